#include "sim/viewer/draw/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
namespace {

/// As many corners as make it round to a third of a pixel.
std::vector<ImVec2> corners_of_circle(ImVec2 center, float radius) {
  const double flat = portable::acos(1 - std::min(0.3 / std::max(static_cast<double>(radius), 0.3), 1.0));
  const int count = std::clamp(static_cast<int>(std::ceil(std::numbers::pi / flat)), 12, 512);
  std::vector<ImVec2> corners;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    corners.push_back({center.x + radius * static_cast<float>(portable::cos(angle)),
                       center.y + radius * static_cast<float>(portable::sin(angle))});
  }
  return corners;
}

}  // namespace

void stroke_lines(ImDrawList* list, std::span<const ImVec2> points, ImU32 color, float thickness, bool closed) {
  if ((color & IM_COL32_A_MASK) == 0 || points.size() < 2) return;
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  const std::size_t count = closed ? points.size() : points.size() - 1;
  list->PrimReserve(static_cast<int>(6 * count), static_cast<int>(4 * count));
  for (std::size_t k = 0; k < count; ++k) {
    const ImVec2 a = points[k], b = points[(k + 1) % points.size()];
    const float length = portable::length(b.x - a.x, b.y - a.y), half = length > 0 ? thickness / 2 / length : 0;
    const float x = (b.x - a.x) * half, y = (b.y - a.y) * half;
    list->PrimQuadUV({a.x + y, a.y - x}, {b.x + y, b.y - x}, {b.x - y, b.y + x}, {a.x - y, a.y + x}, white, white,
                     white, white, color);
  }
}

void stroke_line(ImDrawList* list, ImVec2 from, ImVec2 to, ImU32 color, float thickness) {
  const ImVec2 ends[] = {{from.x + 0.5f, from.y + 0.5f}, {to.x + 0.5f, to.y + 0.5f}};
  stroke_lines(list, ends, color, thickness);
}

void stroke_circle(ImDrawList* list, ImVec2 center, float radius, ImU32 color, float thickness) {
  stroke_lines(list, corners_of_circle(center, radius - 0.5f), color, thickness, true);
}

void fill_circle(ImDrawList* list, ImVec2 center, float radius, ImU32 color) {
  const std::vector<ImVec2> corners = corners_of_circle(center, radius);
  list->AddConvexPolyFilled(corners.data(), static_cast<int>(corners.size()), color);
}

}  // namespace zstep::viewer
