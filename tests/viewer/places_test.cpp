// Run until, bookmarks and repeating, by keys.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

#include "tests/folder.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;
namespace fs = std::filesystem;

namespace {

/// Frames until a search is done; it draws while it goes on.
void wait(App& app) {
  for (int i = 0; app.places().searching() && i < 10'000; ++i) app.frame();
  CHECK_FALSE(app.places().searching());
}

struct TraceFile {
  test::Folder folder;
  fs::path file = folder / "run.ztrace";
  TraceFile() {
    const SceneFile scene_file = load_scene("delhi");
    const Scene scene = look_at_scene(scene_file.scene, {});
    TraceRecorder record(file, header_for(method("z-buffer"), scene_file.conventions), scene);
    method("z-buffer").record(scene, scene_file.conventions, record);
    record.finish();
  }
};

}  // namespace

TEST_CASE("U takes a condition and runs until it is true, J goes on, Shift goes back") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  const auto failed = [&] {
    const RecordedEvent* event = app.session().event();
    const auto* compare = event ? get_if<DepthCompare>(&event->event) : nullptr;
    return compare && !compare->nearer;
  };
  test::press(app, SDLK_j);
  CHECK(app.session().message.find("Press U") != std::string::npos);
  test::type(app, "u");  // the key's own letter is not typed
  REQUIRE(app.drawer() == Drawer::until);
  CHECK(app.typed.empty());
  test::type(app, "not nearr");
  test::press(app, SDLK_RETURN);
  CHECK(app.drawer() == Drawer::until);
  CHECK(app.wrong.find("did you mean `nearer`") != std::string::npos);
  app.settle();
  test::press(app, SDLK_BACKSPACE);
  test::type(app, "er");
  CHECK(app.wrong.empty());
  test::press(app, SDLK_RETURN);
  CHECK(app.drawer() == Drawer::none);
  wait(app);
  const std::int64_t first = app.session().position();
  CHECK(first > 0);
  CHECK(failed());
  test::press(app, SDLK_j);
  wait(app);
  CHECK(app.session().position() > first);
  CHECK(failed());
  test::press(app, SDLK_j, KMOD_LSHIFT);
  wait(app);
  CHECK(app.session().position() == first);
  test::press(app, SDLK_j, KMOD_LSHIFT);
  wait(app);
  CHECK(app.session().position() == first);
  CHECK(app.session().message.find("No earlier step") != std::string::npos);
  // Suggestions: what was asked before, and the pixel at work.
  test::press(app, SDLK_u);
  test::press(app, SDLK_DOWN);
  CHECK(app.typed == "not nearer");
  test::press(app, SDLK_DOWN);
  CHECK(app.typed.starts_with("changes("));
  test::press(app, SDLK_RETURN, KMOD_LSHIFT);
  wait(app);
  CHECK(app.session().position() < first);
  CHECK(holds<PixelWrite>(app.session().event()->event));
}

TEST_CASE("a long search draws on, Esc stops it, and so does going elsewhere") {
  const Trace trace = test::record_run("teapot:4", test::of_size(640, 480));
  App app(trace, nullptr, {}, 640, 480);
  const auto begin = [&] {
    app.places().run_until("z < 0 - 1000000 and x * x > 3 + y", Places::Way::forwards);
    return app.places().searching();
  };
  REQUIRE(trace.size() > 200'000);
  REQUIRE(begin());
  const test::Bytes before = (app.frame(), app.renderer().rgb());
  if (app.places().searching()) {
    CHECK(app.places().progress().find("Looking forwards") != std::string::npos);
    const double share = app.places().share();
    CHECK(share > 0);
    CHECK(share < 1);
    test::press(app, SDLK_ESCAPE);
    CHECK_FALSE(app.places().searching());
    CHECK(app.session().message.find("Stopped looking") != std::string::npos);
    CHECK(test::picture(app) != before);
  }
  if (begin()) {
    test::press(app, SDLK_RIGHT);
    app.frame();
    CHECK_FALSE(app.places().searching());
    CHECK(app.session().position() == 1);
  }
}

TEST_CASE("Ctrl+B keeps a bookmark beside the trace, L lists them, Delete removes one") {
  const TraceFile run;
  const fs::path marks = run.folder / "run.ztrace.marks";
  const Trace trace = Trace::open(run.file);
  {
    App app(trace, nullptr, {}, 1280, 720);
    const auto keep = [&](std::int64_t step, const std::string& name) {
      app.session().go_to(step);
      test::press(app, SDLK_b, KMOD_LCTRL);
      REQUIRE(app.drawer() == Drawer::name_bookmark);
      test::type(app, name);
      test::press(app, SDLK_RETURN);
    };
    keep(100, "here");
    CHECK(app.drawer() == Drawer::none);
    keep(50, "before");
    keep(60, "12");
    CHECK(app.drawer() == Drawer::name_bookmark);
    CHECK_FALSE(app.wrong.empty());
    test::press(app, SDLK_ESCAPE);
    app.session().go_to(0);
    const test::Bytes unmarked = test::picture(app);
    test::press(app, SDLK_l);
    REQUIRE(app.drawer() == Drawer::bookmarks);
    CHECK(test::picture(app) != unmarked);
    test::press(app, SDLK_DOWN);
    test::press(app, SDLK_RETURN);
    CHECK(app.session().position() == 100);
    CHECK(app.drawer() == Drawer::none);
    // The box that goes to a step takes its name, too.
    test::type(app, "gbefore");
    test::press(app, SDLK_RETURN);
    CHECK(app.session().position() == 50);
    test::type(app, "gafter");
    test::press(app, SDLK_RETURN);
    CHECK(app.session().position() == 50);
    CHECK(app.wrong.find("nearest first: ") != std::string::npos);
  }
  App again(trace, nullptr, {}, 1280, 720);
  REQUIRE(again.places().bookmarks().size() == 2);
  test::press(again, SDLK_l);
  test::press(again, SDLK_DELETE);
  CHECK(again.places().bookmarks() == std::vector<places::Bookmark>{{100, "here"}});
  test::press(again, SDLK_DELETE);
  test::press(again, SDLK_DELETE);
  test::press(again, SDLK_RETURN);
  CHECK(again.places().bookmarks().empty());
  // What cannot be read is told, and not written over.
  std::ofstream(marks) << "nonsense\n";
  App hostile(trace, nullptr, {}, 1280, 720);
  test::press(hostile, SDLK_l);
  hostile.settle();
  test::press(hostile, SDLK_ESCAPE);
  test::press(hostile, SDLK_b, KMOD_LCTRL);
  CHECK(hostile.drawer() == Drawer::none);  // before a name is typed
  CHECK(hostile.session().message.find("does not begin with a step") != std::string::npos);
  std::string kept;
  std::getline(std::ifstream(marks), kept);
  CHECK(kept == "nonsense");
}

TEST_CASE("a lesson's bookmarks are kept by its name, and where none can be kept no name is asked for") {
  const Trace trace = test::record_run("delhi");
  const test::Folder kept;
  const char* const before = std::getenv("XDG_CONFIG_HOME");
  const std::string config = before ? before : "";
  setenv("XDG_CONFIG_HOME", kept.path().c_str(), 1);
  Lesson lesson;
  lesson.id = "z-buffer";
  const auto keep = [&](App& app, std::int64_t step, const std::string& name) {
    app.session().go_to(step);
    test::press(app, SDLK_b, KMOD_LCTRL);
    REQUIRE(app.drawer() == Drawer::name_bookmark);
    test::type(app, name);
    test::press(app, SDLK_RETURN);
    CHECK(app.drawer() == Drawer::none);
  };
  {
    App app(trace, &lesson, {}, 1280, 720);
    keep(app, 40, "a tie");
  }
  App again(trace, &lesson, {}, 1280, 720);
  CHECK(again.places().bookmarks() == std::vector<places::Bookmark>{{40, "a tie"}});
  CHECK(fs::exists(kept / "zstep" / "lessons" / "z-buffer.marks"));
  lesson.id = "bsp";
  App other(trace, &lesson, {}, 1280, 720);
  CHECK(other.places().bookmarks().empty());
  App none(trace, nullptr, {}, 1280, 720);
  test::press(none, SDLK_b, KMOD_LCTRL);
  CHECK(none.drawer() == Drawer::none);
  CHECK(none.session().message.find("zstep record") != std::string::npos);
  if (before) setenv("XDG_CONFIG_HOME", config.c_str(), 1);
  else unsetenv("XDG_CONFIG_HOME");
}

TEST_CASE("playing repeats what is set between [ and ]") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  Session& s = app.session();
  s.go_to(100);
  test::type(app, "[");
  CHECK(s.loop_last == trace.size());
  s.go_to(103);
  test::type(app, "]");
  CHECK((s.loop_first == 100 && s.loop_last == 103));
  test::press(app, SDLK_SPACE);
  s.speed = 0;  // a step a second
  std::vector<std::int64_t> seen;
  for (int second = 0; second <= 7; ++second) {
    s.play(second);
    seen.push_back(s.position());
  }
  CHECK(seen == std::vector<std::int64_t>{100, 101, 102, 103, 100, 101, 102, 103});
  app.settle();
  test::press(app, SDLK_l, KMOD_LSHIFT);
  CHECK_FALSE(s.loops());
  for (int second = 8; second <= 10; ++second) s.play(second);
  CHECK(s.position() == 106);
  s.go_to(0);
  test::type(app, "]");
  CHECK_FALSE(s.loops());
}
