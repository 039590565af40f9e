#include "traces/formulas/situation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "traces/formulas/edge_functions.hpp"

namespace zstep::formulas {

namespace {

/// How many scan lines of the raster a facet spans.
std::int64_t lines_of(const DrawnFacet& facet, const Raster& raster) {
  double top = raster.height, bottom = 0;
  for (const DrawnCorner& corner : facet.outline()) top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);
  return static_cast<std::int64_t>(std::clamp<double>(bottom - std::max(top, 0.0), 0, raster.height)) + 1;
}

}  // namespace

Situation::TriangleNow Situation::find_triangle() const {
  TriangleNow found;
  const TriangleWork& work = method().triangle;
  for (std::size_t i = 0; i < std::min(work.edges.size(), found.ends.size()); ++i) {
    const EdgeFunction& edge = work.edges[i];
    const auto from = on_raster(edge.vertex_0), to = on_raster(edge.vertex_1);
    if (!from || !to) continue;
    if (is_first_end(from->x, from->y, to->x, to->y)) found.ends[i] = {edge.vertex_0, from->x, from->y};
    else found.ends[i] = {edge.vertex_1, to->x, to->y};
  }
  if (!work.setup) return found;
  found.vertices = {work.setup->vertex_0, work.setup->vertex_1, work.setup->vertex_2};
  std::array<double, 3> depths{};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const auto at = on_raster(found.vertices[i]);
    if (!at || !has_depth(found.vertices[i])) return found;
    depths[i] = at->z;
  }
  found.depths = depths;
  return found;
}

std::optional<DrawnFacet> Situation::draw_facet() const {
  const MethodState& now = method();
  const std::size_t number = now.facet;
  if (now.facet < 0 || number >= scene.facets.size() || scene.facets[number].polygon != now.polygon)
    return std::nullopt;
  if (now.keeps_all || now.piece >= 0 || ahead.of_all || camera != &scene.camera) return std::nullopt;
  const NumberFormat format = header.conventions.number_format;
  if (!on_screen() && !header.declares(Convention::depth)) return std::nullopt;
  // In fixed point what a run computes from is judged, where it has that.
  const bool has_operands = records<SpanBegin>() || now.slopes;
  if (bits_of(format) > 0 ? has_operands : is_fixed) return std::nullopt;
  // A run of few steps may begin large facets again and again.
  if (drawn_now.spent > 64 * before.position + 20'000'000) return std::nullopt;
  const double u = roundoff > 0 ? roundoff : format == NumberFormat::float32 ? 0x1p-24 : 0x1p-53;
  const auto by_scene = DrawnFacet::from_scene(scene, header, now.facet, u);
  if (by_scene) drawn_now.spent += lines_of(*by_scene, scene.raster) * std::ssize(by_scene->outline());
  if (on_screen() || !by_scene || !records<ViewportTransform>()) return by_scene;
  // A camera at fault is told where it is; what follows goes by the vertices that it gave.
  std::vector<std::int32_t> vertices = now.outline;
  if (vertices.empty())
    for (const DrawnCorner& corner : by_scene->outline()) vertices.push_back(corner.vertex);
  std::vector<DrawnCorner> outline;
  for (const std::int32_t vertex : vertices) {
    const auto at = on_raster(vertex);
    if (!at || !has_depth(vertex)) return by_scene;
    const auto off = [&](double value) { return written * std::abs(value) + written_off; };
    outline.push_back({vertex, at->x, at->y, at->z, off(at->x), off(at->y), off(at->z)});
  }
  auto by_run = DrawnFacet::from_run(scene, header, std::move(outline), u);
  if (by_run) by_run->faces_as(*by_scene);
  return by_run;
}

}  // namespace zstep::formulas
