// zstep diff: what follows from a cause is no cause of its own, and what is said of a cause is true of it.
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "algorithms/scene/load.hpp"
#include "sim/words/judged.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/diff/diff.hpp"
#include "traces/events/fields.hpp"

using namespace zstep;

namespace {

/// A run of these steps.
Trace of_steps(const Trace& like, const std::vector<RecordedEvent>& steps) {
  TraceRecorder recorder(like.header(), like.scene());
  for (const RecordedEvent& step : steps) record_any(recorder, step.step, step.event);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "of steps");
}
std::vector<RecordedEvent> steps_of_run(const Trace& run) {
  std::vector<RecordedEvent> steps;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& read) { return steps.push_back(read), true; });
  return steps;
}

/// Of the lecture: two triangles, of which the second one cuts the first.
Trace delhi() { return test::recorded_by("z-buffer", look_at_scene(load_scene("delhi").scene, {})); }

/// Three of its edges end on a line where its span has no pixel.
Trace ends_in_empty_span() {
  return test::recorded_by("z-buffer",
                           test::screen_scene(14, 12, {{{1.25, 1.5, 0.125}, {12.5, 2.25, 0.875}, {6.5, 10.5, 0.5}}}));
}

/// The kinds of the causes that are more than rounding, each once.
std::string kinds_of(const diff::DiffReport& report) {
  std::set<std::string> kinds;
  for (const diff::Cause& cause : report.causes)
    if (cause.part == diff::Part::different) kinds.emplace(description_of_kind(cause.first.kind).name);
  std::string text;
  for (const std::string& kind : kinds) text += kind + " ";
  return text;
}

}  // namespace

TEST_CASE("diff causes: spans without pixels stay no difference where other steps of their line are missing") {
  const Trace right = ends_in_empty_span();
  std::int64_t last_line = 0, empty = 0;
  std::int32_t last = 0;
  right.each(0, right.size(), [&](std::int64_t step, const RecordedEvent& read) {
    if (const auto* line = get_if<ScanLineBegin>(&read.event)) last_line = step, last = line->y;
    if (const auto* span = get_if<SpanBegin>(&read.event)) empty += span->first > span->last;
    return true;
  });
  REQUIRE(empty > 0);
  const auto is_empty = [](const Event& event) {
    const auto* span = get_if<SpanBegin>(&event);
    return span && span->first > span->last;
  };
  const Trace without = test::changed(right, [&](std::int64_t, const Event& event) { return !is_empty(event); });
  CHECK(diff::compare(right, without).causes.empty());
  // The retirements of the last lines are missing, too.
  const Trace wrong = test::changed(right, [&](std::int64_t, const Event& event) {
    return !is_empty(event) && !(holds<EdgeRetire>(event) && last_line > 0);
  });
  const diff::DiffReport never = diff::compare(right, wrong);
  CHECK(kinds_of(never) == "");
  bool first = true;
  const Trace partly = test::changed(right, [&](std::int64_t, const Event& event) {
    if (holds<EdgeRetire>(event) && first) return first = false, true;
    return !is_empty(event) && !holds<EdgeRetire>(event);
  });
  const diff::DiffReport report = diff::compare(right, partly);
  CHECK(kinds_of(report) == "edge_retire ");
  CHECK(report.kinds[kind_of<SpanBegin>].idle_a == empty);
  CHECK(last > 0);
}

TEST_CASE("diff causes: what an edge enters the list with follows from its entry in the table") {
  for (const char* mistake : {"x_at_vertex", "z_slope_of_x"}) {
    CAPTURE(mistake);
    zoo::Task task = test::triangles(3, 3, 18);
    const std::string head = test::head(task, "float64", "increments");
    const Trace right = test::trace_of(head + zoo::edge_table(task));
    task.mistake = mistake;
    const Trace wrong = test::trace_of(head + zoo::edge_table(task));
    const diff::DiffReport report = diff::compare(right, wrong);
    CHECK(kinds_of(report) == "edge_table_insert ");
    REQUIRE(!report.causes.empty());
    CHECK(report.causes.front().symptoms > 0);
  }
}

TEST_CASE("diff causes: which scan lines there are follows from the lines of the edges") {
  for (const char* mistake : {"starts_one_early", "ends_one_late"}) {
    CAPTURE(mistake);
    zoo::Task task = test::triangles(3, 3, 18);
    const std::string head = test::head(task, "float64", "increments");
    const Trace right = test::trace_of(head + zoo::edge_table(task));
    task.mistake = mistake;
    const Trace wrong = test::trace_of(head + zoo::edge_table(task));
    const diff::DiffReport report = diff::compare(right, wrong);
    CHECK(kinds_of(report) == "edge_table_insert ");
  }
}

TEST_CASE("diff causes: a scan line that is missing is named, and the edges of the lines after it are matched") {
  const Trace right = delhi();
  bool on_line = false;
  std::int32_t polygon = no_polygon;
  const Trace wrong = test::changed(right, [&](std::int64_t, const Event& event) {
    if (const auto* begin = get_if<PolygonBegin>(&event)) polygon = begin->polygon, on_line = false;
    if (const auto* line = get_if<ScanLineBegin>(&event)) on_line = polygon == 0 && line->y == 3;
    return !on_line;
  });
  const diff::DiffReport report = diff::compare(right, wrong);
  CHECK(kinds_of(report) == "scan_line_begin ");
  REQUIRE(report.causes.size() == 1);
  CHECK(report.causes[0].first.only_a());
  CHECK(get<ScanLineBegin>(right.event(report.causes[0].first.a).event).y == 3);
  CHECK(report.kinds[kind_of<EdgeStep>].different == 0);
  CHECK(report.kinds[kind_of<EdgeStep>].only_b == 0);
}

TEST_CASE("diff causes: a span that names another scan line leaves the edges on theirs") {
  const Trace right = delhi();
  bool done = false;
  const Trace wrong = test::changed(right, [&](std::int64_t, Event& event) {
    if (auto* span = get_if<SpanBegin>(&event); span && span->y == 3 && !done) span->y = 4, done = true;
    return true;
  });
  const diff::DiffReport report = diff::compare(right, wrong);
  CHECK(!report.causes.empty());
  CHECK(report.kinds[kind_of<EdgeStep>].same == report.alignment.kinds[kind_of<EdgeStep>].pairs);
  CHECK(report.kinds[kind_of<EdgeStep>].only_a + report.kinds[kind_of<EdgeStep>].only_b == 0);
}

TEST_CASE("diff causes: polygons in another order are named as such") {
  const Trace right = delhi();
  const std::vector<RecordedEvent> all = steps_of_run(right);
  const auto begins = [&](std::int32_t polygon) {
    return std::find_if(all.begin(), all.end(), [&](const RecordedEvent& step) {
      const auto* begin = get_if<PolygonBegin>(&step.event);
      return begin && begin->polygon == polygon;
    });
  };
  std::vector<RecordedEvent> turned(all.begin(), begins(0));
  turned.insert(turned.end(), begins(1), all.end());
  turned.insert(turned.end(), begins(0), begins(1));
  // What is nearer then is found by the compares, as in a program.
  std::vector<RecordedEvent> run;
  std::vector<double> depth(64, no_depth);
  bool wins = false;
  for (RecordedEvent& step : turned) {
    if (auto* compare = get_if<DepthCompare>(&step.event))
      compare->nearer = wins = compare->z < depth[static_cast<std::size_t>(compare->y * 8 + compare->x)];
    if (holds<DepthWrite>(step.event) || holds<PixelWrite>(step.event)) continue;
    run.push_back(step);
    if (const auto* compare = get_if<DepthCompare>(&step.event); compare && wins) {
      depth[static_cast<std::size_t>(compare->y * 8 + compare->x)] = compare->z;
      run.push_back(
          {find_step(right.header().page, "write_depth")->id, DepthWrite{compare->x, compare->y, compare->z}});
    }
  }
  const Trace without_colors =
      test::changed(right, [](std::int64_t, const Event& event) { return !holds<PixelWrite>(event); });
  const Trace other = of_steps(right, run);
  const diff::DiffReport report = diff::compare(without_colors, other);
  REQUIRE(report.causes.size() == 1);
  const diff::Cause& cause = report.causes[0];
  CHECK(cause.first.kind == kind_of<DepthCompare>);
  REQUIRE(cause.other_order);
  const auto here = get<DepthCompare>(without_colors.event(cause.first.a).event);
  const auto moved = get<DepthCompare>(without_colors.event(cause.other_order->a).event);
  CHECK(here.x == moved.x);
  CHECK(here.y == moved.y);
  CHECK((cause.other_order->a < cause.first.a) == cause.other_order->first_in_a);
  CHECK((cause.other_order->b > cause.first.b) == cause.other_order->first_in_a);
  CHECK(why_cause(cause).find("another order") != std::string::npos);
}

TEST_CASE("diff causes: what one run has no step of is not compared, unless it was to print it") {
  const Trace right = delhi();
  for (const std::uint8_t kind : {kind_of<DepthWrite>, kind_of<PixelWrite>, kind_of<DepthCompare>}) {
    CAPTURE(description_of_kind(kind).name);
    const Trace without = test::changed(right, [&](std::int64_t, const Event& event) { return event.index() != kind; });
    CHECK(diff::compare(right, without).causes.empty());
    CHECK(diff::compare(without, right).causes.empty());
    CHECK(!diff::compare(right, without).alignment.compared[kind]);
    const diff::DiffReport asked = diff::compare(right, without, nullptr, diff::Way::fast, {}, diff::most_differences,
                                                 diff::Unrecorded::missing_of_pixels);
    REQUIRE(!asked.causes.empty());
    CHECK(asked.causes.front().first.kind == kind);
  }
}

TEST_CASE("diff causes: a pixel too many of one piece is that pixel, and no wrong order of drawing") {
  const Trace right = test::recorded_by("bsp", look_at_scene(load_scene("cyclic").scene, {}));
  // Where a later piece of the polygon has a pixel, the piece drawn first paints it, too.
  std::vector<RecordedEvent> steps;
  std::optional<std::size_t> place;
  std::optional<PixelPaint> more;
  std::int32_t polygon = no_polygon;
  right.each(0, right.size(), [&](std::int64_t, const RecordedEvent& read) {
    if (const auto* draw = get_if<PieceDraw>(&read.event)) polygon = draw->polygon;
    const auto* paint = get_if<PixelPaint>(&read.event);
    if (paint && !place) place = steps.size() + 1, more = PixelPaint{0, 0, paint->z, paint->polygon};
    else if (paint && place && !more->x && polygon == more->polygon && steps.size() > *place + 60)
      more->x = paint->x, more->y = paint->y;
    steps.push_back(read);
    return true;
  });
  REQUIRE(more);
  REQUIRE(more->x > 0);
  steps.insert(steps.begin() + static_cast<std::ptrdiff_t>(*place), {steps[*place - 1].step, *more});
  const diff::DiffReport report = diff::compare(right, of_steps(right, steps));
  REQUIRE(report.causes.size() == 1);
  CHECK(report.causes[0].first.only_b());
  CHECK(report.causes[0].first.b == static_cast<std::int64_t>(*place) + 1);
  CHECK(!report.causes[0].too_early);
}
