// One small run in each number format and each way of printing numbers, and what its numbers may then be off by, as
// docs/checking-a-run.md says it ("How exact"). None of the amounts is read from what is tested.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::test {

/// Two triangles; z from 2 to 10, and so much more. The first edge is upright, of one depth, and begins on scan line 2.
inline constexpr double range_of_z = 8;
inline constexpr std::size_t upright_from = 0, upright_to = 1;
inline Scene two_triangles(double away) {
  Scene scene = screen_scene(16, 16,
                             {{{3.25, 2, 2.5}, {3.25, 13, 2.5}, {12.6875, 7.3125, 9.40625}},
                              {{0.9375, 1.1875, 3.125}, {13.71875, 12.90625, 10}, {2.40625, 14.4375, 2}}});
  for (glm::dvec3& point : scene.points) point.z += away;
  return scene;
}

/// How numbers are computed and printed, and by how much a number may be off: by such a share of its size, and by such
/// an amount besides.
struct Printed {
  const char* name;
  NumberFormat computed;
  bool declared;
  int decimals, digits;  ///< that are printed; 0 for all
  double share, amount;
  int held = 0;              ///< to so many, though fewer are printed
  double of_positions = -1;  ///< the amount for positions in pixels, where it is another one

  bool cut() const { return decimals > 0 || digits > 0; }
  double of(double size, double count = 1) const { return share * std::abs(size) + count * amount; }
  double amount_of_positions() const { return of_positions < 0 ? amount : of_positions; }
  double of_position(double size, double count = 1) const {
    return share * std::abs(size) + count * amount_of_positions();
  }
  double as_printed(double value) const {
    if (computed == NumberFormat::float32) return static_cast<double>(static_cast<float>(value));
    if (!cut() || !std::isfinite(value)) return value;
    const std::string text =
        decimals > 0 ? fmt::format("{:.{}f}", value, decimals) : fmt::format("{:.{}g}", value, digits);
    return std::strtod(text.c_str(), nullptr);
  }
  /// The last digit that is printed of a number: neighbours are so far apart. 0 where all digits are there.
  double last_digit(double value) const {
    if (decimals > 0) return std::pow(10, -decimals);
    return digits > 0 ? std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - digits) : 0;
  }
};
/// Of fixed16 the unit of depths is larger than 1/65536 of a pixel; of fixed24 it is smaller.
inline const std::vector<Printed>& all_printed() {
  using enum NumberFormat;
  static const std::vector<Printed> all{
      {"float64, declared", float64, true, 0, 0, 1e-9, 0},
      {"float64, by its looks", float64, false, 0, 0, 1e-9, 0},
      {"float32, declared", float32, true, 0, 0, 1e-6, 0},
      {"float32, by its looks", float32, false, 0, 0, 1e-6, 0},
      {"fixed16, declared", fixed16, true, 0, 0, 1e-9, 2 * range_of_z / 65535, 0, 2.0 / 65536},
      {"fixed16, by its looks", fixed16, false, 0, 0, 1e-9, 2 * range_of_z / 65535, 0, 2.0 / 65536},
      {"fixed24, declared", fixed24, true, 0, 0, 1e-9, 2 * range_of_z / 16777215, 0, 2.0 / 65536},
      {"fixed24, by its looks", fixed24, false, 0, 0, 1e-9, 2 * range_of_z / 16777215, 0, 2.0 / 65536},
      {"4 decimals", float64, false, 4, 0, 1e-9, 1e-4},
      {"6 decimals", float64, false, 6, 0, 1e-9, 1e-6},
      {"4 decimals, held to 6", float64, false, 4, 0, 1e-9, 1e-6, 6},
      {"5 digits", float64, false, 0, 5, 2e-4, 0},
      {"8 digits", float64, false, 0, 8, 2e-7, 0},
      {"5 digits, held to 7", float64, false, 0, 5, 2e-6, 0, 7},
  };
  return all;
}

/// Which run, and of what.
struct Run {
  const char* method = "z-buffer";
  double away = 0;
  bool drawn = true;  ///< else it ends before the first piece is drawn
};
/// A run that adds slopes, its numbers as they are printed. Then change(step, event) may alter events, and
/// change_scene(scene) the scene that stands in the header.
template <class Change, class ChangeScene>
Trace run_printed(const Printed& printed, const Run& of, Change&& change, ChangeScene&& change_scene) {
  Conventions conventions;
  conventions.number_format = printed.computed;
  conventions.interpolation = Conventions::Interpolation::increments;
  const Trace run = recorded_by(of.method, two_triangles(of.away), conventions);
  Header header = run.header();
  if (!printed.declared) {
    header.conventions.number_format = NumberFormat::float64;
    header.undeclared |= std::uint8_t{1} << static_cast<unsigned>(Convention::number_format);
  }
  Scene scene = run.scene();
  change_scene(scene);
  TraceRecorder recorder(header, scene);
  for (std::int64_t step = 1; step <= run.size(); ++step) {
    RecordedEvent recorded = run.event(step);
    if (!of.drawn && holds<PieceDraw>(recorded.event)) break;
    visit_event(
        [&]<class E>(E& event) {
          for_each_field<E>([&](const auto& field) {
            if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
              event.*field.member = printed.as_printed(event.*field.member);
          });
        },
        recorded.event);
    change(step, recorded.event);
    record_any(recorder, recorded.step, recorded.event);
  }
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), printed.name);
}
template <class Change>
Trace run_printed(const Printed& printed, const Run& of, Change&& change) {
  return run_printed(printed, of, change, [](Scene&) {});
}
inline Trace run_printed(const Printed& printed, const Run& of = {}) {
  return run_printed(printed, of, [](std::int64_t, Event&) {});
}
/// As it is, but that the upright edge stands elsewhere in the scene: the run has the digits that it had.
inline Trace run_beside(const Printed& printed, const Run& of, const glm::dvec3& off) {
  return run_printed(
      printed, of, [](std::int64_t, Event&) {},
      [&](Scene& scene) {
        for (const std::size_t vertex : {upright_from, upright_to}) scene.points[vertex] += off;
      });
}

}  // namespace zstep::test
