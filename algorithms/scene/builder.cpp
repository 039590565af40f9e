
#include "algorithms/scene/builder.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <set>
#include <utility>

#include "traces/formulas/outlines.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

namespace {

const glm::dvec3& at(std::span<const glm::dvec3> points, std::int32_t corner) { return points[corner]; }

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Drops the axis along which the normal is longest; what is left keeps the turning sense seen from the normal's tip.
glm::dvec2 flatten(glm::dvec3 p, glm::dvec3 normal) {
  const glm::dvec3 size = glm::abs(normal);
  if (size.z >= size.x && size.z >= size.y) return normal.z > 0 ? glm::dvec2(p.x, p.y) : glm::dvec2(p.y, p.x);
  if (size.x >= size.y) return normal.x > 0 ? glm::dvec2(p.y, p.z) : glm::dvec2(p.z, p.y);
  return normal.y > 0 ? glm::dvec2(p.z, p.x) : glm::dvec2(p.x, p.z);
}

}  // namespace

glm::dvec3 newell_normal(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners) {
  return formulas::newell_normal(glm::dvec3(0), corners.size(), [&](std::size_t i) { return at(points, corners[i]); });
}

bool is_planar(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners) {
  if (corners.size() <= 3) return true;
  glm::dvec3 low = at(points, corners[0]), high = low, mean(0);
  for (const std::int32_t corner : corners) {
    low = glm::min(low, at(points, corner));
    high = glm::max(high, at(points, corner));
    mean += at(points, corner) / static_cast<double>(corners.size());
  }
  const double extent = glm::length(high - low);
  const double tolerance = planarity_tolerance * extent;
  const glm::dvec3 normal = newell_normal(points, corners);
  if (glm::length(normal) > planarity_tolerance * extent * extent) {
    const glm::dvec3 unit = glm::normalize(normal);
    return std::all_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
      return std::abs(glm::dot(unit, at(points, corner) - mean)) <= tolerance;
    });
  }
  // No area, so no plane of Newell's: on one line, or an outline that crosses itself.
  const glm::dvec3 first = at(points, corners[0]);
  glm::dvec3 along(0);
  for (const std::int32_t corner : corners)
    if (glm::length(at(points, corner) - first) > glm::length(along)) along = at(points, corner) - first;
  if (glm::length(along) == 0) return true;
  return std::all_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
    return glm::length(glm::cross(at(points, corner) - first, along)) <= tolerance * glm::length(along);
  });
}

bool EarClipper::cut(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners,
                     std::vector<std::int32_t>& triangles) {
  const glm::dvec3 normal = newell_normal(points, corners);
  std::vector<glm::dvec2> flat;
  for (const std::int32_t corner : corners) flat.push_back(flatten(at(points, corner), normal));
  std::vector<std::int32_t> left(corners.size());  // places in `corners`, in order
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = index32(i);
  const std::size_t before = triangles.size();

  const auto p = [&](std::size_t i) { return flat[left[i]]; };
  std::size_t start = 0;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t ear = n, sharpest = start % n;
    double sharpest_turn = -1e300;
    for (std::size_t k = 0; k < n && ear == n; ++k) {
      const std::size_t i = (start + k) % n, previous = (i + n - 1) % n, next = (i + 1) % n;
      const glm::dvec2 a = p(previous), b = p(i), c = p(next);
      const double turn = cross(b - a, c - b);
      if (turn > sharpest_turn) {
        sharpest_turn = turn;
        sharpest = i;
      }
      ++steps_;
      if (turn <= 0) continue;
      bool empty = true;
      for (std::size_t j = 0; j < n && empty; ++j) {
        if (j == previous || j == i || j == next) continue;
        ++steps_;
        const glm::dvec2 q = flat[left[j]];
        if (q == a || q == b || q == c) continue;  // the same place again, as where a hole is bridged
        empty = !(cross(b - a, q - a) >= 0 && cross(c - b, q - b) >= 0 && cross(a - c, q - c) >= 0);
      }
      if (empty) ear = i;
    }
    if (steps_ > most_steps) {
      triangles.resize(before);
      return false;
    }
    if (ear == n) ear = sharpest;
    const std::size_t previous = (ear + n - 1) % n, next = (ear + 1) % n;
    for (const std::size_t i : {previous, ear, next}) triangles.push_back(corners[left[i]]);
    left.erase(left.begin() + ear);
    start = ear;  // the next candidate is the corner after the ear, so that ears come from all round
  }
  for (const std::int32_t i : left) triangles.push_back(corners[i]);
  return true;
}

std::vector<std::int32_t> outline_of(std::span<const glm::dvec3> points, std::span<const std::int32_t> triangles) {
  // An edge that two triangles share runs once in each direction; those of the outline have no opposite.
  std::map<std::int32_t, std::int32_t> next;
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    edges.insert({triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1]});
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from}) && !next.try_emplace(from, to).second) return {};  // it meets itself
  std::vector<std::int32_t> ring;
  if (!next.empty())
    for (std::int32_t at = next.begin()->first; ring.size() < next.size() && next.contains(at); at = next.at(at))
      ring.push_back(at);
  if (3 * ring.size() != triangles.size() + 6) return {};
  EarClipper clipper;
  std::vector<std::int32_t> cut;
  for (std::size_t turned = 0; turned < ring.size(); ++turned) {
    cut.clear();
    if (clipper.cut(points, ring, cut) && std::equal(cut.begin(), cut.end(), triangles.begin(), triangles.end()))
      return ring;
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
  return {};
}

void put_in_order(Scene& scene, std::span<const std::int32_t> place_of) {
  const std::vector<Polygon> polygons = scene.polygons;
  for (std::size_t k = 0; k < polygons.size(); ++k) scene.polygons[place_of[k]] = polygons[k];
  for (VertexAttribute& attribute : scene.attributes) {
    for (VertexAttribute::Own& own : attribute.own) own.polygon = place_of[own.polygon];
    std::sort(attribute.own.begin(), attribute.own.end());
  }
  std::vector<Facet> facets = std::exchange(scene.facets, {});
  const std::vector<std::int32_t> corners = std::exchange(scene.corners, {});
  for (Facet& facet : facets) facet.polygon = place_of[facet.polygon];
  std::stable_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.polygon < b.polygon; });
  for (Facet facet : facets) {
    const auto first = corners.begin() + facet.first_corner;
    facet.first_corner = size32(scene.corners);
    scene.corners.insert(scene.corners.end(), first, first + facet.corner_count);
    scene.facets.push_back(facet);
  }
}

namespace {

std::string at_line(const std::string& where, std::int32_t line) {
  return line > 0 ? fmt::format("{}:{}", where, line) : where;
}

/// "1 polygon is", "3 polygons are"
std::string polygons_are(std::int64_t count) {
  return count == 1 ? std::string("1 polygon is") : fmt::format("{} polygons are", count);
}

/// Six times the volume within closed polygons: negative when the outside is inside, 0 where it is that of rounding.
double signed_volume(const PolygonSoup& soup) {
  double volume = 0, size = 0;
  for (const Facet& outline : soup.outlines) {
    const auto corners = soup.corners_of(outline);
    if (corners.size() < 3) continue;
    const double part = glm::dot(at(soup.points, corners[0]) - soup.points[0], newell_normal(soup.points, corners));
    volume += part;
    size += std::abs(part);
  }
  return std::abs(volume) > 1e-9 * size ? volume : 0;
}

}  // namespace

/// What the half-edge mesh shows: faces that do not fit together, holes, a surface that is inside out. Of few polygons
/// in colours of their own one sees the first two.
void SceneBuilder::note_topology(const PolygonSoup& soup, const std::string& where, const Style& style) {
  const Mesh mesh = build_mesh(soup.points, soup.outlines, soup.corners);
  const std::int64_t loose = mesh.loose_faces - too_few_corners_;
  std::vector<std::string>& notes = file_.notes;
  if (style.bare == Bare::shaded) {
    if (loose > 0)
      notes.push_back(
          fmt::format("{}: {} cut loose: more than two meet at an edge, or neighbours run against each other", where,
                      polygons_are(loose)));
    if (mesh.boundary_edges > 0)
      notes.push_back(
          fmt::format("{}: the surface is open at {} edges: with back faces dropped its inside cannot be seen", where,
                      mesh.boundary_edges));
  }
  if (loose > 0 || mesh.boundary_edges > 0) return;
  const bool mirrored = glm::determinant(style.placement.linear) < 0;  // the outlines of the file are not turned round
  if ((mirrored ? -1 : 1) * signed_volume(soup) < 0)
    notes.push_back(
        fmt::format("{}: the polygons run clockwise seen from outside: all of them count as back faces, and "
                    "the inside is drawn; turn them round where the mesh was made (flip its normals), or "
                    "draw both sides with --no-cull",
                    where));
}

namespace {

/// Does any of the facets from `first` on enclose an area?
bool has_area(const Scene& scene, std::size_t first) {
  return std::any_of(scene.facets.begin() + first, scene.facets.end(), [&](const Facet& facet) {
    const std::span corners(scene.corners.data() + facet.first_corner, static_cast<std::size_t>(facet.corner_count));
    return newell_normal(scene.points, corners) != glm::dvec3(0);
  });
}

}  // namespace

void SceneBuilder::check_limits(const PolygonSoup& soup, const std::string& where) const {
  const auto check = [&](std::size_t have, std::size_t more, std::int64_t most, std::string_view what) {
    if (static_cast<std::int64_t>(have + more) > most) PolygonSoup::too_much(where, what, most);
  };
  check(file_.scene.points.size(), soup.points.size(), most_points, "points");
  check(file_.scene.polygons.size(), soup.outlines.size(), most_polygons, "polygons");
  check(file_.scene.corners.size(), soup.corners.size(), most_corners, "corners");
}

/// Where the points come from, before they are placed.
void SceneBuilder::keep_origins(const PolygonSoup& soup, const std::string& where, const Style& style) {
  Scene& scene = file_.scene;
  const std::size_t first = scene.points.size(), count = soup.points.size();
  if (!soup.point_lines.empty()) scene.point_lines.resize(first);
  if (!scene.point_lines.empty() || !soup.point_lines.empty()) {
    scene.point_lines.insert(scene.point_lines.end(), soup.point_lines.begin(), soup.point_lines.end());
    scene.point_lines.resize(first + count);
  }
  const bool moved = style.placement.linear != glm::dmat3(1) || style.placement.offset != glm::dvec3(0);
  if (moved && scene.file_points.empty()) scene.file_points = scene.points;
  if (moved || !scene.file_points.empty())
    scene.file_points.insert(scene.file_points.end(), soup.points.begin(), soup.points.end());
  if (!style.is_placed_mesh()) return;
  Placement placement = style.placement;
  placement.first_point = index32(first);
  placement.point_count = index32(count);
  placement.source = where;
  placement.line = style.line;
  scene.placements.push_back(std::move(placement));
}

void SceneBuilder::add_points(PolygonSoup& soup, const std::string& where, const Style& style) {
  keep_origins(soup, where, style);
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    glm::dvec3& point = soup.points[i];
    point = style.placement(point) + 0.0;  // -0 becomes 0: it is going to be read
    const std::int32_t line = soup.point_lines.empty() ? 0 : soup.point_lines[i];
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(point[axis]) <= largest_coordinate))
        checked_coordinate(point[axis], at_line(where, line), "a coordinate, once placed,");
  }
  file_.scene.points.insert(file_.scene.points.end(), soup.points.begin(), soup.points.end());
}

/// Values of the soup's attributes behind those of the same names; what has none of a name has no value of it.
void SceneBuilder::add_attributes(PolygonSoup& soup, const std::string& where, const Style& style) {
  Scene& scene = file_.scene;
  // Normals go with the planes that they stand on.
  const glm::dmat3 turned = glm::transpose(glm::inverse(style.placement.linear));
  const auto first_point = size32(scene.points), first_polygon = size32(scene.polygons);
  for (VertexAttribute& from : soup.attributes) {
    const auto known = std::find_if(scene.attributes.begin(), scene.attributes.end(),
                                    [&](const VertexAttribute& one) { return one.name == from.name; });
    if (known == scene.attributes.end() && std::ssize(scene.attributes) == most_attributes) {
      file_.notes.push_back(fmt::format("{}: \"{}\" of its vertices is not kept: a scene has {} attributes at most",
                                        where, from.name, most_attributes));
      continue;
    }
    if (known != scene.attributes.end() && known->components != from.components) {
      file_.notes.push_back(
          fmt::format("{}: \"{}\" of its vertices is not kept: that of a mesh before it has {} numbers", where,
                      from.name, known->components));
      continue;
    }
    VertexAttribute& to =
        known == scene.attributes.end()
            ? scene.attributes.emplace_back(VertexAttribute{from.name, from.components, {}, {}, {}, {}})
            : *known;
    const auto first_value = static_cast<std::int32_t>(std::ssize(to.values) / to.components);
    if (std::ssize(to.values) + std::ssize(from.values) > most_values * to.components)
      PolygonSoup::too_much(where, "values of an attribute", most_values);
    if (!to.lines.empty() || !from.lines.empty()) {
      to.lines.resize(first_value);
      to.lines.insert(to.lines.end(), from.lines.begin(), from.lines.end());
      to.lines.resize(first_value + from.values.size() / from.components);
    }
    if (from.name == normal_attribute && from.components == 3 && style.placement.linear != glm::dmat3(1))
      for (std::size_t k = 0; k + 2 < from.values.size(); k += 3) {
        const glm::dvec3 n = turned * glm::dvec3(from.values[k], from.values[k + 1], from.values[k + 2]);
        for (int axis = 0; axis < 3; ++axis)
          if (std::abs(n[axis]) <= largest_value) from.values[k + static_cast<std::size_t>(axis)] = n[axis];
      }
    to.values.insert(to.values.end(), from.values.begin(), from.values.end());
    to.of_point.resize(first_point, no_value);
    for (const std::int32_t value : from.of_point)
      to.of_point.push_back(value == no_value ? no_value : first_value + value);
    for (const auto& [polygon, point, value] : from.own)
      to.own.push_back({first_polygon + polygon, first_point + point, first_value + value});
  }
  for (VertexAttribute& attribute : scene.attributes)
    attribute.of_point.resize(scene.points.size() + soup.points.size(), no_value);
}

/// Makes the numbers of the soup's textures those of the scene.
void SceneBuilder::add_textures(PolygonSoup& soup, const std::string& where) {
  std::vector<Texture>& known = file_.scene.textures;
  std::int64_t left = most_texels;
  for (const Texture& texture : known) left -= std::ssize(texture.texels);
  std::vector<std::int32_t> number_of;
  for (Texture& texture : soup.textures) {
    const auto found = std::find(known.begin(), known.end(), texture);
    const bool fits = std::ssize(known) < most_textures && std::ssize(texture.texels) <= left;
    number_of.push_back(found != known.end() || fits ? index32(static_cast<std::size_t>(found - known.begin()))
                                                     : no_texture);
    if (found != known.end()) continue;
    if (!fits) {
      file_.notes.push_back(fmt::format("{}: {} is left out: a scene has up to {} textures, of {} texels together",
                                        where, texture.source, most_textures, most_texels));
      continue;
    }
    left -= std::ssize(texture.texels);
    known.push_back(std::move(texture));
  }
  for (Material& material : soup.materials)
    material.texture = material.texture >= 0 && material.texture < std::ssize(number_of)
                           ? number_of[static_cast<std::size_t>(material.texture)]
                           : no_texture;
}

void SceneBuilder::add(PolygonSoup soup, const std::string& where, const Style& style) {
  check_limits(soup, where);
  cut_ = too_few_corners_ = no_area_ = 0;
  Scene& scene = file_.scene;
  const auto first_point = size32(scene.points);
  const bool mirrored = glm::determinant(style.placement.linear) < 0;
  scene.polygons.reserve(scene.polygons.size() + soup.outlines.size());
  scene.facets.reserve(scene.facets.size() + soup.outlines.size());
  scene.corners.reserve(scene.corners.size() + soup.corners.size());
  add_attributes(soup, where, style);
  add_textures(soup, where);
  add_points(soup, where, style);
  for (std::string& note : soup.notes) file_.notes.push_back(std::move(note));

  for (std::size_t k = 0; k < soup.outlines.size(); ++k) {
    Polygon polygon;
    if (!soup.names.empty()) polygon.name = std::move(soup.names[k]);
    const std::int32_t line = soup.outline_lines.empty() ? 0 : soup.outline_lines[k];
    polygon.source_line = style.line > 0 ? style.line : line;

    const auto corners = soup.corners_of(soup.outlines[k]);
    ring_.clear();  // without corners that stand twice in a row
    for (const std::int32_t corner : corners)
      if (ring_.empty() || ring_.back() != corner) ring_.push_back(corner);
    while (ring_.size() > 1 && ring_.back() == ring_.front()) ring_.pop_back();
    if (mirrored) std::reverse(ring_.begin() + (ring_.empty() ? 0 : 1), ring_.end());

    const glm::dvec3 normal = newell_normal(soup.points, ring_);
    if (!soup.colors.empty() && soup.colors[k]) polygon.color = *soup.colors[k];
    else if (style.bare == Bare::shaded) polygon.color = shaded(style.bare_color, normal);
    else polygon.color = palette[scene.polygons.size() % palette.size()];
    const bool is_shaded = style.bare == Bare::shaded && (soup.colors.empty() || !soup.colors[k]);
    file_.unlit_colors.push_back(is_shaded ? style.bare_color : polygon.color);

    polygon.material = style.material.over(soup.materials.empty() ? Material{} : soup.materials[k]);
    const auto id = size32(scene.polygons);
    for (std::int32_t& corner : ring_) corner += first_point;
    const std::size_t facets = scene.facets.size();
    add_facets(ring_, id, where, line);
    if (ring_.size() >= 3 && !has_area(scene, facets)) ++no_area_;
    scene.polygons.push_back(std::move(polygon));
  }

  if (cut_ > 0 && !style.open)
    file_.notes.push_back(fmt::format("{}: {} not planar and cut into triangles", where, polygons_are(cut_)));
  if (too_few_corners_ > 0)
    file_.notes.push_back(fmt::format("{}: {} not drawn, having fewer than three different corners", where,
                                      polygons_are(too_few_corners_)));
  if (no_area_ > 0) {
    // In screen coordinates the Z-buffer walks its edges, and which pixels of a border it draws is a matter of
    // coverage.
    const bool screen = scene.camera.kind == Camera::Kind::screen;
    file_.notes.push_back(fmt::format("{}: {} {}", where, polygons_are(no_area_),
                                      screen ? "without area; nothing is drawn there but pixels of a border, where the "
                                               "coverage counts them"
                                             : "not drawn, enclosing no area"));
  }
  if (!style.open && scene.camera.kind != Camera::Kind::screen) note_topology(soup, where, style);
}

void SceneBuilder::add_facets(std::span<const std::int32_t> corners, std::int32_t polygon, const std::string& where,
                              std::int32_t line) {
  Scene& scene = file_.scene;
  if (corners.size() < 3) {
    ++too_few_corners_;
    return;
  }
  const auto append = [&](std::span<const std::int32_t> piece) {
    if (static_cast<std::int64_t>(scene.corners.size() + piece.size()) > most_corners)
      PolygonSoup::too_much(at_line(where, line), "corners", most_corners);
    scene.facets.push_back({polygon, size32(scene.corners), size32(piece)});
    scene.corners.insert(scene.corners.end(), piece.begin(), piece.end());
  };
  if (is_planar(scene.points, corners)) return append(corners);
  ++cut_;
  triangles_.clear();
  if (!clipper_.cut(scene.points, corners, triangles_))
    throw InputError(at_line(where, line),
                     "polygons that are not planar have too many corners to cut them into triangles",
                     "triangulate the mesh in a modelling program");
  for (std::size_t i = 0; i < triangles_.size(); i += 3) append(std::span(triangles_).subspan(i, 3));
}

SceneFile SceneBuilder::finish() {
  std::vector<Polygon>& polygons = file_.scene.polygons;
  if (polygons.size() <= 26) {
    std::set<std::string> taken;
    for (const Polygon& polygon : polygons) taken.insert(*polygon.name);
    char letter = 'A';
    for (Polygon& polygon : polygons) {
      if (!polygon.name->empty()) continue;
      while (taken.count(std::string(1, letter)) > 0) ++letter;  // 26 letters suffice for 26 polygons
      polygon.name = std::string(1, letter++);
    }
  }
  return std::move(file_);
}

}  // namespace zstep::scene
