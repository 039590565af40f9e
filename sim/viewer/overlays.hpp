// What overlays share. For overlays.cpp and query_overlay.cpp only.
#pragma once

#include <string>

#include "sim/viewer/app.hpp"

namespace zstep::viewer {

/// Begins a framed window over the others: `down` 0 at the top of the screen, 1 at its bottom. A click outside closes it.
void begin_overlay(App& app, const char* id, ImVec2 size, float down = 1 / 2.4f);

/// What is being typed, with its caret in sight; the hint where nothing is.
void draw_field(Ui& ui, const std::string& text, const std::string& hint);

}  // namespace zstep::viewer
