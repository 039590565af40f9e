// Ctrl+P: what it finds, and where that leads.
#include <algorithm>

#include <doctest/doctest.h>

#include "sim/viewer/commands.hpp"
#include "tests/viewer/drive.hpp"
#include "sim/words/explain.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// Types it into the box of Ctrl+P, picks the first row that begins so, and takes it by Enter.
void take(App& app, const std::string& typed, const std::string& title) {
  CAPTURE(typed);
  test::press(app, SDLK_p, KMOD_LCTRL);
  REQUIRE(app.overlay() == Overlay::palette);
  test::type(app, typed);
  app.settle();
  const std::vector<Found>& found = app.found();
  const auto row =
      std::find_if(found.begin(), found.end(), [&](const Found& one) { return one.title.starts_with(title); });
  REQUIRE(row != found.end());
  for (auto k = row - found.begin(); k > 0; --k) test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK(app.overlay() == Overlay::none);
}

}  // namespace

TEST_CASE("Ctrl+P finds steps, pixels, polygons, stops, bookmarks, conditions and what can be opened, and goes there") {
  const Trace trace = test::record_run("delhi");
  Lesson lesson;
  lesson.stops.resize(2);
  lesson.stops[0].heading = "The first line";
  lesson.stops[1].heading = "A tie is kept";
  lesson.stops[1].position = 77;
  App app(trace, &lesson, {}, 1280, 720);
  app.offer([] {
    return std::vector<Offer>{{Offer::What::lesson, "bsp", "The tree of six walls", ""},
                              {Offer::What::scene, "cube", "A cube", ""}};
  });
  take(app, "100", "Go to 100");
  CHECK(app.session().position() == 100);
  take(app, "1, 2", "Select pixel (1, 2)");
  CHECK(app.session().selected == Cell{1, 2});
  take(app, "tie kept", "2. A tie is kept");
  CHECK(app.session().position() == 77);
  CHECK(app.session().stop() == 1);
  const PolygonMark& last = trace.polygons().back();
  const std::string name = "Polygon " + polygon_label(trace.scene(), last.polygon);
  app.session().go_to(0);
  take(app, "polygon", name);
  CHECK(std::any_of(trace.polygons().begin(), trace.polygons().end(), [&](const PolygonMark& mark) {
    return mark.polygon == last.polygon && mark.position == app.session().position();
  }));
  app.session().go_to(0);
  take(app, "not nearer", "Run until not nearer");
  while (app.places().searching()) app.settle();
  const auto* compare = get_if<DepthCompare>(&app.session().event()->event);
  REQUIRE(compare);
  CHECK_FALSE(compare->nearer);
  take(app, "six walls", "The tree of six walls");
  REQUIRE(app.requests.open);
  CHECK(app.requests.open->id == "bsp");
  take(app, "scene cube", "A cube");
  CHECK(app.requests.open->id == "cube");
  take(app, "to the end", "To the end");
  CHECK(app.session().position() == trace.size());
}

TEST_CASE("Ctrl+P finds nothing for what is neither a name nor a place nor a condition, and says so") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_p, KMOD_LCTRL);
  CHECK(app.found().size() == commands().size());
  test::type(app, "no such thing");
  CHECK(app.found().empty());
  const std::int64_t position = app.session().position();
  test::press(app, SDLK_RETURN);
  CHECK(app.overlay() == Overlay::palette);
  CHECK(app.session().position() == position);
}
