// Cutting an outline by a plane: its two parts are the outline, whatever its shape and however little it crosses.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "algorithms/pieces/pieces.hpp"

using namespace zstep;
using namespace zstep::pieces;
using clipping::Outline;

namespace {

// Inside by the even-odd rule, z left aside.
bool covers(const std::vector<glm::dvec3>& points, const Outline& outline, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3& a = points[static_cast<std::size_t>(outline[i])];
    const glm::dvec3& b = points[static_cast<std::size_t>(outline[i + 1 < outline.size() ? i + 1 : 0])];
    if ((a.y > y) != (b.y > y) && a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y) > x) inside = !inside;
  }
  return inside;
}

/// How many points of a grid are in the outline and not in exactly one of its parts, or in a part and not in the
/// outline.
int misplaced(std::vector<glm::dvec3> points, const Plane& plane, double tolerance) {
  const Plane own = plane_of(points);
  const double bend = bend_of(own, points);
  Outline outline(points.size());
  for (std::size_t i = 0; i < outline.size(); ++i) outline[i] = static_cast<std::int32_t>(i);
  const Halves halves = split(
      outline, own, bend, plane, tolerance, [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; },
      [&](std::int32_t, std::int32_t, double, glm::dvec3 point) {
        points.push_back(point);
        return static_cast<std::int32_t>(points.size()) - 1;
      });
  CHECK(halves.positive.size() >= 3);
  CHECK(halves.negative.size() >= 3);
  int wrong = 0;
  for (double y = 0.0537; y < 6; y += 0.1) {
    for (double x = 0.0512; x < 8; x += 0.1)
      wrong += covers(points, halves.positive, x, y) + covers(points, halves.negative, x, y) !=
               covers(points, outline, x, y);
  }
  return wrong;
}

// A comb of three teeth upwards.
std::vector<glm::dvec3> comb(const std::vector<double>& z) {
  std::vector<glm::dvec3> points{{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {7, 6, 0}, {7, 1, 0}, {5, 1, 0},
                                 {5, 6, 0}, {3, 6, 0}, {3, 1, 0}, {1, 1, 0}, {1, 6, 0}, {0, 6, 0}};
  for (std::size_t i = 0; i < z.size(); ++i) points[i].z = z[i];
  return points;
}

/// Through y = `at` where z = 0, rising by `slope` along y and by `lean` along x.
Plane tilted(double at, double slope, double lean = 0) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-lean, -slope, 1));
  return {normal.x, normal.y, normal.z, normal.z * slope * at};
}

}  // namespace

TEST_SUITE("pieces/split") {
  TEST_CASE("a planar comb across its teeth: the parts of a side hang together and cover nothing else") {
    for (const double slope : {1.0, 1e-3, 1e-6}) {
      CAPTURE(slope);
      CHECK(misplaced(comb({}), tilted(3.3, slope, slope / 10), 1e-12) == 0);
      CHECK(misplaced(comb({}), tilted(1, slope), 1e-12) == 0);  // through the feet of the teeth
    }
  }

  TEST_CASE("planes that almost coincide: corners within the tolerance may be far from the line of the cut") {
    // All values are below 7e-9: tips and feet of the teeth would count as on the plane, here and there.
    for (const double at : {1.2, 2.0, 3.3, 5.0})
      for (const double lean : {-2e-10, 1e-10, 3e-10}) CHECK(misplaced(comb({}), tilted(at, 1e-9, lean), 1e-9) == 0);
  }

  TEST_CASE("a comb that is not quite planar, cut by a plane that is as near as its corners are off") {
    const std::vector<double> z{0, 2e-6, -1e-6, 1e-6, -2e-6, 1e-6, 0, 2e-6, -1e-6, 2e-6, -1e-6, 1e-6};
    for (const double at : {1.2, 2.0, 3.3, 5.0})
      for (const double lean : {-1e-6, 0.0, 2e-6}) CHECK(misplaced(comb(z), tilted(at, 3e-6, lean), 1e-9) == 0);
  }
}
