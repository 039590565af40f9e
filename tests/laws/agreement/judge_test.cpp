// The judge of the law of agreement is itself on trial here: it must find what is wrong, and know why the rest is
// right.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "sim/truth/explain_difference.hpp"
#include "tests/laws/agreement/scenes.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;
using namespace zstep::compare;
using namespace zstep::test;

namespace {

const AgreementScene& scene_named(std::string_view name) {
  for (const AgreementScene& candidate : agreement_scenes()) {
    if (candidate.name == name) return candidate;
  }
  throw std::invalid_argument("no scene " + std::string(name));
}

Conventions conventions_of(const AgreementScene& subject) {
  Conventions conventions;
  conventions.cull = subject.cull;
  return conventions;
}

Picture z_buffered(const Scene& scene, const Conventions& conventions) {
  NullRecorder nothing;
  return z_buffer::run(scene, conventions, nothing);
}

// Every polygon over those before it, in the order of the file.
Picture painted_in_file_order(const Truth& truth) {
  Picture picture(truth.width(), truth.height());
  for (std::int32_t y = 0; y < truth.height(); ++y) {
    for (std::int32_t x = 0; x < truth.width(); ++x) {
      for (const Candidate& candidate : truth.at(x, y)) {
        std::int32_t& polygon = picture.polygon[picture.at(x, y)];
        if (candidate.covers) polygon = std::max(polygon, candidate.polygon);
      }
    }
  }
  return picture;
}

}  // namespace

TEST_SUITE("laws/agreement/judge") {
  TEST_CASE("a square on the raster: what covers, how deep, how far from an edge") {
    const Scene scene = screen_scene(8, 6, {{{1, 1, 2}, {5, 1, 6}, {5, 4, 6}, {1, 4, 2}}});
    const Truth truth(scene, false);
    REQUIRE(truth.at(3, 2).size() == 1);
    const Candidate& middle = truth.at(3, 2)[0];
    CHECK(middle.covers);
    CHECK(middle.sure());
    CHECK(middle.z == doctest::Approx(4));
    CHECK(middle.slope == doctest::Approx(1));
    CHECK(middle.edge == doctest::Approx(1));
    REQUIRE(truth.at(1, 3).size() == 1);
    CHECK(truth.at(1, 3)[0].edge == 0);
    CHECK_FALSE(truth.at(1, 3)[0].sure());
    CHECK(truth.at(0, 0).empty());
    CHECK(truth.nearest(3, 2) == 0);
    CHECK(truth.nearest(6, 2) == no_polygon);
  }

  TEST_CASE("a square seen in perspective: its plane's depth, and back faces") {
    // Looking from (4, 0, 0) at x = 1: z_v = 3, a window of 2 x 2 at distance 1 over 16 x 16 pixels.
    Scene scene;
    add_polygon(scene, std::vector<glm::dvec3>{{1, -1.5, -1.5}, {1, 1.5, -1.5}, {1, 1.5, 1.5}, {1, -1.5, 1.5}});
    scene.raster = {16, 16, false};
    look(scene, Camera::Kind::perspective, 4, 0, 90, 1, 10);
    const Truth front(scene, true);
    REQUIRE(front.at(6, 8).size() == 1);
    CHECK(front.at(6, 8)[0].z == doctest::Approx(3).epsilon(1e-14));
    CHECK(front.at(6, 8)[0].edge == doctest::Approx(2.5));  // the square spans columns 3.5 to 11.5
    CHECK(front.at(3, 8).empty());
    CHECK(front.at(4, 8)[0].edge == doctest::Approx(0.5));
    std::reverse(scene.corners.begin(), scene.corners.end());
    CHECK(Truth(scene, true).at(6, 8).empty());
    CHECK(Truth(scene, false).at(6, 8).size() == 1);
  }

  TEST_CASE("the near plane makes an edge") {
    Scene scene;  // a floor under the eye, cut where z_v = 1: there it is 0.5 below the eye, half a window's half
    add_polygon(scene, std::vector<glm::dvec3>{{9, -5, -0.5}, {9, 5, -0.5}, {-9, 5, -0.5}, {-9, -5, -0.5}});
    scene.raster = {16, 16, false};
    look(scene, Camera::Kind::perspective, glm::dvec3(4, 0, 0), glm::dvec3(0, 0, 0), 1, 20);
    const Truth truth(scene, false);
    REQUIRE(truth.at(8, 11).size() == 1);
    CHECK(truth.at(8, 11)[0].edge == doctest::Approx(0.5));  // the cut runs at row 11.5
    CHECK(truth.at(8, 12).empty());
  }

  TEST_CASE("each pixel of a picture made wrong, one at a time, is found, but for edges and ties") {
    for (const std::string name : {"intersecting", "cyclic", "foley", "on the screen", "eye inside"}) {
      CAPTURE(name);
      const AgreementScene& subject = scene_named(name);
      const Truth truth(subject.scene, subject.cull);
      const Picture right = z_buffered(subject.scene, conventions_of(subject));
      Picture picture = right;
      int found = 0, open = 0;
      for (std::size_t pixel = 0; pixel < picture.polygon.size(); ++pixel) {
        std::int32_t& polygon = picture.polygon[pixel];
        polygon = polygon + 1 < static_cast<std::int32_t>(subject.scene.polygons.size()) ? polygon + 1 : no_polygon;
        const auto x = static_cast<std::int32_t>(pixel) % picture.width,
                   y = static_cast<std::int32_t>(pixel) / picture.width;
        const Explanation why = explain(truth, x, y, polygon);
        if (why.reason == Reason::wrong) ++found;
        else ++open;
        CHECK(why.reason != Reason::none);
        polygon = right.polygon[pixel];
      }
      CHECK(found > 0);
      CHECK(open * 5 <= found);
    }
  }

  TEST_CASE("a wrong polygon amidst another is named, with its pixel") {
    const AgreementScene& subject = scene_named("intersecting");
    const Conventions conventions = conventions_of(subject);
    const Picture right = z_buffered(subject.scene, conventions);
    Picture wrong = right;
    const std::size_t pixel = wrong.at(30, 23);
    REQUIRE(right.polygon[pixel] != no_polygon);
    wrong.polygon[pixel] = no_polygon;
    wrong.depth[pixel] = no_depth;
    const Verdict verdict = explain_difference(subject.scene, conventions, right, wrong);
    REQUIRE(verdict.differences.size() == 1);
    CHECK(verdict.unexplained == 1);
    CHECK(verdict.differences[0].x == 30);
    CHECK(verdict.differences[0].y == 23);
    CHECK(verdict.complaints().find("something must be seen; polygon ") != std::string::npos);
    const Truth truth(subject.scene, subject.cull);
    CHECK(hold_against_truth(truth, subject.scene, conventions, wrong).unexplained == 1);
    CHECK(hold_against_truth(truth, subject.scene, conventions, right).holds());
  }

  TEST_CASE("a picture moved by one column is wrong") {
    const AgreementScene& subject = scene_named("teapot");
    const Truth truth(subject.scene, subject.cull);
    const Picture right = z_buffered(subject.scene, conventions_of(subject));
    Picture moved = right;
    std::rotate(moved.polygon.begin(), moved.polygon.begin() + 1, moved.polygon.end());
    const Verdict verdict = explain_difference(truth, right, moved);
    CHECK(verdict.unexplained > 500);
    CHECK(verdict.explained() < 10);
  }

  TEST_CASE("a depth that is off by a millionth is found") {
    const AgreementScene& subject = scene_named("n-gons");
    const Truth truth(subject.scene, subject.cull);
    const Conventions conventions = conventions_of(subject);
    Picture picture = z_buffered(subject.scene, conventions);
    REQUIRE(hold_against_truth(truth, subject.scene, conventions, picture).holds());
    const std::size_t pixel = picture.at(40, 36);
    REQUIRE(picture.polygon[pixel] != no_polygon);
    picture.depth[pixel] += 1e-6;
    const Verdict verdict = hold_against_truth(truth, subject.scene, conventions, picture);
    CHECK(verdict.wrong_depths == 1);
    CHECK_FALSE(verdict.holds());
  }

  TEST_CASE("an edge explains what lies just inside the tolerance, not what lies just outside") {
    for (const double distance : {-1.49 / 256, 1.49 / 256, -1.51 / 256, 1.51 / 256}) {
      CAPTURE(distance * 256);
      const double left = 1 + distance;  // beside the centre of column 1
      const Scene scene = screen_scene(8, 6, {{{left, 1, 2}, {5, 1, 2}, {5, 4, 2}, {left, 4, 2}}});
      const Truth truth(scene, false);
      const bool inside = std::abs(distance) < 1.5 / 256, covers = distance < 0;
      CHECK(truth.at(1, 2).empty() == (!inside && !covers));
      CHECK((explain(truth, 1, 2, 0).reason == Reason::edge) == inside);
      CHECK((explain(truth, 1, 2, 0).reason == Reason::wrong) == (!inside && !covers));
      CHECK((explain(truth, 1, 2, no_polygon).reason == Reason::edge) == inside);
      CHECK((explain(truth, 1, 2, no_polygon).reason == Reason::wrong) == (!inside && covers));
    }
  }

  TEST_CASE("a depth may be off by a billionth of it, or as a billionth of a pixel makes it, and by no more") {
    const auto wrong_depths = [](const Scene& scene, double depth) {
      Picture picture = z_buffered(scene, {});
      REQUIRE(hold_against_truth(Truth(scene, false), scene, {}, picture).holds());
      picture.depth[picture.at(3, 2)] = depth;
      return hold_against_truth(Truth(scene, false), scene, {}, picture).wrong_depths;
    };
    // Level at z = 2: a shift of the line of sight makes nothing of it.
    const Scene level = screen_scene(8, 6, {{{1, 1, 2}, {5, 1, 2}, {5, 4, 2}, {1, 4, 2}}});
    // Steep, 0 at column 3: there a share of the depth is nothing, and a billionth of a pixel is 1/1000.
    const Scene steep = screen_scene(8, 6, {{{1, 1, -2e6}, {5, 1, 2e6}, {5, 4, 2e6}, {1, 4, -2e6}}});
    for (const double sign : {-1.0, 1.0}) {
      CHECK(wrong_depths(level, 2 * (1 + sign * 0.99e-9)) == 0);
      CHECK(wrong_depths(level, 2 * (1 + sign * 1.01e-9)) == 1);
      CHECK(wrong_depths(steep, sign * 0.99e-3) == 0);
      CHECK(wrong_depths(steep, sign * 1.01e-3) == 1);
    }
  }

  TEST_CASE("the second of two equal polygons is a tie, and not a tie a little behind") {
    const std::vector<glm::dvec3> square{{1, 1, 2}, {5, 1, 2}, {5, 4, 2}, {1, 4, 2}};
    for (const double behind : {0.0, 1.9e-5, 2.1e-5}) {
      std::vector<glm::dvec3> other = square;
      for (glm::dvec3& corner : other) corner.z += behind;
      const Scene scene = screen_scene(8, 6, {square, other});
      const Explanation why = explain(Truth(scene, false), 3, 2, 1);
      CHECK((why.reason == Reason::tie) == (behind < 2e-5));
      if (behind == 0) CHECK(why.text == "tie of 0 and 1: relative depth difference 0");
    }
  }

  TEST_CASE("an edge explains only what ends or begins there") {
    // An edge of the far square runs through the pixel's centre; the near one covers it all the same.
    const Scene scene = screen_scene(12, 6,
                                     {{{1, 1, 2}, {9, 1, 2}, {9, 4, 2}, {1, 4, 2}},
                                      {{5, 0, 3}, {11, 0, 3}, {11, 5, 3}, {5, 5, 3}},
                                      {{0, 0, 4}, {11, 0, 4}, {11, 5, 4}, {0, 5, 4}}});
    const Truth truth(scene, false);
    CHECK(explain(truth, 5, 2, 0).reason == Reason::none);
    CHECK(explain(truth, 5, 2, 1).reason == Reason::wrong);
    CHECK(explain(truth, 9, 2, 0).reason == Reason::edge);  // the near square ends here: it and the next may be seen
    CHECK(explain(truth, 9, 2, 1).reason == Reason::edge);
    CHECK(explain(truth, 9, 2, 1).text == "edge of polygon 0 at distance 0 px");
    CHECK(explain(truth, 9, 2, 2).reason == Reason::wrong);
    CHECK(explain(truth, 9, 2, no_polygon).reason == Reason::wrong);
  }

  TEST_CASE("painting in the order of the file is found to be wrong where polygons hide each other") {
    for (const std::string name :
         {"intersecting", "cyclic", "soup of large triangles", "n-gons, back faces drawn, parallel"}) {
      CAPTURE(name);
      const AgreementScene& subject = scene_named(name);
      const Truth truth(subject.scene, subject.cull);
      const Verdict verdict =
          explain_difference(truth, z_buffered(subject.scene, conventions_of(subject)), painted_in_file_order(truth));
      CHECK(verdict.unexplained > 20);
    }
  }
}
