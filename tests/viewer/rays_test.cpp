// What the plan of rays and the scene say of a ray: its whole t, the boxes once they are spoken of, and the half-line
// by which a hit is told inside or not; and the name of the pane of glass that is laid over.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/classroom/lesson.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE(
    "law: the half-line in the scene crosses the outline of what is hit once where the point is inside, else not "
    "once") {
  Lesson lesson = find_lesson("ray-casting");
  const Trace trace = run_lesson(lesson);
  App app(trace, nullptr, {}, 1280, 720);
  REQUIRE(app.show_only("scene"));
  int inside = 0, outside = 0;
  for (std::int64_t position = 1; position <= trace.size(); ++position) {
    const Event event = trace.event(position).event;
    const RayHit* hit = get_if<RayHit>(&event);
    if (!hit) continue;
    app.session().go_to(position);
    CAPTURE(position);
    const bool once = test::times_written(app, "1") == 1 && test::times_written(app, "2") == 0;
    CHECK(once == hit->inside);
    CHECK((test::times_written(app, "X") == 1 || !hit->inside));  // a point beside may lie out of sight
    ++(hit->inside ? inside : outside);
  }
  CHECK(inside > 0);
  CHECK(outside > 0);
}

TEST_CASE("the plan of rays marks t where the stop gives the ray's numbers, and boxes from their first test on") {
  Lesson lesson = find_lesson("ray-casting");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  bool tested = false;
  int marked = 0, boxes = 0;
  for (std::size_t k = 0; k < lesson.stops.size(); ++k) {
    const Stop& stop = lesson.stops[k];
    tested = tested || stop.anchor.find("box_test") != std::string::npos;
    app.session().to_stop(static_cast<int>(k));
    CAPTURE(stop.heading);
    const bool gives = std::find(stop.names.begin(), stop.names.end(), "x_0") != stop.names.end();
    CHECK((test::times_written(app, "t = 0") > 0 && test::times_written(app, "t = 1") > 0) == gives);
    marked += gives;
    for (std::size_t box = 0; box < app.session().state().machine.boxes.size() && !tested; ++box)
      CHECK((stop.focus == "ray_tests" || test::times_written(app, "box " + std::to_string(box)) == 0));
    boxes += tested && test::times_written(app, "box 0") > 0;
  }
  CHECK(marked > 0);
  CHECK(boxes > 0);
}

TEST_CASE("a pane of glass has its letter at its outline while it is laid over what is there") {
  Lesson lesson = find_lesson("transparency");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  int named = 0;
  for (std::size_t k = 0; k < lesson.stops.size(); ++k) {
    app.session().to_stop(static_cast<int>(k));
    app.settle();
    const RecordedEvent* event = app.session().event();
    if (!event || !holds<ColorBlend>(event->event) || lesson.stops[k].focus != "frame") continue;
    CAPTURE(lesson.stops[k].heading);
    const std::int32_t polygon = app.session().state().machine.polygon;
    REQUIRE(polygon >= 0);
    CHECK(test::times_written(app, *trace.scene().polygons[static_cast<std::size_t>(polygon)].name) >= 1);
    ++named;
  }
  CHECK(named > 0);
}
