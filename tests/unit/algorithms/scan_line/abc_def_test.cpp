// The example of 002 (Foley et al., figure 15.34): the active edge table on five scan lines.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "algorithms/scan_line/scan_line.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/where.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

// The scene names its polygons by their corners: point 0 is A, point 5 is F. From the end where the edge begins.
std::string name_of(const EdgeTableInsert& edge) {
  return {static_cast<char>('A' + edge.vertex_0), static_cast<char>('A' + edge.vertex_1)};
}

struct Line {
  std::string active;     // as the sweep finds it
  std::string intervals;  // how many flags are true, edge by edge, and who is seen
};

std::map<std::int32_t, Line> lines_of(const Trace& trace) {
  std::map<std::int32_t, Line> lines;
  Replay replay(trace);
  std::int32_t last = -1;
  while (replay.position() < trace.size()) {
    replay.step_forward();
    const MethodState& machine = replay.state().machine;
    const Event& event = trace.event(replay.position()).event;
    if (!machine.scan_line) continue;
    Line& line = lines[*machine.scan_line];
    if (holds<FlagFlip>(event) && last != *machine.scan_line) {
      last = *machine.scan_line;
      for (const ActiveEdge& active : machine.active) {
        if (!line.active.empty()) line.active += ' ';
        line.active += name_of(machine.edge_table[static_cast<std::size_t>(active.edge)]);
      }
    }
    if (const auto* interval = get_if<SpanFlags>(&event)) line.intervals += std::to_string(interval->flags);
    if (const auto* seen = get_if<SpanWinner>(&event)) line.intervals += seen->piece == 0 ? "a" : "d";
  }
  return lines;
}

}  // namespace

TEST_CASE("scan line: ABC and DEF, the active edge table of 002 on the lines alpha to gamma + 2") {
  const SceneFile file = load_scene(test::in_checkout("lessons/scenes/abc-def.toml"));
  const Scene scene = look_at_scene(file.scene, {});
  Header header;
  header.algorithm = "scan-line";
  header.conventions = file.conventions;
  header.page = scan_line::page();
  TraceRecorder recorder(header, scene);
  scan_line::run(scene, file.conventions, recorder);
  recorder.finish();
  auto lines = lines_of(Trace::from_bytes(recorder.take_bytes(), "abc-def"));

  const std::int32_t alpha = 2, beta = 4, gamma = 9;
  CHECK(lines[alpha].active == "AB AC");
  CHECK(lines[beta].active == "AB AC FD FE");
  CHECK(lines[gamma].active == "AB DE CB FE");
  CHECK(lines[gamma + 1].active == "AB DE CB FE");
  CHECK(lines[gamma + 2].active == "AB CB DE FE");

  // One polygon; two apart, with nothing between; two that overlap, where DEF is in front; two apart again.
  CHECK(lines[alpha].intervals == "1a");
  CHECK(lines[beta].intervals == "1a01d");
  CHECK(lines[gamma].intervals == "1a2d1d");
  CHECK(lines[gamma + 1].intervals == "1a2d1d");
  CHECK(lines[gamma + 2].intervals == "1a01d");
}
