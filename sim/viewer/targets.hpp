// What can be hit on the window, so that a finger, which is broader than a mouse, hits what it means.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <imgui.h>

#include "traces/math/portable_math.hpp"

namespace zstep::viewer {

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

}  // namespace zstep::viewer
