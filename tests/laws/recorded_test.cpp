// What a trace tells is what the run did: every event, to the bit, whatever the codec guessed.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/traces/some_trace.hpp"

using namespace zstep;

namespace {

struct Subject {
  const char* mesh;
  int width, height;
  bool cull;
  double window;  ///< so small that much is clipped; 0: all is seen
};

/// The first event that the trace tells otherwise; empty where it tells all of them as they were.
std::string told_otherwise(const Trace& trace, const std::vector<CollectedEvent>& events) {
  std::string difference;
  std::size_t told = 0;
  trace.each(0, trace.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    const bool same =
        told < events.size() && events[told].step == recorded.step && same_bits(events[told].event, recorded.event);
    ++told;
    if (!same) difference = "step " + std::to_string(position);
    return same;
  });
  if (difference.empty() && told != events.size())
    difference = std::to_string(told) + " steps of " + std::to_string(events.size());
  return difference;
}

}  // namespace

TEST_CASE(
    "law: a trace tells every step of its run to the bit, with many edges at once, clipped, and with both sides") {
  const auto check = [](const Method& m, const Subject& subject) {
    ViewOptions view;
    view.width = subject.width, view.height = subject.height;
    if (subject.window > 0) view.window = subject.window;
    Conventions conventions;
    conventions.cull = subject.cull;
    const Scene scene = look_at_scene(load_scene(subject.mesh).scene, view);
    const std::string name(m.id), mesh = subject.mesh;
    CAPTURE(name);
    CAPTURE(mesh);
    CAPTURE(subject.width);
    CAPTURE(subject.cull);
    CollectRecorder collected;
    m.collect(scene, conventions, collected);
    try {
      CHECK(told_otherwise(test::recorded_by(name, scene, conventions), collected.events) == "");
    } catch (const InputError& error) {
      FAIL_CHECK(error.what());
    }
  };
  for (const Method& m : methods()) {
    if (m.needs != Needs::polygons) continue;
    for (const Subject& subject : {Subject{"teapot:4", 8, 6, false, 0}, Subject{"teapot:2", 24, 18, true, 0},
                                   Subject{"teapot:2", 20, 15, false, 0.2}})
      check(m, subject);
  }
  for (const char* name : {"z-buffer", "scan-line", "depth-sort", "warnock"})
    check(method(name), {"teapot:8", 48, 36, true, 0});
}
