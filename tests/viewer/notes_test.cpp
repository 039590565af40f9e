// The speaker's notes: what stands on them, that all of it can be read, and when they are drawn anew.
#include <doctest/doctest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/ranges.h>

#include "sim/viewer/notes.hpp"
#include "sim/viewer/pictures.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

struct Talk {
  explicit Talk(const char* id = "z-buffer", bool dark = false)
      : lesson(find_lesson(id)), trace(run_lesson(lesson)), app(trace, &lesson, dressed(dark), 640, 360) {}
  static Settings dressed(bool dark) {
    Settings settings;
    settings.dark = dark;
    return settings;
  }
  Lesson lesson;
  Trace trace;
  App app;
};

std::string without_spaces(const std::string& text) {
  std::string bare;
  for (const char c : text)
    if (c != ' ' && c != '*') bare += c;
  return bare;
}

/// All that is drawn, in the order in which it is drawn, without spaces.
std::string seen_in(const Notes& notes) {
  ImGui::SetCurrentContext(notes.context());
  std::string all;
  for (const std::string& word : test::letters_of(notes.fonts()).words) all += without_spaces(word);
  return all;
}

SDL_Event of_window(const Window& window, Uint8 what) {
  SDL_Event event{};
  event.type = SDL_WINDOWEVENT;
  event.window.windowID = SDL_GetWindowID(window.get());
  event.window.event = what;
  return event;
}

}  // namespace

TEST_CASE("law: all that stands on the speaker's notes is read, at each stop that has some, in windows of every size") {
  for (const char* id : {"z-buffer", "bsp"})
    for (const auto& [width, height] : {std::pair{1100, 700}, {1280, 720}, {1600, 900}, {3840, 2160}})
      for (const bool dark : {false, true}) {
        Talk talk(id, dark);
        Notes notes(width, height);
        for (int stop = 0; stop < static_cast<int>(talk.lesson.stops.size()); ++stop) {
          if (std::string_view(id) == "bsp" && stop % 4 != 0) continue;
          talk.app.session().to_stop(stop);
          CHECK(notes.follow(talk.app, "14:05"));
          CAPTURE(id);
          CAPTURE(stop);
          CAPTURE(width);
          CHECK(notes.whole());
          ImGui::SetCurrentContext(notes.context());
          const test::Letters drawn = test::letters_of(notes.fonts());
          CHECK(drawn.all.size() > 60);
          CHECK(fmt::format("{}", fmt::join(test::cut_at_the_side(drawn), "; ")) == "");
          CHECK(fmt::format("{}", fmt::join(drawn.covered, "; ")) == "");
          CHECK(fmt::format("{}", fmt::join(test::over_each_other(drawn), "; ")) == "");
          CHECK(fmt::format("{}", fmt::join(test::smaller_than(drawn, 13), "; ")) == "");
        }
      }
}

TEST_CASE("notes: the stop, its notes, the right answer, what comes next and when, and no more than there is") {
  Talk talk;
  const std::vector<Stop>& stops = talk.lesson.stops;
  Notes notes(1280, 720);
  talk.app.session().to_stop(4);
  REQUIRE(stops[4].question);
  notes.follow(talk.app, "14:05");
  const std::string seen = seen_in(notes);
  CAPTURE(seen);
  const std::vector<Answer>& answers = stops[4].question->answers;
  const auto right = std::find_if(answers.begin(), answers.end(), [](const Answer& answer) { return answer.right; });
  for (const std::string& text :
       {stops[4].heading, std::string("Let them vote by hand"),
        fmt::format("THE ANSWER IS {}", right - answers.begin() + 1), right->text, std::string("NEXT"),
        stops[5].heading, std::string("14:05"), fmt::format("stop 5 of {}", stops.size()),
        std::string("planned 5:30 to 6:30 of 20:30")})
    CHECK_MESSAGE(seen.find(without_spaces(text)) != std::string::npos, text);
  talk.app.session().to_stop(static_cast<int>(stops.size()) - 1);
  notes.follow(talk.app, "14:05");
  const std::string last = seen_in(notes);
  CHECK(last.find("polygons=ACSBDEW") != std::string::npos);
  CHECK(last.find(without_spaces("This is the last stop.")) != std::string::npos);

  // A run without a lesson, and a lesson without notes.
  const Trace trace = test::record_run("pyramid");
  App alone(trace, nullptr, {}, 640, 360);
  CHECK(notes.follow(alone, ""));
  CHECK(seen_in(notes).find(without_spaces("none is open")) != std::string::npos);
  Talk other("bsp");
  for (Stop& stop : other.lesson.stops) stop.notes.reset();
  other.app.session().to_stop(0);
  CHECK(notes.follow(other.app, ""));
  CHECK(seen_in(notes).find(without_spaces("There are no notes for this stop.")) != std::string::npos);
  CHECK(planned(other.lesson, 0).empty());
}

TEST_CASE("notes are drawn anew only when something on them is another") {
  Talk talk;
  talk.app.session().to_stop(3);
  Notes notes(1280, 720);
  CHECK(notes.follow(talk.app, "14:05"));
  CHECK_FALSE(notes.follow(talk.app, "14:05"));
  test::move_mouse(talk.app, 100, 100);
  CHECK_FALSE(notes.follow(talk.app, "14:05"));
  CHECK(notes.follow(talk.app, "14:06"));
  test::press(talk.app, SDLK_RIGHT);
  CHECK(notes.follow(talk.app, "14:06"));
  talk.app.board().turn_clock(0);
  CHECK(notes.follow(talk.app, "14:06"));
  talk.app.clock_time = 0.5;
  CHECK_FALSE(notes.follow(talk.app, "14:06"));
  talk.app.clock_time = 61;
  CHECK(notes.follow(talk.app, "14:06"));
  CHECK(seen_in(notes).find("1:01") != std::string::npos);
}

TEST_CASE("the picture of the notes is what stands on them, without the time of day") {
  Talk talk;
  PictureOptions how;
  how.lesson = &talk.lesson, how.notes = true;
  const Image image = Pictures(talk.trace, how).at_stop(4);
  talk.app.session().to_stop(4);
  Notes notes(how.width, how.height);
  notes.follow(talk.app, "");
  const bool same = image.rgb == notes.renderer().rgb();
  CHECK(same);
}

TEST_CASE("the window of the notes opens and closes without touching the other, which keeps the keys") {
  const char* driver = SDL_getenv("SDL_VIDEODRIVER");
  if (!driver || std::string(driver) != "dummy") return;
  Talk talk;
  talk.app.session().to_stop(4);
  Window window(640, 360);
  NotesWindow notes(window);
  notes.follow(talk.app);
  CHECK_FALSE(notes.is_open());
  CHECK(notes.until_due() > 1000);
  // By its key.
  test::press(talk.app, SDLK_n, KMOD_LCTRL);
  REQUIRE(std::exchange(talk.app.requests.toggle_notes, false));
  CHECK(talk.app.session().stop() == 4);
  notes.toggle(talk.app);
  REQUIRE(notes.is_open());
  notes.follow(talk.app);
  CHECK(notes.until_due() <= 60);
  SDL_Window* second = nullptr;
  for (Uint32 id = 1; id < 20; ++id)
    if (SDL_Window* one = SDL_GetWindowFromID(id); one && one != window.get()) second = one;
  REQUIRE(second != nullptr);
  const Uint32 id = SDL_GetWindowID(second);

  SDL_Event event{};
  event.type = SDL_KEYDOWN;
  event.key.windowID = id;
  CHECK_FALSE(notes.takes(event, talk.app));
  event = {};
  event.type = SDL_MOUSEBUTTONDOWN;
  event.button.windowID = id;
  CHECK(notes.takes(event, talk.app));
  event.button.windowID = SDL_GetWindowID(window.get());
  CHECK_FALSE(notes.takes(event, talk.app));

  const std::string place = talk.app.command_line();
  event = of_window(window, SDL_WINDOWEVENT_CLOSE);
  event.window.windowID = id;
  CHECK(notes.takes(event, talk.app));
  CHECK_FALSE(notes.is_open());
  CHECK_FALSE(talk.app.requests.quit);
  CHECK(talk.app.command_line() == place);

  // Where two windows are, the system tells of the end of the first only so.
  notes.toggle(talk.app);
  CHECK_FALSE(notes.takes(of_window(window, SDL_WINDOWEVENT_CLOSE), talk.app));
  CHECK(talk.app.requests.quit);
}

TEST_CASE("notes open by themselves before a class with a lesson and a second screen, and else by their command") {
  CHECK(notes_open_by_themselves(true, true, 2));
  CHECK_FALSE(notes_open_by_themselves(true, true, 1));
  CHECK_FALSE(notes_open_by_themselves(true, false, 2));
  CHECK_FALSE(notes_open_by_themselves(false, true, 2));
}
