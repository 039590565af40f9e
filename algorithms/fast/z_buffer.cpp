#include "algorithms/fast/z_buffer.hpp"

#include "algorithms/fast/simd.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"

#if ZSTEP_HAS_LANES

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/fast/bands.hpp"
#include "algorithms/scan_conversion/spans.hpp"

namespace zstep::z_buffer {

namespace {

using namespace simd;

// An edge, from its end with the smaller y to its end with the larger.
struct FastEdge {
  double x, y, z, dx, dy, dz, end_y;
};
constexpr std::int32_t most_edges = 16;  // of an outline that is filled without tables

// The spans of four scan lines, from `row` on. Where a row meets no pixel, first and end are equal.
struct FourSpans {
  std::int32_t row;
  Doubles x, z, dx, dz, first, end;
};

// Four pixels from column `first` on: z–x interpolation (000) as depth_on has it, and the compare.
ZSTEP_INLINE void fill_pixels(double x, double z, double dx, double dz, double first, double end, double* depth,
                              std::int32_t* frame, std::int32_t polygon) {
  const Doubles x_s = first + each_lane, z_s = z + dz * (x_s - x) / dx;
  Doubles old_z;
  Ints old_polygon;
  load(old_z, depth), load(old_polygon, frame);
  const Mask nearer = (z_s < old_z) & (x_s < end);
  store(depth, nearer ? z_s : old_z);
  store(frame, narrow(nearer) ? polygon - Ints{} : old_polygon);
}

// One span of any length.
ZSTEP_INLINE void fill_span(double x_left, double z_left, double dx, double dz, std::int32_t first, std::int32_t end,
                            std::int32_t row, std::int32_t polygon, std::int32_t band_end, Picture& picture) {
  const std::size_t start = picture.at(0, row);
  double* const depth = picture.depth.data() + start;
  std::int32_t* const frame = picture.polygon.data() + start;
  const std::ptrdiff_t room = picture.at(0, band_end) - start;
  std::int32_t x = first;
  for (; x < end && x + four <= room; x += four) {
    fill_pixels(x_left, z_left, dx, dz, x, end, depth + x, frame + x, polygon);
  }
  for (; x < end; ++x) {  // the last pixels of the band
    const double z = z_left + dz * (x - x_left) / dx;
    if (z < depth[x]) depth[x] = z, frame[x] = polygon;
  }
}

// Four spans of `most` pixels at most. No branch depends on the spans: a processor would guess most of them wrong.
ZSTEP_INLINE void fill_short_spans(const FourSpans& spans, int most, std::int32_t polygon, Picture& picture) {
  std::int32_t first[four];
  store(first, __builtin_convertvector(spans.first, Ints));
  double* depth = picture.depth.data() + picture.at(0, spans.row);
  std::int32_t* frame = picture.polygon.data() + picture.at(0, spans.row);
  for (int k = 0; k < four; ++k, depth += picture.width, frame += picture.width) {
    for (int more = 0; more < most; more += four) {
      fill_pixels(spans.x[k], spans.z[k], spans.dx[k], spans.dz[k], spans.first[k] + more, spans.end[k],
                  depth + first[k] + more, frame + first[k] + more, polygon);
    }
  }
}

// x–y and z–y interpolation (000), as Edge::x_at and z_at have it, of every edge on four rows. A row that meets two has
// its span between them. False if one meets more.
ZSTEP_INLINE bool find_spans(const FastEdge* edges, int count, std::int32_t row, std::int32_t columns,
                             FourSpans& spans) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Doubles row_s = row + each_lane;
  Doubles x_left = infinity - Doubles{}, x_right = -x_left, z_left{}, z_right{};
  Mask met{};
  for (int i = 0; i < count; ++i) {
    const FastEdge& edge = edges[i];
    const Mask here = (row_s >= edge.y) & (row_s < edge.end_y);
    const Doubles x = edge.x + edge.dx * (row_s - edge.y) / edge.dy;
    const Doubles z = edge.z + edge.dz * (row_s - edge.y) / edge.dy;
    const Mask left = here & (x < x_left), right = here & (x > x_right);
    x_left = left ? x : x_left, z_left = left ? z : z_left;
    x_right = right ? x : x_right, z_right = right ? z : z_right;
    met -= here;
  }
  if (any(met > 2)) return false;

  Doubles first = x_left, end = x_right;
  round_up(first), round_up(end);
  first = first > 0 ? first : Doubles{};
  end = end < columns ? end : columns - Doubles{};
  const Mask some = first < end;
  const double beside = std::min(std::max(std::trunc(edges[0].x), 0.0), columns - 1.0);  // memory that is at hand
  spans = {row,
           x_left,
           z_left,
           x_right - x_left,
           z_right - z_left,
           some ? first : beside + Doubles{},
           some ? end : beside + Doubles{}};
  return true;
}

// False if a scan line meets more than two edges; what was drawn of the rows above it may be drawn again.
ZSTEP_INLINE bool fill_rows(const FastEdge* edges, int count, std::int32_t row, std::int32_t end_row,
                            std::int32_t polygon, std::int32_t band_end, Picture& picture) {
  for (; row < end_row; row += four) {
    FourSpans spans;
    if (!find_spans(edges, count, row, picture.width, spans)) return false;
    // Eight pixels from any of four rows on are in the band.
    const bool room = row + four < band_end && picture.width >= 2 * four;
    if (room && !any(spans.end - spans.first > four)) {
      fill_short_spans(spans, four, polygon, picture);
    } else if (room && !any(spans.end - spans.first > 2 * four)) {
      fill_short_spans(spans, 2 * four, polygon, picture);
    } else {
      for (int k = 0; k < std::min<int>(four, band_end - row); ++k) {
        fill_span(spans.x[k], spans.z[k], spans.dx[k], spans.dz[k], static_cast<std::int32_t>(spans.first[k]),
                  static_cast<std::int32_t>(spans.end[k]), row + k, polygon, band_end, picture);
      }
    }
  }
  return true;
}

ZSTEP_INLINE const std::int32_t* corners_of(const Fill& fill, const FastOutline& outline) {
  return (outline.clipped ? fill.all.made : fill.all.scene.corners).data() + outline.first;
}

ZSTEP_INLINE bool fill_without_tables(Fill& fill, const FastOutline& outline) {
  if (outline.count > most_edges) return false;
  const std::int32_t* const corners = corners_of(fill, outline);
  const RasterPoint* const points = fill.all.points.data();
  const RasterPoint* from = points + corners[outline.count - 1];
  FastEdge edges[most_edges];
  for (std::int32_t i = 0; i < outline.count; ++i) {
    const RasterPoint* const to = points + corners[i];
    const RasterPoint* const ends[2] = {from, to};
    const bool upwards = from->y > to->y;  // a place in `ends` rather than a branch
    const RasterPoint *const start = ends[upwards], *const end = ends[!upwards];
    edges[i] = {start->x, start->y, start->z, end->x - start->x, end->y - start->y, end->z - start->z, end->y};
    from = to;
  }
  const std::int32_t row = std::max(outline.row, fill.first_row), end_row = std::min(outline.end_row, fill.end_row);
  return fill_rows(edges, outline.count, row, end_row, outline.polygon, fill.end_row, fill.picture);
}

// The way of z_buffer.cpp, for an outline that goes up and down more than once.
void fill_with_tables(Fill& fill, const FastOutline& outline) {
  NullRecorder record;
  viewing::Vertices vertices;
  std::vector<std::int32_t> numbers;
  for (std::int32_t i = 0; i < outline.count; ++i) {
    const RasterPoint& point = fill.all.points[corners_of(fill, outline)[i]];
    vertices.push_back({{}, {point.x, point.y, point.z}, 0});
    numbers.push_back(i);
  }
  scan_conversion::EdgeTable edges;
  scan_conversion::ActiveEdges active;
  const Raster& raster = fill.all.scene.raster;
  constexpr auto top_left = Conventions::Coverage::top_left;
  build_edge_table(edges, outline.polygon, numbers, vertices, raster, top_left, record);
  for (std::int32_t y = edges.first_row; y < edges.end_row; ++y) {
    begin_scan_line(active, edges, y, true, record);
    if (y < fill.first_row || y >= fill.end_row) continue;
    for (std::size_t i = 0; i + 1 < active.edges.size(); i += 2) {
      const auto span = begin_span(edges, active.edges[i], active.edges[i + 1], y, raster, top_left, record);
      fill_span(span.x_left, span.z_left, span.x_right - span.x_left, span.z_right - span.z_left, span.first,
                span.last + 1, y, outline.polygon, fill.end_row, fill.picture);
    }
  }
}

ZSTEP_INLINE void fill_band(Fill& fill) {
  clear_band(fill);
  for (const std::vector<FastOutline>& part : fill.all.parts) {
    for (const FastOutline& outline : part) {
      if (outline.row >= fill.end_row || outline.end_row <= fill.first_row) continue;
      if (!fill_without_tables(fill, outline)) fill_with_tables(fill, outline);
    }
  }
}
ZSTEP_FOR_THIS_PROCESSOR(fill_band, Fill)

}  // namespace

void run_fast(const Scene& scene, const Conventions& conventions, Picture& picture, int wanted) {
  const bool one_order = conventions.interpolation == Conventions::Interpolation::increments ||
                         conventions.coverage == Conventions::Coverage::inclusive;
  if (one_order) {
    NullRecorder record;
    picture = run(scene, conventions, record);
    return;
  }
  draw_in_bands(scene, conventions, picture, wanted, fill_band_on_this_processor);
}

}  // namespace zstep::z_buffer

#else

void zstep::z_buffer::run_fast(const Scene& scene, const Conventions& conventions, Picture& picture, int) {
  NullRecorder record;
  picture = run(scene, conventions, record);
}

#endif

zstep::Picture zstep::z_buffer::run_fast(const Scene& scene, const Conventions& conventions) {
  Picture picture;
  run_fast(scene, conventions, picture);
  return picture;
}
