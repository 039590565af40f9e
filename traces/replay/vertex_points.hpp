// Where the vertices of a state are.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "traces/replay/state.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// On the raster, and how deep; whether it came through a camera or was given in screen coordinates.
struct OnRaster {
  double x = 0, y = 0, z = 0;
};
inline std::optional<OnRaster> on_raster(const Scene& scene, const State& state, std::int32_t vertex) {
  const auto at = static_cast<std::size_t>(vertex);
  if (vertex < 0) return std::nullopt;
  if (scene.camera.kind == Camera::Kind::screen && at < scene.points.size())
    return OnRaster{scene.points[at].x, scene.points[at].y, scene.points[at].z};
  if (at >= state.vertices.size() || state.vertices[at].stage < VertexStages::on_raster) return std::nullopt;
  const VertexStages& stages = state.vertices[at];
  return OnRaster{stages.raster.x, stages.raster.y, stages.plane.z};
}

/// Are pieces cut in the world, as those of a tree are, and not on the raster with its depth?
inline bool cuts_in_world(const Scene& scene, const MethodState& method) {
  return !method.tree.empty() && scene.camera.kind != Camera::Kind::screen;
}
/// In the space in which pieces are cut.
inline std::optional<glm::dvec3> cutting_point(const Scene& scene, const State& state, std::int32_t vertex) {
  const auto at = static_cast<std::size_t>(vertex);
  if (vertex >= 0 && cuts_in_world(scene, state.machine)) {
    if (at < scene.points.size()) return scene.points[at];
    return at < state.vertices.size() ? std::optional(state.vertices[at].world) : std::nullopt;
  }
  const auto found = on_raster(scene, state, vertex);
  return found ? std::optional(glm::dvec3(found->x, found->y, found->z)) : std::nullopt;
}

}  // namespace zstep
