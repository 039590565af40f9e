// zstep diff: what follows from a cause is no cause of its own, and what is said of a cause is true of it.
#include <algorithm>
#include <initializer_list>
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

TEST_CASE("diff causes: what is painted follows from its piece's plane, also where the box beside it is right") {
  // Three times four pixels. The second run has the plane half a unit deeper.
  const double z = 9;
  const Trace right = test::recorded_by(
      "scan-line", test::screen_scene(8, 8, {{{1.5, 1.5, z}, {4.5, 1.5, z}, {4.5, 5.5, z}, {1.5, 5.5, z}}}));
  REQUIRE(right.has(kind_of<Extent>));
  const Trace wrong = test::changed(right, [](std::int64_t, Event& event) {
    if (auto* plane = get_if<PlaneEquation>(&event)) plane->plane_d -= 0.5 * plane->plane_c;
    if (auto* paint = get_if<PixelPaint>(&event)) paint->z += 0.5;
    return true;
  });
  const diff::DiffReport report = diff::compare(right, wrong);
  CHECK(kinds_of(report) == "plane_equation ");
  REQUIRE(report.causes.size() == 1);
  CHECK(report.causes[0].symptoms == 12);
  CHECK(report.causes[0].pixels == 12);
}

TEST_CASE("diff causes: an edge may move once more before it leaves the list on the line where it ends") {
  const Trace right = delhi();
  const std::uint8_t move = find_step(right.header().page, "step_edge")->id;
  std::vector<RecordedEvent> steps;
  for (const RecordedEvent& step : steps_of_run(right)) {
    if (const auto* retire = get_if<EdgeRetire>(&step.event)) steps.push_back({move, EdgeStep{retire->edge, 0, 0}});
    steps.push_back(step);
  }
  const diff::DiffReport report = diff::compare(right, of_steps(right, steps));
  CHECK(report.causes.empty());
  CHECK(report.kinds[kind_of<EdgeStep>].only_b == 4);  // two triangles, each with two edges that are not level
  CHECK(report.kinds[kind_of<EdgeStep>].idle_b == 4);
}

TEST_CASE("diff causes: the nth move of an edge is the same step also where it comes a scan line early") {
  zoo::Task task = test::triangles(3, 3, 18);
  const std::string head = test::head(task, "float64", "increments");
  const Trace right = test::trace_of(head + zoo::edge_table(task));
  task.mistake = "stepped_too_early";
  const Trace wrong = test::trace_of(head + zoo::edge_table(task));
  std::int64_t entered = 0;
  for (const RecordedEvent& step : steps_of_run(right)) entered += holds<EdgeEnter>(step.event);
  const diff::KindDifference found = diff::compare(right, wrong).kinds[kind_of<EdgeStep>];
  CHECK(found.only_a == 0);
  CHECK(found.only_b == entered);                // each edge moves once more
  CHECK(found.different + found.rounding == 0);  // and its nth move takes it to the same x and z
}

TEST_CASE("diff causes: where two edges meet, two spans may name them the other way round") {
  // A tent over a notch: at its tip, on y = 4, two edges begin at x = 5.
  const Trace right = test::recorded_by(
      "z-buffer", test::screen_scene(12, 10, {{{1, 1, 0.5}, {9, 1, 0.5}, {9, 8, 0.5}, {5, 4, 0.5}, {1, 8, 0.5}}}));
  std::vector<SpanBegin> spans;
  for (const RecordedEvent& step : steps_of_run(right))
    if (const auto* span = get_if<SpanBegin>(&step.event); span && span->y == 4) spans.push_back(*span);
  REQUIRE(spans.size() == 2);
  REQUIRE(spans[0].x_right == 5);
  REQUIRE(spans[1].x_left == 5);
  const auto named = [&](bool left, bool second) {
    return test::changed(right, [&](std::int64_t, Event& event) {
      auto* span = get_if<SpanBegin>(&event);
      if (!span || span->y != 4) return true;
      if (left && span->x_right == 5) span->right_edge = spans[1].left_edge;
      if (second && span->x_left == 5) span->left_edge = spans[0].right_edge;
      return true;
    });
  };
  const diff::DiffReport both = diff::compare(right, named(true, true));
  CHECK(both.alignment.differences.size() == 2);
  CHECK(both.causes.empty());
  // One of the two edges in both spans is none of them.
  CHECK(kinds_of(diff::compare(right, named(true, false))) == "span_begin ");
  CHECK(kinds_of(diff::compare(right, named(false, true))) == "span_begin ");
}

TEST_CASE("diff causes: of what follows from a cause only the pixels that take another colour are counted as such") {
  const Trace right = delhi();
  const auto first = [&](auto&& is) { return right.next(0, is).value_or(0); };
  const std::int64_t depth = first([](const RecordedEvent&step) { return holds<DepthWrite>(step.event); }),
                     color = first([](const RecordedEvent&step) { return holds<PixelWrite>(step.event); });
  const auto pixels = [&](std::int64_t step) {
    const diff::DiffReport report =
        diff::compare(right, test::changed(right, [&](std::int64_t number, const Event&) { return number != step; }));
    REQUIRE(report.causes.size() == 1);
    return report.causes[0].pixels;
  };
  CHECK(pixels(depth) == 0);
  CHECK(pixels(color) == 1);
}

namespace {

/// Level polygons over each other, of these depths, painted; the first two the other way round in the second run. Both
/// are facets of one polygon where `one_polygon`.
bool is_too_early(std::initializer_list<double> depths, bool one_polygon) {
  std::vector<std::vector<glm::dvec3>> polygons;
  for (const double z : depths) polygons.push_back({{1, 1, z}, {6, 1, z}, {6, 6, z}, {1, 6, z}});
  Scene scene = test::screen_scene(8, 8, polygons);
  if (one_polygon) {
    for (std::size_t facet = 1; facet < scene.facets.size(); ++facet) --scene.facets[facet].polygon;
    scene.polygons.pop_back();
  }
  const Trace right = test::recorded_by("painter", scene);
  const std::vector<RecordedEvent> all = steps_of_run(right);
  std::vector<std::ptrdiff_t> draws;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (holds<PieceDraw>(all[i].event)) draws.push_back(static_cast<std::ptrdiff_t>(i));
  REQUIRE(draws.size() == depths.size());
  std::vector<RecordedEvent> turned(all.begin(), all.begin() + draws[0]);
  turned.insert(turned.end(), all.begin() + draws[1], all.begin() + draws[2]);
  turned.insert(turned.end(), all.begin() + draws[0], all.begin() + draws[1]);
  turned.insert(turned.end(), all.begin() + draws[2], all.end());
  const diff::DiffReport report = diff::compare(right, of_steps(right, turned));
  return std::any_of(report.causes.begin(), report.causes.end(), [](const auto& cause) { return cause.too_early; });
}

}  // namespace

TEST_CASE("diff causes: painted too early is another polygon that is nearer by more than rounding, covered or not") {
  CHECK(is_too_early({0.5, 0.4, 0.25}, false));
  CHECK_FALSE(is_too_early({0.5, 0.5 * (1 - 1e-12), 0.25}, false));
  CHECK_FALSE(is_too_early({0.5, 0.4, 0.25}, true));
}
