// How long a frame takes, and how long one waits: the software renderer at 1600x900.
//
//     zstep_bench_viewer        prints medians; exits with 1 when a 64x64 frame takes more than 16 ms, or 33 ms at
//                               3840x2160
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/stage.hpp"
#include "traces/record/trace_recorder.hpp"

namespace {

using namespace zstep;
using namespace zstep::viewer;

constexpr int width = 1600, height = 900;
constexpr double frame_budget_ms = 16, large_budget_ms = 33;

double milliseconds() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

std::vector<std::uint8_t> record(const std::string& name, std::int32_t w, std::int32_t h) {
  SceneFile file = load_scene(name);
  ViewOptions view;
  view.width = w;
  view.height = h;
  const Scene scene = look_at_scene(file.scene, view);
  const Method& z_buffer = method("z-buffer");
  TraceRecorder recorder(header_for(z_buffer, file.conventions), scene);
  z_buffer.record(scene, file.conventions, recorder);
  recorder.finish();
  return recorder.take_bytes();
}

/// One frame after each move; the move's time is part of it, as it is for a reader.
double median_frame(App& app, Unit unit, int frames) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) {
    const double begin = milliseconds();
    app.session().move(unit, 1);
    app.frame();
    times.push_back(milliseconds() - begin);
    if (app.session().position() == app.session().size()) app.session().go_to(app.session().size() / 3);
  }
  return median(times);
}

double report(const std::string& what, double ms) {
  fmt::print("{:<58} {:>9.2f} ms\n", what, ms);
  return ms;
}

void bench_large(const std::string& scene, std::int32_t w, std::int32_t h) {
  std::vector<std::uint8_t> bytes = record(scene, w, h);
  const double begin = milliseconds();
  const Trace trace = Trace::from_bytes(std::move(bytes), scene);
  App app(trace, nullptr, {}, width, height);
  app.frame();
  const std::string name = fmt::format("{} {}x{}, {} events", scene, w, h, trace.size());
  report(name + ": open and draw", milliseconds() - begin);
  for (const double share : {1.0, 0.5, 0.999, 0.01}) {
    const double seek = milliseconds();
    app.session().go_to(static_cast<std::int64_t>(share * static_cast<double>(trace.size())));
    app.frame();
    report(fmt::format("  seek to {:.1f} % and draw", share * 100), milliseconds() - seek);
  }
  app.session().go_to(trace.size() / 2);
  app.frame();
  for (const Unit unit : {Unit::event, Unit::pixel, Unit::scan_line, Unit::polygon})
    report(fmt::format("  next {}, median frame", unit_word(unit)), median_frame(app, unit, 60));
  std::vector<double> back;
  for (int i = 0; i < 60; ++i) {
    const double start = milliseconds();
    app.session().move(Unit::event, -1);
    app.frame();
    back.push_back(milliseconds() - start);
  }
  report("  previous step, median frame", median(back));
}

/// From a change to its picture, as when a hand pulls a vertex; both in turn, so that each makes another run.
void bench_changes(const std::string& scene, int changes) {
  const Trace trace = Trace::from_bytes(record(scene, 64, 64), scene);
  ViewerOptions options;
  options.run_changed = [](const Trace& opened, const std::string& id, const std::vector<Change>& made) {
    Scene changed = opened.scene();
    Conventions conventions = opened.header().conventions;
    for (const Change& change : made) make_change(method(id), change, changed, conventions);
    TraceRecorder recorder(header_for(method(id), conventions), changed);
    method(id).record(changed, conventions, recorder);
    recorder.finish();
    return OtherRun{Trace::from_bytes(recorder.take_bytes(), changed.name), true};
  };
  Stage stage(trace, options, Settings{}, width, height);
  stage.app().session().go_to(trace.size() / 2);
  stage.app().open_what_if();
  stage.app().settle();
  const glm::dvec3 point = trace.scene().points[0];
  std::vector<double> times;
  for (int k = 0; k < changes; ++k) {
    const double begin = milliseconds();
    stage.change({"vertex 0", fmt::format("{} {} {}", point.x + 0.01 * (k % 2), point.y, point.z)}, k > 0);
    stage.app().frame();
    times.push_back(milliseconds() - begin);
  }
  report(fmt::format("{} 64x64 at 1600x900: a change to its picture, median", scene), median(times));
}

}  // namespace

int main() {
  bench_changes("pyramid-behind", 60);
  bench_changes("pyramid", 60);
  const Trace trace = Trace::from_bytes(record("pyramid-behind", 64, 64), "pyramid-behind");
  App app(trace, nullptr, {}, width, height);
  app.session().go_to(trace.size() / 3);
  app.settle();
  const double step = report("64x64 trace at 1600x900: next step, median frame", median_frame(app, Unit::event, 300));
  report("64x64 trace at 1600x900: next scan line, median frame", median_frame(app, Unit::scan_line, 60));
  std::vector<double> still;
  for (int i = 0; i < 100; ++i) {
    const double begin = milliseconds();
    app.frame();
    still.push_back(milliseconds() - begin);
  }
  report("64x64 trace at 1600x900: same step again, median frame", median(still));
  bench_large("teapot", 640, 480);
  bench_large("teapot:16", 1024, 768);
  App large(trace, nullptr, {}, 3840, 2160);
  large.session().go_to(trace.size() / 3);
  large.settle();
  const double step_large =
      report("64x64 trace at 3840x2160: next step, median frame", median_frame(large, Unit::event, 100));
  report("64x64 trace at 3840x2160: next polygon, median frame", median_frame(large, Unit::polygon, 30));
  if (step > frame_budget_ms || step_large > large_budget_ms) {
    fmt::print("a frame takes more than {} ms, or {} ms at 3840x2160\n", frame_budget_ms, large_budget_ms);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
