// How long a frame takes, and how long one waits: the software renderer at 1600x900.
//
//     zstep_bench_viewer        prints medians; exits with 1 when a 64x64 frame takes more than 16 ms, or 33 ms at
//                               3840x2160
//     zstep_bench_viewer drags  what a hand turns, and steps of other methods, at 1600x900 and 3840x2160
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/stage.hpp"
#include "tests/viewer/made_anew.hpp"
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

std::vector<std::uint8_t> record(const std::string& name, std::int32_t w, std::int32_t h, const char* by = "z-buffer") {
  SceneFile file = load_scene(name);
  ViewOptions view;
  view.width = w;
  view.height = h;
  const Scene scene = look_at_scene(file.scene, view);
  const Method& used = method(by);
  TraceRecorder recorder(header_for(used, file.conventions), scene);
  used.record(scene, file.conventions, recorder);
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
  fmt::print("| {} | {:.2f} |\n", what, ms);
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
    report(name + fmt::format(": seek to {:.1f} % and draw", share * 100), milliseconds() - seek);
  }
  app.session().go_to(trace.size() / 2);
  app.frame();
  for (const Unit unit : {Unit::event, Unit::pixel, Unit::scan_line, Unit::polygon})
    report(name + fmt::format(": next {}, median frame", unit_word(unit)), median_frame(app, unit, 60));
  std::vector<double> back;
  for (int i = 0; i < 60; ++i) {
    const double start = milliseconds();
    app.session().move(Unit::event, -1);
    app.frame();
    back.push_back(milliseconds() - start);
  }
  report(name + ": previous step, median frame", median(back));
}

/// From a change to its picture, as when a hand pulls a vertex; both in turn, so that each makes another run.
void bench_changes(const std::string& scene, int changes) {
  const Trace trace = Trace::from_bytes(record(scene, 64, 64), scene);
  ViewerOptions options;
  options.run_changed = test::made_anew;
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

/// One frame after each part of a drag that turns what is seen.
double median_drag(App& app, Look Ui::*look, int frames) {
  std::vector<double> times;
  for (int k = 0; k < frames; ++k) {
    (app.ui().*look).turn += 2;
    (app.ui().*look).tilt = 5 * std::sin(0.1 * k);
    const double begin = milliseconds();
    app.frame();
    times.push_back(milliseconds() - begin);
  }
  return median(times);
}

/// What a hand turns, as large as it gets without a lesson: the scene from outside and the relief of the depths.
void bench_drags(const std::string& scene, int w, int h) {
  const Trace trace = Trace::from_bytes(record(scene, 64, 64), scene);
  App app(trace, nullptr, {}, w, h);
  app.session().go_to(trace.size());
  const std::string name = fmt::format("{} 64x64 at {}x{}: ", scene, w, h);
  app.set_lead("scene");
  app.ui().from_outside = true;
  app.settle();
  report(name + "the scene turned, median frame", median_drag(app, &Ui::look, 60));
  app.set_lead("depth");
  app.ui().relief = true;
  app.settle();
  report(name + "the relief turned, median frame", median_drag(app, &Ui::relief_look, 60));
}

/// Frames of methods' own workspaces.
void bench_steps(const char* by, const std::string& scene, int w, int h) {
  const Trace trace = Trace::from_bytes(record(scene, 64, 64, by), scene);
  App app(trace, nullptr, {}, w, h);
  app.session().go_to(trace.size() / 3);
  app.settle();
  report(fmt::format("{} of {} at {}x{}: next step, median frame", by, scene, w, h),
         median_frame(app, Unit::event, 60));
}

}  // namespace

int main(int count, char** arguments) {
  fmt::print("| | ms |\n|---|---|\n");
  if (count > 1 && std::string(arguments[1]) == "drags") {
    for (const auto& [w, h] : {std::pair{1600, 900}, {3840, 2160}}) {
      bench_drags("pyramid-behind", w, h);
      bench_drags("teapot", w, h);
      for (const char* by : {"z-buffer", "bsp", "warnock", "ray-casting"}) bench_steps(by, "pyramid-behind", w, h);
    }
    return EXIT_SUCCESS;
  }
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
    fmt::print(stderr, "a frame takes more than {} ms, or {} ms at 3840x2160\n", frame_budget_ms, large_budget_ms);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
