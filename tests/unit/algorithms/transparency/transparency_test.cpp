// Transparency: colours mixed by hand, the orders that get them wrong, and every order of the file giving one picture.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/transparency/transparency.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

constexpr Color red{200, 0, 0}, green{0, 200, 0}, blue{0, 0, 200}, white{255, 255, 255};

Conventions in_order(const char* order) {
  Conventions conventions;
  conventions.options["order"] = order;
  return conventions;
}

/// Squares of side 4 that cover the raster, one after another in the file: their depths, colours and opacities.
struct Pane {
  double z;
  Color color;
  double opacity;
};
Scene panes(const std::vector<Pane>& all) {
  std::vector<std::vector<glm::dvec3>> squares;
  for (const Pane& pane : all) squares.push_back({{-1, -1, pane.z}, {5, -1, pane.z}, {5, 5, pane.z}, {-1, 5, pane.z}});
  Scene scene = test::screen_scene(4, 4, squares);
  scene.background = white;
  for (std::size_t i = 0; i < all.size(); ++i) {
    scene.polygons[i].color = all[i].color;
    scene.polygons[i].material = Material{all[i].opacity};
  }
  return scene;
}

Color seen(const Scene& scene, const char* order = "back-to-front") {
  NullRecorder nothing;
  const Picture picture = transparency::run(scene, in_order(order), nothing);
  const Color color = color_at(picture, scene, picture.at(2, 2));
  for (std::size_t pixel = 0; pixel < picture.polygon.size(); ++pixel) CHECK(color_at(picture, scene, pixel) == color);
  return color;
}

/// Random transparent and opaque triangles in the world, cutting through each other.
Scene soup(std::uint64_t seed, int count, double least_opacity) {
  test::Numbers random(seed);
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 a = random.in_box(1), b = random.in_box(1), c = random.in_box(1);
    test::add_polygon(scene, std::vector<glm::dvec3>{a, b, c});
    Polygon& polygon = scene.polygons.back();
    const auto part = [&] { return static_cast<std::uint8_t>(random.between(0, 255)); };
    polygon.color.red = part(), polygon.color.green = part(), polygon.color.blue = part();
    const double opacity = random.between(least_opacity, 1);
    polygon.material = Material{i % 3 == 0 ? 1 : opacity};
  }
  test::look(scene, Camera::Kind::perspective, 4, 20, 70, 1, 8);
  scene.camera.window = 0.4;
  scene.raster = {48, 48, false};
  scene.background = white;
  return scene;
}

/// What every ray meets, mixed from the farthest to the nearest in floating point: what the picture should be.
struct Layer {
  double z;
  std::int32_t polygon;
};
std::vector<std::vector<Layer>> layers_of(const Scene& scene) {
  std::vector<std::vector<Layer>> layers(static_cast<std::size_t>(scene.raster.width) *
                                         static_cast<std::size_t>(scene.raster.height));
  for (const Facet& facet : scene.facets) {
    Scene alone = scene;
    alone.facets = {facet};
    NullRecorder nothing;
    Conventions both_sides;
    both_sides.cull = false;
    const Picture picture = z_buffer::run(alone, both_sides, nothing);
    for (std::size_t pixel = 0; pixel < layers.size(); ++pixel)
      if (picture.polygon[pixel] != no_polygon) layers[pixel].push_back({picture.depth[pixel], facet.polygon});
  }
  for (auto& stack : layers)
    std::sort(stack.begin(), stack.end(), [](const Layer& a, const Layer& b) { return a.z > b.z; });
  return layers;
}

}  // namespace

TEST_SUITE("transparency") {
  TEST_CASE("half red over white is (228, 128, 128), half green over that is (114, 164, 64)") {
    CHECK(transparency::blended(red, 0.5, white) == Color{228, 128, 128});
    CHECK(seen(panes({{0.5, red, 0.5}})) == Color{228, 128, 128});
    CHECK(seen(panes({{0.5, red, 0.5}, {0.25, green, 0.5}})) == Color{114, 164, 64});
  }

  TEST_CASE("opacity 0 is not to be seen, and opacity 1 hides") {
    CHECK(seen(panes({{0.5, red, 0}})) == white);
    CHECK(seen(panes({{0.5, red, 1}, {0.75, green, 0.5}})) == red);
    CHECK(seen(panes({{0.75, green, 0.5}, {0.5, red, 1}})) == red);
  }

  TEST_CASE("a Z-buffer alone forgets what comes after the pane before it, with the opaque first it is there") {
    // The near pane of glass stands first in the file, the opaque wall behind it second.
    const Scene scene = panes({{0.25, red, 0.5}, {0.75, blue, 1}});
    CHECK(seen(scene, "file") == Color{228, 128, 128});  // red over the background: no wall
    CHECK(seen(scene, "opaque-first") == Color{100, 0, 100});
    CHECK(seen(scene) == Color{100, 0, 100});
  }

  TEST_CASE("two panes in the wrong order are mixed wrongly, however the opaque ones are drawn") {
    const Scene scene = panes({{0.25, red, 0.5}, {0.5, green, 0.5}, {0.75, blue, 1}});
    CHECK(seen(scene) == Color{100, 50, 50});                  // red / 2 + green / 4 + blue / 4
    CHECK(seen(scene, "opaque-first") == Color{50, 100, 50});  // as if the green pane were before the red one
  }

  TEST_CASE("panes in one plane are both to be seen, the first of the file on top") {
    CHECK(seen(panes({{0.5, red, 0.5}, {0.5, green, 0.5}})) == Color{164, 114, 64});
    CHECK(seen(panes({{0.5, green, 0.5}, {0.5, red, 0.5}})) == Color{114, 164, 64});
  }

  TEST_CASE("where nothing is transparent, polygons and depths are the Z-buffer's, in every order") {
    Scene scene = soup(7, 40, 1);
    for (const bool cull : {false, true})
      for (const char* order : {"file", "opaque-first", "back-to-front"}) {
        Conventions conventions = in_order(order);
        conventions.cull = cull;
        NullRecorder nothing;
        const Picture picture = transparency::run(scene, conventions, nothing);
        const Picture truth = z_buffer::run(scene, conventions, nothing);
        CHECK(picture.polygon == truth.polygon);
        CHECK(picture.depth == truth.depth);
        for (std::size_t pixel = 0; pixel < truth.polygon.size(); ++pixel)
          REQUIRE(color_at(picture, scene, pixel) == color_at(truth, scene, pixel));
      }
  }

  TEST_CASE("each pixel of a soup that cuts through itself is its layers, mixed one by one, the other orders differ") {
    for (const std::uint64_t seed : std::vector<std::uint64_t>{1, 2, 3}) {
      const Scene scene = soup(seed, 24, 0.2);
      const auto layers = layers_of(scene);
      const auto wrong = [&](const char* order) {
        Conventions conventions = in_order(order);
        conventions.cull = false;
        NullRecorder nothing;
        const Picture picture = transparency::run(scene, conventions, nothing);
        int apart = 0;
        for (std::size_t pixel = 0; pixel < layers.size(); ++pixel) {
          Color mixed = scene.background;
          for (const Layer& layer : layers[pixel]) {
            const Polygon& polygon = scene.polygons[static_cast<std::size_t>(layer.polygon)];
            mixed = transparency::blended(polygon.color, polygon.material->opacity, mixed);
          }
          apart += !(color_at(picture, scene, pixel) == mixed);
        }
        return apart;
      };
      // Cut edges run through some pixel's centre only by chance, and none of these scenes has that chance.
      CHECK(wrong("back-to-front") == 0);
      CHECK(wrong("opaque-first") > 50);
      CHECK(wrong("file") > wrong("opaque-first"));
    }
  }

  TEST_CASE("back to front the picture does not depend on the order of the file, from file it does") {
    const Scene scene = soup(11, 20, 0.2);
    const auto shuffled = [&](std::uint64_t seed) {
      Scene other = scene;
      std::mt19937_64 engine(seed);
      for (std::size_t i = other.facets.size(); i > 1; --i) std::swap(other.facets[i - 1], other.facets[engine() % i]);
      return other;
    };
    const auto colors = [&](const Scene& of, const char* order) {
      NullRecorder nothing;
      const Picture picture = transparency::run(of, in_order(order), nothing);
      std::vector<Color> all;
      for (std::size_t pixel = 0; pixel < picture.polygon.size(); ++pixel) all.push_back(color_at(picture, of, pixel));
      return all;
    };
    bool once_apart = false;
    for (const std::uint64_t seed : std::vector<std::uint64_t>{1, 2, 3, 4}) {
      CHECK(colors(shuffled(seed), "back-to-front") == colors(scene, "back-to-front"));
      once_apart = once_apart || colors(shuffled(seed), "file") != colors(scene, "file");
    }
    CHECK(once_apart);
  }

  TEST_CASE("only what hides enters the depth buffer") {
    const Scene scene = panes({{0.25, red, 0.5}, {0.75, blue, 1}});
    CollectRecorder record;
    const Picture picture = transparency::run(scene, Conventions{}, record);
    for (const DepthWrite& write : record.all<DepthWrite>()) CHECK(write.z == 0.75);
    CHECK(record.all<DepthWrite>().size() == 16);
    CHECK(record.all<ColorBlend>().size() == 32);
    CHECK(picture.polygon[5] == 1);
  }

  TEST_CASE("an empty scene, and one of a facet without area, are background") {
    Scene scene = panes({{0.5, red, 0.5}});
    scene.facets.clear();
    CHECK(seen(scene) == white);
    Scene line = test::screen_scene(4, 4, {{{0, 0, 0.5}, {3, 3, 0.5}, {1, 1, 0.5}}});
    line.background = white;
    line.polygons[0].material = Material{0.5};
    CHECK(seen(line) == white);
    CHECK(seen(line, "file") == white);
  }
}
