// What fingers on a screen mean, as a mouse would say it: a tap is a click, a finger that rests is a right click, a
// swipe drags or scrolls, two fingers zoom and move; and what they can hit. Knows neither the window nor who draws in
// it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <imgui.h>

#include "traces/math/portable_math.hpp"

namespace zstep::viewer {

// What can be hit on the window, so that a finger, which is broader than a mouse, hits what it means.

class Targets {
 public:
  void clear() { all_.clear(); }
  /// What lies between these corners can be hit, as far as it is seen.
  void add(ImVec2 a, ImVec2 b) {
    if (a.x < b.x && a.y < b.y) all_.push_back({a, b});
  }
  /// Where a finger at this place hits: there, if something or nothing lies there; else in the nearest that, were it at
  /// least so wide and high, would lie there.
  ImVec2 aim(ImVec2 at, float least) const {
    const auto beyond = [](float x, float low, float high) { return x < low ? low - x : x >= high ? x - high + 1 : 0; };
    const Box* nearest = nullptr;
    float away = 1e9f;
    for (const Box& box : all_) {
      const float x = beyond(at.x, box.a.x, box.b.x), y = beyond(at.y, box.a.y, box.b.y);
      if (x == 0 && y == 0) return at;
      const auto reach = [least](float low, float high) { return std::max(0.0f, (least - (high - low)) / 2); };
      if (x > reach(box.a.x, box.b.x) || y > reach(box.a.y, box.b.y) || portable::length(x, y) >= away) continue;
      nearest = &box, away = portable::length(x, y);
    }
    if (!nearest) return at;
    return {std::clamp(at.x, nearest->a.x, nearest->b.x - 1), std::clamp(at.y, nearest->a.y, nearest->b.y - 1)};
  }
  struct Box {
    ImVec2 a, b;
  };
  const std::vector<Box>& all() const { return all_; }

 private:
  std::vector<Box> all_;
};

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
