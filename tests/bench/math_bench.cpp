// What it costs that sines and exponentials are the same on every platform: portable functions against the C
// library's, and what that is of a camera's set-up and of a surface of 250 000 samples. Medians of processor time; the
// two take turns, and ratios are medians of the ratios within a turn.
#include <fmt/core.h>

#include <cmath>
#include <random>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/surface/surface_scene.hpp"
#include "algorithms/viewing/camera.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/bench/seconds.hpp"
#include "traces/math/portable_math.hpp"

using namespace zstep;
using bench::median;

namespace {

constexpr int turns = 15, calls = 250'000;
double kept = 0;  // what is computed counts, so that it is computed

template <class Function>
double nanoseconds_of(const std::vector<double>& arguments, Function function) {
  return 1e9 / calls * processor_seconds_of([&] {
           for (const double x : arguments) kept += function(x);
         });
}

double compare(const char* name, double (*ours)(double), double (*theirs)(double), double low, double high) {
  std::mt19937_64 random(1);
  std::vector<double> arguments(calls), us, them, ratios;
  for (double& x : arguments) x = low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  for (int turn = 0; turn < turns; ++turn) {
    us.push_back(nanoseconds_of(arguments, ours));
    them.push_back(nanoseconds_of(arguments, theirs));
    ratios.push_back(us.back() / them.back());
  }
  fmt::print("{:6} {:6.0f} ns   C library {:4.0f} ns   {:.1f} times\n", name, median(us), median(them), median(ratios));
  return median(us) - median(them);
}

}  // namespace

int main() {
#define COMPARE(name, low, high) \
  compare(                       \
      #name, portable::name, [](double x) { return std::name(x); }, low, high)
  const double of_sine = COMPARE(sin, -10, 10), of_cosine = COMPARE(cos, -10, 10), of_exp = COMPARE(exp, -10, 2);
  COMPARE(tan, -10, 10), COMPARE(atan, -4, 4), COMPARE(acos, -1, 1), COMPARE(log, 0, 10), COMPARE(tanh, -4, 4);
  compare(
      "x^1.5", [](double x) { return portable::pow(x, 1.5); }, [](double x) { return std::pow(x, 1.5); }, 0, 10);
  compare(
      "x^3", [](double x) { return portable::pow(x, 3); }, [](double x) { return std::pow(x, 3); }, -10, 10);

  const auto surface = [](const char* formula, double more) {
    std::vector<double> times;
    for (int turn = 0; turn < turns; ++turn)
      times.push_back(processor_seconds_of([&] {
        Surface sampled;
        sampled.formula = formula;
        sampled.columns = sampled.rows = 500;
        sampled.x_min = sampled.z_min = -3, sampled.x_max = sampled.z_max = 3;
        kept += scene::surface_scene(sampled, "bench", {}, {}).scene.points.front().z;
      }));
    fmt::print("surface y = {} of {} samples: {:.0f} ms, {:.1f} % of it for the same bits\n", formula, calls,
               1e3 * median(times), 100 * more * calls / 1e9 / median(times));
  };
  surface("sin(x) * cos(z)", of_sine + of_cosine);
  surface("exp(-x*x - z*z)", of_exp);

  std::vector<double> times;
  for (int turn = 0; turn < turns; ++turn)
    times.push_back(processor_seconds_of([] {
      for (int i = 0; i < calls / 10; ++i) kept += viewing::eckert_view(10, 0.01 * i, 50)[0][0];
    }));
  fmt::print("a camera's matrix: {:.0f} ns\n", median(times) * 1e9 / (calls / 10));
  return std::isnan(kept) ? 1 : 0;
}
