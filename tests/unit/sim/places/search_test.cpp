// Conditions and the search for steps that fulfil them, against looking at every event of traces of every method.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "sim/places/search.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/polygons_by_hand.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"

using namespace zstep;
using places::Condition, places::Search;
using Way = Search::Way;

namespace {

/// A condition, and the same by hand: of an event, its step and its polygon.
struct Case {
  std::string text;
  std::function<bool(const Event&, std::int64_t step, std::int32_t polygon)> holds;
};

template <class E>
const E* as(const Event& event) {
  return get_if<E>(&event);
}

template <class Test>
auto of_fields(const Event& event, Test&& test) {
  return visit_event([&](const auto& known) { return test(known); }, event);
}

bool at(const Event& event, std::int32_t x, std::int32_t y) {
  const auto pixel = pixel_of(event);
  return pixel && pixel->x == x && pixel->y == y;
}
bool writes(const Event& e) {
  return as<DepthWrite>(e) || as<PixelWrite>(e) || as<PixelPaint>(e) || as<ColorWrite>(e) || as<ColorBlend>(e);
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"not nearer",
       [](const Event& e, std::int64_t, std::int32_t) {
         return (as<DepthCompare>(e) && !as<DepthCompare>(e)->nearer) ||
                (as<TileDepthTest>(e) && !as<TileDepthTest>(e)->nearer) ||
                (as<SampleDepth>(e) && !as<SampleDepth>(e)->nearer);
       }},
      {"depth_compare where nearer",
       [](const Event& e, std::int64_t, std::int32_t) { return as<DepthCompare>(e) && as<DepthCompare>(e)->nearer; }},
      {"x == 9 && y == 7", [](const Event& e, std::int64_t, std::int32_t) { return at(e, 9, 7); }},
      {"touches(9, 7)", [](const Event& e, std::int64_t, std::int32_t) { return at(e, 9, 7); }},
      {"changes(8, 6)", [](const Event& e, std::int64_t, std::int32_t) { return writes(e) && at(e, 8, 6); }},
      {"polygon == 1", [](const Event&, std::int64_t, std::int32_t p) { return p == 1; }},
      {"polygon == 1 and step > 200 and step <= 900",
       [](const Event&, std::int64_t s, std::int32_t p) { return p == 1 && s > 200 && s <= 900; }},
      {"polygon == 0 || polygon == -1", [](const Event&, std::int64_t, std::int32_t p) { return p == 0 || p == -1; }},
      {"polygon_begin", [](const Event& e, std::int64_t, std::int32_t) { return as<PolygonBegin>(e) != nullptr; }},
      {"facing != front", [](const Event& e, std::int64_t,
                             std::int32_t) { return as<FacingTest>(e) && as<FacingTest>(e)->facing != Facing::front; }},
      {"first > last - 2 and y >= 5",
       [](const Event& e, std::int64_t, std::int32_t) {
         return of_fields(e, [](const auto& k) {
           if constexpr (requires {
                           k.first;
                           k.last;
                           k.y;
                         })
             return k.first > k.last - 2 && k.y >= 5;
           else return false;
         });
       }},
      {"z < 0.5 and !(x < 4)",
       [](const Event& e, std::int64_t, std::int32_t) {
         return of_fields(e, [](const auto& k) {
           if constexpr (requires {
                           k.z;
                           k.x;
                         })
             return k.z < 0.5 && k.x >= 4;
           else return false;
         });
       }},
      // What is said of compares alone is settled by neither side for the others.
      {"nearer or vertex == 2",
       [](const Event& e, std::int64_t, std::int32_t) {
         return of_fields(e, [](const auto& k) {
           if constexpr (requires { k.nearer; }) return k.nearer;
           else if constexpr (requires { k.vertex; }) return k.vertex == 2;
           else return false;
         });
       }},
      // Where there is no polygon, none is unlike another; `polygon == -1` asks for such steps.
      {"polygon != 1", [](const Event&, std::int64_t, std::int32_t p) { return p >= 0 && p != 1; }},
      {"not (polygon == 1)", [](const Event&, std::int64_t, std::int32_t p) { return p >= 0 && p != 1; }},
      {"polygon != -1", [](const Event&, std::int64_t, std::int32_t p) { return p != -1; }},
      // Each bound is a step that is there itself.
      {"step <= 50", [](const Event&, std::int64_t s, std::int32_t) { return s <= 50; }},
      {"50 > step", [](const Event&, std::int64_t s, std::int32_t) { return s < 50; }},
      {"step >= 60 and step <= 63.5", [](const Event&, std::int64_t s, std::int32_t) { return s >= 60 && s <= 63; }},
      {"59 < step and 64 > step", [](const Event&, std::int64_t s, std::int32_t) { return s > 59 && s < 64; }},
      {"step == 77", [](const Event&, std::int64_t s, std::int32_t) { return s == 77; }},
      {"step * 2 >= 300 and step < 170",
       [](const Event&, std::int64_t s, std::int32_t) { return s >= 150 && s < 170; }},
  };
  return all;
}

std::vector<std::int64_t> by_hand(const Trace& trace, const Case& c) {
  std::vector<std::int64_t> steps;
  const std::vector<std::int32_t> polygons = test::polygons_by_hand(trace);
  for (std::int64_t step = 1; step <= trace.size(); ++step)
    if (c.holds(trace.event(step).event, step, polygons[static_cast<std::size_t>(step)])) steps.push_back(step);
  return steps;
}

/// All that a search finds, in small slices.
std::vector<std::int64_t> found(const Trace& trace, const Condition& condition, std::int64_t from, Way way) {
  Search search(trace, condition, from, way);
  std::vector<std::int64_t> steps;
  double share = 0;
  while (true) {
    const Search::Result result = search.look(std::chrono::microseconds(0));
    if (result == Search::Result::none) break;
    CHECK(search.share() >= share);
    share = search.share();
    if (result == Search::Result::not_yet) CHECK(share < 1);  // else there were nothing left to look at
    if (result != Search::Result::found) continue;
    steps.push_back(search.step());
    search.go_on();
  }
  CHECK(search.share() == 1);
  return steps;
}

}  // namespace

TEST_SUITE("places") {
  TEST_CASE("of every golden trace: forwards and backwards find what looking at every event finds") {
    std::vector<std::size_t> hits(cases().size());
    test::for_each_golden([&](const std::string& name, const Trace& trace) {
      CAPTURE(name);
      for (std::size_t k = 0; k < cases().size(); ++k) {
        const Case& c = cases()[k];
        CAPTURE(c.text);
        std::vector<std::int64_t> expected = by_hand(trace, c);
        hits[k] += expected.size();
        std::optional<Condition> condition;
        try {
          condition.emplace(trace, c.text);
        } catch (const InputError&) {  // of a method without such fields, or a smaller picture
          const bool one_side_is_there = c.text.find(" or ") != std::string::npos;
          CHECK((expected.empty() || one_side_is_there));
          continue;
        }
        CHECK(found(trace, *condition, 0, Way::forwards) == expected);
        const std::int64_t middle = trace.size() / 2;
        const auto after = std::upper_bound(expected.begin(), expected.end(), middle);
        CHECK(found(trace, *condition, middle, Way::forwards) == std::vector<std::int64_t>(after, expected.end()));
        std::reverse(expected.begin(), expected.end());
        CHECK(found(trace, *condition, trace.size() + 1, Way::backwards) == expected);
      }
    });
    for (std::size_t k = 0; k < cases().size(); ++k) CHECK_MESSAGE(hits[k] > 0, cases()[k].text);
  }

  TEST_CASE("names of polygons, and what a condition tells of where not to look") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    const auto bounds = [&](const char* text) { return Condition(trace, text).bounds(); };
    CHECK(found(trace, Condition(trace, "polygon == B"), 0, Way::forwards) ==
          found(trace, Condition(trace, "\"B\" == polygon"), 0, Way::forwards));
    CHECK(found(trace, Condition(trace, "polygon == B"), 0, Way::forwards) ==
          found(trace, Condition(trace, "polygon == P2"), 0, Way::forwards));
    CHECK(bounds("polygon == B and not nearer").polygon == 2);
    CHECK(bounds("not nearer").kinds.count() == 1);
    CHECK(bounds("12 == x and y == 7 and z < 4").pixel->x == 12);
    CHECK_FALSE(bounds("x == 12 or y == 7").pixel);
    CHECK_FALSE(bounds("not (x == 12 and y == 7)").pixel);
    CHECK(bounds("step >= 10 and 20 > step").first == 10);
    CHECK(bounds("step >= 10 and 20 > step").last == 19);
    CHECK(bounds("step > 10 and step <= 20").first == 11);
    CHECK(bounds("step > 10 and step <= 20").last == 20);
    CHECK(bounds("20.5 >= step").last == 20);
    // Elsewhere an event's polygon need not be the one at work.
    CHECK_FALSE(
        Condition(open_jsonl(test::in_checkout("tests/golden/scan-line.jsonl")), "polygon == 1").bounds().polygon);
  }

  TEST_CASE("a condition is understood as a person types it and as the panes write it") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    const auto same = [&](const std::string& typed, const std::string& text) {
      CAPTURE(typed);
      const auto expected = found(trace, Condition(trace, text), 0, Way::forwards);
      CHECK_FALSE(expected.empty());
      std::string said;
      try {
        CHECK(found(trace, Condition(trace, typed), 0, Way::forwards) == expected);
      } catch (const InputError& error) {
        said = error.what();
      }
      CHECK(said == "");
    };
    same("x = 9", "x == 9");
    same("x=9", "x == 9");
    same("X == 9", "x == 9");
    same("x <> 9", "x != 9");
    same("polygon=B", "polygon == B");
    same("polygon = b", "polygon == B");
    same("Polygon == B", "polygon == B");
    same("NOT nearer", "not nearer");
    same("nearer AND x = 9", "nearer and x == 9");
    same("x == 12 Or y == 3", "x == 12 or y == 3");
    same("compare WHERE NOT nearer", "compare where not nearer");
    same("z < 0,42", "z < 0.42");
    same("changes(8,6)", "changes(8, 6)");
    same("z* < 0.5", "z < 0.5");
    same("0.5 > z* and nearer", "z < 0.5 and nearer");
    same("z*_L < 0.5", "z_left < 0.5");
    same("x_R >= 5", "x_right >= 5");
    same("z*2 < 0.5", "z * 2 < 0.5");
    same("z*x < 3", "z * x < 3");
    same("edge == e0", "edge == 0");
    same("edge = e2", "edge == 2");
    same("e2 == edge", "edge == 2");
    same("line == 5", "y == 5");
    same("scan_line == 5", "y == 5");
    // Depths are not where the scene's vertices are.
    const Condition depth(trace, "z* < 1000");
    for (const std::int64_t step : found(trace, depth, 0, Way::forwards))
      CHECK_FALSE(holds<ViewTransform>(trace.event(step).event));
  }

  TEST_CASE("what is no condition is one line that says what may be typed") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    const auto refused = [&](const std::string& text, const std::string& part) {
      CAPTURE(text);
      const std::string said = test::input_error([&] { Condition(trace, text); });
      CAPTURE(said);
      CHECK(said.find(part) != std::string::npos);
      CHECK(said.find('\n') == std::string::npos);
    };
    refused("", "is empty");
    refused("nearr", "did you mean `nearer`");
    refused("changes(1,5)  )", "left over");
    refused("x", "compare it");
    refused("x and nearer", "compare it");
    refused("nearer + 1 == 2", "is no number");
    refused("nearer == 3", "not of one kind");
    refused("facing == bakc", "one of front, back, edge_on");
    refused("facing < back", "no field, step or kind");
    refused("facing < 3", "is no number");
    refused("polygon == Q", "no polygon of the scene is called `Q`");
    refused("polygon == Bb", "its polygons, nearest first: B, A");
    refused("colour == 3", "its names, nearest first: ");
    refused("edge == q0", "`q0` is no field");
    refused("nearer and vertex == 2", "no step of this trace can fulfil");
    refused("changes(99, 2)", "needs a pixel's column and row");
    refused("changes(1)", "needs a pixel's column and row");
    refused("depth(1, 2) < 3", "there is no `depth(`");
    refused("count(compare) > 3", "zstep query counts");
    refused("compar where nearer", "no step or kind");
    refused("x == 3 and", "is missing");
    refused(std::string(3000, '('), "letters");
    refused(std::string(1500, '('), "nest");
    refused("not nearer )", "left over");
    refused("\"B\"", "stands alone");
  }
}
