// Prints what judging a run costs: reading JSON Lines, check, diff against decoding alone, and exact depths. Medians of
// runs that take turns, all in one process, as one table in Markdown; seconds are the processor's.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/bench/crowds.hpp"
#include "tests/bench/seconds.hpp"
#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;

namespace {

Trace recorded(const Scene& scene, const char* by) {
  const Method& taught = method(by);
  TraceRecorder recorder(header_for(taught, {}), scene);
  taught.record(scene, {}, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), scene.name);
}
Trace recorded(const char* scene, int width, int height, const char* by = "z-buffer") {
  ViewOptions view;
  view.width = width, view.height = height;
  return recorded(look_at_scene(load_scene(scene).scene, view), by);
}

/// The same steps under another title, which a reader cannot tell from other steps by their bytes; without the step at
/// `missing`, if that is not 0.
Trace once_more(const Trace& trace, std::int64_t missing) {
  Header header = trace.header();
  header.title = "once more";
  TraceRecorder recorder(header, trace.scene());
  trace.each(0, trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
    if (step != missing) record_any(recorder, recorded.step, recorded.event);
    return true;
  });
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), header.title);
}

std::int64_t decode(const Trace& trace) {
  std::int64_t steps = 0;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    steps += recorded.step != step_limit;
    return true;
  });
  return steps;
}

}  // namespace

int main() {
  const Trace run = recorded("teapot:4", 800, 600), same = recorded("teapot:4", 800, 600);
  const Trace other_bytes = once_more(run, 0), shorter = once_more(run, run.size() / 2);
  std::ostringstream out;
  write_jsonl(run, out);
  const std::string lines = out.str();
  const auto steps = static_cast<double>(run.size());

  struct Work {
    const char* name;
    std::vector<double> seconds;
  };
  Work reading{"JSON Lines", {}}, checking{"check", {}}, decoding{"decoding two traces", {}},
      comparing{"diff of two equal traces", {}}, comparing_steps{"diff of equal steps in other bytes", {}},
      missing{"diff where one step is missing", {}}, exact{"exact depths", {}};
  std::int64_t depths = 0;
  for (int turn = 0; turn < 7; ++turn) {
    reading.seconds.push_back(processor_seconds_of([&] {
      std::istringstream in(lines);
      Scene kept;  // a recorder looks at it as long as it lives
      std::optional<TraceRecorder> recorder;
      read_jsonl(in, "run.jsonl", [&](const Header& header, Scene scene) -> TraceRecorder& {
        kept = std::move(scene);
        return recorder.emplace(header, kept);
      });
      recorder->finish();
    }));
    checking.seconds.push_back(processor_seconds_of([&] { check(run); }));
    decoding.seconds.push_back(processor_seconds_of([&] { decode(run), decode(same); }));
    comparing.seconds.push_back(processor_seconds_of([&] { diff::compare(run, same); }));
    comparing_steps.seconds.push_back(processor_seconds_of([&] { diff::compare(run, other_bytes); }));
    missing.seconds.push_back(processor_seconds_of([&] { diff::compare(run, shorter); }));
    exact.seconds.push_back(processor_seconds_of([&] { depths = oracle::errors_of(run).all.depths; }));
  }
  const auto median = [](Work& work) {
    std::sort(work.seconds.begin(), work.seconds.end());
    return work.seconds[work.seconds.size() / 2];
  };
  fmt::print("| | seconds | |\n|---|---|---|\n");
  fmt::print("| {} | {:.3f} | {:.0f} MB/s |\n", reading.name, median(reading),
             static_cast<double>(lines.size()) / 1e6 / median(reading));
  fmt::print("| {} | {:.3f} | {:.1f} million steps/s |\n", checking.name, median(checking),
             steps / 1e6 / median(checking));
  for (Work* diff : {&comparing, &comparing_steps, &missing})
    fmt::print("| {} | {:.3f} | {:.2f} times decoding both |\n", diff->name, median(*diff),
               median(*diff) / median(decoding));
  fmt::print("| {} | {:.3f} | {:.0f} depths/s |\n", exact.name, median(exact),
             static_cast<double>(depths) / median(exact));

  const auto check_once = [&](const char* name, const Trace& large) {
    const double seconds = processor_seconds_of([&] { check(large); });
    const double millions = static_cast<double>(large.size()) / 1e6;
    fmt::print("| check of {}, {:.1f} million steps | {:.1f} | {:.1f} million steps/s |\n", name, millions, seconds,
               millions / seconds);
  };
  check_once("ray casting", recorded("teapot:8", 160, 120, "ray-casting"));
  check_once("half-space", recorded(bench::crowd(bench::teapot(4), 24, 1024, 768), "half-space"));
  fmt::print("\n{} steps, {:.1f} MB of JSON Lines, {} depths.\n", run.size(), static_cast<double>(lines.size()) / 1e6,
             depths);
}
