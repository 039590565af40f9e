// Prints what a frame of 1024x768 costs without a trace: the loop that is taught, run_fast, and Mesa's llvmpipe.
//
// What each does, and does not do:
// - Every frame begins with a clear and ends with all pixels in memory. Back faces are culled.
// - llvmpipe runs in this one thread, too (LP_NUM_THREADS=0), and is built with LLVM, here for AVX2 or AVX-512 as it
//   sees fit. It gets what suits it: positions and colours in its own memory, one call with shared vertices, flat
//   colours (a triangle's last vertex says which), no texture and no light. Polygons come to it as triangles.
// - llvmpipe keeps colours of 4 bytes and depths of 24 bits beside 8 unused; zstep polygon numbers of 4 bytes and
// depths
//   of 8. llvmpipe computes in float32 and puts vertices on a grid of 1/256 pixel; zstep computes in float64, and
//   run_fast must give every bit of the taught loop, which is checked.
// - zstep makes a new Picture each frame and decides facing in space; llvmpipe keeps its buffers, decides by the sign
// of
//   the triangle's area, and copies the colours to the caller's memory at the end.
// The three take turns; medians of processor time, and of the ratios within a turn.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/z_buffer/fast.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/bench/scenes.hpp"
#if ZSTEP_BENCH_LLVMPIPE
#include "tests/bench/llvmpipe.hpp"
#endif

using namespace zstep;
using bench::median;

namespace {

template <class Frame>
double milliseconds(int frames, Frame frame) {
  const std::clock_t begin = std::clock();
  for (int i = 0; i < frames; ++i) frame();
  return 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / frames;
}

int drawn(const Picture& picture) {
  return static_cast<int>(picture.polygon.size()) -
         static_cast<int>(std::count(picture.polygon.begin(), picture.polygon.end(), no_polygon));
}

Scene teapot(const std::string& name) {
  ViewOptions options;
  options.width = 1024, options.height = 768;
  return look_at_scene(load_scene(name).scene, options);
}

Scene looked_at(Scene scene) {
  bench::look(scene, 1024, 768);
  return scene;
}

void compare(const std::string& name, const Scene& scene, bool cull) {
  constexpr int rounds = 31;
  Conventions conventions;
  conventions.cull = cull;
  NullRecorder record;
  Picture picture;
  std::vector<double> taught, fast, clear, mesa, over_taught, over_mesa;
  const auto run = [&] { picture = {}, picture = z_buffer::run(scene, conventions, record); };
  const auto run_fast = [&] { picture = {}, picture = z_buffer::run_fast(scene, conventions); };
  const auto run_clear = [&] { picture = {}, picture = Picture(scene.raster.width, scene.raster.height); };
  run();
  const Picture expected = picture;
  run_fast();
  if (!(picture == expected)) {
    fmt::print(stderr, "{}: run_fast draws another picture\n", name);
    std::exit(1);
  }
#if ZSTEP_BENCH_LLVMPIPE
  bench::Llvmpipe llvmpipe(scene, cull);
  llvmpipe.draw_frame();
  const int difference = std::abs(llvmpipe.pixels_drawn() - drawn(expected));
  if (difference > drawn(expected) / 500) {
    fmt::print(stderr, "{}: llvmpipe draws {} pixels more or less\n", name, difference);
    std::exit(1);
  }
#endif
  const int frames = 1 + static_cast<int>(4 / milliseconds(3, run_fast));
  for (int round = 0; round < rounds; ++round) {
    taught.push_back(milliseconds(std::max(1, frames / 3), run));
    fast.push_back(milliseconds(frames, run_fast));
    clear.push_back(milliseconds(frames, run_clear));
    over_taught.push_back(taught.back() / fast.back());
#if ZSTEP_BENCH_LLVMPIPE
    mesa.push_back(milliseconds(std::max(1, frames / 3), [&] { llvmpipe.draw_frame(); }));
    over_mesa.push_back(mesa.back() / fast.back());
#endif
  }
  fmt::print("{:26} {:>8} {:>8} {:>9.3f} {:>9.3f} {:>9.3f}", name, scene.facets.size(), drawn(expected), median(taught),
             median(fast), median(clear));
  if (mesa.empty()) {
    fmt::print(" {:>9} {:>9.2f} {:>11}\n", "-", median(over_taught), "-");
  } else {
    fmt::print(" {:>9.3f} {:>9.2f} {:>11.2f}\n", median(mesa), median(over_taught), median(over_mesa));
  }
}

}  // namespace

int main() {
  fmt::print("{:26} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", "ms a frame of 1024x768", "facets", "pixels",
             "taught", "run_fast", "(clear)", "llvmpipe", "x taught", "x llvmpipe");
  for (const std::string name : {"teapot:4", "teapot:8", "teapot:16", "teapot:32", "teapot:64"}) {
    compare(name, teapot(name), true);
  }
  compare("torus, 50 000 triangles", looked_at(bench::torus(250, 100, true)), true);
  compare("12 large polygons", looked_at(bench::leaves(12)), false);
#if ZSTEP_BENCH_LLVMPIPE
  fmt::print("llvmpipe is \"{}\" in this thread\n", bench::Llvmpipe(looked_at(bench::leaves(1)), false).name());
#else
  fmt::print("llvmpipe was not measured: OSMesa (libosmesa6-dev) was not found when zstep was configured\n");
#endif
}
