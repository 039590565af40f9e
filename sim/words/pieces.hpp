// The nodes of the tree that pieces belong to.
#pragma once

#include <cstdint>

#include "traces/replay/vertex_points.hpp"

namespace zstep {

/// The plane of a node of the tree; none where the trace does not tell.
const PlaneEquation* plane_of_node(const MethodState& machine, std::int32_t node);
/// The node at which a piece lies, -1 where there is none.
std::int32_t node_of_piece(const MethodState& machine, std::int32_t piece);
/// The node that the step is about: that of the piece being drawn, else the one tested or made last.
std::int32_t node_at_work(const MethodState& machine, const Event* event);

}  // namespace zstep
