// What single steps of traces that other programs wrote are said to have done (tests/data/foreign): a reason is given
// where it holds, and where the numbers say otherwise, that is the sentence.
#include <doctest/doctest.h>

#include <string>

#include "sim/words/explain.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

Explanation told(const std::string& file, std::int64_t step) {
  const Trace trace = open_jsonl(test::in_checkout("tests/data/foreign/" + file + ".jsonl"));
  Replay replay(trace);
  replay.go_to(step);
  return explain(trace, replay.state(), *replay.current());
}
std::string sentence(const std::string& file, std::int64_t step) { return told(file, step).sentence; }

}  // namespace

TEST_CASE("foreign traces: clearing and comparing say what is stored") {
  CHECK(sentence("far1", 1) == "Every pixel becomes background and every depth becomes 1.");
  CHECK(sentence("greater_minf", 1) ==
        "Every pixel becomes background and every depth becomes \u2212\u221e, so whatever comes first will be nearer.");
  CHECK(sentence("greater_minf", 115) == "5 > \u2212\u221e: nothing was drawn here yet, so pixel (1, 3) becomes A.");
  CHECK(sentence("far1", 115) ==
        "0.5 < 1: the depth buffer was cleared to that, and nothing was drawn here yet, so pixel (1, 3) becomes A.");
  CHECK(sentence("clear1", 256) == "0.6 = 0.6: equal to what the depth buffer was cleared to, so pixel (1, 4) stays.");
  CHECK(sentence("nowrite", 207) ==
        "0.5 < \u221e: A was drawn here, but the depth buffer still holds what it was cleared to, so pixel (1, 3) "
        "becomes B.");
}

TEST_CASE("foreign traces: a compare and what is written with it") {
  CHECK(sentence("alwayswrite", 265) ==
        "0.6 > 0.5: B is not nearer than A at pixel (1, 4), and step 266 writes B all the same.");
  CHECK(told("alwayswrite", 265).doubt);
  CHECK(sentence("wrongcolour", 203) ==
        "0.3 < 0.5: nearer than A, so pixel (1, 1) should become B, but step 205 writes A.");
  CHECK(told("wrongcolour", 203).doubt);
  CHECK(sentence("writefirst", 56) == "0.5 < \u221e: nothing was drawn here yet, so pixel (1, 1) becomes A.");
  CHECK(sentence("nopoly", 91) == "0.5 < \u221e: nothing was drawn here yet, so pixel (1, 3) becomes A.");
  CHECK(sentence("nopoly", 183) == "0.5 = 0.5: a tie with A, and the trace says not nearer, so pixel (1, 3) stays.");
}

TEST_CASE("foreign traces: the ray keeps the farthest hit") {
  CHECK(sentence("far", 3) == "The point lies inside B at t = 1, nearer than A at t = 2, but the trace keeps A.");
  CHECK(told("far", 3).doubt);
}

TEST_CASE("foreign traces: reasons that the numbers contradict") {
  CHECK(sentence("facing_wrong", 187) ==
        "The trace says that polygon B faces away from the eye, but by its four numbers it faces the eye.");
  CHECK(sentence("facing_wrong", 188) ==
        "The trace drops polygon B as facing away, but by the numbers of its facing test it faces the eye.");
  CHECK(sentence("rb", 187) ==
        "The trace drops polygon B as facing away; the scene is given in screen coordinates, without an eye, so that "
        "cannot be checked.");
  CHECK(sentence("reject_edge_on", 187) ==
        "The trace drops polygon B as seen edge-on, but on the raster its area is 12.5 pixels.");
  CHECK(sentence("skip", 190) ==
        "The trace leaves out the edge from vertex 3 to vertex 5 as horizontal, but it is not: 1 \u2260 6.");
  CHECK(sentence("skip", 191) ==
        "The trace leaves out the edge from vertex 4 to vertex 5 as lying between two scan lines, but it meets scan "
        "line 1.");
  CHECK(sentence("retire_early", 81) ==
        "Edge e0 (1\u20132) leaves the active edge list at scan line 2, though it is to leave at 8.");
  CHECK(sentence("swap", 81) ==
        "Places 0 and 1 of the active edge list change, though they were in order: now e0 at x = 5 is left of e1 at x "
        "= 0.");
  CHECK(sentence("unsorted", 9) ==
        "Edge e1 (0\u20132) begins at this scan line and enters the active edge list at place 0, sorted by x.");
  CHECK(sentence("unsorted", 10) ==
        "Edge e0 (1\u20132) begins at this scan line and enters the active edge list at place 0, which leaves it "
        "unsorted: e0 at x = 7 is left of e1 at x = 0.");
  for (const auto& [file, step] : {std::pair{"skip", 190},
                                   {"skip", 191},
                                   {"retire_early", 81},
                                   {"swap", 81},
                                   {"unsorted", 10},
                                   {"facing_wrong", 187},
                                   {"facing_wrong", 188},
                                   {"reject_edge_on", 187}}) {
    CAPTURE(file);
    CHECK(told(file, step).doubt);
  }
}
