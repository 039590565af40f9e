
#include "algorithms/viewing/vertices.hpp"

#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::viewing {

double distance_inside(const Lens& lens, glm::dvec3 view, ClipPlane plane) {
  // -w_c <= z_c <= w_c is near <= z_v <= far times a positive factor; so written it is exact for a face on the plane
  // itself.
  if (plane == ClipPlane::near) return view.z - lens.near;
  if (plane == ClipPlane::far) return lens.far - view.z;
  const glm::dvec4 clip = lens.clip_coordinates(view);
  switch (plane) {
    case ClipPlane::left:
      return clip.w + clip.x;
    case ClipPlane::right:
      return clip.w - clip.x;
    case ClipPlane::bottom:
      return clip.w + clip.y;
    default:
      return clip.w - clip.y;
  }
}

namespace {

std::int32_t outcode(const Lens& lens, glm::dvec3 view) {
  std::int32_t outside = 0;
  for (const ClipPlane plane : values_of<ClipPlane>) {
    const bool inside = distance_inside(lens, view, plane) >= 0;
    outside |= static_cast<std::int32_t>(!inside) << index_of(plane);
  }
  return outside;
}

}  // namespace

template <Recorder R>
void project_vertex(const Lens& lens, std::int32_t index, Vertex& vertex, R& record) {
  const glm::dvec3 plane = lens.project(vertex.view);
  record(step::project, Projection{index, plane.x, plane.y, plane.z});

  const glm::dvec2 raster = lens.to_viewport(plane.x, plane.y);
  record(step::to_viewport, ViewportTransform{index, raster.x, raster.y});

  vertex.raster = {raster.x, raster.y, plane.z};
}

template <Recorder R>
void view_points(const Camera& camera, std::span<const glm::dvec3> points, const Lens& lens, Vertices& vertices,
                 R& record) {
  const std::size_t known = vertices.size();
  vertices.resize(points.size());
  for (std::size_t i = known; i < points.size(); ++i) {
    const auto index = index32(i);
    Vertex& vertex = vertices[i];
    if (camera.kind == Camera::Kind::screen) {
      vertex.raster = points[i];
      continue;
    }
    vertex.view = glm::dvec3(camera.view * glm::dvec4(points[i], 1));
    record(step::view_vertex, ViewTransform{index, vertex.view.x, vertex.view.y, vertex.view.z});

    vertex.outside = outcode(lens, vertex.view);
    if (vertex.view.z >= lens.near) project_vertex(lens, index, vertex, record);
  }
}

template <Recorder R>
Vertices view_vertices(const Scene& scene, const Lens& lens, R& record) {
  Vertices vertices;
  view_points(scene.camera, scene.points, lens, vertices, record);
  return vertices;
}

#define INSTANTIATE(R)                                                                                  \
  template void project_vertex<R>(const Lens&, std::int32_t, Vertex&, R&);                              \
  template void view_points<R>(const Camera&, std::span<const glm::dvec3>, const Lens&, Vertices&, R&); \
  template Vertices view_vertices<R>(const Scene&, const Lens&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::viewing
