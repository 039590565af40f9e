// The start page: what it offers, and that opening something else leaves the place in what was open.
#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>
#include <unistd.h>

#include "sim/viewer/settings.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/viewer/start_overlay.hpp"
#include "tests/folder.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;
namespace fs = std::filesystem;

namespace {

ViewerOptions with_offers(int* asked = nullptr) {
  ViewerOptions options;
  options.offers = [asked] {
    if (asked) ++*asked;
    std::vector<Offer> offers;
    int number = 0;
    for (const Lesson& lesson : all_lessons())
      offers.push_back({Offer::What::lesson, lesson.id, lesson.title, lesson.summary,
                        static_cast<int>(lesson.stops.size()), ++number});
    offers.push_back({Offer::What::method, "painter", "Painter's algorithm", "far to near"});
    offers.push_back({Offer::What::scene, "cube", "cube", "a cube", 0, 0, {2, 1, {255, 0, 0, 0, 0, 255}}});
    return offers;
  };
  options.open = [](const Trace&, const Offer& offer) {
    if (offer.what == Offer::What::lesson) {
      Lesson lesson = find_lesson(offer.id);
      Trace trace = run_lesson(lesson);
      return std::make_unique<Opened>(Opened{std::move(trace), std::move(lesson), {"lesson", offer.id}, {}});
    }
    if (offer.id != "cube") throw InputError(offer.id, "there is no such file", "give the path of one");
    return std::make_unique<Opened>(Opened{test::record_run("cube"), {}, {"view", "cube"}, "By the Z-buffer."});
  };
  return options;
}

std::string picked_id(App& app) { return app.choices().at(static_cast<std::size_t>(app.picked))->id; }

}  // namespace

TEST_CASE("the start page is asked for what it offers once, and finds it by a part of its name") {
  const Trace trace = test::record_run("pyramid");
  int asked = 0;
  const ViewerOptions options = with_offers(&asked);
  Stage stage(trace, options, Settings{}, 1280, 720);
  App& app = stage.app();
  CHECK(asked == 0);
  test::press(app, SDLK_o, KMOD_LCTRL);
  REQUIRE(app.overlay() == Overlay::start);
  const test::Bytes all = test::picture(app);
  CHECK(app.choices().size() == all_lessons().size() + 2);
  test::type(app, "Warn");
  REQUIRE(app.choices().size() == 1);
  CHECK(app.choices()[0]->id == "warnock");
  CHECK(app.choices()[0]->number == 10);  // as among all
  CHECK(test::picture(app) != all);
  for (int k = 0; k < 4; ++k) test::press(app, SDLK_BACKSPACE), test::release(app, SDLK_BACKSPACE);
  CHECK(app.choices().size() == all_lessons().size() + 2);
  CHECK(asked == 1);
}

TEST_CASE("a lesson is opened from the start page, by keys alone, and how far it was read is kept") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = with_offers();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(100);
  test::press(stage.app(), SDLK_o, KMOD_LCTRL);
  for (int k = 0; k < 3; ++k) test::press(stage.app(), SDLK_DOWN);
  CHECK(picked_id(stage.app()) == "z-buffer");
  test::press(stage.app(), SDLK_RETURN);
  stage.serve();
  REQUIRE(stage.app().session().lesson());
  CHECK(stage.app().session().lesson()->id == "z-buffer");
  CHECK(stage.app().overlay() == Overlay::none);
  CHECK(stage.app().session().stop() == 0);
  CHECK(stage.app().command_line().rfind("zstep lesson z-buffer --at ", 0) == 0);
  test::press(stage.app(), SDLK_n);
  (void)test::picture(stage.app());
  CHECK(stage.app().settings().stops_seen("z-buffer") == 2);
  CHECK(stage.app().settings().place(place_key(trace)) == 100);
  // What was open last is picked.
  test::press(stage.app(), SDLK_o, KMOD_LCTRL);
  CHECK(picked_id(stage.app()) == "z-buffer");
  // The next column, and the one after it.
  test::press(stage.app(), SDLK_TAB);
  CHECK(picked_id(stage.app()) == "painter");
  test::press(stage.app(), SDLK_TAB);
  CHECK(picked_id(stage.app()) == "cube");
  const std::int64_t left_at = stage.app().session().position();
  const std::string left = place_key(stage.trace());
  test::press(stage.app(), SDLK_RETURN);
  stage.serve();
  CHECK_FALSE(stage.app().session().lesson());
  CHECK(stage.trace().scene().name == "cube");
  CHECK(stage.app().settings().place(left) == left_at);
  CHECK(stage.app().session().message == "By the Z-buffer.");
  (void)test::picture(stage.app());
}

TEST_CASE("what cannot be opened is said on the start page, and all stays as it is") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = with_offers();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(7);
  test::press(stage.app(), SDLK_o, KMOD_LCTRL);
  test::type(stage.app(), "none.obj");
  REQUIRE(stage.app().choices().size() == 1);
  test::press(stage.app(), SDLK_RETURN);
  stage.serve();
  CHECK(stage.app().overlay() == Overlay::start);
  CHECK(stage.app().wrong.find("there is no such file") != std::string::npos);
  CHECK(stage.app().typed == "none.obj");
  CHECK(&stage.trace() == &trace);
  CHECK(stage.app().session().position() == 7);
  // A file that is dropped, too.
  test::press(stage.app(), SDLK_ESCAPE);
  SDL_Event drop{};
  drop.type = SDL_DROPFILE;
  drop.drop.file = SDL_strdup("gone.off");
  test::send(stage.app(), drop);
  stage.serve();
  CHECK(stage.app().overlay() == Overlay::start);
  CHECK(stage.app().wrong.find("gone.off") != std::string::npos);
}

TEST_CASE("settings keep how far lessons were read, and which was open last") {
  Settings s;
  s.see_stop("bsp", 3);
  s.see_stop("warnock", 9);
  s.see_stop("bsp", 1);
  CHECK(s.stops_seen("bsp") == 3);
  CHECK(s.stops_seen("warnock") == 9);
  CHECK(s.stops_seen("none") == 0);
  CHECK(s.lessons.back().first == "bsp");
}

TEST_CASE("before a class a clicker's four keys are enough: choose a lesson, go from stop to stop, black window") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = with_offers();
  Settings settings;  // as they are at first; the lesson was read to its end at home
  Lesson read = find_lesson("z-buffer");
  settings.remember(place_key(run_lesson(read)), read.stops.back().position);
  settings.see_stop("viewing", 1);
  for (const SDL_Keycode slip : {SDLK_PERIOD, SDLK_b}) {  // the third key before the others
    Stage stage(trace, options, settings, 1280, 720);
    stage.app().open_start();
    test::press(stage.app(), slip);
    CHECK(stage.app().typed == (slip == SDLK_b ? "b" : "."));
    test::press(stage.app(), SDLK_PAGEDOWN);
    CHECK(stage.app().typed == "");
    CHECK(stage.app().choices().size() == all_lessons().size() + 2);
  }
  Stage stage(trace, options, settings, 1280, 720);
  stage.app().open_start();
  for (int k = 0; k < 2; ++k) test::press(stage.app(), SDLK_PAGEDOWN);
  test::press(stage.app(), SDLK_PAGEDOWN);
  test::press(stage.app(), SDLK_PERIOD);
  stage.serve();
  App& app = stage.app();
  REQUIRE(app.session().lesson());
  CHECK(app.session().lesson()->id == "z-buffer");
  CHECK(app.ui().presenter);
  // A question shows its answer first.
  for (std::size_t stop = 0; stop < app.session().lesson()->stops.size(); ++stop) {
    CHECK(app.session().stop() == static_cast<int>(stop));
    const bool asks = app.session().lesson()->stops[stop].question.has_value();
    CHECK(app.session().question_open() == asks);
    test::press(app, SDLK_PAGEDOWN);
    if (!asks) continue;
    CHECK(app.session().stop() == static_cast<int>(stop));
    CHECK_FALSE(app.session().question_open());
    test::press(app, SDLK_PAGEDOWN);
  }
  test::press(app, SDLK_PAGEUP);
  CHECK(app.session().stop() == static_cast<int>(app.session().lesson()->stops.size()) - 2);
  // Beyond the last stop, once that was said, the next lesson is chosen.
  test::press(app, SDLK_PAGEDOWN);
  test::press(app, SDLK_PAGEDOWN);
  CHECK(app.overlay() == Overlay::none);
  CHECK(app.session().message.find("last stop") != std::string::npos);
  test::press(app, SDLK_PAGEDOWN);
  CHECK(app.overlay() == Overlay::start);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.session().stop() == static_cast<int>(app.session().lesson()->stops.size()) - 1);
  app.session().message.clear();
  const test::Bytes shown = test::picture(app);
  for (const SDL_Keycode key : {SDLK_b, SDLK_PERIOD}) {
    test::press(app, key);
    test::release(app, key);
    const test::Bytes black = test::picture(app);
    CHECK(test::count_of(black, 0x000000) == 1280 * 720);
    test::press(app, key);
    test::release(app, key);
    CHECK(test::picture(app) == shown);
  }
}

TEST_CASE(
    "every method has a picture of its own on the start page, in light and dark, and what is no method has none") {
  CHECK_FALSE(has_emblem("sorting"));
  std::vector<Canvas> seen;
  for (const Method& one : methods())
    for (const Theme* theme : {&light_theme(), &dark_theme()}) {
      CAPTURE(one.id);
      CHECK(has_emblem(one.id));
      Canvas canvas, blank;
      canvas.resize(48, 36), blank.resize(48, 36);
      paint_emblem(canvas, std::string(one.id), *theme);
      paint_emblem(blank, "sorting", *theme);
      const auto pixels = [](const Canvas& of) { return std::vector<Pixel32>(of.row(0), of.row(0) + 48 * 36); };
      const std::vector<Pixel32> own = pixels(canvas), none = pixels(blank);
      int painted = 0;
      for (std::size_t k = 0; k < own.size(); ++k) painted += own[k] != none[k];
      CHECK(painted > 150);
      for (const Canvas& other : seen) CHECK(pixels(other) != own);
      seen.push_back(std::move(canvas));
    }
}

TEST_CASE("a file of the reader's that was opened is offered again as long as it is there, the last first") {
  const Trace trace = test::record_run("pyramid");
  const test::Folder folder;
  const std::string first = (folder / "first = 1.off").string(), second = (folder / "second.off").string();
  for (const std::string& path : {first, second}) std::ofstream(path) << "OFF";
  Settings settings;
  ViewerOptions options = with_offers();
  for (const std::string& path : {first, second, first}) {
    options.opened_by = {"view", path, "--algorithm", "bsp"};
    Stage stage(trace, options, settings, 1280, 720);
    settings = stage.app().settings();
  }
  CHECK(settings.files == std::vector<std::string>{second, first});
  CHECK(save_settings(folder / "viewer.ini", settings));
  settings = load_settings(folder / "viewer.ini");
  CHECK(settings.files == std::vector<std::string>{second, first});
  CHECK(progress_text(folder.path()).find("second.off") == std::string::npos);  // it stays on this computer
  fs::remove(second);
  options.opened_by = {"lesson", "z-buffer"};
  Stage stage(trace, options, settings, 1280, 720);
  test::press(stage.app(), SDLK_o, KMOD_LCTRL);
  test::type(stage.app(), "zstep-test");
  stage.app().settle();
  const std::vector<const Offer*> found = stage.app().choices();
  REQUIRE(found.size() >= 1);
  CHECK(found[0]->id == first);
  CHECK(std::none_of(found.begin(), found.end(), [&](const Offer* one) { return one->id == second; }));
}

TEST_CASE("a path that is typed is completed from its folder: folders lead on, files that can be opened are opened") {
  const Trace trace = test::record_run("pyramid");
  const test::Folder folder;
  for (const char* name : {"Ring.off", "ring.ztrace", "ring.txt", ".ring.off", "meshes/ring.ply"})
    folder.write(name, "x");
  ViewerOptions options = with_offers();
  Stage stage(trace, options, {}, 1280, 720);
  App& app = stage.app();
  const auto listed = [&](const std::string& typed) {
    test::press(app, SDLK_ESCAPE);
    test::press(app, SDLK_o, KMOD_LCTRL);
    test::type(app, typed);
    app.settle();
    std::vector<std::string> names;
    for (const Offer* offer : app.choices()) names.push_back(offer->title);
    return names;
  };
  const std::string at = folder.path().string() + "/";
  CHECK(listed(at) == std::vector<std::string>{"meshes/", "Ring.off", "ring.ztrace", "Open " + at});
  CHECK(listed(at + "r") == std::vector<std::string>{"Ring.off", "ring.ztrace", "Open " + at + "r"});
  CHECK(listed(at + ".r") == std::vector<std::string>{".ring.off", "Open " + at + ".r"});
  CHECK(listed(at + "ring.ztrace") == std::vector<std::string>{"ring.ztrace"});
  CHECK(listed(at + "nowhere/x") == std::vector<std::string>{"Open " + at + "nowhere/x"});
  CHECK(app.choices()[0]->theme.empty());
  // Through a folder to a file, by Enter alone.
  listed(at + "me");
  CHECK(app.choices()[0]->theme == "In " + folder.path().string());
  test::press(app, SDLK_RETURN);
  CHECK(app.typed == at + "meshes/");
  app.settle();
  CHECK_FALSE(app.requests.open);
  test::press(app, SDLK_RETURN);
  REQUIRE(app.requests.open);
  CHECK(app.requests.open->id == at + "meshes/ring.ply");
}
