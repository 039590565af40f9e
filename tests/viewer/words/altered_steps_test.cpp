// Steps of golden traces with one field altered: whole sentences about what the trace says and its numbers contradict,
// and none where they only just agree.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// The first step of a kind for which fits(event, state after it) is true, altered.
template <class E, class Fits, class Alter>
Explanation told(const std::string& golden, Fits&& fits, Alter&& alter) {
  const Trace trace = open_jsonl(test::in_checkout("tests/golden/" + golden + ".jsonl"));
  Replay replay(trace);
  while (replay.position() < trace.size()) {
    replay.step_forward();
    RecordedEvent event = *replay.current();
    if (!holds<E>(event.event) || !fits(get<E>(event.event), replay.state())) continue;
    alter(get<E>(event.event));
    return explain(trace, replay.state(), event);
  }
  FAIL("no such step in " << golden);
  return {};
}
template <class E, class Alter>
Explanation told(const std::string& golden, Alter&& alter) {
  return told<E>(
      golden, [](const E&, const State&) { return true; }, alter);
}
const auto same = [](auto&) {};

/// Its sentence, where that is doubted as well.
std::string contradicted(const Explanation& told) {
  CHECK(told.doubt);
  return told.sentence;
}
bool has_formula(const Explanation& told, const std::string& line) {
  return std::find(told.formulas.begin(), told.formulas.end(), line) != told.formulas.end();
}

}  // namespace

TEST_CASE("altered steps: an edge or a span that begins or ends elsewhere") {
  CHECK(contradicted(told<EdgeTableInsert>("pyramid", [](EdgeTableInsert& e) { ++e.first_row; })) ==
        "The trace lets edge e0 from vertex 1 to vertex 0 begin at scan line 11 and leave at 15; its ends are at y = "
        "9.8483 and 14.6765, so it should begin at 10 and leave at 15.");
  CHECK(contradicted(told<EdgeTableInsert>("pyramid", [](EdgeTableInsert& e) { ++e.end_row; })) ==
        "The trace lets edge e0 from vertex 1 to vertex 0 begin at scan line 10 and leave at 16; its ends are at y = "
        "9.8483 and 14.6765, so it should begin at 10 and leave at 15.");
  const auto single = [](const SpanBegin& e, const State&) { return e.first == e.last; };
  CHECK(contradicted(told<SpanBegin>("pyramid", single, [](SpanBegin& e) { ++e.last; })) ==
        "The trace fills x = 8 to 9 of scan line 5 between e2 and e1; by x_L = 7.7075 and x_R = 8.5223 it should fill "
        "8 to 8.");
  const auto empty = [](const SpanBegin& e, const State&) { return e.first > e.last; };
  CHECK(contradicted(told<SpanBegin>("pyramid", empty, [](SpanBegin& e) { e.last = e.first; })) ==
        "The trace fills x = 8 to 8 of scan line 4 between e2 and e1; by x_L = 7.5537 and x_R = 7.7645 it should fill "
        "nothing.");
}

TEST_CASE("altered steps: what the light reaches, as far as its picture goes") {
  const auto lit = [](const ShadowCompare& e, const State&) { return e.lit; };
  CHECK(has_formula(told<ShadowCompare>("shadow-buffer", lit, same),
                    "shadow[6, 3] = 0.742;  0.3855 is not behind it by more than the bias"));
  const auto dark = [](const ShadowCompare& e, const State&) { return !e.lit; };
  CHECK(has_formula(told<ShadowCompare>("shadow-buffer", dark, same),
                    "shadow[5, 2] = 0.4955;  0.7036 is behind it by more than the bias: dark"));
  const auto nearer = [](ShadowCompare& e) { e.lit = false, e.z_light -= 0.5; };
  CHECK(contradicted(told<ShadowCompare>("shadow-buffer", lit, nearer)) ==
        "The trace says that B is in shadow at pixel (4, 2), but its depth, \u22120.1145, is less than the 0.742 that "
        "the light sees there.");
  CHECK(told<ShadowCompare>("shadow-buffer", lit, [](ShadowCompare& e) { e.x_light = -0.6; }).sentence ==
        "The point of B at pixel (4, 2) lies beside the light's window: dark.");
  CHECK(has_formula(told<ShadowCompare>("shadow-buffer", lit, [](ShadowCompare& e) { e.x_light = -0.4; }),
                    "shadow[0, 3] = \u221e;  0.3855 is not behind it by more than the bias"));
}

TEST_CASE("altered steps: rays, boxes and planes") {
  const auto misses = [](const BoxTest& e, const State&) { return e.t_enter > e.t_leave; };
  CHECK(told<BoxTest>("ray-casting-hierarchy", misses, [](BoxTest& e) { e.hit = true; }).doubt ==
        "The trace says that the ray meets box 1, but t_enter = 4 > 2.16 = t_leave.");
  CHECK_FALSE(told<BoxTest>("ray-casting-hierarchy", misses, same).doubt);
  CHECK(told<RayPlane>("ray-casting", [](RayPlane& e) { e.t = 0, e.numerator = 0; }).sentence ==
        "The ray meets the plane of A at t = 0.");
  const auto beside = [](double denominator) {
    return told<RayPlane>("ray-casting", [=](RayPlane& e) { e.t = std::nan(""), e.denominator = denominator; });
  };
  CHECK(has_formula(beside(0), "A\u00b7dX + B\u00b7dY + C\u00b7dZ = 0"));
  CHECK(has_formula(beside(1e-17), "A\u00b7dX + B\u00b7dY + C\u00b7dZ = 1.00e\u221217, which is 0 to rounding"));
  CHECK(contradicted(told<RayHit>("ray-casting", [](RayHit& e) { e.inside = false, e.nearest = true; })) ==
        "The point lies outside A, and yet the trace keeps it.");
  const auto kept = [](const RayHit& e, const State&) { return e.inside && e.nearest; };
  CHECK(contradicted(told<RayHit>("ray-casting", kept, [](RayHit& e) { e.nearest = false; })) ==
        "The point lies inside A, and nothing nearer is known, but the trace does not keep it.");
}

TEST_CASE("altered steps: extents that meet, touch or do not") {
  const auto beside = [](const ExtentTest& e, const State&) { return !e.overlap && e.axis != Axis::z; };
  CHECK(contradicted(told<ExtentTest>("depth-sort", beside, [](ExtentTest& e) { e.overlap = true; })) ==
        "The trace says that the x extents of A and B overlap, but 3.5 \u2026 15.5 and 18.5 \u2026 29.5 do not.");
  const auto meet = [](const ExtentTest& e, const State&) { return e.overlap && e.axis != Axis::z; };
  const Explanation apart = told<ExtentTest>("depth-sort", meet, [](ExtentTest& e) { e.overlap = false; });
  CHECK(contradicted(apart) ==
        "The trace says that the x extents of A and C do not overlap, but 3.5 \u2026 15.5 and 3.5 \u2026 14.5 do.");
  CHECK(apart.formulas.size() == 1);  // no order of their ends that does not hold
  const auto touch = [](ExtentTest& e) { e.overlap = false, e.other_low = e.high, e.other_high = e.high + 1; };
  const Explanation touching = told<ExtentTest>("depth-sort", meet, touch);
  CHECK(touching.sentence == "The x extents of A and C do not overlap: neither can hide the other.");
  CHECK(has_formula(touching, "15.5 \u2264 15.5"));
  CHECK_FALSE(touching.doubt);
}

TEST_CASE("altered steps: sides of planes") {
  const auto crossing = [](const SideTest& e, const State&) { return e.side == Side::crossing; };
  CHECK(contradicted(told<SideTest>("depth-sort", crossing, [](SideTest& e) { e.side = Side::front; })) ==
        "The trace says that A lies on the eye's side of the plane of F, but its values there run from \u22123.5777 to "
        "6.261: it lies on both sides.");
  CHECK(told<SideTest>("depth-sort", crossing, [](SideTest& e) { e.greatest += 1; }).doubt ==
        "The trace records the greatest value = 7.261, but this formula gives 6.261.");
  const auto front = [](const SideTest& e, const State&) { return e.side == Side::front; };
  CHECK(contradicted(told<SideTest>("depth-sort", front, [](SideTest& e) { e.side = Side::crossing; })) ==
        "The trace says that E lies on both sides of the plane of A, but its values there run from \u22122.9069 to "
        "\u22120.2236: it lies on one side.");
  CHECK(contradicted(told<EyeSide>("bsp", [](EyeSide& e) { e.front = true, e.value = 0; })) ==
        "The trace takes the eye for in front of the plane of A, but its value there, 0, says behind.");
  const Explanation touched = told<NodeSkip>("bsp-behind", [](NodeSkip& e) { e.value = 0; });
  CHECK(contradicted(touched) ==
        "The trace skips what lies behind the plane of A, but the view volume reaches there: its least value is 0.");
  CHECK(has_formula(touched, "least of A\u00b7x_w + B\u00b7y_w + C\u00b7z_w + D over the view volume's corners = 0"));
  CHECK_FALSE(told<ClipVertex>("clipping", [](ClipVertex& e) { e.inside = true, e.distance = 0; }).doubt);
  CHECK(contradicted(told<ClipVertex>("clipping", [](ClipVertex& e) { e.inside = false, e.distance = 0; })) ==
        "The trace takes vertex 0 for outside the near plane, but the value there says inside.");
  CHECK(contradicted(told<FacingTest>("pyramid", [](FacingTest& e) { e.determinant = -e.determinant; })) ==
        "The trace says that polygon A faces the eye, but its four numbers do not agree.");
}

TEST_CASE("altered steps: areas, curves and depths that were taken over") {
  const auto around = [](const AreaBin& e, const State&) {
    return e.bin == Bin::surrounding && !e.by_box && e.crossings == 0 && e.corners_inside == 4;
  };
  CHECK(contradicted(told<AreaBin>("warnock", around, [](AreaBin& e) { e.corners_inside = 3; })) ==
        "The trace says that B is surrounding, but 0 of its edges meet the area and 3 of the area's corners lie inside "
        "it.");
  CHECK(contradicted(told<AreaBin>("warnock", around, [](AreaBin& e) { e.bin = Bin::disjoint; })) ==
        "The trace says that B is disjoint, but 0 of its edges meet the area and 4 of the area's corners lie inside "
        "it.");
  const auto hidden = [](const HorizonTest& e, const State&) { return e.verdict == Horizon::hidden; };
  CHECK(contradicted(told<HorizonTest>("floating-horizon", hidden, [](HorizonTest& e) {
          e.verdict = Horizon::above;
        })) == "On column 7 the trace says above, but by these numbers the curve is hidden.");
  CHECK(contradicted(told<DepthWrite>("pyramid", [](DepthWrite& e) { e.z += 0.25; })) ==
        "The depth buffer at (8, 5) takes \u22120.4186, though \u22120.6686 was compared.");
  CHECK(told<DepthCompare>("pyramid", [](DepthCompare& e) { e.z -= 0.25; }).doubt ==
        "The trace compares z* = \u22120.9186, but had interpolated z* = \u22120.6686.");
}

TEST_CASE("by increments every pixel but the first of its span tells what it was added to") {
  const Trace trace = test::record_run("foley", {}, Conventions::Interpolation::increments);
  Replay replay(trace);
  int added = 0;
  while (replay.position() < trace.size()) {
    replay.step_forward();
    const auto* z = get_if<DepthInterpolate>(&replay.current()->event);
    if (!z) continue;
    const std::int32_t x = z->x;
    const Explanation told = explain(trace, replay.state(), *replay.current());
    REQUIRE(told.formulas.size() == 1);
    const bool first = x == replay.state().machine.span->first;
    CHECK((told.formulas[0].find(" + dz/dx = ") != std::string::npos) == !first);
    added += !first;
  }
  CHECK(added > 0);
}
