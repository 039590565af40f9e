// zstep diff: by how much two runs may be apart, held from both sides (docs/comparing-runs.md). What is apart by 0.9 of
// it is rounding, and what is apart by 1.5 of it is a cause, at its step.
#include "traces/diff/diff.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/unit/traces/printed_runs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/diff/buffers.hpp"

using namespace zstep;
using test::Printed;

namespace {

/// The numbers of a run, some of them changed, by a program that declares what it computes in.
template <class Change>
Trace declared_as(NumberFormat format, const Trace& run, Change&& change) {
  Header header = run.header();
  header.conventions.number_format = format;
  const auto bit = std::uint8_t{1} << static_cast<unsigned>(Convention::number_format);
  header.undeclared = static_cast<std::uint8_t>(header.undeclared & ~bit);
  TraceRecorder recorder(header, run.scene());
  for (std::int64_t step = 1; step <= run.size(); ++step) {
    RecordedEvent recorded = run.event(step);
    change(step, recorded.event);
    record_any(recorder, recorded.step, recorded.event);
  }
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "declared");
}
/// Nothing from which depths follow is left.
Trace without_operands(const Trace& run) {
  TraceRecorder recorder(run.header(), run.scene());
  for (std::int64_t step = 1; step <= run.size(); ++step) {
    const RecordedEvent recorded = run.event(step);
    if (holds<BuffersClear>(recorded.event) ||  // and no polygon, by which the scene would say what depths must be
        holds<DepthCompare>(recorded.event) || holds<DepthWrite>(recorded.event) || holds<PixelWrite>(recorded.event))
      record_any(recorder, recorded.step, recorded.event);
  }
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "without operands");
}

/// Is this step a cause that rounding does not explain, whichever of the two runs is A?
bool parts(const Trace& one, const Trace& other, const Printed& printed, std::int64_t step) {
  const auto found = [&](const Trace& a, const Trace& b) {
    const diff::DiffReport report = diff::compare(a, b, nullptr, diff::Way::fast, printed.held);
    return std::any_of(report.causes.begin(), report.causes.end(), [&](const diff::Cause& cause) {
      return cause.part == diff::Part::different && cause.first.a == step && cause.first.b == step;
    });
  };
  const bool as_a = found(one, other), as_b = found(other, one);
  CHECK(as_a == as_b);
  return as_a;
}

/// Each way of printing numbers beside a run that declares float64 or float32 and has all its digits.
template <class Use>
void for_each_pair(Use&& use) {
  for (const double away : {0.0, 1e6})
    for (const NumberFormat other : {NumberFormat::float64, NumberFormat::float32})
      for (const Printed& printed : test::all_printed()) {
        if (away > 0 && !printed.declared && !printed.cut()) continue;  // all digits of such depths look like float64
        CAPTURE(std::string(printed.name));
        CAPTURE(std::string(word_of(other)));
        CAPTURE(away);
        Printed coarser = printed;
        coarser.share = std::max(printed.share, other == NumberFormat::float32 ? 1e-6 : 1e-9);
        use(printed, coarser, other, test::run_printed(printed, {"z-buffer", away}));
      }
}
template <class E>
std::int64_t first_of(const Trace& run) {
  const auto found = run.next<E>(0, [](const E&) { return true; });
  REQUIRE(found);
  return *found;
}

TEST_CASE("diff: numbers that follow from nothing recorded are apart by what the coarser format lets both be off by") {
  for_each_pair([](const Printed& printed, const Printed& coarser, NumberFormat other, const Trace& whole) {
    if (printed.digits > 0) return;  // such depths alone are whole, or look like so many decimals
    const Trace run = without_operands(whole);
    const std::int64_t compared = first_of<DepthCompare>(run), written = first_of<DepthWrite>(run);
    const double z = get<DepthCompare>(run.event(compared).event).z;
    const auto apart = [&](double off) {
      return parts(run,
                   declared_as(other, run,
                               [&](std::int64_t step, Event& event) {
                                 if (step == compared) get<DepthCompare>(event).z += off;
                                 if (step == written) get<DepthWrite>(event).z += off;
                               }),
                   printed, compared);
    };
    const double allowed = coarser.of(z, 2);
    CHECK(!apart(0.9 * allowed));
    CHECK(!apart(-0.9 * allowed));
    CHECK(apart(1.5 * allowed));
    CHECK(apart(-1.5 * allowed));
  });
}

TEST_CASE("diff: a number that follows from its own run's operands is held to what these may be off by") {
  for_each_pair([](const Printed& printed, const Printed& coarser, NumberFormat other, const Trace& run) {
    const std::int64_t moved = first_of<EdgeStep>(run), written = first_of<DepthWrite>(run);
    const auto at = get<EdgeStep>(run.event(moved).event);
    const auto inserted = run.next<EdgeTableInsert>(0, [&](const EdgeTableInsert& e) { return e.edge == at.edge; });
    REQUIRE(inserted);
    const auto entry = get<EdgeTableInsert>(run.event(*inserted).event);
    const double x = entry.x_edge + entry.dx_dy, z = get<DepthWrite>(run.event(written).event).z;
    const auto sum_apart = [&](double off) {
      return parts(run,
                   declared_as(other, run,
                               [&](std::int64_t step, Event& event) {
                                 if (step == moved) get<EdgeStep>(event).x_edge = x + off;
                               }),
                   printed, moved);
    };
    const double of_sum = coarser.of_position(std::abs(entry.x_edge) + std::abs(entry.dx_dy), 2);
    CHECK(!sum_apart(0.9 * of_sum));
    CHECK(sum_apart(1.5 * of_sum));
    const auto copy_apart = [&](double off) {
      return parts(run,
                   declared_as(other, run,
                               [&](std::int64_t step, Event& event) {
                                 if (step == written) get<DepthWrite>(event).z = z + off;
                               }),
                   printed, written);
    };
    CHECK(!copy_apart(0.9 * coarser.of(z)));
    CHECK(copy_apart(1.5 * coarser.of(z)));
  });
}

TEST_CASE("diff: depths of two pictures are apart by the coarser format's share or amount, or the bound of theory") {
  for_each_pair([](const Printed& printed, const Printed& coarser, NumberFormat other, const Trace& run) {
    HeldTo held(printed.held);
    const double z = get<DepthWrite>(run.event(first_of<DepthWrite>(run)).event).z;
    const double of_format = std::max(coarser.share * z, coarser.amount);
    for (const double bound : {0.0, 10 * of_format}) {
      // The pixel (1, 0) alone has it.
      if (bound > 0) held.depths = std::make_shared<DepthBounds>(DepthBounds{2, {0, bound}});
      const auto none = [](std::int64_t, Event&) {};
      const Precision precision =
          diff::compare(run, declared_as(other, run, none), nullptr, diff::Way::fast, held).precision;
      const auto apart = [&](double at_0, double at_1) {
        const std::vector<double> a{z, z}, b{z + at_0, z - at_1};
        const diff::BufferDifference found = diff::compare_depths(a, b, precision);
        CHECK(found.depths + found.depths_rounded == 2);
        return found.depths;
      };
      const double allowed = std::max(of_format, bound);
      CHECK(apart(0.9 * of_format, 0.9 * allowed) == 0);
      CHECK(apart(0.9 * of_format, 1.5 * allowed) == 1);
      CHECK(apart(1.5 * of_format, 0.9 * allowed) == 1);
    }
  });
}

TEST_CASE("diff: another verdict is rounding where the two depths are apart by no more, and the headers do not tell") {
  const auto part_of = [](double apart) {
    zoo::Task task;
    task.width = 12, task.height = 10;
    for (const double z : {0.5, 0.5 * (1 + apart)}) {
      const int first = static_cast<int>(task.points.size());
      for (const auto& [x, y] : {std::pair(1.0, 1.0), {10.5, 2.0}, {4.0, 8.5}}) task.points.push_back({x, y, z});
      task.polygons.push_back({static_cast<int>(task.polygons.size()), {first, first + 1, first + 2}});
    }
    std::string text = test::head(task, "float64", "direct") + zoo::edge_table(task);
    const std::string declared = "\"nearer\":\"smaller\",\"ties\":\"first\",";
    REQUIRE(text.find(declared) != std::string::npos);
    text.erase(text.find(declared), declared.size());
    const Trace run = test::trace_of(text);
    const auto second = run.next<DepthCompare>(0, [](const DepthCompare& e) { return !e.nearer; });
    REQUIRE(second);
    const Trace other = declared_as(NumberFormat::float64, run, [&](std::int64_t step, Event& event) {
      if (step == *second) get<DepthCompare>(event).z *= 1 + 1e-12, get<DepthCompare>(event).nearer = true;
    });
    const diff::DiffReport report = diff::compare(run, other);
    REQUIRE(report.causes.size() == 1);
    CHECK(report.causes[0].first.b == *second);
    return report.causes[0].part;
  };
  // Each of the two depths may be off by 10⁻⁹ of itself.
  CHECK(part_of(1e-9) == diff::Part::rounding);
  CHECK(part_of(40e-9) == diff::Part::different);
}

}  // namespace
