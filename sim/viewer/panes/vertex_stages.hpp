// The coordinates of the vertices at work, stage by stage: world, view, projected, screen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

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

}  // namespace zstep::viewer
