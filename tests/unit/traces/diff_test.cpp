// zstep diff: equal runs are equal, and what parts is named. (tests/laws/changes_test.cpp changes anything anywhere.)
#include "traces/diff/diff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/sparse.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/diff/buffers.hpp"
#include "traces/diff/seen.hpp"
#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

TEST_CASE("diff: every golden trace is the same as itself") {
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const diff::DiffReport report = diff::compare(trace, trace);
    CHECK(report.causes.empty());
    CHECK(report.differences() == 0);
    std::int64_t same = 0;
    for (const diff::KindDifference& kind : report.kinds) {
      same += kind.same;
      CHECK(kind.only_a + kind.only_b + kind.different + kind.rounding == 0);
    }
    CHECK(same > 0);
    for (std::int64_t step = 1; step <= trace.size(); ++step)
      if (report.alignment.in_b(step) != 0) CHECK(report.alignment.in_b(step) == step);
  });
}

TEST_CASE("diff: what float32 makes of the depths near the end of a span is rounding, and so is what copies it") {
  for (const char* name : {"pyramid", "pyramid-behind", "cyclic", "cube"}) {
    CAPTURE(std::string(name));
    const Scene scene = look_at_scene(load_scene(name).scene, {});
    Conventions narrow;
    narrow.number_format = NumberFormat::float32;
    const diff::DiffReport report =
        diff::compare(test::recorded_by("z-buffer", scene), test::recorded_by("z-buffer", scene, narrow));
    std::int64_t rounding = 0;
    for (const diff::KindDifference& kind : report.kinds) {
      rounding += kind.rounding;
      CHECK(kind.different + kind.only_a + kind.only_b == 0);
    }
    CHECK(rounding > 100);
  }
}

TEST_CASE("diff: numbers written with few decimals part by rounding, and what is wrong beyond them does not") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/pyramid-view.jsonl"));
  const auto written = [&](std::int64_t wrong_step) {
    Header header = right.header();
    header.undeclared |= std::uint8_t{1} << static_cast<unsigned>(Convention::number_format);
    TraceRecorder recorder(header, right.scene());
    for (std::int64_t step = 1; step <= right.size(); ++step) {
      RecordedEvent recorded = right.event(step);
      if (auto* vertex = get_if<ViewportTransform>(&recorded.event); vertex && step >= wrong_step) vertex->x_s += 0.01;
      visit_event(
          []<class E>(E& event) {
            for_each_field<E>([&](const auto& field) {
              if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
                if (double& value = event.*field.member; std::isfinite(value)) value = std::round(value * 1e5) / 1e5;
            });
          },
          recorded.event);
      record_any(recorder, recorded.step, recorded.event);
    }
    recorder.finish();
    return Trace::from_bytes(recorder.take_bytes(), "written");
  };
  const diff::DiffReport rounded = diff::compare(right, written(right.size() + 1));
  CHECK(!rounded.causes.empty());
  CHECK(rounded.differences() == 0);
  const auto vertex = right.next<ViewportTransform>(0, [](const ViewportTransform&) { return true; });
  REQUIRE(vertex);
  const diff::DiffReport wrong = diff::compare(right, written(*vertex));
  REQUIRE(!wrong.causes.empty());
  CHECK(wrong.causes[0].part == diff::Part::different);
  CHECK(wrong.causes[0].first.b == *vertex);
}

TEST_CASE("diff: runs of several blocks are the same however they are packed, and a change is found in any block") {
  const Trace right = test::recorded_by("z-buffer", test::large_scene(), {});
  REQUIRE(right.impl().blocks.size() > 3);
  const auto of = [](const diff::DiffReport& report, auto count) {
    std::int64_t sum = 0;
    for (const diff::KindDifference& kind : report.kinds) sum += kind.*count;
    return sum;
  };
  // Under another header the same steps are other bytes as far as a reader knows.
  const auto recorded = [&](const std::string& title, auto&& change) {
    Header header = right.header();
    header.title = title;
    TraceRecorder recorder(header, right.scene());
    right.each(0, right.size(), [&](std::int64_t step, const RecordedEvent& read) {
      RecordedEvent made = read;
      if (change(step, made.event)) record_any(recorder, made.step, made.event);
      return true;
    });
    recorder.finish();
    return Trace::from_bytes(recorder.take_bytes(), title);
  };
  for (const std::string& title : {right.header().title, std::string("another")}) {
    CAPTURE(title);
    const Trace same = recorded(title, [](std::int64_t, Event&) { return true; });
    const diff::DiffReport equal = diff::compare(right, same);
    CHECK(equal.causes.empty());
    CHECK(equal.alignment.identical == (title == right.header().title));
    CHECK(of(equal, &diff::KindDifference::same) == right.size());
    CHECK(equal.alignment.by_a.size() == 1);

    for (const int part : {1, 5, 9}) {
      const auto depth = right.next<DepthWrite>(right.size() * part / 12, [](const DepthWrite&) { return true; });
      REQUIRE(depth);
      CAPTURE(*depth);
      const Trace other = recorded(title, [&](std::int64_t step, Event& event) {
        if (step == *depth) event.as<DepthWrite>().z += 1;
        return true;
      });
      const diff::DiffReport changed = diff::compare(right, other);
      REQUIRE(!changed.causes.empty());
      CHECK(changed.causes[0].first.a == *depth);
      CHECK(changed.causes[0].first.b == *depth);
      CHECK(of(changed, &diff::KindDifference::only_a) + of(changed, &diff::KindDifference::only_b) == 0);
      CHECK(changed.alignment.in_b(right.size()) == right.size());

      const Trace shorter = recorded(title, [&](std::int64_t step, Event&) { return step != *depth; });
      const diff::DiffReport left_out = diff::compare(right, shorter);
      REQUIRE(left_out.causes.size() == 1);
      CHECK(left_out.causes[0].first.a == *depth);
      CHECK(left_out.causes[0].first.only_a());
      CHECK(of(left_out, &diff::KindDifference::same) == right.size() - 1);
      CHECK(left_out.alignment.in_b(*depth - 1) == *depth - 1);
      CHECK(left_out.alignment.in_b(*depth) == 0);
      CHECK(left_out.alignment.in_b(right.size()) == right.size() - 1);
    }
  }
}

/// All that a report says of steps, so that two can be held against each other.
std::string all_of(const diff::DiffReport& report) {
  const diff::Alignment& alignment = report.alignment;
  std::string all = fmt::format("complete {}\n", alignment.complete);
  for (const auto* matches : {&alignment.by_a, &alignment.by_b})
    for (const diff::Match& match : *matches) all += fmt::format("match {} {} {}\n", match.a, match.b, match.count);
  for (const diff::Difference& one : alignment.differences)
    all += fmt::format("{} {} {} {} {} {}\n", one.a, one.b, one.fields, one.kind, one.line, one.off);
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const diff::KindDifference& count = report.kinds[kind];
    all += fmt::format("kind {} {} {} {} {} {}\n", kind, count.same, count.rounding, count.different, count.only_a,
                       count.only_b);
  }
  for (const diff::Cause& cause : report.causes)
    all +=
        fmt::format("cause {} {} {} {} {} {} {} {}\n", cause.first.a, cause.first.b, cause.part == diff::Part::rounding,
                    cause.wrong_a, cause.wrong_b, cause.again, cause.symptoms, cause.pixels);
  return all;
}

/// Changes, leaves out, repeats or moves some steps of a run.
std::string plant(std::vector<RecordedEvent>& steps, std::mt19937_64& random) {
  const std::size_t at = random() % steps.size();
  const auto here = steps.begin() + static_cast<std::ptrdiff_t>(at);
  const auto some = static_cast<std::ptrdiff_t>(std::min<std::size_t>(1 + random() % 100, steps.size() - at));
  const auto way = random() % 6;
  if (way == 0) {
    steps.erase(here);
  } else if (way == 1) {
    steps.erase(here, here + some);
  } else if (way == 2) {
    const std::vector<RecordedEvent> again(here, here + some);
    steps.insert(here, again.begin(), again.end());
  } else if (way == 3) {
    std::rotate(here, here + 1, here + some);
  } else if (way == 4) {
    std::rotate(here, here + some, steps.end());
  } else {
    visit_event(
        [&]<class E>(E& event) {
          for_each_field<E>([&](const auto& field) {
            using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
            if constexpr (std::is_same_v<Value, double>) event.*field.member *= random() % 2 == 0 ? 1.5 : 1 + 1e-15;
          });
        },
        steps[at].event);
  }
  return fmt::format("{} at step {}, {} steps", way, at + 1, some);
}

TEST_CASE("diff: going along with both runs finds what matching every step for itself finds") {
  // Of half-space its own, so that the others keep theirs.
  std::mt19937_64 random_of_others(8), random_of_half_space(8);
  int differ = 0, apart = 0;
  const auto compare_both_ways = [&](const Trace& a, const Trace& b) {
    const diff::DiffReport fast = diff::compare(a, b);
    CHECK(all_of(fast) == all_of(diff::compare(a, b, nullptr, diff::Way::plain)));
    differ += !fast.alignment.differences.empty();
    apart += fast.alignment.by_b.size() > 1;
  };
  const auto plants = [&](const std::string& name, const Trace& trace, int times) {
    CAPTURE(name);
    std::mt19937_64& random = trace.header().algorithm == "half-space" ? random_of_half_space : random_of_others;
    for (int time = 0; time < times; ++time) {
      std::vector<RecordedEvent> steps;
      trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& step) {
        steps.push_back(step);
        return true;
      });
      std::string planted;
      for (auto left = 1 + random() % 3; left > 0 && !steps.empty(); --left) planted += plant(steps, random) + "; ";
      CAPTURE(planted);
      Header header = trace.header();
      if (random() % 2 == 0) header.title = "another";  // then equal bytes are not looked for
      TraceRecorder recorder(header, trace.scene());
      for (const RecordedEvent& step : steps) record_any(recorder, step.step, step.event);
      recorder.finish();
      const Trace other = Trace::from_bytes(recorder.take_bytes(), "planted");
      compare_both_ways(trace, other);
      compare_both_ways(other, trace);
    }
  };
  int runs = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    plants(name, trace, 6 / test::sparse);
    ++runs;
  });
  plants("several blocks", test::recorded_by("z-buffer", test::large_scene(), {}), 6 / test::sparse);
  CHECK(differ > runs);
  CHECK(apart > runs);
}

TEST_CASE("diff: of many differences the first are followed, and the others are counted") {
  ViewOptions view;
  view.width = 48, view.height = 40;
  const Scene scene = look_at_scene(load_scene("pyramid-behind").scene, view);
  Conventions adds;
  adds.interpolation = Conventions::Interpolation::increments;
  const Trace direct = test::recorded_by("z-buffer", scene, {}), added = test::recorded_by("z-buffer", scene, adds);
  const auto compared = [&](std::size_t keeps) {
    return diff::compare(direct, added, nullptr, diff::Way::fast, {}, keeps);
  };
  const diff::DiffReport all = compared(diff::most_differences);
  const std::size_t count = all.alignment.differences.size();
  REQUIRE(count > 100);
  CHECK(all.alignment.not_kept == 0);
  for (const std::size_t keeps : {std::size_t{1}, std::size_t{10}, count - 1}) {
    CAPTURE(keeps);
    const diff::DiffReport few = compared(keeps);
    REQUIRE(few.alignment.differences.size() == keeps);
    CHECK(few.alignment.complete);
    CHECK(few.alignment.not_kept == static_cast<std::int64_t>(count - keeps));
    for (std::size_t i = 0; i < keeps; ++i) {
      CHECK(few.alignment.differences[i].a == all.alignment.differences[i].a);
      CHECK(few.alignment.differences[i].b == all.alignment.differences[i].b);
    }
    REQUIRE(!few.causes.empty());
    CHECK(few.causes.front().first.b == all.causes.front().first.b);
    for (std::size_t kind = 0; kind < kind_count; ++kind) {
      const diff::KindDifference &one = few.kinds[kind], &other = all.kinds[kind];
      CHECK(one.same == other.same);
      CHECK(one.only_a == other.only_a);
      CHECK(one.only_b == other.only_b);
      CHECK(one.rounding + one.different + one.not_followed == other.rounding + other.different);
    }
  }
}

/// A run as it was, but for what `change` does to its steps; false leaves a step out.
template <class Change>
Trace changed_run(const Trace& right, Change&& change) {
  TraceRecorder recorder(right.header(), right.scene());
  right.each(0, right.size(), [&](std::int64_t step, const RecordedEvent& read) {
    RecordedEvent made = read;
    if (change(step, made.event)) record_any(recorder, made.step, made.event);
    return true;
  });
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "changed");
}
/// Two triangles by a program that has no spans.
Trace without_spans(const char* style = "rows edge_functions weights float64", const char* ties = "first") {
  zoo::Task task;
  task.width = 14, task.height = 12;
  task.points = {{1, 1, 0.75}, {12, 1, 0.5}, {1, 10, 0.25}, {2, 2, 0.25}, {11, 2, 0.5}, {2, 9, 0.75}};
  task.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}};
  task.style = style;
  std::string head = test::head("z-buffer", test::scene_of(task), {});
  const std::string first = "\"ties\":\"first\"";
  head.replace(head.find(first), first.size(), std::string("\"ties\":\"") + ties + "\"");
  return test::trace_of(head + zoo::variants(task));
}

TEST_CASE("diff: that one pixel is compared after another makes it no consequence of it") {
  const Trace right = without_spans();
  REQUIRE(!right.has(kind_of<SpanBegin>));
  // Every depth is wrong for itself; what is written follows from it.
  std::int64_t compares = 0, writes = 0;
  const Trace lower = changed_run(right, [&](std::int64_t, Event& event) {
    if (auto* compare = get_if<DepthCompare>(&event)) compare->z -= 0.001, ++compares;
    if (auto* write = get_if<DepthWrite>(&event)) write->z -= 0.001, ++writes;
    return true;
  });
  const diff::DiffReport all = diff::compare(right, lower);
  REQUIRE(all.causes.size() == 1);
  CHECK(all.causes[0].first.kind == kind_of<DepthCompare>);
  CHECK(all.causes[0].again == compares - 1);
  CHECK(all.causes[0].symptoms == writes);

  // Two faults that have nothing to do with each other: a pixel that is left out, and depths of the later polygon.
  std::int32_t polygon = no_polygon;
  std::optional<std::pair<std::int32_t, std::int32_t>> left_out;
  std::int64_t wrong = 0;
  const Trace both = changed_run(right, [&](std::int64_t, Event& event) {
    if (const auto* begin = get_if<PolygonBegin>(&event)) polygon = begin->polygon;
    if (auto* compare = get_if<DepthCompare>(&event)) {
      if (!left_out) left_out = {compare->x, compare->y};
      if (polygon == 1) compare->z += 0.5, wrong += 1;
    }
    if (auto* write = get_if<DepthWrite>(&event); write && polygon == 1) write->z += 0.5;
    const auto here = [&]<class E>(const E& e) {
      if constexpr (requires { e.x, e.y; })
        return polygon == 0 && left_out && left_out->first == static_cast<std::int32_t>(e.x) &&
               left_out->second == static_cast<std::int32_t>(e.y);
      else return false;
    };
    return !visit_event(here, event);
  });
  const diff::DiffReport two = diff::compare(right, both);
  std::int64_t of_depths = 0, missing = 0;
  for (const diff::Cause& cause : two.causes) {
    if (cause.first.kind != kind_of<DepthCompare>) continue;
    if (cause.first.only_a()) missing += 1 + cause.again;
    else of_depths += 1 + cause.again;
  }
  CHECK(missing == 1);
  CHECK(of_depths == wrong);
}

TEST_CASE("diff: a verdict follows from the depth that was stored wrongly at its own pixel") {
  const Trace right = without_spans();
  // The depth of one pixel of the first polygon is stored nearer than it is, so that the second one loses there.
  std::optional<std::pair<std::int32_t, std::int32_t>> at;
  std::int32_t polygon = no_polygon;
  right.each(0, right.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* begin = get_if<PolygonBegin>(&recorded.event)) polygon = begin->polygon;
    if (const auto* write = get_if<DepthWrite>(&recorded.event); write && polygon == 1 && !at)
      at = {write->x, write->y};
    return true;
  });
  REQUIRE(at);
  polygon = no_polygon;
  const Trace wrong = changed_run(right, [&](std::int64_t, Event& event) {
    if (const auto* begin = get_if<PolygonBegin>(&event)) polygon = begin->polygon;
    const auto here = [&](const auto& e) { return e.x == at->first && e.y == at->second; };
    if (auto* write = get_if<DepthWrite>(&event); write && here(*write)) {
      if (polygon == 1) return false;
      write->z = 0;
    }
    if (auto* compare = get_if<DepthCompare>(&event); compare && here(*compare) && polygon == 1)
      compare->nearer = false;
    if (const auto* write = get_if<PixelWrite>(&event); write && here(*write) && polygon == 1) return false;
    return true;
  });
  const diff::DiffReport report = diff::compare(right, wrong);
  REQUIRE(report.causes.size() == 1);
  CHECK(report.causes[0].first.kind == kind_of<DepthWrite>);
  CHECK(report.causes[0].symptoms == 3);  // the compare, and the two steps that are missing after it
}

TEST_CASE("diff: equal depths of which another one wins are a cause, and no rounding") {
  const auto run = [](const char* ties, bool last) {
    const Trace right = without_spans("rows edge_functions weights float64", ties);
    std::int32_t polygon = no_polygon;
    // All at one depth: each pixel of the second polygon is a tie.
    return changed_run(right, [&](std::int64_t, Event& event) {
      if (const auto* begin = get_if<PolygonBegin>(&event)) polygon = begin->polygon;
      if (auto* compare = get_if<DepthCompare>(&event)) {
        compare->z = 0.5 * (1 + (last ? 1e-16 : 0));
        compare->nearer = polygon == 0 || last;
      }
      if (auto* write = get_if<DepthWrite>(&event)) write->z = 0.5 * (1 + (last ? 1e-16 : 0));
      return last || polygon == 0 || !(holds<DepthWrite>(event) || holds<PixelWrite>(event));
    });
  };
  const Trace first = run("first", false), last = run("last", true);
  const diff::DiffReport report = diff::compare(first, last);
  CHECK(report.differences() > 0);
  const auto tie =
      std::find_if(report.causes.begin(), report.causes.end(), [](const auto& cause) { return cause.tie; });
  REQUIRE(tie != report.causes.end());
  CHECK(tie->part == diff::Part::different);
  CHECK(tie->pixels > 10);
}

TEST_CASE("diff: what both methods record of a polygon is the same, though only one says which one it draws") {
  const Scene scene = look_at_scene(load_scene(test::in_checkout("tests/data/horizontal-edge.toml")).scene, {});
  const Trace one = test::recorded_by("z-buffer", scene), other = test::recorded_by("painter", scene);
  for (const auto& [a, b] : {std::pair(&one, &other), {&other, &one}}) {
    const diff::DiffReport report = diff::compare(*a, *b);
    CHECK(report.causes.empty());
    CHECK(report.kinds[kind_of<EdgeTableSkip>].same == 2);
    CHECK(report.kinds[kind_of<EdgeTableSkip>].only_a + report.kinds[kind_of<EdgeTableSkip>].only_b == 0);
  }
  Replay end_one(one), end_other(other);
  end_one.go_to(one.size()), end_other.go_to(other.size());
  const auto groups = diff::seen_apart(one, end_one.state().picture, other, end_other.state().picture);
  REQUIRE(groups.size() == 1);
  const diff::SeenApart& group = groups[0];
  CHECK(group.pixels == 4);
  CHECK(group.polygon_a == 0);
  CHECK(group.polygon_b == 1);
  // In A the farther one loses; in B it is painted over the nearer one.
  CHECK(group.b_in_a.step == 0);
  CHECK(group.b_in_a.z > group.a_in_a.z);
  CHECK(group.b_in_b.step > group.a_in_b.step);
  CHECK(group.a_in_b.step > 0);
  CHECK(group.b_in_b.z > group.a_in_b.z);
  CHECK(get<PixelPaint>(other.event(group.b_in_b.step).event).x == group.x);
}

TEST_CASE("diff: a kind of step is compared, or said not to be") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/foley.jsonl"));
  const Trace never = changed_run(right, [](std::int64_t, const Event& event) { return !holds<EdgeRetire>(event); });
  const diff::DiffReport report = diff::compare(never, right);
  CHECK(!report.alignment.compared[kind_of<EdgeRetire>]);
  for (const diff::Cause& cause : report.causes) CHECK(report.alignment.compared[cause.first.kind]);
  CHECK(report.causes.empty());
}

TEST_CASE("diff: a step that each run has where the other one does not is one cause, and no two") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/foley.jsonl"));
  // The first edge that ends is retired one scan line later.
  std::optional<EdgeRetire> late;
  int moved = 0;
  TraceRecorder recorder(right.header(), right.scene());
  right.each(0, right.size(), [&](std::int64_t, const RecordedEvent& read) {
    const auto* retire = get_if<EdgeRetire>(&read.event);
    if (retire && moved == 0) {
      late = *retire, ++moved;
      return true;
    }
    record_any(recorder, read.step, read.event);
    if (holds<ScanLineBegin>(read.event) && late) {
      const StepInfo* step = find_step(right.header().page, "retire_edge");
      record_any(recorder, step->id, *late);
      late.reset();
    }
    return true;
  });
  recorder.finish();
  const Trace wrong = Trace::from_bytes(recorder.take_bytes(), "late");
  REQUIRE(moved == 1);
  const diff::DiffReport report = diff::compare(right, wrong);
  REQUIRE(report.causes.size() == 1);
  CHECK(report.causes[0].first.only_a());
  REQUIRE(report.causes[0].elsewhere > 0);
  CHECK(holds<EdgeRetire>(wrong.event(report.causes[0].elsewhere).event));
}

TEST_CASE("diff: of two edges at one x either may stand to the left, and of others only the right one") {
  // Two edges begin in a vertex at a pixel's centre.
  const Scene scene = test::screen_scene(16, 14, {{{5, 1, 0.5}, {12, 10, 0.25}, {2, 10, 0.75}}});
  const Trace right = test::recorded_by("z-buffer", scene);
  const auto exchanged = [&](bool at_vertex) {
    bool done = false;
    return changed_run(right, [&](std::int64_t, Event& event) {
      auto* span = get_if<SpanBegin>(&event);
      if (!span || done || (span->x_left == span->x_right) != at_vertex) return true;
      done = true;
      std::swap(span->left_edge, span->right_edge);
      return true;
    });
  };
  const diff::DiffReport either = diff::compare(right, exchanged(true));
  CHECK(either.alignment.differences.size() == 1);
  CHECK(either.causes.empty());
  CHECK(either.kinds[kind_of<SpanBegin>].rounding == 0);
  const diff::DiffReport wrong = diff::compare(right, exchanged(false));
  REQUIRE(!wrong.causes.empty());
  CHECK(wrong.causes[0].first.kind == kind_of<SpanBegin>);
  CHECK(wrong.causes[0].part == diff::Part::different);
}

TEST_CASE("diff: the slope of a span without width says nothing, and no number that is far off is called rounding") {
  const Scene scene = test::screen_scene(16, 14, {{{5, 1, 0.5}, {12, 10, 0.25}, {2, 10, 0.75}}});
  const Trace right = test::recorded_by("z-buffer", scene);
  const auto changed = [](const Trace& run, bool at_vertex, auto&& change) {
    bool done = false;
    return changed_run(run, [&](std::int64_t, Event& event) {
      auto* span = get_if<SpanBegin>(&event);
      if (span && !done && (span->x_left == span->x_right) == at_vertex) change(*span), done = true;
      return true;
    });
  };
  const auto steep = [](SpanBegin& span) { span.dz_dx += 9; };
  const auto exchanged = [](SpanBegin& span) { std::swap(span.left_edge, span.right_edge), span.dz_dx += 9; };
  for (const Trace& other : {changed(right, true, steep), changed(right, true, exchanged)}) {
    const diff::DiffReport report = diff::compare(right, other);
    CHECK(report.alignment.differences.size() == 1);
    CHECK(report.causes.empty());
    CHECK(report.kinds[kind_of<SpanBegin>].rounding == 0);
  }
  const diff::DiffReport steeper = diff::compare(right, changed(right, false, steep));
  REQUIRE(!steeper.causes.empty());
  CHECK(steeper.causes[0].part == diff::Part::different);
  CHECK(steeper.causes[0].first.kind == kind_of<SpanBegin>);

  // Where nothing says what z is there, it may still be no rounding of the other one's.
  const Trace bare = changed_run(right, [](std::int64_t, const Event& event) {
    return !holds<EdgeTableInsert>(event) && !holds<EdgeEnter>(event) && !holds<EdgeStep>(event) &&
           !holds<EdgeRetire>(event) && !holds<EdgeSwap>(event);
  });
  const diff::DiffReport deeper =
      diff::compare(bare, changed(bare, true, [](SpanBegin& span) { span.z_right += 0.25, span.dz_dx += 9; }));
  REQUIRE(!deeper.causes.empty());
  CHECK(deeper.causes[0].part == diff::Part::different);
  std::string parting;
  for (const FieldOfKind& field : fields_of_kind(kind_of<SpanBegin>))
    if ((deeper.causes[0].first.fields >> (&field - fields_of_kind(kind_of<SpanBegin>).data()) & 1) != 0)
      parting += std::string(field.name) + " ";
  CHECK(parting == "z_right ");
}

TEST_CASE("diff: pictures part where a depth or a colour does, and rounding is told apart") {
  Scene scene;
  scene.polygons.resize(2);
  scene.polygons[0].color = {10, 20, 30};
  scene.polygons[1].color = {10, 20, 31};
  Picture a(3, 2), b(3, 2);
  const Precision precision{1e-9, 0, true, ""};
  a.depth = {1, 1, 2, no_depth, no_depth, 3};
  b.depth = {1, 1 + 1e-12, 2.5, no_depth, 4, 3};
  a.polygon = {0, 0, 0, no_polygon, no_polygon, 1};
  b.polygon = {0, 0, 1, no_polygon, 0, 1};
  const diff::BufferDifference found = diff::compare_pictures({a, scene}, {b, scene}, precision);
  CHECK(found.pixels == 6);
  CHECK(found.colors == 2);
  CHECK(found.depths == 2);
  CHECK(found.depths_rounded == 1);
  CHECK(found.farthest == 0.5);
  CHECK(found.first == 2);
  CHECK(found.apart[0] == 0);
  CHECK(found.apart[2] == 1);
  CHECK(found.apart[4] == 1);
}

TEST_CASE("diff: a depth that is no finite number is never as good as one, and what was not drawn is no depth") {
  Scene scene;
  scene.polygons.resize(1);
  const Precision precision{1e-9, 0, true, ""};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Picture a(3, 2), b(3, 2);
  // Nothing is drawn at the last two pixels; A was cleared to −∞, and B to 0.
  a.polygon = b.polygon = {0, 0, 0, 0, no_polygon, no_polygon};
  a.depth = {1, 2, nan, 4, -no_depth, -no_depth};
  b.depth = {nan, no_depth, 3, 4, 0, 0};
  const diff::BufferDifference found =
      diff::compare_pictures({a, scene, -no_depth, true}, {b, scene, 0, true}, precision);
  CHECK(found.colors == 0);
  CHECK(found.depths == 3);
  CHECK(found.not_finite == 3);
  CHECK(found.farthest == 0);
  CHECK(found.apart[0] == 1);
  CHECK(found.apart[3] == 0);
  CHECK(found.apart[4] == 0);

  // All depths of a run are NaN: it has depths, and they are wrong.
  const Trace right = without_spans();
  const Trace no_number = changed_run(right, [&](std::int64_t, Event& event) {
    if (auto* write = get_if<DepthWrite>(&event)) write->z = nan;
    return true;
  });
  Replay end_right(right), end_wrong(no_number);
  end_right.go_to(right.size()), end_wrong.go_to(no_number.size());
  const diff::BufferDifference of_runs =
      diff::compare_pictures(diff::buffers_of(right, end_right.state().picture),
                             diff::buffers_of(no_number, end_wrong.state().picture), precision);
  CHECK(of_runs.depths_compared);
  CHECK(of_runs.not_finite > 50);

  // A table of depths: NaN and infinities count as not drawn only where the run has nothing, either.
  const std::vector<double> ours{1, 2, 3, no_depth, no_depth, no_depth};
  const auto table = [&](std::vector<double> theirs) { return diff::compare_depths(ours, theirs, precision).depths; };
  CHECK(table({1, 2, 3, no_depth, nan, -no_depth}) == 0);
  CHECK(table({1, 2, 3, -1, -1, -1}) == 0);  // cleared to another depth
  CHECK(table({1, nan, no_depth, -1, -1, -1}) == 2);
  CHECK(table({1, 2, 3, -1, -1, 7}) == 1);  // drawn where the run has nothing
}

}  // namespace
