// The three wrong programs' runs that a lesson has the student judge: what it says of them is so.
#include <doctest/doctest.h>

#include <map>
#include <numeric>
#include <string>

#include "sim/classroom/lesson.hpp"
#include "tests/where.hpp"
#include "traces/check/check.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

TEST_CASE(
    "the lesson's wrong runs have one cause each, with as many wrong steps, and as many that follow, as it says") {
  const struct {
    const char* file;
    std::int64_t wrong, follow;
  } runs[] = {{"first", 48, 24}, {"second", 5, 70}, {"third", 2, 4}};
  for (const auto& run : runs) {
    CAPTURE(run.file);
    const CheckReport report = check(open_jsonl(test::in_checkout(std::string("lessons/runs/") + run.file + ".jsonl")));
    CHECK(report.causes.size() == 1);
    CHECK(report.wrong_steps == run.wrong);
    CHECK(report.inherited == run.follow);
  }
}

TEST_CASE("the runs that stand beside lessons end with the pictures of which they speak") {
  const auto pixels = [](const Trace& trace) {
    Replay replay(trace);
    replay.go_to(trace.size());
    std::map<std::string, int> count;
    for (const std::int32_t polygon : replay.state().picture.polygon)
      if (polygon != no_polygon) ++count[*trace.scene().polygons[static_cast<std::size_t>(polygon)].name];
    return count;
  };
  const auto of = [&](const char* name) {
    return pixels(open_jsonl(test::in_checkout(std::string("lessons/runs/") + name + ".jsonl")));
  };
  const auto named = [](const std::map<std::string, int>& count) {
    std::string names;
    for (const auto& [name, how_many] : count) names += name;
    return names;
  };
  Lesson wires = find_lesson("wireframe");
  run_lesson(wires);
  std::vector<std::map<std::string, int>> shown;
  for (const Stop& stop : wires.stops)
    for (const RunBeside& beside : stop.beside) shown.push_back(pixels(*beside.run));
  REQUIRE(shown.size() == 4);
  CHECK(named(shown[0]) == "A");
  CHECK(named(shown[1]) == "ABCDEF");
  const auto all = [](const std::map<std::string, int>& count) {
    return std::accumulate(count.begin(), count.end(), 0, [](int sum, const auto& one) { return sum + one.second; });
  };
  CHECK(all(shown[3]) == 1060);  // as stop 19 says
  CHECK(named(shown[3]) == "ABCJKLQUVW");
  CHECK(named(of("sign")) == "CDE");
  CHECK(named(of("subtree")) == "BW");
  // The same run with all of its subtrees: of what is drawn before them nothing is missing.
  CHECK(named(of("tree")) == "ABW");
  CHECK(of("tree").at("B") == of("subtree").at("B"));
  Lesson lesson = find_lesson("where-the-notes-disagree");
  const auto right = pixels(run_lesson(lesson)), half = of("half");
  CHECK(half.at("W") - right.at("W") == 16);
  CHECK(right.at("A") - half.at("A") == 10);
}

TEST_CASE("of the third of them, the two writes of a wrong compare follow from it, and the next pixel does not") {
  const Trace trace = open_jsonl(test::in_checkout("lessons/runs/third.jsonl"));
  CheckMarks marks;
  check(trace, nullptr, nullptr, &marks);
  std::int64_t compared = 0;
  for (const CheckMarks::Step& one : marks.steps) {
    CAPTURE(one.step);
    const Event& event = trace.event(one.step).event;
    if (one.wrong) compared = one.step;
    const bool follows =
        one.step == compared + 1 ? holds<DepthWrite>(event) : one.step == compared + 2 && holds<PixelWrite>(event);
    CHECK((one.wrong ? holds<DepthCompare>(event) : follows));
  }
}

TEST_CASE("the first of them stores no depth, and check notices it after each pixel but the very last one") {
  const Trace trace = open_jsonl(test::in_checkout("lessons/runs/first.jsonl"));
  std::int64_t stores = 0, pixels = 0;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    stores += get_if<DepthWrite>(&recorded.event) != nullptr;
    pixels += get_if<DepthInterpolate>(&recorded.event) != nullptr;
    return true;
  });
  CHECK(stores == 0);
  CHECK(pixels - 1 == 48);
}
