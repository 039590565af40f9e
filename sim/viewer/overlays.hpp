// What overlays share. For overlays.cpp and for the overlays that show answers.
#pragma once

#include <cstdint>
#include <string>

#include "sim/viewer/app.hpp"

namespace zstep::viewer {

/// Begins a framed window over the others: `down` 0 at the top of the screen, 1 at its bottom. A click outside closes
/// it.
void begin_overlay(App& app, const char* id, ImVec2 size, float down = 1 / 2.4f);
/// The same with a corner at this place, as far as the screen has room.
void begin_overlay(App& app, const char* id, ImVec2 size, ImVec2 corner);

/// The next row of a list of answers: where it is, and whether it was clicked. The picked one is marked and scrolled
/// to.
struct ListRow {
  ImVec2 at, end;
  bool clicked = false, visible = true;
};
ListRow list_row(App& app, std::size_t place, float height);

/// How wide a column of steps is: as the widest of them, with a gap beside it, and never narrower than it usually is.
float step_column(const Ui& ui, std::int64_t last_step);

/// A depth as lists of answers write it, with the signs of the rest of the viewer: "−0.25", "∞".
std::string depth_in_list(double z);

/// A polygon's colour in a row of a list.
void draw_swatch(Ui& ui, ImVec2 at, float height, const Scene& scene, std::int32_t polygon);

/// A text cut with a sign where it has no room.
std::string fitted(const Ui& ui, const ImFont* font, std::string text, float room);

/// How far something long is, over all else, and how it is ended.
void draw_progress(App& app, const std::string& text, double share, const std::string& help);

/// What is wrong with what is typed.
void say_wrong(Ui& ui, const std::string& what);

}  // namespace zstep::viewer
