#include "algorithms/scene/surface/sample.hpp"

namespace zstep::scene {

namespace {

double at(double low, double high, std::int32_t i, std::int32_t count) {
  return i == count - 1 && i > 0 ? high : count > 1 ? low + (high - low) * i / (count - 1) : low;
}

}  // namespace

PolygonSoup sample(const Surface& surface, Formula& formula, const std::string& where) {
  const std::int32_t columns = surface.columns, rows = surface.rows;
  const auto place = [&] { return where; };
  PolygonSoup soup;
  for (std::int32_t row = 0; row < rows; ++row) {
    const double z = at(surface.z_min, surface.z_max, row, rows);
    for (std::int32_t column = 0; column < columns; ++column) {
      const double x = at(surface.x_min, surface.x_max, column, columns);
      soup.add_point({x, z, formula.at(x, z)}, 0, place);
    }
  }
  for (std::int32_t row = 0; row + 1 < rows; ++row)
    for (std::int32_t column = 0; column + 1 < columns; ++column) {
      const std::int32_t corner = row * columns + column;
      for (const std::int32_t index : {corner, corner + 1, corner + columns + 1, corner + columns})
        soup.add_corner(index, place);
      soup.close_outline(0, std::nullopt, place);
    }
  return soup;
}

}  // namespace zstep::scene
