// Lines and circles. Dear ImGui's own take 1/√x as the processor estimates it, and cosines of the C library: a picture
// would be another on another computer.
#pragma once

#include <span>

#include <imgui.h>

namespace zstep::viewer {

/// So thick, in pixels, from pixel's centre to pixel's centre.
void stroke_line(ImDrawList* list, ImVec2 from, ImVec2 to, ImU32 color, float thickness);
/// From point to point, and `closed`: from the last to the first. Here the points are corners of pixels.
void stroke_lines(ImDrawList* list, std::span<const ImVec2> points, ImU32 color, float thickness, bool closed = false);
void stroke_circle(ImDrawList* list, ImVec2 center, float radius, ImU32 color, float thickness);
void fill_circle(ImDrawList* list, ImVec2 center, float radius, ImU32 color);

}  // namespace zstep::viewer
