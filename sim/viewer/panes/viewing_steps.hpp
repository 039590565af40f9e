// The viewing transformation one matrix after the other, T_1 … T_4: the axes before and after, and the matrix in type.
#pragma once

#include "sim/viewer/panes/room_pen.hpp"

namespace zstep::viewer {

/// Whether this scene's camera is made of the four.
bool has_viewing_steps(const Scene& scene);
/// Which of them is shown, 0 for none: as the reader chose, until a stop of the lesson speaks that shows another.
int viewing_step(const Ui& ui);
void choose_viewing_step(Ui& ui, int step);

/// The axes in which coordinates are counted before this step, dashed, and after it, with their names.
void draw_viewing_axes(RoomPen& pen, const Camera& camera, int step);

/// Where all of them end, so that none is outside the picture.
std::vector<glm::dvec3> ends_of_viewing_axes(const Room& room, const Camera& camera);

/// In a pane that is large enough, and sees the scene from outside: a button for each, and of the one that is shown
/// what it does, its matrix, and a vertex before and after. True where one is shown, and the rest of the pane is the
/// scene's.
bool draw_viewing_steps(Ui& ui);

}  // namespace zstep::viewer
