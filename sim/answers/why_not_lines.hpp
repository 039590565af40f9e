// A polygon's edges as lines, and its curves on a surface: for why_not_lines.cpp, why_not_curves.cpp and
// why_not_anywhere.cpp only.
#pragma once

#include <vector>

#include "sim/answers/why_not_parts.hpp"

namespace zstep::answers {

/// An edge of the polygon, as the trace left it at its end.
struct Line {
  LineRow row;
  OnRaster from, to;
};
std::vector<Line> lines_of(Asked& q);
/// Where work on it begins.
std::optional<std::int64_t> begin_of(const Asked& q, const Line& line);

/// A piece of a curve along the polygon's border: the step of its curve_segment and the one at which it ends.
struct Segment {
  std::int64_t begin = 0, end = 0;
  CurveSegment ends{};
};
std::vector<Segment> segments_of(const Asked& q);

}  // namespace zstep::answers
