// The edge table: the edges of one polygon, or of all, by the scan line on which they begin.
//
// Foley, van Dam, Feiner and Hughes, "Computer Graphics: Principles and Practice", 2nd edition, section 3.6; the depth
// beside x as in 000 ("mixed coordinates": x_s, y_s and z).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/viewing/vertices.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/record/recorder.hpp"

// The steps of scan conversion with an edge table and an active edge list.

#define ZSTEP_MODULE scan_conversion
#define ZSTEP_FIRST_STEP 24
#define ZSTEP_STEPS "algorithms/scan_conversion/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::scan_conversion {

/// How numbers are made of the vertices' doubles: not at all, where the run computes in doubles. Other types of number
/// have their own (algorithms/interpolation/numbers.hpp).
template <class T>
struct NumbersOf {
  T position(double x) const { return static_cast<T>(x); }
  T depth(double z) const { return static_cast<T>(z); }
  T reciprocal(T w) const { return T(1) / w; }
};

/// An edge, from its end with the smaller y to its end with the larger. Two polygons that share it thus compute the
/// same bits along it. T is the type of number that the run computes in.
template <class T>
struct EdgeOf {
  std::int32_t vertex_0, vertex_1;
  T x_0, y_0, z_0, x_1, y_1, z_1;   ///< (x_s, y_s, depth) of the two
  std::int32_t first_row, end_row;  ///< the scan lines it meets: first_row <= y < end_row
  T x, z;                           ///< where it meets the current scan line
  T dx_dy, dz_dy;                   ///< what they gain from line to line
  std::int32_t way = 1;             ///< 1 where the outline goes from vertex_0 to vertex_1, else -1

  /// x–y interpolation (000): x = x_0 + (x_1 - x_0)(y - y_0)/(y_1 - y_0)
  T x_at(std::int32_t row) const { return formulas::on_line(x_0, x_1, T(row), y_0, y_1); }
  /// z–y interpolation (000): z = z_0 + (z_1 - z_0)(y - y_0)/(y_1 - y_0)
  T z_at(std::int32_t row) const { return formulas::on_line(z_0, z_1, T(row), y_0, y_1); }
};

template <class T>
struct EdgeTableOf {
  std::vector<EdgeOf<T>> edges;             ///< in the order of the outlines; an edge's place here is its number
  std::vector<std::int32_t> buckets;        ///< numbers of edges by first_row, within a row in the order of insertion
  std::int32_t first_row = 0, end_row = 0;  ///< the scan lines that the edges span: first_row <= y < end_row
  NumbersOf<T> numbers{};
};
using Edge = EdgeOf<double>;
using EdgeTable = EdgeTableOf<double>;

/// Fills the table with the edges of an outline (indices into vertices). Scan lines are limited to the raster.
///
/// top_left: an edge meets the rows ceil(y_0) … ceil(y_1) - 1, so the end on top counts and the end at the bottom does
/// not. inclusive: row y_1 too, when the polygon has its lowest point there (a local maximum of y, horizontal edges
/// looked past); elsewhere the next edge begins on that row and two would be one too many.
template <class T, Recorder R>
void build_edge_table(EdgeTableOf<T>& table, std::int32_t polygon, std::span<const std::int32_t> outline,
                      const viewing::Vertices& vertices, const Raster& raster, Conventions::Coverage coverage,
                      R& record);

/// The same in two halves, for a global table: the edges of one more outline behind those that are there, and, once
/// all are in, the buckets.
template <class T, Recorder R>
void add_edges(EdgeTableOf<T>& table, std::int32_t polygon, std::span<const std::int32_t> outline,
               const viewing::Vertices& vertices, const Raster& raster, Conventions::Coverage coverage, R& record);
template <class T>
void fill_buckets(EdgeTableOf<T>& table);

}  // namespace zstep::scan_conversion
