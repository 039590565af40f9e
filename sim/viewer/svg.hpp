// What a frame drew, as SVG: for slides, which show it at any size.
#pragma once

#include <string>

#include <imgui.h>

#include "sim/viewer/draw/fonts.hpp"
#include "sim/viewer/motion.hpp"

namespace zstep::viewer {

/// What was drawn in this part of the window, on this ground: letters as text, shapes as paths, canvases as pictures of
/// their pixels. Dear ImGui's atlas must be as it was then.
std::string svg_of(const ImDrawData& data, const Fonts& fonts, const Motion::Place& part, ImU32 ground);

}  // namespace zstep::viewer
