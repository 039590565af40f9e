// Whose a key is: the overlay's, the drawer's, a field's, or a command's.
#include <algorithm>
#include <utility>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/drawer/drawer.hpp"

namespace zstep::viewer {

bool App::pick_among(std::size_t rows, SDL_Keycode code) {
  if (code != SDLK_UP && code != SDLK_DOWN) return false;
  picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, std::max(0, static_cast<int>(rows) - 1));
  scroll_to_picked = true;
  return true;
}

void App::take_found(std::size_t row) {
  const Found taken = finder_.find(*this)[row];  // what is typed goes with the box
  open(Overlay::none);
  taken.go(*this);
}

bool App::pick_found(SDL_Keycode code) {
  const std::vector<Found>& found = finder_.find(*this);
  if (code != SDLK_RETURN) return pick_among(found.size(), code);
  if (picked < static_cast<int>(found.size())) take_found(static_cast<std::size_t>(picked));
  return true;
}

bool App::key_of_box(SDL_Keycode code, unsigned modifiers) {
  switch (overlay_) {
    case Overlay::palette:
      return pick_found(code);
    case Overlay::go_to:
      return code == SDLK_RETURN ? go_to_typed(), true : false;
    case Overlay::start:
      return pick_offer(code);
    case Overlay::racers:
      return pick_racer(code);
    case Overlay::film:
      return pick_film(code);
    case Overlay::here:
      return pick_here(code);
    case Overlay::settings:
      return pick_setting(code);
    case Overlay::keys:
    case Overlay::menu:
      return false;
    case Overlay::none:
      break;
  }
  // With Alt the arrows move the selection.
  return drawer_has_keys() && (modifiers & Chord::alt) == 0 && (this->*page_of(drawer_)->key)(code, modifiers);
}

bool App::typing() const {
  if (overlay_ == Overlay::none) return drawer_has_keys() && page_of(drawer_)->typed;
  return overlay_ == Overlay::palette || overlay_ == Overlay::go_to || overlay_ == Overlay::start ||
         overlay_ == Overlay::racers || overlay_ == Overlay::film;
}

/// A key while something is typed that the box does not know has one owner: its field, or a command that keeps out of
/// what is typed. False if the key is left to commands.
bool App::type(SDL_Keycode code, unsigned modifiers) {
  const bool arrow = code == SDLK_LEFT || code == SDLK_RIGHT || code == SDLK_UP || code == SDLK_DOWN;
  const bool leaves = code == SDLK_PAGEUP || code == SDLK_PAGEDOWN || (arrow && (modifiers & Chord::alt) != 0);
  if (leaves && overlay_ == Overlay::none) return false;  // the drawer leaves the run to be seen
  if (Field::takes(code, modifiers)) {
    field_.press(code, modifiers);
    text_taken_ = false;
    return true;
  }
  return !(modifiers & Chord::ctrl) && code != SDLK_ESCAPE && code != SDLK_F1 && code != SDLK_F10 && code != SDLK_F11;
}

bool App::key(const SDL_KeyboardEvent& event) {
  const unsigned modifiers = (event.keysym.mod & KMOD_SHIFT ? Chord::shift : 0u) |
                             (event.keysym.mod & (KMOD_CTRL | KMOD_GUI) ? Chord::ctrl : 0u) |
                             (event.keysym.mod & KMOD_ALT ? Chord::alt : 0u);
  SDL_Keycode code = event.keysym.sym;
  if (code == SDLK_KP_ENTER) code = SDLK_RETURN;
  if (event.type == SDL_KEYUP) {
    for (const Command& command : commands())
      if (command.release && !command.keys.empty() && command.keys[0].key == code) command.release(*this);
    return false;
  }
  if (std::exchange(black_, false)) {
    return true;
  }
  if (key_of_box(code, modifiers) || (typing() && type(code, modifiers)) ||
      (overlay_ == Overlay::none && race_shown_ && race_key(code, modifiers))) {
    return true;
  }
  if (const Command* command = command_for(code, modifiers)) {
    if (event.repeat && command->release) return true;
    if (overlay_ == Overlay::keys || overlay_ == Overlay::menu) {
      const std::string id = command->id;
      if (id != "keys" && id != "menu" && id != "escape") open(Overlay::none);
    }
    session_.message.clear();
    run(*command);
    return true;
  }
  return false;
}

}  // namespace zstep::viewer
