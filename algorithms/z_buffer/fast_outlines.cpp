#include "algorithms/z_buffer/fast_outlines.hpp"

#include "algorithms/lanes/lanes.hpp"

#if ZSTEP_HAS_LANES

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "algorithms/viewing/clip.hpp"
#include "traces/record/recorder.hpp"

namespace zstep::z_buffer {

namespace {

using namespace lanes;

constexpr std::int32_t unsound = 1 << 6;

struct Stage {
  const Scene& scene;
  const Conventions& conventions;
  viewing::Lens lens;
  bool orthographic;
  Outlines result;
  viewing::Vertices vertices;  // for the facets that find_outline looks at
  clipping::Outline outline;
};

ZSTEP_INLINE std::int32_t soundness(double x, double y, double z) {
  constexpr double limit = 1e9;  // as clip.cpp has it
  const bool sound = std::abs(x) <= limit && std::abs(y) <= limit && std::isfinite(z);
  return sound ? 0 : unsound;
}

// viewing/vertices.cpp with viewing/camera.cpp, for four points at a time.
ZSTEP_INLINE void view_points(Stage& stage) {
  const auto& from = stage.scene.points;
  const viewing::Lens lens = stage.lens;
  const glm::dmat4 view = stage.scene.camera.view;
  const bool view_z = lens.depth == Conventions::Depth::view;
  for (std::size_t first = 0; first < from.size(); first += four) {
    double xyz[3][four];
    for (std::size_t k = 0; k < four; ++k) {
      const glm::dvec3& point = from[std::min(first + k, from.size() - 1)];
      xyz[0][k] = point.x, xyz[1][k] = point.y, xyz[2][k] = point.z;
    }
    Doubles x, y, z;
    load(x, xyz[0]), load(y, xyz[1]), load(z, xyz[2]);
    // In the order of glm's product.
    const Doubles x_v = (view[0][0] * x + view[1][0] * y) + (view[2][0] * z + view[3][0]);
    const Doubles y_v = (view[0][1] * x + view[1][1] * y) + (view[2][1] * z + view[3][1]);
    const Doubles z_v = (view[0][2] * x + view[1][2] * y) + (view[2][2] * z + view[3][2]);
    Doubles x_c, y_c, w_c, x_p, y_p, depth;
    if (stage.orthographic) {
      x_c = x_v / lens.window_x, y_c = y_v / lens.window_y, w_c = 1 + Doubles{};
      x_p = x_v, y_p = y_v, depth = view_z ? z_v : 2 * (z_v - lens.near) / (lens.far - lens.near) - 1;
    } else {
      const Doubles x_d = lens.d * x_v, y_d = lens.d * y_v;
      x_c = x_d / lens.window_x, y_c = y_d / lens.window_y, w_c = z_v;
      x_p = x_d / z_v, y_p = y_d / z_v, depth = view_z ? z_v : lens.near * (lens.a * z_v + lens.b) / z_v;
    }
    const Doubles x_s = (x_p + lens.window_x) / (2 * lens.window_x) * lens.width - 0.5;
    const Doubles y_s = (lens.window_y - y_p) / (2 * lens.window_y) * lens.height - 0.5;
    const Mask outside = (~(z_v - lens.near >= 0) & 1) | (~(lens.far - z_v >= 0) & 2) | (~(w_c + x_c >= 0) & 4) |
                         (~(w_c - x_c >= 0) & 8) | (~(w_c + y_c >= 0) & 16) | (~(w_c - y_c >= 0) & 32);
    for (std::size_t k = 0; k < four && first + k < from.size(); ++k) {
      const auto code = static_cast<std::int32_t>(outside[k]);
      stage.result.points[first + k] = {x_s[k], y_s[k], depth[k], code | soundness(x_s[k], y_s[k], depth[k])};
    }
  }
}

enum class Seen { yes, no, unclear };

// degenerate() and test_facing() of viewing/back_face.cpp where the margin is wide: a sine above 1e-10 where they ask
// for 1e-12, an area above 1e-10 of the extent's square where they ask for 1e-14. So no square root is needed.
ZSTEP_INLINE Seen test_facet(const Stage& stage, clipping::Corners corners) {
  const glm::dvec3* const points = stage.scene.points.data();
  const glm::dvec3 origin = points[corners[0]];
  glm::dvec3 normal(0), along = points[corners[1]] - origin;
  double extent = glm::dot(along, along);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const glm::dvec3 next = points[corners[i]] - origin;
    normal += glm::cross(along, next);
    extent = std::max(extent, glm::dot(next, next));
    along = next;
  }
  const glm::dvec3 sight = stage.orthographic ? -stage.scene.camera.eye : origin - stage.scene.camera.eye;
  const double area = glm::dot(normal, normal), away = glm::dot(sight, normal);
  const bool clear = away * away > 1e-20 * glm::dot(sight, sight) * area && area > 1e-20 * extent * extent &&
                     area > 1e-290 && area < 1e290;
  if (!clear) return Seen::unclear;
  return away > 0 && stage.conventions.cull ? Seen::no : Seen::yes;
}

// The taught way, for one facet.
void find_slowly(Stage& stage, const Facet& facet) {
  NullRecorder record;
  const std::size_t points = stage.scene.points.size();
  stage.vertices.resize(points);
  for (std::int32_t i = 0; i < facet.corner_count; ++i) {
    const auto n = static_cast<std::size_t>(stage.scene.corners[static_cast<std::size_t>(facet.first_corner + i)]);
    const RasterPoint& point = stage.result.points[n];
    const glm::dvec3 view(stage.scene.camera.view * glm::dvec4(stage.scene.points[n], 1));
    stage.vertices[n] = {view, {point.x, point.y, point.z}, point.outside & ~unsound};
  }
  const bool cull = stage.conventions.cull;
  if (!clipping::find_outline(stage.scene, facet, cull, stage.lens, stage.vertices, stage.outline, record)) return;

  auto& [all, made, outlines] = stage.result;
  const auto first = static_cast<std::int32_t>(made.size()), before = static_cast<std::int32_t>(all.size() - points);
  outlines.push_back({facet.polygon, first, static_cast<std::int32_t>(stage.outline.size()), true});
  for (const std::int32_t index : stage.outline) {
    made.push_back(static_cast<std::size_t>(index) < points ? index : index + before);
  }
  for (std::size_t i = points; i < stage.vertices.size(); ++i) {
    const glm::dvec3 raster = stage.vertices[i].raster;
    all.push_back({raster.x, raster.y, raster.z, 0});
  }
}

ZSTEP_INLINE void find(Stage& stage) {
  const Scene& scene = stage.scene;
  const bool screen = scene.camera.kind == Camera::Kind::screen;
  Outlines& result = stage.result;
  if (screen) {
    std::transform(scene.points.begin(), scene.points.end(), result.points.begin(), [](const glm::dvec3& p) {
      return RasterPoint{p.x, p.y, p.z, soundness(p.x, p.y, p.z)};
    });
  } else {
    view_points(stage);
  }
  for (const Facet& facet : scene.facets) {
    if (facet.corner_count < 3) continue;
    const clipping::Corners corners(scene.corners.data() + facet.first_corner,
                                    static_cast<std::size_t>(facet.corner_count));
    std::int32_t outside_some = 0, outside_all = unsound - 1;
    for (const std::int32_t corner : corners) {
      const std::int32_t outside = result.points[static_cast<std::size_t>(corner)].outside;
      outside_some |= outside, outside_all &= outside;
    }
    if (outside_all != 0) continue;
    const Seen seen = screen ? Seen::yes : test_facet(stage, corners);
    if (seen == Seen::no) continue;
    if (seen == Seen::unclear || outside_some != 0) {
      find_slowly(stage, facet);
    } else {
      result.outlines.push_back({facet.polygon, facet.first_corner, facet.corner_count, false});
    }
  }
}

ZSTEP_FOR_THIS_PROCESSOR(find, Stage)

}  // namespace

Outlines find_outlines(const Scene& scene, const Conventions& conventions) {
  Stage stage{scene,
              conventions,
              viewing::Lens(scene.camera, scene.raster, conventions.depth),
              scene.camera.kind == Camera::Kind::orthographic,
              {},
              {},
              {}};
  stage.result.points.resize(scene.points.size());
  stage.result.outlines.reserve(scene.facets.size());
  find_on_this_processor(stage);
  return std::move(stage.result);
}

}  // namespace zstep::z_buffer

#endif
