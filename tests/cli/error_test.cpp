// zstep error: what it writes beside its text (docs/command-line.md shows that).
#include <doctest/doctest.h>

#include <string>

#include "sim/image/png.hpp"
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
