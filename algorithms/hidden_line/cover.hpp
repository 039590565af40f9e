// What a face hides of a line.
//
// On the raster, with z* for depth, lines stay lines and planes stay planes. A point of the line from + t (to - from)
// is hidden by a face if it lies inside the face's outline on the picture (even-odd rule) and behind its plane: an
// interval of t, or several where the face is concave.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/hidden_line/lines.hpp"
#include "algorithms/pieces/pieces.hpp"

namespace zstep::hidden_line {

struct Interval {
  double t_0, t_1;
};
struct Crossing {
  double t;
  bool in_space;  ///< through the face's plane, else over one of its edges on the picture
};
struct Cover {
  LineFace outcome;
  std::vector<Crossing> crossings;  ///< within the line
  std::vector<Interval> hidden;     ///< ascending, longer than shortest
};

/// Tolerances. An end of the line within on_plane of the face's plane is on it, and what is on a plane is not behind
/// it: an edge does not vanish in a face that it touches. A corner of the face within on_line of the line counts as on
/// its right. What is hidden or seen over less than shortest is nothing.
inline constexpr double on_plane = 1e-9;  ///< distance on the raster, where depths run from -1 to 1
inline constexpr double on_line = 1e-9;   ///< pixels
inline constexpr double shortest = 1e-6;  ///< pixels

Cover find_cover(const lines::Line& line, std::span<const glm::dvec3> face, const pieces::Plane& plane);

/// The whole line, cut into pieces hidden and visible by turns. `hidden` in any order, overlapping or not.
struct Part {
  double t_0, t_1;
  bool visible;
};
std::vector<Part> cut(std::vector<Interval> hidden, double length);

// Which faces may lie at a line: the picture in square cells, each with the faces whose extents reach into it.

class Grid {
 public:
  Grid(const pieces::Pieces& faces, const Raster& raster);

  /// The faces whose extents overlap the line's in x and y and that do not lie wholly behind it, ascending.
  std::vector<std::int32_t> near(const lines::Line& line);

 private:
  struct Cells {
    std::int32_t first_column, first_row, last_column, last_row;
  };
  Cells cells_of(glm::dvec3 low, glm::dvec3 high) const;
  std::vector<std::int32_t>& at(std::int32_t column, std::int32_t row);

  const pieces::Pieces& faces_;
  std::int32_t columns_, rows_;
  std::vector<std::vector<std::int32_t>> cells_;
};

}  // namespace zstep::hidden_line
