#include <map>
#include <string>

#include <doctest/doctest.h>

#include "sim/viewer/model/label_spots.hpp"
#include "sim/words/explain.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("law: a polygon is said to have no scan line only where none of its scan lines is in the run") {
  std::map<std::string, int> said;
  for (const auto& [method, scene] : {std::pair("painter", "slanting"),
                                      {"depth-sort", "five-tests"},
                                      {"bsp", "six-walls"},
                                      {"z-buffer", "prism"},
                                      {"scan-line", "prism"},
                                      {"shadow-buffer", "lamp"}}) {
    CAPTURE(method);
    const Trace trace =
        test::record_run_by(method, test::in_checkout(std::string("lessons/scenes/") + scene + ".toml"));
    std::map<std::int32_t, int> lines_of;
    for (std::int64_t step = 1; step <= trace.size(); ++step)
      if (holds<ScanLineBegin>(trace.event(step).event)) ++lines_of[trace.polygon_at_work(step)];
    ScanLineMarks marks;
    for (std::int64_t position = 0; position <= trace.size(); ++position) {
      const ScanLineMarks::Interval interval = marks.at(trace, position);
      if (!interval.lines.empty() || interval.polygon == no_polygon) continue;
      const std::string why = why_no_lines(trace, interval, position);
      CAPTURE(position);
      CAPTURE(why);
      const bool at_work = trace.polygon_at_work(position) != no_polygon, has_lines = lines_of[interval.polygon] > 0;
      if (why.ends_with("has no scan line in this run")) REQUIRE((at_work && !has_lines));
      REQUIRE(why.find("meets no") == std::string::npos);
      if (why.starts_with("no polygon is at work")) REQUIRE(!at_work);
      if (why.ends_with(" yet")) REQUIRE(at_work);
      ++said[why.substr(why.find_last_of(' '))];
    }
  }
  CHECK(said[" yet"] > 0);
  CHECK(said[" run"] > 0);
}

TEST_CASE("timeline: of a run that records no scan lines it is not said that a polygon meets none") {
  const Trace whole = test::record_run_by("z-buffer", test::in_checkout("lessons/scenes/prism.toml"));
  const Trace trace = test::changed(
      whole, [](std::int64_t, const Event& event) { return holds<PolygonBegin>(event) || holds<DepthCompare>(event); });
  ScanLineMarks marks;
  for (std::int64_t position = 1; position <= trace.size(); ++position)
    REQUIRE(why_no_lines(trace, marks.at(trace, position), position) == "this run records no scan lines");
}
