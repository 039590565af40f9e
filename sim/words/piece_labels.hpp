// The labels of all pieces of a machine, for lists of many: each alone (piece_label) looks at those before it.
#pragma once

#include <string>
#include <vector>

#include "traces/replay/state.hpp"

namespace zstep {

/// By piece, what piece_label says of each.
std::vector<std::string> piece_labels(const Scene& scene, const MethodState& machine);

}  // namespace zstep
