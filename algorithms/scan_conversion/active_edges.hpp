// The active edge list: the edges of the polygon that the current scan line meets, from left to right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/scan_conversion/edge_table.hpp"

namespace zstep::scan_conversion {

struct ActiveEdges {
  std::vector<std::int32_t> edges;  ///< numbers of edges, by x and then by slope
  std::size_t waiting = 0;          ///< the first of table.buckets that has not entered yet

  void clear() { edges.clear(), waiting = 0; }
};

/// Moves the list to scan line y, in the order of Foley et al.: active edges step to y, those that begin at y enter,
/// those that end at y leave, and the rest is put in order again. Calls must go through the table's rows one by one.
///
/// `direct` says how edges step: by the formulas of x–y and z–y interpolation, or by adding dx_dy and dz_dy.
///
/// Stepping comes before leaving, so that the list can be read as the book prints it; an edge may thus be stepped to
/// the scan line just beyond its end, once, before it leaves.
template <class T, Recorder R>
void begin_scan_line(ActiveEdges& active, EdgeTableOf<T>& table, std::int32_t y, bool direct, R& record);

/// After the last scan line: the edges that are still active leave.
template <Recorder R>
void end_polygon(ActiveEdges& active, R& record);

}  // namespace zstep::scan_conversion
