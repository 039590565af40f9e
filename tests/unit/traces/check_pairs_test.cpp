// Pairs of pieces, the list that they are taken from, and what one step says of another: each is changed in every
// golden trace that has it, and named.
#include <optional>
#include <string_view>

#include <doctest/doctest.h>

#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"

using namespace zstep;

namespace {

/// Calls use(trace, step, event) for each step of the kind of which may(event) is true, in each golden trace that has
/// pairs, or in all. How many there are.
enum class Runs : std::uint8_t { with_pairs, all };
template <class E, class May, class Use>
int for_each_step(Runs runs, May&& may, Use&& use) {
  int steps = 0;
  test::for_each_golden([&](const std::string& golden, const Trace& right) {
    if (runs == Runs::with_pairs && !right.has(kind_of<PairBegin>)) return;
    for (auto step = right.next<E>(0, may); step; step = right.next<E>(*step, may)) {
      CAPTURE(golden);
      CAPTURE(*step);
      ++steps;
      use(right, *step, get<E>(right.event(*step).event));
    }
  });
  return steps;
}
template <class E, class Change>
Trace with(const Trace& right, std::int64_t step, Change&& change) {
  return test::changed(right, [&](std::int64_t number, Event& event) {
    if (number == step) change(*get_if<E>(&event));
    return true;
  });
}
Trace without(const Trace& right, std::int64_t step) {
  return test::changed(right, [&](std::int64_t number, Event&) { return number != step; });
}
/// Where a run breaks this rule first.
std::optional<std::int64_t> broken_at(const Trace& run, std::string_view rule) {
  for (const Cause& cause : check(run).causes)
    if (cause.first.rule && rule_text(*cause.first.rule).name == rule) return cause.first.step;
  return std::nullopt;
}
bool diff_names(const Trace& right, const Trace& wrong, std::int64_t step) {
  const diff::DiffReport report = diff::compare(right, wrong);
  if (report.causes.empty()) return false;
  const diff::Difference& first = report.causes.front().first;
  return first.a == step || first.b == step;
}
constexpr auto any = [](const auto&) { return true; };
constexpr auto crosses = [](const SideTest& e) { return e.side == Side::crossing; };
constexpr auto decides = [](const SideTest& e) { return e.side != Side::crossing; };

TEST_CASE("check: a pair is the first piece of the list and another one in it") {
  const auto is_wrong = [](const Trace& right, std::int64_t step, const PairBegin& pair) {
    for (const PairBegin wrong : {PairBegin{pair.other, pair.piece}, PairBegin{pair.piece, pair.piece}})
      CHECK(broken_at(with<PairBegin>(right, step, [&](PairBegin& e) { e = wrong; }), "pair_in_list") == step);
  };
  CHECK(for_each_step<PairBegin>(Runs::with_pairs, any, is_wrong) > 50);
}

/// A test of another piece than those of its pair; and where the test begins, in a run without that pair.
template <class E>
Trace of_third(const Trace& right, std::int64_t step, const E& e) {
  std::int32_t other = 0;
  if constexpr (requires { e.plane_of; }) other = e.plane_of;
  else other = e.other;
  const std::int32_t third = e.piece != 0 && other != 0 ? 0 : e.piece != 1 && other != 1 ? 1 : 2;
  return with<E>(right, step, [&](E& changed) { changed.piece = third; });
}

TEST_CASE("check: two pieces are tested as the pair at work") {
  const auto is_named = [](const Trace& right, std::int64_t step, const auto& e) {
    CHECK(broken_at(of_third(right, step, e), "test_of_pair") == step);
  };
  CHECK(for_each_step<ExtentTest>(Runs::with_pairs, any, is_named) > 50);
  CHECK(for_each_step<OverlapTest>(Runs::with_pairs, any, is_named) > 5);
  CHECK(for_each_step<SideTest>(Runs::with_pairs, decides, is_named) > 10);
  // A piece of a ring may be cut by the plane of any other one in it.
  const auto is_free = [](const Trace& right, std::int64_t step, const auto& e) {
    CHECK(broken_at(of_third(right, step, e), "test_of_pair") != step);
  };
  CHECK(for_each_step<SideTest>(Runs::with_pairs, crosses, is_free) > 5);
}

TEST_CASE(
    "a piece that does not enter the list is named by check where pieces are compared or drawn first, and by diff "
    "where it should have entered") {
  int lists = 0;
  test::for_each_golden([&](const std::string& golden, const Trace& right) {
    const auto used =
        right.next(0, [](const RecordedEvent& e) { return holds<PairBegin>(e.event) || holds<PieceDraw>(e.event); });
    if (!used || !right.has(kind_of<ListInsert>)) return;
    CAPTURE(golden);
    for (auto step = right.next<ListInsert>(0, any); step && *step < *used; step = right.next<ListInsert>(*step, any)) {
      CAPTURE(*step);
      ++lists;
      const Trace wrong = without(right, *step);
      CHECK(broken_at(wrong, "list_is_whole") == *used - 1);
      CHECK(diff_names(right, wrong, *step));
    }
  });
  CHECK(lists > 20);
}

TEST_CASE("check: an edge of a piece that is drawn is of the piece's polygon") {
  int edges = 0;
  for_each_step<EdgeTableInsert>(Runs::all, any, [&](const Trace& right, std::int64_t step, const EdgeTableInsert& e) {
    if (!right.has(kind_of<PieceDraw>)) return;
    ++edges;
    const Trace wrong =
        with<EdgeTableInsert>(right, step, [&](EdgeTableInsert& changed) { changed.polygon = e.polygon == 0 ? 1 : 0; });
    const CheckReport report = check(wrong);
    REQUIRE(!report.causes.empty());
    CHECK(report.causes.front().first.step == step);
    CHECK(report.causes.front().first.field == "polygon");
  });
  CHECK(edges > 100);
}

TEST_CASE("check: a span has two edges, also where both are at one place") {
  const auto at_one_place = [](const SpanBegin& e) { return e.x_left == e.x_right; };
  const int spans = for_each_step<SpanBegin>(
      Runs::all, at_one_place, [](const Trace& right, std::int64_t step, const SpanBegin& span) {
        const Trace left = with<SpanBegin>(right, step, [&](SpanBegin&e) { e.right_edge = span.left_edge; }),
                    turned = with<SpanBegin>(right, step, [&](SpanBegin&e) { e.left_edge = span.right_edge; });
        CHECK(broken_at(left, "span_pairs") == step);
        CHECK(broken_at(turned, "span_pairs") == step);
      });
  CHECK(spans > 3);
}

TEST_CASE("diff: a scan line that is not begun, though its spans are there, is missing") {
  int with_spans = 0;
  test::for_each_golden([&](const std::string& golden, const Trace& right) {
    // Where a polygon is drawn in parts, of two scan lines that look alike the second one is taken for the missing one.
    if (right.scene().facets.size() != right.scene().polygons.size() || right.has(kind_of<SplitVertex>)) return;
    CAPTURE(golden);
    for (auto step = right.next<ScanLineBegin>(0, any); step; step = right.next<ScanLineBegin>(*step, any)) {
      CAPTURE(*step);
      const auto next = right.next(*step, [](const RecordedEvent& e) {
        return holds<ScanLineBegin>(e.event) || holds<PolygonBegin>(e.event) || holds<SpanBegin>(e.event);
      });
      const bool spans = next && holds<SpanBegin>(right.event(*next).event);
      with_spans += spans;
      if (spans) CHECK(diff_names(right, without(right, *step), *step));
    }
  });
  CHECK(with_spans > 100);
}

}  // namespace
