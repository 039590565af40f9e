#include "sim/viewer/words/explain.hpp"

#include "sim/viewer/words/explain_parts.hpp"

namespace zstep {

std::string polygon_label(const Scene& scene, std::int32_t polygon) {
  if (polygon < 0) return "background";
  const auto at = static_cast<std::size_t>(polygon);
  if (at < scene.polygons.size() && !scene.polygons[at].name.empty()) return scene.polygons[at].name;
  return fmt::format("P{}", polygon);
}

std::string depth_symbol(const Scene& scene, const Conventions& conventions) {
  if (scene.camera.kind == Camera::Kind::screen) return "z";
  return conventions.depth == Conventions::Depth::view ? "z_v" : "z*";
}

std::optional<OnRaster> on_raster(const Scene& scene, const State& state, std::int32_t vertex) {
  const auto at = static_cast<std::size_t>(vertex);
  if (vertex < 0) return std::nullopt;
  if (scene.camera.kind == Camera::Kind::screen) {
    if (at >= scene.points.size()) return std::nullopt;
    return OnRaster{scene.points[at].x, scene.points[at].y, scene.points[at].z};
  }
  if (at >= state.vertices.size() || state.vertices[at].stage < VertexWay::on_raster) return std::nullopt;
  const VertexWay& way = state.vertices[at];
  return OnRaster{way.raster.x, way.raster.y, way.plane.z};
}

Explanation explain(const Trace& trace, const State& after, const RecordedEvent event) {
  words::Telling telling(trace, after);
  std::visit([&](const auto& e) { words::tell(telling, e); }, event.event);
  return std::move(telling.out);
}

}  // namespace zstep
