// Why a polygon is not what is seen, case by case: what is said where faces are turned away, a trace contradicts itself
// or is not whole.
#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/answers/why_not.hpp"
#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using answers::Verdict, answers::Why, answers::why_not;

namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_SUITE("why not") {
  TEST_CASE(
      "of a hidden edge: the pixel lies on the edge, and within the interval that is hidden but for rounding, which is "
      "told") {
    ViewOptions view;
    view.width = 30, view.height = 20;
    const Scene scene = look_at_scene(load_scene(test::in_checkout("lessons/scenes/hidden-lines.toml")).scene, view);
    const Trace trace = test::recorded_by("hidden-line", scene);
    int within = 0, rounded = 0;
    for (std::int32_t polygon = 0; polygon < static_cast<std::int32_t>(scene.polygons.size()); ++polygon)
      for (std::int32_t y = 0; y < view.height; ++y)
        for (std::int32_t x = 0; x < view.width; ++x) {
          const Verdict verdict = why_not(trace, polygon, {x, y});
          if (verdict.kind != Why::line_hidden) continue;
          CAPTURE(verdict.sentence);
          const std::string& place = verdict.formulas.back();
          CAPTURE(place);
          const auto number_after = [](const std::string& text, const std::string& words) {
            const std::size_t at = text.find(words);
            REQUIRE(at != std::string::npos);
            std::string digits = text.substr(at + words.size());
            for (std::size_t minus = digits.find("\u2212"); minus != std::string::npos; minus = digits.find("\u2212"))
              digits.replace(minus, 3, "-");
            return std::stod(digits);
          };
          const double t = number_after(place, "at the pixel t = ");
          CHECK(t >= 0);
          CHECK(t <= 1);
          if (contains(place, "is rounded to this pixel")) {
            ++rounded;
            continue;
          }
          ++within;
          CHECK(t >= number_after(verdict.sentence, "hides it from t = ") - 1e-4);
          CHECK(t <= number_after(verdict.sentence, " to t = ") + 1e-4);
        }
    CHECK(within > 20);
    CHECK(rounded > 0);
  }

  TEST_CASE("of a polygon none of whose edges is in view, no pixel is named") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/wireframe-clipping.jsonl"));
    const Verdict verdict = why_not(trace, *answers::polygon_called(trace.scene(), "H"));
    CHECK(verdict.sentence == "H is not seen anywhere: none of its edges is in view.");
    CHECK_FALSE(verdict.pixel);
  }

  TEST_CASE("a back face of a tree is dropped by a step, and of rays none is spoken where none is cast") {
    Scene scene = look_at_scene(load_scene("pyramid-behind").scene, {});
    const Trace trace = test::recorded_by("bsp", scene);
    int dropped = 0;
    for (const char* name : {"B", "C", "E"}) {
      const std::int32_t polygon = *answers::polygon_called(scene, name);
      for (const Verdict& verdict : {why_not(trace, polygon), why_not(trace, polygon, {15, 12})}) {
        CHECK_FALSE(contains(verdict.sentence, "rays"));
        if (verdict.kind != Why::culled) continue;
        const auto* reject = get_if<PolygonReject>(&trace.event(verdict.step).event);
        REQUIRE(reject);
        CHECK(reject->polygon == polygon);
        CHECK(verdict.chain.back().step == verdict.step);
        CHECK(contains(verdict.formulas.front(), "> 0: it faces away"));
        ++dropped;
      }
    }
    CHECK(dropped >= 4);
  }

  TEST_CASE("by rays, of a polygon that faces away: one normal is written n") {
    const Scene scene = look_at_scene(load_scene("pyramid-behind").scene, {});
    const Verdict verdict =
        why_not(test::recorded_by("ray-casting", scene), *answers::polygon_called(scene, "B"), {15, 12});
    REQUIRE(verdict.kind == Why::culled);
    for (const std::string& formula : verdict.formulas) CHECK_FALSE(contains(formula, "dX\u00b7n"));
    CHECK(contains(verdict.formulas.back(), "A dX + B dY + C dZ = 1.27"));
  }

  TEST_CASE("a compare that says what its numbers do not is told as that") {
    const std::vector<glm::dvec3> all{{-1, -1, 7}, {5, -1, 7}, {5, 5, 7}, {-1, 5, 7}};
    Scene scene = test::screen_scene(4, 4, {all, all});
    const auto flipped = [](const Trace& honest, std::int32_t which, bool nearer) {
      std::int32_t seen = 0;
      bool gone = false;
      return test::changed(honest, [&](std::int64_t, Event& event) {
        if (auto* compare = get_if<DepthCompare>(&event)) {
          const bool meant = compare->x == 2 && compare->y == 1 && seen++ == which;
          if (meant) compare->nearer = nearer;
          gone = meant && !nearer;
        }
        return !gone || !(holds<DepthWrite>(event) || holds<PixelWrite>(event));
      });
    };
    const Verdict tie = why_not(flipped(test::recorded_by("z-buffer", scene), 1, true), 1, {2, 1});
    CHECK(contains(tie.sentence, "the trace says nearer, but 7 < 7 is false"));
    CHECK_FALSE(contains(tie.sentence, "lost the compare"));
    for (std::size_t k = 4; k < 8; ++k) scene.points[k].z = 3;
    const Verdict hidden = why_not(flipped(test::recorded_by("z-buffer", scene), 1, false), 1, {2, 1});
    CHECK(contains(hidden.sentence, "the trace says not nearer, but 3 < 7 is true"));
  }

  TEST_CASE("Warnock's corners: what is equally near is not said to be in front") {
    const std::vector<glm::dvec3> flat{{-1, -1, 7}, {5, -1, 7}, {5, 5, 7}, {-1, 5, 7}};
    // At the area's corners on the left it is as near, on the right farther.
    const auto z = [](double x) { return 7 + (x + 0.5) / 4; };
    const std::vector<glm::dvec3> leaning{{-1, -1, z(-1)}, {5, -1, z(5)}, {5, 5, z(5)}, {-1, 5, z(-1)}};
    const auto farther = [](std::vector<glm::dvec3> points) {
      for (glm::dvec3& point : points) point.z += 1;
      return points;
    };
    const struct {
      std::vector<glm::dvec3> other;
      const char *why, *decided;
    } cases[] = {
        {flat, "is exactly as near as it at all four corners, and is the one of the two that is painted",
         "none is in front of it at its four corners. Where another is exactly as near"},
        {leaning, "is in front of it at 2 of the corners, and exactly as near at the others",
         "none is in front of it at its four corners. Where another is exactly as near"},
        {farther(flat), "is in front of it at all four corners", "is in front of all others at its four corners"},
    };
    for (const auto& one : cases) {
      CAPTURE(one.why);
      const Trace trace = test::recorded_by("warnock", test::screen_scene(4, 4, {flat, one.other}));
      CHECK(contains(why_not(trace, 1, {2, 1}).sentence, one.why));
      const auto decided =
          trace.next<AreaDecide>(0, [](const AreaDecide& e) { return e.what == AreaCase::front_surrounder; });
      REQUIRE(decided);
      Replay replay(trace);
      replay.go_to(*decided);
      const Explanation told = explain(trace, replay.state(), *replay.current());
      CHECK(contains(told.sentence, one.decided));
      CHECK_FALSE(told.doubt);
    }
  }

  TEST_CASE("where spans include both ends no half-open rule is cited") {
    Conventions conventions;
    conventions.coverage = Conventions::Coverage::inclusive;
    // The centres of column 1 lie beside its outline, by less than brute force can tell.
    const double left = 1 + 1e-9;
    const Scene scene = test::screen_scene(6, 6, {{{left, -1, 2}, {4, -1, 2}, {4, 7, 2}, {left, 7, 2}}});
    const Verdict verdict = why_not(test::recorded_by("z-buffer", scene, conventions), 0, {1, 3});
    CHECK(verdict.kind == Why::not_covered);
    CHECK(contains(verdict.sentence, "so near its outline that rounding decides"));
    CHECK_FALSE(contains(verdict.sentence, "half-open"));
    CHECK(contains(why_not(test::recorded_by("z-buffer", scene), 0, {4, 3}).sentence,
                   "lies on a right or last edge of it, and by the half-open rule such a centre is outside"));
  }

  TEST_CASE("a pixel that a recording did not reach is not lost to the background") {
    const Scene scene = test::large_scene();
    for (const char* by : {"z-buffer", "warnock", "ray-casting"}) {
      CAPTURE(by);
      const Trace trace = test::cut_off(by, scene);
      REQUIRE_FALSE(trace.warnings().empty());
      REQUIRE(trace.size() > 0);
      int pending = 0;
      for (std::int32_t polygon = 0; polygon < static_cast<std::int32_t>(scene.polygons.size()); ++polygon) {
        const std::string sentence = why_not(trace, polygon).sentence;
        CAPTURE(sentence);
        CHECK_FALSE(contains(sentence, "to background"));
        pending += contains(sentence, "cut off before its turn");
      }
      CHECK(pending > 0);
    }
  }

  TEST_CASE("a trace that was cut off, or comes from elsewhere and says less, is answered for as far as it goes") {
    const Scene scene = test::screen_scene(
        4, 4, {{{-1, -1, 2}, {5, -1, 2}, {5, 5, 2}, {-1, 5, 2}}, {{-1, -1, 1}, {5, -1, 1}, {5, 5, 1}, {-1, 5, 1}}});
    for (const Method& m : methods()) {
      if (m.needs != Needs::polygons) continue;
      CAPTURE(m.id);
      const Trace whole = test::recorded_by(std::string(m.id), scene);
      for (std::int64_t size = 0; size < whole.size(); size += std::max<std::int64_t>(1, whole.size() / 23)) {
        const Trace cut = test::changed(whole, [&](std::int64_t step, const Event&) { return step <= size; });
        for (const std::int32_t polygon : {0, 1}) {
          CHECK_FALSE(why_not(cut, polygon).sentence.empty());
          const Verdict verdict = why_not(cut, polygon, {2, 1});
          if (size == 0 && m.gives != Gives::lines) CHECK(verdict.kind == Why::not_recorded);
        }
      }
    }
    CHECK_THROWS_AS(why_not(test::recorded_by("z-buffer", scene), 2), std::out_of_range);
    CHECK_THROWS_AS(why_not(test::recorded_by("z-buffer", scene), 0, {4, 0}), std::out_of_range);
  }
}
