// Drives the viewer without a window: events in, pixels out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <SDL.h>

#include "sim/viewer/app.hpp"
#include "tests/sparse.hpp"

namespace zstep::test {

using Bytes = std::vector<std::uint8_t>;

inline Bytes picture(viewer::App& app) {
  app.settle();
  return app.renderer().rgb();
}

/// As the window's loop does: a frame where the next event needs one.
inline void send(viewer::App& app, const SDL_Event& event) {
  if (app.handle(event)) app.frame();
}

inline void send_text(viewer::App& app, const std::string& character) {
  SDL_Event event{};
  event.type = SDL_TEXTINPUT;
  std::copy(character.begin(), character.end(), event.text.text);
  send(app, event);
}

/// A key goes down. As under X11 its text follows, with Ctrl as well unless that makes a control character of it.
inline void press(viewer::App& app, SDL_Keycode key, std::uint16_t modifiers = KMOD_NONE) {
  SDL_Event event{};
  event.type = SDL_KEYDOWN;
  event.key.keysym.sym = key;
  event.key.keysym.mod = modifiers;
  send(app, event);
  const bool letter = key >= SDLK_a && key <= SDLK_z;
  if (key < SDLK_SPACE || key >= SDLK_DELETE || (letter && (modifiers & KMOD_CTRL) != 0)) return;
  send_text(app, std::string(1, static_cast<char>(letter && (modifiers & KMOD_SHIFT) != 0 ? key - SDLK_a + 'A' : key)));
}

inline void release(viewer::App& app, SDL_Keycode key) {
  SDL_Event event{};
  event.type = SDL_KEYUP;
  event.key.keysym.sym = key;
  send(app, event);
}

/// Keys one after another. What is no letter of ASCII comes as text alone, as from an input method.
inline void type(viewer::App& app, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) < 0x80) {
      const bool capital = c >= 'A' && c <= 'Z';
      const SDL_Keycode key = capital ? c - 'A' + 'a' : c;
      press(app, key, capital ? KMOD_LSHIFT : KMOD_NONE);
      release(app, key);
      ++at;
      continue;
    }
    std::size_t end = at + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) ++end;
    send_text(app, text.substr(at, end - at));
    at = end;
  }
}

inline void move_mouse(viewer::App& app, int x, int y) {
  SDL_Event event{};
  event.type = SDL_MOUSEMOTION;
  event.motion.x = x;
  event.motion.y = y;
  app.handle(event);
  app.frame();
  app.frame();
}

inline void mouse_button(viewer::App& app, int x, int y, bool down, std::uint8_t button = SDL_BUTTON_LEFT) {
  SDL_Event event{};
  event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
  event.button.button = button;
  event.button.x = x;
  event.button.y = y;
  app.handle(event);
  app.frame();
}

inline void click(viewer::App& app, int x, int y, std::uint8_t button = SDL_BUTTON_LEFT) {
  move_mouse(app, x, y);
  mouse_button(app, x, y, true, button);
  mouse_button(app, x, y, false, button);
  app.frame();
}

/// How many pixels of a picture have this colour (0xRRGGBB).
inline int count_of(const Bytes& rgb, std::uint32_t color) {
  int count = 0;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
    count += rgb[i] == (color >> 16 & 255u) && rgb[i + 1] == (color >> 8 & 255u) && rgb[i + 2] == (color & 255u);
  return count;
}

}  // namespace zstep::test
