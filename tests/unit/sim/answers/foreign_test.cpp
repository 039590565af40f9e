// What is said of traces that other programs wrote, right and wrong ones (tests/data/foreign): whole sentences.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "sim/answers/pixel_history.hpp"
#include "sim/answers/why_not.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"
#include "traces/file/jsonl.hpp"

using namespace zstep;
using answers::Verdict, answers::Visit, answers::Why;

namespace {

Trace foreign(const std::string& name) {
  return open_jsonl(test::in_checkout("tests/data/foreign/" + name + ".jsonl"));
}

Verdict why_not(const Trace& trace, const std::string& polygon, std::int32_t x, std::int32_t y) {
  return answers::why_not(trace, *answers::polygon_called(trace.scene(), polygon), {x, y});
}
std::string sentence(const std::string& file, const std::string& polygon, std::int32_t x, std::int32_t y) {
  return why_not(foreign(file), polygon, x, y).sentence;
}
std::string sentence(const std::string& file, const std::string& polygon) {
  const Trace trace = foreign(file);
  return answers::why_not(trace, *answers::polygon_called(trace.scene(), polygon)).sentence;
}

/// "115 5 against −∞: nearer", a line a visit.
std::string history(const std::string& file, std::int32_t x, std::int32_t y) {
  const Trace trace = foreign(file);
  std::string text;
  const std::vector<Visit> all = answers::pixel_history(trace, {x, y});
  for (const Visit& visit : all)
    text += fmt::format(
        "{} {} {}{}: {}\n", visit.step,
        visit.polygon == no_polygon ? "?" : *trace.scene().polygons[static_cast<std::size_t>(visit.polygon)].name,
        visit.z ? answers::depth_text(*visit.z) : "-",
        visit.stored ? " against " + answers::depth_text(*visit.stored) : "", answers::outcome_text(trace, all, visit));
  return text;
}

}  // namespace

TEST_SUITE("foreign traces") {
  TEST_CASE("what the depth buffer was cleared to is what a depth is held against") {
    CHECK(history("far1", 1, 3) ==
          "115 A 0.5 against 1: nearer\n243 B 0.5 against 0.5: a tie: the trace says not nearer\n");
    const Verdict seen = why_not(foreign("far1"), "A", 1, 3);
    CHECK(seen.sentence == "A is what is seen at pixel (1, 3): step 117 put it there, z = 0.5.");
    CHECK(seen.formulas == std::vector<std::string>{"z < zbuffer[x,y]:  0.5 < 1  is true"});
    CHECK(sentence("clear1", "B", 1, 4) ==
          "B is not seen at pixel (1, 4): at step 256 its z is equal to 0.6, to which the depth buffer was cleared.");
  }

  TEST_CASE("where the greater depth is nearer, that is what is said") {
    CHECK(history("greater_minf", 1, 3) ==
          "115 A 5 against \u2212\u221e: nearer\n239 B 5 against 5: a tie: the trace says not nearer\n");
    CHECK(why_not(foreign("greater_minf"), "A", 1, 3).formulas ==
          std::vector<std::string>{"z > zbuffer[x,y]:  5 > \u2212\u221e  is true"});
  }

  TEST_CASE("a depth that is never written is not written, and the compare is not blamed") {
    CHECK(history("nowrite", 1, 3) ==
          "93 A 0.5 against \u221e: nearer; its depth was not written; B comes over it at step 207\n"
          "207 B 0.5 against \u221e: nearer; its depth was not written\n");
    CHECK(sentence("nowrite", "A", 1, 3) ==
          "A is not seen at pixel (1, 3): it was there from step 94 on, but its depth was never written; so B was held "
          "against \u221e at step 207 and found to be nearer.");
    CHECK(sentence("nowrite", "B", 1, 3) ==
          "B is what is seen at pixel (1, 3): step 208 put it there, z = 0.5. The depth of B was never written there.");
  }

  TEST_CASE("who lost the compare and is written all the same did not win it") {
    CHECK(history("alwayswrite", 1, 4) ==
          "139 A 0.5 against \u221e: nearer; B comes over it at step 265\n"
          "265 B 0.6 against 0.5: behind by 0.1; written all the same at step 266; its depth was not written\n");
    const Verdict gone = why_not(foreign("alwayswrite"), "A", 1, 4);
    CHECK(gone.kind == Why::contradicted);
    CHECK(gone.sentence ==
          "A is not seen at pixel (1, 4): it was there from step 141 on; B lost the compare at step 265, and step 266 "
          "wrote B all the same.");
    CHECK(sentence("alwayswrite", "B", 1, 4) ==
          "B is what is seen at pixel (1, 4): step 266 wrote it there, though it lost the compare at step 265. The "
          "depth of B was never written there.");
  }

  TEST_CASE("a depth that is written is not the one that was compared") {
    CHECK(history("wrongdepth", 1, 4) ==
          "139 A 0.5 against \u221e: nearer; the depth written is 0.55\n255 B 0.6 against 0.55: behind by 0.05\n");
    CHECK(sentence("wrongdepth", "B", 1, 4) ==
          "B is not seen at pixel (1, 4): at step 255 it lost the compare to A by \u0394z = 0.05. The depth that step "
          "140 wrote for A is 0.55, though 0.5 was compared.");
  }

  TEST_CASE("the polygon that is written is not the one that won") {
    CHECK(history("wrongcolour", 1, 1) ==
          "55 A 0.5 against \u221e: nearer; written once more after step 203\n203 B 0.3 against 0.5: nearer; step 205 "
          "writes A\n");
    CHECK(sentence("wrongcolour", "A", 1, 1) ==
          "A is what is seen at pixel (1, 1): step 205 put it there, z = 0.3. It is B that was compared at step 203: "
          "step 205 writes A instead.");
    const Verdict lost = why_not(foreign("wrongcolour"), "B", 1, 1);
    CHECK(lost.kind == Why::contradicted);
    CHECK(lost.sentence ==
          "B is not seen at pixel (1, 1): it won the compare at step 203, but step 205 writes A there.");
  }

  TEST_CASE("a pixel that is written without a compare shows what was written") {
    CHECK(history("painter", 1, 1) == "7 B -: painted; A comes over it at step 18\n18 A -: painted\n");
    CHECK(sentence("painter", "A") ==
          "A is seen at 10 pixels; the first of them: A is what is seen at pixel (0, 0): step 13 wrote it there "
          "without a compare.");
    CHECK(sentence("painter", "B", 1, 1) ==
          "B is not seen at pixel (1, 1): it was there from step 7 on, until step 18 wrote A there without a compare.");
    CHECK(history("nocompare", 1, 3) == "94 A 0.5: painted\n194 B 0.5: interpolated; no compare of it is recorded\n");
    CHECK(sentence("nocompare", "B", 1, 3) ==
          "B is not seen at pixel (1, 3): it was interpolated there at step 194, z = 0.5, and no compare of it is "
          "recorded.");
    CHECK(sentence("nocompare", "A", 1, 3) ==
          "A is what is seen at pixel (1, 3): step 94 wrote it there without a compare, z = 0.5.");
  }

  TEST_CASE("a polygon that the trace does not name is not known") {
    CHECK(history("nopoly", 1, 3) ==
          "91 A 0.5 against \u221e: nearer\n183 ? 0.5 against 0.5: a tie: the trace says not nearer; the trace does "
          "not say whose\n");
    CHECK(sentence("nopoly", "B", 1, 3) ==
          "B is not seen at pixel (1, 3): it covers the pixel; at step 183 a polygon that the trace does not name was "
          "compared there, and found not to be nearer.");
  }

  TEST_CASE("a colour that is written before its compare belongs to it") {
    CHECK(history("writefirst", 1, 1) ==
          "56 A 0.5 against \u221e: nearer; B comes over it at step 203\n204 B 0.3 against 0.5: nearer\n");
    CHECK(sentence("writefirst", "A", 1, 1) ==
          "A is not seen at pixel (1, 1): it was there from step 55 on, until step 203 wrote B; only then, at step "
          "204, B was compared, and found to be nearer.");
  }

  TEST_CASE("a trace that ends before work on a polygon begins says nothing of it") {
    CHECK(sentence("cutincl", "B") == "B is not seen anywhere: the trace ends at step 150, before work on B begins.");
    CHECK(sentence("cutincl", "B", 1, 1) ==
          "B is not seen at pixel (1, 1): the trace ends at step 150, before work on B begins.");
    CHECK(history("cutincl", 1, 2) ==
          "87 A 0.5 against \u221e: nearer\n150 B -: the trace ends at step 150, before work on it begins\n");
  }

  TEST_CASE("along a ray the farthest is kept: that is said, and no reason invented") {
    CHECK(history("far", 1, 1) == "27 A 2: nearer\n28 B 1 against 2: the trace says not nearer, but 1 < 2 is true\n");
    const Verdict verdict = why_not(foreign("far"), "B", 1, 1);
    CHECK(verdict.kind == Why::contradicted);
    CHECK(verdict.sentence ==
          "B is not seen at pixel (1, 1): the ray meets it at step 28 at t = 1, nearer than A at t = 2, but the trace "
          "keeps A.");
    CHECK(sentence("far", "A", 1, 1) ==
          "A is what is seen at pixel (1, 1): the trace keeps it at t = 2, though the ray meets B at t = 1.");
  }

  TEST_CASE("a polygon that is dropped for a reason that does not hold") {
    CHECK(sentence("rb", "B", 1, 2) ==
          "B is not seen at pixel (1, 2): the trace drops it as facing away; the scene is given in screen coordinates, "
          "without an eye, so that cannot be checked.");
    CHECK(
        sentence("reject_edge_on", "B", 1, 2) ==
        "B is not seen at pixel (1, 2): the trace drops it as seen edge-on, but it covers the centre of pixel (1, 2).");
    CHECK(sentence("reject_edge_on", "B") ==
          "B is not seen anywhere: the trace drops it as seen edge-on, but it covers the centre of pixel (1, 2).");
    CHECK(sentence("facing_wrong", "B", 1, 2) ==
          "B is not seen at pixel (1, 2): the trace drops it as facing away, but by the numbers of its facing test it "
          "faces the eye.");
  }

  TEST_CASE("a recording that was cut off is so as JSON Lines, too, and says nothing of what did not come") {
    const Trace cut = test::cut_off("z-buffer", test::large_scene());
    REQUIRE_FALSE(cut.warnings().empty());
    const auto read = [](const std::string& text, std::optional<TraceRecorder>& recorder, Scene& kept) {
      std::istringstream in(text);
      return read_jsonl(in, "run.jsonl", [&](const Header& header, Scene scene) -> TraceRecorder& {
        kept = std::move(scene);
        return recorder.emplace(header, kept);
      });
    };
    const std::string text = test::jsonl_of(cut), mark = "{\"cut_off\":true}\n";
    REQUIRE(text.ends_with(mark));
    std::optional<TraceRecorder> recorder;
    Scene kept;
    const auto said = read(text, recorder, kept);
    CHECK(said == fmt::format("run.jsonl:{}: the recording was cut off before its end; {} steps could be read",
                              cut.size() + 2, cut.size()));
    recorder->finish(!said);
    const Trace again = Trace::from_bytes(recorder->take_bytes(), "run.jsonl", *said);
    CHECK(again.size() == cut.size());
    CHECK_FALSE(again.warnings().empty());
    CHECK(test::jsonl_of(again) == text);
    // It is the end: nothing comes after it.
    std::optional<TraceRecorder> other;
    CHECK_THROWS_AS(read(text + jsonl_event(cut.header(), cut.scene(), cut.event(1)) + "\n", other, kept), InputError);
  }
}
