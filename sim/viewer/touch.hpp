// What fingers on a screen mean, as a mouse would say it: a tap is a click, a finger that rests is a right click, a
// swipe drags or scrolls, two fingers zoom and move. Knows neither the window nor who draws in it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace zstep::viewer {

class Touch {
 public:
  struct Point {
    float x = 0, y = 0;
  };
  /// Something for the mouse to do.
  struct Act {
    enum class Kind : std::uint8_t {
      point,        ///< the mouse is there
      tap,          ///< its left button goes down and up
      press,        ///< its left button goes down, and something is dragged from there
      release,      ///< and up
      right_click,  ///< its right button goes down and up
      release_right,
      hold,    ///< its middle button goes down
      let_go,  ///< and up
      scroll,  ///< what lies there is moved by `by`
      zoom,    ///< what lies there is enlarged by `factor`
      leave    ///< the mouse is nowhere
    };
    Kind kind;
    Point at{};
    Point by{};
    float factor = 1;
  };
  /// Milliseconds that a finger rests until it is a right click.
  static constexpr std::int64_t long_press = 500;

  /// `scrolls`: whether a swipe that begins there scrolls; else it drags.
  explicit Touch(std::function<bool(Point)> scrolls) : scrolls_(std::move(scrolls)) {}
  float slop = 10;  ///< as far as a finger may move that taps or rests

  /// Times in milliseconds.
  std::vector<Act> down(std::int64_t finger, Point at, std::int64_t now);
  std::vector<Act> move(std::int64_t finger, Point at);
  std::vector<Act> up(std::int64_t finger);
  /// What time alone does.
  std::vector<Act> wait(std::int64_t now);
  /// When that is to be asked again; nothing while no finger rests.
  std::optional<std::int64_t> due() const;
  /// All fingers are gone, and nothing more is meant by them.
  std::vector<Act> end();

 private:
  struct Finger {
    std::int64_t id;
    Point at;
  };
  enum class Means : std::uint8_t { nothing, rests, drags, scrolls, two_move, two_scroll, done };
  Finger* find(std::int64_t finger);
  Point middle() const;
  float apart() const;
  std::vector<Act> stop();

  std::function<bool(Point)> scrolls_;
  std::vector<Finger> fingers_;
  Means means_ = Means::nothing;
  Point began_;
  std::int64_t since_ = 0;
};

}  // namespace zstep::viewer
