// Input that is hard for depth sort has a stated outcome, and always an end.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "tests/unit/algorithms/depth_sort/sorted.hpp"

using namespace zstep;
using namespace zstep::test;
namespace step = zstep::depth_sort::step;

TEST_SUITE("depth_sort/degenerate") {
  TEST_CASE("in one plane: the later in the file is drawn first, whatever their farthest z") {
    for (const bool first_is_long : {true, false}) {
      const Ring small = slope(3, 9, 2, 12, 3, 9), large = slope(1, 12, 4, 10, 1, 12);  // both in z = x
      const Sorted sorted = first_is_long ? sort_pair(large, small) : sort_pair(small, large);
      CHECK(sorted.order() == Order{1, 0});
      CHECK(sorted.count(step::split.id) == 0);
      CHECK(sorted.wrong == 0);
    }
  }

  TEST_CASE("the same polygon several times, either way round: the first is seen") {
    const Ring once = slope(1, 12, 4, 10, 1, 12);
    const Scene scene = screen_scene(16, 16, {once, Ring(once.rbegin(), once.rend()), once, once});
    const Sorted sorted = sort(scene);
    CHECK(sorted.order() == Order{3, 2, 1, 0});
    for (const std::int32_t polygon : sorted.picture.polygon) CHECK((polygon == 0 || polygon == no_polygon));
  }

  TEST_CASE("edge-on, without area, one polygon, none") {
    CHECK(sort_pair({{1, 1, 0}, {9, 1, 0}, {9, 1, 9}}, square(0, 0, 9, 4)).order() == Order{1});
    CHECK(sort_pair({{1, 1, 0}, {2, 2, 0}, {3, 3, 0}}, square(0, 0, 9, 4)).order() == Order{1});
    CHECK(sort(screen_scene(8, 8, {square(1, 1, 4, 2)})).order() == Order{0});
    CHECK(sort(screen_scene(8, 8, {})).order().empty());
    CHECK(sort(screen_scene(0, 0, {square(1, 1, 4, 2), square(1, 1, 4, 2)})).order() == Order{1, 0});
  }

  TEST_CASE("almost edge-on: its plane is steep, and it is drawn in its place") {
    const Ring steep{{5.5, 1, -40}, {5.6, 1, 60}, {9.6, 13, 60}, {9.5, 13, -40}};
    CHECK(sort_pair(steep, slope(1, 14, 2, 12, 9, 3)).wrong == 0);
    CHECK(sort_pair(slope(1, 14, 2, 12, 9, 3), steep).wrong == 0);
  }

  TEST_CASE("concave: a bar through the notch of a U, and through its walls") {
    const Ring u{{1, 1, 1}, {13, 1, 13}, {13, 13, 13}, {9, 13, 9}, {9, 5, 9}, {5, 5, 5}, {5, 13, 5}, {1, 13, 1}};
    const Sorted through = sort_pair(u, slope(0, 15, 8, 10, 11, 3));
    CHECK(through.count(step::split.id) == 1);
    CHECK(through.wrong == 0);
    const Sorted notch = sort_pair(u, slope(5.2, 8.8, 6, 12, 9, 3));
    CHECK(notch.count(step::split.id) == 0);
    CHECK(notch.only(step::test_5).overlap == false);
    CHECK(notch.wrong == 0);
  }

  TEST_CASE("crossing itself with a signed area of zero: it has no plane and is dropped") {
    const Ring even{{1, 1, 1}, {13, 13, 13}, {13, 1, 13}, {1, 13, 1}};
    const Sorted sorted = sort_pair(even, square(0, 0, 9, 20));
    CHECK(sorted.order() == Order{1});
    CHECK(sorted.record.all<PolygonReject>().size() == 1);
  }

  TEST_CASE("crossing itself: a bow tie, cut") {
    const Ring bow_tie{{1, 1, 1}, {13, 12, 13}, {13, 1, 13}, {1, 9, 1}};
    CHECK(sort_pair(bow_tie, slope(0, 15, 2, 12, 12, 2)).wrong == 0);
  }

  TEST_CASE("depths and coordinates at the ends of the numbers do no harm") {
    CHECK(sort_pair({{0, 0, -1.7e308}, {8, 0, 1.7e308}, {8, 8, 1.7e308}}, square(0, 0, 9, 4)).order().back() == 1);
    const Ring vast = slope(-1e8, 1e8, -1e8, 1e8, 2, 4);
    CHECK(sort_pair(vast, square(2, 2, 5, 1)).wrong == 0);
    CHECK(sort_pair(vast, vast).order() == Order{1, 0});
  }

  TEST_CASE("rings of many bars, each over the next: they end") {
    for (const int bars : {3, 4, 5, 8, 13}) {
      std::vector<Ring> polygons;
      for (int i = 0; i < bars; ++i) {
        const double angle = 6.28318530717958647692 * i / bars;
        const glm::dvec2 out(std::cos(angle), std::sin(angle)), along(-out.y, out.x);
        const double reach = 20 * std::tan(3.14159265358979 / bars) + 6;
        const auto corner = [&](double r, double s) {
          const glm::dvec2 point = glm::dvec2(32.3, 31.6) + r * out + s * along;
          return glm::dvec3(point, 10 + 5 * s / reach);
        };
        polygons.push_back({corner(18, -reach), corner(22, -reach), corner(22, reach), corner(18, reach)});
      }
      const Sorted sorted = sort(screen_scene(64, 64, polygons));
      CAPTURE(bars);
      CHECK(sorted.count(step::split.id) >= 1);
      CHECK(sorted.count(step::split.id) <= 2 * bars);
      CHECK(sorted.wrong == 0);
    }
  }

  TEST_CASE("a ring in which neither P nor the marked Q crosses the other's plane: another one of it is split") {
    int others = 0;
    for (unsigned seed = 1; seed <= 260; ++seed) {
      Numbers random(seed);
      std::vector<Ring> bars(3 + seed % 4);
      for (Ring& bar : bars) {
        const double angle = random.between(0, 6.283), x = random.between(10, 22), y = random.between(10, 22);
        const double length = random.between(5, 14), width = random.between(0.7, 2), z = random.between(0, 10);
        const double along = random.between(-0.6, 0.6), across = random.between(-3, 3);
        const auto corner = [&](double s, double t) {
          return glm::dvec3(x + s * std::cos(angle) - t * std::sin(angle),
                            y + s * std::sin(angle) + t * std::cos(angle), z + along * s + across * t);
        };
        bar = {corner(-length, -width), corner(length, -width), corner(length, width), corner(-length, width)};
      }
      const Sorted sorted = sort(screen_scene(32, 32, bars));
      CAPTURE(seed);
      CHECK(sorted.wrong == 0);
      PairBegin pair{};
      for (const CollectedEvent& event : sorted.record.events) {
        if (event.step == step::pair.id) pair = get<PairBegin>(event.event);
        if (event.step != step::split.id) continue;
        const auto& split = get<SideTest>(event.event);
        const std::set<std::int32_t> asked{pair.piece, pair.other}, cut{split.piece, split.plane_of};
        others += asked != cut;
      }
    }
    CHECK(others > 0);
  }

  TEST_CASE("a sheaf of random triangles through one point") {
    Numbers random(7);
    std::vector<Ring> polygons;
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 a = 14.0 * random.in_box(1), b = 14.0 * random.in_box(1), middle(16, 16, 0);
      polygons.push_back({middle + a, middle + b, middle - a - b});
    }
    const Sorted sorted = sort(screen_scene(32, 32, polygons));
    MESSAGE("a sheaf of 40: ", sorted.count(step::split.id), " splits");
    CHECK(sorted.wrong == 0);
  }
}
