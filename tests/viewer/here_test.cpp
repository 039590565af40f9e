// What a right click offers: of a pixel, a line of code, a place in time, a number; taken by mouse or by keys.
#include <algorithm>

#include <doctest/doctest.h>
#include <imgui_internal.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

bool offers(const App& app, const std::string& part) {
  return std::any_of(app.here().begin(), app.here().end(),
                     [&](const HereLine& line) { return line.text.find(part) != std::string::npos; });
}

void right_click(App& app, int x, int y) { test::click(app, x, y, SDL_BUTTON_RIGHT); }

}  // namespace

TEST_CASE("a right click on a pixel offers what can be asked of it, keys take a line, Esc none") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  app.settle();
  right_click(app, 592, 208);
  REQUIRE(app.overlay() == Overlay::here);
  CHECK(offers(app, "All that happened to pixel"));
  CHECK_FALSE(app.session().selected);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.overlay() == Overlay::none);
  CHECK_FALSE(app.session().selected);
  right_click(app, 592, 208);
  test::press(app, SDLK_RETURN);
  CHECK(app.drawer() == Drawer::history);
  // The other questions about a pixel begin with it.
  for (const auto& [text, drawer] : {std::pair("Run until", Drawer::until), {"Compare this run", Drawer::compare}}) {
    right_click(app, 592, 208);
    const auto line = std::find_if(app.here().begin(), app.here().end(),
                                   [&](const HereLine& one) { return one.text.starts_with(text); });
    REQUIRE(line != app.here().end());
    app.take_here(static_cast<std::size_t>(line - app.here().begin()));
    CHECK(app.drawer() == drawer);
    CHECK(app.session().selected);
    app.open(Drawer::none);
    app.settle();
  }
  right_click(app, 592, 208);
  test::press(app, SDLK_RETURN);
  CHECK(app.drawer() == Drawer::history);
  REQUIRE(app.session().selected);
  CHECK(app.history_of() == *app.session().selected);
  test::press(app, SDLK_ESCAPE);
  right_click(app, 592, 208);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK((app.drawer() == Drawer::why_ask || app.drawer() == Drawer::why));
}

TEST_CASE("a right click on a place in time goes there or repeats from it, on a line of code runs to it") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.settle();
  const int strip = 720 - static_cast<int>(timeline_height(app.ui()));
  right_click(app, 640, strip);
  REQUIRE(app.overlay() == Overlay::here);
  REQUIRE(offers(app, "Go to step"));
  test::press(app, SDLK_RETURN);
  CHECK(app.overlay() == Overlay::none);
  CHECK(std::abs(app.session().position() - trace.size() / 2) <= trace.size() / 100 + 1);
  right_click(app, 640, strip);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().loops());
  const std::int64_t here = app.session().position();
  right_click(app, 120, 120);
  REQUIRE(offers(app, "next time this line runs"));
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() != here);
}

TEST_CASE("a number of a formula asks the same by a right click as by a click, and can be copied") {
  const Trace trace = test::record_run("delhi");
  const auto at = trace.next(0, [](const RecordedEvent& e) { return holds<SpanBegin>(e.event); });
  REQUIRE(at);
  App left(trace, nullptr, {}, 1280, 720), right(trace, nullptr, {}, 1280, 720);
  for (App* app : {&left, &right}) app->session().go_to(*at), app->settle();
  int numbers = 0, others = 0;
  for (int y = 340; y < 560; y += 9)
    for (int x = 20; x < 280; x += 13) {
      test::click(left, x, y), right_click(right, x, y);
      CAPTURE(x);
      CAPTURE(y);
      const bool asks = left.drawer() == Drawer::explain;
      CHECK(asks == (right.overlay() == Overlay::here && offers(right, "Where this number comes from")));
      if (asks) {
        if (offers(right, "Copy ")) ++numbers;
        test::press(right, SDLK_RETURN);
        REQUIRE(right.drawer() == Drawer::explain);
        CHECK(right.chain().links.size() == left.chain().links.size());
        CHECK(right.picked == left.picked);
        const bool same = test::picture(right) == test::picture(left);
        CHECK(same);
        others += left.picked > 0;
      }
      for (App* app : {&left, &right}) app->open(Drawer::none), app->session().go_to(*at), app->settle();
    }
  CHECK(numbers > 3);
  CHECK(others > 0);
}

TEST_CASE("what a right click offers stands within the window, wherever the mouse is, and names the keys that do it") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 900, 600);
  app.session().go_to(trace.size() / 2);
  app.settle();
  int opened = 0;
  for (int x = 5; x < 900; x += 41)
    for (int y = 5; y < 600; y += 37) {
      right_click(app, x, y);
      if (app.overlay() == Overlay::here) {
        ++opened;
        for (const HereLine& line : app.here()) {
          CAPTURE(line.text);
          CHECK((line.command[0] == '\0' || command_called(line.command) != nullptr));
          CHECK((line.command[0] != '\0' || line.first || line.asks || !line.copies.empty()));
        }
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
          if (window->Active && std::string(window->Name) == "here") {
            CHECK(window->Pos.x >= 0);
            CHECK(window->Pos.y >= 0);
            CHECK(window->Pos.x + window->Size.x <= 900);
            CHECK(window->Pos.y + window->Size.y <= 600);
          }
      }
      app.open(Drawer::none);
    }
  CHECK(opened > 20);
}

TEST_CASE("a right click in a table copies a number, its row or the whole table") {
  const Trace trace = test::record_run("foley");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(14);
  app.set_lead("edge_table");
  app.settle();
  const auto place = std::find_if(app.ui().row_places.begin(), app.ui().row_places.end(),
                                  [](const auto& row) { return row.first.first == "edges"; });
  REQUIRE(place != app.ui().row_places.end());
  const int y = static_cast<int>(place->second.at.y + place->second.size.y / 2),
            left = static_cast<int>(place->second.at.x);
  bool number_seen = false;
  for (int x = left + 4; x < left + 300; x += 6) {
    right_click(app, x, y);
    REQUIRE(app.overlay() == Overlay::here);
    REQUIRE(offers(app, "Copy this row"));
    REQUIRE(offers(app, "Copy the table"));
    CHECK(offers(app, "Where this number comes from") == (app.here().size() == 4));
    if (app.here().size() == 4 && !number_seen) {
      number_seen = true;
      app.picked = 1;
      test::press(app, SDLK_RETURN);
      REQUIRE(app.requests.clipboard);
      CHECK(std::stod(*app.requests.clipboard) >= 0);
    }
    test::press(app, SDLK_ESCAPE);
  }
  CHECK(number_seen);
  right_click(app, left + 4, y);
  app.picked = static_cast<int>(app.here().size()) - 1;
  test::press(app, SDLK_RETURN);
  REQUIRE(app.requests.clipboard);
  const std::string table = *app.requests.clipboard;
  CHECK(table.starts_with("y\tedge\tleaves\tx\t1/m\t"));
  CHECK(std::count(table.begin(), table.end(), '\n') ==
        static_cast<std::ptrdiff_t>(app.session().state().machine.edge_table.size()) + 1);
}

TEST_CASE("a right click on a polygon of the scene from outside leads to where the run begins it") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  app.ui().from_outside = true;
  app.set_lead("scene");
  app.settle();
  bool offered = false;
  for (int y = 60; y < 480 && !offered; y += 12)
    for (int x = 756; x < 1260 && !offered; x += 12) {
      right_click(app, x, y);
      offered = app.overlay() == Overlay::here && app.here().front().text == "Back to where work on polygon B began";
      if (!offered) test::press(app, SDLK_ESCAPE);
    }
  REQUIRE(offered);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() < trace.size());
  REQUIRE(app.session().event());
  CHECK(app.session().state().machine.polygon == 1);
}
