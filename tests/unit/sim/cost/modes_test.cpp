// Ways of interpolating beside each other: what is measured, against what formulas predict.
#include "sim/cost/modes.hpp"

#include <cmath>
#include <optional>

#include <doctest/doctest.h>

#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/where.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using namespace zstep::compare;

namespace {

Scene poster(double near) {
  ViewOptions view;
  view.near = near;
  return look_at_scene(load_scene(test::in_checkout("lessons/scenes/poster.toml")).scene, view);
}

Mode mode_of(NumberFormat format, Conventions::Depth depth = Conventions::Depth::pseudodepth) {
  Mode mode{"", {}};
  mode.conventions.number_format = format, mode.conventions.depth = depth;
  return mode;
}

TEST_CASE(
    "two polygons 0.02 apart fight where a unit of the depth buffer is as large as that, and not where it is "
    "small") {
  for (const NumberFormat format : {NumberFormat::fixed16, NumberFormat::fixed20, NumberFormat::fixed24}) {
    CAPTURE(bits_of(format));
    std::optional<double> begins;
    for (double near = 10; near > 1e-5 && !begins; near /= 1.25)
      if (errors_of_mode(poster(near), mode_of(format)).wrong_pixels > 0) begins = near;
    REQUIRE(begins);
    // z_v^2 (1/f - 1/F)/2^b = 0.02 at z_v = 28, solved for f.
    const double predicted = 1 / (0.02 * std::ldexp(1.0, bits_of(format)) / (28.0 * 28.0) + 1 / 100.0);
    MESSAGE(bits_of(format), " bits: from near = ", *begins, " on, predicted ", predicted);
    CHECK(*begins < 2 * predicted);
    CHECK(*begins > predicted / 2);
  }
}

TEST_CASE(
    "float32 with reversed depth keeps thousands of times more of z_v than with pseudodepth, fixed point does not") {
  using Depth = Conventions::Depth;
  const Scene scene = poster(0.001);
  const double forward = errors_of_mode(scene, mode_of(NumberFormat::float32)).largest,
               reversed = errors_of_mode(scene, mode_of(NumberFormat::float32, Depth::reversed)).largest;
  CHECK(forward > 1000 * reversed);
  const double fixed_forward = errors_of_mode(scene, mode_of(NumberFormat::fixed24)).largest,
               fixed_reversed = errors_of_mode(scene, mode_of(NumberFormat::fixed24, Depth::reversed)).largest;
  CHECK(fixed_forward < 2 * fixed_reversed);
  CHECK(fixed_reversed < 2 * fixed_forward);
}

TEST_CASE(
    "rounding turns only compares that go the other way in exact numbers, and z_v that is not linear bends others") {
  const Scene scene = look_at_scene(load_scene(test::in_checkout("tests/data/crossed-boxes.toml")).scene, {});
  const ModeErrors linear = errors_of_mode(scene, mode_of(NumberFormat::float64, Conventions::Depth::view));
  CHECK(linear.wrong_pixels > 0);
  CHECK(linear.fighting_pixels == 0);
  CHECK(linear.bent_pixels >= linear.wrong_pixels);
  const ModeErrors right = errors_of_mode(scene, mode_of(NumberFormat::float64));
  CHECK(right.wrong_pixels + right.fighting_pixels + right.bent_pixels == 0);
  const ModeErrors coarse = errors_of_mode(poster(0.001), mode_of(NumberFormat::fixed16));
  CHECK(coarse.fighting_pixels > 0);
  CHECK(coarse.bent_pixels == 0);
}

TEST_CASE("modes are all combinations of their words, what cannot be drawn is named") {
  std::vector<std::string> left_out;
  Scene scene = load_scene("delhi").scene;
  const auto modes =
      modes_of(scene, {}, {{"depth", {"pseudodepth", "foley"}}, {"number_format", {"float32", "fixed16"}}}, left_out);
  REQUIRE(modes.size() == 2);
  CHECK(modes[1].text == "pseudodepth, fixed16");
  REQUIRE(left_out.size() == 2);
  CHECK(left_out[0].find("foley, float32: ") == 0);
}

TEST_CASE(
    "operations: a direct depth takes 4 additions, a multiplication and a division, an added one a single addition") {
  // One rectangle, 20 x 10 pixels: 10 spans, 2 edges.
  const Scene scene = load_scene(test::in_checkout("tests/golden/plate.toml")).scene;
  const ModeErrors direct = errors_of_mode(scene, mode_of(NumberFormat::float64));
  CHECK(direct.operations.pixels == 200);
  // Two edges, x and z by the formula on each of the ten scan lines.
  const std::int64_t on_edges = 2 * 2 * 10;
  CHECK(direct.operations.multiplications == 200 + on_edges);
  CHECK(direct.operations.divisions == 200 + on_edges);
  CHECK(direct.operations.additions == 4 * (200 + on_edges));
  Mode adds = mode_of(NumberFormat::float64);
  adds.conventions.interpolation = Conventions::Interpolation::increments;
  const ModeErrors added = errors_of_mode(scene, adds);
  CHECK(added.operations.multiplications == 2 * 2 + 10);  // the edges' beginnings, and the first pixel of each span
  CHECK(added.operations.divisions == 2 * 2 + 2 * 2 + 10 + 10);  // and the slopes of edges and spans
}

TEST_CASE("operations: a perspective-correct attribute interpolates two numbers, and divides once more at each pixel") {
  const Scene scene = look_at_scene(load_scene(test::in_checkout("lessons/scenes/receding.toml")).scene, {});
  Mode mode = mode_of(NumberFormat::float64);
  for (const auto attribute : {Conventions::Attribute::linear, Conventions::Attribute::perspective}) {
    const bool divides = attribute == Conventions::Attribute::perspective;
    CAPTURE(divides);
    mode.conventions.attribute = attribute;
    const Operations cost = errors_of_mode(scene, mode).attribute_operations;
    CollectRecorder record;
    interpolation::run(scene, mode.conventions, record);
    const auto spans = static_cast<std::int64_t>(record.all<SpanBegin>().size()),
               pixels = static_cast<std::int64_t>(record.all<AttributeInterpolate>().size());
    const std::int64_t numbers = divides ? 2 : 1;  // a, or a/z_v and 1/z_v
    CHECK(cost.pixels == pixels);
    CHECK(pixels > 100);
    // On both edges of a span and at each pixel a number takes what a depth does.
    const std::int64_t on_lines = numbers * (2 * spans + pixels);
    CHECK(cost.multiplications == on_lines);
    CHECK(cost.additions == 4 * on_lines);
    CHECK(cost.divisions == on_lines + (divides ? 2 * 4 * spans + pixels : 0));
  }
  mode.conventions.attribute = Conventions::Attribute::none;
  CHECK(errors_of_mode(scene, mode).attribute_operations.pixels == 0);
}

}  // namespace
