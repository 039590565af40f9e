
#include "sim/viewer/draw/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// As many corners as make it round to a third of a pixel.
std::vector<ImVec2> corners_of_circle(ImVec2 center, float radius) {
  const double flat = portable::acos(1 - std::min(0.3 / std::max<double>(radius, 0.3), 1.0));
  const int count = std::clamp(ceil_int(std::numbers::pi / flat), 12, 512);
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
  list->AddConvexPolyFilled(corners.data(), size32(corners), color);
}

void Canvas::resize(int width, int height) {
  width_ = std::max(0, width);
  height_ = std::max(0, height);
  pixels_.assign(pixel_count(width_, height_), 0xff000000u);
}

void Canvas::fill(Pixel32 color) { std::fill(pixels_.begin(), pixels_.end(), color); }

void Canvas::rectangle(int left, int top, int right, int bottom, Pixel32 color) {
  left = std::max(left, 0);
  top = std::max(top, 0);
  right = std::min(right, width_);
  bottom = std::min(bottom, height_);
  for (int y = top; y < bottom; ++y)
    if (left < right) std::fill(row(y) + left, row(y) + right, color);
}

namespace {

/// Cuts the segment to the box; false when nothing is left. Keeps far-away ends from costing time.
bool cut_to(double left, double top, double right, double bottom, double& x0, double& y0, double& x1, double& y1) {
  double first = 0, last = 1;
  const double dx = x1 - x0, dy = y1 - y0;
  const auto side = [&](double p, double q) {
    if (p == 0) return q >= 0;
    const double t = q / p;
    if (p < 0) first = std::max(first, t);
    else last = std::min(last, t);
    return first <= last;
  };
  if (!side(-dx, x0 - left) || !side(dx, right - x0) || !side(-dy, y0 - top) || !side(dy, bottom - y0)) return false;
  const double ox = x0, oy = y0;
  x0 = ox + first * dx;
  y0 = oy + first * dy;
  x1 = ox + last * dx;
  y1 = oy + last * dy;
  return true;
}

}  // namespace

void Canvas::line(double x0, double y0, double x1, double y1, double thickness, Pixel32 color, unsigned share) {
  if (!std::isfinite(x0) || !std::isfinite(y0) || !std::isfinite(x1) || !std::isfinite(y1)) return;
  if (!cut_to(-4, -4, width_ + 4.0, height_ + 4.0, x0, y0, x1, y1)) return;
  const bool steep = std::abs(y1 - y0) > std::abs(x1 - x0);
  if (steep) {
    std::swap(x0, y0);
    std::swap(x1, y1);
  }
  if (x0 > x1) {
    std::swap(x0, x1);
    std::swap(y0, y1);
  }
  // Along the longer axis; across it, coverage falls off linearly around the true width.
  const double length = x1 - x0, slope = length > 0 ? (y1 - y0) / length : 0;
  const double half = thickness / 2 * std::sqrt(1 + slope * slope);
  const int first = floor_int(x0), last = floor_int(x1);
  const int across = steep ? width_ : height_, along = steep ? height_ : width_;
  for (int u = std::max(first, 0); u <= std::min(last, along - 1); ++u) {
    const double middle = y0 + (std::clamp(u + 0.5, x0, x1) - x0) * slope;
    const int low = floor_int(middle - half), high = floor_int(middle + half);
    for (int v = std::max(low, 0); v <= std::min(high, across - 1); ++v) {
      const double covered = std::min(v + 1.0, middle + half) - std::max<double>(v, middle - half);
      if (covered <= 0) continue;
      Pixel32& pixel = steep ? row(u)[v] : row(v)[u];
      pixel = mixed(pixel, color, nearest_int(std::min(covered, 1.0) * share));
    }
  }
}

namespace {

// How far (x, y) lies inside a mark around the origin, in pixels; negative outside.
double inside_mark(int shape, double x, double y, double r) {
  switch (shape % 4) {
    case 0:
      return r - portable::length(x, y);
    case 1:
      return 0.9 * r - std::max(std::abs(x), std::abs(y));
    case 2:
      return std::min(0.75 * r - y, 0.45 * (y + 1.35 * r) - 0.9 * std::abs(x));
    default:
      return (1.35 * r - std::abs(x) - std::abs(y)) * 0.707;
  }
}

}  // namespace

void Canvas::mark(double x, double y, double radius, int shape, Pixel32 color) {
  // What is far outside is not looked at; neither are coordinates that no int can hold.
  const double reach = radius * 1.5 + 2;
  if (!(x > -reach && x < width_ + reach && y > -reach && y < height_ + reach)) return;
  const int left = std::max(0, static_cast<int>(x - reach)), right = std::min(width_ - 1, static_cast<int>(x + reach));
  const int top = std::max(0, static_cast<int>(y - reach)), bottom = std::min(height_ - 1, static_cast<int>(y + reach));
  for (int py = top; py <= bottom; ++py)
    for (int px = left; px <= right; ++px) {
      const double covered = std::clamp(inside_mark(shape, px - x, py - y, radius) + 0.5, 0.0, 1.0);
      Pixel32& pixel = row(py)[px];
      pixel = mixed(pixel, color, nearest_int(255 * covered));
    }
}

}  // namespace zstep::viewer
