// zstep check: right runs are not doubted, and of wrong ones the first wrong step is named.
#include "traces/check/check.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/depths.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// "interp.z", "span.list_in_order": the line of the pseudo-code, and the field or the rule.
std::string name_of(const Trace& trace, const Fault& fault) {
  const StepInfo* step = find_step(trace.header().page, fault.line);
  return fmt::format("{}.{}", step ? step->name : "?",
                     fault.rule ? std::string(rule_text(*fault.rule).name)
                     : fault.field.empty() ? "impossible" : fault.field);
}

std::string causes_of(const Trace& trace) {
  std::string names;
  for (const Cause& cause : check(trace).causes)
    names += fmt::format("{}{}@{}", names.empty() ? "" : " ", name_of(trace, cause.first), cause.first.step);
  return names;
}

TEST_CASE("check: in a run that records compares and no writes, a compare that is nearer writes") {
  const Trace trace = test::trace_of(
      R"({"ztrace":1,"writer":"my program","algorithm":"z-buffer","conventions":{"depth":"view","nearer":"smaller"},)"
      R"("steps":[{"id":1,"name":"compare","event":"depth_compare"}],"scene":{"raster":{"width":4,"height":4},)"
      R"("camera":{"kind":"screen"},"points":[[0,0,5],[4,0,5],[0,4,5]],"polygons":[{"name":"A"}],)"
      R"("facets":[{"polygon":0,"points":[0,1,2]}]}})"
      "\n"
      R"({"step":"compare","x":1,"y":1,"z":5,"nearer":true})"
      "\n"
      R"({"step":"compare","x":1,"y":1,"z":4,"nearer":true})"
      "\n"
      R"({"step":"compare","x":1,"y":1,"z":4.5,"nearer":false})"
      "\n"
      R"({"step":"compare","x":1,"y":1,"z":4.25,"nearer":true})"
      "\n");
  CHECK(causes_of(trace) == "compare.nearer@4");
  Replay replay(trace);
  const auto depth = [&](std::int64_t step) {
    replay.go_to(step);
    return replay.state().picture.depth[replay.state().picture.at(1, 1)];
  };
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(depth(4) == 4.25);
  CHECK(depth(3) == 4);
  CHECK(depth(2) == 4);
  CHECK(depth(1) == 5);
  CHECK(depth(0) == inf);
}

TEST_CASE("check: each step of every golden trace follows from its own operands, to the last bit") {
  std::int64_t numbers = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const CheckReport report = check(trace);
    CHECK(causes_of(trace) == "");
    CHECK(report.steps == trace.size());
    // Formulas are evaluated in float64: what a run computes in other numbers they give but for rounding.
    if (trace.header().conventions.number_format == NumberFormat::float64) CHECK(report.exact == report.numbers);
    CHECK(report.inherited == 0);
    numbers += report.numbers;
  });
  CHECK(numbers > 15'000);
}

TEST_CASE("check: depths of which the trace does not have the operands are said not to be judged") {
  // No spans: of a depth that is compared nothing says what it should be.
  const Trace whole = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  const Trace without_spans = test::changed(whole, [](std::int64_t, const Event& event) {
    return !holds<SpanBegin>(event) && !holds<DepthInterpolate>(event);
  });
  CHECK(depths_not_judged(without_spans) == std::vector<std::uint8_t>{kind_of<DepthCompare>});
}

TEST_CASE("check: of foreign traces the first wrong step is named, and right ones are not doubted") {
  const std::map<std::string, std::string> first{
      {"alwayswrite", "wp.write_after_win@212"},
      {"facing_wrong", "facing.facing@187"},
      {"halfcompare", "compare.z@15"},
      {"insert_wrong", "insert.first_row@6"},
      {"nowrite", "interp.win_is_written@17"},
      {"retire_early", "retire.edge_retires@81"},
      {"skip", "skip.skip_is_right@190"},
      {"span_end", "insert.first_row@7"},  // it rounds to the nearest scan line; its header does not say so
      {"span_wrong", "span.span_pairs@13"},
      {"swap", "swap.swap_needed@81"},
      {"unsorted", "enter.edge_sorted@10"},
      {"wrongcolour", "wp.polygon@201"},
      {"wrongdepth", "wz.z@16"},
      {"wrongz", "interp.z@14"},
      {"big", ""},
      {"clear1", ""},
      {"f32", ""},
      {"far", ""},
      {"far1", ""},
      {"greater", ""},
      {"greater_minf", ""},
      {"near9", ""},
      {"nocompare", ""},
      {"nopoly", ""},
      {"painter", ""},
      {"torn", ""},
      {"writefirst", ""},
  };
  for (const auto& file : first) {
    CAPTURE(file.first);
    const Trace trace = open_jsonl(test::in_checkout("tests/data/foreign/" + file.first + ".jsonl"));
    const CheckReport report = check(trace);
    const std::string named = report.causes.empty() ? ""
                                                    : fmt::format("{}@{}", name_of(trace, report.causes.front().first),
                                                                  report.causes.front().first.step);
    CHECK(named == file.second);
  }
}

TEST_CASE("check: an error is counted where it is made, and what follows from it as its consequence") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/pyramid-view.jsonl"));
  const auto won = right.next<DepthCompare>(0, [](const DepthCompare& e) { return e.nearer; });
  REQUIRE(won);
  const auto nearer = get<DepthCompare>(right.event(*won).event);
  // One depth is interpolated wrongly, and all goes on from there.
  const Trace wrong = test::changed(right, [&](std::int64_t step, Event& event) {
    visit_event(
        [&]<class E>(E& e) {
          if constexpr (requires { e.x; e.y; e.z; })
            if (step >= *won - 1 && step <= *won + 1 && e.x == nearer.x && e.y == nearer.y) e.z -= 0.001;
        },
        event);
    return true;
  });
  const CheckReport report = check(wrong);
  REQUIRE(report.causes.size() == 1);
  const Cause& cause = report.causes[0];
  CHECK(cause.first.step == *won - 1);
  CHECK(cause.first.field == "z");
  CHECK(cause.first.recorded - cause.first.expected == doctest::Approx(-0.001));
  CHECK(cause.again == 0);
  CHECK(cause.inherited >= 3);  // the compare, the two writes, and what is compared with them later
  CHECK(report.inherited == cause.inherited);
  CHECK(report.wrong_steps == 1);
}

TEST_CASE("check: numbers that a program writes with few digits are not doubted, and errors beyond them are") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/pyramid-view.jsonl"));
  for (const int decimals : {4, 6}) {
    CAPTURE(decimals);
    const double unit = std::pow(10.0, decimals);
    const auto rounded = [&](double off, std::int64_t at) {
      Header header = right.header();
      header.undeclared |= std::uint8_t{1} << static_cast<unsigned>(Convention::number_format);
      TraceRecorder recorder(header, right.scene());
      for (std::int64_t step = 1; step <= right.size(); ++step) {
        RecordedEvent recorded = right.event(step);
        visit_event(
            [&]<class E>(E& event) {
              for_each_field<E>([&](const auto& field) {
                if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
                  if (double& value = event.*field.member; std::isfinite(value))
                    value = std::round(value * unit) / unit;
              });
            },
            recorded.event);
        if (auto* edge = get_if<EdgeStep>(&recorded.event); edge && step == at) edge->x_edge += off;
        record_any(recorder, recorded.step, recorded.event);
      }
      recorder.finish();
      return Trace::from_bytes(recorder.take_bytes(), "rounded");
    };
    CHECK(causes_of(rounded(0, 0)) == "");
    const auto stepped = right.next<EdgeStep>(0, [](const EdgeStep&) { return true; });
    REQUIRE(stepped);
    CHECK(causes_of(rounded(0.01, *stepped)).starts_with(fmt::format("step_edge.x_edge@{}", *stepped)));
  }
}

/// The same run under a header that is changed.
template <class Change, class ChangeEvent>
Trace under(const Trace& right, Change&& change, ChangeEvent&& change_event) {
  Header header = right.header();
  change(header);
  TraceRecorder recorder(header, right.scene());
  for (std::int64_t step = 1; step <= right.size(); ++step) {
    RecordedEvent recorded = right.event(step);
    change_event(step, recorded.event);
    record_any(recorder, recorded.step, recorded.event);
  }
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "under");
}

TEST_CASE("check: the convention that a run follows otherwise than its header says is named, unless much is wrong still") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  const auto followed = [&](auto&& change, int wrong_depths) {
    int left = wrong_depths;
    const Trace trace = under(right, change, [&](std::int64_t, Event& event) {
      if (auto* depth = get_if<DepthInterpolate>(&event); depth && left > 0) depth->z += 100, --left;
    });
    const CheckReport report = check(trace);
    REQUIRE(report.wrong_steps > 0);
    const auto found = convention_it_follows(trace, report);
    return found ? fmt::format("{} {} {}", found->key, found->word, found->wrong_steps) : "none";
  };
  const auto greater = [](Header& header) { header.comparison.nearer = Comparison::Nearer::greater; };
  CHECK(followed(greater, 0) == "nearer smaller 0");
  CHECK(followed([](Header& header) { header.comparison.ties = Comparison::Ties::last; }, 0) == "ties first 0");
  const std::int64_t wrong = check(under(right, greater, [](std::int64_t, Event&) {})).wrong_steps;
  REQUIRE(wrong > 20);
  // Depths that are wrong under any convention: fewer than a tenth of all that is, and about a fifth.
  CHECK(followed(greater, 1).starts_with("nearer smaller "));
  CHECK(followed(greater, static_cast<int>(wrong / 4)) == "none");
  CHECK(followed([](Header&) {}, 1) == "none");
}

/// Fields that a formula gives in every golden trace of the Z-buffer where they occur.
bool is_derived(std::uint8_t kind, std::string_view field) {
  static const std::map<std::uint8_t, std::vector<std::string_view>> derived{
      {kind_of<ViewTransform>, {"x_v", "y_v", "z_v"}},
      {kind_of<Projection>, {"x_p", "y_p", "z"}},
      {kind_of<ViewportTransform>, {"x_s", "y_s"}},
      {kind_of<FacingTest>, {"view_dot_normal", "plane_at_eye", "determinant", "projected_normal_z"}},
      {kind_of<ClipVertex>, {"distance"}},
      {kind_of<ClipCross>, {"t", "x_v", "y_v", "z_v"}},
      {kind_of<EdgeTableInsert>, {"x_edge", "dx_dy", "z_edge", "dz_dy"}},
      {kind_of<EdgeStep>, {"x_edge", "z_edge"}},
      {kind_of<SpanBegin>, {"x_left", "z_left", "x_right", "z_right"}},
      {kind_of<DepthInterpolate>, {"z"}},
      {kind_of<DepthCompare>, {"z"}},
      {kind_of<DepthWrite>, {"z"}},
  };
  const auto found = derived.find(kind);
  return found != derived.end() && std::find(found->second.begin(), found->second.end(), field) != found->second.end();
}

TEST_CASE("check: a number that is changed anywhere is the first cause") {
  std::mt19937_64 random(16);
  std::map<std::pair<std::string, std::string>, std::array<int, 3>> found;  // here, later, never
  for (const char* name : {"pyramid-view", "clipping", "foley", "cube-ortho", "edges"}) {
    const Trace right = open_jsonl(test::in_checkout(fmt::format("tests/golden/{}.jsonl", name)));
    for (int trial = 0; trial < 150; ++trial) {
      const std::int64_t at = 1 + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(right.size()));
      std::string kind, changed_field;
      bool must = false;
      const Trace wrong = test::changed(right, [&](std::int64_t step, Event& event) {
        if (step != at) return true;
        visit_event(
            [&]<class E>(E& e) {
              std::vector<std::pair<double E::*, std::string>> numbers;
              for_each_field<E>([&](const auto& field) {
                if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
                  if (std::isfinite(e.*field.member)) numbers.emplace_back(field.member, std::string(field.name));
              });
              if (numbers.empty()) return;
              const auto& [member, field] = numbers[random() % numbers.size()];
              e.*member += (random() % 2 ? 1 : -1) * std::max(std::abs(e.*member), 1.0) * 1e-6;
              kind = kind_text<E>.name, changed_field = field;
              must = is_derived(kind_of<E>, field);
            },
            event);
        return true;
      });
      if (kind.empty()) continue;
      const CheckReport report = check(wrong);
      const bool here = !report.causes.empty() && report.causes[0].first.step == at;
      ++found[{kind, changed_field}][here ? 0 : report.causes.empty() ? 2 : 1];
      CAPTURE(name);
      CAPTURE(at);
      CAPTURE(kind);
      CAPTURE(changed_field);
      if (must) CHECK(here);
    }
  }
  int all = 0, here = 0;
  for (const auto& row : found) here += row.second[0], all += row.second[0] + row.second[1] + row.second[2];
  MESSAGE("changed numbers named as the first cause: ", here, " of ", all);
  CHECK(here >= 0.9 * all);
}

}  // namespace
