#include "tests/laws/degenerate_scenes.hpp"

#include <algorithm>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "tests/unit/algorithms/floating_horizon/surfaces.hpp"

namespace zstep::test {

namespace {

constexpr int side = 13;

std::string polygon(const std::string& points) { return "[[polygon]]\npoints = [" + points + "]\n"; }

// Two rectangles in the plane y = 0.
Degenerate coplanar() {
  Degenerate input{"coplanar", polygon("[-5.5, 0, -3.5], [0.5, 0, -3.5], [0.5, 0, 1.5], [-5.5, 0, 1.5]") +
                                   polygon("[-1.5, 0, -1.5], [4.5, 0, -1.5], [4.5, 0, 3.5], [-1.5, 0, 3.5]")};
  input.layers = {{{3, ""}, {2, ".....BBBBBB.."}, {3, ".AAAAAABBBB.."}, {2, ".AAAAAA......"}},
                  {{5, ""}, {3, ".....BB......"}}};
  input.tie = Tie::same_numbers;
  input.lines = {8, 8, 0, 44, 44};
  return input;
}

// The same in the plane y = -0.3 x: the left one reaches farther.
Degenerate coplanar_slanting() {
  Degenerate input = coplanar();
  input.name = "coplanar, slanting";
  input.polygons = polygon("[-5.5, 1.65, -3.5], [0.5, -0.15, -3.5], [0.5, -0.15, 1.5], [-5.5, 1.65, 1.5]") +
                   polygon("[-1.5, 0.45, -1.5], [4.5, -1.35, -1.5], [4.5, -1.35, 3.5], [-1.5, 0.45, 3.5]");
  input.painted = {{3, ""}, {2, ".....BBBBBB.."}, {3, ".AAAABBBBBB.."}, {2, ".AAAAAA......"}};
  input.tie = Tie::rounding;
  return input;
}

// Three times the same.
Degenerate duplicate() {
  const std::string once = polygon("[-3.5, 1.05, -2.5], [3.5, -1.05, -2.5], [3.5, -1.05, 2.5], [-3.5, 1.05, 2.5]");
  Degenerate input{"duplicate", once + once + once};
  input.layers = {{{4, ""}, {5, "...AAAAAAA..."}}, {{4, ""}, {5, "...BBBBBBB..."}}, {{4, ""}, {5, "...CCCCCCC..."}}};
  input.tie = Tie::same_numbers;
  input.lines = {12, 12, 0, 72, 72};
  return input;
}

// A face and its back, which share their edges.
Degenerate both_ways_round() {
  Degenerate input{"duplicate, the other way round",
                   polygon("[-3.5, 1.05, -2.5], [3.5, -1.05, -2.5], [3.5, -1.05, 2.5], [-3.5, 1.05, 2.5]") +
                       polygon("[-3.5, 1.05, 2.5], [3.5, -1.05, 2.5], [3.5, -1.05, -2.5], [-3.5, 1.05, -2.5]")};
  input.layers = {{{4, ""}, {5, "...AAAAAAA..."}}, {{4, ""}, {5, "...BBBBBBB..."}}};
  input.tie = Tie::seen_by_rays;
  input.lines = {4, 4, 0, 24, 24};
  return input;
}

// Four bars, each over the next: B over A, C over B, D over C, A over D.
Degenerate ring() {
  Degenerate input{"ring", polygon("[-5.5, -1.1, 1.5], [5.5, 1.1, 1.5], [5.5, 1.1, 3.5], [-5.5, -1.1, 3.5]") +
                               polygon("[1.5, 1.1, -5.5], [3.5, 1.1, -5.5], [3.5, -1.1, 5.5], [1.5, -1.1, 5.5]") +
                               polygon("[-5.5, 1.1, -3.5], [5.5, -1.1, -3.5], [5.5, -1.1, -1.5], [-5.5, 1.1, -1.5]") +
                               polygon("[-3.5, -1.1, -5.5], [-1.5, -1.1, -5.5], [-1.5, 1.1, 5.5], [-3.5, 1.1, 5.5]")};
  const std::pair<int, std::string> upright{2, "...DD...BB..."};
  input.layers = {{{1, ""}, upright, {2, ".AAAAAAABBAA."}, {3, upright.second}, {2, ".CCDDCCCCCCC."}, upright},
                  {{3, ""}, {2, "...DD...AA..."}, {3, ""}, {2, "...CC...BB..."}}};
  input.painted = {{1, ""}, upright, {2, ".AAAAAAAAAAA."}, {3, upright.second}, {2, ".CCCCCCCBBCC."}, upright};
  input.lines = {16, 24, 8, 104, 88};
  return input;
}

// Through each other at x = 0.25.
Degenerate intersecting() {
  Degenerate input{"intersecting",
                   polygon("[-5.5, -1.65, -3.5], [5.5, 1.65, -3.5], [5.5, 1.65, 1.5], [-5.5, -1.65, 1.5]") +
                       polygon("[-5.5, 1.8, -1.5], [5.5, -1.5, -1.5], [5.5, -1.5, 3.5], [-5.5, 1.8, 3.5]")};
  input.layers = {{{3, ""}, {2, ".BBBBBBBBBBB."}, {3, ".AAAAAABBBBB."}, {2, ".AAAAAAAAAAA."}},
                  {{5, ""}, {3, ".BBBBBBAAAAA."}}};
  input.painted = {{3, ""}, {2, ".BBBBBBBBBBB."}, {5, ".AAAAAAAAAAA."}};
  input.lines = {8, 8, 2, 64, 53};
  return input;
}

// The first contains the eye, the light and a column of pixel centres. Two of its edges are points.
Degenerate edge_on() {
  Degenerate input{"edge-on", polygon("[0, -2, -3.5], [0, 2, -3.5], [0, 2, 3.5], [0, -2, 3.5]") +
                                  polygon("[-3.5, 3, -2.5], [3.5, 3, -2.5], [3.5, 3, 2.5], [-3.5, 3, 2.5]")};
  input.layers = {{{4, ""}, {5, "...BBBBBBB..."}}};
  input.lines = {6, 6, 0, 38, 38};
  return input;
}

// A line, a point, a way there and back.
Degenerate zero_area() {
  Degenerate input{"zero area", polygon("[-6.5, -1, 4], [0, -1, 4], [6.5, -1, 4]") +
                                    polygon("[2, -1, 0], [2, -1, 0], [2, -1, 0]") +
                                    polygon("[-6, -1, -4], [-2, -1, 3], [-6, -1, -4], [-2, -1, 3]") +
                                    polygon("[-3.5, 0, -2.5], [3.5, 0, -2.5], [3.5, 0, 2.5], [-3.5, 0, 2.5]")};
  input.layers = {{{4, ""}, {5, "...DDDDDDD..."}}};
  input.lines = {4, 4, 0, 24, 24};
  return input;
}

// A roof whose ridge goes from the lower right to the upper left, through the plane y = 0.
Degenerate not_planar() {
  Degenerate input{"non-planar", polygon("[-3.5, 0.8, -2.5], [3.5, -0.8, -2.5], [3.5, 0.8, 2.5], [-3.5, -0.8, 2.5]") +
                                     polygon("[-5.5, 0, -3.5], [5.5, 0, -3.5], [5.5, 0, 3.5], [-5.5, 0, 3.5]")};
  const std::string wall = ".BBBBBBBBBBB.";
  input.layers = {{{3, ""},
                   {1, wall},
                   {1, ".BBAAAABBBBB."},
                   {1, ".BBAAAAAABBB."},
                   {1, ".BBAAAAAAABB."},
                   {1, ".BBBAAAAAABB."},
                   {1, ".BBBBBAAAABB."},
                   {1, wall}},
                  {{4, ""},
                   {1, "...BBBBAAA..."},
                   {1, "...BBBBBBA..."},
                   {1, "...BBBBBBB..."},
                   {1, "...ABBBBBB..."},
                   {1, "...AAABBBB..."}}};
  input.painted = {{3, ""}, {7, wall}};
  input.lines = {8, 8, 4, 60, 48};
  return input;
}

// A U, and a bar through its left wall, its notch and its right wall.
Degenerate concave() {
  Degenerate input{"concave", polygon("[-5.5, 0, -3.5], [5.5, 0, -3.5], [5.5, 0, 3.5], [1.5, 0, 3.5], [1.5, 0, -1.5], "
                                      "[-1.5, 0, -1.5], [-1.5, 0, 3.5], [-5.5, 0, 3.5]") +
                                  polygon("[-6.5, -1.3, 0.5], [6.5, 1.3, 0.5], [6.5, 1.3, 2.5], [-6.5, -1.3, 2.5]")};
  const std::string walls = ".AAAA...AAAA.", base = ".AAAAAAAAAAA.";
  input.layers = {{{3, ""}, {1, walls}, {2, "BBBBBBBBAAAAB"}, {2, walls}, {2, base}}, {{4, ""}, {2, ".AAAA...BBBB."}}};
  input.painted = {{3, ""}, {1, walls}, {2, "BAAAABBBAAAAB"}, {2, walls}, {2, base}};
  input.lines = {12, 16, 4, 76, 64};
  return input;
}

// Two rectangles round which the outline runs in opposite ways.
Degenerate crossing_itself() {
  Degenerate input{
      "crossing itself, unequal parts",
      polygon("[-5.5, 0, -3.5], [0.5, 0, -3.5], [0.5, 0, 2.5], [5.5, 0, 2.5], [5.5, 0, -0.5], [-5.5, 0, -0.5]")};
  input.layers = {{{4, ""}, {3, ".......AAAAA."}, {3, ".AAAAAA......"}}};
  input.lines = {6, 6, 0, 34, 34};
  return input;
}

// Cut into the triangles left of the upper diagonal and above the lower one: three quarters of its box, one of them
// twice.
Degenerate bow_tie() {
  Degenerate input{"crossing itself, equal parts",
                   polygon("[-4.25, 0, -2.4], [4.75, 0, 2.6], [4.75, 0, -2.4], [-4.25, 0, 2.6]")};
  input.layers = {{{4, ""}, {3, "..AAAAAAAAA.."}, {1, "..AAA....AA.."}, {1, "..A.........."}},
                  {{4, ""}, {1, "...AAAAAAA..."}, {1, ".....AAA....."}}};
  input.tie = Tie::same_numbers;
  input.lines = {4, 4, 0, 30.59126028, 30.59126028};
  return input;
}

Degenerate one() {
  Degenerate input{"one", polygon("[-3.5, 1, -2.5], [3.5, -1, -2.5], [3.5, -1, 2.5], [-3.5, 1, 2.5]")};
  input.layers = {{{4, ""}, {5, "...AAAAAAA..."}}};
  input.lines = {4, 4, 0, 24, 24};
  return input;
}

Degenerate none() {
  Degenerate input{"none", ""};
  input.layers = {{}};
  return input;
}

}  // namespace

const std::vector<Degenerate>& degenerate_inputs() {
  static const std::vector<Degenerate> inputs{
      coplanar(),  coplanar_slanting(), duplicate(), both_ways_round(), ring(),    intersecting(), edge_on(),
      zero_area(), not_planar(),        concave(),   crossing_itself(), bow_tie(), one(),          none()};
  return inputs;
}

const std::vector<DegenerateSurface>& degenerate_surfaces() {
  static const std::vector<DegenerateSurface> surfaces = [] {
    const std::string blank(8, '.'), line = ".#####..";
    Scene none = surface_of({{}}), twice = surface_of({{1, 2, {5, 2, 5}}, {1, 2, {5, 2, 5}}});
    none.surface.reset();
    std::copy_n(twice.points.begin(), 3, twice.points.begin() + 3);
    const std::vector<std::string> hat{blank, blank, "...#....", "...##...", "..#.##..", ".#...#..", blank, blank};
    return std::vector<DegenerateSurface>{
        {"none", none, std::vector(8, blank)},
        {"one row", surface_of({{1, 2, {5, 2, 5}}}), hat},
        {"one column", surface_of({{1, 2, {4}}, {1, 2, {2}}}), std::vector(8, blank)},
        {"one cell",
         surface_of({{1, 4, {5, 5}}, {1, 4, {3, 3}}}),
         {blank, blank, blank, line, blank, line, blank, blank}},
        {"coplanar cells",
         surface_of({{1, 2, {6, 6, 6}}, {1, 2, {4, 4, 4}}, {1, 2, {2, 2, 2}}}),
         {blank, blank, line, blank, line, blank, line, blank}},
        {"coplanar cells, edge-on",
         surface_of({{1, 4, {4, 4}}, {1, 4, {4, 4}}, {1, 4, {4, 4}}}),
         {blank, blank, blank, blank, line, blank, blank, blank}},
        {"the same row twice: cells without area", twice, hat},
        {"a cell that is not planar",
         surface_of({{1, 4, {2, 6}}, {1, 4, {6, 2}}}),
         {blank, blank, ".#...#..", "..#.#...", "...o....", "..o.#...", ".o...#..", blank}},
        {"a curve edge-on between two columns",
         surface_of({{3.25, 0, {5, 3, 2}}}),
         {blank, blank, "...#....", "...#....", "...#....", "...#....", blank, blank}}};
  }();
  return surfaces;
}

Scene degenerate_scene(const std::string& polygons, Camera::Kind kind) {
  const bool none = polygons.empty(), parallel = kind == Camera::Kind::orthographic;
  const std::string text =
      "[raster]\nwidth = 13\nheight = 13\n[camera]\ntarget = [0, 0, 0]\nwindow = 6.5\nnear = 1\nfar = 1100\n" +
      std::string(parallel ? "eye = [0, -20, 0]\northographic = true\n" : "eye = [0, -1000, 0]\nd = 1000\n") +
      (none ? polygon("[0, 0, 0], [1, 0, 0], [0, 0, 1]") : polygons);
  SceneFile file =
      scene::read_scene(text, "degenerate.toml", "degenerate", [](const std::string&) { return scene::PolygonSoup{}; });
  if (none) file.scene.polygons.clear(), file.scene.facets.clear(), file.scene.corners.clear();
  return look_at_scene(std::move(file.scene), {});
}

std::string letters_of(const Rows& layer) {
  std::string letters;
  for (const auto& [times, row] : layer)
    for (int i = 0; i < times; ++i) letters += row.empty() ? std::string(side, '.') : row;
  letters.resize(side * side, '.');
  return letters;
}

std::string letters_of(const Picture& picture) {
  std::string letters;
  for (const std::int32_t polygon : picture.polygon)
    letters += polygon == no_polygon ? '.' : static_cast<char>('A' + polygon);
  return letters;
}

}  // namespace zstep::test
