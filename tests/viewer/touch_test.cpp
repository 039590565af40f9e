// Fingers: what they mean as a mouse would say it, and what they do in the window.
#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <imgui_internal.h>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/touch.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

std::string act_named(const Touch::Act& act) {
  using Kind = Touch::Act::Kind;
  const auto at = [&](const char* what) { return fmt::format("{} {},{}", what, act.at.x, act.at.y); };
  switch (act.kind) {
    case Kind::point:
      return at("point");
    case Kind::tap:
      return at("tap");
    case Kind::press:
      return at("press");
    case Kind::release:
      return "release";
    case Kind::right_click:
      return at("right");
    case Kind::release_right:
      return "release right";
    case Kind::hold:
      return at("hold");
    case Kind::let_go:
      return "let go";
    case Kind::scroll:
      return fmt::format("scroll {},{}", act.by.x, act.by.y);
    case Kind::zoom:
      return fmt::format("zoom {}", act.factor);
    case Kind::leave:
      return "leave";
  }
  return "";
}

/// "down 1 100 100 @0; move 1 130 100; up 1; wait @600; end" and what the mouse does then. Left of x = 200 lies a text.
std::string meant(const std::string& script) {
  Touch touch([](Touch::Point at) { return at.x < 200; });
  std::istringstream steps(script);
  std::string step, said;
  while (std::getline(steps, step, ';')) {
    std::istringstream words(step);
    std::string verb, rest;
    std::int64_t finger = 0, time = 0;
    Touch::Point at;
    words >> verb;
    if (verb == "down" || verb == "move") words >> finger >> at.x >> at.y;
    if (verb == "up") words >> finger;
    if (words >> rest) time = std::stoll(rest.substr(1));
    for (const Touch::Act& act : verb == "down"   ? touch.down(finger, at, time)
                                 : verb == "move" ? touch.move(finger, at)
                                 : verb == "up"   ? touch.up(finger)
                                 : verb == "wait" ? touch.wait(time)
                                                  : touch.end())
      said += (said.empty() ? "" : "; ") + act_named(act);
  }
  return said;
}

constexpr int phone_width = 390, phone_height = 844;

SDL_Event finger_event(std::uint32_t type, int id, float x, float y, std::uint32_t time, App& app) {
  SDL_Event event{};
  event.type = type;
  event.tfinger.fingerId = id;
  event.tfinger.touchId = 1;
  event.tfinger.x = x / static_cast<float>(app.renderer().width());
  event.tfinger.y = y / static_cast<float>(app.renderer().height());
  event.tfinger.timestamp = time;
  return event;
}

/// As the window's loop does, with the frames that what fingers did still takes.
void by_finger(App& app, std::uint32_t type, int id, float x, float y, std::uint32_t time = 0) {
  test::send(app, finger_event(type, id, x, y, time, app));
  for (int k = 0; k < 8; ++k) app.frame();
}

void tap(App& app, float x, float y) {
  by_finger(app, SDL_FINGERDOWN, 1, x, y);
  by_finger(app, SDL_FINGERUP, 1, x, y, 50);
}

const ImGuiWindow* window_with(const std::string& part) {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->Active && std::string(window->Name).find(part) != std::string::npos) return window;
  return nullptr;
}

struct OnPhone {
  explicit OnPhone(int w = phone_width, int h = phone_height)
      : lesson(find_lesson("z-buffer")), trace(run_lesson(lesson)), app(trace, &lesson, {}, w, h) {
    app.session().go_to(867);
    app.settle();
  }
  Lesson lesson;
  Trace trace;
  App app;
};

}  // namespace

TEST_CASE("a finger is a mouse: taps, drags, right clicks when it rests") {
  CHECK(meant("down 1 300 90 @0; move 1 305 93; up 1") == "point 300,90; tap 300,90; leave");
  CHECK(meant("down 1 300 90 @0; move 1 320 90; move 1 330 95; up 1") ==
        "point 300,90; press 300,90; point 320,90; point 330,95; release; leave");
  CHECK(meant("down 1 300 90 @100; wait @599; wait @600; move 1 340 90; up 1") == "point 300,90; right 300,90; leave");
  CHECK(meant("down 1 300 90 @0; up 1; wait @900") == "point 300,90; tap 300,90; leave");
}

TEST_CASE("a swipe over a text scrolls it and presses nothing, also back to where it began") {
  CHECK(meant("down 1 100 300 @0; move 1 100 280; move 1 98 250; up 1") ==
        "point 100,300; scroll 0,-20; scroll -2,-30; leave");
  CHECK(meant("down 1 100 300 @0; move 1 100 280; move 1 100 300; wait @900; up 1") ==
        "point 100,300; scroll 0,-20; scroll 0,20; leave");
}

TEST_CASE("two fingers zoom by how far they part, and move, a text they scroll, what one began ends") {
  CHECK(meant("down 1 300 100 @0; down 2 400 100 @20; move 2 500 100; up 2; move 1 320 100; up 1") ==
        "point 300,100; point 350,100; hold 350,100; point 400,100; zoom 2; let go; leave");
  CHECK(meant("down 1 300 100 @0; move 1 300 140; down 2 400 140 @90; up 1; up 2") ==
        "point 300,100; press 300,100; point 300,140; release; point 350,140; hold 350,140; let go; leave");
  CHECK(meant("down 1 100 100 @0; down 2 150 100 @0; move 1 100 140; up 1; up 2") ==
        "point 100,100; point 125,100; scroll 0,20; leave");
  // Together they never divide by how close they are.
  CHECK(meant("down 1 300 100 @0; down 2 300 100 @0; move 2 301 100; up 1; up 2") ==
        "point 300,100; point 300,100; hold 300,100; point 300.5,100; let go; leave");
}

TEST_CASE("a third finger ends what two did, and where all are gone nothing is held") {
  CHECK(meant("down 1 300 100 @0; down 2 400 100 @0; down 3 350 150 @0; move 1 200 100; up 1; up 2; up 3") ==
        "point 300,100; point 350,100; hold 350,100; let go; leave");
  CHECK(meant("down 1 300 90 @0; move 1 330 90; end; wait @900; up 1") ==
        "point 300,90; press 300,90; point 330,90; release; leave");
  CHECK(meant("move 1 10 10; up 1; end; wait @900").empty());
  // That a finger went up may not be told, where something else had the window.
  CHECK(meant("down 1 300 90 @0; move 1 330 90; down 1 300 50 @900; up 1") ==
        "point 300,90; press 300,90; point 330,90; release; leave; point 300,50; tap 300,50; leave");
}

TEST_CASE("what is aimed at is hit in 44 pixels around it, of two the nearer, and what lies there before both") {
  Targets targets;
  targets.add({100, 100}, {120, 110});
  targets.add({100, 130}, {120, 140});
  const auto y = [&](float at) { return targets.aim({110, at}, 44).y; };
  CHECK(y(105) == 105);
  CHECK(y(88) == 100);
  CHECK(y(82) == 82);  // too far
  CHECK(y(115) == 109);
  CHECK(y(126) == 130);
  CHECK(targets.aim({93, 105}, 44).x == 100);
  CHECK(targets.aim({87, 105}, 44).x == 87);
  targets.add({0, 80}, {90, 200});
  CHECK(targets.aim({89, 105}, 44).x == 89);
}

TEST_CASE("law: what is hit in a window as small as a phone's is 44 pixels wide and high") {
  for (const auto& [w, h] : {std::pair{phone_width, phone_height}, {phone_height, phone_width}}) {
    CAPTURE(w);
    OnPhone phone(w, h);
    const ImGuiWindow* lesson = window_with("/lesson_");
    REQUIRE(lesson);
    const float top = lesson->Pos.y, end = top + lesson->Size.y;
    const auto& all = phone.app.ui().targets->all();
    CHECK(all.size() > 12);
    for (const Targets::Box& box : all) {
      CAPTURE(box.a.x);
      CAPTURE(box.a.y);
      CHECK(box.b.x - box.a.x >= 44);
      const bool scrolled = std::abs(box.a.y - top) < 2 || std::abs(box.b.y - end) < 2;  // part of it is out of sight
      CHECK((scrolled || box.b.y - box.a.y >= 44));
    }
  }
}

TEST_CASE("by fingers: a step on, a step back, the menu, another pane, an answer") {
  OnPhone phone;
  App& app = phone.app;
  Session& s = app.session();
  const Motion::Place foot = app.timeline_place();
  const float buttons = foot.at.y + foot.size.y - 22;
  const auto along = [&](float share) { return foot.at.x + foot.size.x * share; };
  s.answer(0);
  tap(app, along(0.7f), buttons);
  CHECK(s.position() == 868);
  tap(app, along(0.3f), buttons);
  CHECK(s.position() == 867);
  tap(app, along(0.5f), buttons);
  CHECK(s.playing);
  tap(app, along(0.5f), buttons);
  CHECK_FALSE(s.playing);
  tap(app, phone_width - 20, 20);
  CHECK(app.overlay() == Overlay::menu);
  app.open(Overlay::none);
  app.settle();
  const Motion::Place stage = app.stage_place();
  tap(app, stage.at.x + stage.size.x - 20, stage.at.y - 20);  // the arrow to the next name
  CHECK(app.lead() == "depth");
  // The whole strip is hit in a band of 44 pixels, also where it is dragged.
  by_finger(app, SDL_FINGERDOWN, 1, along(0.5f), foot.at.y + 3);
  by_finger(app, SDL_FINGERMOTION, 1, along(0.25f), foot.at.y + 20);
  by_finger(app, SDL_FINGERUP, 1, along(0.25f), foot.at.y + 20);
  CHECK(std::abs(s.position() - s.size() / 4) <= 4);
}

TEST_CASE("the mouse that a system makes of a finger is not told a second time") {
  OnPhone phone;
  App& app = phone.app;
  const Motion::Place foot = app.timeline_place();
  const int x = static_cast<int>(foot.at.x + foot.size.x * 0.3f), y = static_cast<int>(foot.at.y + foot.size.y) - 22;
  for (const std::uint32_t which : {SDL_TOUCH_MOUSEID, 0u}) {
    for (const std::uint32_t type : {SDL_MOUSEMOTION, SDL_MOUSEBUTTONDOWN, SDL_MOUSEBUTTONUP}) {
      SDL_Event event{};
      event.type = type;
      if (type == SDL_MOUSEMOTION) event.motion.which = which, event.motion.x = x, event.motion.y = y;
      else event.button.which = which, event.button.button = SDL_BUTTON_LEFT, event.button.x = x, event.button.y = y;
      app.handle(event);
      app.frame(), app.frame();
    }
    CHECK(app.session().position() == (which == 0 ? 866 : 867));
  }
}

TEST_CASE(
    "a swipe scrolls the lesson and answers nothing, a finger that rests on a pixel offers what can be done there") {
  OnPhone phone(390, 560);
  App& app = phone.app;
  const ImGuiWindow* lesson = window_with("/lesson_");
  REQUIRE(lesson);
  REQUIRE(lesson->ScrollMax.y > 20);
  const float x = lesson->Pos.x + 60, y = lesson->Pos.y + lesson->Size.y - 20,
              up = std::min(60.0f, lesson->ScrollMax.y);
  by_finger(app, SDL_FINGERDOWN, 1, x, y);
  by_finger(app, SDL_FINGERMOTION, 1, x, y - up);
  by_finger(app, SDL_FINGERUP, 1, x, y - up, 90);
  CHECK(lesson->Scroll.y == up);
  CHECK_FALSE(app.session().chosen(app.session().stop()).has_value());

  const Motion::Place stage = app.stage_place();
  by_finger(app, SDL_FINGERDOWN, 1, stage.at.x + stage.size.x / 2, stage.at.y + stage.size.y / 2, 1000);
  CHECK(app.wait_for_finger(1400) == doctest::Approx(0.1));
  CHECK(app.overlay() == Overlay::none);
  app.wait_for_finger(1500);
  for (int k = 0; k < 8; ++k) app.frame();
  CHECK(app.overlay() == Overlay::here);
  CHECK(app.here().size() >= 3);
  by_finger(app, SDL_FINGERUP, 1, stage.at.x + stage.size.x / 2, stage.at.y + stage.size.y / 2, 1900);
  CHECK(app.overlay() == Overlay::here);
}

TEST_CASE("two fingers on the frame zoom it and move it") {
  OnPhone phone;
  App& app = phone.app;
  const Motion::Place stage = app.stage_place();
  const float x = stage.at.x + stage.size.x / 2, y = stage.at.y + stage.size.y / 2;
  by_finger(app, SDL_FINGERDOWN, 1, x - 40, y);
  by_finger(app, SDL_FINGERDOWN, 2, x + 40, y);
  by_finger(app, SDL_FINGERMOTION, 1, x - 80, y);
  by_finger(app, SDL_FINGERMOTION, 2, x + 80, y);
  CHECK(app.ui().view.zoom == doctest::Approx(2).epsilon(0.01));
  const double before = app.ui().view.center_x;
  by_finger(app, SDL_FINGERMOTION, 1, x - 100, y);
  by_finger(app, SDL_FINGERMOTION, 2, x + 60, y);
  CHECK(app.ui().view.center_x > before + 0.5);
  by_finger(app, SDL_FINGERUP, 1, x, y);
  by_finger(app, SDL_FINGERUP, 2, x, y);
  CHECK_FALSE(app.session().selected.has_value());
  CHECK_FALSE(app.moving());
}

TEST_CASE("what a keyboard on the screen types comes in pieces that a text event takes, each of whole characters") {
  std::string text, joined;
  for (int k = 0; k < 40; ++k) text += "a\u00e9\u25b6";
  for (const std::string& part : in_text_events(text)) {
    CHECK(part.size() < SDL_TEXTINPUTEVENT_TEXT_SIZE);
    CHECK((static_cast<unsigned char>(part[0]) & 0xc0u) != 0x80u);
    joined += part;
  }
  CHECK(joined == text);
  CHECK(in_text_events("").empty());
}
