// A film of what the window shows: its frames are the window's own pictures, and the reader is where he was.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "sim/film/video.hpp"
#include "sim/viewer/app.hpp"
#include "tests/folder.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"

#if !defined(_WIN32)
#include <unistd.h>

using namespace zstep;
using namespace zstep::viewer;
namespace fs = std::filesystem;

namespace {

/// A folder to save in, with an ffmpeg that does this, as long as it lives.
class Studio {
 public:
  explicit Studio(const std::string& ffmpeg) : was_(fs::current_path()), path_(std::getenv("PATH")) {
    fs::create_directories(folder_ / "bin");
    if (!ffmpeg.empty()) {
      std::ofstream(folder_ / "bin/ffmpeg") << "#!/bin/sh\nfor last; do :; done\n" << ffmpeg;
      fs::permissions(folder_ / "bin/ffmpeg", fs::perms::owner_all);
    }
    setenv("PATH", ffmpeg.empty() ? "/nonexistent" : (folder_.path().string() + "/bin:" + path_).c_str(), 1);
    fs::current_path(folder_.path());
  }
  ~Studio() {
    fs::current_path(was_);
    setenv("PATH", path_.c_str(), 1);
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& file : fs::directory_iterator(folder_.path()))
      if (file.is_regular_file()) names.push_back(file.path().filename().string());
    return names;
  }

 private:
  test::Folder folder_;
  fs::path was_;
  std::string path_;
};

constexpr const char* keeps_frames = "cat > \"$last\"\n";

void make_film(App& app) {
  for (int frames = 0; app.filming() && frames < 10'000; ++frames) app.frame();
  REQUIRE_FALSE(app.filming());
}

test::Bytes bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct OnSet {
  OnSet() : lesson(find_lesson("z-buffer")), trace(run_lesson(lesson)), app(trace, &lesson, Settings{}, 640, 360) {}
  Lesson lesson;
  Trace trace;
  App app;
};

}  // namespace

TEST_CASE("a film's frames are the window's pictures of those steps, and all is as it was afterwards") {
  const Studio studio(keeps_frames);
  OnSet o;
  const int stop = 7;
  o.app.session().to_stop(stop);
  o.app.session().selected_edge = 1;
  const test::Bytes before = test::picture(o.app);
  const std::int64_t first = o.app.session().position(), last = o.lesson.stops[stop + 1].position;
  REQUIRE(last > first);
  test::press(o.app, SDLK_f, KMOD_LCTRL | KMOD_LSHIFT);
  REQUIRE(o.app.overlay() == Overlay::film);
  test::press(o.app, SDLK_RETURN);
  REQUIRE(o.app.filming());
  // What keys and mouse do meanwhile is no part of it.
  SDL_Event event{};
  event.type = SDL_KEYDOWN, event.key.keysym.sym = SDLK_t;
  o.app.handle(event);
  for (const SDL_EventType type : {SDL_MOUSEBUTTONDOWN, SDL_MOUSEBUTTONUP}) {
    event = {};
    event.type = type, event.button.button = SDL_BUTTON_LEFT, event.button.x = 300, event.button.y = 200;
    o.app.handle(event);
  }
  make_film(o.app);
  const std::string name = fmt::format("zstep-{}-{}.mp4", first, last);
  CHECK(studio.files() == std::vector<std::string>{name});
  CAPTURE(o.app.session().message);
  CHECK(o.app.session().message.find((fs::current_path() / name).string()) != std::string::npos);
  CHECK(o.app.session().stop() == stop);
  CHECK(o.app.session().position() == first);
  CHECK(o.app.session().selected_edge == 1);
  CHECK_FALSE(o.app.settings().dark);
  o.app.session().message.clear();
  CHECK(test::picture(o.app) == before);

  const test::Bytes frames = bytes_of(name);
  const std::size_t bytes = 640 * 360 * 3;
  REQUIRE(frames.size() == bytes * film_steps(first, last).size());
  OnSet other;
  for (const std::int64_t step : {first, first + 1, last}) {
    CAPTURE(step);
    other.app.session().go_to(step);
    const auto from = frames.begin() + static_cast<std::ptrdiff_t>(bytes) * (step - first);
    const bool same = test::Bytes(from, from + static_cast<std::ptrdiff_t>(bytes)) == test::picture(other.app);
    CHECK(same);
  }
}

TEST_CASE("a film that is ended, fails or cannot be made leaves no file, and says why in one line") {
  OnSet o;
  o.app.session().go_to(300);
  const auto says = [&](const char* text) { return o.app.session().message.find(text) != std::string::npos; };
  {
    const Studio studio(keeps_frames);
    o.app.film(0, o.trace.size());
    o.app.frame();
    REQUIRE(o.app.filming());
    // One sees how far it is.
    o.app.frame();
    bool told = false;
    for (const std::string& word : test::letters_of(o.app.ui().fonts).words)
      told = told || word.find("of200") != std::string::npos || word.find("filming") != std::string::npos;
    CHECK(told);
    test::press(o.app, SDLK_ESCAPE);
    CHECK_FALSE(o.app.filming());
    CHECK(says("no file was left"));
    CHECK(studio.files().empty());
    CHECK(o.app.session().position() == 300);

    o.app.film(0, o.trace.size());
    o.app.frame();
    o.app.resize(700, 400);
    CHECK(says("another size"));
    CHECK(studio.files().empty());

    test::press(o.app, SDLK_f, KMOD_LCTRL | KMOD_LSHIFT);
    test::type(o.app, "20 10");
    test::press(o.app, SDLK_RETURN);
    CHECK_FALSE(o.app.filming());
    CHECK(o.app.wrong.find("The first step comes before the last") != std::string::npos);
    test::press(o.app, SDLK_ESCAPE);
  }
  {
    const Studio studio("cat > /dev/null\necho half > \"$last\"\nexit 3\n");
    o.app.film(300, 302);
    make_film(o.app);
    CHECK(says("ffmpeg could not make it"));
    CHECK(studio.files().empty());
  }
  const Studio studio("");
  o.app.film(300, 302);
  CHECK_FALSE(o.app.filming());
  CHECK(says("films are made by ffmpeg, which is not installed"));
  CHECK(o.app.session().message.find('\n') == std::string::npos);
  CHECK(studio.files().empty());
}

TEST_CASE("what a film may be of: the lesson's stop, what is repeated, the polygon, the rest, all, long ones skip") {
  OnSet o;
  o.app.session().to_stop(9);
  o.app.session().loop_first = 5, o.app.session().loop_last = 50;
  std::vector<std::string> what;
  for (const FilmRange& range : o.app.film_ranges()) {
    CHECK(range.first < range.last);
    what.push_back(range.what);
  }
  CHECK(what == std::vector<std::string>{"From this stop of the lesson to the next", "What playing repeats",
                                         "Work on polygon W", "From here to the end", "The whole run"});
  const std::vector<std::int64_t> all = film_steps(0, 1'000'000);
  CHECK(all.size() == 200);
  CHECK((all.front() == 0 && all.back() == 1'000'000));
  CHECK(film_steps(7, 9) == std::vector<std::int64_t>{7, 8, 9});
}
#endif
