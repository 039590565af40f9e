// Prints how many rays a second cast_fast follows, and how many Embree does: the rays from the eye through the pixels
// of a frame of 1024x768, the same triangles, one thread.
//
// What each does, and does not do:
// - Embree is asked ray by ray (rtcIntersect1), with its best tree (build quality high) and without the slower robust
//   mode. It computes in float32 and chooses its own instructions, AVX-512 among them.
// - cast_fast uses AVX2, computes hits in float64 and gives every bit of the taught method, which is checked: a facet
//   is taken only when its own outline says so, and of equal depths the one drawn first.
// - Both make each ray, and write polygon number and depth of what it meets to a picture. Neither culls.
// - Building the trees is printed apart; it is not in the rates.
// The two take turns; medians of processor time, and of the ratios within a turn.
#include <fmt/core.h>

#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "algorithms/fast/ray_casting.hpp"
#include "algorithms/ray_casting/ray_casting.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/bench/scenes.hpp"
#if ZSTEP_BENCH_EMBREE
#include "tests/bench/embree_rays.hpp"
#endif

using namespace zstep;
using bench::median;

namespace {

double seconds(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

Scene seen(const std::string& name, int width, int height) {
  if (name == "torus") {
    Scene scene = bench::torus(250, 100, true);
    bench::look(scene, width, height);
    return scene;
  }
  ViewOptions options;
  options.width = width, options.height = height;
  return look_at_scene(load_scene(name).scene, options);
}

// Against the method as it is taught, on a raster that it can do in reasonable time.
bool same_as_taught(const std::string& name) {
  const Scene scene = seen(name, 96, 72);
  Conventions conventions;
  conventions.cull = false;
  conventions.options = {{"boxes", "hierarchy"}};
  NullRecorder record;
  return ray_casting::cast_fast(scene, conventions) == ray_casting::run(scene, conventions, record);
}

void compare(const std::string& title, const std::string& name) {
  constexpr int rounds = 15;
  const Scene scene = seen(name, 1024, 768);
  Conventions conventions;
  conventions.cull = false;
  if (!same_as_taught(name)) {
    fmt::print(stderr, "{}: cast_fast draws another picture\n", title);
    std::exit(1);
  }

  std::clock_t begin = std::clock();
  const ray_casting::Tree tree = ray_casting::build_tree(scene);
  const double our_build = seconds(begin);
  Picture ours;
  std::vector<double> our_rate, embrees_rate, ratio;
#if ZSTEP_BENCH_EMBREE
  begin = std::clock();
  const bench::EmbreeRays embree(scene);
  const double embrees_build = seconds(begin);
  Picture embrees(1024, 768);
#endif
  const double rays = 1024.0 * 768;
  for (int round = 0; round < rounds; ++round) {
    begin = std::clock();
    ours = ray_casting::cast_fast(tree, scene, conventions);
    our_rate.push_back(rays / seconds(begin));
#if ZSTEP_BENCH_EMBREE
    begin = std::clock();
    embrees = Picture(1024, 768);
    embree.cast(embrees);
    embrees_rate.push_back(rays / seconds(begin));
    ratio.push_back(our_rate.back() / embrees_rate.back());
#endif
  }

  int drawn = 0;
  for (const std::int32_t polygon : ours.polygon) drawn += polygon != no_polygon;
  fmt::print("| {} | {} | {} | {:.2f} |", title, bench::triangles_in(scene), drawn, 1e-6 * median(our_rate));
#if ZSTEP_BENCH_EMBREE
  int different = 0;
  for (std::size_t i = 0; i < ours.polygon.size(); ++i) different += ours.polygon[i] != embrees.polygon[i];
  fmt::print(" {:.2f} | {:.2f} | {} | {:.1f} | {:.1f} |\n", 1e-6 * median(embrees_rate), median(ratio), different,
             1000 * our_build, 1000 * embrees_build);
  if (different > drawn / 1000) {
    fmt::print(stderr, "{}: Embree sees another picture\n", title);
    std::exit(1);
  }
#else
  fmt::print(" - | - | - | {:.1f} | - |\n", 1000 * our_build);
#endif
}

}  // namespace

int main() {
  fmt::print(
      "| 1024x768 | triangles | hits | cast_fast, million rays a second | Embree's | ratio | pixels that differ | "
      "build, ms | Embree's |\n|---|---|---|---|---|---|---|---|---|\n");
  compare("teapot", "teapot");
  compare("teapot:32", "teapot:32");
  compare("torus, 50 000 triangles", "torus");
#if ZSTEP_BENCH_EMBREE
  fmt::print("\n{}\n", bench::embree_name());
#else
  fmt::print("\nEmbree (libembree-dev, 3 or 4) was not found when zstep was configured\n");
#endif
}
