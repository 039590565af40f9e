// What the viewer asks of the system around its window. One implementation is linked: the desktop's
// (sim/viewer/desktop/), or a browser's (sim/viewer/browser/).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace zstep::viewer {

class FilmMaker;
class Loop;

namespace system {

/// Turns it until the window is closed. In a browser the page turns it, and this returns at once.
void keep_turning(std::unique_ptr<Loop> loop);

void copy_text(const std::string& text);

/// Lets the reader choose a file, which comes to the window as one that is dropped on it does. Says what is wrong where
/// that cannot be, else nothing.
std::string ask_for_file();

/// A file was written for the reader, by a name without a folder. What became of it: "in the folder zstep was started
/// in".
std::string hand_over(const std::filesystem::path& file);

/// Makes a film of frames of this size, so many a second. Throws InputError where there is nothing that makes films.
std::unique_ptr<FilmMaker> make_film(const std::filesystem::path& path, int width, int height, double frames_a_second);
/// Where a film of this name goes, with the extension of what is made.
std::filesystem::path film_path(const std::string& name);

/// Something was kept for the next time in a file of this folder.
void kept(const std::filesystem::path& folder);

/// What stands before a link when it is copied: the address of the page, or nothing.
std::string address();

/// The reader is there now; `at_stop`: come to anew, so that going back leads here.
void arrived(const std::string& link, bool at_stop);

/// Opens a link in a window with everything, beside this one. False where this window is to become that.
bool open_beside(const std::string& link);

/// Between these corners, in the mouse's units, stands the line that is typed into now; nothing: none is. A keyboard
/// that is drawn on the screen comes up for it and leaves it to be seen.
struct TypedLine {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool operator==(const TypedLine&) const = default;
};
void typing_at(const std::optional<TypedLine>& line);

/// Whether what is shown is said besides, for a screen reader, and saying it: the step as a text, and lists as
/// description.hpp parts them.
bool is_heard();
void say(const std::string& text);
void show_tables(const std::string& list);
void offer_commands(const std::string& list);

}  // namespace system
}  // namespace zstep::viewer
