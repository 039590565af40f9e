// zstep diff, as a person runs it.
#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "tests/cli/program.hpp"
#include "tests/exr_bytes.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

TEST_CASE("diff: the same is exit code 0, rounding too, a difference is 1, what cannot be compared is 2") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid -o a.ztrace").code == 0);
  REQUIRE(run(folder, "dump a.ztrace --jsonl > a.jsonl").code == 0);
  REQUIRE(run(folder, "record pyramid --interpolation increments -o b.ztrace").code == 0);
  REQUIRE(run(folder, "record cube -o c.ztrace").code == 0);
  const Outcome same = run(folder, "diff a.ztrace a.jsonl");
  CHECK(same.code == 0);
  CHECK(has(same.out, "All steps that both have are the same, to the last bit."));
  const Outcome rounding = run(folder, "diff a.ztrace b.ztrace");
  CHECK(rounding.code == 0);
  CHECK(has(rounding.out, "The runs differ only by rounding"));
  const Outcome other = run(folder, "diff a.ztrace c.ztrace");
  CHECK(other.code == 1);
  CHECK(has(other.out, "the vertices of the two scenes differ"));
  CHECK(run(folder, "diff a.ztrace nowhere.ztrace").code == 2);
  CHECK(run(folder, "record pyramid --size 16x16 -o small.ztrace").code == 0);
  const Outcome sizes = run(folder, "diff a.ztrace small.ztrace");
  CHECK(sizes.code == 2);
  CHECK(has(sizes.err, "small.ztrace: is 16x16 pixels, but A is 32x32"));
  CHECK(run(folder, "diff a.ztrace a.jsonl --html a.jsonl").code == 2);  // never over what is read
}

TEST_CASE("diff: a cause stands with both runs' lines, numbers and formulas, what follows is counted") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o a.ztrace").code == 0);
  REQUIRE(run(folder, "dump a.ztrace --jsonl > a.jsonl").code == 0);
  // The second span of the run begins farther away, and its pixels go on from there.
  const std::string text = text_of(folder / "a.jsonl");
  const std::size_t span = text.find("\"step\":\"span\"", text.find("\"step\":\"span\"", text.find("\n")) + 1);
  const std::size_t z = text.find("\"z_left\":", span) + 9;
  std::string wrong = text;
  wrong.insert(z, "1");
  write_text(folder / "b.jsonl", wrong);
  const Outcome outcome = run(folder, "diff a.jsonl b.jsonl --json");
  CHECK(outcome.code == 1);
  const auto report = nlohmann::json::parse(outcome.out);
  REQUIRE(report["causes"].size() >= 1);
  const auto& cause = report["causes"][0];
  CHECK(cause["kind"] == "span_begin");
  CHECK(cause["part"] == "different");
  CHECK(cause["what"] == "B computes it wrongly from its own operands");
  CHECK(has(cause["b"]["where"], "b.jsonl:"));
  CHECK(has(cause["b"]["fields"][0], "z_left = 1"));
  CHECK(report["kinds"]["depth_compare"]["different"] == 0);  // its depths were not changed
  const Outcome page = run(folder, "diff a.jsonl b.jsonl --html page.html");
  CHECK(page.code == 1);
  const std::string html = text_of(folder / "page.html");
  CHECK(times(html, "<img src=\"data:image/png;base64,iVBORw0KGgo") == 3);
  CHECK(times(html, "<script") == 0);
  for (const char* elsewhere : {"http:", "https:"}) CHECK(times(html, elsewhere) == 0);
}

TEST_CASE("diff: against depths and pictures of other programs") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid -o a.ztrace").code == 0);
  REQUIRE(run(folder, "render pyramid --save-depth-raw same.npy --save same.png").code == 0);
  REQUIRE(run(folder, "render pyramid --phi 50 --save-depth-raw other.npy --save other.png").code == 0);
  CHECK(run(folder, "diff a.ztrace same.npy").code == 0);
  CHECK(run(folder, "diff a.ztrace same.png").code == 0);
  const Outcome depths = run(folder, "diff a.ztrace other.npy");
  CHECK(depths.code == 1);
  CHECK(has(depths.out, "The first from the top is ("));
  CHECK(run(folder, "diff a.ztrace other.png").code == 1);
  // A portable float map: text, then rows from the bottom up, the lowest byte first.
  std::string pfm = "Pf\n32 32\n-1.0\n";
  pfm.append(32 * 32 * 4, '\0');
  write_text(folder / "zero.pfm", pfm);
  CHECK(run(folder, "diff a.ztrace zero.pfm").code == 1);
  write_text(folder / "short.pfm", pfm.substr(0, 100));
  const Outcome damaged = run(folder, "diff a.ztrace short.pfm");
  CHECK(damaged.code == 2);
  CHECK(has(damaged.err, "short.pfm: has not the 4096 bytes of 32x32 numbers"));
}

TEST_CASE("diff: one sentence does not contradict another") {
  const Folder folder;
  REQUIRE(run(folder, "record foley -o a.ztrace").code == 0);
  REQUIRE(run(folder, "dump a.ztrace --jsonl > a.jsonl").code == 0);
  // What is not compared is no cause.
  REQUIRE(run(folder, "dump a.ztrace --jsonl | grep -v '\"step\":\"retire_edge\"' > b.jsonl").code == 0);
  const Outcome retired = run(folder, "diff b.jsonl a.ztrace");
  CHECK(retired.code == 0);
  CHECK(has(retired.out, "A never records edge_retire: not compared"));
  CHECK(has(retired.out, "All steps that both have are the same, to the last bit."));
  // Which convention differs is said, and only that.
  REQUIRE(run(folder, "dump a.ztrace --jsonl | sed 's/\"ties\":\"first\"/\"ties\":\"last\"/' > c.jsonl").code == 0);
  const Outcome ties = run(folder, "diff a.ztrace c.jsonl");
  CHECK(has(ties.out, "the headers differ: A keeps the first of equal depths, B takes the last of equal depths"));
  CHECK_FALSE(has(ties.out, "is nearer"));
  // Depths that are no numbers, and what was never drawn.
  REQUIRE(run(folder, "dump a.ztrace --jsonl | sed '/write_depth/s/\"z\":[-0-9.e]*/\"z\":\"nan\"/' > d.jsonl").code ==
          0);
  const Outcome numbers = run(folder, "diff a.ztrace d.jsonl");
  CHECK(numbers.code == 1);
  CHECK(has(numbers.out, "66 have a depth that is no finite number in one of the two."));
  REQUIRE(run(folder, "dump a.ztrace --jsonl | sed '/\"step\":\"clear\"/s/\"z\":\"inf\"/\"z\":7/' > e.jsonl").code ==
          0);
  const Outcome cleared = run(folder, "diff a.ztrace e.jsonl");
  CHECK(has(cleared.out,
            "The pictures are the same, all 224 pixels. Where nothing is drawn the depth is \u221e in A, 7 in B."));
}

TEST_CASE("diff: between two methods what each did at the pixels that differ is told") {
  const Folder folder;
  REQUIRE(run(folder, "record cyclic -o a.ztrace").code == 0);
  REQUIRE(run(folder, "record cyclic --algorithm painter -o b.ztrace").code == 0);
  const Outcome outcome = run(folder, "diff a.ztrace b.ztrace");
  CHECK(outcome.code == 1);
  CHECK(has(outcome.out, "10 pixels show polygon B in run A, polygon A in run B; the first is (20, 19)."));
  CHECK(has(outcome.out,
            "Run B draws polygon A (step 485) over polygon B (step 372), which is nearer: z = 0.4379 against "));
  CHECK(has(run(folder, "diff a.ztrace b.ztrace --html page.html").out, "wrote page.html"));
  CHECK(has(text_of(folder / "page.html"), "10 pixels show polygon B in run A"));
}

TEST_CASE("diff: each convention in which the headers differ is named") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid -o a.ztrace").code == 0);
  const std::vector<std::pair<const char*, const char*>> others{
      {"--depth view", "which z is interpolated"},
      {"--interpolation increments", "how depths are interpolated"},
      {"--coverage inclusive", "which pixels a span covers"},
      {"--number-format float32", "the number format"},
      {"--positions integer", "where vertices are on the raster"},
      {"--attribute linear", "how an attribute is interpolated"}};
  for (const auto& other : others) {
    const std::string option = other.first, what = other.second;
    CAPTURE(option);
    REQUIRE(run(folder, "record pyramid " + option + " -o b.ztrace").code == 0);
    CHECK(has(run(folder, "diff a.ztrace b.ztrace").out, "the headers differ: " + what));
  }
  REQUIRE(run(folder, "record pyramid --number-format fixed16 -o a.ztrace").code == 0);
  REQUIRE(run(folder, "record pyramid --number-format fixed16 --rounding down -o b.ztrace").code == 0);
  CHECK(has(run(folder, "diff a.ztrace b.ztrace").out, "the headers differ: how quotients are rounded"));
}

TEST_CASE("two runs in one window: view --against, and diff --view where they first part") {
  const Folder folder;
  REQUIRE(run(folder, "record foley -o a.ztrace").code == 0);
  REQUIRE(run(folder, "dump a.ztrace --jsonl | sed 's/\"dx_dy\":1.5/\"dx_dy\":1.25/' > b.jsonl").code == 0);
  const Outcome diff = run(folder, "diff a.ztrace b.jsonl --view --screenshot diff.png");
  CHECK(diff.code == 1);
  CHECK(has(diff.out, "wrote diff.png: the viewer, 1280x720 pixels"));
  CHECK(run(folder, "diff a.ztrace a.ztrace --view --screenshot same.png").code == 0);
  CHECK(run(folder, "view a.ztrace --against b.jsonl --at 60 --screenshot both.png").code == 0);
  CHECK(run(folder, "view a.ztrace --at 60 --screenshot one.png").code == 0);
  CHECK(text_of(folder / "both.png") != text_of(folder / "one.png"));
  // Wrong input: a scene, another size, a picture, the run itself as the output.
  CHECK(has(run(folder, "view foley --against b.jsonl --screenshot x.png").err, "foley: is no trace"));
  CHECK(run(folder, "record pyramid -o c.ztrace").code == 0);
  CHECK(run(folder, "view a.ztrace --against c.ztrace --screenshot x.png").code == 2);
  CHECK(run(folder, "diff a.ztrace both.png --view --screenshot x.png").code == 2);
  CHECK(run(folder, "diff a.ztrace b.jsonl --screenshot x.png").code == 2);
  CHECK(run(folder, "view a.ztrace --against b.jsonl --screenshot b.jsonl").code == 2);
}

TEST_CASE("check and diff go up to a step that cannot be, and name it") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o a.ztrace").code == 0);
  REQUIRE(run(folder, "dump a.ztrace --jsonl | sed '40s/\"y\":[0-9]*/\"y\":99/' > b.jsonl").code == 0);
  const Outcome check = run(folder, "check b.jsonl");
  CHECK(check.code == 1);
  CHECK(has(check.out, "The run is judged up to a step that is impossible:\nb.jsonl:40:"));
  CHECK(has(check.out, "row 99 lies outside the raster"));
  const Outcome diff = run(folder, "diff a.ztrace b.jsonl");
  CHECK(diff.code == 1);
  CHECK(has(diff.out, "compared up to a step that is impossible: b.jsonl:40:"));
  CHECK(times(diff.out, "has this step") == 0);  // what comes after it may be there
  const Outcome turned = run(folder, "diff b.jsonl a.ztrace");
  CHECK(turned.code == 1);
  CHECK(times(turned.out, "has this step") == 0);
  CHECK(run(folder, "info b.jsonl").code == 2);
}

TEST_CASE("diff tells of causes beyond a step that does not go with what was before it") {
  const Folder folder;
  REQUIRE(run(folder, "record cube --size 20x15 -o a.ztrace").code == 0);
  // An edge moves that never entered; and in the second run the last pixel is another polygon's, besides.
  REQUIRE(run(folder, "dump a.ztrace --jsonl | sed '54s/\"edge\":3/\"edge\":9/' > b.jsonl").code == 0);
  REQUIRE(has(run(folder, "check b.jsonl").out, "this step is impossible: edge 9 is not in the active edge list"));
  REQUIRE(
      shell(folder, "tac b.jsonl | sed '/write_pixel/{s/\"polygon\":[0-9]*/\"polygon\":5/;:a;n;ba}' | tac > c.jsonl")
          .code == 0);
  const Outcome alike = run(folder, "diff a.ztrace b.jsonl");
  CHECK(alike.code == 1);
  CHECK(has(alike.out, "e9"));
  CHECK(alike.err.empty());
  const Outcome last = run(folder, "diff a.ztrace c.jsonl");
  CHECK(last.code == 1);
  CHECK(times(last.out, "write_pixel") > 0);
  CHECK(run(folder, "diff c.jsonl a.ztrace").code == 1);
}

TEST_CASE("diff: a picture is held against its scene, by colours, by numbers of polygons and by depths") {
  const Folder folder;
  REQUIRE(run(folder, "render cyclic --save a.png --save-ids ids.npy --save-depth-raw z.npy").code == 0);
  for (const char* right : {"a.png cyclic", "ids.npy cyclic", "z.npy cyclic"}) {
    const Outcome outcome = run(folder, std::string("diff ") + right);
    CHECK(outcome.code == 0);
    CHECK(has(outcome.out, "The picture is right: none of "));
  }
  REQUIRE(run(folder, "record cyclic -o run.ztrace").code == 0);
  CHECK(run(folder, "diff a.png run.ztrace").code == 0);
  CHECK(run(folder, "diff a.png cyclic --theta 40").code == 1);
  const Outcome sizes = run(folder, "diff a.png cyclic --size 16x16");
  CHECK(sizes.code == 2);
  CHECK(has(sizes.err, "cyclic: is 16x16 pixels, but A is 32x32"));
}

TEST_CASE("diff: another convention that explains a picture is named, and no mistake then") {
  const Folder folder;
  REQUIRE(run(folder, "render cyclic --save-depth-raw z.npy --depth zero-to-one").code == 0);
  const Outcome outcome = run(folder, "diff z.npy cyclic --json");
  CHECK(outcome.code == 1);
  const auto report = nlohmann::json::parse(outcome.out);
  CHECK(report["differ"] > 200);
  CHECK(report["likely"].empty());
  REQUIRE(report["conventions"].size() == 1);
  CHECK(report["conventions"][0]["depth"] == "zero_to_one");
  CHECK(report["conventions"][0]["differ"] == 0);
  CHECK(run(folder, "diff z.npy cyclic --depth zero-to-one").code == 0);
}

TEST_CASE("diff: the mistake that makes a picture is named, and two that are made together") {
  const Folder folder;
  write_text(folder / "two.toml",
             "coordinates = \"screen\"\nraster.width = 24\nraster.height = 16\n"
             "[[polygon]]\ncolor = \"#d55e00\"\npoints = [[2.3, 1.2, 0.2], [21.7, 4.1, 0.6], [6.4, 13.8, 0.4]]\n"
             "[[polygon]]\ncolor = \"#0072b2\"\npoints = [[20.6, 1.7, 0.3], [22.2, 14.3, 0.7], [1.1, 9.6, 0.9]]\n");
  // A pixmap of the scene as zstep draws it, mirrored; and once more with the later polygon seen wherever it is.
  REQUIRE(run(folder, "render two.toml --save-ids ids.npy").code == 0);
  const std::string npy = text_of(folder / "ids.npy");
  constexpr std::size_t width = 24, height = 16;
  const std::size_t begin = npy.size() - width * height * 4;
  std::string mirrored = "P3\n24 16\n255\n";
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const char polygon = npy[begin + 4 * (y * width + (width - 1 - x))];
      mirrored += polygon == 0 ? "213 94 0 " : polygon == 1 ? "0 114 178 " : "255 255 255 ";
    }
  write_text(folder / "mirrored.ppm", mirrored);
  const Outcome one = run(folder, "diff mirrored.ppm two.toml");
  CHECK(one.code == 1);
  CHECK(has(one.out, "So drawn it is this very picture:\n  Likely: The picture is mirrored."));
  // The same as others write it: rows from the bottom up, blue first.
  const auto colors = [&](std::size_t y) {
    std::string row;
    for (std::size_t x = 0; x < width; ++x) {
      const char polygon = npy[begin + 4 * (y * width + (width - 1 - x))];
      row += polygon == 0   ? std::string("\x00\x5e\xd5", 3)
             : polygon == 1 ? std::string("\xb2\x72\x00", 3)
                            : "\xff\xff\xff";
    }
    return row;
  };
  std::string rows;
  for (std::size_t y = height; y-- > 0;) rows += colors(y);
  const std::string tga = std::string("\0\0\2\0\0\0\0\0\0\0\0\0\x18\0\x10\0\x18\0", 18) + rows;
  const std::string bmp = "BM" +
                          std::string("\xb6\x04\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x18\0\0\0\x10\0\0\0\1\0\x18\0", 28) +
                          std::string(24, '\0') + rows;
  write_text(folder / "mirrored.tga", tga), write_text(folder / "mirrored.bmp", bmp);
  for (const char* file : {"mirrored.tga", "mirrored.bmp"}) {
    const Outcome other = run(folder, fmt::format("diff {} two.toml", file));
    CAPTURE(other.err);
    CHECK(other.out.substr(other.out.find("B: ")) == one.out.substr(one.out.find("B: ")));
  }
  write_text(folder / "cut.tga", tga.substr(0, 10)), write_text(folder / "text.bmp", "no picture");
  for (const char* file : {"cut.tga", "text.bmp"}) {
    const Outcome refused = run(folder, fmt::format("diff {} two.toml", file));
    CHECK(refused.code == 2);
    CHECK(has(refused.err, fmt::format("{}: is no .bmp or .tga that can be read", file)));
  }
  std::string later = npy;
  REQUIRE(run(folder, "record two.toml -o run.ztrace").code == 0);
  const Outcome compares =
      run(folder, "query run.ztrace \"SELECT x, y FROM depth_compare GROUP BY x, y HAVING count(*) = 2\" --csv");
  REQUIRE(compares.code == 0);
  std::size_t both = 0;
  for (std::size_t at = compares.out.find('\n') + 1; at < compares.out.size();) {
    const std::size_t comma = compares.out.find(',', at), end = compares.out.find('\n', at);
    const std::size_t x = std::stoul(compares.out.substr(at, comma - at)),
                      y = std::stoul(compares.out.substr(comma + 1, end - comma - 1));
    later[begin + 4 * (y * width + x)] = 1, ++both;
    at = end + 1;
  }
  CHECK(both > 20);
  // Turned over as well: line 15 first.
  std::string turned = later;
  for (std::size_t y = 0; y < height; ++y)
    turned.replace(begin + y * width * 4, width * 4, later, begin + (height - 1 - y) * width * 4, width * 4);
  write_text(folder / "turned.npy", turned);
  const Outcome two = run(folder, "diff turned.npy two.toml --json");
  CHECK(two.code == 1);
  const auto report = nlohmann::json::parse(two.out);
  REQUIRE(!report["likely"].empty());
  CHECK(report["likely"][0]["differ"] == 0);
  CHECK(report["likely"][0]["mistakes"] == nlohmann::json{"y_upside_down", "depth_not_written"});
}

TEST_CASE("diff: where nothing draws a picture the nearest is named, or none") {
  const Folder folder;
  REQUIRE(run(folder,
              "render pyramid-behind --size 48x36 --no-cull --depth view --save-ids ids.npy "
              "--save-depth-raw two.npy")
              .code == 0);
  // Mirrored.
  constexpr std::size_t width = 48, height = 36, bytes = 4;
  const std::string npy = text_of(folder / "ids.npy");
  const std::size_t begin = npy.size() - width * height * bytes;
  std::string mirrored = npy;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      mirrored.replace(begin + bytes * (y * width + x), bytes, npy, begin + bytes * (y * width + width - 1 - x), bytes);
  write_text(folder / "mirrored.npy", mirrored);
  const auto of_mirrored =
      nlohmann::json::parse(run(folder, "diff mirrored.npy pyramid-behind --size 48x36 --json").out);
  bool named = false;
  for (const auto& one : of_mirrored["likely"])
    named = named || (one["mistakes"] == nlohmann::json{"picture_mirrored"} && one["differ"] == 0);
  CHECK(named);
  // A few pixels are otherwise: the nearest, and how many differ.
  for (std::size_t x = 0; x < 5; ++x) mirrored.replace(begin + bytes * (18 * width + 16 + 3 * x), bytes, bytes, '\7');
  write_text(folder / "nearest.npy", mirrored);
  const Outcome nearest = run(folder, "diff nearest.npy pyramid-behind --size 48x36 --no-cull");
  CHECK(has(nearest.out, "explain all of it. These come nearest:\n\nSo drawn "));
  CHECK(has(nearest.out, "Likely: The picture is mirrored."));
  // And what is nothing known.
  std::string noise = npy;
  for (std::size_t x = 0; x < 9; ++x) noise.replace(begin + bytes * (18 * width + 14 + 2 * x), bytes, bytes, '\7');
  write_text(folder / "noise.npy", noise);
  CHECK(has(run(folder, "diff noise.npy pyramid-behind --size 48x36 --no-cull").out, "nor half of it."));
}

TEST_CASE("diff: depths are held to the number format that is given, also those of a .exr") {
  const Folder folder;
  REQUIRE(run(folder, "render cyclic --number-format float32 --save-depth-raw z.npy").code == 0);
  CHECK(run(folder, "diff z.npy cyclic").code == 1);
  CHECK(run(folder, "diff z.npy cyclic --number-format float32").code == 0);
  // The same numbers, in the format that they were computed in.
  const std::string npy = text_of(folder / "z.npy");
  std::string rows;
  for (std::size_t at = npy.size() - 32 * 32 * sizeof(double); at < npy.size(); at += sizeof(double)) {
    double depth = 0;
    std::memcpy(&depth, npy.data() + at, sizeof depth);
    rows += zstep::test::bytes_in(static_cast<float>(depth));
  }
  write_text(folder / "z.exr", zstep::test::exr_of(32, 32, "Z", rows));
  CHECK(run(folder, "diff z.exr cyclic").code == 0);
  write_text(folder / "cut.exr", "v/1\1");
  const Outcome refused = run(folder, "diff cut.exr cyclic");
  CHECK(refused.code == 2);
  CHECK(has(refused.err, "cut.exr: is no .exr; write its depths as .pfm or .npy"));
}

TEST_CASE("diff: what cannot be held against a scene says so") {
  const Folder folder;
  REQUIRE(run(folder, "render cyclic --save a.png").code == 0);
  REQUIRE(run(folder, "record cyclic -o run.ztrace").code == 0);
  CHECK(has(run(folder, "diff a.png cyclic --view").err, "--view: shows a run, but this is a picture; leave it out"));
  CHECK(has(run(folder, "diff a.png run.ztrace --depth view").err, "--depth: is for scenes, but this is a trace"));
  CHECK(has(run(folder, "diff run.ztrace run.ztrace --depth view").err, "--depth: is for the scene of a picture"));
  CHECK(run(folder, "diff a.png nowhere.toml").code == 2);
  CHECK(run(folder, "diff nowhere.png cyclic").code == 2);
}

}  // namespace

TEST_CASE("diff: runs with other depth ranges, and what they are") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid --depth zero-to-one -o a.ztrace").code == 0);
  REQUIRE(run(folder, "record pyramid --depth zero-to-one --depth-range 0.25,0.75 -o b.ztrace").code == 0);
  const std::string said = run(folder, "diff a.ztrace b.ztrace").out;
  CHECK(said.find("depths of 0 to 1 are 0 to 1 of A, 0.25 to 0.75 of B") != std::string::npos);
  CHECK(said.find("cameras") == std::string::npos);
}

TEST_CASE("diff: runs of one method with other options, and what they are") {
  const Folder folder;
  REQUIRE(run(folder, "record cyclic --algorithm half-space -o a.ztrace").code == 0);
  REQUIRE(run(folder, "record cyclic --algorithm half-space --option samples=4 -o b.ztrace").code == 0);
  CHECK(run(folder, "diff a.ztrace b.ztrace").out.find("option samples: not given of A, 4 of B") != std::string::npos);
  CHECK(run(folder, "diff a.ztrace a.ztrace").out.find("option") == std::string::npos);
}
