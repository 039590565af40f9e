#include <array>
#include <cmath>

#include <fmt/format.h>

#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/built_in/teapot_patches.hpp"
#include "algorithms/scene/files/number.hpp"
#include "algorithms/scene/files/point_merger.hpp"
#include "traces/error.hpp"

namespace zstep::scene {

namespace {

using Patch = std::array<std::int16_t, 16>;

/// The Bernstein polynomials of degree three.
std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

glm::dvec3 point_of(const Patch& patch, double u, double v) {
  const auto in_u = bernstein(u), in_v = bernstein(v);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto& control = teapot_points[static_cast<std::size_t>(patch[4 * i + j])];
      sum += in_u[i] * in_v[j] * glm::dvec3(control[0], control[1], control[2]);
    }
  // Millionths to units, the middle of the pot's extent to the origin, its length to 2.
  constexpr double middle_x = 554258, middle_z = 675049, half_length = 804258;
  const glm::dvec3 placed = (sum - glm::dvec3(middle_x, 0, middle_z)) / half_length;
  // Neighbouring patches have the same border, but reach its points by different roundings. On a grid of 2^-30 they
  // agree.
  constexpr double grid = 1 << 30;
  return {std::round(placed.x * grid) / grid, std::round(placed.y * grid) / grid, std::round(placed.z * grid) / grid};
}

}  // namespace

PolygonSoup teapot(int level) {
  PolygonSoup soup;
  PointMerger merger;
  const auto where = [] { return std::string("teapot"); };
  std::vector<std::int64_t> index(static_cast<std::size_t>((level + 1) * (level + 1)));
  const auto at = [&](int i, int j) -> std::int64_t& { return index[static_cast<std::size_t>(i * (level + 1) + j)]; };
  for (const Patch& patch : teapot_patches) {
    for (int i = 0; i <= level; ++i)
      for (int j = 0; j <= level; ++j)
        at(i, j) =
            merger.add(soup, point_of(patch, static_cast<double>(i) / level, static_cast<double>(j) / level), 0, where);
    for (int i = 0; i < level; ++i)
      for (int j = 0; j < level; ++j) {
        const std::array<std::int64_t, 4> around{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        for (std::size_t k = 0; k < 4; ++k)  // at the pole two corners are one
          if (around[k] != around[(k + 1) % 4]) soup.add_corner(around[k], where);
        soup.close_outline(0, std::nullopt, where);
      }
  }
  return soup;
}

std::optional<int> teapot_level(const std::string& name, const std::string& where) {
  if (name == "teapot") return default_teapot_level;
  if (name.substr(0, 7) != "teapot:") return std::nullopt;
  const auto level = parse_integer(std::string_view(name).substr(7));
  if (!level || *level < 1 || *level > highest_teapot_level)
    throw InputError(where, fmt::format("the level is not a whole number from 1 to {}", highest_teapot_level),
                     "write teapot:8");
  return static_cast<int>(*level);
}

}  // namespace zstep::scene
