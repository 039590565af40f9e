// Which faces may lie at a line: the picture in square cells, each with the faces whose extents reach into it.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/hidden_line/lines.hpp"
#include "algorithms/pieces/pieces.hpp"

namespace zstep::hidden_line {

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
