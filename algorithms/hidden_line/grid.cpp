#include "algorithms/hidden_line/grid.hpp"

#include <algorithm>

#include <glm/common.hpp>

namespace zstep::hidden_line {

namespace {

constexpr std::int32_t cell = 16;  // pixels

// The cell of a coordinate; what lies beyond the picture counts to the cells at its border.
std::int32_t cell_of(double at, std::int32_t cells) {
  return static_cast<std::int32_t>(std::clamp((at + 0.5) / cell, 0.0, cells - 1.0));
}

}  // namespace

Grid::Grid(const pieces::Pieces& faces, const Raster& raster)
    : faces_(faces),
      columns_(std::max(1, (raster.width + cell - 1) / cell)),
      rows_(std::max(1, (raster.height + cell - 1) / cell)),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  for (std::size_t i = 0; i < faces.pieces.size(); ++i) {
    const Cells reach = cells_of(faces.pieces[i].low, faces.pieces[i].high);
    for (std::int32_t row = reach.first_row; row <= reach.last_row; ++row) {
      for (std::int32_t column = reach.first_column; column <= reach.last_column; ++column) {
        at(column, row).push_back(static_cast<std::int32_t>(i));
      }
    }
  }
}

Grid::Cells Grid::cells_of(glm::dvec3 low, glm::dvec3 high) const {
  return {cell_of(low.x, columns_), cell_of(low.y, rows_), cell_of(high.x, columns_), cell_of(high.y, rows_)};
}

std::vector<std::int32_t>& Grid::at(std::int32_t column, std::int32_t row) {
  return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
}

std::vector<std::int32_t> Grid::near(const lines::Line& line) {
  const glm::dvec3 low = glm::min(line.from, line.to), high = glm::max(line.from, line.to);
  const Cells reach = cells_of(low, high);
  std::vector<std::int32_t> found;
  for (std::int32_t row = reach.first_row; row <= reach.last_row; ++row) {
    for (std::int32_t column = reach.first_column; column <= reach.last_column; ++column) {
      for (const std::int32_t number : at(column, row)) {
        const pieces::Piece& face = faces_[number];
        const bool apart = face.high.x < low.x || face.low.x > high.x || face.high.y < low.y || face.low.y > high.y;
        if (!apart && face.low.z < high.z) found.push_back(number);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace zstep::hidden_line
