// Scan conversion of one outline from its edge table to its spans.
#pragma once

#include "algorithms/scan_conversion/spans.hpp"

namespace zstep::scan_conversion {

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
