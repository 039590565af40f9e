// What is printed beside the formulas that printed_formulas_test.cpp evaluates: what a field must follow from, as
// `check`, `diff` and grading show it; comparisons; mixed colours; the numbers of the sentence itself.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "sim/words/derived.hpp"
#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/words/printed.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

std::string kind_name(const Event& event) {
  return visit_event([](const auto& known) { return std::string(description_of<std::decay_t<decltype(known)>>.name); },
                     event);
}

bool meet(const Interval& a, const Interval& b) { return a.low <= b.high && b.low <= a.high; }

/// Calls use(text, a, sign, b) for each "a < b" of two numbers in a text.
template <class Use>
void for_each_comparison(const std::string& text, Use&& use) {
  const auto all = numbers_in(text);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const std::size_t end = all[i].first + all[i].second;
    const std::string between = text.substr(end, all[i + 1].first - end);
    for (const std::string sign : signs) {
      if (between != " " + sign + " ") continue;
      const auto a = number_of(text.substr(all[i].first, all[i].second)),
                 b = number_of(text.substr(all[i + 1].first, all[i + 1].second));
      const std::string rest = text.substr(all[i + 1].first + all[i + 1].second);
      if (a && b) use(*a, sign, *b, rest);
    }
  }
}

/// Is the number in a sentence one that the step, its explanation, the state at hand or a polygon's glass has?
bool is_known(const Explanation& told, const Event& event, const Trace& trace, const State& state,
              const std::string& number) {
  for (const Polygon& polygon : trace.scene().polygons)
    if (polygon.material->opacity < 1 && shown_as(polygon.material->opacity, number)) return true;
  for (const auto& [name, value] : told.values)
    if (shown_as(value, number)) return true;
  for (const auto& [name, value] : fields_by_name(event))
    if (shown_as(value, number)) return true;
  for (const std::string& line : told.formulas)
    for (const auto& [at, size] : numbers_in(line))
      if (line.substr(at, size) == number) return true;
  return state.machine.fragment && shown_as(state.machine.fragment->stored, number);
}

}  // namespace

TEST_CASE("law: what a field follows from gives, as it is printed, what the trace records") {
  std::map<std::string, int> evaluated;
  int compared = 0;
  for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    for (std::int64_t step = 1; step <= trace.size(); replay.step_forward(), ++step) {
      CAPTURE(step);
      const Event event = trace.event(step).event;
      const formulas::Situation at = formulas::situation_of(trace, replay.state());
      for (const auto& one : fields_by_name(event)) {
        const std::string& field = one.first;
        const double value = one.second;
        const auto printed = derived_formula(event, at, field);
        if (!printed) continue;
        std::string line = printed->text;
        CAPTURE(field);
        CAPTURE(line);
        if (const std::size_t colon = line.find(":  "); colon != std::string::npos) {
          int found = 0;
          for_each_comparison(line.substr(colon + 3), [&](double a, const std::string& sign, double b, auto rest) {
            REQUIRE(so(a, sign, b) == (rest == " is true"));
            REQUIRE((rest == " is true") == (value != 0));
            ++found, ++compared;
          });
          REQUIRE(found == 1);
          continue;
        }
        const std::string limits = ", within the raster ";
        const std::size_t limited = line.find(limits);
        if (limited != std::string::npos) {
          REQUIRE(number_of(line.substr(limited + limits.size())) == value);
          line = line.substr(0, limited);
        }
        const std::vector<std::string> sides = parts(line, " = ");
        const auto ends_in = number_of(sides.back());
        REQUIRE(ends_in);
        // Of planes: 0 recorded, and -7.95e-18 by the formula. A run in float32 has rounded each operand and each
        // result on the way; by as much as that moves the formula, the number may be beside what the printed one stands
        // for.
        double beside = 1e-9;
        Interval shown{*ends_in, *ends_in};
        if (trace.header().conventions.number_format == NumberFormat::float32 && sides.size() > 1) {
          const std::string& computed = sides[sides.size() - 2];
          if (const auto exact = read(computed), narrow = read(computed, 0x1p-24); exact && narrow) {
            beside = std::max({beside, narrow->value.high - exact->value.high, exact->value.low - narrow->value.low});
            REQUIRE(std::isfinite(beside));
            shown = meant_by(sides.back());
          }
        }
        REQUIRE_MESSAGE((limited != std::string::npos || shown_as(value, sides.back()) ||
                         (value > shown.low - beside && value < shown.high + beside)),
                        value);
        if (sides.size() < 2) continue;
        const auto formula = read(sides[sides.size() - 2]), result = read(sides.back());
        if (!formula || !formula->computes) continue;
        REQUIRE(result);
        REQUIRE(meet(formula->value, result->value));
        if (std::isfinite(formula->value.high)) ++evaluated[kind_name(event)];
      }
    }
  });
  CHECK(compared > 0);
  for (const std::string kind :
       {"view_transform", "projection", "viewport_transform", "clip_cross", "edge_table_insert", "edge_step",
        "span_begin", "depth_interpolate", "pixel_paint", "plane_depth", "plane_slopes", "implied_edge", "eye_side",
        "split_vertex", "ray_plane", "ray_hit", "horizon_test", "line_cross"}) {
    CAPTURE(kind);
    CHECK(evaluated[kind] > 0);
  }
}

TEST_CASE("law: comparisons, lengths and mixed colours are right as they are printed") {
  std::map<std::string, int> compared;
  int lengths = 0, mixtures = 0;
  for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Event event = replay.current()->event;
      const Explanation told = explain(trace, replay.state(), *replay.current());
      const auto step = replay.position();
      CAPTURE(step);
      CAPTURE(told.sentence);
      for_each_comparison(told.sentence, [&](double a, const std::string& sign, double b, const std::string&) {
        REQUIRE(so(a, sign, b));
        ++compared[kind_name(event)];
      });
      for (const std::string& line : told.formulas) {
        CAPTURE(line);
        for_each_comparison(line, [&](double a, const std::string& sign, double b, const std::string& rest) {
          if (sign == "=") return;  // the end of a formula
          REQUIRE(so(a, sign, b) == !rest.starts_with("  is false"));
          ++compared[kind_name(event)];
        });
        std::vector<double> numbers;
        const std::size_t from = line.find(":  ") == std::string::npos ? 0 : line.find(":  ");
        for (const auto& [at, size] : numbers_in(line))
          if (at >= from) numbers.push_back(number_of(line.substr(at, size)).value_or(infinite));
        if (holds<LinePiece>(event) && line.ends_with(" of its length")) {
          REQUIRE(numbers.size() == 3);
          REQUIRE(numbers[1] - numbers[0] == doctest::Approx(numbers[2]).epsilon(1e-3));
          ++lengths;
        }
        if (holds<ColorBlend>(event)) {
          // α · colour + (1 − α) · frame = α · (r, g, b) + (1 − α) · (r, g, b) = (r, g, b), the 1 of the symbols first
          REQUIRE(numbers.size() == 13);
          REQUIRE(numbers[5] == 1);
          REQUIRE(numbers[6] == numbers[1]);
          for (std::size_t k = 0; k < 3; ++k)
            REQUIRE(std::abs(numbers[1] * numbers[2 + k] + (1 - numbers[1]) * numbers[7 + k] - numbers[10 + k]) < 0.55);
          ++mixtures;
        }
      }
    }
  });
  CHECK(lengths > 0);
  CHECK(mixtures > 0);
  for (const std::string kind :
       {"depth_compare", "box_test", "extent_test", "clip_vertex", "facing_test", "node_skip"}) {
    CAPTURE(kind);
    CHECK(compared[kind] > 0);
  }
}

TEST_CASE("law: a number in a sentence is the step's own, or stands in one of its formulas") {
  // These tell of what was before, of places on the raster, or in percent.
  const std::set<std::string> otherwise{"horizon_move", "curve_segment", "coverage_add"};
  std::map<std::string, int> found;
  for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Event event = replay.current()->event;
      const std::string kind = kind_name(event);
      if (otherwise.contains(kind)) continue;
      const Explanation told = explain(trace, replay.state(), *replay.current());
      CAPTURE(told.sentence);
      for (const auto& [at, size] : numbers_in(told.sentence)) {
        const std::string number = told.sentence.substr(at, size);
        if (number.find('.') == std::string::npos) continue;
        REQUIRE_MESSAGE(is_known(told, event, trace, replay.state(), number), number);
        ++found[kind];
      }
    }
  });
  for (const std::string kind :
       {"depth_compare", "depth_interpolate", "viewport_transform", "ray_plane", "line_piece"}) {
    CAPTURE(kind);
    CHECK(found[kind] > 0);
  }
}
