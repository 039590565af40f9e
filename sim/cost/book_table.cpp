#include "sim/cost/book_table.hpp"

#include <cmath>
#include <random>

#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::compare {

namespace {

// The mean area of a triangle whose corners are drawn evenly from a square of side 1.
constexpr double mean_triangle = 11.0 / 144;

struct Numbers {
  std::mt19937_64 engine;
  double between(double low, double high) { return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53; }
  glm::dvec3 in_box(double half) {
    const double x = between(-half, half), y = between(-half, half);
    return {x, y, between(-half, half)};
  }
};

}  // namespace

Scene random_scene(int triangles, double layers, std::int32_t side, unsigned seed) {
  constexpr double window = 2;  // its side: the box spans -1 … 1
  const double square = std::sqrt(layers * window * window / (triangles * mean_triangle));

  Scene scene;
  scene.name = "random-" + std::to_string(triangles);
  scene.source = "random";
  Numbers random{std::mt19937_64(seed)};
  for (std::int32_t polygon = 0; polygon < triangles; ++polygon) {
    const auto first = static_cast<std::int32_t>(scene.points.size());
    const glm::dvec3 centre = random.in_box(1);
    for (std::int32_t corner = 0; corner < 3; ++corner) {
      scene.points.push_back(centre + random.in_box(square / 2));
      scene.corners.push_back(first + corner);
    }
    scene.polygons.push_back({"", scene::palette[static_cast<std::size_t>(polygon) % scene::palette.size()], 0});
    scene.facets.push_back({polygon, first, 3});
  }
  // From above, so that x and y of the box are those of the picture.
  ViewOptions view;
  view.rho = 10, view.theta = -90, view.phi = 0;
  view.window = window / 2, view.orthographic = true;
  view.width = view.height = side;
  return look_at_scene(std::move(scene), view);
}

double growth_exponent(double n_0, double cost_0, double n_1, double cost_1) {
  return portable::log(cost_1 / cost_0) / portable::log(n_1 / n_0);
}

}  // namespace zstep::compare
