// Which polygon is seen where on an interval of a scan line on which several in/out flags are true.
//
// Depths are compared at the two ends of the interval. Along a scan line a plane's depth is linear in x, so a polygon
// that is in front at both ends is in front all along; where another one is in front at the other end, the two
// penetrate each other and the interval is split at the implied edge (Bouknight 1970; Foley et al., section 15.6).
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "algorithms/scan_line/steps.hpp"
#include "algorithms/scan_line/tables.hpp"

namespace zstep::scan_line {

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

}  // namespace zstep::scan_line
