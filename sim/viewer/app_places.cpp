// What keys do in the boxes for conditions and bookmarks.
#include <algorithm>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/words/numbers.hpp"

namespace zstep::viewer {

void App::run_until(const std::string& condition, Places::Way way) {
  wrong = places_.run_until(condition, way);
  if (wrong.empty()) open(Overlay::none);
  session_.touch();
}

void App::keep_bookmark() {
  wrong = places_.bookmark(typed);
  if (!wrong.empty()) return session_.touch();
  const std::string name = typed;
  open(Overlay::none);
  say(fmt::format("Step {} is kept as {}; L lists all bookmarks.", grouped(session_.position()), name));
}

void App::go_to_bookmark(std::size_t place) {
  const auto& all = places_.bookmarks();
  if (place >= all.size()) return;
  const places::Bookmark mark = all[place];
  open(Overlay::none);
  session_.go_to(mark.step);
  say(fmt::format("Bookmark: {}", mark.name));
}

/// A key for the box of a condition or of a bookmark's name; false if it is none.
bool App::edit_place(SDL_Keycode code, unsigned modifiers) {
  if (overlay_ == Overlay::name_bookmark && code == SDLK_RETURN) return keep_bookmark(), true;
  if (overlay_ != Overlay::until) return false;
  if (code == SDLK_RETURN) return run_until(typed, (modifiers & Chord::shift) != 0 ? Places::Way::backwards : Places::Way::forwards), true;
  if (code != SDLK_UP && code != SDLK_DOWN) return false;
  const auto suggestions = places_.suggestions();
  if (suggestions.empty()) return true;
  picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, static_cast<int>(suggestions.size()) - 1);
  typed = suggestions[static_cast<std::size_t>(picked)].condition;
  wrong.clear();
  scroll_to_picked = true;
  return true;
}

bool App::pick_bookmark(SDL_Keycode code) {
  const int last = static_cast<int>(places_.bookmarks().size()) - 1;
  const auto place = static_cast<std::size_t>(std::max(0, picked));
  if (code == SDLK_RETURN) return go_to_bookmark(place), true;
  if (code == SDLK_DELETE) {
    if (last < 0) return true;
    const std::string name = places_.bookmarks()[std::min(place, static_cast<std::size_t>(last))].name;
    const std::string fault = places_.remove_bookmark(place);
    say(fault.empty() ? fmt::format("Removed the bookmark {}.", name) : fault);
    picked = std::clamp(picked, 0, std::max(0, last - 1));
    return true;
  }
  if (code != SDLK_UP && code != SDLK_DOWN) return false;
  picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, std::max(0, last));
  scroll_to_picked = true;
  return true;
}

}  // namespace zstep::viewer
