// What a mesh reader hands on: points and outlines, in the order of the file, checked.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "traces/limits.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

/// What one scene may hold. With these, the largest file that is accepted needs less than 1 GiB to load.

/// Every corner is an index into `points`, every coordinate is finite, and nothing is beyond the limits.
struct PolygonSoup {
  std::vector<glm::dvec3> points;
  std::vector<std::int32_t> point_lines;    ///< one a point; empty for a binary file
  std::vector<Facet> outlines;              ///< the k-th is polygon k, with its corners as the file has them
  std::vector<std::int32_t> outline_lines;  ///< one a polygon; empty for a binary file
  std::vector<std::int32_t> corners;
  std::vector<std::optional<Color>> colors;  ///< one a polygon, or none at all
  std::vector<Material> materials;           ///< one a polygon, or none at all
  std::vector<std::string> names;            ///< one a polygon, or none at all
  std::vector<std::string> notes;            ///< what was passed over, one sentence each

  /// Adds a point; throws InputError at `where()` beyond the limit. `line` 0: the file has no lines.
  template <class Where>
  void add_point(glm::dvec3 point, std::int32_t line, Where&& where) {
    if (static_cast<std::int64_t>(points.size()) == most_points) too_much(where(), "points", most_points);
    points.push_back(point);
    if (line > 0) point_lines.push_back(line);
  }
  /// Adds a polygon whose corners were pushed to `corners` since the last one; throws InputError beyond the limit.
  template <class Where>
  void close_outline(std::int32_t line, std::optional<Color> color, Where&& where) {
    if (static_cast<std::int64_t>(outlines.size()) == most_polygons) too_much(where(), "polygons", most_polygons);
    const std::int32_t first = outlines.empty() ? 0 : outlines.back().first_corner + outlines.back().corner_count;
    const auto polygon = static_cast<std::int32_t>(outlines.size());
    if (static_cast<std::int64_t>(corners.size()) - first > most_corners_of_polygon)
      too_much(where(), "corners of one polygon", most_corners_of_polygon);
    outlines.push_back({polygon, first, static_cast<std::int32_t>(corners.size()) - first});
    if (line > 0) outline_lines.push_back(line);
    if (color && colors.empty()) colors.resize(outlines.size() - 1);
    if (color || !colors.empty()) colors.push_back(color);
  }
  template <class Where>
  void add_corner(std::int64_t point, Where&& where) {
    if (static_cast<std::int64_t>(corners.size()) == most_corners) too_much(where(), "corners", most_corners);
    corners.push_back(static_cast<std::int32_t>(point));
  }

  std::span<const std::int32_t> corners_of(const Facet& outline) const {
    return {corners.data() + outline.first_corner, static_cast<std::size_t>(outline.corner_count)};
  }

  [[noreturn]] static void too_much(std::string_view where, std::string_view what, std::int64_t most);
};

}  // namespace zstep::scene
