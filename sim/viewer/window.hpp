// A window of the system's, its title, and what it knows of its screen.
#pragma once

#include <SDL.h>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

// The names in the bar at the top, as many as there is room for.

struct TitleName {
  std::string text;
  int tells = 0;                        ///< how much: where room is scarce, what tells least goes first
  std::optional<Offer::What> offers{};  ///< others, at a click; then a sign behind it says so
  std::string sign() const { return offers ? " \u25be" : ""; }
};

struct TitleMeasures {
  std::function<float(const std::string&)> width;
  std::function<std::string(const std::string&, float)> cut;  ///< to this width, with "\u2026" at its end
  float least = 0;                                            ///< pixels; rather than cut shorter, a name is left out
};

/// "zstep · Hidden lines ▾ · box, plank and card ▾".
std::string joined_names(const std::vector<TitleName>& names);
/// Those that tell most, whole.
std::vector<TitleName> most_telling(std::vector<TitleName> names);
/// One after another goes until the rest fits; what tells most goes last, and is cut before that.
std::vector<TitleName> names_that_fit(std::vector<TitleName> names, float room, const TitleMeasures& measures);

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
