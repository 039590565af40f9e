// Which polygon is seen where on a stretch of a scan line on which several in/out flags are true.
//
// Depths are compared at the two ends of the stretch. Along a scan line a plane's depth is linear in x, so a polygon
// that is in front at both ends is in front all along; where another one is in front at the other end, the two
// penetrate each other and the stretch is split at the implied edge (Bouknight 1970; Foley et al., section 15.6).
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
struct Stretch {
  double y, x_left, x_right;
  std::int32_t first, last;
};

/// A stretch on which one polygon is seen.
struct Visible {
  std::int32_t piece;
  Stretch where;
};

/// The pixels from the first centre at or beyond x_left to the last before x_right.
Stretch stretch_between(double y, double x_left, double x_right, std::int32_t width);

/// Splits a stretch into what is seen of the pieces `inside`, from left to right.
///
/// Depths that are equal to rounding are ties: the piece that is nearer at the other end wins, else the one with the
/// smaller number. So of coplanar polygons the one drawn first is seen, and nothing of the others.
template <Recorder R>
void find_front(const pieces::Pieces& polygons, const std::vector<std::int32_t>& inside, const Stretch& stretch,
                std::vector<Visible>& visible, R& record);

/// Depth coherence from line to line: on a stretch between the same two edges as on the line before, the polygon that
/// was in front all along still is, if it and each other one inside lie apart: all corners of the one beyond the plane
/// of the other, by more than rounding. The difference of two planes' depths is linear in x and y, so what is positive
/// at a polygon's corners is positive on all of it: whichever is in front at one pixel is so at every pixel of both.
class Coherence {
 public:
  /// To be called first on each line.
  void begin_line(const std::vector<std::int32_t>& active);
  /// The piece that was seen all along the stretch right of the active edge at `place` one line before and must still
  /// be in front; -1 if depths must be compared. What it takes to know that is tested once for each pair of pieces.
  template <Recorder R>
  std::int32_t front_as_before(const pieces::Pieces& polygons, std::size_t place,
                               const std::vector<std::int32_t>& inside, R& record);
  void keep(std::size_t place, std::int32_t piece) { front_[place] = piece; }

 private:
  template <Recorder R>
  bool lie_apart(const pieces::Pieces& polygons, std::int32_t one, std::int32_t other, R& record);

  std::vector<std::int32_t> active_;  // of the line before
  std::vector<std::int32_t> front_;   // by place: the one piece seen on the stretch, -1 if there are more or none
  std::map<std::pair<std::int32_t, std::int32_t>, bool> apart_;
};

}  // namespace zstep::scan_line
