// Statements about small traces of other programs, right ones and wrong ones, and about own ones: what is printed is
// what the numbers give, and what the trace has otherwise is said by every command. The traces stand in
// tests/data/foreign.
#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

std::string must(const Folder& folder, const std::string& arguments) {
  const Outcome outcome = run(folder, arguments);
  CAPTURE(arguments);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return outcome.out;
}
std::string foreign(const std::string& name) {
  return "'" + in_checkout("tests/data/foreign/" + name + ".jsonl") + "'";
}

/// Is this one of the lines, but for what it is indented by?
bool line(const std::string& text, const std::string& wanted) {
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string one = text.substr(from, end - from);
    const std::size_t begin = one.find_first_not_of(' ');
    if (begin != std::string::npos && one.substr(begin) == wanted) return true;
    from = end + 1;
  }
  return false;
}
#define HAS_LINE(text, wanted) \
  do {                         \
    CAPTURE(text);             \
    CHECK(line(text, wanted)); \
  } while (false)

}  // namespace

TEST_CASE("inclusive coverage is told as such: the last pixel of a span, the scan line at which an edge leaves") {
  const Folder folder;
  must(folder, "record delhi -o run.ztrace");
  HAS_LINE(must(folder, "explain run.ztrace --at 12 last"),
           "last = ⌊x_R⌋ = ⌊0⌋ = 0   coverage is inclusive: a pixel on x_R belongs to the span   (0x0p+0)");
  HAS_LINE(
      must(folder, "explain run.ztrace --at 155 end_row"),
      "end_row = ⌊y_1⌋ + 1 = ⌊6⌋ + 1 = 7   coverage is inclusive, and the edge goes on as far as y_1   (0x1.cp+2)");
  const std::string retired = must(folder, "find run.ztrace edge_retire");
  HAS_LINE(retired, "149  retire_edge  Scan line 7 was the last of A: edge e1 (2–0) leaves the active edge list.");
  HAS_LINE(retired, "e1 leaves at y = 8: y + 1 = 8");
  HAS_LINE(must(folder, "find run.ztrace \"step==12\""), "last = ⌊x_R⌋ = ⌊0⌋ = 0");
  must(folder, "record foley -o foley.ztrace");
  HAS_LINE(must(folder, "find foley.ztrace span"), "last = ⌈x_R⌉ − 1 = ⌈7⌉ − 1 = 6");
}

TEST_CASE("a line buffer: the polygon is that of the span, and the buffer is the pseudo-code's") {
  const Folder folder;
  must(folder, "record intersecting --algorithm scan-line --option resolve=line-buffer -o run.ztrace");
  const std::string found = must(folder, "find run.ztrace \"compare where x==16 and y==12\" --all");
  HAS_LINE(found, "443  compare  0.2146 < ∞: nothing was drawn here yet, so pixel (16, 12) becomes A.");
  HAS_LINE(found, "450  compare  0.1254 < 0.2146: nearer than A, so pixel (16, 12) becomes B.");
  HAS_LINE(must(folder, "history run.ztrace 16 12 --why"), "z* < line[x]:  0.1254 < 0.2146  is true");
}

TEST_CASE("a hit is held against what the ray has kept at that moment, and ties go by the file") {
  const Folder folder;
  must(folder, "record pyramid-behind --algorithm ray-casting -o run.ztrace");
  const std::string history = must(folder, "history run.ztrace 15 10 --why");
  HAS_LINE(history, "3 922: The point lies inside D, nearer than F, which was kept so far: it is kept.");
  HAS_LINE(history, "3 925: The point lies inside G, but D is nearer: it is not kept.");
  HAS_LINE(history, "t < t kept:  2.843 < 2.2138  is false");
  must(folder, "record '" + in_checkout("tests/golden/bsp.toml") + "' --algorithm ray-tracing -o ties.ztrace");
  HAS_LINE(must(folder, "find ties.ztrace \"step==1127\""),
           "1127  hit  The point lies inside A, just as near as C: a tie, and A, the first of the two in the file, is "
           "kept.");
  HAS_LINE(must(folder, "explain ties.ztrace --at 1127 nearest"),
           "nearest: t ≤ kept:  4 ≤ 4  is true   a tie: of two as near the first in the file is kept");
}

TEST_CASE("depths that differ late have as many digits as tell them apart") {
  const Folder folder;
  const std::string near = must(folder, "why-not " + foreign("near9") + " A 1 1");
  HAS_LINE(near, "Δz = z of A − z of B = 0.5 − 0.499999999999 = 9.99977878e−13");
  HAS_LINE(near, "z < zbuffer[x,y]:  0.499999999999 < 0.5  is true");
}

TEST_CASE("what the viewer doubts, find and history and why-not doubt") {
  const Folder folder;
  const std::string span = must(folder, "find " + foreign("span_wrong") + " span");
  HAS_LINE(span, "dz/dx = (z_R − z_L)/(x_R − x_L) = (0.5 − 0.5)/(7 − 0) = 0, but the trace records 9");
  HAS_LINE(span, "The trace records dz/dx = 9, but this formula gives 0.");
  const std::string insert = must(folder, "find " + foreign("insert_wrong") + " insert");
  HAS_LINE(insert,
           "6  insert  The trace lets edge e0 from vertex 2 to vertex 1 begin at scan line 3 and leave at 8; its ends "
           "are at y = 7 and 0, so it "
           "should begin at 0 and leave at 8.");
  HAS_LINE(insert, "first scan line = ⌈y_1⌉ = ⌈0⌉ = 0, but the trace records 3");
  const std::string z = must(folder, "find " + foreign("wrongz") + " \"interp where x==1 and y==1\"");
  HAS_LINE(z,
           "z = z_L + (z_R − z_L)(x − x_L)/(x_R − x_L) = 0.5 + (0.5 − 0.5)(1 − 0)/(6 − 0) = 0.5, but the trace records "
           "0.55");
  HAS_LINE(z, "The trace records z = 0.55, but this formula gives 0.5.");
  HAS_LINE(must(folder, "find " + foreign("wrongdepth") + " \"wz where x==1 and y==1\" --backwards"),
           "The trace writes z = 0.35, but had compared z = 0.3.");
  HAS_LINE(must(folder, "history " + foreign("halfcompare") + " 1 1 --why"),
           "The trace compares z = 0.15, but had interpolated z = 0.3.");
}

TEST_CASE("a step of why-not wins a compare only where there was one, and its numbers say so") {
  const Folder folder;
  HAS_LINE(must(folder, "why-not " + foreign("near9") + " A 1 1"),
           "239  B        B at z = 0.499999999999 wins the compare");
  const std::string forged = "'" + in_checkout("tests/data/hostile/forged_compare.jsonl") + "'";
  const std::string seen = must(folder, "why-not " + forged + " P0 1 1");
  CHECK(seen.find("wins the compare") == std::string::npos);
  HAS_LINE(seen,
           "5  P0       P0 at z = 9 is compared: the trace says nearer, but 9 < 1 is false (its header does not "
           "declare which depth is nearer)");
  // Glass that lets nothing through, laid over the pixel without a compare.
  std::string glass = text_of(in_checkout("tests/data/foreign/nocompare.jsonl"));
  const std::string steps = "\"steps\": [", pixel = R"({"step": "wp", "x": 1, "y": 1, "polygon": 1})";
  glass.replace(glass.find(steps), steps.size(), steps + R"({"id": 20, "name": "mix", "event": "color_blend"}, )");
  REQUIRE(times(glass, pixel) == 1);
  glass.replace(glass.find(pixel), pixel.size(),
                R"({"step": "mix", "x": 1, "y": 1, "polygon": 1, "opacity": 1, "r8": 0, "g8": 114, "b8": 178})"
                "\n" +
                    pixel);
  write_text(folder / "glass.jsonl", glass);
  const std::string over = must(folder, "why-not glass.jsonl A 1 1");
  CAPTURE(over);
  CHECK(over.find("compare") == std::string::npos);
  CHECK(over.find("nearer") == std::string::npos);
  CHECK(over.find(" until B was laid over it at step ") != std::string::npos);
}

TEST_CASE("numbers that are copied or rounded are held against what they come from") {
  const Folder folder;
  HAS_LINE(must(folder, "explain " + foreign("wrongdepth") + " 1 1"),
           "The trace records 0.35, but it was taken from 0.3.");
  HAS_LINE(must(folder, "explain " + foreign("halfcompare") + " 1 1"),
           "The trace records 0.15, but it was taken from 0.3.");
  HAS_LINE(must(folder, "explain " + foreign("round") + " --at 8 end_row"),
           "The trace records 8, but this formula gives 7.");
  HAS_LINE(must(folder, "explain " + foreign("span_end") + " --at 16 last"),
           "The trace records 8, but this formula gives 7.");
  HAS_LINE(must(folder, "find " + foreign("span_end") + " span"),
           "16  span  The trace fills x = 1 to 8 of scan line 1 between e2 and e1; by x_L = 0.6533 and x_R = 7 it "
           "should fill 1 to 7.");
}

TEST_CASE("a centre beside an outline is not on it, and a polygon without a neighbour has none") {
  const Folder folder;
  must(folder, "record cube -o cube.ztrace");
  HAS_LINE(must(folder, "why-not cube.ztrace B 8 11"),
           "B is not seen at pixel (8, 11): it covers the pixel only in part: the centre lies 0.0048 pixels outside "
           "its outline.");
  must(folder, "record foley -o foley.ztrace");
  HAS_LINE(must(folder, "why-not foley.ztrace A 10 3"),
           "A is not seen at pixel (10, 3): the pixel's centre lies on a right or last edge of it, and by the "
           "half-open rule such a centre is outside.");
}

TEST_CASE("a method that draws lines has no depths, and what no option mends comes first") {
  const Folder folder;
  const std::string lines = run(folder, "record delhi --algorithm wireframe -o run.ztrace").err;
  CHECK(lines ==
        "--algorithm wireframe: draws lines: nothing is interpolated, and no pixel is covered; give "
        "--coverage top-left\n");
  const std::string all = run(folder, "compare-methods delhi").err;
  CAPTURE(all);
  CHECK(has(all,
            "without Floating horizon: delhi: floating-horizon draws a surface y = f(x, z), and this scene has "
            "none"));
  CHECK(must(folder, "record delhi --algorithm wireframe --coverage top-left -o run.ztrace") != "");
}

TEST_CASE("an edge that is left out: the run's reason is held against its own numbers") {
  const Folder folder;
  must(folder, "record delhi -o run.ztrace");
  must(folder, "dump run.ztrace --jsonl | sed '/skip_edge/s/horizontal/between_rows/' > wrong.jsonl");
  HAS_LINE(must(folder, "find run.ztrace skip_edge"),
           "6  skip_edge  The edge from vertex 0 to vertex 1 is horizontal: it meets no scan line in one point and is "
           "left out.");
  HAS_LINE(must(folder, "find wrong.jsonl skip_edge"),
           "6  skip_edge  The trace leaves out the edge from vertex 0 to vertex 1 as lying between two scan lines, but "
           "it is horizontal and lies on scan line 7.");
}

TEST_CASE("explain: the hexadecimal number is that of the number beside it, also where the trace records another") {
  const Folder folder;
  const std::string round = must(folder, "explain " + foreign("round") + " --at 8 end_row");
  HAS_LINE(
      round,
      "end_row = ⌊y_1⌋ + 1 = ⌊6.6⌋ + 1 = 7   coverage is inclusive, and the edge goes on as far as y_1   (0x1.cp+2)");
  HAS_LINE(round, "The trace records 8, but this formula gives 7.");
  const std::string last = must(folder, "explain " + foreign("span_end") + " --at 16 last");
  CAPTURE(last);
  CHECK(has(last, "(0x1.cp+2)"));
  CHECK(!has(last, "(0x1p+3)"));
}

TEST_CASE("explain: a number that its formula does not give is no rounding, and a run without spans has none") {
  const Folder folder;
  must(folder, "record pyramid-behind --size 20x15 --interpolation plane -o run.ztrace");
  must(folder,
       "dump run.ztrace --jsonl | grep -v '\"step\":\"span\"' | "
       "sed '/interpolate_z/s/\"x\":9,\"y\":8,\"z\":[-0-9.e]*/\"x\":9,\"y\":8,\"z\":0.125/' > wrong.jsonl");
  const std::string right = must(folder, "explain run.ztrace 9 8 --exact"),
                    wrong = must(folder, "explain wrong.jsonl 9 8 --exact");
  CHECK(has(right, "is the sum of what each rounding brings. The largest part, "));
  CHECK(has(right, "depth at x = 9 on the span"));
  CAPTURE(wrong);
  CHECK(!has(wrong, "is the sum of what each rounding brings"));
  CHECK(has(wrong, "is more than rounding brings: "));
  CHECK(has(wrong, ", where the trace records another number than its formula gives."));
  CHECK(!has(wrong, "on the span"));
  CHECK(has(wrong, "depth at pixel (9, 8)"));
}

TEST_CASE("explain: of a run that records no writes it is not said that nothing was drawn") {
  const Folder folder;
  must(folder, "record foley -o run.ztrace");
  must(folder, "dump run.ztrace --jsonl | grep -v '\"step\":\"write_' > compares.jsonl");
  must(folder, "dump run.ztrace --jsonl | grep -v '\"step\":\"write_depth' > pixels.jsonl");
  for (const char* file : {"compares", "pixels"}) {
    const std::string said = must(folder, std::string("explain ") + file + ".jsonl 3 4");
    CAPTURE(said);
    CHECK(has(said,
              "pixel (3, 4): the run does not record what is written into the depth buffer; the last that was "
              "found to be nearer there is "));
    CHECK(!has(said, "nothing was drawn"));
  }
}
