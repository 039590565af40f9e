// zstep check: what a number may be off by, held from both sides. A number that is off by 0.9 of it is not doubted, and
// one that is off by 1.5 of it is, at its step and by its name. Where numbers are printed with few digits and only a
// printed number can be changed, the two are the last number that is within it and the next one.
#include "traces/check/check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "algorithms/scene/load.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/unit/traces/printed_runs.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"

using namespace zstep;
using test::Printed;

namespace {

bool doubts(const Trace& run, const Printed& printed, std::int64_t step, std::string_view field) {
  CheckMarks marks;
  check(run, nullptr, nullptr, &marks, printed.held);
  return std::any_of(marks.faults.begin(), marks.faults.end(),
                     [&](const Fault& fault) { return fault.step == step && fault.field == field; });
}

/// Just within what a number may be off by, and just beyond.
struct Sides {
  double within, beyond;
};
/// `digit`: of what is changed, where it is a printed number.
Sides sides_of(double allowed, double digit) {
  if (digit == 0) return {0.9 * allowed, 1.5 * allowed};
  const double most = std::floor(allowed / digit);
  return {most * digit, (most + 1) * digit};
}

template <class E>
std::int64_t first_step(const Trace& run) {
  const auto found = run.next<E>(0, [](const E&) { return true; });
  REQUIRE(found);
  return *found;
}

TEST_CASE("check: depths that are rounded to whole numbers are not held to float64, unless the header says so") {
  Printed as_it_is = test::all_printed()[0];
  const auto rounded = [&](bool declared, double (*round)(double), std::int64_t wrong) {
    as_it_is.declared = declared;
    return test::run_printed(as_it_is, {}, [=](std::int64_t step, Event& event) {
      visit_event(
          [&]<class E>(E& e) {
            for_each_field<E>([&](const auto& field) {
              if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
                if (field.unit == "depth" && field.name.front() == 'z' && std::isfinite(e.*field.member))
                  e.*field.member = round(e.*field.member) + (step == wrong ? 4 : 0);
            });
          },
          event);
    });
  };
  const auto floor_of = [](double z) { return std::floor(z); };
  const auto nearest_of = [](double z) { return std::round(z); };
  for (double (*round)(double) :
       {static_cast<double (*)(double)>(floor_of), static_cast<double (*)(double)>(nearest_of)}) {
    const Trace right = rounded(false, round, 0);
    const CheckReport report = check(right);
    std::string causes;
    for (const Cause& cause : report.causes)
      causes += (cause.first.rule ? std::string(rule_text(*cause.first.rule).name) : cause.first.field) + "@" +
                std::to_string(cause.first.step) + " " + std::to_string(cause.first.recorded) + " for " +
                std::to_string(cause.first.expected) + ", ";
    CHECK(causes == "");
    CHECK(report.precision.whole);
    CHECK_FALSE(check(rounded(true, round, 0)).causes.empty());
    // Positions are held to all their digits, and depths to their units.
    const std::int64_t depth = first_step<DepthInterpolate>(right) + 7;
    REQUIRE(right.next<DepthInterpolate>(depth - 1, [](const auto&) { return true; }));
    const std::int64_t step = *right.next<DepthInterpolate>(depth - 1, [](const auto&) { return true; });
    CHECK(doubts(rounded(false, round, step), as_it_is, step, "z"));
    const std::int64_t span = first_step<SpanBegin>(right);
    const Trace beside = test::changed(right, [&](std::int64_t at, Event& event) {
      if (at == span) get_if<SpanBegin>(&event)->x_left += 1e-3;
      return true;
    });
    CHECK(doubts(beside, as_it_is, span, "x_left"));
  }
}

TEST_CASE("check: a short number among such that float64 has exactly does not say that all are cut") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  REQUIRE(check(right).precision.every_digit);
  int tried = 0;
  for (std::int64_t step = 1; step <= right.size(); ++step) {
    const auto* edge = get_if<EdgeTableInsert>(&right.event(step).event);
    if (!edge || edge->dx_dy == 0) continue;
    ++tried;
    const Trace wrong = test::changed(right, [&](std::int64_t at, Event& event) {
      if (at == step) get_if<EdgeTableInsert>(&event)->dx_dy *= 1.02;
      return true;
    });
    const CheckReport report = check(wrong);
    CHECK(report.precision.every_digit);
    CHECK_FALSE(report.causes.empty());
  }
  CHECK(tried > 1);
}

TEST_CASE("check: what numbers are rounded by is told in units of the last digit that is written") {
  for (const Printed& printed : test::all_printed()) {
    if (!printed.cut() || printed.held > 0) continue;
    CAPTURE(std::string(printed.name));
    const CheckReport report = check(test::run_printed(printed));
    CHECK(report.rounded > 0);
    CHECK(report.largest_rounding > 0.01);
    CHECK(report.largest_rounding < 40);  // of a difference of larger numbers, of its own last digit
  }
}

TEST_CASE("check: fixed point shows where the header declares neither the format nor which depths they are") {
  const Scene scene = look_at_scene(load_scene("pyramid").scene, {});
  for (const auto depth : {Conventions::Depth::view, Conventions::Depth::pseudodepth, Conventions::Depth::reciprocal}) {
    CAPTURE(static_cast<int>(depth));
    Conventions conventions;
    conventions.number_format = NumberFormat::fixed16, conventions.depth = depth;
    conventions.interpolation = Conventions::Interpolation::increments;
    const Trace run = test::recorded_by("z-buffer", scene, conventions);
    REQUIRE(check(run).causes.empty());
    Header header = run.header();
    header.conventions.number_format = NumberFormat::float64,
    header.conventions.depth = Conventions::Depth::pseudodepth;
    for (const Convention one : {Convention::number_format, Convention::depth})
      header.undeclared |= static_cast<decltype(header.undeclared)>(1u << static_cast<unsigned>(one));
    TraceRecorder recorder(header, run.scene());
    for (std::int64_t step = 1; step <= run.size(); ++step)
      record_any(recorder, run.event(step).step, run.event(step).event);
    recorder.finish();
    CHECK(check(Trace::from_bytes(recorder.take_bytes(), "undeclared")).precision.format == NumberFormat::fixed16);
  }
}

TEST_CASE("check: a number of each format, and printed in each way, is held to no more and no less than its digits") {
  // Far away the share of a depth is more than the amount.
  for (const double away : {0.0, 1e6})
    for (const Printed& printed : test::all_printed()) {
      if (away > 0 && !printed.declared && !printed.cut()) continue;  // all digits of such depths look like float64
      CAPTURE(std::string(printed.name));
      CAPTURE(away);
      const test::Run of{"z-buffer", away};
      const Trace right = test::run_printed(printed, of);
      if (printed.held == 0) CHECK(check(right).causes.empty());
      const std::int64_t step = first_step<EdgeTableInsert>(right);
      const auto edge = get<EdgeTableInsert>(right.event(step).event);
      REQUIRE(edge.vertex_0 == static_cast<std::int32_t>(test::upright_from));
      REQUIRE(edge.vertex_1 == static_cast<std::int32_t>(test::upright_to));
      // The upper vertex lies on a scan line: x = x_0 and z = z_0 where neither changes along the edge.
      const auto holds = [&](const char* field, double value, const glm::dvec3& along) {
        CAPTURE(std::string(field));
        const Sides sides = sides_of(along.z == 0 ? printed.of_position(value) : printed.of(value), 0);
        const double in_scene = glm::dot(along, right.scene().points[test::upright_from]);
        const auto doubted = [&](double off) {
          return doubts(test::run_beside(printed, of, (value + off - in_scene) * along), printed, step, field);
        };
        CHECK(!doubted(sides.within));
        CHECK(!doubted(-sides.within));
        CHECK(doubted(sides.beyond));
        CHECK(doubted(-sides.beyond));
      };
      holds("x_edge", edge.x_edge, {1, 0, 0});
      holds("z_edge", edge.z_edge, {0, 0, 1});
    }
}

TEST_CASE("check: a sum is held to what both its operands may be off by, and what is only copied to its own digits") {
  for (const Printed& printed : test::all_printed()) {
    if (printed.held > 0) continue;  // more digits than can be printed
    CAPTURE(std::string(printed.name));
    const Trace right = test::run_printed(printed);
    // x + 1/m
    const std::int64_t moved = first_step<EdgeStep>(right);
    const std::int32_t edge = get<EdgeStep>(right.event(moved).event).edge;
    const auto inserted = right.next<EdgeTableInsert>(0, [&](const EdgeTableInsert& e) { return e.edge == edge; });
    REQUIRE(inserted);
    const auto entry = get<EdgeTableInsert>(right.event(*inserted).event);
    const double x = entry.x_edge + entry.dx_dy;
    const auto sum_doubted = [&](double off) {
      const Trace run = test::run_printed(printed, {}, [&](std::int64_t step, Event& event) {
        if (step == moved) get<EdgeStep>(event).x_edge = printed.as_printed(x + off);
      });
      return doubts(run, printed, moved, "x_edge");
    };
    const Sides of_sum =
        sides_of(printed.of_position(std::abs(entry.x_edge) + std::abs(entry.dx_dy), 2), printed.last_digit(x));
    CHECK(!sum_doubted(of_sum.within));
    CHECK(sum_doubted(of_sum.beyond));

    // zbuffer[x,y] = z
    const std::int64_t written = first_step<DepthWrite>(right);
    const double z = get<DepthWrite>(right.event(written).event).z;
    const auto copy_doubted = [&](double off) {
      const Trace run = test::run_printed(printed, {}, [&](std::int64_t step, Event& event) {
        if (step == written) get<DepthWrite>(event).z = printed.as_printed(z + off);
      });
      return doubts(run, printed, written, "z");
    };
    const Sides of_copy = sides_of(printed.of(z), printed.last_digit(z));
    CHECK(!copy_doubted(of_copy.within));
    CHECK(copy_doubted(of_copy.beyond));
  }
}

TEST_CASE("check: a side of an extent is held to its own digits, or to the amount that numbers may be off by") {
  for (const bool drawn : {true, false})  // float32 shows in depths and positions, or in all numbers
    for (const Printed& printed : test::all_printed()) {
      if (!printed.declared && bits_of(printed.computed) > 0) continue;  // it shows in depths on spans alone
      if (!drawn && printed.cut()) continue;
      CAPTURE(std::string(printed.name));
      CAPTURE(drawn);
      const test::Run of{"depth-sort", 0, drawn};
      const Trace right = test::run_printed(printed, of);
      const std::int64_t step = first_step<Extent>(right);
      const double low = get<Extent>(right.event(step).event).x_min;
      REQUIRE(low == right.scene().points[test::upright_from].x);
      const auto doubted = [&](double off) {
        return doubts(test::run_beside(printed, of, {off, 0, 0}), printed, step, "x_min");
      };
      const Sides sides = sides_of(std::max(printed.share * low, printed.amount_of_positions()), 0);
      CHECK(!doubted(sides.within));
      CHECK(doubted(sides.beyond));
    }
}

TEST_CASE("check: which of two depths is nearer is not judged where the digits that are printed do not tell") {
  for (const Printed& printed : test::all_printed()) {
    if (printed.held > 0) continue;
    CAPTURE(std::string(printed.name));
    const Trace right = test::run_printed(printed);
    std::vector<double> stored(16 * 16, no_depth);
    std::optional<std::int64_t> second;
    double before = 0;
    for (std::int64_t step = 1; step <= right.size() && !second; ++step) {
      const Event event = right.event(step).event;
      const auto pixel = [](const auto& e) { return static_cast<std::size_t>(e.y * 16 + e.x); };
      if (const auto* write = get_if<DepthWrite>(&event)) stored[pixel(*write)] = write->z;
      if (const auto* compared = get_if<DepthCompare>(&event))
        if (before = stored[pixel(*compared)]; std::isfinite(before)) second = step;
    }
    REQUIRE(second);
    // Farther by so much, and called nearer.
    const auto doubted = [&](double off) {
      const Trace run = test::run_printed(printed, {}, [&](std::int64_t step, Event& event) {
        if (step != *second) return;
        get<DepthCompare>(event).z = printed.as_printed(before + off), get<DepthCompare>(event).nearer = true;
      });
      return doubts(run, printed, *second, "nearer");
    };
    const Sides sides = sides_of(printed.of(before), printed.last_digit(before));
    CHECK(doubted(sides.within) == !printed.cut());
    CHECK(doubted(sides.beyond));
  }
}

TEST_CASE("check: the pixels of a span are its edges' but where the digits that are printed do not tell") {
  for (const Printed& printed : test::all_printed()) {
    if (printed.held > 0) continue;
    CAPTURE(std::string(printed.name));
    const Trace right = test::run_printed(printed);
    const std::int64_t begun = first_step<SpanBegin>(right);
    // The left edge lies so far beside the centre of pixel 3, and the span begins so many pixels late.
    const auto doubted = [&](double beside, int late = 1) {
      const Trace run = test::run_printed(printed, {}, [&](std::int64_t step, Event& event) {
        if (step != begun) return;
        auto& span = get<SpanBegin>(event);
        span.x_left = printed.as_printed(3 + beside);
        span.first = static_cast<std::int32_t>(std::ceil(span.x_left)) + late;
      });
      return doubts(run, printed, begun, "first");
    };
    const Sides sides = sides_of(printed.of_position(2.99), printed.last_digit(2.99));
    CHECK(doubted(-sides.within) == !printed.cut());
    CHECK(doubted(-sides.within, 2));
    CHECK(doubted(-sides.beyond));
    CHECK(doubted(0.4));
  }
}

TEST_CASE("check: depths are in fixed point where they are whole numbers of units but for 1/100 000 of one") {
  for (const Printed& printed : test::all_printed()) {
    if (printed.declared || bits_of(printed.computed) == 0) continue;
    CAPTURE(std::string(printed.name));
    const double unit = test::range_of_z / (std::pow(2, bits_of(printed.computed)) - 1);
    const auto format_of = [&](double off) {
      return precision_of(test::run_printed(printed, {},
                                            [&](std::int64_t, Event& event) {
                                              if (auto* depth = get_if<DepthInterpolate>(&event))
                                                depth->z += off * unit;
                                              if (auto* compared = get_if<DepthCompare>(&event))
                                                compared->z += off * unit;
                                            }))
          .format;
    };
    CHECK(format_of(0.9e-5) == printed.computed);
    CHECK(format_of(1.5e-5) != printed.computed);
  }
}

}  // namespace
