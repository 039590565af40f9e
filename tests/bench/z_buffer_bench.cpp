// Prints what a frame of 1024x768 costs without a trace, by spans and by half-spaces: the loop that is taught,
// run_fast, and Mesa's llvmpipe.
//
// What each does, and does not do:
// - Every frame begins with a clear and ends with all pixels in memory. Back faces are culled.
// - llvmpipe runs in this one thread, too (LP_NUM_THREADS=0), and is built with LLVM, here for AVX2 or AVX-512 as it
//   sees fit. It gets what suits it: positions and colours in its own memory, one call with shared vertices, flat
//   colours (a triangle's last vertex says which), no texture and no light. Polygons come to it as triangles.
// - llvmpipe keeps colours of 4 bytes and depths of 24 bits beside 8 unused; zstep polygon numbers of 4 bytes and
//   depths of 8. llvmpipe computes in float32 and puts vertices on a grid of 1/256 pixel; zstep computes in float64,
//   and run_fast must give every bit of the taught loop, which is checked.
// - Both keep their buffers from frame to frame; the taught loop makes a new Picture. zstep decides facing in space,
//   llvmpipe by the sign of the triangle's area, and it copies the colours to the caller's memory at the end.
// - run_fast draws in one thread, and in as many as the processor runs at once.
// All take turns; medians of the time on the wall, and of the ratios within a turn.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/fast/half_space.hpp"
#include "algorithms/fast/z_buffer.hpp"
#include "algorithms/half_space/half_space.hpp"
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
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < frames; ++i) frame();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count() / frames;
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

/// Of one method: the loop that is taught, and the fast one, by so many threads, 0 for as many as are worth it.
struct Loops {
  Picture (*taught)(const Scene&, const Conventions&, NullRecorder&);
  bool (*fast)(const Scene&, const Conventions&, Picture&, int);
};
constexpr Loops z_buffer_loops{z_buffer::run<NullRecorder>,
                               [](const Scene& scene, const Conventions& conventions, Picture& picture, int threads) {
                                 z_buffer::run_fast(scene, conventions, picture, threads);
                                 return true;
                               }};
constexpr Loops half_space_loops{half_space::run<NullRecorder>, half_space::run_fast};

void compare(const Loops& loops, const std::string& name, const Scene& scene, bool cull) {
  constexpr int rounds = 31;
  Conventions conventions;
  conventions.cull = cull;
  NullRecorder record;
  Picture picture, kept;
  std::vector<double> taught, one, all, mesa, one_over_taught, all_over_taught, one_over_mesa, all_over_mesa;
  const auto run = [&] { picture = {}, picture = loops.taught(scene, conventions, record); };
  bool fast = true;
  const auto run_one = [&] { fast = loops.fast(scene, conventions, kept, 1) && fast; };
  const auto run_all = [&] { fast = loops.fast(scene, conventions, kept, 0) && fast; };
  run();
  const Picture expected = picture;
  run_one();
  if (!fast || !(kept == expected)) {
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
  const int frames = 1 + static_cast<int>(4 / milliseconds(3, run_one));
  for (int round = 0; round < rounds; ++round) {
    taught.push_back(milliseconds(std::max(1, frames / 3), run));
    one.push_back(milliseconds(frames, run_one));
    all.push_back(milliseconds(frames, run_all));
    one_over_taught.push_back(taught.back() / one.back());
    all_over_taught.push_back(taught.back() / all.back());
#if ZSTEP_BENCH_LLVMPIPE
    mesa.push_back(milliseconds(std::max(1, frames / 3), [&] { llvmpipe.draw_frame(); }));
    one_over_mesa.push_back(mesa.back() / one.back());
    all_over_mesa.push_back(mesa.back() / all.back());
#endif
  }
  fmt::print("| {} | {} | {} | {:.3f} | {:.3f} | {:.3f} |", name, scene.facets.size(), drawn(expected), median(taught),
             median(one), median(all));
  const auto times = [](const std::vector<double>& ratio) {
    return ratio.empty() ? std::string("-") : fmt::format("{:.2f}", median(ratio));
  };
  fmt::print(" {} | {} | {} | {} | {} |\n", mesa.empty() ? "-" : fmt::format("{:.3f}", median(mesa)),
             times(one_over_taught), times(all_over_taught), times(one_over_mesa), times(all_over_mesa));
}

}  // namespace

int main() {
  const unsigned threads = std::thread::hardware_concurrency();
  for (const auto& [title, loops] :
       {std::pair("Z-buffer", z_buffer_loops), std::pair("half-space", half_space_loops)}) {
    fmt::print(
        "{1}\n\n| | facets | pixels | taught loop, ms | fast, 1 thread | fast, {0} threads | llvmpipe, 1 thread | 1 "
        "thread, times taught | {0} threads | 1 thread, times llvmpipe | {0} threads "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        threads, title);
    for (const std::string name : {"teapot:4", "teapot:8", "teapot:16", "teapot:32", "teapot:64"})
      compare(loops, name, teapot(name), true);
    compare(loops, "torus, 50 000 triangles", looked_at(bench::torus(250, 100, true)), true);
    compare(loops, "12 large polygons", looked_at(bench::leaves(12)), false);
    fmt::print("\n");
  }
#if ZSTEP_BENCH_LLVMPIPE
  fmt::print("\nllvmpipe is \"{}\" in this thread\n", bench::Llvmpipe(looked_at(bench::leaves(1)), false).name());
#else
  fmt::print("\nllvmpipe was not measured: OSMesa (libosmesa6-dev) was not found when zstep was configured\n");
#endif
}
