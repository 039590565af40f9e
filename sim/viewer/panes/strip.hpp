// A part of the trace laid out from left to right: the place of each step on it, and the step at each place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <imgui.h>

namespace zstep::viewer {

struct Strip {
  ImVec2 at;
  float width, height;
  std::int64_t first, last;  ///< positions at its ends
  bool holds(std::int64_t position) const { return position >= first && position <= last; }
  float x(std::int64_t position) const {
    if (last <= first) return at.x;
    return at.x + width * static_cast<float>(static_cast<double>(position - first) / static_cast<double>(last - first));
  }
  std::int64_t position(float mouse) const {
    const double share = std::clamp((mouse - at.x) / width, 0.0f, 1.0f);
    return first + std::llround(share * static_cast<double>(last - first));
  }
};

}  // namespace zstep::viewer
