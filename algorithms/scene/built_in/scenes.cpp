// The built-in scenes, written as a user would write them (docs/scene-format.md).

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <initializer_list>

#include "algorithms/scene/built_in/built_in.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

namespace {

std::string no_place() { return "built-in mesh"; }

PolygonSoup solid(std::initializer_list<glm::dvec3> points,
                  std::initializer_list<std::initializer_list<int>> outlines) {
  PolygonSoup soup;
  soup.points = points;
  for (const auto& outline : outlines) {
    for (const int corner : outline) soup.add_corner(corner, no_place);
    soup.close_outline(0, std::nullopt, no_place);
  }
  return soup;
}

PolygonSoup cube_solid() {
  return solid({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
               {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}, {3, 2, 1, 0}});
}

PolygonSoup pyramid_solid() {
  return solid({{1, 1, -1}, {-1, 1, -1}, {-1, -1, -1}, {1, -1, -1}, {0, 0, 1}},
               {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {3, 2, 1, 0}});
}

/// Twelve pentagons, their planes perpendicular to the directions of an icosahedron's corners (0, ±g, ±1), (±g, ±1, 0),
/// (±1, 0, ±g). The corners: those of a cube and (0, ±1/g, ±g), (±1/g, ±g, 0), (±g, 0, ±1/g), g the golden ratio.
PolygonSoup dodecahedron_solid() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  PolygonSoup soup;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) soup.points.push_back({x, y, z});
  std::vector<glm::dvec3> directions;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      for (const glm::dvec3 p : {glm::dvec3(0, a / g, b * g), glm::dvec3(a / g, b * g, 0), glm::dvec3(b * g, 0, a / g)})
        soup.points.push_back(p);
      for (const glm::dvec3 n : {glm::dvec3(0, b * g, a), glm::dvec3(b * g, a, 0), glm::dvec3(a, 0, b * g)})
        directions.push_back(n);
    }
  for (const glm::dvec3 n : directions) {
    std::vector<std::int32_t> ring;  // the five corners furthest out in this direction
    for (std::size_t i = 0; i < soup.points.size(); ++i)
      if (glm::dot(soup.points[i], n) > 2.5) ring.push_back(index32(i));
    const glm::dvec3 middle = n * (glm::dot(soup.points[ring[0]], n) / glm::dot(n, n));
    const glm::dvec3 u = soup.points[ring[0]] - middle, v = glm::cross(n, u) / glm::length(n);
    std::sort(ring.begin(), ring.end(), [&](std::int32_t a, std::int32_t b) {
      const auto angle = [&](std::int32_t i) {
        const glm::dvec3 p = soup.points[i] - middle;
        const double turn = portable::atan2(glm::dot(p, v), glm::dot(p, u));
        return turn < -1e-9 ? turn + 7 : turn;
      };
      return angle(a) < angle(b);
    });
    for (const std::int32_t corner : ring) soup.add_corner(corner, no_place);
    soup.close_outline(0, std::nullopt, no_place);
  }
  return soup;
}

}  // namespace

std::vector<std::string_view> built_in_meshes() { return {"cube", "pyramid", "dodecahedron", "teapot"}; }

std::optional<PolygonSoup> built_in_mesh(const std::string& name, const std::string& where) {
  if (name == "cube") return cube_solid();
  if (name == "pyramid") return pyramid_solid();
  if (name == "dodecahedron") return dodecahedron_solid();
  if (const auto level = teapot_level(name, where)) return teapot(*level);
  return std::nullopt;
}

namespace {

constexpr std::string_view pyramid =
    R"(# A pyramid with a square base: five corners, five polygons, counter-clockwise seen from
# outside. The program skeleton of Eckert's lecture 21 (Binghamton University, 2001) draws one; these are its arrays
# w_pts and polys with numbers filled in.
name = "pyramid"
points = [[1, 1, -1], [-1, 1, -1], [-1, -1, -1], [1, -1, -1], [0, 0, 1]]

[raster]
width = 32
height = 32

[camera]
rho = 5
theta = 30
phi = 60
d = 2.5

[[polygon]]
name = "A"
corners = [0, 1, 4]

[[polygon]]
name = "B"
corners = [1, 2, 4]

[[polygon]]
name = "C"
corners = [2, 3, 4]

[[polygon]]
name = "D"
corners = [3, 0, 4]

[[polygon]]
name = "E"
corners = [3, 2, 1, 0]
)";

constexpr std::string_view pyramid_behind =
    R"(# The pyramid, and behind it a card that is drawn twice: F before the pyramid, G after it,
# at exactly the same place. Every outcome of the compare happens: F wins against nothing, the pyramid wins against F,
# G fails behind the pyramid, and beside it G ties with F, so that F stays.
name = "pyramid-behind"
points = [
  [1, 1, -1], [-1, 1, -1], [-1, -1, -1], [1, -1, -1], [0, 0, 1],  # the pyramid
  [-1, -2, -0.5], [-1, 2, -1], [-1.5, 0, 1.5],                     # the card
]

[raster]
width = 32
height = 32

[camera]
rho = 6
theta = 30
phi = 60
d = 2.5

[[polygon]]
name = "F"
color = "blue"
corners = [5, 6, 7]

[[polygon]]
name = "A"
color = "orange"
corners = [0, 1, 4]

[[polygon]]
name = "B"
color = "sky blue"
corners = [1, 2, 4]

[[polygon]]
name = "C"
color = "green"
corners = [2, 3, 4]

[[polygon]]
name = "D"
color = "yellow"
corners = [3, 0, 4]

[[polygon]]
name = "E"
color = "grey"
corners = [3, 2, 1, 0]

[[polygon]]
name = "G"
color = "vermillion"
corners = [5, 6, 7]
)";

constexpr std::string_view foley =
    R"(# The polygon on which Foley, van Dam, Feiner and Hughes explain edge table and active edges
# ("Computer Graphics: Principles and Practice", 2nd edition, 1990, section 3.6).
name = "foley"
coordinates = "screen"

[raster]
width = 16
height = 14
y_axis = "up"

[[polygon]]
name = "A"
points = [[2, 3], [7, 1], [13, 5], [13, 11], [7, 7], [2, 9]]
)";

constexpr std::string_view delhi =
    R"(# The worked example of lecture 28 of Kalra's course (Indian Institute of Technology, Delhi): two
# triangles in a buffer of 8 x 8. The lecture gives the corners of the second; those of the first, all of depth 5, are
# reconstructed from the depth buffer that it shows. The second lies in the plane z = x + y + 1; where it is 5 as well,
# the first stays. The lecture's cells are the textbook's inclusive loop, x from the left edge to the right one.
name = "delhi"
coordinates = "screen"

[raster]
width = 8
height = 8
y_axis = "up"

[options]
coverage = "inclusive"

[[polygon]]
name = "A"
points = [[0, 7, 5], [6, 7, 5], [0, 1, 5]]

[[polygon]]
name = "B"
points = [[0, 6, 7], [5, 1, 7], [0, 1, 2]]
)";

constexpr std::string_view cyclic =
    R"(# Three triangles, each in front of the next and the last in front of the first: no order of drawing
# is right, but the Z-buffer needs none. With this camera x is to the right, y upwards and z towards the eye.
name = "cyclic"

[raster]
width = 32
height = 32

[camera]
rho = 8
theta = -90
phi = 0
d = 2

[[polygon]]
name = "A"
points = [[-2.5, -2.5, 1], [3, -1, -1], [-2.5, -0.5, 1]]

[[polygon]]
name = "B"
points = [[1.5, -2.5, 1], [3, -1.5, 1], [-0.5, 3, -1]]

[[polygon]]
name = "C"
points = [[1.5, 2, 1], [-0.5, 3, 1], [-2.5, -2, -1]]
)";

constexpr std::string_view intersecting =
    R"(# Two triangles that run through each other: A is nearer on the left, B on the right. With this
# camera x is to the right, y upwards and z towards the eye.
name = "intersecting"

[raster]
width = 32
height = 32

[camera]
rho = 6
theta = -90
phi = 0
d = 2

[[polygon]]
name = "A"
points = [[-2, -1.5, 1], [2, 0, -1], [-2, 1.5, 1]]

[[polygon]]
name = "B"
points = [[2, -1.5, 1], [2, 1.5, 1], [-2, 0, -1]]
)";

constexpr std::string_view cube = R"(# A cube of edge 2, a colour a side.
name = "cube"

[raster]
width = 32
height = 32

[camera]
rho = 5
theta = 30
phi = 60
d = 2

[[mesh]]
builtin = "cube"
)";

constexpr std::string_view dodecahedron = R"(# Twelve regular pentagons.
name = "dodecahedron"

[raster]
width = 64
height = 64

[camera]
rho = 5
theta = 20
phi = 65
d = 2

[[mesh]]
builtin = "dodecahedron"
)";

// {0}: the name, with its level where one is given
constexpr std::string_view teapot_at_level =
    R"(# Martin Newell's teapot (University of Utah, 1975). A level N after the name, as in teapot:12, cuts each of
# its 28 patches into N x N pieces.
name = "{0}"

[raster]
width = 640
height = 480

[camera]
rho = 3.2
theta = -60
phi = 68
d = 3.6

[[mesh]]
builtin = "{0}"
)";

struct Entry {
  BuiltIn about;
  std::string_view text;
};

constexpr std::array<Entry, 9> entries{{
    {{"pyramid", "a pyramid of five polygons, as in Eckert's lecture (32x32)"}, pyramid},
    {{"pyramid-behind", "the pyramid before a card: compares that win, fail and tie (32x32)"}, pyramid_behind},
    {{"foley", "one concave polygon in screen coordinates, Foley's for the edge table (16x14)"}, foley},
    {{"delhi", "two triangles in screen coordinates, the Delhi lecture's example (8x8)"}, delhi},
    {{"cyclic", "three triangles that overlap in a circle (32x32)"}, cyclic},
    {{"intersecting", "two triangles that run through each other (32x32)"}, intersecting},
    {{"cube", "a cube, a colour a side (32x32)"}, cube},
    {{"dodecahedron", "twelve regular pentagons (64x64)"}, dodecahedron},
    {{"teapot", "Newell's teapot; teapot:N cuts its patches into N x N (640x480)"}, teapot_at_level},
}};

}  // namespace

std::optional<std::string> built_in_scene(const std::string& name) {
  if (teapot_level(name, name.substr(0, 40))) return fmt::format(fmt::runtime(teapot_at_level), name);
  for (const Entry& entry : entries)
    if (entry.about.name == name) return std::string(entry.text);
  return std::nullopt;
}

std::span<const BuiltIn> built_in_scene_list() {
  static const auto list = [] {
    std::array<BuiltIn, entries.size()> about{};
    for (std::size_t i = 0; i < entries.size(); ++i) about[i] = entries[i].about;
    return about;
  }();
  return list;
}

}  // namespace zstep::scene
