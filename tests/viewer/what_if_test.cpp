// What if: the run is made anew with what was changed, at the same moment, and what differs is marked.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/save.hpp"
#include "sim/viewer/stage.hpp"
#include "tests/folder.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/made_anew.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

struct Run {
  Scene scene;
  Conventions conventions;
};
Run changed_run(const Trace& opened, const std::string& id, const std::vector<Change>& changes) {
  Run run{opened.scene(), id == opened.header().algorithm ? opened.header().conventions : Conventions{}};
  for (const Change& change : changes) make_change(method(id), change, run.scene, run.conventions, "");
  return run;
}

ViewerOptions changing_or_another_method() {
  ViewerOptions options;
  options.run_changed = test::made_anew;
  options.other_method = [](const Trace& trace, int) -> std::optional<OtherRun> {
    return test::made_anew(trace, "bsp", {});
  };
  return options;
}

void ask(Stage& stage, const std::string& text) {
  test::type(stage.app(), text);
  test::press(stage.app(), SDLK_RETURN);
  stage.serve();
  stage.app().settle();
}

Picture end_of(const Trace& trace) {
  Replay replay(trace);
  replay.go_to(trace.size());
  return replay.state().picture;
}

}  // namespace

TEST_CASE("what if: a change that is typed makes the run anew, at the same moment, and marks what ends otherwise") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(trace.size() / 2);
  const Whereabouts moment = moment_of(stage.app().session());
  REQUIRE(moment.cell);
  test::press(stage.app(), SDLK_e, KMOD_CTRL);
  REQUIRE(stage.app().drawer() == Drawer::what_if);
  ask(stage, "theta = 40");
  REQUIRE(stage.changes() == std::vector<Change>{{"theta", "40"}});
  CHECK(stage.trace().scene().camera.theta == 40);
  CHECK(stage.app().drawer() == Drawer::what_if);
  CHECK(stage.app().typed.empty());
  // The same polygon at the same pixel by the same line of the page, or else as near as the run has it, which is said.
  const MomentThere there = moment_in(stage.trace(), moment);
  CHECK(stage.app().session().position() == there.step);
  CHECK(stage.app().changed().told.find("Here: " + there.what + ".") != std::string::npos);
  CHECK(stage.app().session().current_cell() == moment.cell);

  const Picture was = end_of(trace), is = end_of(stage.trace());
  std::vector<std::int64_t> differ, marked;
  for (std::size_t at = 0; at < was.polygon.size(); ++at)
    if (was.polygon[at] != is.polygon[at]) differ.push_back(static_cast<std::int64_t>(at));
  for (const PixelMark& mark : stage.app().changed().pixels) marked.push_back(mark.pixel);
  CHECK(!differ.empty());
  CHECK(marked == differ);
  REQUIRE(stage.app().changed().made.size() == 1);
  CHECK(stage.app().changed().made[0].was == fmt::format("{}", trace.scene().camera.theta));
  CHECK(stage.app().changed().told.find(fmt::format("In the end {} pixels have another colour", differ.size())) == 0);
}

TEST_CASE("law: after any change the window shows what a run of the changed scene shows, and undo brings all back") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(trace.size());
  const test::Bytes at_first = test::picture(stage.app());
  std::vector<Change> made;
  const glm::dvec3 apex = trace.scene().points[0];
  for (const Change& change :
       {Change{"phi", "50"}, Change{"vertex 0", fmt::format("{} {} {}", apex.x + 3, apex.y, apex.z)},
        Change{"size", "30x20"}, Change{"coverage", "inclusive"}, Change{"cull", "off"},
        Change{"vertex 0", fmt::format("{} {} {}", apex.x, apex.y, apex.z)}}) {
    CAPTURE(change.name);
    stage.change(change, false);
    made.push_back(change);
    CHECK(stage.changes() == made);
    const Run run = changed_run(trace, "z-buffer", made);
    CHECK(stage.trace().scene() == run.scene);
    NullRecorder none;
    const Picture picture = method("z-buffer").render(run.scene, run.conventions, none);
    CHECK(end_of(stage.trace()).polygon == picture.polygon);
    CHECK(end_of(stage.trace()).depth == picture.depth);
    CHECK(!test::picture(stage.app()).empty());
  }
  for (std::size_t left = made.size(); left-- > 0;) {
    stage.undo(1);
    CHECK(stage.changes().size() == left);
  }
  CHECK(&stage.trace() == &trace);
  stage.app().show_changes({});
  stage.app().session().message.clear();
  CHECK(test::picture(stage.app()) == at_first);
  for (std::size_t again = 1; again <= made.size(); ++again) {
    stage.undo(-1);
    CHECK(stage.changes() == std::vector<Change>(made.begin(), made.begin() + static_cast<std::ptrdiff_t>(again)));
  }
  stage.undo(-1);
  CHECK(stage.app().session().message == "Nothing was taken back.");
}

TEST_CASE("what if: what cannot be is said where it was asked, and all stays as it was") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(100);
  test::press(stage.app(), SDLK_e, KMOD_CTRL);
  ask(stage, "theta = east");
  CHECK(stage.app().wrong.find("theta = east: east is no number for it") == 0);
  CHECK(stage.app().typed == "theta = east");
  CHECK(stage.changes().empty());
  CHECK(&stage.trace() == &trace);
  CHECK(stage.app().session().position() == 100);
  stage.undo(1);
  CHECK(stage.app().wrong == "Nothing is changed.");
  test::press(stage.app(), SDLK_e, KMOD_CTRL);
  CHECK(stage.app().drawer() == Drawer::none);
}

TEST_CASE("what if: buttons and Ctrl with an arrow change a little, and the next of some words") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  test::press(stage.app(), SDLK_e, KMOD_CTRL);
  test::type(stage.app(), "theta");
  const double theta = trace.scene().camera.theta;
  test::press(stage.app(), SDLK_UP, KMOD_CTRL);
  stage.serve();
  CHECK(stage.trace().scene().camera.theta == doctest::Approx(theta + 5).epsilon(0.1));
  CHECK(std::fmod(stage.trace().scene().camera.theta, 5) == 0);
  stage.app().put("coverage");
  stage.app().settle();
  test::press(stage.app(), SDLK_DOWN, KMOD_CTRL);
  stage.serve();
  CHECK(stage.trace().header().conventions.coverage == Conventions::Coverage::round_half_open);
}

TEST_CASE("what if: a vertex that is pulled in the scene moves with the hand, and is one change") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(trace.size());
  stage.app().set_lead("scene");
  test::press(stage.app(), SDLK_e, KMOD_CTRL);
  stage.app().settle();
  // Its handle is looked for on the stage.
  int x = 0, y = 0;
  for (int row = 60; row < 500 && x == 0; row += 6)
    for (int column = 300; column < 980 && x == 0; column += 6) {
      test::move_mouse(stage.app(), column, row);
      if (stage.app().ui().mouse_help == "Drag: moves vertex 0.") x = column, y = row;
    }
  REQUIRE(x > 0);
  SDL_Event button{};
  button.type = SDL_MOUSEBUTTONDOWN;
  button.button.button = SDL_BUTTON_LEFT;
  button.button.x = x, button.button.y = y;
  test::send(stage.app(), button);
  stage.app().frame();
  for (int k = 1; k <= 5; ++k) {
    SDL_Event motion{};
    motion.type = SDL_MOUSEMOTION;
    motion.motion.x = x + 6 * k, motion.motion.y = y - 4 * k;
    test::send(stage.app(), motion);
    stage.app().frame();
    stage.serve();
  }
  button.type = SDL_MOUSEBUTTONUP;
  test::send(stage.app(), button);
  stage.app().settle();
  REQUIRE(stage.changes().size() == 1);
  CHECK(stage.changes()[0].name == "vertex 0");
  const glm::dvec3 from = trace.scene().points[0], to = stage.trace().scene().points[0];
  CHECK(to != from);
  CHECK(to.z > from.z);  // upwards
  CHECK_FALSE(stage.app().ui().taken);
  stage.undo(1);
  CHECK(&stage.trace() == &trace);
}

TEST_CASE("what if: what was changed goes with the scene to another method") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().board().turn_clock(10);
  stage.change({"theta", "70"}, false);
  CHECK(stage.app().board().clock(75) == "1:05");  // the clock goes on, whatever is shown
  stage.switch_method(1);
  CHECK(stage.app().board().clock(75) == "1:05");
  CHECK(stage.trace().header().algorithm == "bsp");
  CHECK(stage.trace().scene().camera.theta == 70);
  stage.change({"phi", "40"}, false);
  CHECK(stage.trace().header().algorithm == "bsp");
  CHECK(stage.trace().scene().camera.theta == 70);
  CHECK(stage.trace().scene().camera.phi == 40);
  CHECK(stage.app().command_line().find("--change 'theta = 70' --change 'phi = 40'") != std::string::npos);
}

TEST_CASE("what if: another order of the polygons is no other colour") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  std::string back;
  for (std::size_t at = trace.scene().polygons.size(); at-- > 0;) back += *trace.scene().polygons[at].name + " ";
  stage.change({"polygons", back}, false);
  REQUIRE(stage.changes().size() == 1);
  CHECK(stage.app().changed().told.find("The picture ends the same") == 0);
}

TEST_CASE("what if: a lesson's task is asked in the drawer, with hints one at a time, and is seen to be done") {
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  ViewerOptions options = changing_or_another_method();
  options.lesson = &lesson;
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().to_stop(static_cast<int>(lesson.stops.size()) - 1);
  const Task* task = stage.app().task();
  REQUIRE(task);
  test::press(stage.app(), SDLK_e, KMOD_CTRL);
  REQUIRE(stage.app().drawer() == Drawer::what_if);
  CHECK_FALSE(stage.app().changed().task);
  ask(stage, "polygons = W A B C S D E");
  REQUIRE(stage.app().changed().task);
  CHECK_FALSE(stage.app().changed().task->done);
  CHECK(stage.app().changed().task->now == "224 depths are written.");
  CHECK(stage.app().task() == task);  // the lesson waits, and what it asks stays
  for (std::size_t hints = 1; hints <= task->hints.size(); ++hints) {
    test::press(stage.app(), SDLK_h, KMOD_CTRL);
    stage.serve();
    CHECK(stage.app().hints_given() == hints);
    CHECK(stage.changes().size() == 1);
  }
  test::press(stage.app(), SDLK_h, KMOD_CTRL);  // how it is done
  stage.serve();
  REQUIRE(stage.app().changed().task);
  CHECK(stage.app().changed().task->done);
  stage.undo(1);
  REQUIRE(stage.app().changed().task);
  CHECK_FALSE(stage.app().changed().task->done);
  stage.undo(1);
  CHECK(&stage.trace() == &trace);
  CHECK(stage.app().task() == task);
  stage.app().session().to_stop(0);
  CHECK(stage.app().task() == nullptr);
}

TEST_CASE("what if: a run that cannot be made anew says so") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_e, KMOD_CTRL);
  CHECK(app.drawer() == Drawer::none);
  CHECK(app.session().message == "This run cannot be changed from here.");
}

TEST_CASE("what if: the changed scene is saved beside what is there") {
  namespace fs = std::filesystem;
  const fs::path started = fs::current_path();
  const test::Folder folder;
  fs::current_path(folder.path());
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing_or_another_method();
  Stage stage(trace, options, Settings{}, 1280, 720);
  test::press(stage.app(), SDLK_e, KMOD_CTRL);
  ask(stage, "vertex 2 = 0 0 1.5");
  test::press(stage.app(), SDLK_s, KMOD_CTRL | KMOD_SHIFT);  // in the drawer
  CHECK(stage.app().saved_scene() == "Saved pyramid-changed.toml in the folder zstep was started in.");
  const SceneFile saved = load_scene("pyramid-changed.toml");
  CHECK(runs_alike(look_at_scene(saved.scene, {}), stage.trace().scene()));
  ask(stage, "theta = 41");
  CHECK(stage.app().saved_scene().empty());
  test::press(stage.app(), SDLK_ESCAPE);
  test::press(stage.app(), SDLK_s, KMOD_CTRL | KMOD_SHIFT);
  CHECK(stage.app().session().message == "Saved pyramid-changed-2.toml in the folder zstep was started in.");
  CHECK(load_scene("pyramid-changed.toml").scene.camera.theta == 30);
  CHECK(load_scene("pyramid-changed-2.toml").scene.camera.theta == 41);

  fs::current_path(started);
}
