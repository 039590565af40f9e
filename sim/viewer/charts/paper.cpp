#include "sim/viewer/charts/paper.hpp"
#include "traces/math/portable_math.hpp"

#include <algorithm>
#include <cmath>

namespace zstep::viewer {

void Paper::dashed_line(ImVec2 from, ImVec2 to, ImU32 color, float thickness) {
  const float dx = to.x - from.x, dy = to.y - from.y, length = portable::length(dx, dy);
  constexpr float dash = 10, gap = 8;
  for (float at = 0; at < length; at += dash + gap) {
    const float begin = at / length, end = std::min(at + dash, length) / length;
    line({from.x + begin * dx, from.y + begin * dy}, {from.x + end * dx, from.y + end * dy}, color, thickness);
  }
}

void Paper::rule(ImVec2 from, ImVec2 to, ImU32 color) {
  const bool across = std::abs(to.x - from.x) > std::abs(to.y - from.y);
  const ImVec2 end = across ? ImVec2(to.x, from.y + 1) : ImVec2(from.x + 1, to.y);
  rectangle(from, end, color);
}

}  // namespace zstep::viewer
