// What stays from run to run: theme, text size, borders, places in traces, progress in lessons, files opened before.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

/// Where the borders between panes are, as shares of the window or of the row they divide.
struct Layout {
  float left = 0.22f;                       ///< width of pseudo-code and explanation
  float right = 0.225f;                     ///< width of the lesson
  float code = 0.5f;                        ///< height of the pseudo-code in its column
  float stage = 0.8f;                       ///< height of what leads above the small panes
  float frame = 0.5f;                       ///< width of the first of two panes that lead
  float table = 0.58f;                      ///< the same beside a table
  float both = 0.62f;                       ///< height of two runs' frames above what they live by
  float lesson = 0.235f;                    ///< width of the words in a lesson's layout
  float drawer_width = 0.25f;               ///< of the drawer beside the stage
  float drawer_height = 0.3f;               ///< of the drawer below it
  std::map<std::string, float> structures;  ///< weights by pane id
  bool operator==(const Layout&) const = default;
};

struct Settings {
  bool dark = false, presenter = false;
  bool embedded = false;        ///< inside a page of others, for this run; never saved
  bool reduced_motion = false;  ///< nothing moves by itself
  float text_scale = 1;
  int width = 0, height = 0;  ///< of the window; 0: never set
  int speed = 2;
  Layout layout;
  using Kept = std::vector<std::pair<std::string, std::int64_t>>;
  Kept places;   ///< by trace, newest last
  Kept lessons;  ///< how many of its stops were come to, by lesson, the one that was open last at the end

  std::vector<std::string> files;  ///< of the reader's own that were opened, by their whole paths, newest last

  std::optional<std::int64_t> place(const std::string& key) const;
  void remember(const std::string& key, std::int64_t position);
  int stops_seen(const std::string& lesson) const;
  /// But for places, of which each step makes another.
  bool same_but_for_places(const Settings& other) const;
  void see_stop(const std::string& lesson, int stops);  ///< so many, counted from its first
  void see_file(const std::string& path);
};

/// What to save when a run ends: what options of the command line set for this run alone (dark, presenter: in `begun`,
/// not in `stored`) is as it was before, unless it was changed meanwhile.
Settings kept_settings(const Settings& stored, const Settings& begun, Settings ended);

/// The size a window opens at: the one asked for, even if it is the usual one, or else the one it was left at.
WindowSize opening_size(const Settings& left, const std::optional<WindowSize>& asked);

/// $XDG_CONFIG_HOME/zstep/viewer.ini, or the platform's likeness of it; empty when there is no home.
std::filesystem::path settings_path();

/// What cannot be read is left at its default: a damaged file must not keep the viewer from opening.
Settings load_settings(const std::filesystem::path& path);
Settings read_settings(std::istream& from);
/// Whether a line of such a file names one of the reader's files, which are none of another computer's.
bool is_own_file(std::string_view line);
/// False when it could not be written.
bool save_settings(const std::filesystem::path& path, const Settings& settings);

// All that stays from run to run in one file, which a reader can carry to another computer or browser: settings, how
// far lessons were read, and their bookmarks.
//
//     # zstep: settings, progress and bookmarks
//     [viewer.ini]
//     dark = 1
//     lesson z-buffer = 4
//     [lessons/z-buffer.marks]
//     219 the first tie
//
// Below a name in brackets stands what the file of that name in kept_folder() says.

/// Its name where it is saved, and how the name of one ends.
constexpr const char* progress_file_name = "zstep-progress.ini";
bool is_progress_file(const std::string& path);

/// What the folder keeps, in this form.
std::string progress_text(const std::filesystem::path& folder);

/// Takes over what such a file says: its settings, of each lesson and each trace the place that is further, and the
/// bookmarks whose names are not there yet, which are written to `folder`. Returns what the settings are then. Throws
/// InputError, and has changed nothing, where the file is none or what is kept cannot be read.
Settings take_progress(const std::filesystem::path& file, const std::filesystem::path& folder, const Settings& here);

// Files of the reader's own on the start page: those that were opened before, and those that a typed path may mean.

class OwnFiles {
 public:
  /// Which of these, the newest last, are still there.
  void look_for(const std::vector<std::string>& opened_before);

  /// What may be meant by what is typed, the likeliest first: files that were opened before and have it in their paths;
  /// what the folder it names, or else the current one, has whose name begins so, folders first; and last the path
  /// itself, where it is one or a formula. A folder ends in "/".
  std::vector<const Offer*> find(const std::string& typed);

 private:
  std::vector<Offer> before_, listed_;
  std::string listed_for_;
};

/// Whether choosing it leads into a folder.
bool is_folder(const Offer& offer);

}  // namespace zstep::viewer
