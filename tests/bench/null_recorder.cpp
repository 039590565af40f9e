// Prints what a NullRecorder costs: the Z-buffer against the same code without its record calls, medians of runs that
// take turns, on a mesh of small polygons and on a few large ones. Exit code 1 if a ratio is above the limit given as
// argument.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "algorithms/viewing/camera.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"

namespace zstep::stripped::z_buffer {
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);
}

using namespace zstep;

namespace {

void look(Scene& scene, std::int32_t width, std::int32_t height) {
  scene.raster = {width, height, false};
  scene.camera.near = 1, scene.camera.far = 10;
  scene.camera.view = viewing::eckert_view(4, 30, 60);
  scene.camera.eye = viewing::eckert_eye(4, 30, 60);
}

void add_polygon(Scene& scene, const std::vector<std::int32_t>& corners) {
  scene.facets.push_back({static_cast<std::int32_t>(scene.polygons.size()),
                          static_cast<std::int32_t>(scene.corners.size()), static_cast<std::int32_t>(corners.size())});
  scene.corners.insert(scene.corners.end(), corners.begin(), corners.end());
  scene.polygons.push_back({});
}

// A torus of rings x sides quadrilaterals.
Scene torus(int rings, int sides) {
  Scene scene;
  constexpr double turn = 6.28318530717958647692;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double u = turn * i / rings, v = turn * j / sides, r = 2 + 0.8 * std::cos(v);
      scene.points.push_back({r * std::cos(u), r * std::sin(u), 0.8 * std::sin(v)});
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const int next_i = (i + 1) % rings, next_j = (j + 1) % sides;
      add_polygon(scene, {i * sides + j, next_i * sides + j, next_i * sides + next_j, i * sides + next_j});
    }
  }
  return scene;
}

// Leaves through the z axis, each over much of the picture and through all others.
Scene leaves(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const double angle = 3.14159265358979323846 * (i + 0.3) / count, x = 3 * std::cos(angle), y = 3 * std::sin(angle);
    const auto first = static_cast<std::int32_t>(scene.points.size());
    for (const double side : {-1.0, 1.0}) {
      scene.points.push_back({side * x, side * y, -side * 2});
      scene.points.push_back({side * x, side * y, side * 2});
    }
    add_polygon(scene, {first, first + 1, first + 2, first + 3});
  }
  return scene;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

using Run = Picture (*)(const Scene&, const Conventions&, NullRecorder&);

// Processor time, which other programs disturb less than the clock on the wall.
double milliseconds(Run run, const Scene& scene, const Conventions& conventions, int repeats, Picture& picture) {
  NullRecorder record;
  const std::clock_t begin = std::clock();
  for (int i = 0; i < repeats; ++i) picture = run(scene, conventions, record);
  return 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / repeats;
}

double compare(const std::string& name, const Scene& scene, Conventions::Interpolation interpolation) {
  constexpr int rounds = 101;
  Conventions conventions;
  conventions.cull = false;
  conventions.interpolation = interpolation;
  std::vector<double> recorded, plain, ratios;
  Picture one, other;
  const int repeats = 1 + static_cast<int>(10 / milliseconds(z_buffer::run<NullRecorder>, scene, conventions, 3, one));
  for (int round = 0; round < rounds; ++round) {
    // Take turns in going first.
    if (round % 2 == 0) recorded.push_back(milliseconds(z_buffer::run<NullRecorder>, scene, conventions, repeats, one));
    plain.push_back(milliseconds(stripped::z_buffer::run<NullRecorder>, scene, conventions, repeats, other));
    if (round % 2 != 0) recorded.push_back(milliseconds(z_buffer::run<NullRecorder>, scene, conventions, repeats, one));
    ratios.push_back(recorded.back() / plain.back());
    if (!(one == other)) {
      fmt::print(stderr, "the two pictures differ\n");
      std::exit(1);
    }
  }
  // Of each pair that ran one after the other, as the load of the machine changes between pairs.
  const double ratio = median(ratios);
  fmt::print("{:28} {:11} {:>9.3f} ms {:>9.3f} ms {:>7.3f}\n", name,
             interpolation == Conventions::Interpolation::direct ? "direct" : "increments", median(recorded),
             median(plain), ratio);
  return ratio;
}

}  // namespace

int main(int argc, char** argv) {
  Scene small = torus(160, 80), large = leaves(12), tiny = torus(600, 300);
  look(small, 640, 480);
  look(large, 640, 480);
  look(tiny, 640, 480);
  fmt::print("{:28} {:11} {:>12} {:>12} {:>7}\n", "", "", "NullRecorder", "stripped", "ratio");
  double worst = 0;
  for (const auto interpolation : {Conventions::Interpolation::direct, Conventions::Interpolation::increments}) {
    worst = std::max(worst, compare("12 800 small polygons", small, interpolation));
    worst = std::max(worst, compare("180 000 polygons of a pixel", tiny, interpolation));
    worst = std::max(worst, compare("12 large polygons", large, interpolation));
  }
  if (argc > 1 && worst > std::strtod(argv[1], nullptr)) {
    fmt::print("a NullRecorder costs more than {} allows: {:.3f}\n", argv[1], worst);
    return 1;
  }
  return 0;
}
