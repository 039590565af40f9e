// The drawer: it takes room from the panes and covers none of them, its pages follow what is selected, the rest of the
// window goes on, and its border and its keys are where a hand puts them.
#include <string>

#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/model/against.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/pictures.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/drawer_pages.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

using Place = Motion::Place;

bool apart(const Place& a, const Place& b) {
  return a.at.x + a.size.x <= b.at.x || b.at.x + b.size.x <= a.at.x || a.at.y + a.size.y <= b.at.y ||
         b.at.y + b.size.y <= a.at.y;
}

/// A pixel's square on the screen, in the frame.
Place in_frame(App& app, Cell cell) {
  const auto canvas = app.ui().canvases.find("frame");
  REQUIRE(canvas != app.ui().canvases.end());
  const Canvas& made = canvas->second.made;
  const auto corner = test::corner_of(Renderer::image(made));
  REQUIRE_MESSAGE(corner, "the frame is not seen");
  const RasterMap map(app.session().scene().raster, app.ui().view, made.width(), made.height());
  const auto side = static_cast<float>(map.cell);
  return {{corner->x + static_cast<float>(map.px(cell.x)) - side / 2,
           corner->y + static_cast<float>(map.py(cell.y)) - side / 2},
          {side, side}};
}

struct Shape {
  int width, height;
  bool presenter;
};
constexpr Shape looks[] = {{1280, 720, false},  {1600, 900, false}, {1920, 1080, false},
                           {3840, 2160, false}, {1280, 720, true},  {1920, 1080, true}};

void check_apart(App& app, const Shape& look, Cell cell) {
  const Place drawer = app.drawer_place(), timeline = app.timeline_place();
  CAPTURE(drawer.at.x);
  CAPTURE(drawer.at.y);
  CAPTURE(drawer.size.x);
  CAPTURE(drawer.size.y);
  CHECK(drawer.size.x > 10 * app.ui().em);
  CHECK(drawer.size.y > 5 * app.ui().em);
  CHECK(drawer.at.x >= 0);
  CHECK(drawer.at.x + drawer.size.x <= static_cast<float>(look.width));
  CHECK(apart(drawer, timeline));
  CHECK(timeline.size.y > 0);
  CHECK(apart(drawer, in_frame(app, cell)));
  CHECK(apart(drawer, {{0, 0}, {static_cast<float>(look.width), 1.8f * app.ui().em}}));  // the title
}

}  // namespace

TEST_CASE("law: the drawer covers neither the picked pixel nor the transport nor the timeline, whatever it shows") {
  for (const char* id : {"z-buffer", "bsp"}) {
    Lesson lesson = find_lesson(id);
    const Trace trace = run_lesson(lesson);
    CAPTURE(id);
    for (const bool beside_lesson : {true, false})
      for (const Shape& look : looks) {
        CAPTURE(beside_lesson);
        CAPTURE(look.width);
        CAPTURE(look.presenter);
        Settings settings;
        settings.presenter = look.presenter;
        App app(trace, beside_lesson ? &lesson : nullptr, settings, look.width, look.height);
        if (beside_lesson) app.session().to_stop(2);
        else app.session().go_to(trace.size() / 2);
        const Cell cell = test::a_drawn_pixel(app);
        for (const Drawer page : test::all_pages()) {
          CAPTURE(static_cast<int>(page));
          test::open_page(app, page, cell);
          app.settle();
          check_apart(app, look, cell);
          const Place stage = app.stage_place();
          CHECK(apart(app.drawer_place(), stage));
          const float share = stage.size.x * stage.size.y / static_cast<float>(look.width * look.height);
          // Before a class a question with its answers has a third of the window already.
          CHECK(share >= (look.presenter && app.session().question_open() ? 0.25f : 0.3f));
          app.open(Drawer::none);
        }
      }
  }
}

TEST_CASE("the smallest window has the frame beside what is asked, and two runs above it") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 640, 360);
  app.session().go_to(trace.size() / 2);
  const Cell cell = test::a_drawn_pixel(app);
  for (const Drawer page : test::all_pages()) {
    CAPTURE(static_cast<int>(page));
    test::open_page(app, page, cell);
    app.settle();
    check_apart(app, {640, 360, false}, cell);
    app.open(Drawer::none);
  }
  const Trace other = test::record_run("pyramid-behind", {}, Conventions::Interpolation::increments);
  const diff::DiffReport report = diff::compare(trace, other);
  const AgainstRun with{&other, &report, false};
  App both(trace, nullptr, {}, 1280, 720);
  both.show_against(with);
  test::open_page(both, Drawer::history, cell);
  both.settle();
  CHECK(both.drawer_place().at.y + both.drawer_place().size.y <= both.timeline_place().at.y);
  CHECK(test::letters_of(both.ui().fonts).covered.empty());
}

TEST_CASE("Esc and the drawer's button give the room back, and the bytes are those of before") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(900);
  app.session().select(Cell{15, 12});
  const test::Bytes before = test::picture(app);
  for (const Drawer page : test::all_pages()) {
    CAPTURE(static_cast<int>(page));
    app.session().select(Cell{15, 12});
    test::open_page(app, page, Cell{15, 12});
    const bool changed = test::picture(app) != before;
    CHECK(changed);
    test::press(app, SDLK_ESCAPE);
    CHECK(app.drawer() == Drawer::none);
    app.session().select(Cell{15, 12});
    app.session().go_to(900);
    app.session().message.clear();
    const bool same = test::picture(app) == before;
    CHECK(same);
  }
}

TEST_CASE("with the drawer open the window goes on: the mouse steps, selects and takes the keys, and gives them back") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(900);
  test::press(app, SDLK_u);
  test::type(app, "z < 4");
  REQUIRE(app.drawer_has_keys());
  const auto square = [&] { return in_frame(app, Cell{15, 12}); };
  app.settle();
  const Place pixel = square();
  test::click(app, static_cast<int>(pixel.at.x + pixel.size.x / 2), static_cast<int>(pixel.at.y + pixel.size.y / 2));
  CHECK(app.session().selected == Cell{15, 12});
  CHECK_FALSE(app.drawer_has_keys());
  test::press(app, SDLK_RIGHT);
  CHECK(app.session().position() == 901);
  test::type(app, "z");  // zooms, and is not typed
  CHECK(app.ui().view.zoom > 1);
  CHECK(app.typed == "z < 4");
  CHECK(app.drawer() == Drawer::until);
  // A click in the drawer gives the keys back, with nothing lost.
  const Place drawer = app.drawer_place();
  test::click(app, static_cast<int>(drawer.at.x + 40), static_cast<int>(drawer.at.y + drawer.size.y - 20));
  REQUIRE(app.drawer_has_keys());
  test::type(app, ".2");
  CHECK(app.typed == "z < 4.2");
  // Keys that no field has a use for go on.
  test::press(app, SDLK_PAGEDOWN);
  CHECK(app.session().position() > 901);
  test::press(app, SDLK_LEFT, KMOD_LALT);
  CHECK(app.session().selected == Cell{14, 12});
  CHECK(app.typed == "z < 4.2");
}

TEST_CASE("history and why follow the selected pixel, by mouse and by keys") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  app.session().select(Cell{15, 12});
  test::press(app, SDLK_h);
  REQUIRE(app.drawer() == Drawer::history);
  const std::size_t things = app.history().size();
  test::press(app, SDLK_RIGHT, KMOD_LALT);
  app.settle();
  CHECK(app.history_of() == Cell{16, 12});
  CHECK(app.drawer() == Drawer::history);
  app.session().select(Cell{0, 0});  // which nothing reached
  app.settle();
  CHECK(app.history().empty());
  CHECK(app.history_of() == Cell{0, 0});
  app.session().select(Cell{15, 12});
  app.settle();
  CHECK(app.history().size() == things);

  test::press(app, SDLK_y);
  REQUIRE(app.drawer() == Drawer::why);
  CHECK(app.why_of() == Cell{15, 12});
  const std::int32_t polygon = app.why_polygon();
  const std::string sentence = app.why().sentence;
  test::press(app, SDLK_UP, KMOD_LALT);
  app.settle();
  CHECK(app.why_of() == Cell{15, 11});
  CHECK(app.why_polygon() == polygon);
  app.session().select(Cell{0, 0});
  app.settle();
  CHECK(app.why().sentence != sentence);
}

TEST_CASE("tabs ask something else in the same place, and what lies over the window leaves what is typed") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(900);
  test::press(app, SDLK_q);
  test::type(app, "select 1");
  test::press(app, SDLK_p, KMOD_LCTRL);
  REQUIRE(app.overlay() == Overlay::palette);
  test::type(app, "scan");
  app.settle();
  test::press(app, SDLK_ESCAPE);
  CHECK(app.overlay() == Overlay::none);
  CHECK(app.drawer() == Drawer::query);
  test::type(app, "2");
  CHECK(app.typed == "select 12");
  app.settle();
  // Along the title row; each tab is clicked where the mouse says its command.
  const Place drawer = app.drawer_place();
  std::string opened;
  for (float x = drawer.at.x + 4; x < drawer.at.x + drawer.size.x; x += 6) {
    const int px = static_cast<int>(x), py = static_cast<int>(drawer.at.y + app.ui().em);
    test::move_mouse(app, px, py);
    const Drawer before = app.drawer();
    test::click(app, px, py);
    if (app.drawer() != before) opened += std::to_string(static_cast<int>(app.drawer())) + " ";
    if (app.drawer() == Drawer::none) break;
  }
  const auto number = [](Drawer page) { return std::to_string(static_cast<int>(page)) + " "; };
  CHECK(opened == number(Drawer::history) + number(Drawer::why) + number(Drawer::explain) + number(Drawer::until) +
                      number(Drawer::query) + number(Drawer::bookmarks) + number(Drawer::range) +
                      number(Drawer::compare) + number(Drawer::none));
}

TEST_CASE("the drawer's border is pulled, and stays so for whatever is asked next") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_l);
  app.settle();
  const Place before = app.drawer_place();
  const int x = static_cast<int>(before.at.x + 300), y = static_cast<int>(before.at.y - 3);
  test::move_mouse(app, x, y);
  test::mouse_button(app, x, y, true);
  test::move_mouse(app, x, y - 60);
  test::mouse_button(app, x, y - 60, false);
  app.settle();
  CHECK(app.drawer_place().size.y == doctest::Approx(before.size.y + 60).epsilon(0.02));
  CHECK(apart(app.drawer_place(), app.stage_place()));
  const float height = app.drawer_place().size.y;
  test::press(app, SDLK_ESCAPE);
  test::press(app, SDLK_u);
  app.settle();
  CHECK(app.drawer_place().size.y == height);
  CHECK(app.settings().layout.drawer_height != Layout().drawer_height);
  test::press(app, SDLK_ESCAPE);
  test::press(app, SDLK_l, KMOD_LCTRL);
  CHECK(app.settings().layout == Layout());
}

TEST_CASE("where one leading picture is larger beside the drawer, the drawer stands beside it") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  const auto beside = [&] {
    app.settle();
    return app.drawer_place().size.y > app.drawer_place().size.x;
  };
  test::press(app, SDLK_l);
  CHECK_FALSE(beside());  // frame and depth buffer
  app.set_lead("frame");
  CHECK(beside());
}

TEST_CASE("law: with the drawer open, too, the same step has the same bytes, however one got there") {
  const Trace trace = test::record_run("pyramid-behind");
  for (const Drawer page : {Drawer::until, Drawer::bookmarks, Drawer::what_if, Drawer::range, Drawer::query}) {
    CAPTURE(static_cast<int>(page));
    App walked(trace, nullptr, {}, 1280, 720), jumped(trace, nullptr, {}, 1280, 720);
    walked.session().go_to(895);
    (void)test::picture(walked);
    walked.open(page);
    for (int step = 0; step < 5; ++step) walked.session().move(Unit::event, 1), walked.frame();
    walked.resize(900, 600);
    (void)test::picture(walked);
    walked.resize(1280, 720);
    jumped.session().go_to(900);
    jumped.open(page);
    const bool same = test::picture(walked) == test::picture(jumped);
    CHECK(same);
  }
}

TEST_CASE("what an input method sends is typed, also after a key that did something else") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_u);  // with its letter, which is not typed
  SDL_Event editing{};
  editing.type = SDL_TEXTEDITING;
  test::send(app, editing);
  test::send_text(app, "\u00e9");
  CHECK(app.typed == "\u00e9");
  test::press(app, SDLK_DOWN);  // takes a suggestion; no text follows
  test::release(app, SDLK_DOWN);
  const std::string taken = app.typed;
  test::send_text(app, "\u00e9");
  CHECK(app.typed == taken + "\u00e9");
}
