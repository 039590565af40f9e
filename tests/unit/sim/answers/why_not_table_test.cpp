// Law: each reason why a polygon is not what is seen is given where it is so, with the step that decided it. By table:
// a run, a polygon, a pixel, the reason, and its step.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

#include "sim/answers/why_not.hpp"
#include "tests/golden/run_edits.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"

using namespace zstep;
using answers::Verdict, answers::Why;

namespace {

struct Reason {
  Why kind;
  const char* run;    ///< of tests/golden, or foreign/NAME of tests/data
  std::int32_t x, y;  ///< −1 where it is asked of the whole picture
  const char* polygon;
  std::int64_t step;                 ///< 0 where none decides it
  const char* name;                  ///< of that step, "" where there is none
  std::vector<const char*> edits{};  ///< of the run, as test::with_edit takes them
};

const std::vector<Reason>& reasons() {
  using enum Why;
  static const std::vector<Reason> all{
      // Compared or painted pixel by pixel.
      {seen, "pyramid", 8, 5, "A", 37, "write_pixel"},
      {seen, "depth-sort", 4, 4, "A", 105, "paint"},
      {mixed, "transparency", 4, 2, "A", 405, "blend"},
      {lost, "pyramid-behind", 6, 5, "G", 448, "compare"},
      {lost, "pyramid-view", -1, -1, "B", 100, "compare"},
      {lost, "scan-line-buffer", 9, 4, "B", 306, "compare"},
      {tie, "pyramid-behind", 8, 2, "G", 416, "compare"},
      {overwritten, "delhi", 0, 1, "A", 163, "compare"},
      {painted_over, "depth-sort-cyclic", 7, 7, "A", 298, "paint"},
      {painted_over, "bsp-walls", 7, 5, "A", 439, "paint"},
      {wiped, "foreign/clear1", 0, 0, "A", 186, "clear"},
      {taken, "bsp", 7, 4, "A", 303, "paint"},
      {contradicted, "foreign/alwayswrite", 3, 1, "A", 211, "compare"},
      {contradicted, "foreign/wrongcolour", 1, 1, "B", 205, "wp"},
      {not_recorded, "foreign/nocompare", 2, 2, "B", 184, "interp"},
      {not_recorded, "foreign/torn", 0, 1, "B", 0, ""},
      {not_recorded, "foreign/cutincl", -1, -1, "B", 0, ""},
      {not_recorded, "foreign/nopoly", 2, 2, "B", 0, ""},
      // Before the raster: by what each facet is, whatever the method.
      {culled, "pyramid", 8, 5, "B", 160, "reject"},
      {culled, "bsp", -1, -1, "D", 274, "back_face"},
      {culled, "ray-tracing", -1, -1, "S", 0, ""},
      {clipped, "clipping", 0, 0, "A", 76, "clip_vertex"},
      {clipped, "with-attribute", 7, 6, "A", 17, "clip_vertex"},
      {clipped, "bsp-behind", 3, 1, "A", 0, ""},
      {outside, "clipping", -1, -1, "G", 573, "reject"},
      {edge_on, "depth-sort-clipping", -1, -1, "F", 193, "reject"},
      {degenerate, "transparency", -1, -1, "I", 218, "no_area"},
      {degenerate, "ray-casting-no-area", -1, -1, "B", 2, "reject"},
      {not_covered, "cyclic", 0, 0, "A", 29, "polygon"},
      {not_covered, "bsp-behind", -1, -1, "A", 0, ""},
      {contradicted, "foreign/reject_edge_on", 1, 2, "B", 187, "reject"},
      {contradicted, "foreign/facing_wrong", -1, -1, "B", 188, "reject"},
      // The floating horizon.
      {seen, "floating-horizon", 4, 6, "A", 253, "draw"},
      {horizon, "floating-horizon", 7, 5, "H", 336, "test"},
      {not_covered, "floating-horizon", 0, 0, "A", 155, "segment"},
      // Lines.
      {seen, "hidden-line", 12, 12, "A", 159, "draw"},
      {line_hidden, "hidden-line", 12, 23, "A", 180, "hide"},
      {back_edge, "wireframe", 5, 3, "A", 42, "back"},
      {outside, "wireframe-clipping", -1, -1, "H", 0, ""},
      {not_covered, "hidden-line", 0, 0, "A", 152, "edge"},
      // Rays.
      {seen, "ray-casting", 2, 1, "A", 123, "paint"},
      {lost, "ray-casting", 2, 1, "B", 116, "hit"},
      {tie, "ray-casting-tree", 7, 1, "E", 148, "hit"},
      {overwritten, "ray-casting-tree", 2, 1, "B", 85, "hit"},
      {unreached, "ray-casting-facet", 2, 1, "B", 83, "box_test"},
      {unreached, "ray-casting-grid", 2, 1, "B", 107, "cell"},
      {box_missed, "ray-casting-facet", 0, 0, "A", 13, "box_test"},
      {box_missed, "ray-casting-grid", 3, 0, "A", 60, "cell"},
      {clipped, "ray-casting", 0, 0, "E", 11, "plane"},
      {not_covered, "ray-casting", 0, 0, "A", 4, "hit"},
      {contradicted, "foreign/far", 0, 0, "B", 3, "hit"},
      {contradicted, "ray-casting", 2, 1, "A", 123, "paint", {"set paint 2 polygon=1"}},
      // Warnock's areas.
      {seen, "warnock", 13, 2, "A", 58, "paint"},
      {lost, "warnock", 13, 7, "B", 119, "pixel"},
      {surrounded, "warnock", 10, 10, "C", 229, "front_surrounder"},
      {apart, "warnock", 0, 0, "A", 31, "disjoint"},
      {not_covered, "warnock", 12, 0, "A", 57, "one_polygon"},
      {contradicted, "warnock", 13, 7, "A", 119, "pixel", {"set pixel 2 piece=1", "set paint 23 polygon=1"}},
      {tie, "warnock", 13, 7, "B", 119, "pixel", {"set center_depth 2 z=3.5"}},
      {contradicted, "warnock", 10, 10, "C", 229, "front_surrounder", {"set corner_depth 5 z=0.5"}},
      // The scan-line method.
      {seen, "scan-line", 5, 2, "ABC", 54, "paint"},
      {mixed, "scan-line-areas", 13, 1, "A", 92, "cover"},
      {lost, "scan-line", 13, 7, "ABC", 161, "winner"},
      {flag_out, "scan-line", 0, 0, "ABC", 0, ""},
      {flag_out, "scan-line", 20, 7, "ABC", 163, "flip"},
      {contradicted, "scan-line", 13, 7, "DEF", 161, "winner", {"set paint 38 polygon=0", "set paint 38 z=4.0"}},
  };
  return all;
}

Trace run_of(const Reason& reason) {
  const std::string name = reason.run,
                    path = (name.starts_with("foreign/") ? "tests/data/" : "tests/golden/") + name + ".jsonl";
  if (reason.edits.empty()) return open_jsonl(test::in_checkout(path));
  test::RunLines lines = test::lines_of_run(path);
  for (const char* edit : reason.edits) lines = test::with_edit(lines, edit);
  return test::trace_of_lines(lines);
}

std::string name_of_step(const Trace& trace, std::int64_t step) {
  if (step > 0)
    for (const StepInfo& info : trace.header().page)
      if (info.id == trace.event(step).step) return info.name;
  return "";
}

}  // namespace

TEST_SUITE("why not") {
  TEST_CASE("law: each reason is given where it is so, with the step that decides it") {
    std::set<Why> given;
    for (const Reason& reason : reasons()) {
      CAPTURE(std::string(reason.run));
      CAPTURE(reason.x);
      CAPTURE(reason.y);
      CAPTURE(std::string(reason.polygon));
      const Trace trace = run_of(reason);
      const auto polygon = answers::polygon_called(trace.scene(), reason.polygon);
      REQUIRE(polygon);
      const Verdict verdict =
          reason.x < 0 ? answers::why_not(trace, *polygon) : answers::why_not(trace, *polygon, {reason.x, reason.y});
      CAPTURE(verdict.sentence);
      CHECK(static_cast<int>(verdict.kind) == static_cast<int>(reason.kind));
      CHECK(verdict.step == reason.step);
      CHECK(name_of_step(trace, verdict.step) == std::string(reason.name));
      given.insert(reason.kind);
    }
    for (std::size_t kind = 0; kind < answers::why_count; ++kind) {
      CAPTURE(kind);
      CHECK(given.contains(static_cast<Why>(kind)));
    }
  }
}
