// Keys, palette, mouse: everything a reader can do goes through one table.
#include <set>

#include <doctest/doctest.h>
#include <imgui_internal.h>

#include "tests/viewer/drive.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/places/typed_place.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("every command has a key, and no key has two commands") {
  std::set<std::tuple<SDL_Keycode, unsigned, char>> taken;
  std::set<std::string> ids;
  for (const Command& command : commands()) {
    CAPTURE(command.id);
    CHECK_FALSE(command.keys.empty());
    CHECK_FALSE(key_names(command).empty());
    CHECK(ids.insert(command.id).second);
    for (const Chord& chord : command.keys) CHECK(taken.insert({chord.key, chord.modifiers, chord.character}).second);
  }
}

TEST_CASE("the keys of the sheet move as they say") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  Session& s = app.session();
  const auto kind_here = [&] { return s.event() ? s.event()->event.index() : std::size_t{99}; };
  test::press(app, SDLK_RIGHT);
  CHECK(s.position() == 1);
  test::press(app, SDLK_RIGHT, KMOD_LSHIFT);
  CHECK(kind_here() == kind_of<DepthInterpolate>);
  test::press(app, SDLK_RIGHT, KMOD_LCTRL);
  CHECK(kind_here() == kind_of<ScanLineBegin>);
  const std::int64_t line = s.position();
  test::press(app, SDLK_RIGHT, KMOD_LCTRL);
  test::press(app, SDLK_LEFT, KMOD_RCTRL);
  CHECK(s.position() == line);
  test::press(app, SDLK_PAGEDOWN);
  CHECK(kind_here() == kind_of<PolygonBegin>);
  test::press(app, SDLK_END);
  CHECK(s.position() == trace.size());
  test::press(app, SDLK_RIGHT);
  CHECK(s.message.find("end") != std::string::npos);
  test::press(app, SDLK_HOME);
  CHECK(s.position() == 0);
  test::press(app, SDLK_SPACE);
  CHECK(s.playing);
  test::press(app, SDLK_SPACE);
  CHECK_FALSE(s.playing);
  const int speed = s.speed;
  test::type(app, "+");
  CHECK(s.speed == speed + 1);
  test::type(app, "-");
  CHECK(s.speed == speed);
}

TEST_CASE("G goes to a step, a share, a polygon or selects a pixel, and nonsense says what may be typed") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  const auto go = [&](const std::string& text) {
    if (app.overlay() != Overlay::none) test::press(app, SDLK_ESCAPE);
    test::type(app, "g" + text);
    test::press(app, SDLK_RETURN);
  };
  go("100");
  CHECK(app.session().position() == 100);
  go("1 01");
  CHECK(app.session().selected == Cell{1, 1});
  go("50%");
  CHECK(app.session().position() == trace.size() / 2);
  go("p 1");
  CHECK(app.session().position() == trace.polygons()[1].position);
  go("3, 2");
  CHECK(app.session().selected == Cell{3, 2});
  const std::int64_t here = app.session().position();
  go("99, 99");
  CHECK(app.session().selected == Cell{3, 2});
  CHECK(app.overlay() == Overlay::go_to);
  CHECK(app.wrong.find("there is no pixel (99, 99)") != std::string::npos);
  go("what");
  CHECK(app.session().position() == here);
  // What is refused stays in the box, with what is wrong beside it, and can be mended there.
  CHECK(app.overlay() == Overlay::go_to);
  CHECK(app.typed == "what");
  CHECK(app.wrong.find("'what' is no step") != std::string::npos);
  for (int i = 0; i < 4; ++i) test::press(app, SDLK_BACKSPACE);
  CHECK(app.wrong.empty());
  test::type(app, "+5");
  test::press(app, SDLK_RETURN);
  CHECK(app.overlay() == Overlay::none);
  CHECK(app.session().position() == here + 5);
  test::type(app, "g-5");
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() == here);
  go("999999999999999999999999");
  CHECK(app.session().position() == trace.size());
  // No digits are picked out of what is something else.
  app.session().go_to(7);
  for (const char* const text : {"1e5", "12.5", "lines 3", "p", "150%", "1, 2, 3", ""}) {
    CAPTURE(text);
    go(text);
    CHECK(app.session().position() == 7);
    CHECK_FALSE(app.wrong.empty());
  }
}

TEST_CASE("G goes to the next place where a scan line begins, and back to the last where there is no next") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  const auto go = [&](const std::string& text) {
    if (app.overlay() != Overlay::none) test::press(app, SDLK_ESCAPE);
    test::type(app, "g" + text);
    test::press(app, SDLK_RETURN);
  };
  std::vector<std::int64_t> begins;
  for (std::int64_t p = 1; p <= trace.size(); ++p)
    if (const auto* line = get_if<ScanLineBegin>(&trace.event(p).event); line && line->y == 3) begins.push_back(p);
  REQUIRE_FALSE(begins.empty());
  for (const std::int64_t position : begins) {
    go("line 3");
    CHECK(app.session().position() == position);
    CHECK(app.session().message.empty());
  }
  app.session().go_to(trace.size());
  go("y 3");
  CHECK(app.session().position() == begins.back());
  CHECK_FALSE(app.session().message.empty());
  go("line 4000");
  CHECK(app.session().position() == begins.back());
  CHECK(app.wrong.find("4000") != std::string::npos);
}

TEST_CASE("what is said to the reader goes with the next key or click, and nothing pops up at a mouse that rests") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_f);  // no pixel is selected
  CHECK_FALSE(app.session().message.empty());
  test::press(app, SDLK_z);
  CHECK(app.session().message.empty());
  test::press(app, SDLK_f);
  test::click(app, 700, 300);
  CHECK(app.session().message.empty());

  test::move_mouse(app, 100, 100);
  CHECK_FALSE(app.ui().reads);
  test::press(app, SDLK_RIGHT);
  CHECK(app.ui().reads);
  test::move_mouse(app, 101, 100);
  CHECK_FALSE(app.ui().reads);
}

TEST_CASE("the key sheet fits into the window") {
  const Trace trace = test::record_run("pyramid-behind");
  for (const auto& [width, height] : {std::pair{1024, 768}, {1280, 720}, {1920, 1080}}) {
    CAPTURE(width);
    App app(trace, nullptr, {}, width, height);
    test::press(app, SDLK_F1);
    REQUIRE(app.overlay() == Overlay::keys);
    app.settle();
    const ImGuiWindow* sheet = nullptr;
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (std::string(window->Name) == "keys") sheet = window;
    REQUIRE(sheet);
    CHECK(sheet->ScrollMax.y == 0);
    CHECK(sheet->Pos.y + sheet->Size.y <= static_cast<float>(height));
  }
}

TEST_CASE("F runs through everything that touches the selected pixel and nothing else") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  Session& s = app.session();
  test::press(app, SDLK_f);
  CHECK(s.position() == 0);
  CHECK_FALSE(s.message.empty());
  s.select(Cell{1, 2});
  std::int64_t expected = 0, found = 0;
  for (std::int64_t p = 1; p <= trace.size(); ++p)
    if (const auto pixel = pixel_of(trace.event(p).event); pixel && pixel->x == 1 && pixel->y == 2) ++expected;
  for (std::int64_t before = -1; s.position() != before && found < 100;) {
    before = s.position();
    test::press(app, SDLK_f);
    if (s.position() == before) break;
    ++found;
  }
  CHECK(expected > 3);
  CHECK(found == expected);
  test::press(app, SDLK_f, KMOD_LSHIFT);
  CHECK(pixel_of(s.event()->event)->x == 1);
}

TEST_CASE("the palette finds commands by words of their name and runs them") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  CHECK(matching("scan line").size() == 2);
  CHECK(matching("").size() == commands().size());
  CHECK(matching("no such thing").empty());
  test::press(app, SDLK_p, KMOD_LCTRL);
  REQUIRE(app.overlay() == Overlay::palette);
  test::type(app, "to the end");
  app.settle();
  test::press(app, SDLK_RETURN);
  CHECK(app.overlay() == Overlay::none);
  CHECK(app.session().position() == trace.size());
  test::press(app, SDLK_p, KMOD_LCTRL);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.overlay() == Overlay::none);
}

TEST_CASE("every command runs at every end of a trace without harm") {
  const Trace trace = test::record_run("delhi");
  for (const std::int64_t at : {std::int64_t{0}, std::int64_t{60}, trace.size()})
    for (const Command& command : commands()) {
      App app(trace, nullptr, {}, 800, 600);
      app.session().go_to(at);
      command.run(app);
      app.settle();
      if (command.release) command.release(app);
      app.settle();
    }
}

TEST_CASE("a click selects the pixel under the mouse, in either buffer") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  app.settle();
  // The middle of the framebuffer pane, and the same cell in the depth buffer beside it.
  test::click(app, 592, 208);
  REQUIRE(app.session().selected);
  const Cell cell = *app.session().selected;
  test::click(app, 592, 208);
  CHECK_FALSE(app.session().selected);
  test::click(app, 592 + 463, 208);
  CHECK(app.session().selected == cell);
}

TEST_CASE("a border follows the mouse that drags it, from where it is taken hold of") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.settle();
  const float before = app.settings().layout.left;
  test::move_mouse(app, 900, 500);
  // Straight onto the border between code and framebuffer, without a frame on the way.
  test::mouse_button(app, 288, 300, true);
  test::move_mouse(app, 308, 300);
  test::move_mouse(app, 328, 300);
  test::mouse_button(app, 328, 300, false);
  app.settle();
  CHECK(app.settings().layout.left == doctest::Approx(before + 40.0 / 1268).epsilon(0.01));
  test::press(app, SDLK_l, KMOD_LCTRL);
  CHECK(app.settings().layout.left == before);
}

TEST_CASE("the wheel zooms about the cell under the mouse, in both buffers alike") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  app.settle();
  test::move_mouse(app, 600, 210);
  const auto cell = app.ui().pointed;
  REQUIRE(cell);
  for (int i = 0; i < 4; ++i) {
    SDL_Event event{};
    event.type = SDL_MOUSEWHEEL;
    event.wheel.y = 1;
    app.handle(event);
    app.settle();
    CHECK(app.ui().pointed == cell);
  }
  CHECK(app.ui().view.zoom > 2);
  test::press(app, SDLK_0);
  CHECK(app.ui().view.zoom == 1);
}

TEST_CASE("the copied command names trace and step, and quotes what a shell would split") {
  const Trace plain = test::record_run("delhi");
  App app(plain, nullptr, {}, 640, 480);
  app.session().go_to(42);
  CHECK(app.command_line() == "zstep view delhi --at 42");
  app.opened_by = {"view", "teapot", "--no-cull"};
  CHECK(app.command_line() == "zstep view teapot --no-cull --at 42");
  Lesson lesson;
  lesson.id = "worked-example";
  App in_lesson(plain, &lesson, {}, 640, 480);
  in_lesson.session().go_to(7);
  CHECK(in_lesson.command_line() == "zstep lesson worked-example --at 7");
  test::press(app, SDLK_c, KMOD_LCTRL);
  CHECK(app.requests.clipboard == app.command_line());
}

TEST_CASE("a key has one owner: what runs a command types nothing, and what the field takes runs none") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  Session& s = app.session();
  s.go_to(100);
  const int speed = s.speed;
  for (const SDL_Keycode key : {SDLK_PLUS, SDLK_MINUS, SDLK_MINUS, SDLK_EQUALS}) test::press(app, key, KMOD_LCTRL);
  CHECK(s.speed == speed);  // the text's size alone
  test::type(app, "-");
  CHECK(s.speed == speed - 1);

  test::type(app, "gabc");
  REQUIRE(app.overlay() == Overlay::go_to);
  CHECK(app.typed == "abc");
  const float size = app.settings().text_scale;
  test::press(app, SDLK_MINUS, KMOD_LCTRL);
  CHECK(app.settings().text_scale < size);
  CHECK(app.typed == "abc");
  // The field's own: nothing of it reaches the trace, the link or the speed.
  for (const SDL_Keycode key : {SDLK_LEFT, SDLK_RIGHT, SDLK_HOME, SDLK_END})
    for (const std::uint16_t with : {KMOD_NONE, KMOD_LCTRL, KMOD_LSHIFT}) test::press(app, key, with);
  for (const SDL_Keycode key : {SDLK_PAGEUP, SDLK_PAGEDOWN}) test::press(app, key);
  test::press(app, SDLK_c, KMOD_LCTRL);
  CHECK(s.position() == 100);
  CHECK_FALSE(app.requests.clipboard);
  CHECK(app.overlay() == Overlay::go_to);
  CHECK(app.typed == "abc");
}

TEST_CASE("a field is edited as fields are: a caret, a selection, the clipboard, undo") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  test::type(app, "g123");
  test::press(app, SDLK_LEFT);
  test::type(app, "9");
  CHECK(app.typed == "1293");
  test::press(app, SDLK_HOME);
  test::press(app, SDLK_DELETE);
  CHECK(app.typed == "293");
  test::press(app, SDLK_z, KMOD_LCTRL);
  CHECK(app.typed == "1293");
  test::press(app, SDLK_a, KMOD_LCTRL);
  test::press(app, SDLK_c, KMOD_LCTRL);
  test::press(app, SDLK_BACKSPACE);
  CHECK(app.typed.empty());
  test::press(app, SDLK_v, KMOD_LCTRL);
  test::press(app, SDLK_v, KMOD_LCTRL);
  CHECK(app.typed == "12931293");
  test::press(app, SDLK_LEFT, KMOD_LSHIFT);
  test::type(app, "\u00fc");
  CHECK(app.typed == "1293129\u00fc");
  test::press(app, SDLK_BACKSPACE);
  test::press(app, SDLK_a, KMOD_LCTRL);
  test::press(app, SDLK_x, KMOD_LCTRL);
  CHECK(app.typed.empty());
  // The same in every box that is typed in.
  test::press(app, SDLK_ESCAPE);
  for (const char* const key : {"g", "u", "q", "y", "R"}) {
    CAPTURE(key);
    test::type(app, key);
    REQUIRE((app.overlay() != Overlay::none || app.drawer() != Drawer::none));
    CHECK(app.typed.empty());
    test::press(app, SDLK_v, KMOD_LCTRL);
    CHECK(app.typed == "1293129");
    test::press(app, SDLK_a, KMOD_LCTRL);
    test::press(app, SDLK_BACKSPACE);
    CHECK(app.typed.empty());
    test::press(app, SDLK_ESCAPE);
  }
}

TEST_CASE("a click among the words of the drawer leaves the keyboard with its field") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  test::type(app, "u");
  test::click(app, 640, 580);  // the drawer's words
  test::type(app, "not nearer");
  CHECK(app.typed == "not nearer");
}
