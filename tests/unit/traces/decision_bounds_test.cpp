// What rounding may do to a point's distance from a plane, by which a wrong decision is told from one that rounding
// cannot have made: held from both sides. (How near real runs come to it: tests/laws/decisions_test.cpp.)
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/laws/decisions/decisions.hpp"

using namespace zstep;
using oracle::Decided, oracle::Predicate;

namespace {

constexpr double u = 0x1p-53;  // what one rounding does, as a share

/// A tree whose planes divide in the order of the file, and the side of `vertex` of the plane of `piece` told wrongly.
template <class Change>
Decided told_wrongly(const Scene& scene, std::int32_t vertex, std::int32_t piece, Change&& change) {
  Conventions conventions;
  conventions.cull = false;
  conventions.options["root"] = "first";
  int told = 0;
  const Trace wrong = test::changed(test::recorded_by("bsp", scene, conventions), [&](std::int64_t, Event& event) {
    change(event);
    if (auto* side = get_if<VertexSide>(&event); side && side->vertex == vertex && side->plane_of == piece)
      side->side = Side::behind, ++told;
    return true;
  });
  REQUIRE(told > 0);
  return oracle::decisions_of(wrong)[Predicate::vertex_side];
}

/// How far a point at this distance above z = 2 is, as a multiple of what rounding may do. The plane is that of
/// `corners`, all at z = 2; distances are whole numbers of last digits of 2, which are 4u.
double of_bound(const std::vector<glm::dvec3>& corners, glm::dvec2 at, double away) {
  const double digits = std::floor(away / (4 * u));
  const Scene scene = test::screen_scene(16, 16, {corners, {{at.x, at.y, 2 + 4 * u * digits}, {12, 1, 6}, {1, 12, 7}}});
  const Decided found = told_wrongly(scene, static_cast<std::int32_t>(corners.size()), 0, [](Event&) {});
  REQUIRE(found.wrong == 1);
  return found.worst;
}

TEST_CASE("decisions: a vertex just within what rounding may do to its distance from a plane, and one just beyond") {
  // Newell's normal of n corners rounds the differences, the products and the sums of its terms, and is divided by its
  // length: (8 + 2n)u of the terms, which turns the plane about the mean of its corners. Ax + By + Cz + D and the mean
  // round what is as large as the point and the mean: 16u of their coordinates.
  //
  // Corners (0, 0), (8, 0), (0, 8): one term, 8·8 = 64, and as long a normal: 14u. The point (4, 4) is 4/3 + 4/3 from
  // the mean (8/3, 8/3); its coordinates add up to 10, those of the mean to 22/3. Nearly all of it is the 16u.
  const std::vector<glm::dvec3> wide{{0, 0, 2}, {8, 0, 2}, {0, 8, 2}};
  const double of_wide = 14 * u * (8 / 3.0) + 16 * u * (10 + 22 / 3.0);
  CHECK(of_bound(wide, {4, 4}, 0.9 * of_wide) == doctest::Approx(0.9).epsilon(0.02));
  CHECK(of_bound(wide, {4, 4}, 1.5 * of_wide) == doctest::Approx(1.5).epsilon(0.02));

  // A sliver: the term is 8·(8 + 1/64), the normal 1/8 long, which makes 14u·513. The point (4, 12) is 4/3 + 12 − 1/192
  // from the mean (16/3, 1/192). Nearly all of it is the 14u.
  const std::vector<glm::dvec3> sliver{{0, 0, 2}, {8, 0, 2}, {8, 1 / 64.0, 2}};
  const double of_sliver = 14 * u * 513 * (4 / 3.0 + 12 - 1 / 192.0) + 16 * u * (18 + 16 / 3.0 + 1 / 192.0 + 2);
  CHECK(of_bound(sliver, {4, 12}, 0.9 * of_sliver) == doctest::Approx(0.9).epsilon(0.02));
  CHECK(of_bound(sliver, {4, 12}, 1.5 * of_sliver) == doctest::Approx(1.5).epsilon(0.02));

  // A square: two terms, 8·16 and 16·8, the normal 128 long, which makes 16u·2. The point (12, 12) is 8 + 8 from the
  // mean.
  const std::vector<glm::dvec3> square{{0, 0, 2}, {8, 0, 2}, {8, 8, 2}, {0, 8, 2}};
  const double of_square = 16 * u * 2 * 16 + 16 * u * (26 + 10);
  CHECK(of_bound(square, {12, 12}, 0.9 * of_square) == doctest::Approx(0.9).epsilon(0.02));
  CHECK(of_bound(square, {12, 12}, 1.5 * of_square) == doctest::Approx(1.5).epsilon(0.02));
}

TEST_CASE("decisions: a vertex that cutting made may be as far off as it was put") {
  // The first plane, x = 4, cuts the third triangle at z = 2 + 2⁻²⁰, which is that far from the second, z = 2.
  const double away = 0x1p-20;
  const double z = 2 + away;
  const Scene scene = test::screen_scene(
      16, 16,
      {{{4, 0, 0}, {4, 15, 0}, {4, 8, 9}}, {{5, 5, 2}, {12, 5, 2}, {5, 12, 2}}, {{1, 1, z}, {9, 2, z}, {2, 12, z}}});
  const auto of_slip = [&](double slip) {
    std::int32_t made = -1;
    test::changed(test::recorded_by("bsp", scene), [&](std::int64_t, Event& event) {
      if (const auto* split = get_if<SplitVertex>(&event); split && made < 0) made = split->vertex;
      return true;
    });
    const Decided found = told_wrongly(scene, made, 1, [&](Event& event) {
      if (auto* split = get_if<SplitVertex>(&event); split && split->vertex == made) split->x_cut += slip;
    });
    REQUIRE(found.wrong == 1);
    return found.worst;
  };
  CHECK(of_slip(away / 0.9) == doctest::Approx(0.9).epsilon(1e-3));
  CHECK(of_slip(away / 1.5) == doctest::Approx(1.5).epsilon(1e-3));
}

}  // namespace
