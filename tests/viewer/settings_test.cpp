// What stays from run to run.
#include <fstream>

#include <doctest/doctest.h>
#include <unistd.h>

#include "sim/places/bookmarks.hpp"
#include "sim/viewer/settings.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/error.hpp"

using namespace zstep::viewer;

namespace {
const std::filesystem::path path =
    std::filesystem::temp_directory_path() / ("zstep_settings_test_" + std::to_string(getpid())) / "viewer.ini";
}

TEST_CASE("settings come back as they were saved") {
  Settings s;
  s.dark = s.reduced_motion = true;
  s.text_scale = 1.25f;
  s.width = 1000;
  s.height = 600;
  s.layout.left = 0.33f;
  s.layout.drawer_width = 0.4f, s.layout.drawer_height = 0.45f;
  s.layout.structures["scene"] = 0.5f;
  s.remember("a run.ztrace|100|5", 42);
  s.remember("other", 7);
  s.remember("y = sin(x) * cos(z)|1144|1024", 194);
  s.remember("a run.ztrace|100|5", 43);
  REQUIRE(save_settings(path, s));
  const Settings back = load_settings(path);
  CHECK(back.dark);
  CHECK(back.reduced_motion);
  CHECK(back.same_but_for_places(s));
  CHECK_FALSE(back.presenter);
  CHECK(back.text_scale == 1.25f);
  CHECK(back.width == 1000);
  CHECK(back.layout.left == doctest::Approx(0.33f));
  CHECK(back.layout.drawer_width == doctest::Approx(0.4f));
  CHECK(back.layout.drawer_height == doctest::Approx(0.45f));
  CHECK(back.layout.structures.at("scene") == doctest::Approx(0.5f));
  CHECK(back.place("a run.ztrace|100|5") == 43);
  CHECK(back.place("other") == 7);
  CHECK(back.place("y = sin(x) * cos(z)|1144|1024") == 194);
  CHECK_FALSE(back.place("never seen"));
  std::filesystem::remove_all(path.parent_path());
}

TEST_CASE("a damaged file of settings leaves the defaults") {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path)
      << "left = nan\nright = 1e99\nwidth = -5\ntext_scale = 1000\nspeed = 99\ngarbage\n = \nplace x = -4\n\xff\xfe";
  const Settings s = load_settings(path);
  CHECK(s.layout.left == Layout{}.left);
  CHECK(s.layout.right <= 0.95f);
  CHECK(s.width == 0);
  CHECK(s.text_scale == 3.0f);
  CHECK(s.speed == 9);
  CHECK(s.place("x") == 0);
  std::filesystem::remove_all(path.parent_path());
}

TEST_CASE("what an option sets holds for its run, what a key changes stays") {
  Settings stored, begun;
  begun.dark = begun.presenter = true;  // --dark --presenter
  Settings ended = begun;
  ended.speed = 4;
  CHECK_FALSE(kept_settings(stored, begun, ended).dark);
  CHECK_FALSE(kept_settings(stored, begun, ended).presenter);
  CHECK(kept_settings(stored, begun, ended).speed == 4);
  stored.dark = true, begun.dark = false, ended.dark = false;  // --light
  CHECK(kept_settings(stored, begun, ended).dark);
  stored = begun = Settings();
  ended.dark = ended.presenter = true;  // by keys
  CHECK(kept_settings(stored, begun, ended).dark);
  CHECK(kept_settings(stored, begun, ended).presenter);
}

TEST_CASE("a window opens as it was left, unless a size is asked for, the usual one too") {
  Settings left;
  CHECK(opening_size(left, {}) == zstep::WindowSize{1280, 720});
  CHECK(opening_size(left, zstep::WindowSize{800, 600}) == zstep::WindowSize{800, 600});
  left.width = 1000, left.height = 500;
  CHECK(opening_size(left, {}) == zstep::WindowSize{1000, 500});
  CHECK(opening_size(left, zstep::WindowSize{1280, 720}) == zstep::WindowSize{1280, 720});
  left.height = 0;
  CHECK(opening_size(left, {}) == zstep::WindowSize{1280, 720});
}

TEST_CASE("only the latest places are kept") {
  Settings s;
  for (int i = 0; i < 500; ++i) s.remember("trace " + std::to_string(i), i);
  CHECK(s.places.size() <= 200);
  CHECK(s.place("trace 499") == 499);
  CHECK_FALSE(s.place("trace 0"));
}

TEST_CASE("what is saved at once is every setting, and not each step") {
  const Settings before;
  Settings after;
  after.remember("a run", 12);
  CHECK(after.same_but_for_places(before));
  const std::vector<void (*)(Settings&)> changes{[](Settings& s) { s.dark = true; },
                                                 [](Settings& s) { s.presenter = true; },
                                                 [](Settings& s) { s.text_scale = 1.125f; },
                                                 [](Settings& s) { s.reduced_motion = true; },
                                                 [](Settings& s) { s.speed = 4; },
                                                 [](Settings& s) { s.layout.left = 0.3f; },
                                                 [](Settings& s) { s.layout.drawer_height = 0.4f; },
                                                 [](Settings& s) { s.width = 900; },
                                                 [](Settings& s) { s.layout.structures["scene"] = 0.4f; },
                                                 [](Settings& s) { s.see_stop("viewing", 3); }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    CAPTURE(k);
    Settings changed;
    changes[k](changed);
    CHECK_FALSE(changed.same_but_for_places(before));
  }
}

TEST_CASE("the page of settings opens by key and by its gear, and each row changes what it says") {
  const zstep::Trace trace = zstep::test::record_run("pyramid", zstep::test::of_size(16, 16));
  App app(trace, nullptr, {}, 1280, 720);
  zstep::test::press(app, SDLK_COMMA, KMOD_LCTRL);
  REQUIRE(app.overlay() == Overlay::settings);
  const auto key = [&](SDL_Keycode code) { zstep::test::press(app, code); };
  key(SDLK_RIGHT);
  CHECK(app.settings().text_scale == doctest::Approx(1.125f));
  key(SDLK_LEFT), key(SDLK_LEFT);
  CHECK(app.settings().text_scale == doctest::Approx(1 / 1.125f));
  key(SDLK_DOWN), key(SDLK_RIGHT);
  CHECK(app.session().speed == 3);
  key(SDLK_DOWN), key(SDLK_RETURN);
  CHECK(app.settings().dark);
  key(SDLK_DOWN), key(SDLK_RETURN);
  CHECK(app.settings().presenter);
  key(SDLK_LEFT);
  CHECK_FALSE(app.settings().presenter);
  key(SDLK_DOWN), key(SDLK_RETURN);
  CHECK(app.settings().reduced_motion);
  app.settings().layout.left = 0.4f;
  key(SDLK_DOWN), key(SDLK_RETURN);
  CHECK(app.settings().layout == Layout{});
  CHECK(app.session().position() == 0);  // no key of the page has moved the run
  key(SDLK_ESCAPE);
  CHECK(app.overlay() == Overlay::none);
  bool opened = false;
  for (int x = 1270; x > 1000 && !opened; x -= 6) {
    zstep::test::click(app, x, 14);
    opened = app.overlay() == Overlay::settings;
    key(SDLK_ESCAPE);
  }
  CHECK(opened);
}

namespace {

std::string text_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::filesystem::path put_in(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
  return file;
}

}  // namespace

TEST_CASE("settings, progress and bookmarks go to another computer in one file") {
  const std::filesystem::path home = path.parent_path(), one = home / "one", other = home / "other";
  Settings s;
  s.dark = true, s.width = 900, s.height = 500, s.text_scale = 1.5f;
  s.see_stop("z-buffer", 4), s.see_stop("bsp", 2);
  s.remember("run|10|3", 7);
  REQUIRE(save_settings(one / "viewer.ini", s));
  put_in(one / "lessons/z-buffer.marks", "219 the first tie\n231 hidden by B\n");
  put_in(one / "lessons/not a lesson.marks", "1 nothing\n");
  put_in(one / "lessons/other.txt", "nothing\n");
  const std::filesystem::path file = put_in(home / progress_file_name, progress_text(one));
  CHECK(is_progress_file(file.string()));

  Settings here;
  here.width = 1600, here.height = 1000;
  here.see_stop("z-buffer", 9), here.see_stop("warnock", 1);
  put_in(other / "lessons/z-buffer.marks", "300 mine\n301 the first tie\n");
  const Settings taken = take_progress(file, other, here);
  CHECK(taken.dark);
  CHECK(taken.text_scale == 1.5f);
  CHECK(taken.width == 1600);  // of this screen
  CHECK(taken.stops_seen("z-buffer") == 9);
  CHECK(taken.stops_seen("bsp") == 2);
  CHECK(taken.stops_seen("warnock") == 1);
  CHECK(taken.place("run|10|3") == 7);
  CHECK(text_in(other / "lessons/z-buffer.marks") ==
        "# bookmarks of the lesson z-buffer\n231 hidden by B\n300 mine\n301 the first tie\n");
  // Once more changes nothing, and what is written is what can be read.
  CHECK(take_progress(file, other, taken).stops_seen("z-buffer") == 9);
  CHECK(progress_text(other) == "# zstep: settings, progress and bookmarks\n[lessons/z-buffer.marks]\n" +
                                    text_in(other / "lessons/z-buffer.marks"));
  std::filesystem::remove_all(home);
}

TEST_CASE("a file of progress that is none is refused by its line, and nothing is changed") {
  const std::filesystem::path home = path.parent_path(), other = home / "other";
  const std::string head = "# zstep: settings, progress and bookmarks\n";
  const std::pair<std::string, std::string> wrong[] = {
      {"", ":1: is not the line"},
      {"dark = 1\n", ":1: is not the line"},
      {head + "dark = 1\n", ":2: belongs to no part"},
      {head + "[viewer.ini]\ndark = 1\n[../../.bashrc]\n", ":4: names a part"},
      {head + "[lessons/../x.marks]\n", ":2: names a part"},
      {head + "[lessons/.marks]\n", ":2: names a part"},
      {head + "[lessons/z-buffer.marks]\n1 right\nwrong\n", ":4: does not begin with a step"},
      {head + "[lessons/z-buffer.marks]\n1 right\n[lessons/bsp.marks]\n5 a\n6 a\n", ":6: its name was given before"}};
  for (const auto& [text, what] : wrong) {
    const std::filesystem::path file = put_in(home / progress_file_name, text);
    CAPTURE(text);
    std::string said;
    try {
      take_progress(file, other, Settings{});
    } catch (const zstep::InputError& error) {
      said = error.what();
    }
    CHECK_MESSAGE(said.find(what) != std::string::npos, said);
    CHECK_FALSE(std::filesystem::exists(other));
  }
  std::filesystem::remove_all(home);
}
