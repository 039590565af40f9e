// zstep error: what it writes beside its text (docs/command-line.md shows that).
#include <doctest/doctest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "traces/image/png.hpp"
#include "tests/cli/program.hpp"

using namespace zstep::test;

TEST_CASE("error: a picture, a table and a chart of the errors, and each only once") {
  const Folder folder;
  REQUIRE(run(folder, "record cube --size 24x18 --number-format float32 -o run.ztrace").code == 0);
  const Outcome outcome = run(folder, "error run.ztrace --save e.png --save-errors e.npy --plot e.svg");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(zstep::read_png(folder / "e.png").width == 24);
  CHECK(text_of(folder / "e.npy").find("(18, 24)") != std::string::npos);
  const std::string chart = text_of(folder / "e.svg");
  CHECK(times(chart, ">along the span</text>") == 1);
  CHECK(times(chart, ">along the edge</text>") == 1);
  CHECK(times(outcome.out, "wrote ") == 3);
  CHECK(run(folder, "error run.ztrace --save e.png --plot e.png").code == 2);
  CHECK(run(folder, "error run.ztrace --plot run.ztrace").code == 2);
}

TEST_CASE("error: works from the polygons where there are no spans, and says truly why it cannot work") {
  const Folder folder;
  REQUIRE(run(folder, "record foley -o run.ztrace").code == 0);
  REQUIRE(run(folder, "dump run.ztrace --jsonl | grep -v '\"step\":\"[a-z]*_edge\"\\|\"step\":\"span\"' > few.jsonl")
              .code == 0);
  const Outcome few = run(folder, "error few.jsonl");
  CAPTURE(few.err);
  CHECK(few.code == 0);
  CHECK(has(few.out, "few.jsonl: 66 depths compared with the exact ones"));
  CHECK(has(few.out, "66 of them with the plane of the polygon"));
  REQUIRE(run(folder, "dump run.ztrace --jsonl | grep '\"ztrace\"\\|\"step\":\"compare\"' > none.jsonl").code == 0);
  const Outcome none = run(folder, "error none.jsonl");
  CHECK(none.code == 2);
  CHECK(has(none.err, "none.jsonl: does not say which polygon its depths are of; print polygon_begin before them"));
  REQUIRE(run(folder, "dump run.ztrace --jsonl | grep '\"ztrace\"\\|\"step\":\"polygon\"' > bare.jsonl").code == 0);
  CHECK(has(run(folder, "error bare.jsonl").err, "bare.jsonl: records no depth that is computed at a pixel"));
}

TEST_CASE("error: depths that are no finite numbers are found, and not exact") {
  const Folder folder;
  REQUIRE(run(folder, "record foley -o run.ztrace").code == 0);
  for (const char* word : {"nan", "inf", "-inf"}) {
    CAPTURE(std::string(word));
    const std::string edit = std::string("dump run.ztrace --jsonl | sed '/interpolate_z/s/\"z\":[-0-9.e]*/\"z\":\"") +
                             word + "\"/' > wrong.jsonl";
    REQUIRE(run(folder, edit).code == 0);
    const Outcome outcome = run(folder, "error wrong.jsonl");
    CHECK(outcome.code == 1);
    CHECK(has(outcome.out, "66 depths are no finite number, the first at step "));
    CHECK(has(outcome.out, "largest error \u221e"));
    CHECK(has(run(folder, "error wrong.jsonl --json").out, "\"not_finite\": 66"));
  }
}

TEST_CASE("error: what is stored is held to the bound, and not what was computed before it") {
  const Folder folder;
  REQUIRE(run(folder, "record foley -o run.ztrace").code == 0);
  const Outcome right = run(folder, "error run.ztrace");
  CHECK(right.code == 0);
  CHECK(has(right.out, "every stored depth is within its own bound"));
  for (const char* word : {"\"nan\"", "0.5"}) {
    CAPTURE(std::string(word));
    REQUIRE(run(folder, std::string("dump run.ztrace --jsonl | sed '/write_depth/s/\"z\":[-0-9.e]*/\"z\":") + word +
                            "/' > wrong.jsonl")
                .code == 0);
    const Outcome wrong = run(folder, "error wrong.jsonl");
    CHECK(wrong.code == 1);
    CHECK(!has(wrong.out, "within"));
    CHECK(has(wrong.out, " stored depths are beyond their bounds, which rounding alone does not explain"));
    CHECK(has(wrong.out, "depths that are written are no finite number, the first at step ") == (word[0] == '"'));
  }
}

TEST_CASE("error: without an error there is no step of the largest one, and without attributes no error of theirs") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi --attribute linear -o run.ztrace").code == 0);
  const Outcome exact = run(folder, "error run.ztrace");
  CAPTURE(exact.out);
  CHECK(!has(exact.out, "at step 0"));
  CHECK(has(exact.out, "largest error 0, root mean square 0; every depth is exact"));
  CHECK(has(run(folder, "error run.ztrace --json").out, "\"largest_at_step\": null"));
  REQUIRE(run(folder, "dump run.ztrace --jsonl | grep -v '\"step\":\"span\"' > few.jsonl").code == 0);
  const Outcome few = run(folder, "error few.jsonl");
  CAPTURE(few.out);
  CHECK(!has(few.out, "attributes compared"));
  CHECK(has(few.out, " attributes are left out: nothing in the run says what they are exactly"));
}

TEST_CASE("error: the largest error in ulps and the largest in depth stand with their steps, in text and JSON") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o run.ztrace").code == 0);
  REQUIRE(run(folder, "dump run.ztrace --jsonl > run.jsonl").code == 0);
  std::string text = text_of(folder / "run.jsonl");
  const auto set = [&](std::size_t step, const std::string& z) {
    const std::size_t from = text.find("\"z\":", step) + 4;
    text.replace(from, text.find_first_of(",}", from) - from, z);
  };
  set(text.rfind("{\"step\":\"interpolate_z\""), "50");
  set(text.find("{\"step\":\"interpolate_z\""), "0.0009765625");
  write_text(folder / "wrong.jsonl", text);
  const auto found = nlohmann::json::parse(run(folder, "error wrong.jsonl --json").out);
  const auto steep = std::to_string(found.value("largest_at_step", 0)),
             deep = std::to_string(found.value("largest_depth_at_step", 0));
  CHECK(steep != deep);
  const Outcome told = run(folder, "error wrong.jsonl");
  CAPTURE(told.out);
  CHECK(has(told.out, ", at step " + steep + ", root mean square "));
  CHECK(has(told.out, " in depth, at step " + deep + "\n"));
}

TEST_CASE("error: where no number format is declared, ulps are those of the numbers as they look") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid-behind --size 24x18 --number-format float32 -o run.ztrace").code == 0);
  REQUIRE(run(folder, "dump run.ztrace --jsonl | sed 's/\"number_format\":\"float32\",//' > open.jsonl").code == 0);
  const Outcome declared = run(folder, "error run.ztrace"), open = run(folder, "error open.jsonl");
  CAPTURE(open.out);
  CHECK(has(open.out, "of float32, which its header does not declare (float32, as the numbers look)"));
  const auto largest = [](const Outcome& of) {
    const std::size_t at = of.out.find("largest error");
    return of.out.substr(at, of.out.find(',', at) - at);
  };
  CHECK(largest(declared) == largest(open));
}

TEST_CASE("error: of a header that does not declare what is nearer no compare is said to go the other way") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o run.ztrace").code == 0);
  REQUIRE(run(folder,
              "dump run.ztrace --jsonl | sed 's/,\"nearer\":\"smaller\",\"ties\":\"first\"//' | "
              "sed '/compare/s/\"nearer\":false/\"nearer\":true/' > open.jsonl")
              .code == 0);
  const Outcome open = run(folder, "error open.jsonl");
  CAPTURE(open.out);
  CHECK(open.code == 0);
  CHECK(has(open.out, "0 compares would go the other way; the header does not declare which depth is nearer"));
  CHECK(!has(open.out, "another polygon"));
  CHECK(has(run(folder, "error open.jsonl --json").out, "\"wrong_pixels\": null"));
}

TEST_CASE("error: compares that rounding alone turns are no finding, and others are") {
  const Folder folder;
  write_text(folder / "cards.toml",
             "coordinates = \"screen\"\n[raster]\nwidth = 64\nheight = 64\n"
             "[[polygon]]\nname = \"A\"\npoints = [[2.3, 3.1, 0.1], [60.7, 5.2, 0.7], [11.9, 58.3, 0.33]]\n"
             "[[polygon]]\nname = \"B\"\npoints = [[2.3, 3.1, 0.10000001], [31.5, 4.15, 0.40000001], "
             "[60.7, 5.2, 0.70000001], [11.9, 58.3, 0.33000001]]\n");
  REQUIRE(run(folder, "record cards.toml --number-format float32 -o run.ztrace").code == 0);
  const Outcome right = run(folder, "error run.ztrace");
  CAPTURE(right.out);
  CHECK(right.code == 0);
  CHECK(has(right.out, "113 pixels would show another polygon; no depth of these is beyond its bound, so rounding"));
  CHECK(has(run(folder, "error run.ztrace --json").out, "\"pixels_turned_beyond_bound\": 0"));
  // One of these depths farther off; and no number format, of which there is no bound.
  for (const char* edit : {"s/0.2309327572584[0-9]*/0.2308/", "s/\"number_format\":\"float32\",//"}) {
    CAPTURE(std::string(edit));
    REQUIRE(run(folder, std::string("dump run.ztrace --jsonl | sed '") + edit + "' > wrong.jsonl").code == 0);
    const Outcome wrong = run(folder, "error wrong.jsonl");
    CAPTURE(wrong.out);
    CHECK(wrong.code == 1);
    CHECK(!has(wrong.out, "so rounding explains them"));
  }
}
