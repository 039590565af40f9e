#include "algorithms/fast/z_buffer_outlines.hpp"

#include "algorithms/fast/simd.hpp"

#if ZSTEP_HAS_LANES

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "algorithms/viewing/clip.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::z_buffer {

namespace {

using namespace simd;

constexpr std::int32_t unsound = 1 << 6;

struct Stage {
  Outlines& all;
  std::size_t part;
  const Scene& scene = all.scene;
  viewing::Lens lens{scene.camera, scene.raster, all.conventions.depth};
  bool orthographic = scene.camera.kind == Camera::Kind::orthographic;
};

// Of an outline that finish() is to look at: its facet's number stands in `first`.
constexpr std::int32_t wants_a_look = -1;

ZSTEP_INLINE std::int32_t soundness(double x, double y, double z) {
  constexpr double limit = 1e9;  // as clip.cpp has it
  const bool sound = std::abs(x) <= limit && std::abs(y) <= limit && std::isfinite(z);
  return sound ? 0 : unsound;
}

// viewing/vertices.cpp with viewing/camera.cpp, for four points at a time.
ZSTEP_INLINE void view_points(Stage& stage) {
  const auto& from = stage.scene.points;
  const Range range = part_of(from.size(), stage.part, stage.all.parts.size(), four);
  const viewing::Lens lens = stage.lens;
  const glm::dmat4 view = stage.scene.camera.view;
  const bool view_z = lens.scale.depth == Conventions::Depth::view;
  for (std::size_t first = range.first; first < range.end; first += four) {
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
    const double seen_at = lens.raster.corners ? 0 : 0.5;
    Doubles x_s = (x_p + lens.window_x) / (2 * lens.window_x) * lens.width - seen_at;
    const Doubles from_edge = lens.raster.y_up ? y_p + lens.window_y : lens.window_y - y_p;
    Doubles y_s = from_edge / (2 * lens.window_y) * lens.height - seen_at;
    if (lens.raster.corners)
      for (Doubles* s : {&x_s, &y_s})
        *s = ((*s < viewing::border_width) & (*s > -viewing::border_width)) ? Doubles{} : *s;
    const Mask outside = (~(z_v - lens.near >= 0) & 1) | (~(lens.far - z_v >= 0) & 2) | (~(w_c + x_c >= 0) & 4) |
                         (~(w_c - x_c >= 0) & 8) | (~(w_c + y_c >= 0) & 16) | (~(w_c - y_c >= 0) & 32);
    for (std::size_t k = 0; k < four && first + k < range.end; ++k) {
      const auto code = static_cast<std::int32_t>(outside[k]);
      stage.all.points[first + k] = {x_s[k], y_s[k], depth[k], code | soundness(x_s[k], y_s[k], depth[k])};
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
  return away > 0 && stage.all.conventions.cull ? Seen::no : Seen::yes;
}

// The first row at or below y, limited to the raster.
ZSTEP_INLINE std::int32_t row_from(double y, std::int32_t height) {
  if (!(y > 0)) return 0;
  if (y >= height) return height;
  const auto row = static_cast<std::int32_t>(y);
  return row + (row < y);
}

void view_screen_points(Stage& stage) {
  const auto& from = stage.scene.points;
  const Range range = part_of(from.size(), stage.part, stage.all.parts.size(), four);
  for (std::size_t i = range.first; i < range.end; ++i) {
    const glm::dvec3& p = from[i];
    stage.all.points[i] = {p.x, p.y, p.z, soundness(p.x, p.y, p.z)};
  }
}

ZSTEP_INLINE void find_facets(Stage& stage) {
  const Scene& scene = stage.scene;
  const bool screen = scene.camera.kind == Camera::Kind::screen;
  const RasterPoint* const points = stage.all.points.data();
  std::vector<FastOutline>& found = stage.all.parts[stage.part];
  const Range range = part_of(scene.facets.size(), stage.part, stage.all.parts.size(), 1);
  found.reserve(range.end - range.first);
  for (std::size_t number = range.first; number < range.end; ++number) {
    const Facet& facet = scene.facets[number];
    if (facet.corner_count < 3) continue;
    const clipping::Corners corners(scene.corners.data() + facet.first_corner,
                                    static_cast<std::size_t>(facet.corner_count));
    std::int32_t outside_some = 0, outside_all = unsound - 1;
    double top = points[corners[0]].y, low = top;
    for (const std::int32_t corner : corners) {
      const RasterPoint& point = points[corner];
      outside_some |= point.outside, outside_all &= point.outside;
      top = std::min(top, point.y), low = std::max(low, point.y);
    }
    if (outside_all != 0) continue;
    const Seen seen = screen ? Seen::yes : test_facet(stage, corners);
    if (seen == Seen::no) continue;
    if (seen == Seen::unclear || outside_some != 0) {
      found.push_back({facet.polygon, index32(number), wants_a_look, false, 0, 0});
    } else {
      const std::int32_t row = row_from(top, scene.raster.height), end_row = row_from(low, scene.raster.height);
      if (row < end_row) found.push_back({facet.polygon, facet.first_corner, facet.corner_count, false, row, end_row});
    }
  }
}

ZSTEP_FOR_THIS_PROCESSOR(view_points, Stage)
ZSTEP_FOR_THIS_PROCESSOR(find_facets, Stage)

// The taught way, for one facet. False if it is not to be drawn.
bool look_closely(Outlines& all, const viewing::Lens& lens, viewing::Vertices& vertices, FastOutline& outline) {
  const Scene& scene = all.scene;
  const Facet& facet = scene.facets[outline.first];
  NullRecorder record;
  const std::size_t points = scene.points.size();
  vertices.resize(points);
  for (std::int32_t i = 0; i < facet.corner_count; ++i) {
    const std::size_t n = scene.corners[facet.first_corner + i];
    const RasterPoint& point = all.points[n];
    const glm::dvec3 view(scene.camera.view * glm::dvec4(scene.points[n], 1));
    vertices[n] = {view, {point.x, point.y, point.z}, point.outside & ~unsound};
  }
  clipping::Outline clipped;
  if (!clipping::find_outline(scene, facet, all.conventions.cull, lens, vertices, clipped, record)) return false;

  const auto before = static_cast<std::int32_t>(all.points.size() - points);
  outline.first = size32(all.made);
  outline.count = size32(clipped);
  outline.clipped = true;
  double top = std::numeric_limits<double>::infinity(), low = -top;
  for (const std::int32_t index : clipped) {
    all.made.push_back(static_cast<std::size_t>(index) < points ? index : index + before);
    const double y = vertices[index].raster.y;
    top = std::min(top, y), low = std::max(low, y);
  }
  for (std::size_t i = points; i < vertices.size(); ++i) {
    const glm::dvec3 raster = vertices[i].raster;
    all.points.push_back({raster.x, raster.y, raster.z, 0});
  }
  outline.row = row_from(top, scene.raster.height), outline.end_row = row_from(low, scene.raster.height);
  return true;
}

}  // namespace

Range part_of(std::size_t count, std::size_t k, std::size_t parts, std::size_t step) {
  const std::size_t each = (count / step + parts) / parts * step;
  return {std::min(count, k * each), std::min(count, (k + 1) * each)};
}

Outlines::Outlines(const Scene& scene_, const Conventions& conventions_, std::size_t parts_)
    : scene(scene_), conventions(conventions_), points(scene_.points.size()), parts(parts_) {}

void Outlines::view(std::size_t part) {
  Stage stage{*this, part};
  if (scene.camera.kind == Camera::Kind::screen) view_screen_points(stage);
  else view_points_on_this_processor(stage);
}

void Outlines::find(std::size_t part) {
  Stage stage{*this, part};
  find_facets_on_this_processor(stage);
}

void Outlines::finish() {
  const viewing::Lens lens(scene.camera, scene.raster, conventions.depth);
  viewing::Vertices vertices;
  for (std::vector<FastOutline>& part : parts) {
    std::size_t kept = 0;
    for (FastOutline outline : part) {
      const bool drawn = outline.count != wants_a_look || look_closely(*this, lens, vertices, outline);
      if (drawn) part[kept++] = outline;
    }
    part.resize(kept);
  }
}

}  // namespace zstep::z_buffer

#endif
