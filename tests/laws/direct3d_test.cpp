// Coverage as Direct3D publishes it, under its conventions (`zstep header --like direct3d`).
//
// Two pages of Microsoft's have figures. "Rasterization Rules (Direct3D 9)" gives the corners of its triangles and how
// many pixels they get in its text; its pixel centres are at integers. The figure of "Rasterization Rules" of Direct3D
// 10 and 11 has no numbers beside it: the corners and counts below are as a test bench of a GPU (FPGAGPUTesting,
// D3DTriRasterizeTestData.h) read them off. Which pixels these are neither of them says: those in the tables follow
// from the rule by hand. The rest is the rule of the Direct3D 11.3 functional specification (3.4.1, 3.4.2.1) itself,
// said once more in whole 256ths of a pixel.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "tests/sparse.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/check/check.hpp"
#include "traces/file/trace.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;

namespace {

/// Corners in 256ths of a pixel, the centre of pixel (0, 0) being (128, 128).
using Triangle = std::array<std::pair<std::int64_t, std::int64_t>, 3>;
constexpr std::int64_t parts = 256, half = parts / 2;

Triangle triangle(std::array<std::pair<double, double>, 3> corners, double centre) {
  Triangle made;
  for (std::size_t i = 0; i < made.size(); ++i)
    made[i] = {static_cast<std::int64_t>((corners[i].first - centre) * parts) + half,
               static_cast<std::int64_t>((corners[i].second - centre) * parts) + half};
  return made;
}

/// The pixels that a triangle owns, row by row: "(1, 1) (2, 1)".
std::string owned(const Picture& picture, std::int32_t polygon) {
  std::string pixels;
  for (std::int32_t y = 0; y < picture.height; ++y)
    for (std::int32_t x = 0; x < picture.width; ++x)
      if (picture.polygon[picture.at(x, y)] == polygon) pixels += fmt::format("({}, {}) ", x, y);
  return pixels;
}

/// The same by the specification: a centre on an edge is inside if the edge is a top or a left one.
std::string owned_by_rule(Triangle t, std::int32_t width, std::int32_t height) {
  const auto side = [](const auto& a, const auto& b, std::int64_t x, std::int64_t y) {
    return (b.first - a.first) * (y - a.second) - (b.second - a.second) * (x - a.first);
  };
  const std::int64_t area = side(t[0], t[1], t[2].first, t[2].second);
  if (area == 0) return "";
  if (area < 0) std::swap(t[1], t[2]);  // clockwise as it is seen
  std::string pixels;
  for (std::int32_t y = 0; y < height; ++y)
    for (std::int32_t x = 0; x < width; ++x) {
      bool inside = true;
      for (std::size_t i = 0; i < t.size(); ++i) {
        const auto &a = t[i], &b = t[(i + 1) % t.size()];
        const bool is_top = a.second == b.second && a.first < b.first, is_left = b.second < a.second;
        const std::int64_t at = side(a, b, parts * x + half, parts * y + half);
        inside = inside && (at > 0 || (at == 0 && (is_top || is_left)));
      }
      if (inside) pixels += fmt::format("({}, {}) ", x, y);
    }
  return pixels;
}

struct Way {
  const char* method;
  std::map<std::string, std::string> options;
};
const std::vector<Way> ways{{"z-buffer", {}},
                            {"half-space", {}},
                            {"half-space", {{"stepping", "increments"}}},
                            {"half-space", {{"stepping", "increments"}, {"tiles", "8"}}},
                            {"half-space", {{"hierarchical-z", "on"}}}};

/// Draws triangles of one depth each, none of which lies on another, as Direct3D has it, their corners on the raster
/// already; check doubts none of it.
template <class Check>
void each_picture(const std::vector<Triangle>& triangles, std::int32_t width, std::int32_t height, Check&& check_it) {
  std::vector<std::vector<glm::dvec3>> polygons;
  for (const Triangle& t : triangles) {
    std::vector<glm::dvec3>& corners = polygons.emplace_back();
    for (const auto& [x, y] : t)
      corners.emplace_back(static_cast<double>(x - half) / parts, static_cast<double>(y - half) / parts, 0.5);
  }
  const Scene scene = test::screen_scene(width, height, polygons);
  for (const Way& way : ways)
    for (const auto format : {NumberFormat::float64, NumberFormat::float32}) {
      CAPTURE(way.method);
      CAPTURE(way.options.size());
      CAPTURE(word_of(format));
      Conventions conventions;
      conventions.number_format = format;
      conventions.options = way.options;
      const Method& method = zstep::method(way.method);
      check_run(method, scene, conventions);
      Header header = header_for(method, conventions);
      header.written.centre = WrittenAs::Centre::half;
      TraceRecorder recorder(header, scene);
      method.record(scene, conventions, recorder);
      recorder.finish();
      const Trace run = Trace::from_bytes(recorder.take_bytes(), way.method);
      CHECK(check(run).causes.empty());
      check_it(formulas::end_of(run).picture);
    }
}

struct Figure {
  std::array<std::pair<double, double>, 3> corners;
  int count;
  std::string pixels;
};

void hold_against(const std::vector<Figure>& figures, double centre, std::int32_t width, std::int32_t height) {
  std::vector<Triangle> triangles;
  for (const Figure& figure : figures) triangles.push_back(triangle(figure.corners, centre));
  each_picture(triangles, width, height, [&](const Picture& picture) {
    for (std::size_t i = 0; i < figures.size(); ++i) {
      CAPTURE(i);
      const std::string pixels = owned(picture, static_cast<std::int32_t>(i));
      CHECK(std::count(pixels.begin(), pixels.end(), '(') == figures[i].count);
      CHECK(pixels == figures[i].pixels);
      CHECK(pixels == owned_by_rule(triangles[i], width, height));
    }
  });
}

}  // namespace

TEST_SUITE("direct3d") {
  TEST_CASE("of a square cut in two the figure of Direct3D 9 gives 15 pixels to one triangle, 10 to the other") {
    hold_against(
        {{{{{0, 0}, {5, 0}, {5, 5}}},
          15,
          "(0, 0) (1, 0) (2, 0) (3, 0) (4, 0) (1, 1) (2, 1) (3, 1) (4, 1) (2, 2) (3, 2) (4, 2) (3, 3) (4, 3) "
          "(4, 4) "},
         {{{{0, 5}, {0, 0}, {5, 5}}}, 10, "(0, 1) (0, 2) (1, 2) (0, 3) (1, 3) (2, 3) (0, 4) (1, 4) (2, 4) (3, 4) "}},
        0, 8, 8);
  }

  TEST_CASE("of a rectangle cut in four, and of the same half a pixel on, the figures have the same eight pixels") {
    const auto four = [](double x, double y) {
      const std::pair<double, double> a{x, y}, b{x + 2, y}, c{x + 2, y + 4}, d{x, y + 4}, middle{x + 1, y + 2};
      return std::array<std::array<std::pair<double, double>, 3>, 4>{
          {{a, b, middle}, {b, c, middle}, {c, d, middle}, {d, a, middle}}};
    };
    const auto clear = four(0.5, 0.5), on_edges = four(1, 1);
    hold_against({{clear[0], 2, "(1, 1) (2, 1) "},
                  {clear[1], 2, "(2, 2) (2, 3) "},
                  {clear[2], 2, "(1, 4) (2, 4) "},
                  {clear[3], 2, "(1, 2) (1, 3) "}},
                 0, 6, 6);
    hold_against({{on_edges[0], 3, "(1, 1) (2, 1) (2, 2) "},
                  {on_edges[1], 1, "(2, 3) "},
                  {on_edges[2], 1, "(2, 4) "},
                  {on_edges[3], 3, "(1, 2) (1, 3) (1, 4) "}},
                 0, 6, 6);
  }

  TEST_CASE("the triangles of the figure of Direct3D 10 and 11 cover the pixels that it shows") {
    hold_against(
        {{{{{1, 1}, {2, 4}, {6, 2}}}, 7, "(1, 1) (2, 1) (1, 2) (2, 2) (3, 2) (4, 2) (2, 3) "},
         {{{{4.5, 0.5}, {4.5, 0.5}, {4.5, 0.5}}}, 0, ""},
         {{{{5.25, 1.25}, {6.25, 1.25}, {6.25, 0.25}}}, 0, ""},
         {{{{6.5, 1.5}, {7.5, 1.5}, {7.5, 0.5}}}, 0, ""},  // a centre at each vertex
         {{{{11.5, 4.5}, {11.5, 6.5}, {12.5, 5.5}}}, 1, "(11, 5) "},
         {{{{9.5, 7.5}, {9.5, 9.5}, {10.5, 7.5}}}, 1, "(9, 7) "},  // and on below the raster
         {{{{13.5, 5.5}, {13.5, 7.5}, {15.5, 5.5}}}, 3, "(13, 5) (14, 5) (13, 6) "},
         {{{{15.5, 5.5}, {13.5, 7.5}, {15.5, 7.5}}}, 1, "(14, 6) "},
         {{{{15, 0}, {13.5, 1.5}, {14.5, 2.5}}}, 3, "(14, 0) (13, 1) (14, 1) "},
         {{{{14.5, 2.5}, {13.5, 1.5}, {14.5, 4.5}}}, 0, ""},
         {{{{9.75, 0.75}, {7.75, 2.5}, {11.75, 2.5}}}, 2, "(9, 1) (10, 1) "},
         {{{{11.75, 2.5}, {7.75, 2.5}, {9.5, 5.25}}}, 8, "(8, 2) (9, 2) (10, 2) (11, 2) (8, 3) (9, 3) (10, 3) (9, 4) "},
         {{{{7, 4}, {1, 6}, {5, 6}}}, 4, "(5, 4) (2, 5) (3, 5) (4, 5) "},  // three that share a vertex
         {{{{7, 4}, {5, 6}, {8, 7}}}, 5, "(6, 4) (5, 5) (6, 5) (6, 6) (7, 6) "},
         {{{{7, 4}, {8, 7}, {9.5, 5.5}}}, 3, "(7, 4) (7, 5) (8, 5) "}},
        0.5, 16, 8);
  }

  TEST_CASE("law: triangles with corners in 256ths of a pixel cover what the specification's rule says") {
    std::mt19937_64 random(1108);
    constexpr std::int32_t width = 11, height = 9;
    for (const std::int64_t grid : {std::int64_t{1}, std::int64_t{64}, half})
      for (int round = 0; round < 60 / test::sparse; ++round) {
        Triangle t;
        for (auto& [x, y] : t) {
          x = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>((width + 4) * parts / grid)) * grid;
          y = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>((height + 4) * parts / grid)) * grid;
          x -= 2 * parts, y -= 2 * parts;
        }
        CAPTURE(grid);
        CAPTURE(round);
        each_picture({t}, width, height,
                     [&](const Picture& picture) { CHECK(owned(picture, 0) == owned_by_rule(t, width, height)); });
      }
  }
}
