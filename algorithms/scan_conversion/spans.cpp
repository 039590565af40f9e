
#include "algorithms/scan_conversion/spans.hpp"

#include <algorithm>

#include "algorithms/scan_conversion/numbers.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::scan_conversion {

template <class T, Recorder R>
Span begin_span(const EdgeTableOf<T>& table, std::int32_t left, std::int32_t right, std::int32_t y,
                const Raster& raster, Conventions::Coverage coverage, R& record) {
  const EdgeOf<T>& left_edge = table.edges[left];
  const EdgeOf<T>& right_edge = table.edges[right];
  Span span{left, right, y, 0, 0, left_edge.x, left_edge.z, right_edge.x, right_edge.z, 0};

  span.first = std::max(0, formulas::limited_column(formulas::first_pixel(span.x_left, coverage), raster.width));
  span.last = formulas::limited_column(formulas::last_pixel(span.x_right, coverage) + 1, raster.width) - 1;

  // 001 prints (z1 - z3)/(x1 - x3) for the step along a scan line: the ends of an edge. It is the ends of the span.
  if (span.x_right != span.x_left) span.dz_dx = formulas::slope(left_edge.z, right_edge.z, left_edge.x, right_edge.x);
  record(step::span, span);
  return span;
}

#define INSTANTIATE(R, T)                                                                                        \
  template Span begin_span<T, R>(const EdgeTableOf<T>&, std::int32_t, std::int32_t, std::int32_t, const Raster&, \
                                 Conventions::Coverage, R&);
ZSTEP_FOR_EACH_NUMBER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::scan_conversion
