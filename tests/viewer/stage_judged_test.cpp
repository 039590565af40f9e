// A run is checked in the window, and compared with another.
#include <utility>

#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "sim/viewer/stage.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/made_anew.hpp"
#include "tests/viewer/with_mistake.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

ViewerOptions with_runs() {
  ViewerOptions options;
  options.run_changed = test::made_anew;
  options.open = [](const Trace&, const Offer& offer) {
    if (offer.id == "small") {
      Scene scene = test::record_run("pyramid").scene();
      scene.raster.width = scene.raster.height = 8;
      TraceRecorder recorder(header_for(method("z-buffer"), {}), scene);
      method("z-buffer").record(scene, {}, recorder);
      recorder.finish();
      return std::make_unique<Opened>(Opened{Trace::from_bytes(recorder.take_bytes(), "small")});
    }
    if (offer.id != "pyramid") throw InputError(offer.id, "there is no such file", "give the path of one");
    return std::make_unique<Opened>(Opened{test::record_run("pyramid")});
  };
  return options;
}

constexpr const char* right_compare = "\"nearer\":true";
constexpr const char* wrong_compare = "\"nearer\":false";

}  // namespace

TEST_CASE("Ctrl+K checks the run: it marks what is wrong and goes to the first cause, or says that nothing is") {
  const Trace right = test::record_run("pyramid");
  const Trace wrong = test::with_mistake(right, right_compare, wrong_compare);
  const ViewerOptions options = with_runs();
  {
    Stage stage(right, options, Settings{}, 1280, 720);
    test::press(stage.app(), SDLK_k, KMOD_LCTRL);
    stage.serve();
    CHECK(stage.app().session().message.find("Nothing is wrong") == 0);
    CHECK(stage.app().session().position() == 0);
  }
  Stage stage(wrong, options, Settings{}, 1280, 720);
  App& app = stage.app();
  const CheckReport report = check(wrong);
  REQUIRE(report.causes.size() >= 1);
  const test::Bytes before = test::picture(app);
  test::press(app, SDLK_k, KMOD_LCTRL);
  stage.serve();
  CHECK(app.session().position() == report.causes.front().first.step);
  CHECK(app.session().message.find("to mend") != std::string::npos);
  REQUIRE(app.ui().findings != nullptr);
  CHECK(app.ui().findings->checked().report.causes.size() == report.causes.size());
  // As the command opens it: the picture is the same.
  const CheckedRun judged = judge_run(wrong, nullptr, true);
  App opened(wrong, nullptr, Settings{}, 1280, 720);
  opened.allow_changes(options.run_changed);
  opened.offer(options.offers);
  opened.show_findings(judged);
  opened.session().go_to(report.causes.front().first.step);
  app.session().message.clear();
  CHECK(test::picture(app) == test::picture(opened));
  // Again: the same place, from anywhere.
  app.session().go_to(0);
  test::press(app, SDLK_k, KMOD_LCTRL);
  stage.serve();
  CHECK(app.session().position() == report.causes.front().first.step);
}

TEST_CASE("Ctrl+D compares the run with zstep's own, with another that can be opened, and puts it away again") {
  const Trace right = test::record_run("pyramid");
  const Trace wrong = test::with_mistake(right, right_compare, wrong_compare);
  const ViewerOptions options = with_runs();
  Stage stage(wrong, options, Settings{}, 1280, 720);
  App& app = stage.app();
  const test::Bytes alone = test::picture(app);
  for (const char* with : {"", "pyramid"}) {
    CAPTURE(with);
    test::press(app, SDLK_d, KMOD_LCTRL);
    REQUIRE(app.drawer() == Drawer::compare);
    test::type(app, with);
    test::press(app, SDLK_RETURN);
    stage.serve();
    CHECK(app.drawer() == Drawer::none);
    REQUIRE(app.compares());
    const diff::DiffReport report = diff::compare(wrong, right);
    REQUIRE(!report.causes.empty());
    // As the command opens it.
    const AgainstRun both{&right, &report, true};
    App opened(wrong, nullptr, Settings{}, 1280, 720);
    opened.allow_changes(options.run_changed);
    opened.offer(options.offers);
    opened.show_against(both);
    opened.to_first_cause();
    CHECK(app.session().position() == opened.session().position());
    CHECK(app.session().position() > 0);
    app.session().message.clear();
    CHECK(test::picture(app) == test::picture(opened));
    test::press(app, SDLK_d, KMOD_LCTRL);
    CHECK_FALSE(app.compares());
    app.session().go_to(0);
    app.session().message.clear();
    CHECK(test::picture(app) == alone);
  }
}

TEST_CASE("what a run cannot be compared with is said in the drawer, and what was typed stays") {
  const Trace right = test::record_run("pyramid");
  const ViewerOptions options = with_runs();
  Stage stage(right, options, Settings{}, 1280, 720);
  App& app = stage.app();
  test::press(app, SDLK_d, KMOD_LCTRL);
  test::type(app, "no such");
  test::press(app, SDLK_RETURN);
  stage.serve();
  CHECK(app.drawer() == Drawer::compare);
  CHECK(app.typed == "no such");
  CHECK(app.wrong.find("there is no such file") != std::string::npos);
  CHECK_FALSE(app.compares());
  app.put("small");
  test::press(app, SDLK_RETURN);
  stage.serve();
  CHECK(app.wrong == "That run has 8x8 pixels, and this one 32x32; record both with one size.");
  // A file that is dropped meanwhile is meant for the drawer; else it is opened.
  app.take_file("pyramid");
  stage.serve();
  CHECK(app.compares());
  CHECK_FALSE(app.requests.open);
  app.take_file("pyramid");
  REQUIRE(app.requests.open);
  CHECK(app.requests.open->id == "pyramid");
}

TEST_CASE("who ends a check or a comparison is left where they were, and nothing is marked") {
  const Trace right = test::record_run("pyramid");
  const Trace wrong = test::with_mistake(right, right_compare, wrong_compare);
  const ViewerOptions options = with_runs();
  Stage stage(wrong, options, Settings{}, 1280, 720);
  App& app = stage.app();
  app.session().go_to(100);
  app.session().on_way = [](double) { return true; };
  stage.check();
  CHECK(app.ui().findings == nullptr);
  stage.compare_with("");
  CHECK_FALSE(app.compares());
  CHECK(app.wrong == "Comparing was ended.");
  CHECK(app.session().position() == 100);
}
