#include "sim/words/pieces.hpp"

namespace zstep {

std::optional<glm::dvec3> cutting_point(const Scene& scene, const State& state, std::int32_t vertex) {
  const auto at = static_cast<std::size_t>(vertex);
  if (vertex < 0) return std::nullopt;
  if (!state.machine.tree.empty() && scene.camera.kind != Camera::Kind::screen) {
    if (at < scene.points.size()) return scene.points[at];
    if (at < state.vertices.size()) return state.vertices[at].world;
    return std::nullopt;
  }
  if (scene.camera.kind == Camera::Kind::screen && at < scene.points.size()) return scene.points[at];
  if (at >= state.vertices.size() || state.vertices[at].stage < VertexStages::on_raster) return std::nullopt;
  const VertexStages& way = state.vertices[at];
  return glm::dvec3(way.raster, way.plane.z);
}

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
