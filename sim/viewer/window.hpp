// A window of the system's, and what it knows of its screen.
#pragma once

#include <memory>

#include <SDL.h>

#include "sim/viewer/draw/canvas.hpp"

namespace zstep::viewer {

class Window {
 public:
  /// Not larger than the screen. Throws InputError where no window can be opened.
  Window(int width, int height);
  /// A second one, which goes before the first; on another screen, where there is one. The keyboard stays with the
  /// first.
  Window(const Window& first, const char* title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  SDL_Window* get() const { return window_.get(); }
  SDL_Surface* surface() const;
  float pixels_per_point() const;  ///< of the surface, per unit of the mouse's coordinates
  float dpi_scale() const;         ///< pixels of the surface per pixel of a common screen
  bool full_screen() const { return (SDL_GetWindowFlags(window_.get()) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0; }
  void show(const Canvas& picture) const;
  /// Over what is shown, a bar along the upper edge: how much of something long is done.
  void show_progress(double share) const;
  /// Esc was pressed, or the window is to be closed. What was typed before Esc is dropped; without it, keys wait for
  /// what is done now, each once however long it is held.
  static bool is_ended();

 private:
  struct Deleter {
    void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
  };
  std::unique_ptr<SDL_Window, Deleter> window_;
  bool second_ = false;
};

/// Where a second window goes on the one screen that there is: a lower right corner of it, at most half as wide and
/// high, so that the first is seen beside it.
SDL_Rect place_beside(const SDL_Rect& usable, int width, int height);

}  // namespace zstep::viewer
