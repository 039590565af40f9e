// Searches by leaps: in a trace of many blocks they find what a walk through all of it finds.
#include <doctest/doctest.h>

#include <map>
#include <random>
#include <string>

#include "algorithms/scene/load.hpp"
#include "sim/answers/origin/find.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/traces/some_trace.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

constexpr std::int32_t numbers = 3000;

/// Boxes 0, 2, 4, … among other events: many in some places, few in others, and none at the end.
Trace trace_of_boxes(std::vector<std::int64_t>& steps) {
  const Scene scene = some_scene();
  TraceRecorder recorder(some_header(), scene);
  std::mt19937_64 random(7);
  std::int64_t step = 0;
  const auto pass = [&](std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i, ++step)
      record_any(recorder, step_of(kind_of<PixelWrite>), PixelWrite{static_cast<std::int32_t>(random() % 16), 3, 0});
  };
  for (std::int32_t number = 0; number < numbers; ++number) {
    pass(number % 500 == 250 ? 40000 : random() % 40);
    record_any(recorder, step_of(kind_of<BoxMake>), BoxMake{2 * number, 0, 0, 1, 0, 1, 0, 1});
    steps.push_back(++step);
  }
  pass(60000);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "boxes");
}

}  // namespace

TEST_SUITE("searches by leaps") {
  TEST_CASE("an event by its number: where a walk finds it, or nowhere") {
    std::vector<std::int64_t> steps;
    const Trace trace = trace_of_boxes(steps);
    REQUIRE(trace.size() > 300000);
    const std::int64_t end = trace.size() + 1;
    for (std::int32_t number = 0; number < numbers; number += 113) {
      CAPTURE(number);
      const std::int64_t step = steps[static_cast<std::size_t>(number)];
      CHECK(answers::numbered(trace, 0, end, &BoxMake::box, 2 * number) == step);
      CHECK(answers::numbered(trace, step - 1, end, &BoxMake::box, 2 * number) == step);
      CHECK(answers::numbered(trace, 0, step + 1, &BoxMake::box, 2 * number) == step);
      CHECK(answers::numbered(trace, 0, step, &BoxMake::box, 2 * number) == std::nullopt);
      CHECK(answers::numbered(trace, step, end, &BoxMake::box, 2 * number) == std::nullopt);
      CHECK(answers::numbered(trace, 0, end, &BoxMake::box, 2 * number + 1) == std::nullopt);
    }
    const auto found = answers::first_beyond<BoxMake>(trace, 0, end, [](const BoxMake& box) { return box.box > 3001; });
    REQUIRE(found);
    CHECK(found->step == steps[1501]);
    CHECK(found->event.box == 3002);
    CHECK_FALSE(
        answers::first_beyond<BoxMake>(trace, 0, end, [](const BoxMake& box) { return box.box > 2 * numbers; }));
  }

  TEST_CASE("where vertices were viewed and edges entered the table: the steps that say so") {
    // A tree of all facets, one edge table of all polygons, and polygons one by one.
    struct Subject {
      std::string method;
      const char* mesh;
    };
    for (const Subject& subject :
         {Subject{"bsp", "teapot:6"}, Subject{"scan-line", "teapot:8"}, Subject{"z-buffer", "teapot:8"}}) {
      const std::string& name = subject.method;
      CAPTURE(name);
      ViewOptions view;
      view.width = 240, view.height = 180;
      const Trace trace = test::recorded_by(name, look_at_scene(load_scene(subject.mesh).scene, view));
      REQUIRE(trace.size() > 50000);
      std::map<std::int32_t, std::int64_t> viewed, made;
      trace.each(0, trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
        if (const auto* seen = get_if<ViewTransform>(&recorded.event)) viewed[seen->vertex] = step;
        if (const auto* split = get_if<SplitVertex>(&recorded.event)) made[split->vertex] = step;
        return true;
      });
      REQUIRE(viewed.size() >= trace.scene().points.size());
      CHECK(made.empty() == (name != "bsp"));
      Replay replay(trace);
      replay.go_to(trace.size());
      for (const auto& seen : viewed) {
        const std::int32_t vertex = seen.first;
        if (vertex % 23 != 0) continue;
        CAPTURE(vertex);
        const answers::VertexSteps steps =
            answers::steps_of_vertex(trace, replay.state().machine, trace.size(), vertex);
        CHECK(steps.viewed == seen.second);
        CHECK(holds<Projection>(trace.event(steps.projected.value()).event));
        CHECK(holds<ViewportTransform>(trace.event(steps.on_raster.value()).event));
        CHECK(steps.made.has_value() == made.contains(vertex));
        if (steps.made) CHECK(*steps.made == made[vertex]);
      }
      const MethodState& machine = replay.state().machine;
      for (std::size_t edge = 0; edge < machine.edge_table.size(); edge += 41) {
        CAPTURE(edge);
        const auto step = answers::step_of_edge(trace, machine, trace.size(), static_cast<std::int32_t>(edge));
        REQUIRE(step);
        const Event event = trace.event(*step).event;
        const auto* entry = get_if<EdgeTableInsert>(&event);
        REQUIRE(entry);
        CHECK(entry->edge == static_cast<std::int32_t>(edge));
        CHECK(entry->vertex_0 == machine.edge_table[edge].vertex_0);
      }
    }
  }
}
