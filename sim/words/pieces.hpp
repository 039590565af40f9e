// What pieces of polygons are called: by the nodes of the tree that they belong to, and for lists of many.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traces/replay/state.hpp"

namespace zstep {

/// The plane of a node of the tree; none where the trace does not tell.
const PlaneEquation* plane_of_node(const MethodState& machine, std::int32_t node);
/// The node at which a piece lies, -1 where there is none.
std::int32_t node_of_piece(const MethodState& machine, std::int32_t piece);
/// The first piece of a polygon at a node; -1 where there is none.
std::int32_t piece_at_node(const MethodState& machine, std::int32_t node, std::int32_t polygon);
/// The node that the step is about: that of the piece being drawn, else the one tested or made last.
std::int32_t node_at_work(const MethodState& machine, const Event* event);

// The labels of all pieces of a machine, for lists of many: each alone (piece_label) looks at those before it.

/// By piece, what piece_label says of each.
std::vector<std::string> piece_labels(const Scene& scene, const MethodState& machine);

}  // namespace zstep
