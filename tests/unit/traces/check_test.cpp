// zstep check: right runs are not doubted, and of wrong ones the first wrong step is named.
#include "traces/check/check.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"
#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// "interp.z", "span.list_in_order": the line of the pseudo-code, and the field or the rule.
std::string name_of(const Trace& trace, const Fault& fault) {
  const StepInfo* step = find_step(trace.header().page, fault.line);
  return fmt::format("{}.{}", step ? step->name : "?",
                     fault.rule            ? std::string(rule_text(*fault.rule).name)
                     : fault.field.empty() ? "impossible"
                                           : fault.field);
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

/// A run of two triangles on a raster of 12x10, as a program prints it; `table`: the names of its steps and their
/// events. `thin`: A has no area, so that the scene says nothing of its pixels.
std::string small_head(const std::string& interpolation, const std::vector<std::pair<const char*, const char*>>& table,
                       bool thin = false) {
  std::string steps;
  for (std::size_t i = 0; i < table.size(); ++i)
    steps += fmt::format(R"({}{{"id":{},"name":"{}","event":"{}"}})", i == 0 ? "" : ",", i + 1, table[i].first,
                         table[i].second);
  return fmt::format(
      R"({{"ztrace":1,"writer":"my program","algorithm":"z-buffer","conventions":{{"depth":"view","nearer":"smaller",)"
      R"("ties":"first","interpolation":"{}","number_format":"float64"}},"steps":[{}],"scene":{{"raster":{{"width":12,)"
      R"("height":10}},"camera":{{"kind":"screen"}},"points":[[1,1,10],{},[4,8,20],[2,7,50],[1,2,5],[10,6,15]],)"
      R"("polygons":[{{"name":"A"}},{{"name":"B"}}],"facets":[{{"polygon":0,"points":[0,1,2]}},)"
      R"({{"polygon":1,"points":[3,4,5]}}]}}}})"
      "\n",
      interpolation, steps, thin ? "[2.5,4.5,40]" : "[10,2,40]");
}
const std::vector<std::pair<const char*, const char*>> whole_table{
    {"clear", "buffers_clear"},      {"polygon", "polygon_begin"}, {"slopes", "plane_slopes"},
    {"interp", "depth_interpolate"}, {"compare", "depth_compare"}, {"wz", "depth_write"},
    {"wp", "pixel_write"},           {"enter", "edge_enter"},      {"scan", "scan_line_begin"},
    {"insert", "edge_table_insert"}};
std::string compare_at(int x, int y, double z, bool nearer) {
  return fmt::format(R"({{"step":"compare","x":{},"y":{},"z":{},"nearer":{}}})"
                     "\n",
                     x, y, z, nearer);
}
std::string write_at(int x, int y, double z) {
  return fmt::format(R"({{"step":"wz","x":{0},"y":{1},"z":{2}}})"
                     "\n"
                     R"({{"step":"wp","x":{0},"y":{1},"polygon":0}})"
                     "\n",
                     x, y, z);
}
const std::string begin_a = R"({"step":"polygon","polygon":0,"facet":0})"
                            "\n";

bool has(const std::vector<NotJudged>& left, std::uint8_t kind, std::string_view field) {
  return std::any_of(left.begin(), left.end(), [&](const NotJudged& one) {
    return one.kind == kind && std::find(one.fields.begin(), one.fields.end(), field) != one.fields.end();
  });
}

TEST_CASE("check: what nothing in the run says is not judged, and then it is not said that nothing is wrong") {
  const Trace whole = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  const CheckReport all = check(whole);
  CHECK(not_judged(all).empty());
  CHECK(all.coverage);
  CHECK(verdict_of(all) == Verdict::right);
  // No spans: of a depth that is compared the scene says what it should be, and that no pixel is missing.
  const CheckReport by_scene = check(test::changed(whole, [](std::int64_t, const Event& event) {
    return !holds<SpanBegin>(event) && !holds<DepthInterpolate>(event);
  }));
  CHECK_FALSE(has(not_judged(by_scene), kind_of<DepthCompare>, "z"));
  CHECK(by_scene.coverage);
  CHECK(verdict_of(by_scene) == Verdict::right);
  // Nor which polygon it is: then nothing does.
  const CheckReport without_spans = check(test::changed(whole, [](std::int64_t, const Event& event) {
    return !holds<SpanBegin>(event) && !holds<DepthInterpolate>(event) && !holds<PolygonBegin>(event);
  }));
  CHECK(has(not_judged(without_spans), kind_of<DepthCompare>, "z"));
  CHECK_FALSE(without_spans.coverage);
  CHECK(verdict_of(without_spans) == Verdict::right_where_judged);
  // Not even a polygon.
  const CheckReport half = check(test::changed(whole, [polygons = 0](std::int64_t, const Event& event) mutable {
    polygons += holds<PolygonBegin>(event);
    return polygons < 2;
  }));
  CHECK(half.polygons_missing.size() + 1 == whole.scene().polygons.size());
  CHECK(verdict_of(half) == Verdict::right_where_judged);
  // Nor its last scan lines, or pixels.
  for (const std::int64_t missing : {3, 30, 60}) {
    CAPTURE(missing);
    CHECK(verdict_of(check(test::changed(whole, [&](std::int64_t step, const Event&) {
            return step <= whole.size() - missing;
          }))) == Verdict::right_where_judged);
  }
  CHECK(verdict_of(check(test::changed(whole, [](std::int64_t, const Event&) { return false; }))) ==
        Verdict::not_judged);
}

TEST_CASE("check: a span, pixels of one, or an edge that is missing is found where the run has what they follow from") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/pyramid-view.jsonl"));
  REQUIRE(causes_of(right).empty());
  const auto first_rule = [&](auto&& stays) {
    const CheckReport report = check(test::changed(right, stays));
    return report.causes.empty() || !report.causes.front().first.rule
               ? std::string("none")
               : std::string(rule_text(*report.causes.front().first.rule).name);
  };
  const auto wide = right.next<SpanBegin>(0, [](const SpanBegin& e) { return e.last > e.first + 2; });
  REQUIRE(wide);
  const auto span = get<SpanBegin>(right.event(*wide).event);
  const auto is_pixel_of = [&](const Event& event, std::int32_t first, std::int32_t last) {
    return visit_event(
        [&]<class E>(const E& e) {
          if constexpr (requires { e.x, e.y; }) return e.y == span.y && e.x >= first && e.x <= last;
          return false;
        },
        event);
  };
  const auto next_span = right.next<SpanBegin>(*wide, [](const SpanBegin&) { return true; });
  REQUIRE(next_span);
  for (const std::int32_t x : {span.first, span.first + 1, span.last})
    CHECK(first_rule([&](std::int64_t step, const Event& event) {
            return step < *wide || step > *next_span || !is_pixel_of(event, x, x);
          }) == "span_is_filled");
  CHECK(first_rule([&](std::int64_t step, const Event& event) {
          return step != *wide && (step < *wide || step > *next_span || !is_pixel_of(event, span.first, span.last));
        }) == "pair_has_span");
}

TEST_CASE("check: the edge back to a polygon's first vertex may not be forgotten") {
  zoo::Task task = test::triangles(3, 3, 18);
  const auto cause = [&](const char* mistake) {
    task.mistake = mistake;
    std::string impossible;
    return causes_of(test::trace_of(test::head(task, "float64", "increments") + zoo::edge_table(task), &impossible));
  };
  CHECK(cause("") == "");
  CHECK(cause("closing_edge_left_out").find("line.outline_is_closed@") == 0);
}

TEST_CASE("check: a run without spans whose depths go by slopes is held to them") {
  const auto run_of = [&](double off) {
    // z = 10 + 3(x − 1) + 1(y − 1) or so: the plane of A, by its slopes.
    const double dz_dx = (30.0 * 7 - 10.0 * 1) / (9.0 * 7 - 3.0 * 1), dz_dy = (10.0 * 9 - 30.0 * 3) / 60;
    std::string text = small_head("plane", whole_table) + begin_a +
                       fmt::format(R"({{"step":"slopes","polygon":0,"vertex_0":0,"vertex_1":1,"vertex_2":2,)"
                                   R"("dz_dx":{},"dz_dy":{}}})"
                                   "\n",
                                   dz_dx, dz_dy);
    // In no order that says which others should have come before.
    for (const auto& [x, y] : {std::pair(3, 3), {3, 4}, {4, 3}}) {
      const double z = 10 + dz_dx * (x - 1) + dz_dy * (y - 1) + (x == 4 ? off : 0);
      text += compare_at(x, y, z, true) + write_at(x, y, z);
    }
    return test::trace_of(text);
  };
  CHECK(causes_of(run_of(0)) == "");
  CHECK_FALSE(has(not_judged(check(run_of(0))), kind_of<DepthCompare>, "z"));
  CHECK(causes_of(run_of(0.25)) == "compare.z@9");
}

TEST_CASE("check: a pixel is written where it was compared, also in runs without spans") {
  const auto run_of = [&](const std::string& steps) {
    return causes_of(test::trace_of(small_head("direct", whole_table, true) + begin_a + steps));
  };
  CHECK(run_of(compare_at(2, 2, 5, true) + write_at(2, 2, 5)) == "");
  CHECK(run_of(compare_at(2, 2, 5, true) + write_at(5, 5, 5)) == "wz.write_after_win@3 wp.write_after_win@4");
  CHECK(run_of(compare_at(2, 2, 5, true) + write_at(2, 2, 5) + compare_at(2, 2, 7, false) + write_at(2, 7, 7)) ==
        "wz.write_after_win@6 wp.write_after_win@7");
  // Won before, but written since.
  CHECK(run_of(compare_at(2, 2, 5, true) + write_at(2, 2, 5) + compare_at(3, 2, 5, true) + write_at(2, 2, 5)) ==
        "wz.write_after_win@6 wp.write_after_win@7");
  // The last pixel of a polygon, too, has to be written.
  CHECK(run_of(compare_at(2, 2, 5, true) + write_at(2, 2, 5) + compare_at(3, 2, 5, true) +
               R"({"step":"polygon","polygon":1,"facet":1})"
               "\n") == "polygon.win_is_written@6");
  // Colours of some pixels may be written after all of them were compared.
  const std::vector<std::pair<const char*, const char*>> colours{
      {"polygon", "polygon_begin"}, {"compare", "depth_compare"}, {"wp", "pixel_write"}};
  const auto colour = [](int x) {
    return fmt::format(R"({{"step":"wp","x":{},"y":2,"polygon":0}})"
                       "\n",
                       x);
  };
  CHECK(causes_of(test::trace_of(small_head("direct", colours, true) + begin_a + compare_at(2, 2, 5, true) +
                                 compare_at(3, 2, 5, true) + colour(2) + colour(3))) == "");
}

TEST_CASE("check: steps that a run never has are not recorded, whatever its header lists") {
  const std::string compares =
      compare_at(2, 2, 5, true) + compare_at(3, 2, 5, true) + compare_at(2, 2, 4, true) + compare_at(2, 2, 4.5, false);
  const Trace run = test::trace_of(small_head("direct", whole_table, true) + begin_a + compares +
                                   R"({"step":"scan","y":1})"
                                   "\n"
                                   R"({"step":"scan","y":2})"
                                   "\n");
  CHECK(causes_of(run) == "");
  const std::vector<std::string_view> never = never_recorded(run.header(), check(run));
  CHECK(std::find(never.begin(), never.end(), "wz") != never.end());
  CHECK(std::find(never.begin(), never.end(), "compare") == never.end());
  CHECK(causes_of(test::trace_of(small_head("direct", whole_table, true) + begin_a + compares +
                                 compare_at(2, 2, 4.25, true))) == "compare.nearer@6");
  // With colours: their depths are not recorded either, unless the compares show that they are never written.
  const auto with_colours = [&](bool farther_wins) {
    std::string text = small_head("direct", whole_table, true);
    for (const double z : {4.0, 5.0}) {
      const bool wins = z == 4.0 || farther_wins;
      text += begin_a + compare_at(2, 2, z, wins);
      if (wins)
        text += R"({"step":"wp","x":2,"y":2,"polygon":0})"
                "\n";
    }
    return causes_of(test::trace_of(text));
  };
  CHECK(with_colours(false) == "");
  CHECK(with_colours(true).find("win_is_written") != std::string::npos);
}

TEST_CASE("check: no number is right where one must be, in any field of any kind") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  int changed = 0;
  for (const char* name : {"pyramid-view", "clipping", "depth-sort", "bsp", "scan-line", "ray-casting", "areas"}) {
    const std::string path = test::in_checkout(fmt::format("tests/golden/{}.jsonl", name));
    if (!std::filesystem::exists(path)) continue;
    const Trace right = open_jsonl(path);
    std::set<std::pair<std::uint8_t, std::size_t>> done;
    for (std::int64_t at = 1; at <= right.size(); ++at) {
      const Event event = right.event(at).event;
      const auto kind = static_cast<std::uint8_t>(event.index());
      const auto fields = fields_of_kind(kind);
      for (std::size_t field = 0; field < fields.size(); ++field) {
        if (fields[field].type != FieldOfKind::Type::real || !std::isfinite(fields[field].read(event)) ||
            !done.insert({kind, field}).second)
          continue;
        for (const double value : {nan, inf}) {
          if (value == inf && kind == kind_of<BuffersClear>) continue;
          const Trace wrong = test::changed(right, [&](std::int64_t step, Event& changed_event) {
            if (step == at) fields[field].write(changed_event, value);
            return true;
          });
          const CheckReport report = check(wrong);
          CAPTURE(name);
          CAPTURE(std::string(kind_names()[kind]));
          CAPTURE(std::string(fields[field].name));
          CAPTURE(value);
          REQUIRE_FALSE(report.causes.empty());
          CHECK(report.causes.front().first.step == at);
          ++changed;
        }
      }
    }
  }
  CHECK(changed > 60);
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

template <class E>
E called(std::string_view word) {
  std::size_t k = 0;
  while (words_of<E>[k] != word) ++k;
  return static_cast<E>(k);
}

TEST_CASE("law: a convention acquits no number that is judged under the declared one alone") {
  int hints = 0;
  for (const char* interpolation : {"direct", "increments"})
    for (const char* mistake : test::of_edge_table)
      for (zoo::Task task : {test::triangles(3, 3, 18), test::ties()}) {
        task.mistake = mistake;
        std::string impossible;
        const Trace run =
            test::trace_of(test::head(task, "float64", interpolation) + zoo::edge_table(task), &impossible);
        const CheckReport report = check(run);
        if (report.causes.empty()) continue;
        const auto hint = convention_it_follows(run, report);
        if (!hint) continue;
        CAPTURE(interpolation);
        CAPTURE(mistake);
        const std::string key = hint->declared.front().key, word = hint->declared.front().word;
        CAPTURE(key);
        CAPTURE(word);
        if (hint->declared.size() > 1 || hint->declared.front().in_raster || key == "pixel_centre" || key == "cull" ||
            key == "view_coordinates")
          continue;
        const CheckReport other = check(under(
            run,
            [&](Header& header) {
              using Nearer = Comparison::Nearer;
              using Ties = Comparison::Ties;
              if (key == "nearer") header.comparison.nearer = word == "greater" ? Nearer::greater : Nearer::smaller;
              if (key == "ties") header.comparison.ties = word == "last" ? Ties::last : Ties::first;
              for_each_convention([&]<class E>(std::string_view of, E Conventions::*member) {
                if (of == key) header.conventions.*member = called<E>(word);
              });
            },
            [](std::int64_t, Event&) {}));
        CHECK(other.wrong_steps == hint->wrong_steps);
        CHECK(other.judged >= report.judged);
        CHECK(other.numbers >= report.numbers);
        for (std::size_t kind = 0; kind < kind_count; ++kind)
          CHECK(other.kinds[kind].judged >= report.kinds[kind].judged);
        CHECK(std::string(mistake) != "z_not_to_centre");
        CHECK(std::string(mistake) != "z_stepped_before_use");
        ++hints;
      }
  CHECK(hints > 0);
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
    // What follows from an edge that stands or leaves where it must not is no cause of its own.
    if (file.first == "swap" || file.first == "retire_early") CHECK(report.causes.size() == 1);
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
          if constexpr (requires {
                          e.x;
                          e.y;
                          e.z;
                        })
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

TEST_CASE(
    "check: the convention that a run follows otherwise than its header says is named, unless much is wrong still") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  const auto followed = [&](auto&& change, int wrong_depths) {
    int left = wrong_depths;
    const Trace trace = under(right, change, [&](std::int64_t, Event& event) {
      if (auto* depth = get_if<DepthInterpolate>(&event); depth && left > 0) depth->z += 100, --left;
    });
    const CheckReport report = check(trace);
    REQUIRE(report.wrong_steps > 0);
    const auto found = convention_it_follows(trace, report);
    if (!found) return std::string("none");
    std::string text;
    for (const OtherConvention::Declared& one : found->declared) text += one.key + " " + one.word + " ";
    return text + fmt::format("{}", found->wrong_steps);
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
              kind = description_of<E>.name, changed_field = field;
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
