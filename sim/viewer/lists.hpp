// Lists that are chosen from, in overlays and in the drawer: their rows, and what stands in them.
#pragma once

#include <cstdint>
#include <string>

#include "sim/viewer/app.hpp"

namespace zstep::viewer {

/// The next row of a list: where it is, and whether it was clicked. The picked one is marked and scrolled to.
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

/// What is wrong with what is typed.
void say_wrong(Ui& ui, const std::string& what);

}  // namespace zstep::viewer
