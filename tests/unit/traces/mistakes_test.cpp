// Which steps speak for a known mistake and which against it, where only few do.
#include "traces/mistakes/name.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/golden/golden.hpp"
#include "tests/golden/run_edits.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/grade/grade.hpp"

using namespace zstep;
using enum mistakes::Mistake;

namespace {

const std::string clear = R"({"step":"clear","z":"inf"})", clear_to_0 = R"({"step":"clear","z":0})",
                  begin_a = R"({"step":"polygon","polygon":0,"facet":0})",
                  begin_b = R"({"step":"polygon","polygon":1,"facet":1})";

std::string compare(int x, const std::string& z, bool nearer) {
  return R"({"step":"compare","x":)" + std::to_string(x) + R"(,"y":1,"z":)" + z + R"(,"nearer":)" +
         (nearer ? "true}" : "false}");
}
std::string store(int x, const std::string& z) {
  return R"({"step":"store","x":)" + std::to_string(x) + R"(,"y":1,"z":)" + z + "}";
}
std::string paint(int x, int polygon) {
  return R"({"step":"paint","x":)" + std::to_string(x) + R"(,"y":1,"polygon":)" + std::to_string(polygon) + "}";
}

/// Steps of a program that prints no more than what happens at pixels, of two triangles in the plane z = 5.
Trace run_of(const std::vector<std::string>& steps) {
  test::RunLines lines{
      R"({"ztrace":1,"writer":"my program","algorithm":"z-buffer","conventions":{"depth":"view","nearer":"smaller",)"
      R"("ties":"first","number_format":"float64"},"steps":[{"id":1,"name":"clear","event":"buffers_clear"},)"
      R"({"id":2,"name":"polygon","event":"polygon_begin"},{"id":3,"name":"compare","event":"depth_compare"},)"
      R"({"id":4,"name":"store","event":"depth_write"},{"id":5,"name":"paint","event":"pixel_write"}],)"
      R"("scene":{"raster":{"width":4,"height":4},"camera":{"kind":"screen"},"points":[[0,0,5],[1,1,5],[2,2,5]],)"
      R"("polygons":[{"name":"A"},{"name":"B"}],)"
      R"("facets":[{"polygon":0,"points":[0,1,2]},{"polygon":1,"points":[0,1,2]}]}})"};
  lines.insert(lines.end(), steps.begin(), steps.end());
  return test::trace_of_lines(lines);
}
mistakes::Fit fit_of(const Trace& run, mistakes::Mistake mistake) {
  return mistakes::fits_of(run, precision_of(run), {})[static_cast<std::size_t>(mistake)];
}

}  // namespace

TEST_CASE("mistakes: who keeps the first of two depths that rounding tells apart does not let equal ones win") {
  const mistakes::Fit kept = fit_of(
      run_of({clear, begin_a, compare(1, "5", true), store(1, "5"), begin_b, compare(1, "4.99999999999", false)}),
      equal_wins);
  CHECK(kept.as_made == 0);
  CHECK(kept.against_before + kept.against_after == 1);
  CHECK(
      fit_of(run_of({clear, begin_a, compare(1, "5", true), store(1, "5"), begin_b, compare(1, "5", true)}), equal_wins)
          .as_made == 1);
}

TEST_CASE("mistakes: a reversed compare against nothing always loses, or always wins") {
  const auto reversed = [](bool first, bool second) {
    return fit_of(run_of({clear, begin_a, compare(1, "5", first), compare(2, "5", second)}), compare_reversed).holds();
  };
  CHECK(reversed(false, false));
  CHECK_FALSE(reversed(true, false));
  CHECK_FALSE(reversed(false, true));
}

TEST_CASE("mistakes: a buffer that begins at 0 does so each time that it is cleared") {
  const auto begins_at_0 = [](const std::string& one, const std::string& other) {
    return fit_of(run_of({one, other, begin_a, compare(1, "5", false)}), buffer_begins_at_0).holds();
  };
  CHECK(begins_at_0(clear_to_0, clear_to_0));
  CHECK_FALSE(begins_at_0(clear_to_0, clear));
  CHECK_FALSE(begins_at_0(clear, clear_to_0));
}

TEST_CASE("mistakes: a pixel that keeps its polygon's colour from before tells nothing of a compare that is lost") {
  const std::vector<std::string> right{clear,       begin_a, compare(1, "5", true),  store(1, "5"),
                                       paint(1, 0), begin_a, compare(1, "6", false), compare(2, "5", true)};
  CHECK(fit_of(run_of(right), colour_always).as_made == 0);
  std::vector<std::string> wrong = right;
  wrong.insert(wrong.end(), {store(2, "5"), paint(2, 0), begin_b, compare(2, "6", false), paint(2, 1)});
  CHECK(fit_of(run_of(wrong), colour_always).as_made == 1);
}

TEST_CASE("mistakes: a polygon's closing edge is not there for a neighbour's that joins the same vertices") {
  zoo::Task task;
  task.width = 14, task.height = 12;
  task.points = {{1, 1, 0.5}, {6, 2, 0.5}, {5.5, 10, 0.5}, {1.5, 9, 0.5}, {12, 5.5, 0.5}};
  task.polygons = {{0, {0, 1, 2, 3}}, {1, {2, 4, 1}}};  // the second one's last edge is the first one's second
  task.mistake = "closing_edge_missed";
  std::string impossible;
  const Scene scene = test::scene_of(task);
  const Trace run =
      test::trace_of(test::head("scan-line", scene, test::recorded_by("scan-line", scene).header().conventions) +
                         zoo::scan_line_flags(task),
                     &impossible);
  const mistakes::Fit fit = fit_of(run, closing_edge_missed);
  CHECK(fit.as_made == 2);
  CHECK(fit.against_before + fit.against_after == 0);
}

TEST_CASE("mistakes: one number that two mistakes together would make names neither") {
  // Of one triangle one edge goes upwards; two triangles have two.
  const auto named = [](int triangles) {
    zoo::Task task;
    task.width = task.height = 16;
    for (int k = 0; k < triangles; ++k) {
      const int first = 3 * k;
      for (const zoo::Point& point : {zoo::Point{2.25, 1.5, 0.25 + k}, {12.5, 6.25, 0.5 + k}, {4.75, 13.5, 0.875 + k}})
        task.points.push_back(point);
      task.polygons.push_back({k, {first, first + 1, first + 2}});
    }
    const Trace right = test::trace_of(test::head(task, "float64", "increments") + zoo::edge_table(task));
    std::int64_t changed = 0;
    const Trace wrong = test::changed(right, [&](std::int64_t step, Event& event) {
      auto* edge = get_if<EdgeTableInsert>(&event);
      if (!edge || edge->vertex_0 % 3 != 0 || edge->vertex_1 % 3 != 2) return true;
      edge->z_edge = right.scene().points[static_cast<std::size_t>(edge->vertex_1)].z;
      if (changed == 0) changed = step;
      return true;
    });
    return mistakes::pair_of(wrong, changed, precision_of(wrong)).has_value();
  };
  CHECK(named(2));
  CHECK_FALSE(named(1));
}

TEST_CASE("mistakes: where the first depth is wrong, who wins at a later pixel is not what the run goes wrong by") {
  const auto named = [](const std::string& z) {
    const auto pixels = [](const std::string& depth, bool second) {
      std::vector<std::string> steps{clear,
                                     begin_a,
                                     compare(1, depth, true),
                                     store(1, depth),
                                     paint(1, 0),
                                     compare(2, depth, true),
                                     store(2, depth),
                                     paint(2, 0),
                                     begin_b,
                                     compare(2, "6", false),
                                     compare(1, depth, second)};
      if (second) steps.insert(steps.end(), {store(1, depth), paint(1, 1)});
      return run_of(steps);
    };
    const Trace run = pixels(z, true), reference = pixels("5", false);
    const auto likely = grade::mistake_in(reference, run, grade::judge(reference, run, {}));
    return likely && likely->mistake == equal_wins;
  };
  CHECK(named("5"));
  CHECK_FALSE(named("5.5"));
}
