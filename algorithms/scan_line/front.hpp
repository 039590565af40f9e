// Which polygon is seen where on an interval of a scan line on which several in/out flags are true.
//
// Depths are compared at the two ends of the interval. Along a scan line a plane's depth is linear in x, so a polygon
// that is in front at both ends is in front all along; where another one is in front at the other end, the two
// penetrate each other and the interval is split at the implied edge (Bouknight 1970; Foley et al., section 15.6).
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "algorithms/pieces/pieces.hpp"
#include "algorithms/scan_conversion/active_edges.hpp"
#include "traces/scene.hpp"

// The steps of the scan-line method.

#define ZSTEP_MODULE scan_line
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/scan_line/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::scan_line {

// What the scan-line method keeps of all polygons at once.

struct Tables {
  pieces::Pieces polygons;           ///< the polygon table: a piece is a polygon as far as it is in view
  scan_conversion::EdgeTable edges;  ///< the global edge table
  std::vector<std::int32_t> owner;   ///< of each edge, by number: the row of the polygon table

  std::int32_t owner_of(std::int32_t edge) const { return owner[edge]; }
  double x_of(std::int32_t edge) const { return edges.edges[edge].x; }
};

/// Fills the edge table and its owners from the polygon table.
template <Recorder R>
void fill_edge_table(Tables& tables, const viewing::Vertices& vertices, const Raster& raster,
                     Conventions::Coverage coverage, R& record) {
  for (std::size_t piece = 0; piece < tables.polygons.pieces.size(); ++piece) {
    const pieces::Piece& row = tables.polygons.pieces[piece];
    scan_conversion::add_edges(tables.edges, row.polygon, row.outline, vertices, raster, coverage, record);
    tables.owner.resize(tables.edges.edges.size(), index32(piece));
  }
  fill_buckets(tables.edges);
}

/// Part of scan line y, from x_left to x_right, within the raster. The pixels whose centres lie on it are first … last:
/// a centre on the left end counts, one on the right end does not; one on an implied edge is a tie and goes to the
/// polygon drawn first.
struct Interval {
  double y, x_left, x_right;
  std::int32_t first, last;
};

/// An interval on which one polygon is seen.
struct Visible {
  std::int32_t piece;
  Interval where;
};

/// The pixels from the first centre at or beyond x_left to the last before x_right.
Interval interval_between(double y, double x_left, double x_right, std::int32_t width);

/// Splits an interval into what is seen of the pieces `inside`, from left to right.
///
/// Depths that are equal to rounding are ties: the piece that is nearer at the other end wins, else the one with the
/// smaller number. So of coplanar polygons the one drawn first is seen, and nothing of the others.
template <Recorder R>
void find_front(const pieces::Pieces& polygons, const std::vector<std::int32_t>& inside, const Interval& interval,
                std::vector<Visible>& visible, R& record);

/// Coherence from line to line, on an interval between the same two edges as on the line before.
///
/// Scan-line coherence: the polygon that was in front all along still is, if it and each other one inside lie apart:
/// all corners of the one beyond the plane of the other, by more than rounding. The difference of two planes' depths is
/// linear in x and y, so what is positive at a polygon's corners is positive on all of it: whichever is in front at one
/// pixel is so at every pixel of both.
///
/// Implied edge coherence: where two polygons penetrated each other, both apart from all others inside, they still do
/// or no longer meet on the interval. The line where their planes meet is straight, and known from the line before.
class Coherence {
 public:
  /// To be called first on each line.
  void begin_line(const std::vector<std::int32_t>& active);
  /// Splits the interval right of the active edge at `place` as find_front() would, if what was seen there one line
  /// before tells; if not, depths must be compared. What it takes to know that is tested once for each pair of pieces.
  template <Recorder R>
  bool as_before(const pieces::Pieces& polygons, std::size_t place, const std::vector<std::int32_t>& inside,
                 const Interval& interval, std::vector<Visible>& visible, R& record);
  /// What find_front() found there.
  void keep(const pieces::Pieces& polygons, std::size_t place, const std::vector<Visible>& visible);

 private:
  struct Seen {
    std::int32_t left = -1;          // seen on the left; -1: unknown, or more than two
    std::int32_t right = -1;         // seen beyond the implied edge, if there was one
    double x = 0, y = 0, dx_dy = 0;  // a point of the implied edge and its slope
    double x_at(double row) const { return x + (row - y) * dx_dy; }
  };
  template <Recorder R>
  bool lie_apart(const pieces::Pieces& polygons, std::int32_t one, std::int32_t other, R& record);

  std::vector<std::int32_t> active_;  // of the line before
  std::vector<Seen> seen_;            // by place
  std::map<std::pair<std::int32_t, std::int32_t>, bool> apart_;
};

// The sweep along a scan line: across the active edges from left to right, with an in/out flag for each polygon.

/// What a sweep looks for: the pixels, so that intervals without a pixel's centre need no depth, or every length of
/// line.
enum class Wanted : std::uint8_t { pixels, lengths };

/// Finds what is seen on scan line y and calls seen(const Visible&) for each part, from left to right. `coherence` may
/// be null. Flags are out before the first edge and after the last, as every outline is crossed an even number of
/// times.
template <Recorder R, class Seen>
void sweep(const Tables& tables, const std::vector<std::int32_t>& active, double y, std::int32_t width, Wanted wanted,
           Coherence* coherence, R& record, Seen&& seen) {
  std::vector<std::int32_t> inside;  // the polygons whose flag is true
  std::vector<Visible> visible;
  if (coherence) coherence->begin_line(active);

  for (std::size_t i = 0; i < active.size(); ++i) {
    const std::int32_t piece = tables.owner_of(active[i]);
    const auto flag = std::find(inside.begin(), inside.end(), piece);
    const bool enters = flag == inside.end();
    record(step::flip, FlagFlip{active[i], piece, enters});
    if (enters) inside.push_back(piece);
    else inside.erase(flag);

    if (i + 1 == active.size()) break;
    const Interval interval = interval_between(y, tables.x_of(active[i]), tables.x_of(active[i + 1]), width);
    if (!(interval.x_left < interval.x_right)) continue;  // two edges at one x, or outside the raster
    const auto row = static_cast<std::int32_t>(y), flags = static_cast<std::int32_t>(inside.size());
    record(step::flags, SpanFlags{row, interval.x_left, interval.x_right, interval.first, interval.last, flags});
    if (inside.empty() || (wanted == Wanted::pixels && interval.last < interval.first)) continue;

    const bool known =
        coherence && flags > 1 && coherence->as_before(tables.polygons, i, inside, interval, visible, record);
    if (!known) {
      find_front(tables.polygons, inside, interval, visible, record);
      if (coherence) coherence->keep(tables.polygons, i, visible);
    }
    for (const Visible& part : visible) seen(part);
  }
}

}  // namespace zstep::scan_line
