// Spans: the pixels between two active edges, and the depth along them.
#pragma once

#include <cstdint>

#include "algorithms/scan_conversion/active_edges.hpp"
#include "traces/formulas/outlines.hpp"

namespace zstep::scan_conversion {

/// A span is what its event says.
using Span = SpanBegin;

/// The pixels of scan line y between two active edges. top_left: ceil(x_left) … ceil(x_right) - 1, so a centre on the
/// left edge counts and one on the right edge does not. inclusive: ceil(x_left) … floor(x_right), the `for x = x_L to
/// x_R` of 000, which draws the pixels on a shared edge twice. The others: formulas::first_pixel, formulas::last_pixel.
/// Limited to the raster's width.
template <class T, Recorder R>
Span begin_span(const EdgeTableOf<T>& table, std::int32_t left, std::int32_t right, std::int32_t y,
                const Raster& raster, Conventions::Coverage coverage, R& record);

/// z–x interpolation (000): z = z_L + (z_R - z_L)(x - x_L)/(x_R - x_L), by which the trace's codec predicts it.
inline double depth_on(const Span& span, std::int32_t x) {
  if (span.x_right == span.x_left) return span.z_left;
  return formulas::on_line<double>(span.z_left, span.z_right, x, span.x_left, span.x_right);
}

// Scan conversion of one outline from its edge table to its spans.

/// Calls visit(span) for every span of an outline (indices into vertices), from top to bottom and from left to right.
/// Coverage is top-left, interpolation direct.
template <Recorder R, class Visit>
void for_each_span(std::int32_t polygon, std::span<const std::int32_t> outline, const viewing::Vertices& vertices,
                   const Raster& raster, R& record, Visit&& visit) {
  const auto coverage = Conventions::Coverage::top_left;
  EdgeTable edges;
  ActiveEdges active;
  build_edge_table(edges, polygon, outline, vertices, raster, coverage, record);
  for (std::int32_t y = edges.first_row; y < edges.end_row; ++y) {
    begin_scan_line(active, edges, y, true, record);

    for (std::size_t i = 0; i + 1 < active.edges.size(); i += 2) {  // even-odd: inside between each pair
      visit(begin_span(edges, active.edges[i], active.edges[i + 1], y, raster, coverage, record));
    }
  }
  end_polygon(active, record);
}

}  // namespace zstep::scan_conversion
