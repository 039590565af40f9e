// The viewing transformation one matrix after the other, T_1 … T_4: the axes before and after, the matrix in type, and
// a vertex at each stage.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/panes/scene_in_space.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

// The coordinates of the vertices at work, stage by stage: world, view, projected, screen.

/// The vertex that the step is about; −1 for none.
std::int32_t vertex_at_work(const RecordedEvent* event);
/// Those of the polygon at work, and the one that the step is about.
std::vector<std::int32_t> vertices_shown(const Session& session);
/// Their stages, below each other.
void draw_vertex_stages(Ui& ui);

struct StageRow {
  const char* stage;
  std::optional<glm::dvec3> at;
  bool flat;          ///< x and y alone
  std::string field;  ///< what x, y and z are called there: x_v, y_v, z_v
};
/// How the numbers of a vertex are set.
struct StageLayout {
  const ImFont* font;
  int across;  ///< numbers side by side: three, or one below the other
  int decimals;
  float name, column;  ///< widths
};
/// Where three do not fit into the room, smaller type, then one below the other; never fewer decimals, for 0 is another
/// number than 0.5.
StageLayout lay_out_stages(const Ui& ui, const std::vector<StageRow>& rows, float room);

/// Whether this scene's camera is made of the four.
bool has_viewing_steps(const Scene& scene);
/// Which of them is shown, 0 for none: as the reader chose, until a stop of the lesson speaks that shows another.
int viewing_step(const Ui& ui);
void choose_viewing_step(Ui& ui, int step);

/// The axes in which coordinates are counted before this step, dashed, and after it, with their names; or on the way
/// there, where they have not arrived.
void draw_viewing_axes(RoomPen& pen, const Camera& camera, int step, double arrived);

/// Where each order of T_1 … T_4 takes the eye, one after the other from the right.
std::vector<std::vector<glm::dvec3>> ways_of_eye(const Camera& camera, const std::vector<std::vector<int>>& orders);
/// These ways in the world's axes, with the coordinates after each.
void draw_orders(RoomPen& pen, const Camera& camera, const std::vector<std::vector<int>>& orders);

/// Where all of them end, so that none is outside the picture.
std::vector<glm::dvec3> ends_of_viewing_axes(const Room& room, const Camera& camera);

/// In a pane that is large enough, and sees the scene from outside: a button for each, and of the one that is shown
/// what it does, its matrix, and a vertex before and after. True where one is shown, and the rest of the pane is the
/// scene's.
bool draw_viewing_steps(Ui& ui);

}  // namespace zstep::viewer
