// What a person types to name a place: understood whole, or refused with what is written most like it.
#include <doctest/doctest.h>

#include <cmath>

#include "sim/places/typed_place.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/where.hpp"

using namespace zstep;
using places::Place;

TEST_SUITE("places") {
  TEST_CASE("what is typed for a place is understood whole, or it is none") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    const Raster& raster = trace.scene().raster;
    REQUIRE(trace.size() > 400);
    Lesson lesson;
    lesson.stops.resize(3);
    lesson.stops[2].position = 77;
    const places::Bookmarks marks;
    const auto at = [&](const std::string& text, std::int64_t from = 100) {
      return places::find_place({trace, marks, &lesson, from}, text, "go to");
    };
    const auto step = [&](const std::string& text, std::int64_t from = 100) {
      CAPTURE(text);
      const std::string fault = test::input_error([&] { at(text, from); });
      CHECK(fault == "no error");
      if (fault != "no error") return std::int64_t{-1};
      CHECK_FALSE(at(text, from).pixel);
      return at(text, from).step;
    };
    const auto pixel = [&](const std::string& text, std::int32_t x, std::int32_t y) {
      CAPTURE(text);
      const std::string fault = test::input_error([&] { at(text); });
      CHECK(fault == "no error");
      if (fault != "no error") return;
      const Place place = at(text);
      REQUIRE(place.pixel);
      CHECK(place.pixel->x == x);
      CHECK(place.pixel->y == y);
      CHECK(place.step == 100);  // selecting moves nothing
    };
    CHECK(step("12041") == 12041);
    CHECK(step(" 12\u00a0041 ") == 12041);
    CHECK(step("1,000") == 1000);
    CHECK(step("1 200") == 1200);
    CHECK(step("12'041'000") == 12041000);
    CHECK(step("Step 5") == 5);
    CHECK(step("step 1 200") == 1200);
    CHECK(step("007") == 7);
    CHECK(step("999999999999999999999999") > trace.size());
    CHECK(step("+5") == 105);
    CHECK(step("-5") == 95);
    CHECK(step("\u22125") == 95);
    CHECK(step("- 5", 3) == 0);
    CHECK(step("37.5 %") == std::llround(0.375 * static_cast<double>(trace.size())));
    CHECK(step("37,5%") == step("37.5 %"));
    CHECK(step("end") == trace.size());
    CHECK(step("beginning") == 0);
    CHECK(step("stop 3") == 77);
    CHECK(at("stop 3").stop == 2);

    const auto begins = [&](std::int32_t polygon) {
      for (const PolygonMark& mark : trace.polygons())
        if (mark.polygon == polygon) return mark.position;
      return std::int64_t{-1};
    };
    REQUIRE(begins(1) > 0);
    const std::string name = *trace.scene().polygons[1].name;
    for (const std::string text : {"p1", "p 1", "P1", "Polygon 1", name.c_str()}) CHECK(step(text, 0) == begins(1));
    CHECK(step("polygon " + name, 0) == begins(1));
    CHECK(step("POLYGON " + name, 0) == begins(1));
    CHECK(step(name, trace.size()) == begins(1));  // there is no next
    CHECK(at("p 1", 0).unit == Unit::polygon);

    pixel("9 7", 9, 7);
    pixel("9 12", 9, 12);
    pixel("9,7", 9, 7);
    pixel("(9, 7)", 9, 7);
    pixel("pixel 9 7", 9, 7);
    pixel("pixel (9,7)", 9, 7);
    pixel("Pixel 9, 7", 9, 7);
    REQUIRE(raster.width < 100);
    CHECK(step("9,170") == 9170);  // there is no such pixel
    CHECK(step("line 5", 0) == step("y = 5", 0));
    CHECK(step("scan line 5", 0) == step("line 5", 0));
    CHECK(get<ScanLineBegin>(trace.event(step("line 5", 0)).event).y == 5);
    CHECK(at("line 5", trace.size()).note.find("No later work on scan line 5") == 0);

    for (const char* const text : {"", " ", "1e5", "12.5", "line", "line -3", "3 line", "9,", "9, 17, 3", "-9, 17",
                                   "p 3 4 x", "5'", "(5)", "1 0 1", "step", "pixel 9", "nothing"}) {
      CAPTURE(text);
      const std::string said = test::input_error([&] { at(text); });
      CHECK(said.starts_with("go to: "));
      CHECK(said.find("type a step (12041, +5)") != std::string::npos);
    }
    const auto refused = [&](const std::string& text, const std::string& part) {
      CAPTURE(text);
      const std::string said = test::input_error([&] { at(text); });
      CAPTURE(said);
      CHECK(said.find(part) != std::string::npos);
    };
    refused("1e1 %", "is no part of a trace");
    refused("101 %", "'101 %' is no part of a trace; give 0% to 100%");
    refused("stop 4", "there is no stop 4; the lesson has the stops 1 to 3");
    refused("p 99", "there is no polygon 99");
    refused("99, 99", "there is no pixel (99, 99)");
    refused("polygon Bb", "nearest first: B, ");
    refused("line 4000", "scan line 4000");
  }

  TEST_CASE("what could be a step or a pixel is asked about where both are there") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    Scene wide = trace.scene();
    wide.raster.width = wide.raster.height = 200;
    const Trace large = test::recorded_by("z-buffer", wide);
    REQUIRE(large.size() > 1100);
    const places::Bookmarks marks;
    const auto at = [&](const std::string& text) {
      return places::find_place({large, marks, nullptr, 3}, text, "go to");
    };
    CHECK(test::input_error([&] { at("1,100"); }) ==
          "go to: 1,100 may be a step or a pixel; type step 1100 or pixel 1 100");
    CHECK(at("1 100").step == 1100);  // as zstep writes steps
    CHECK(at("1,000").step == 1000);  // nobody writes a row so
    CHECK(at("1, 100").pixel);
    CHECK(test::input_error([&] { at("stop 1"); }).find("there is no lesson here") != std::string::npos);
  }
}
