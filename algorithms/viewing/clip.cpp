#include "algorithms/viewing/clip.hpp"

#include <cmath>

#include "traces/formulas/outlines.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::clipping {

namespace {

using viewing::Lens;
using viewing::Vertex;
using viewing::Vertices;

const Vertex& vertex_at(const Vertices& vertices, std::int32_t index) { return vertices[index]; }

// The point at which the edge from a vertex inside to one outside meets the plane. It is always computed from the
// inside end, so that two polygons that share the edge get the same bits, whichever way round they run along it.
template <Recorder R>
std::int32_t cross(const Lens& lens, ClipPlane plane, std::int32_t inside, std::int32_t outside, Vertices& vertices,
                   R& record) {
  const glm::dvec3 from = vertex_at(vertices, inside).view, to = vertex_at(vertices, outside).view;
  const double d_in = viewing::distance_inside(lens, from, plane), d_out = viewing::distance_inside(lens, to, plane);
  const double t = formulas::where_zero(d_in, d_out);
  const glm::dvec3 view = formulas::part_of_way(from, to, t);

  const auto made = size32(vertices);
  record(step::clip_cross, ClipCross{plane, inside, outside, t, made, view.x, view.y, view.z});
  vertices.push_back({view, {}, 0});
  return made;
}

// Sutherland and Hodgman: what of the polygon lies inside one plane.
template <Recorder R>
Outline clip_against(const Lens& lens, ClipPlane plane, const Outline& polygon, Vertices& vertices, R& record) {
  Outline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::int32_t here = polygon[i], next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double distance = viewing::distance_inside(lens, vertex_at(vertices, here).view, plane);
    const double distance_next = viewing::distance_inside(lens, vertex_at(vertices, next).view, plane);

    const bool inside = distance >= 0;
    record(step::clip_vertex, ClipVertex{plane, here, distance, inside});
    if (inside) kept.push_back(here);

    // A vertex on the plane itself is the crossing already.
    if (distance > 0 && distance_next < 0) kept.push_back(cross(lens, plane, here, next, vertices, record));
    if (distance < 0 && distance_next > 0) kept.push_back(cross(lens, plane, next, here, vertices, record));
  }
  return kept;
}

bool on_raster(const Vertices& vertices, const Outline& outline) {
  constexpr double limit = 1e9;  // pixels; beyond, differences of coordinates lose whole pixels
  if (outline.size() < 3) return false;
  for (const std::int32_t index : outline) {
    const glm::dvec3 raster = vertex_at(vertices, index).raster;
    const bool sound = std::abs(raster.x) <= limit && std::abs(raster.y) <= limit && std::isfinite(raster.z);
    if (!sound) return false;
  }
  return true;
}

template <Recorder R>
bool reject(std::int32_t polygon, Reject reason, R& record) {
  record(step::reject, PolygonReject{polygon, reason});
  return false;
}

// Outcodes and the six planes, for an outline in space.
template <Recorder R>
bool clip(std::int32_t polygon, const Lens& lens, Vertices& vertices, Outline& outline, R& record) {
  std::int32_t outside_some = 0, outside_all = (1 << value_count<ClipPlane>)-1;
  for (const std::int32_t corner : outline) {
    outside_some |= vertex_at(vertices, corner).outside;
    outside_all &= vertex_at(vertices, corner).outside;
  }
  record(step::clip_test, ClipTest{outside_some, outside_all});
  if (outside_all != 0) return reject(polygon, Reject::outside, record);
  if (outside_some == 0) return true;

  const std::size_t known = vertices.size();
  for (const ClipPlane plane : values_of<ClipPlane>) {
    const bool crossed = (outside_some >> index_of(plane) & 1) != 0;
    if (crossed) outline = clip_against(lens, plane, outline, vertices, record);
  }
  if (outline.size() < 3) return reject(polygon, Reject::outside, record);

  for (const std::int32_t index : outline) {
    const std::size_t i = index;
    if (i >= known) viewing::project_vertex(lens, index, vertices[i], record);
  }
  return true;
}

}  // namespace

template <Recorder R>
bool clip_outline(std::int32_t polygon, Camera::Kind kind, const Lens& lens, Vertices& vertices, Outline& outline,
                  R& record) {
  if (kind != Camera::Kind::screen && !clip(polygon, lens, vertices, outline, record)) return false;
  if (!on_raster(vertices, outline)) return reject(polygon, Reject::degenerate, record);

  for (const std::int32_t index : outline) {
    record(step::outline, OutlineVertex{index});
  }
  return true;
}

template <Recorder R>
bool find_outline(const Scene& scene, const Facet& facet, bool cull, const Lens& lens, Vertices& vertices,
                  Outline& outline, R& record) {
  const auto corners = scene.corners.begin() + facet.first_corner;
  outline.assign(corners, corners + facet.corner_count);

  if (scene.camera.kind != Camera::Kind::screen) {
    if (degenerate(scene, outline)) return reject(facet.polygon, Reject::degenerate, record);
    const Facing facing = test_facing(scene, outline, vertices, record);
    if (facing == Facing::edge_on) return reject(facet.polygon, Reject::edge_on, record);
    if (facing == Facing::back && cull) return reject(facet.polygon, Reject::back_facing, record);
  }
  return clip_outline(facet.polygon, scene.camera.kind, lens, vertices, outline, record);
}

#define INSTANTIATE(R)                                                                             \
  template bool clip_outline<R>(std::int32_t, Camera::Kind, const Lens&, Vertices&, Outline&, R&); \
  template bool find_outline<R>(const Scene&, const Facet&, bool, const viewing::Lens&, Vertices&, Outline&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::clipping
