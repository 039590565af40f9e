#include "algorithms/fast/half_space.hpp"

#include "algorithms/fast/simd.hpp"
#include "algorithms/half_space/half_space.hpp"

#if ZSTEP_HAS_LANES

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "algorithms/fast/bands.hpp"
#include "algorithms/half_space/triangles.hpp"
#include "traces/formulas/edge_functions.hpp"
#include "traces/formulas/samples.hpp"

namespace zstep::half_space {

namespace {

using namespace simd;
using z_buffer::FastOutline;
using z_buffer::Fill;
using z_buffer::RasterPoint;

/// E(x, y) = a (x - end_x) + b (y - end_y).
struct FastEdge {
  double a, b, end_x, end_y;
  bool owns;
};

struct FastTriangle {
  std::array<FastEdge, 3> edges;
  double twice_area, z_0, dz_1, dz_2;  ///< of the depths of vertices 1 and 2, what they are more than that of 0
  double reciprocal;                   ///< of twice_area, where E / twice_area may be computed by it; else 0
  std::int32_t first_column, first_row, end_column, end_row, polygon;
};

ZSTEP_INLINE FastEdge edge_of(const RasterPoint& from, const RasterPoint& to) {
  const bool first = formulas::is_first_end(from.x, from.y, to.x, to.y);
  const double a = from.y - to.y, b = to.x - from.x;
  return {a, b, first ? from.x : to.x, first ? from.y : to.y, formulas::owns_line(a, b)};
}

/// Is a number 0, or neither very small nor very large? Then no product, sum or quotient of a few such numbers loses
/// bits by being too small or too large.
ZSTEP_INLINE bool has_room(double value) {
  const double size = std::abs(value);
  return size == 0 || (size > 0x1p-200 && size < 0x1p200);
}
/// 1 / twice_area, where simd::quotient may be asked for E / twice_area, and for so many pixels that it pays. With
/// z_0 = -0 the sign of a weight that is 0 would show.
ZSTEP_INLINE double reciprocal_of(const FastTriangle& triangle) {
  constexpr std::int32_t wide = 64;
  if (triangle.end_column - triangle.first_column < wide) return 0;
  bool has = has_fma() && has_room(triangle.twice_area) && triangle.z_0 != 0;
  for (const FastEdge& edge : triangle.edges)
    has = has && has_room(edge.a) && has_room(edge.b) && has_room(edge.end_x) && has_room(edge.end_y);
  return has ? 1 / triangle.twice_area : 0;
}

/// False where it has no area.
ZSTEP_INLINE bool set_up(const RasterPoint* p, const RasterPoint* q, const RasterPoint* r, const Fill& fill,
                         std::int32_t polygon, FastTriangle& triangle) {
  triangle.twice_area = formulas::twice_area(p->x, p->y, q->x, q->y, r->x, r->y);
  if (triangle.twice_area < 0) {
    std::swap(q, r);
    triangle.twice_area = formulas::twice_area(p->x, p->y, q->x, q->y, r->x, r->y);
  }
  if (triangle.twice_area == 0) return false;
  triangle.edges = {edge_of(*q, *r), edge_of(*r, *p), edge_of(*p, *q)};
  triangle.z_0 = p->z, triangle.dz_1 = q->z - p->z, triangle.dz_2 = r->z - p->z;
  const Raster& raster = fill.all.scene.raster;
  triangle.first_column = formulas::box_first(std::min(std::min(p->x, q->x), r->x), raster.width);
  triangle.end_column = formulas::box_end(std::max(std::max(p->x, q->x), r->x), raster.width);
  triangle.first_row =
      std::max(fill.first_row, formulas::box_first(std::min(std::min(p->y, q->y), r->y), raster.height));
  triangle.end_row = std::min(fill.end_row, formulas::box_end(std::max(std::max(p->y, q->y), r->y), raster.height));
  triangle.polygon = polygon;
  triangle.reciprocal = reciprocal_of(triangle);
  return true;
}

/// Columns of a scan line: from first on some may be inside, from sure_first to before sure_end all are.
struct Columns {
  double first, sure_first, sure_end, end;
};

/// Of the box's columns on a scan line those that the lines of the edges leave, two more at each end; and those that
/// lie two columns inside of them.
ZSTEP_INLINE Columns columns_of(const FastTriangle& triangle, const std::array<double, 3>& of_row) {
  const double box_first = triangle.first_column, box_end = triangle.end_column;
  Columns columns{box_first, box_first, box_end, box_end};
  for (std::size_t i = 0; i < 3; ++i) {
    const FastEdge& edge = triangle.edges[i];
    if (edge.a == 0) {
      if (!formulas::is_on_side(of_row[i], edge.owns)) return {0, 0, 0, 0};
      continue;
    }
    const double x = std::floor(edge.end_x - of_row[i] / edge.a);
    if (edge.a > 0)
      columns.first = std::max(columns.first, x - 1), columns.sure_first = std::max(columns.sure_first, x + 3);
    else columns.end = std::min(columns.end, x + 3), columns.sure_end = std::min(columns.sure_end, x - 1);
  }
  columns.sure_first = std::min(columns.sure_first, box_end), columns.sure_end = std::max(columns.sure_end, box_first);
  return columns;
}

/// Takes out the pixels where E is not on the triangle's side of an edge.
ZSTEP_INLINE void keep_covered(const FastEdge& edge, const Doubles& e, Mask& inside) {
  if (edge.owns) inside &= e >= 0;
  else inside &= e > 0;
}

/// E / twice_area.
template <bool by_reciprocal>
ZSTEP_INLINE void weight_of(const FastTriangle& t, const Doubles& e, Doubles& weight) {
  if constexpr (by_reciprocal) quotient(e, t.twice_area - Doubles{}, t.reciprocal - Doubles{}, weight);
  else weight = e / t.twice_area;
}

/// Four pixels from column x on; all are inside, or each is asked.
template <bool all_inside, bool by_reciprocal>
ZSTEP_INLINE void fill_pixels(const FastTriangle& t, const std::array<double, 3>& of_row, const Doubles& x_s,
                              double end, double* depth, std::int32_t* frame) {
  const Doubles e_1 = t.edges[1].a * (x_s - t.edges[1].end_x) + of_row[1],
                e_2 = t.edges[2].a * (x_s - t.edges[2].end_x) + of_row[2];
  Mask inside = x_s < end;
  if constexpr (!all_inside) {
    const Doubles e_0 = t.edges[0].a * (x_s - t.edges[0].end_x) + of_row[0];
    keep_covered(t.edges[0], e_0, inside), keep_covered(t.edges[1], e_1, inside), keep_covered(t.edges[2], e_2, inside);
  }
  Doubles w_1, w_2;
  weight_of<by_reciprocal>(t, e_1, w_1), weight_of<by_reciprocal>(t, e_2, w_2);
  const Doubles z = t.z_0 + (w_1 * t.dz_1 + w_2 * t.dz_2);
  Doubles old_z;
  Ints old_polygon;
  load(old_z, depth), load(old_polygon, frame);
  const Mask nearer = all_inside ? z < old_z : inside & (z < old_z);
  store(depth, nearer ? z : old_z);
  store(frame, narrow(nearer) ? t.polygon - Ints{} : old_polygon);
}

ZSTEP_INLINE void fill_pixel(const FastTriangle& t, const std::array<double, 3>& of_row, std::int32_t x, double* depth,
                             std::int32_t* frame) {
  double e[3];
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = t.edges[i].a * (x - t.edges[i].end_x) + of_row[i];
    if (!formulas::is_on_side(e[i], t.edges[i].owns)) return;
  }
  const double z = t.z_0 + (e[1] / t.twice_area * t.dz_1 + e[2] / t.twice_area * t.dz_2);
  if (z < depth[x]) depth[x] = z, frame[x] = t.polygon;
}

/// Four by four while x is before a column, and there is room.
template <bool all_inside, bool by_reciprocal>
ZSTEP_INLINE void fill_row(const FastTriangle& t, const std::array<double, 3>& of_row, std::int32_t& x,
                           std::int32_t before, double end, std::ptrdiff_t room, double* depth, std::int32_t* frame) {
  Doubles x_s = x + each_lane;
  for (; x < before && x + four <= room; x += four, x_s += four)
    fill_pixels<all_inside, by_reciprocal>(t, of_row, x_s, end, depth + x, frame + x);
}

template <bool by_reciprocal>
ZSTEP_INLINE void fill_triangle(const FastTriangle& t, Fill& fill) {
  for (std::int32_t y = t.first_row; y < t.end_row; ++y) {
    std::array<double, 3> of_row;
    for (std::size_t i = 0; i < 3; ++i) of_row[i] = t.edges[i].b * (y - t.edges[i].end_y);
    const Columns columns = columns_of(t, of_row);
    if (!(columns.first < columns.end)) continue;
    const double to = columns.end;
    const auto end = static_cast<std::int32_t>(to), sure_first = static_cast<std::int32_t>(columns.sure_first),
               sure_end = static_cast<std::int32_t>(columns.sure_end);
    const std::size_t start = fill.picture.at(0, y);
    double* const depth = fill.picture.depth.data() + start;
    std::int32_t* const frame = fill.picture.polygon.data() + start;
    const std::ptrdiff_t room = fill.picture.at(0, fill.end_row) - start;
    auto x = static_cast<std::int32_t>(columns.first);
    fill_row<false, by_reciprocal>(t, of_row, x, std::min(sure_first, end), to, room, depth, frame);
    fill_row<true, by_reciprocal>(t, of_row, x, sure_end - four + 1, to, room, depth, frame);
    fill_row<false, by_reciprocal>(t, of_row, x, end, to, room, depth, frame);
    for (; x < end; ++x) fill_pixel(t, of_row, x, depth, frame);  // the last pixels of the band
  }
}

ZSTEP_INLINE void fill_band(Fill& fill) {
  clear_band(fill);
  for (const std::vector<FastOutline>& part : fill.all.parts)
    for (const FastOutline& outline : part) {
      if (outline.row >= fill.end_row || outline.end_row < fill.first_row) continue;
      const std::int32_t* const corners =
          (outline.clipped ? fill.all.made : fill.all.scene.corners).data() + outline.first;
      const RasterPoint* const points = fill.all.points.data();
      for (std::int32_t i = 1; i + 1 < outline.count; ++i) {
        FastTriangle triangle;
        if (!set_up(points + corners[0], points + corners[i], points + corners[i + 1], fill, outline.polygon, triangle))
          continue;
        if (triangle.reciprocal != 0) fill_triangle<true>(triangle, fill);
        else fill_triangle<false>(triangle, fill);
      }
    }
}
ZSTEP_FOR_THIS_PROCESSOR(fill_band, Fill)

/// Is each outline on these rows convex?
bool are_convex(const Fill& fill) {
  for (const std::vector<FastOutline>& part : fill.all.parts)
    for (const FastOutline& outline : part) {
      if (outline.row >= fill.end_row || outline.end_row < fill.first_row) continue;
      const std::int32_t* const corners =
          (outline.clipped ? fill.all.made : fill.all.scene.corners).data() + outline.first;
      if (!is_convex(static_cast<std::size_t>(outline.count),
                     [&](std::size_t i) -> const RasterPoint& { return fill.all.points[corners[i]]; }))
        return false;
    }
  return true;
}

}  // namespace

bool run_fast(const Scene& scene, const Conventions& conventions, Picture& picture, int threads) {
  const bool as_taught = interpolation::is_taught(conventions) &&
                         conventions.interpolation == Conventions::Interpolation::direct &&
                         choice_of<Stepping>(options, conventions, "stepping") == Stepping::products &&
                         formulas::reach_of(conventions) == 0;
  if (!as_taught) return false;
  std::atomic<bool> convex = true;
  z_buffer::draw_in_bands(scene, conventions, picture, threads, [&](Fill& fill) {
    if (!are_convex(fill)) convex = false;
    if (convex) fill_band_on_this_processor(fill);
  });
  return convex;
}

}  // namespace zstep::half_space

#else

bool zstep::half_space::run_fast(const Scene&, const Conventions&, Picture&, int) { return false; }

#endif
