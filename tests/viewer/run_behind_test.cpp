// A large run is made anew while the window goes on.
#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "sim/viewer/stage.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

struct EndedEarly {};

std::vector<std::uint8_t> recorded(const Scene& scene, const Conventions& conventions, const RunWatch& watch) {
  const Method& by = method("z-buffer");
  TraceRecorder recorder(header_for(by, conventions), scene);
  recorder.on_block([&](std::int64_t steps) {
    if (watch && !watch(steps)) throw EndedEarly{};
  });
  by.record(scene, conventions, recorder);
  recorder.on_block(nullptr);
  recorder.finish();
  return recorder.take_bytes();
}

Trace large_run() {
  const Scene scene = look_at_scene(load_scene("teapot").scene, [] {
    ViewOptions view;
    view.width = 800, view.height = 600;
    return view;
  }());
  return Trace::from_bytes(recorded(scene, Conventions{}, nullptr), "teapot");
}

OtherRun made_anew(const Trace& opened, const std::string& id, const std::vector<Change>& changes,
                   const RunWatch& watch) {
  Scene scene = opened.scene();
  Conventions conventions = opened.header().conventions;
  for (const Change& change : changes) make_change(method(id), change, scene, conventions, "");
  check_run(method(id), scene, conventions);
  return {Trace::from_bytes(recorded(scene, conventions, watch), scene.name), true};
}
OtherRun made_at_once(const Trace& opened, const std::string& id, const std::vector<Change>& changes) {
  return made_anew(opened, id, changes, nullptr);
}

ViewerOptions changing_at_once() {
  ViewerOptions options;
  options.run_changed = made_at_once;
  options.run_watched = [](const Trace& opened, const std::string& id, const std::vector<Change>& changes,
                           const RunWatch& watch) {
    try {
      return made_anew(opened, id, changes, watch);
    } catch (const EndedEarly&) {
      return OtherRun{test::record_run("cube"), false};
    }
  };
  return options;
}

/// Turns until the run is there; how many turns that took.
int wait_for(Stage& stage) {
  int turns = 0;
  for (; stage.app().waits_for_run && turns < 6000; ++turns) {
    stage.look_for_run();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  REQUIRE_FALSE(stage.app().waits_for_run);
  return turns;
}

}  // namespace

TEST_CASE("a large run is made anew behind the window, which goes on, and ends the same as made at once") {
  const Trace trace = large_run();
  REQUIRE(trace.size() > 400'000);
  const ViewerOptions options = changing_at_once();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(1000);
  stage.change({"theta", "70"}, false);
  CHECK(stage.app().waits_for_run);
  CHECK(stage.changes().empty());
  CHECK(&stage.trace() == &trace);
  // The window goes on.
  stage.app().move(Unit::event, 1);
  CHECK(stage.app().session().position() == 1001);
  (void)test::picture(stage.app());
  wait_for(stage);
  CHECK(stage.changes() == std::vector<Change>{{"theta", "70"}});
  const OtherRun at_once = made_at_once(trace, "z-buffer", stage.changes());
  REQUIRE(at_once.whole);
  CHECK(stage.trace().size() == at_once.trace.size());
  Replay behind(stage.trace()), once(at_once.trace);
  behind.go_to(stage.trace().size()), once.go_to(at_once.trace.size());
  CHECK(behind.state().picture.polygon == once.state().picture.polygon);
  CHECK(behind.state().picture.depth == once.state().picture.depth);
  // Many pixels changed; what marks them is no more than can be drawn at once, and than can be seen through.
  REQUIRE(stage.app().changed().pixels.size() > 20'000);
  (void)test::picture(stage.app());
  CHECK(ImGui::GetDrawData()->TotalVtxCount < 150'000);
}

TEST_CASE("changes made while a run is being made are made together, and Esc leaves all as it was") {
  const Trace trace = large_run();
  const ViewerOptions options = changing_at_once();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.change({"theta", "70"}, false);
  stage.change({"phi", "50"}, false);
  wait_for(stage);
  CHECK(stage.changes() == std::vector<Change>{{"theta", "70"}, {"phi", "50"}});
  stage.undo(1);
  CHECK(stage.changes().size() == 2);  // until it is made
  wait_for(stage);
  CHECK(stage.changes() == std::vector<Change>{{"theta", "70"}});
  stage.undo(-1);
  wait_for(stage);
  CHECK(stage.changes() == std::vector<Change>{{"theta", "70"}, {"phi", "50"}});

  stage.change({"rho", "9"}, false);
  REQUIRE(stage.app().waits_for_run);
  test::press(stage.app(), SDLK_ESCAPE);
  REQUIRE(stage.app().requests.end_run);
  stage.end_run();
  CHECK_FALSE(stage.app().waits_for_run);
  CHECK(stage.changes() == std::vector<Change>{{"theta", "70"}, {"phi", "50"}});
  // What cannot be run says so, and nothing is lost.
  stage.change({"rho", "-1"}, false);
  wait_for(stage);
  CHECK(stage.changes().size() == 2);
  // A stage that goes while a run is being made ends it.
  stage.change({"rho", "9"}, false);
  REQUIRE(stage.app().waits_for_run);
}
