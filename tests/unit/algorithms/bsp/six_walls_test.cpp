// The six-polygon example of the lectures, worked by hand: seen from above, the walls are
//   A (-2,0)-(2,0)   B (-1,-3)-(-1,-1)   C (0,1)-(0,2)   D (0,-1)-(2,-2.5)   E (-2,4)-(2,1)   F (-4,-1)-(-2.5,1)
// and the planes A: -y = 0, B: x + 1 = 0, C: x = 0, D: -0.6x - 0.8y - 0.8 = 0, E: -0.6x - 0.8y + 2 = 0,
// F: 0.8x - 0.6y + 2.6 = 0.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "algorithms/bsp/bsp.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/where.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using namespace zstep::bsp;

namespace {

Scene six_walls() { return look_at_scene(load_scene(test::in_checkout("lessons/scenes/six-walls.toml")).scene, {}); }

// Names of pieces as the lectures give them: F1 is the part of F that was made first.
std::string name_of(const Tree& tree, std::int32_t piece) {
  std::string name(1, static_cast<char>('A' + tree.piece(piece).polygon));
  if (tree.piece(piece).outline.size() == 4 && piece < 6) return name;
  return name + (piece % 2 == 0 ? "1" : "2");
}

std::string shape(const Tree& tree, std::int32_t node = 0) {
  if (node < 0) return "-";
  const Node& at = tree.node(node);
  const std::string name = name_of(tree, at.pieces[0]);
  if (at.front < 0 && at.back < 0) return name;
  return name + "(" + shape(tree, at.front) + " " + shape(tree, at.back) + ")";
}

std::string order_from(const Tree& tree, glm::dvec4 eye, Order order = Order::back_to_front) {
  std::string names;
  NullRecorder nothing;
  traverse(
      tree, {eye, {}}, order,
      [&](std::int32_t node, double) {
        for (const std::int32_t piece : tree.node(node).pieces) {
          if (!names.empty()) names += ' ';
          names += name_of(tree, piece);
        }
      },
      nothing);
  return names;
}

}  // namespace

TEST_SUITE("bsp/six walls") {
  TEST_CASE("the tree with the first polygon as root of each subtree: F is cut by A, E by C") {
    NullRecorder nothing;
    const Tree tree = build(six_walls(), {Root::first}, nothing);
    CHECK(shape(tree) == "A(B(D F1) C(E1 E2(F2 -)))");
    CHECK(tree.pieces.size() == 10);
    CHECK(tree.nodes[0].nodes == 8);
    CHECK(tree.nodes[4].nodes == 4);
    // F is cut where y = 0: halfway, at x = -3.25; E where x = 0: halfway, at y = 2.5.
    REQUIRE(tree.points.size() == 28);
    CHECK(tree.points[24] == glm::dvec3(-3.25, 0, 0));
    CHECK(tree.points[25] == glm::dvec3(-3.25, 0, 1));
    CHECK(tree.points[26] == glm::dvec3(0, 2.5, 0));
    CHECK(tree.points[27] == glm::dvec3(0, 2.5, 1));
  }

  TEST_CASE("the order of drawing for two eyes, from one tree") {
    NullRecorder nothing;
    const Tree tree = build(six_walls(), {Root::first}, nothing);
    const glm::dvec4 eye_1(-3, -8, 3, 1), eye_2(3, 8, 3, 1);
    CHECK(order_from(tree, eye_1) == "E1 C E2 F2 A D B F1");
    CHECK(order_from(tree, eye_2) == "F1 B D A F2 E2 C E1");
    CHECK(order_from(tree, eye_1, Order::front_to_back) == "F1 B D A F2 E2 C E1");
    CHECK(order_from(tree, eye_2, Order::front_to_back) == "E1 C E2 F2 A D B F1");
    // In parallel projection the eye is a direction; from the right, C and B are seen from their front.
    CHECK(order_from(tree, {1, 0, 0, 0}) == "F1 B D A F2 E2 C E1");
  }

  TEST_CASE("the eye in each plane, as the lesson prints it") {
    CollectRecorder record;
    const Scene scene = six_walls();
    const Tree tree = build(scene, {Root::first}, record);
    CHECK(record.all<RootCandidate>().empty());
    traverse(
        tree, eye_of(scene.camera, scene.raster, false), Order::back_to_front, [](std::int32_t, double) {}, record);
    const auto sides = record.all<EyeSide>();
    REQUIRE(sides.size() == 8);
    const double expected[8] = {8, -2, 7.4, 5, -3, 10.2, 10.2, 5};  // A B D F1 C E1 E2 F2
    for (const EyeSide& side : sides) {
      CHECK(side.value == doctest::Approx(expected[side.node]).epsilon(1e-14));
      CHECK(side.front == (side.value > 0));
    }
  }

  TEST_CASE("fewest splits: with E, then F, then A as roots nothing is cut at all") {
    CollectRecorder record;
    const Tree tree = build(six_walls(), {Root::fewest_splits, 6, 1}, record);
    CHECK(shape(tree) == "E(F(A(B(D -) C) -) -)");
    CHECK(tree.pieces.size() == 6);
    CHECK(record.all<SplitVertex>().empty());
    const auto candidates = record.all<RootCandidate>();
    REQUIRE(candidates.size() >= 5);
    const std::int32_t splits[5] = {1, 2, 2, 2, 0};  // A cuts F; B cuts A and E; C the same; D cuts A and F; E none
    for (std::int32_t i = 0; i < 5; ++i) {
      CHECK(candidates[static_cast<std::size_t>(i)].piece == i);
      CHECK(candidates[static_cast<std::size_t>(i)].splits == splits[i]);
    }
  }

  TEST_CASE("one candidate is the first, a seed gives the same tree again, and seeds give different trees") {
    NullRecorder nothing;
    const Scene scene = six_walls();
    CHECK(shape(build(scene, {Root::fewest_splits, 1, 1}, nothing)) == shape(build(scene, {Root::first}, nothing)));
    std::set<std::string> shapes;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const std::string one = shape(build(scene, {Root::random, 5, seed}, nothing));
      CHECK(one == shape(build(scene, {Root::random, 5, seed}, nothing)));
      shapes.insert(one);
    }
    CHECK(shapes.size() > 3);
  }
}
