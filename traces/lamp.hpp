// A lamp as a camera, and the matrices of cameras: a trace has the lamp alone, and what it sees follows from it.
#pragma once

#include "traces/scene.hpp"

namespace zstep {

/// World to view, from its first three rows.
glm::dmat4 view_from_rows(glm::dvec4 row_1, glm::dvec4 row_2, glm::dvec4 row_3);

/// World to view for an eye that looks at `target`, with `up` upwards in the picture; left-handed as T_v is. `eye` and
/// `target` must differ. An `up` along the line of sight says nothing: the world axis furthest from that line stands
/// in.
glm::dmat4 look_at_view(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up);

/// The light as a camera that sees what it shines on, with the world's z axis upwards.
Camera camera_of(const Light& light);

}  // namespace zstep
