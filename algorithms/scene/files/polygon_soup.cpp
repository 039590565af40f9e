
#include "algorithms/scene/files/polygon_soup.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "traces/error.hpp"

namespace zstep::scene {

void PolygonSoup::too_much(std::string_view where, std::string_view what, std::int64_t most) {
  throw InputError(where, fmt::format("there are more than {} {}, the most that are read", most, what),
                   "decimate the mesh in a modelling program");
}

void PolygonSoup::note(const PassedOver& passed, std::string_view one, std::string_view several,
                       std::string_view rest) {
  if (passed.count > 0)
    notes.push_back(fmt::format("{}: {} {}{}", passed.where, passed.count, passed.count == 1 ? one : several, rest));
}

void PolygonSoup::give_to_corners(VertexAttribute& to, std::span<const std::int32_t> value_of_corner) {
  to.of_point.resize(points.size(), no_value);
  const auto same = [&](std::int32_t a, std::int32_t b) {
    const auto first = to.values.begin();
    return a == b ||
           std::equal(first + std::ptrdiff_t{a} * to.components, first + (std::ptrdiff_t{a} + 1) * to.components,
                      first + std::ptrdiff_t{b} * to.components);
  };
  for (const Facet& outline : outlines) {
    const std::size_t before = to.own.size();
    for (std::int32_t i = 0; i < outline.corner_count; ++i) {
      const std::int32_t point = corners[outline.first_corner + i], value = value_of_corner[outline.first_corner + i];
      if (value == no_value) continue;
      std::int32_t& usual = to.of_point[point];
      if (usual == no_value) usual = value;
      else if (!same(usual, value)) to.own.push_back({outline.polygon, point, value});
    }
    // A polygon that comes to a point twice has its first value there.
    std::stable_sort(to.own.begin() + before, to.own.end(),
                     [](const auto& a, const auto& b) { return a.point < b.point; });
    to.own.erase(std::unique(to.own.begin() + before, to.own.end(),
                             [](const auto& a, const auto& b) { return a.point == b.point; }),
                 to.own.end());
  }
}

namespace {

bool is_placed(const glm::dvec3& point) { return std::isfinite(point.x + point.y + point.z); }

std::string place_of(const PolygonSoup& soup, std::int32_t point, const std::string& name) {
  return soup.point_lines.empty() ? fmt::format("{}: vertex {}", name, point)
                                  : fmt::format("{}:{}", name, soup.point_lines[point]);
}

/// Puts the k-th polygon into a place that is free, of those before it.
void move_polygon(PolygonSoup& soup, std::size_t k, std::size_t place) {
  const auto move = [&](auto& one_a_polygon) {
    if (!one_a_polygon.empty()) one_a_polygon[place] = std::move(one_a_polygon[k]);
  };
  move(soup.outlines), move(soup.outline_lines), move(soup.colors), move(soup.materials), move(soup.names);
  soup.outlines[place].polygon = index32(place);
}

void keep_polygons(PolygonSoup& soup, std::size_t count) {
  const auto keep = [&](auto& one_a_polygon) {
    if (!one_a_polygon.empty()) one_a_polygon.resize(count);
  };
  keep(soup.outlines), keep(soup.outline_lines), keep(soup.colors), keep(soup.materials), keep(soup.names);
}

void leave_out_unplaced(PolygonSoup& soup, const std::string& name) {
  const auto placed = std::find_if(soup.points.begin(), soup.points.end(), is_placed);
  if (std::all_of(soup.points.begin(), soup.points.end(), is_placed)) return;
  std::size_t kept = 0;
  std::vector<std::int32_t> new_place(soup.outlines.size(), no_polygon);
  for (std::size_t k = 0; k < soup.outlines.size(); ++k) {
    const auto corners = soup.corners_of(soup.outlines[k]);
    const auto unplaced = std::find_if_not(corners.begin(), corners.end(),
                                           [&](std::int32_t corner) { return is_placed(soup.points[corner]); });
    if (unplaced != corners.end()) soup.losses.unplaced.add([&] { return place_of(soup, *unplaced, name); });
    else new_place[k] = index32(kept);
    if (new_place[k] != no_polygon && kept++ != k) move_polygon(soup, k, kept - 1);
  }
  for (VertexAttribute& attribute : soup.attributes) {
    for (VertexAttribute::Own& own : attribute.own) own.polygon = new_place[own.polygon];
    std::erase_if(attribute.own, [](const VertexAttribute::Own& own) { return own.polygon == no_polygon; });
  }
  keep_polygons(soup, kept);
  // No polygon uses them now. At the place of another they do not move the scene's bounds.
  const glm::dvec3 somewhere = placed == soup.points.end() ? glm::dvec3(0) : *placed;
  std::replace_if(
      soup.points.begin(), soup.points.end(), [](const glm::dvec3& p) { return !is_placed(p); }, somewhere);
}

}  // namespace

PolygonSoup finish_soup(PolygonSoup soup, const std::string& name) {
  std::erase_if(soup.attributes, [](const VertexAttribute& attribute) { return attribute.values.empty(); });
  for (VertexAttribute& attribute : soup.attributes) attribute.of_point.resize(soup.points.size(), no_value);
  leave_out_unplaced(soup, name);
  const Losses& lost = soup.losses;
  if (soup.outlines.empty() && lost.unplaced.count > 0)
    throw InputError(lost.unplaced.where, "every polygon has a vertex that is no finite number",
                     "repair the mesh where it was made");
  soup.note(lost.unplaced, "polygon is", "polygons are",
            " left out, with a vertex that is no finite number; repair the mesh where it was made");
  soup.note(lost.values, "value of a vertex is", "values of vertices are",
            " taken as 0 or left out: no finite number, or named by a face and not in the file");
  soup.note(lost.components, "number of a vertex is", "numbers of vertices are",
            fmt::format(" not kept: a scene has {} attributes at most, texture coordinates u and v, no weight",
                        most_attributes));
  soup.note(lost.textures, "texture is", "textures are",
            " not kept: of a material only the image of its colour is (map_Kd)");
  soup.note(lost.opacities, "polygon has", "polygons have",
            " an alpha that is not used; a scene file's [[mesh]] can give opacity");
  soup.note(lost.clamped_colors, "colour is", "colours are",
            " out of range and clamped; use whole numbers of 0 to 255, or fractions of 0 to 1");
  return soup;
}

}  // namespace zstep::scene
