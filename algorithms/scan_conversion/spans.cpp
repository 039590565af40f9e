#include "algorithms/scan_conversion/spans.hpp"

#include <cmath>

#include "traces/record/all_recorders.hpp"

namespace zstep::scan_conversion {

namespace {

// A whole number, limited to -1 … width.
std::int32_t column(double whole, std::int32_t width) {
  if (!(whole > -1)) return -1;
  if (whole >= width) return width;
  return static_cast<std::int32_t>(whole);
}

}  // namespace

template <Recorder R>
Span begin_span(const EdgeTable& table, std::int32_t left, std::int32_t right, std::int32_t y, const Raster& raster,
                Conventions::Coverage coverage, R& record) {
  const Edge& left_edge = table.edges[static_cast<std::size_t>(left)];
  const Edge& right_edge = table.edges[static_cast<std::size_t>(right)];
  Span span{left, right, y, 0, 0, left_edge.x, left_edge.z, right_edge.x, right_edge.z, 0};

  const bool inclusive = coverage == Conventions::Coverage::inclusive;
  const double beyond = inclusive ? std::floor(span.x_right) + 1 : std::ceil(span.x_right);
  span.first = std::max(0, column(std::ceil(span.x_left), raster.width));
  span.last = column(beyond, raster.width) - 1;

  // 001 prints (z1 - z3)/(x1 - x3) for the step along a scan line: the ends of an edge. It is the ends of the span.
  if (span.x_right != span.x_left) span.dz_dx = (span.z_right - span.z_left) / (span.x_right - span.x_left);
  record(step::span, span);
  return span;
}

#define INSTANTIATE(R)                                                                                   \
  template Span begin_span<R>(const EdgeTable&, std::int32_t, std::int32_t, std::int32_t, const Raster&, \
                              Conventions::Coverage, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)

}  // namespace zstep::scan_conversion
