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
