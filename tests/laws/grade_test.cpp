// Law: who computes right gets all points, whatever the program is like; who does not loses some, and the first wrong
// step is named; and what follows correctly from a mistake keeps the points of its computation.
#include <doctest/doctest.h>

#include <algorithm>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/grade/grade.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;
using grade::Level, grade::Part;

namespace {

std::vector<Part> parts() {
  return {{"buffers", Level::buffers, {}, 0, 8},
          {"compares", Level::matched, {kind_of<DepthCompare>, kind_of<DepthWrite>, kind_of<PixelWrite>}, 4, 4},
          {"spans", Level::matched, {kind_of<SpanBegin>, kind_of<DepthInterpolate>}, 4, 4},
          {"edge table", Level::matched, {kind_of<EdgeTableInsert>, kind_of<EdgeTableSkip>}, 4, 4},
          {"active edges", Level::matched, {kind_of<EdgeEnter>, kind_of<EdgeStep>, kind_of<EdgeRetire>}, 4, 4}};
}
constexpr std::size_t compares = 1, spans = 2, edge_table = 3;

std::vector<zoo::Task> tasks() {
  return {test::triangles(3, 3, 18), test::triangles(6, 6, 22), test::triangles(11, 10, 26)};
}

struct Judged {
  grade::Judgement found;
  double points = 0, most = 0;
};
Judged judged(const zoo::Task& task, const std::string& text, const char* number_format, const char* interpolation) {
  std::string impossible;
  const Trace run = test::trace_of(test::head(task, number_format, interpolation) + text, &impossible);
  const Trace reference = test::recorded_by("z-buffer", run.scene(), run.header().conventions);
  const std::vector<Part> all = parts();
  Judged result{grade::judge(reference, run, all)};
  for (std::size_t k = 0; k < all.size(); ++k) {
    const grade::PartCount& count = result.found.parts[k];
    CHECK(count.computed <= count.expected);
    CHECK(count.same <= count.expected);
    CHECK(count.same >= 0);
    CHECK(count.computed >= 0);
    result.points += count.computation_points(all[k]) + count.value_points(all[k]);
    result.most += all[k].points();
  }
  return result;
}

/// The run once more: change(step, put) may alter each step, or say that it is left out, and put(NAME, event) puts a
/// step of this name before it.
template <class Change>
Trace with_steps(const Trace& run, Change&& change) {
  TraceRecorder recorder(run.header(), run.scene());
  for (std::int64_t at = 1; at <= run.size(); ++at) {
    RecordedEvent step = run.event(at);
    const auto put = [&](const char* name, const Event& event) {
      record_any(recorder, find_step(run.header().page, name)->id, event);
    };
    if (change(step, put)) record_any(recorder, step.step, step.event);
  }
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "changed");
}

}  // namespace

TEST_CASE("grade: right programs of two structures get all points, and no step is named") {
  for (const zoo::Task& task : tasks()) {
    const Judged by_increments = judged(task, zoo::edge_table(task), "float64", "increments");
    CHECK(by_increments.points == doctest::Approx(by_increments.most));
    CHECK_FALSE(by_increments.found.first);
  }
  // What a program does not do, here an edge table, it gets no points for; what it does is right all the same.
  for (const zoo::Task& task : tasks()) {
    const Judged by_half_planes = judged(task, zoo::half_planes(task), "float64", "direct");
    CHECK_FALSE(by_half_planes.found.first);
    const std::vector<grade::PartCount>& counts = by_half_planes.found.parts;
    CHECK(counts[0].same == counts[0].all());
    CHECK(counts[compares].same == counts[compares].all());
    CHECK(counts[edge_table].same == 0);
    CHECK(counts[edge_table].expected > 0);
  }
}

TEST_CASE("grade: a wrong program loses points, and its first wrong step is named where it shows") {
  int wrong = 0, named = 0;
  for (const char* mistake :
       {"z_not_swapped", "slope_inverted", "z_slope_of_x", "x_at_vertex", "ends_one_late", "compare_reversed",
        "equal_wins", "written_before_test", "colour_always", "depth_not_written", "right_end_included",
        "z_not_to_centre", "never_retired", "not_sorted", "buffer_begins_at_0", "buffer_reset"}) {
    for (zoo::Task& task : std::vector<zoo::Task>(tasks())) {
      const std::string right = zoo::edge_table(task);
      task.mistake = mistake;
      const std::string text = zoo::edge_table(task);
      const std::int64_t first = test::first_difference(right, text);
      if (first == 0) continue;
      CAPTURE(mistake);
      ++wrong;
      const Judged result = judged(task, text, "float64", "increments");
      CHECK(result.points < result.most - 1e-9);
      REQUIRE(result.found.first);
      std::string impossible;
      const Trace run = test::trace_of(test::head(task, "float64", "increments") + text, &impossible);
      named += first <= result.found.first->step && result.found.first->step <= test::shown_at(run, first);
    }
  }
  MESSAGE("the first wrong step is named in ", named, " of ", wrong, " runs");
  CHECK(wrong > 30);
  CHECK(named >= 0.95 * wrong);
}

TEST_CASE("grade: what follows from a wrong slope is computed right, and only its values are wrong") {
  zoo::Task task = test::triangles(3, 1, 18);
  task.mistake = "z_slope_of_x";
  const Judged result = judged(task, zoo::edge_table(task), "float64", "increments");
  const std::vector<grade::PartCount>& counts = result.found.parts;
  CHECK(counts[edge_table].computed < counts[edge_table].all());
  CHECK(counts[spans].computed == counts[spans].all());
  CHECK(counts[spans].same < counts[spans].all());
}

TEST_CASE("grade: fixed-point numbers are rounded right only where the homework names them") {
  zoo::Task task = test::triangles(6, 6, 22);
  task.style = "16";
  const Scene scene = test::scene_of(task);
  Conventions conventions;
  conventions.cull = false;
  std::string head = test::head("z-buffer", scene, conventions);
  const std::string declared = "\"number_format\":\"float64\"";
  REQUIRE(head.find(declared) != std::string::npos);
  head.replace(head.find(declared), declared.size(), "\"number_format\":\"as computed\"");
  const Trace run = test::trace_of(head + zoo::fixed_point(task));
  const Trace reference = test::recorded_by("z-buffer", run.scene(), run.header().conventions);
  CHECK_FALSE(
      grade::judge(reference, run, parts(), grade::held_to(6, {"number_format", "number_format fixed16"})).first);
  CHECK(grade::judge(reference, run, parts(), grade::held_to(6, {"number_format"})).first);
}

TEST_CASE("grade: steps in another order count where the order is free, and not where it is graded") {
  const zoo::Task task = test::triangles(6, 6, 22);
  std::string impossible;
  const Trace run =
      test::trace_of(test::head(task, "float64", "direct") + zoo::half_planes(task), &impossible);  // by columns
  const Trace reference = test::recorded_by("z-buffer", run.scene(), run.header().conventions);
  const std::vector<std::uint8_t> kinds{kind_of<DepthCompare>};
  const grade::Judgement found =
      grade::judge(reference, run, {{"free", Level::matched, kinds, 1, 1}, {"in order", Level::ordered, kinds, 1, 1}});
  CHECK(found.parts[0].same == found.parts[0].all());
  CHECK(found.parts[1].same < found.parts[1].all());
  CHECK(found.parts[1].same > 0);
}

TEST_CASE("grade: of an ordered part, steps that are exchanged cost computation and value alike, each its share") {
  const zoo::Task task = test::triangles(3, 3, 18);
  const std::string text = zoo::edge_table(task);
  const Trace right = test::trace_of(test::head(task, "float64", "increments") + text);
  // The first two compares of one span change places, with nothing else between them that is about either.
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  std::vector<std::size_t> compares_at;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].find("\"compare\"") != std::string::npos) compares_at.push_back(i);
  REQUIRE(compares_at.size() > 2);
  std::swap(lines[compares_at[0]], lines[compares_at[1]]);
  std::string other;
  for (const std::string& line : lines) other += line + "\n";
  const Trace run = test::trace_of(test::head(task, "float64", "increments") + other);
  const Trace reference = test::recorded_by("z-buffer", right.scene(), right.header().conventions);
  const std::vector<std::uint8_t> kinds{kind_of<DepthCompare>};
  const Part free{"free", Level::matched, kinds, 10, 20}, ordered{"in order", Level::ordered, kinds, 10, 20};
  const grade::Judgement before = grade::judge(reference, right, {free, ordered}),
                         after = grade::judge(reference, run, {free, ordered});
  CHECK(before.parts[1].lost.empty());
  const grade::PartCount &loose = after.parts[0], &strict = after.parts[1];
  CHECK(strict.computed == loose.computed - 1);
  CHECK(strict.same == loose.same - 1);
  CHECK(strict.computation_points(ordered) ==
        doctest::Approx(10.0 * static_cast<double>(strict.computed) / static_cast<double>(strict.all())));
  CHECK(strict.value_points(ordered) ==
        doctest::Approx(20.0 * static_cast<double>(strict.same) / static_cast<double>(strict.all())));
  CHECK(std::any_of(strict.lost.begin(), strict.lost.end(),
                    [](const grade::Loss& loss) { return loss.why == grade::Loss::Why::order && loss.count == 1; }));
}

TEST_CASE("grade: moves that right programs make or leave out are not counted as additional") {
  const Trace right = test::recorded_by("z-buffer", look_at_scene(load_scene("delhi").scene, {}));
  // Each edge moves once more before it leaves the list.
  const Trace run = with_steps(right, [](const RecordedEvent& step, auto&& put) {
    if (const auto* retire = get_if<EdgeRetire>(&step.event)) put("step_edge", EdgeStep{retire->edge, 0, 0});
    return true;
  });
  REQUIRE(run.size() == right.size() + 4);
  const grade::Judgement found = grade::judge(right, run, {{"moves", Level::matched, {kind_of<EdgeStep>}, 4, 4}});
  CHECK(found.parts[0].additional == 0);
  CHECK(found.parts[0].same == found.parts[0].all());
}

TEST_CASE("grade: of a run without an edge table no step of the active edges is named as wrong") {
  const Trace right = test::recorded_by("z-buffer", look_at_scene(load_scene("delhi").scene, {}));
  const auto first_of = [&](bool with_table) {
    const Trace run = with_steps(right, [&](RecordedEvent& step, auto&&) {
      if (auto* moved = get_if<EdgeStep>(&step.event)) moved->x_edge += 0.25;
      return with_table || !holds<EdgeTableInsert>(step.event);
    });
    return grade::judge(right, run, {}).first;
  };
  CHECK_FALSE(first_of(false));
  REQUIRE(first_of(true));
  CHECK(first_of(true)->fault);
}

TEST_CASE("grade: a step that breaks a rule is named before a later one that parts from the reference") {
  const Trace right = test::recorded_by("z-buffer", look_at_scene(load_scene("delhi").scene, {}));
  // Before the span on y = 3 two edges change places and change back, and a later depth is written otherwise.
  std::int64_t swapped = 0, at = 0;
  const auto last =
      right.previous(right.size() + 1, [](const RecordedEvent& step) { return holds<DepthWrite>(step.event); });
  REQUIRE(last);
  const Trace run = with_steps(right, [&](RecordedEvent& step, auto&& put) {
    ++at;
    if (const auto* span = get_if<SpanBegin>(&step.event); span && span->y == 3 && swapped == 0) {
      put("swap_edges", EdgeSwap{0}), put("swap_edges", EdgeSwap{0});
      swapped = at;
    }
    if (at == *last) get_if<DepthWrite>(&step.event)->z += 1;
    return true;
  });
  const auto first = grade::judge(right, run, {}).first;
  REQUIRE(first);
  CHECK(first->step == swapped);
  REQUIRE(first->fault);
  CHECK(first->fault->rule == formulas::Rule::swap_needed);
  CHECK_FALSE(first->parts);
}
