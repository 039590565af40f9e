// The system around the window, where zstep is a program of a desktop.
#include <SDL.h>

#include "sim/viewer/desktop/file_dialogue.hpp"
#include "sim/viewer/loop.hpp"
#include "sim/viewer/system.hpp"

namespace zstep::viewer::system {

void keep_turning(std::unique_ptr<Loop> loop) {
  while (loop->turn(Loop::May::wait)) {
  }
}

void copy_text(const std::string& text) { SDL_SetClipboardText(text.c_str()); }

std::string ask_for_file() {
  static FileDialogue dialogue;
  if (dialogue.ask(std::filesystem::current_path())) return "";
  return "This desktop has no dialogue for files (zenity or kdialog); type the path of a file.";
}

std::string hand_over(const std::filesystem::path&) { return "in the folder zstep was started in"; }

void kept(const std::filesystem::path&) {}

std::string address() { return ""; }

void arrived(const std::string&, bool) {}

bool open_beside(const std::string&) { return false; }

/// An input method has its candidates there.
void typing_at(const std::optional<TypedLine>& line) {
  if (!line) return;
  const SDL_Rect place{line->left, line->top, line->right - line->left, line->bottom - line->top};
  SDL_SetTextInputRect(&place);
}

bool is_heard() { return false; }

void say(const std::string&) {}

void show_tables(const std::string&) {}

void offer_commands(const std::string&) {}

}  // namespace zstep::viewer::system
