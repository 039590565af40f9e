// Where a reader is: moving, before and after, the lesson's stops and questions, playing.
#include <doctest/doctest.h>

#include "sim/viewer/model/session.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Lesson two_stops(const Trace& trace) {
  Lesson lesson;
  Stop plain, asking;
  plain.text = "Look.";
  plain.position = 10;
  asking.text = "Guess.";
  asking.position = 20;
  asking.question = Question{"Which?", {{"wrong", false, "because"}, {"right", true, "yes"}}};
  Stop same = plain;
  same.position = 20;
  lesson.stops = {plain, asking, same};
  REQUIRE(trace.size() > 40);
  return lesson;
}

}  // namespace

TEST_CASE("what changed is what the last move's unit wrote") {
  const Trace trace = test::record_run("delhi");
  Session s(trace, nullptr);
  s.go_to(trace.size());
  s.move(Unit::polygon, -1);
  const std::int64_t polygon = s.position();
  s.go_to(polygon, Unit::polygon);
  std::size_t written = 0;
  for (std::int64_t p = s.before() + 1; p <= polygon; ++p) written += holds<PixelWrite>(trace.event(p).event);
  CHECK(written == 28);  // the first polygon of the worked example
  CHECK(s.changed().size() == written);
  s.go_to(0);
  CHECK(s.changed().empty());
  CHECK(s.before() == 0);
}

TEST_CASE("where a method has no such unit, or none more that way, the reader stays and is told") {
  const auto stays = [](Session& s, Unit unit, int direction, const std::string& why) {
    const std::int64_t here = s.position();
    s.message.clear();
    s.move(unit, direction);
    CAPTURE(why);
    CAPTURE(s.message);
    CHECK(s.position() == here);
    CHECK(s.message.find(why) == 0);
  };
  const Trace rays = test::record_run_by("ray-casting", "pyramid-behind");
  Session cast(rays, nullptr);
  cast.go_to(100);
  for (const int direction : {1, -1}) {
    stays(cast, Unit::scan_line, direction, "No scan line begins in this trace.");
    stays(cast, Unit::polygon, direction, "No polygon begins in this trace.");
    stays(cast, Unit::span, direction, "No span begins in this trace.");
  }
  // Warnock's method begins with all polygons, then goes from area to area.
  const Trace quarters = test::record_run_by("warnock", "pyramid-behind");
  Session warnock(quarters, nullptr);
  warnock.move(Unit::scan_line, 1);
  stays(warnock, Unit::scan_line, -1, "No earlier area begins;");
  stays(warnock, Unit::polygon, 1, "No later polygon begins;");
  CHECK(warnock.position() > 0);
  const Trace edges = test::record_run_by("hidden-line", "pyramid-behind");
  Session hidden(edges, nullptr);
  hidden.move(Unit::scan_line, 1);
  stays(hidden, Unit::scan_line, -1, "No earlier edge begins;");
  // A Z-buffer: the last scan line and pixel are done at the end, which is said.
  const Trace trace = test::record_run("delhi");
  Session s(trace, nullptr);
  s.go_to(trace.polygons().back().position);
  stays(s, Unit::polygon, 1, "No later polygon begins;");
  for (const Unit unit : {Unit::scan_line, Unit::span, Unit::pixel}) {
    s.go_to(trace.polygons().back().position);
    for (int i = 0; i < 1000 && s.position() < trace.size(); ++i) {
      CHECK(s.message.empty());
      s.move(unit, 1);
    }
    CHECK(s.position() == trace.size());
    CHECK((s.message.find("this is the end") != std::string::npos || unit == Unit::pixel));
  }
}

TEST_CASE("the buffers of before are those of the place before") {
  const Trace trace = test::record_run("delhi");
  Session s(trace, nullptr);
  Replay replay(trace);
  for (std::int64_t at = 1; at <= trace.size(); at += 7) {
    s.go_to(at);
    replay.go_to(at - 1);
    s.looking_back = true;
    CHECK(s.picture() == replay.state().picture);
    s.looking_back = false;
    replay.go_to(at);
    CHECK(s.picture() == replay.state().picture);
  }
}

TEST_CASE("a stop speaks from its position on, and several at one place speak in turn") {
  const Trace trace = test::record_run("delhi");
  const Lesson lesson = two_stops(trace);
  Session s(trace, &lesson);
  CHECK(s.stop() == -1);
  s.next_stop(1);
  CHECK(s.position() == 10);
  CHECK(s.stop() == 0);
  s.move(Unit::event, 1);
  CHECK(s.stop() == 0);
  s.next_stop(-1);  // from between two stops back to the one that speaks
  CHECK(s.position() == 10);
  s.next_stop(1);
  CHECK(s.stop() == 1);
  s.next_stop(1);
  CHECK(s.stop() == 2);
  CHECK(s.position() == 20);
  s.next_stop(1);
  CHECK(s.stop() == 2);
  CHECK_FALSE(s.message.empty());
  s.go_to(0);
  s.go_to(20);
  CHECK(s.stop() == 1);
}

TEST_CASE("stepping into an unanswered question's answer is allowed, and nudged") {
  const Trace trace = test::record_run("delhi");
  Lesson lesson = two_stops(trace);
  lesson.stops.pop_back();
  Session s(trace, &lesson);
  s.to_stop(1);
  CHECK(s.question_open());
  CHECK_FALSE(s.nudged());
  s.move(Unit::event, 1);
  CHECK(s.position() == 21);
  CHECK(s.nudged());
  s.answer(0);
  CHECK(s.question_open());
  CHECK_FALSE(s.nudged());
  s.answer(1);
  CHECK_FALSE(s.question_open());
  s.answer(7);
  CHECK(s.chosen(1) == 1);
}

TEST_CASE("playing says that it waits for the reader and how long, and never runs over an open question") {
  const Trace trace = test::record_run("delhi");
  Lesson lesson = two_stops(trace);
  lesson.stops[0].position = 3;
  lesson.stops[0].text = "seven words stand here to be read";
  Session s(trace, &lesson);
  s.speed = 2;
  double now = 100;
  s.toggle_play();
  for (int i = 0; i < 100 && s.position() < 3; ++i) s.play(now += 0.1);
  REQUIRE(s.position() == 3);
  s.play(now += 0.1);
  CHECK(s.seconds_to_read() == 4);  // 2 + 6/3.5
  CHECK(s.message.find("goes on in 4 s") != std::string::npos);
  const std::string waited = s.message;
  s.play(now += 1);
  CHECK(s.seconds_to_read() == 3);
  CHECK(s.message != waited);  // and it is drawn: App::moment
  CHECK(s.position() == 3);
  s.toggle_play();  // Space: the reader has read
  CHECK(s.playing);
  for (int i = 0; i < 5; ++i) s.play(now += 0.1);
  CHECK(s.position() > 3);
  CHECK(s.seconds_to_read() == 0);
  CHECK(s.message.empty());
  for (int i = 0; i < 300 && s.playing; ++i) s.play(now += 0.1);
  const std::int64_t asks = lesson.stops[1].position;
  CHECK(s.position() == asks);
  CHECK_FALSE(s.playing);
  CHECK(s.message.find("the lesson asks") != std::string::npos);

  // The same where N or a jump led there.
  Session jumped(trace, &lesson);
  jumped.to_stop(1);
  jumped.toggle_play();
  CHECK_FALSE(jumped.playing);
  CHECK(jumped.nudged());
  CHECK(jumped.message.find("the lesson asks") != std::string::npos);
  jumped.answer(0);
  jumped.toggle_play();
  CHECK(jumped.playing);
  for (int i = 0; i < 40; ++i) jumped.play(now += 0.1);  // another stop speaks here, for two seconds
  CHECK(jumped.position() > asks);

  // Several stops may speak at one step: none is passed over.
  lesson.stops[0].position = asks;
  Session both(trace, &lesson);
  both.to_stop(0);
  both.toggle_play();
  for (int i = 0; i < 20 && both.playing; ++i) both.play(now += 0.5);
  CHECK(both.position() == asks);
  CHECK(both.stop() == 1);
  CHECK_FALSE(both.playing);

  Session end(trace, nullptr);
  end.go_to(trace.size());
  end.toggle_play();
  CHECK_FALSE(end.playing);
  CHECK(end.message.find("This is the end") != std::string::npos);
}

TEST_CASE("playing keeps its pace, halts where the lesson asks, and ends at the end") {
  const Trace trace = test::record_run("delhi");
  const Lesson lesson = two_stops(trace);
  Session s(trace, &lesson);
  s.speed = 2;  // 5 steps a second
  s.playing = true;
  double now = 100;
  s.play(now);
  for (int i = 0; i < 21; ++i) s.play(now += 0.05);
  CHECK(s.position() == 5);
  for (int i = 0; i < 300 && s.playing; ++i) s.play(now += 0.1);
  CHECK(s.position() == 20);  // it asks
  CHECK_FALSE(s.playing);

  Session alone(trace, nullptr);
  alone.speed = static_cast<int>(Session::speeds().size()) - 1;
  alone.playing = true;
  int frames = 0;
  for (; alone.playing && frames < 100; ++frames) alone.play(now += 0.016);
  CHECK(alone.position() == trace.size());
  CHECK(frames <= 4);          // two polygons: one a frame
  CHECK(alone.play(now) > 1);  // and then nothing is due
}
