// Prints what a NullRecorder costs: the Z-buffer against the same code without its record calls, medians of runs that
// take turns, on a mesh of small polygons and on a few large ones. Exit code 1 if a ratio is above the limit given as
// argument.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/bench/scenes.hpp"

namespace zstep::stripped::z_buffer {
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);
}

using namespace zstep;
using bench::median, bench::look, bench::leaves, bench::torus;

namespace {

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
