#include "sim/words/pieces.hpp"

namespace zstep {

const PlaneEquation* plane_of_node(const MethodState& machine, std::int32_t node) {
  if (node < 0 || static_cast<std::size_t>(node) >= machine.tree.size()) return nullptr;
  const TreeNode& at = machine.tree[static_cast<std::size_t>(node)];
  if (at.pieces.empty() || at.pieces[0] < 0 || static_cast<std::size_t>(at.pieces[0]) >= machine.pieces.size())
    return nullptr;
  const auto& plane = machine.pieces[static_cast<std::size_t>(at.pieces[0])].plane;
  return plane ? &*plane : nullptr;
}

std::int32_t node_of_piece(const MethodState& machine, std::int32_t piece) {
  for (std::size_t node = 0; node < machine.tree.size(); ++node)
    for (const std::int32_t one : machine.tree[node].pieces)
      if (one == piece) return static_cast<std::int32_t>(node);
  return -1;
}

std::int32_t node_at_work(const MethodState& machine, const Event* event) {
  if (event)
    if (const auto* skip = get_if<NodeSkip>(event)) return skip->node;
  if (machine.piece >= 0 && !(event && holds<EyeSide>(*event))) {
    const std::int32_t node = node_of_piece(machine, machine.piece);
    if (node >= 0) return node;
  }
  return machine.node;
}

}  // namespace zstep
