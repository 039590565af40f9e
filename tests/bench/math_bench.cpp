// What it costs that sines and exponentials are the same on every platform: portable functions against the C
// library's, and what that is of a camera's set-up and of a surface of 250 000 samples. Medians of processor time; the
// two take turns, and ratios are medians of the ratios within a turn.
#include <fmt/core.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/surface/surface_scene.hpp"
#include "algorithms/viewing/camera.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/bench/seconds.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

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

/// eckert_view() as it would be with the C library's functions.
glm::dmat4 with_c_library(double rho, double theta, double phi) {
  const auto turned_by = [](double degrees) {
    int quadrant = 0;
    const double rest = std::remquo(degrees, 90.0, &quadrant) * 3.14159265358979323846 / 180;
    const double sine = std::sin(rest), cosine = std::cos(rest), around[5] = {sine, cosine, -sine, -cosine, sine};
    return std::pair(around[quadrant & 3], around[(quadrant & 3) + 1]);
  };
  const auto [sin_theta, cos_theta] = turned_by(theta);
  const auto [sin_phi, cos_phi] = turned_by(phi);
  return view_from_rows({-sin_theta, cos_theta, 0, 0}, {-cos_phi * cos_theta, -cos_phi * sin_theta, sin_phi, 0},
                        {-sin_phi * cos_theta, -sin_phi * sin_theta, -cos_phi, rho});
}

template <class Matrix>
double nanoseconds_of_matrices(Matrix matrix) {
  constexpr int matrices = calls / 10;
  return 1e9 / matrices * processor_seconds_of([&] {
           for (int i = 0; i < matrices; ++i) kept += matrix(10, 0.01 * i, 50 + 0.001 * i)[0][0];
         });
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

  std::vector<double> us, them, ratios;
  for (int turn = 0; turn < turns; ++turn) {
    us.push_back(nanoseconds_of_matrices(viewing::eckert_view));
    them.push_back(nanoseconds_of_matrices(with_c_library));
    ratios.push_back(us.back() / them.back());
  }
  fmt::print("a camera's matrix {:.0f} ns   C library {:.0f} ns   {:.1f} times\n", median(us), median(them),
             median(ratios));
  return std::isnan(kept) ? 1 : 0;
}
