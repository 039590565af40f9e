// A rectangle of pixels that the viewer paints itself: buffers, wireframes, the timeline.
#pragma once

#include <concepts>
#include <cstdint>
#include <imgui.h>
#include <span>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::viewer {

/// A whole number of pixels, lines or rows, as Dear ImGui counts them.
template <std::integral Whole>
constexpr float to_float(Whole number) {
  return static_cast<float>(number);
}

/// The point so far to the right of another and below it.
inline ImVec2 moved_by(ImVec2 from, double right, double down) {
  return {from.x + static_cast<float>(right), from.y + static_cast<float>(down)};
}

// Lines and circles. Dear ImGui's own take 1/√x as the processor estimates it, and cosines of the C library: a picture
// would be another on another computer.

/// So thick, in pixels, from pixel's centre to pixel's centre.
void stroke_line(ImDrawList* list, ImVec2 from, ImVec2 to, ImU32 color, float thickness);
/// From point to point, and `closed`: from the last to the first. Here the points are corners of pixels.
void stroke_lines(ImDrawList* list, std::span<const ImVec2> points, ImU32 color, float thickness, bool closed = false);
void stroke_circle(ImDrawList* list, ImVec2 center, float radius, ImU32 color, float thickness);
void fill_circle(ImDrawList* list, ImVec2 center, float radius, ImU32 color);

/// 0xAARRGGBB.
using Pixel32 = std::uint32_t;
constexpr Pixel32 opaque(Color c) {
  return 0xff000000u | static_cast<Pixel32>(c.red) << 16 | static_cast<Pixel32>(c.green) << 8 |
         static_cast<Pixel32>(c.blue);
}
/// `share` 0…255 of `top` over `bottom`.
constexpr Pixel32 mixed(Pixel32 bottom, Pixel32 top, unsigned share) {
  const auto channel = [&](int shift) {
    const unsigned b = bottom >> shift & 255u, t = top >> shift & 255u;
    return ((b * (255u - share) + t * share + 127u) / 255u) << shift;
  };
  return 0xff000000u | channel(16) | channel(8) | channel(0);
}

class Canvas {
 public:
  void resize(int width, int height);
  void fill(Pixel32 color);
  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  Pixel32* row(int y) { return pixels_.data() + pixel_at(0, y, width_); }
  const Pixel32* row(int y) const { return pixels_.data() + pixel_at(0, y, width_); }

  /// Clipped to the canvas; right and bottom are exclusive.
  void rectangle(int left, int top, int right, int bottom, Pixel32 color);
  /// An antialiased line, one to a few pixels wide, by distance to the segment; coverage is mixed over what is there,
  /// at most `share` of 255.
  void line(double x0, double y0, double x1, double y1, double thickness, Pixel32 color, unsigned share = 255);
  /// A mark around a point, antialiased: 0 disc, 1 square, 2 triangle, 3 diamond.
  void mark(double x, double y, double radius, int shape, Pixel32 color);

 private:
  int width_ = 0, height_ = 0;
  std::vector<Pixel32> pixels_;
};

}  // namespace zstep::viewer
