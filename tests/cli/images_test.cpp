// A homework's pictures and depths, handed in without steps.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "traces/image/file.hpp"
#include "traces/image/png.hpp"
#include "traces/image/tables.hpp"
#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

/// hw is the homework; in pictures/ is what zstep itself draws of crossing, with the homework's conventions.
void set_up_pictures(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  REQUIRE(shell(folder, "mkdir pictures").code == 0);
  const Outcome drawn = run(folder,
                            "render hw/scenes/crossing.toml --coverage top-left --save pictures/crossing.png "
                            "--save-ids ids.npy --save-depth-raw depth.npy");
  CAPTURE(drawn.err);
  REQUIRE(drawn.code == 0);
}
Outcome grade_pictures(const Folder& folder, const std::string& format = "text") {
  return run(folder, "grade --homework hw pictures --scene crossing --format " + format);
}
template <class Value>
std::vector<Value> values_in(const Folder& folder, const char* file) {
  return std::get<std::vector<Value>>(zstep::read_npy(folder / file).values);
}
void put(const Folder& folder, const std::string& name, const std::string& bytes) {
  zstep::write_file(folder / name, std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}
/// As numpy.save writes it.
template <class Value>
std::string npy_of(const std::vector<Value>& values, const std::string& type, bool columns_first, int version = 1) {
  const std::size_t width = 14, height = 12;
  std::string head =
      "{'descr': '" + type + "', 'fortran_order': " + (columns_first ? "True" : "False") + ", 'shape': (12, 14), }\n";
  std::string bytes = std::string("\x93NUMPY") + static_cast<char>(version) + '\0';
  bytes += static_cast<char>(head.size()), bytes += '\0';
  if (version > 1) bytes += std::string(2, '\0');
  bytes += head;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Value value = values[columns_first ? i % height * width + i / height : i];
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (type[0] == '>') one = std::string(one.rbegin(), one.rend());
    bytes += one;
  }
  return bytes;
}

}  // namespace

TEST_CASE(
    "pictures: a frame and depths earn half of the picture's points each, and the report says that there are no "
    "steps") {
  const Folder folder;
  set_up_pictures(folder);
  const auto polygons = values_in<std::int32_t>(folder, "ids.npy");
  const auto depths = values_in<double>(folder, "depth.npy");
  enum class Has { frame, depth_buffer, both };
  const auto expect = [&](const char* what, Has has_what) {
    CAPTURE(what);
    const Outcome outcome = grade_pictures(folder);
    CAPTURE(outcome.out);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);  // the steps are missing
    CHECK(has(outcome.out, has_what == Has::both ? "\n2.5 of 16.25 points" : "\n1.25 of 16.25 points"));
    CHECK(has(outcome.out, "there are no steps in crossing"));
    if (has_what == Has::both) CHECK(has(outcome.out, "ok picture and depths     right pixels 60 of 60: 2.5 of 2.5"));
    else
      CHECK(
          has(outcome.out, has_what == Has::frame
                               ? "   picture and depths     right colours 60, right depths 0, of 60 each: 1.25 of 2.5\n"
                                 "                            there are no depths, which are half of this part\n"
                               : "   picture and depths     right colours 0, right depths 60, of 60 each: 1.25 of 2.5\n"
                                 "                            no picture was handed in, which is half of this part\n"));
    CHECK(has(outcome.out, "   compares               there are no steps: 0 of 1.5"));
    CHECK_FALSE(has(outcome.out, "--view"));
  };
  expect("a PNG", Has::frame);
  REQUIRE(shell(folder, "rm pictures/*").code == 0);

  const std::vector<std::int64_t> wide(polygons.begin(), polygons.end());
  const std::vector<std::int8_t> narrow(polygons.begin(), polygons.end());
  const std::vector<float> single(depths.begin(), depths.end());
  for (const int version : {1, 2, 3})
    for (const bool columns_first : {false, true}) {
      CAPTURE(version);
      CAPTURE(columns_first);
      put(folder, "pictures/crossing.npy", npy_of(wide, "<i8", columns_first, version));
      put(folder, "pictures/crossing.depth.npy", npy_of(depths, "<f8", columns_first, version));
      expect("both", Has::both);
    }
  put(folder, "pictures/crossing.npy", npy_of(narrow, "|i1", false));
  put(folder, "pictures/crossing.depth.npy", npy_of(single, ">f4", true));
  expect("narrow and turned", Has::both);
  REQUIRE(shell(folder, "rm pictures/crossing.depth.npy").code == 0);
  put(folder, "pictures/crossing.npy", npy_of(depths, "<f8", false));
  expect("depths as SCENE.npy", Has::depth_buffer);
  std::string map = "Pf\n14 12\n-1\n";
  for (std::size_t row = 12; row-- > 0;)
    map.append(reinterpret_cast<const char*>(single.data() + 14 * row), 14 * sizeof(float));
  REQUIRE(shell(folder, "rm pictures/*").code == 0);
  put(folder, "pictures/crossing.pfm", map);
  expect("a float map", Has::depth_buffer);

  const Outcome one = run(folder, "grade --homework hw pictures/crossing.pfm");
  CHECK(has(one.out, "right colours 0, right depths 60, of 60 each: 1.25 of 2.5"));
  CHECK_FALSE(has(one.out, "triangle:"));
  const json all = json::parse(grade_pictures(folder, "json").out);
  CHECK(all["points"] == doctest::Approx(1.25));
  CHECK(all["scenes"][0]["parts"][0]["lost"][0]["why"] == "no_colors");
  CHECK(all["scenes"][0]["from_picture"] == true);
  const json gradescope = json::parse(grade_pictures(folder, "gradescope").out);
  CHECK(gradescope["tests"][0]["output"] ==
        "right colours 0, right depths 60, of 60 pixels each. no picture was handed in, which is half of this part");
  CHECK(gradescope["tests"][1]["output"] == "there are no steps");
  const Outcome shown = run(folder, "grade --homework hw pictures --scene crossing --view --screenshot a.png");
  CHECK(shown.code == 2);
  CHECK(has(shown.err, "there is no run that can be shown"));
}

TEST_CASE("pictures: rung 1 alone is full marks for a picture with its depths") {
  const Folder folder;
  set_up_pictures(folder);
  const std::string text = text_of(folder / "hw/homework.toml");
  write_text(folder / "hw/homework.toml", text.substr(0, text.find("[[part]]\nname = \"compares\"")));
  const Outcome half = grade_pictures(folder);
  CHECK(half.code == 1);
  CHECK(has(half.out, "1.25 of 2.5 points"));
  put(folder, "pictures/crossing.depth.npy", text_of(folder / "depth.npy"));
  const Outcome outcome = grade_pictures(folder);
  CAPTURE(outcome.out);
  CHECK(outcome.code == 0);
  CHECK(has(outcome.out, "\n2.5 of 2.5 points"));
  // And without any part for pictures, they are no submission.
  write_text(folder / "hw/homework.toml",
             text.substr(0, text.find("[[part]]")) + text.substr(text.find("[[part]]\nname = \"compares\"")));
  const Outcome steps = grade_pictures(folder);
  CHECK(steps.code == 2);
  CHECK(
      has(steps.out, "there is no crossing.jsonl; crossing.png, crossing.depth.npy cannot be graded here, only steps"));
}

TEST_CASE("pictures: the first wrong pixel is shown, with both sides") {
  const Folder folder;
  set_up_pictures(folder);
  auto polygons = values_in<std::int32_t>(folder, "ids.npy");
  auto depths = values_in<double>(folder, "depth.npy");
  std::size_t at = 0;
  while (polygons[at] != 0) ++at;
  REQUIRE(shell(folder, "rm pictures/*").code == 0);
  const std::string pixel = "pixel (" + std::to_string(at % 14) + ", " + std::to_string(at / 14) + ")";

  polygons[at] = 1, depths[at] += 0.25;
  put(folder, "pictures/crossing.npy", npy_of(polygons, "<i4", false));
  put(folder, "pictures/crossing.depth.npy", npy_of(depths, "<f8", false));
  const Outcome wrong = grade_pictures(folder);
  CAPTURE(wrong.out);
  CHECK(wrong.code == 1);
  CHECK(has(wrong.out, "right pixels 59 of 60: 2.46 of 2.5"));
  CHECK(has(wrong.out, "The first thing to look at, in crossing, crossing.npy, crossing.depth.npy:\n  " + pixel) !=
        has(wrong.out, "The first thing to look at, in crossing, crossing.depth.npy, crossing.npy:\n  " + pixel));
  CHECK(has(wrong.out, "expected  polygon A, z = "));
  CHECK(has(wrong.out, "yours     polygon B, z = "));

  // A background of 1 is a depth like any other.
  depths = values_in<double>(folder, "depth.npy");
  for (double& z : depths)
    if (std::isinf(z)) z = 1;
  REQUIRE(shell(folder, "rm pictures/crossing.npy").code == 0);
  put(folder, "pictures/crossing.depth.npy", npy_of(depths, "<f8", false));
  const Outcome one = grade_pictures(folder);
  CHECK(has(one.out, "right colours 0, right depths 60, of 168 each"));
  CHECK(has(one.out, "expected  z = ∞\n  yours     z = 1\n"));

  // Rounding to float32 and another order of operations are no mistake; the sixth digit is.
  const auto right = values_in<double>(folder, "depth.npy");
  for (const auto& [off, all] : {std::pair{1e-10, true}, std::pair{1e-5, false}}) {
    depths = right;
    for (double& z : depths) z += off;
    put(folder, "pictures/crossing.depth.npy", npy_of(depths, "<f8", false));
    CHECK(has(grade_pictures(folder).out, "right colours 0, right depths 60, of 60 each") == all);
  }

  // Upside down.
  REQUIRE(shell(folder, "rm pictures/*").code == 0);
  depths = right;
  for (std::size_t i = 0; i < right.size(); ++i) depths[i] = right[(11 - i / 14) * 14 + i % 14];
  put(folder, "pictures/crossing.npy", npy_of(depths, "<f8", false));
  CHECK(has(grade_pictures(folder).out, "The picture is upside down: its first row should be the top one."));
}

TEST_CASE("pictures: links in a submission are not followed") {
  const Folder folder;
  set_up_pictures(folder);
  REQUIRE(shell(folder, "mv pictures/crossing.png right.png && ln -s ../right.png pictures/crossing.png").code == 0);
  const Outcome outcome = grade_pictures(folder);
  CHECK(outcome.code == 2);
  CHECK(has(outcome.out, "there is no crossing.jsonl"));
}

TEST_CASE("pictures: where there is a run, it is graded, and the report says so") {
  const Folder folder;
  set_up_pictures(folder);
  const Outcome made = run(folder, "record hw/scenes/crossing.toml --coverage top-left -o right.ztrace");
  REQUIRE(made.code == 0);
  REQUIRE(shell(folder, "$zstep dump right.ztrace --jsonl | tail -n +2 > pictures/crossing.jsonl").code == 0);
  put(folder, "pictures/crossing.png", "no picture at all");
  const Outcome outcome = grade_pictures(folder);
  CAPTURE(outcome.out);
  CHECK(outcome.code == 0);
  CHECK(has(outcome.out, "16.25 of 16.25 points"));
  CHECK(has(outcome.out, "The run is graded; crossing.png is left aside."));
}

TEST_CASE("pictures: what cannot be read says so in one line, and is no 0") {
  const Folder folder;
  set_up_pictures(folder);
  const auto polygons = values_in<std::int32_t>(folder, "ids.npy");
  const auto depths = values_in<double>(folder, "depth.npy");
  const std::string png = text_of(folder / "pictures/crossing.png");
  const auto table = [&](auto change) {
    auto changed = polygons;
    change(changed);
    return npy_of(changed, "<i4", false);
  };
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    REQUIRE(has(text, from));
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string right = npy_of(depths, "<f8", false), numbers = npy_of(polygons, "<i4", false);
  struct Case {
    const char* name;
    std::string bytes, message;
  };
  const std::vector<Case> cases{
      {"crossing.png", "", "is no PNG"},
      {"crossing.png", png.substr(0, png.size() / 2), "is no PNG"},
      {"crossing.png", "\x89PNG\r\n\x1a\n" + std::string(1000, '\0'), "is no PNG"},
      {"crossing.png", std::string(4 << 20, '\0'), "is larger than any picture of 14x12 pixels"},
      {"crossing.npy", std::string(4 << 20, '\0'), "is larger than any picture of 14x12 pixels"},
      {"crossing.npy", "", "is no .npy"},
      {"crossing.npy", right.substr(0, 9), "is no .npy"},
      {"crossing.npy", right.substr(0, 40), "is cut off"},
      {"crossing.npy", right.substr(0, right.size() - 1), "is cut off"},
      {"crossing.npy", with(right, "NUMPY\x01", "NUMPY\x09"), "version 9"},
      {"crossing.npy", with(right, "NUMPY\x01", "NUMPY\x02"), "is cut off"},
      {"crossing.npy", with(right, "(12, 14)", "(14, 12)"), "rows come first"},
      {"crossing.npy", with(right, "(12, 14)", "(11, 14)"), "is 14x11 pixels, but the scene is 14x12 pixels"},
      {"crossing.npy", with(right, "(12, 14)", "(168)   "), "two-dimensional"},
      {"crossing.npy", with(right, "(12, 14)", "(99999999999999999999, 14)"), "is too large"},
      {"crossing.npy", with(right, "(12, 14)", "(12,-14)"), "two-dimensional"},
      {"crossing.npy", with(right, "'<f8'", "'|O' "), "another type of numbers"},
      {"crossing.npy", with(right, "'<f8'", "'<c8'"), "another type of numbers"},
      {"crossing.npy", with(right, "'<f8'", "'|b1'"), "another type of numbers"},
      {"crossing.npy", with(right, "descr", "des\x1b["), "has no 'descr' in its head"},
      {"crossing.npy", table([](auto& all) { all[5] = 2; }), "polygons are counted from 0 to 1; -1 is the background"},
      {"crossing.npy", table([](auto& all) { all[5] = -2; }), "has the polygon -2"},
      {"crossing.depth.npy", numbers, "has whole numbers"},
      {"crossing.pfm", "Pf\n14 12\n-1\n", "has not the 672 bytes"},
      {"crossing.pfm", "Pf\n99999 99999\n-1\n", "99999x99999 numbers"},
  };
  for (const Case& one : cases) {
    CAPTURE(one.name);
    CAPTURE(one.message);
    REQUIRE(shell(folder, "rm -f pictures/*").code == 0);
    put(folder, std::string("pictures/") + one.name, one.bytes);
    const Outcome outcome = grade_pictures(folder);
    CAPTURE(outcome.out);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.out, std::string("This cannot be graded:\n  pictures/") + one.name + ": "));
    CHECK(has(outcome.out, one.message));
    CHECK_FALSE(has(outcome.out, "\x1b"));
    const json result = json::parse(grade_pictures(folder, "prairielearn").out);
    CHECK(result["gradable"] == false);
  }
}
