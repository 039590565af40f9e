// zstep compare-methods: its tables, its files, its mistakes, and Ctrl-C.
#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include "traces/image/png.hpp"
#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

void check_refused(const std::string& arguments, const std::string& part) {
  const Folder folder;
  CAPTURE(arguments);
  const Outcome outcome = run(folder, "compare-methods " + arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(times(outcome.err, "\n") == 1);
  CHECK(has(outcome.err, part));
  CHECK(folder.names().empty());
}

}  // namespace

TEST_CASE("compare-methods: all methods that can draw the scene, with numbers and chart") {
  const Folder folder;
  const Outcome outcome = run(folder, "compare-methods cyclic --size 24x20 --steps --csv c.csv --plot c.png");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 1);  // the painter's algorithm is wrong where polygons overlap in a circle
  CHECK(has(outcome.out, "cyclic: 3 polygons, 24x20 pixels. Pictures are held against that of Z-buffer."));
  CHECK(has(outcome.out, "z_buffer.compare"));
  const std::string csv = text_of(folder / "c.csv");
  CHECK(csv.starts_with("scene,method,measure,step,value\ncyclic,z-buffer,pixels,,480\n"));
  CHECK(has(csv, "cyclic,z-buffer,equal,,480\n"));
  CHECK(has(csv, "cyclic,z-buffer,unexplained,,0\n"));
  const std::string manual = text_of(in_checkout("docs/command-line.md"));
  const std::size_t begin = manual.find("- `--csv` writes all numbers");
  const std::string measures = manual.substr(begin, manual.find("\n- ", begin) - begin);
  std::istringstream lines(csv);
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    const std::size_t measure = line.find(',', line.find(',') + 1) + 1;
    CHECK_MESSAGE(has(measures, "`" + line.substr(measure, line.find(',', measure) - measure) + "`"), line);
  }
  if (has(outcome.out, "wrote c.png")) CHECK(zstep::read_png(folder / "c.png").width == 1280);
}

TEST_CASE("compare-methods: methods that are named, in their order") {
  const Folder folder;
  const Outcome outcome = run(folder, "compare-methods pyramid --size 16x16 --methods z-buffer");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(has(outcome.out, "\nZ-buffer    256      0     0      0"));
  CHECK(folder.names().empty());
}

TEST_CASE("compare-methods: the table, quickly") {
  const Folder folder;
  const Outcome outcome = run(folder, "compare-methods --table --quick --csv t.csv --plot t.png");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(has(outcome.out, "128x128 pixels"));
  CHECK(has(outcome.out, "Z-buffer"));
  CHECK(has(outcome.out, "left out"));
  CHECK(has(outcome.out, "(54)"));
  const std::string csv = text_of(folder / "t.csv");
  CHECK(csv.starts_with("method,polygons,time_s,cost,book_cost\n"));
  CHECK(has(csv, "z-buffer,60000,,,54\n"));
  CHECK(has(csv, "z-buffer,100,"));
  CHECK_FALSE(has(csv, "z-buffer,100,,"));
}

TEST_CASE("compare-methods: ways of interpolating, and what cannot be drawn so") {
  const Folder folder;
  const Outcome outcome = run(folder,
                              "compare-methods pyramid-behind --size 24x20 --ortho --modes depth=view,reciprocal "
                              "--modes number-format=float32,fixed16 --csv m.csv");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(has(outcome.out, "\nview, float32 "));
  CHECK(has(outcome.out, "\nview, fixed16 "));
  CHECK_FALSE(has(outcome.out, "reciprocal"));
  CHECK(times(outcome.err, "note: without reciprocal, ") == 2);
  CHECK(has(outcome.err, "leave out --ortho"));
  const std::string csv = text_of(folder / "m.csv");
  CHECK(csv.starts_with("scene,mode,depths,largest,"));
  CHECK(run(folder, "compare-methods delhi --rounding down --modes number-format=fixed16").code == 0);
  CHECK(times(csv, "\n") == 3);
}

TEST_CASE("compare-methods: a clipping plane is moved, and the errors are drawn") {
  const Folder folder;
  const Outcome outcome = run(folder,
                              "compare-methods pyramid-behind --size 16x16 --modes number-format=fixed16,float64 "
                              "--sweep near=0.5..1.5 --csv s.csv --plot s.png");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(has(outcome.out, "near  fixed16  WRONG"));
  CHECK(has(outcome.out, "fixed16: wrong pixels begin "));
  CHECK(times(text_of(folder / "s.csv"), "\n") == 1 + 2 * 17);
  if (has(outcome.out, "wrote s.png")) CHECK(zstep::read_png(folder / "s.png").width == 1280);
}

TEST_CASE(
    "compare-methods: where wrong pixels begin is looked for between samples, and is not said to be more than it is") {
  const Folder folder;
  const std::string poster =
      "compare-methods " + in_checkout("lessons/scenes/poster.toml") + " --modes number-format=fixed16 --sweep near=";
  const auto begins = [&](const std::string& range) {
    const std::string out = run(folder, poster + range).out;
    CAPTURE(out);
    const std::string before = "wrong pixels begin at near = ";
    REQUIRE(has(out, before));
    CHECK(has(out, "threshold of these samples only"));
    return std::stod(out.substr(out.find(before) + before.size()));
  };
  const double one = begins("0.01..10"), other = begins("0.1..2");
  CHECK(one > 0.5);  // 0.487 and 0.75 are samples
  CHECK(one < 0.74);
  CHECK(other > 0.9);
  CHECK(other < 1.1);
}

TEST_CASE("compare-methods: which depths the buffers of ways can hold is drawn, as SVG too") {
  const Folder folder;
  const Outcome outcome = run(folder,
                              "compare-methods pyramid-behind --size 16x16 --modes number-format=fixed16,float32 "
                              "--plot units.svg");
  CAPTURE(outcome.err);
  if (has(outcome.err, "built without the viewer")) return;
  REQUIRE(outcome.code == 0);
  const std::string svg = text_of(folder / "units.svg");
  CHECK(svg.starts_with("<svg "));
  CHECK(times(svg, ">fixed16</text>") == 1);
  CHECK(times(svg, "<circle ") == 17);
}

TEST_CASE("compare-methods: mistakes") {
  check_refused("cube --modes depth=deep", "'deep' is not");
  check_refused("cube --modes colour=red", "is not CONVENTION=WORD,WORD");
  check_refused("cube --modes depth", "is not CONVENTION=WORD,WORD");
  check_refused("cube --modes depth=view --methods z-buffer", "--methods: does not go with --modes");
  check_refused("cube --modes depth=all --plot a.png", "7 modes are too many for one chart; give at most 4");
  check_refused("delhi --modes depth=view --plot a.png", "this scene has no such planes");
  check_refused("cube --sweep middle=1..2", "is not near=FROM..TO");
  check_refused("cube --sweep near=2..1", "does not go from a distance above 0");
  check_refused("cube --modes number-format=all --sweep near=0.5..1", "are too many for one chart");
  check_refused("", "there is no scene; name one, or give --table");
  check_refused("cube --quick", "--quick: goes with --table");
  check_refused("cube --methods z-bufer", "did you mean z-buffer?");
  check_refused("cube --methods z-buffer,z-buffer", "z-buffer is named twice");
  check_refused("cube --methods z-buffer:fast", "'fast' is not NAME=VALUE");
  check_refused("cube --methods z-buffer:colour=red", "colour");
  check_refused("cube --limit 0", "--limit: '0' is no time to run in");
  check_refused("cube --csv none/a.csv", "there is no folder none");
  check_refused("cube --csv a --plot a", "is asked for twice");
  check_refused("cube --table", "--table: brings its own scenes");
  check_refused("--table --rho 4", "leave out --rho");
  check_refused("cube --algorithm z-buffer", "there is no option --algorithm");
}

TEST_CASE("compare-methods: a method that takes too long is stopped, and it is said so") {
  const Folder folder;
  const Outcome outcome =
      run(folder, "compare-methods teapot:64 --size 4096x4096 --methods z-buffer --limit 0.2 --csv a.csv");
  CHECK(outcome.code == 3);
  CHECK(has(outcome.out, "Z-buffer: not done within 0.2 s\n"));
  CHECK(has(text_of(folder / "a.csv"), "z-buffer,end,,out_of_time\n"));
}
