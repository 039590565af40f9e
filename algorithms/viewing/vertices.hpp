// The way of vertices from the world to the raster.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/viewing/camera.hpp"
#include "traces/record/recorder.hpp"

// The steps of viewing, and of culling and clipping one polygon.

#define ZSTEP_MODULE viewing
#define ZSTEP_FIRST_STEP 1
#define ZSTEP_STEPS "algorithms/viewing/steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE clipping
#define ZSTEP_FIRST_STEP 8
#define ZSTEP_STEPS "algorithms/viewing/clipping_steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::viewing {

/// A vertex on its way.
struct Vertex {
  glm::dvec3 view{0};        ///< (x_v, y_v, z_v); unused in screen scenes
  glm::dvec3 raster{0};      ///< (x_s, y_s) and the depth that is interpolated; meaningful once it was projected
  std::int32_t outside = 0;  ///< outcode: bit k is set if it lies outside plane k of ClipPlane
};

/// The scene's points by index, then those that clipping makes for the facet at work.
using Vertices = std::vector<Vertex>;

/// Signed distance of a point of view space from a plane of the view volume, up to a positive factor; not negative is
/// inside, and NaN is outside.
double distance_inside(const Lens& lens, glm::dvec3 view, ClipPlane plane);

/// Every point of the scene: world to view, and on to the raster if it lies on or beyond the near plane. A screen
/// scene's points are on the raster already: nothing happens to them and nothing is recorded.
template <Recorder R>
Vertices view_vertices(const Scene& scene, const Lens& lens, R& record);

/// The same for those of these points of the camera's world that have no vertex yet; their vertices are put behind the
/// others.
template <Recorder R>
void view_points(const Camera& camera, std::span<const glm::dvec3> points, const Lens& lens, Vertices& vertices,
                 R& record);

/// One vertex from view space to the raster. It must lie on or beyond the near plane.
template <Recorder R>
void project_vertex(const Lens& lens, std::int32_t index, Vertex& vertex, R& record);

}  // namespace zstep::viewing
