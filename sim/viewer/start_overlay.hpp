// A small picture of what each method lives by, for the start page.
#pragma once

#include <string>
#include <string_view>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/draw/theme.hpp"

namespace zstep::viewer {

bool has_emblem(std::string_view method);

/// Paints the method's, on all of the canvas; nothing but the ground for a method without one.
void paint_emblem(Canvas& canvas, const std::string& method, const Theme& theme);

}  // namespace zstep::viewer
