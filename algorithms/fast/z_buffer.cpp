// Work in parts, shared by several threads.

#include "algorithms/fast/z_buffer.hpp"

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "algorithms/fast/simd.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"

namespace zstep::simd {

/// Calls work(part) once for each part from 0 on, on this thread and up to threads - 1 others at the same time; on
/// fewer where the system gives no more. What a part throws is thrown here, when all threads have ended.
template <class Work>
void parallel_for(int threads, std::size_t parts, Work&& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr fault;
  std::mutex faults;
  const auto take_parts = [&] {
    try {
      for (std::size_t part = next++; part < parts; part = next++) work(part);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(faults);
      if (!fault) fault = std::current_exception();
      next = parts;
    }
  };
  std::vector<std::thread> others;
  others.reserve(threads > 1 ? threads - 1 : 0);
  try {
    for (int k = 1; k < threads && static_cast<std::size_t>(k) < parts; ++k) others.emplace_back(take_parts);
  } catch (const std::system_error&) {  // no thread is to be had
  }
  take_parts();
  for (std::thread& other : others) other.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace zstep::simd

#if ZSTEP_HAS_LANES

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/scan_conversion/spans.hpp"
#include "algorithms/fast/z_buffer_outlines.hpp"

namespace zstep::z_buffer {

namespace {

using namespace simd;

// What one thread draws: all outlines, on the rows of its band. It touches no memory of other rows.
struct Fill {
  const Outlines& all;
  Picture& picture;
  std::int32_t first_row, end_row;
  bool clear_first;
};

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
  if (fill.clear_first) {
    const std::size_t first = fill.picture.at(0, fill.first_row), end = fill.picture.at(0, fill.end_row);
    std::fill(fill.picture.depth.data() + first, fill.picture.depth.data() + end, no_depth);
    std::fill(fill.picture.polygon.data() + first, fill.picture.polygon.data() + end, no_polygon);
  }
  for (const std::vector<FastOutline>& part : fill.all.parts) {
    for (const FastOutline& outline : part) {
      if (outline.row >= fill.end_row || outline.end_row <= fill.first_row) continue;
      if (!fill_without_tables(fill, outline)) fill_with_tables(fill, outline);
    }
  }
}
ZSTEP_FOR_THIS_PROCESSOR(fill_band, Fill)

int threads_for(const Raster& raster, int wanted) {
  constexpr int most = 16, rows_worth_it = 64;
  if (wanted > 0) return std::clamp(wanted, 1, std::max(1, raster.height));
  const int there = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(std::min(there, raster.height / rows_worth_it), 1, most);
}

// More than threads, as some have more to draw; and each small enough to stay near the processor while it is drawn.
std::int32_t bands_for(const Raster& raster, int threads) {
  constexpr std::int64_t near_by = 1 << 20;  // bytes
  constexpr std::int64_t of_pixel = sizeof(double) + sizeof(std::int32_t);
  const std::int64_t bytes = of_pixel * raster.width * raster.height;
  const std::int64_t shared = threads == 1 ? 1 : 4 * std::int64_t{threads};
  return static_cast<std::int32_t>(
      std::min<std::int64_t>(std::max(shared, bytes / near_by), std::max(1, raster.height / 8)));
}

}  // namespace

void run_fast(const Scene& scene, const Conventions& conventions, Picture& picture, int wanted) {
  const Raster& raster = scene.raster;
  const bool one_order = conventions.interpolation == Conventions::Interpolation::increments ||
                         conventions.coverage == Conventions::Coverage::inclusive;
  if (one_order) {
    NullRecorder record;
    picture = run(scene, conventions, record);
    return;
  }
  const bool kept = picture.width == raster.width && picture.height == raster.height;
  if (kept) picture.ink.clear();
  else picture = Picture(raster.width, raster.height);

  const int threads = threads_for(raster, wanted);
  const std::int32_t bands = bands_for(raster, threads);
  const std::size_t parts = threads;
  Outlines all(scene, conventions, parts);
  // To begin a thread takes as long as some thousands of these.
  const int viewing = scene.points.size() < 30'000 ? 1 : threads, finding = scene.facets.size() < 4'000 ? 1 : threads;
  simd::parallel_for(viewing, parts, [&](std::size_t part) { all.view(part); });
  simd::parallel_for(finding, parts, [&](std::size_t part) { all.find(part); });
  all.finish();
  simd::parallel_for(threads, static_cast<std::size_t>(bands), [&](std::size_t band) {
    const auto row_of = [&](std::size_t k) {
      return static_cast<std::int32_t>(std::int64_t{raster.height} * static_cast<std::int64_t>(k) / bands);
    };
    Fill fill{all, picture, row_of(band), row_of(band + 1), kept};
    fill_band_on_this_processor(fill);
  });
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
