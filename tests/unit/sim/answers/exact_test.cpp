// Exact values of a chain, against fractions that were worked out by hand or found in another way.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include <boost/multiprecision/cpp_int.hpp>
#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "sim/answers/explain_value.hpp"
#include "sim/answers/origin/exact.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using answers::Chain, answers::Exact, answers::Exactness, answers::exactness_of, answers::explain_value;
using Fraction = boost::multiprecision::cpp_rational;

namespace {

Scene lesson_scene(const char* name) { return load_scene(test::in_checkout("lessons/scenes/") + name).scene; }

std::int32_t polygon_named(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.polygons.size(); ++i)
    if (scene.polygons[i].name == name) return static_cast<std::int32_t>(i);
  return -1;
}

/// Calls use(x, y, chain) for each pixel where this polygon is seen in the end.
template <class Use>
int for_each_pixel_of(const Trace& trace, std::int32_t polygon, Use&& use) {
  Replay replay(trace);
  replay.go_to(trace.size());
  const Picture picture = replay.state().picture;
  int count = 0;
  for (std::int32_t y = 0; y < picture.height; ++y)
    for (std::int32_t x = 0; x < picture.width; ++x)
      if (picture.polygon[picture.at(x, y)] == polygon)
        use(x, y, explain_value(trace, answers::of_pixel(trace.size(), {x, y}))), ++count;
  return count;
}

/// What rounding added at each step, together, is the error of the number that was asked for; the most of it is at the
/// step that is said to have it.
void check_shares(const Exactness& found) {
  double sum = 0, size = 0, most = 0;
  for (const auto& link : found.of)
    for (const Exact& one : link)
      sum += one.brought, size += std::abs(one.brought), most = std::max(most, std::abs(one.brought));
  const double error = found.of[0][0].error;
  CHECK(std::abs(sum - error) <= 1e-9 * size);
  CHECK(found.most.has_value() == (most > 0));
  if (found.most) CHECK(std::abs(found.of[found.most->link][found.most->value].brought) == most);
}

}  // namespace

TEST_CASE("exact values: slanting's wall, 15 deep at x = 3 and 3 deep at x = 21, is (51 - 2x)/3 deep") {
  const Scene scene = lesson_scene("slanting.toml");
  for (const auto how : {Conventions::Interpolation::direct, Conventions::Interpolation::increments,
                         Conventions::Interpolation::plane}) {
    Conventions conventions;
    conventions.interpolation = how;
    const Trace trace = test::recorded_by("z-buffer", scene, conventions);
    const int count = for_each_pixel_of(trace, polygon_named(scene, "L"), [&](int x, int, const Chain& chain) {
      CAPTURE(x);
      const Exactness found = exactness_of(chain, trace);
      const Exact& z = found.of[0][0];
      REQUIRE(z.known);
      const int thirds = 51 - 2 * x;
      if (thirds % 3 == 0) CHECK(z.digits == fmt::format("{}", thirds / 3));
      else
        CHECK(z.digits.starts_with(fmt::format("{}/3 = {}.{}", thirds, thirds / 3,
                                               thirds % 3 == 1 ? "333333333333333333333" : "66666666666666666666")));
      const double recorded = chain.links[0].values[0].value;
      CHECK(z.error == static_cast<double>(Fraction(recorded) - Fraction(thirds, 3)));
      check_shares(found);
    });
    CHECK(count > 30);
  }
}

TEST_CASE("exact values: abc-def's planes, (x - 5)/4 and x/2 - 5/4, whatever rounding did on the way") {
  const Scene scene = lesson_scene("abc-def.toml");
  const Trace trace = test::recorded_by("z-buffer", scene);
  int rounded = 0;
  const auto check_plane = [&](const char* name, double slope, double at_0) {
    return for_each_pixel_of(trace, polygon_named(scene, name), [&](int x, int y, const Chain& chain) {
      CAPTURE(x);
      CAPTURE(y);
      const Exactness found = exactness_of(chain, trace);
      REQUIRE(found.of[0][0].known);
      CHECK(found.of[0][0].digits == answers::full_digits(slope * x + at_0));
      CHECK(found.of[0][0].error == chain.links[0].values[0].value - (slope * x + at_0));
      check_shares(found);
      rounded += found.of[0][0].error != 0;
    });
  };
  CHECK(check_plane("DEF", 0.25, -1.25) > 20);
  CHECK(check_plane("KLM", 0.5, -1.25) > 5);
  CHECK(rounded > 5);
}

TEST_CASE("exact values: in perspective, as the plane through three vertices that were projected as fractions") {
  // Of the second the window is 4/3 as wide as high, which no double is.
  ViewOptions wide;
  wide.width = 24, wide.height = 18;
  const std::array<Trace, 2> traces{open_jsonl(test::in_checkout("tests/golden/pyramid.jsonl")),
                                    test::recorded_by("z-buffer", look_at_scene(load_scene("pyramid").scene, wide))};
  for (const Trace& trace : traces) {
    const Scene& scene = trace.scene();
    const Camera& camera = scene.camera;
    const auto projected = [&](std::int32_t vertex) {
      const glm::dvec3& p = scene.points[static_cast<std::size_t>(vertex)];
      std::array<Fraction, 3> view;
      for (int row = 0; row < 3; ++row)
        view[static_cast<std::size_t>(row)] = Fraction(camera.view[0][row]) * p.x +
                                              Fraction(camera.view[1][row]) * p.y +
                                              Fraction(camera.view[2][row]) * p.z + Fraction(camera.view[3][row]);
      const Fraction d(camera.d), f(camera.near), far(camera.far), w_y(camera.window), width(scene.raster.width),
          height(scene.raster.height), w_x = w_y * width / height;
      const Fraction a = -(f + far) / (f * (f - far)), b = 2 * far / (f - far);
      return std::array<Fraction, 3>{(d * view[0] / view[2] + w_x) / (2 * w_x) * width - Fraction(1, 2),
                                     (w_y - d * view[1] / view[2]) / (2 * w_y) * height - Fraction(1, 2),
                                     f * (a * view[2] + b) / view[2]};
    };
    int pixels = 0;
    for (const Facet& facet : scene.facets) {
      const auto corner = [&](int i) {
        return projected(scene.corners[static_cast<std::size_t>(facet.first_corner + i)]);
      };
      const auto o = corner(0), u = corner(1), v = corner(2);
      const auto along = [&](const std::array<Fraction, 3>& p, std::size_t i) { return Fraction(p[i] - o[i]); };
      const Fraction area = along(u, 0) * along(v, 1) - along(v, 0) * along(u, 1);
      pixels += for_each_pixel_of(trace, facet.polygon, [&](int x, int y, const Chain& chain) {
        CAPTURE(x);
        CAPTURE(y);
        const Fraction s = ((x - o[0]) * along(v, 1) - along(v, 0) * (y - o[1])) / area,
                       t = (along(u, 0) * (y - o[1]) - (x - o[0]) * along(u, 1)) / area;
        const Fraction exact = o[2] + s * along(u, 2) + t * along(v, 2);
        const Exactness found = exactness_of(chain, trace);
        REQUIRE(found.of[0][0].known);
        const double error = static_cast<double>(Fraction(chain.links[0].values[0].value) - exact);
        CHECK(found.of[0][0].error == doctest::Approx(error).epsilon(1e-13));
        check_shares(found);
      });
    }
    CHECK(pixels > 20);
  }
}

TEST_CASE("exact values: what no formula gives is not called exact, and what stands in the way is said") {
  const Trace trace = open_jsonl(test::in_checkout("tests/golden/warnock.jsonl"));
  const auto area = trace.next(0, [](const RecordedEvent& event) { return holds<AreaBin>(event.event); });
  REQUIRE(area);
  const Exactness found = exactness_of(explain_value(trace, answers::Question{*area, "crossings"}), trace);
  CHECK_FALSE(found.of[0][0].known);
  CHECK(found.of[0][0].why == "crossings, which is taken as recorded");
  CHECK_FALSE(found.most);
}

TEST_CASE("exact values: a plane of length 1 has a square root, and all 25 digits of what follows from it are right") {
  const Trace trace = test::recorded_by("ray-casting", look_at_scene(load_scene("intersecting").scene, {}));
  // Of polygon B: its normal is (-6, 0, 12), so A = -1/sqrt(5) and C = 2/sqrt(5).
  const std::array<std::string, 3> digits{"\u22120.4472135954999579392818347", "0", "0.8944271909999158785636695"};
  int planes = 0;
  for_each_pixel_of(trace, polygon_named(trace.scene(), "B"), [&](int, int, const Chain& chain) {
    const Exactness found = exactness_of(chain, trace);
    CAPTURE(found.of[0][0].why);
    CHECK(found.of[0][0].known);
    for (std::size_t link = 0; link < chain.links.size(); ++link)
      for (std::size_t i = 0; i < chain.links[link].values.size(); ++i) {
        const std::string& name = chain.links[link].values[i].name;
        if (!chain.links[link].what.starts_with("plane of B") || name.size() != 1) continue;
        const Exact& letter = found.of[link][i];
        const auto which = static_cast<std::size_t>(name[0] - 'A');
        ++planes;
        // D = -(2A + C)/3: the roots cancel, and no digits of them can tell that it is 0.
        CHECK(letter.known == (name != "D"));
        if (name == "D") continue;
        CHECK(letter.digits == digits.at(which));
        CHECK(letter.enclosed == (letter.digits.size() > 1));
      }
  });
  CHECK(planes > 100);
}

TEST_CASE("exact values: depths of rays, planes and pieces are those that the oracle finds for the whole picture") {
  const Scene scene = lesson_scene("five-tests.toml");
  for (const char* method_id : {"ray-casting", "bsp", "depth-sort", "warnock", "scan-line"}) {
    CAPTURE(method_id);
    const Trace trace = test::recorded_by(method_id, scene);
    const oracle::Errors errors = oracle::errors_of(trace);
    int count = 0, inexact = 0;
    for (const char* name : {"C", "H"}) {  // run through each other
      CAPTURE(name);
      count += for_each_pixel_of(trace, polygon_named(scene, name), [&](int x, int y, const Chain& chain) {
        CAPTURE(x);
        CAPTURE(y);
        if (chain.cut) return;
        const Exact z = exactness_of(chain, trace).of[0][0];
        CAPTURE(z.why);
        REQUIRE(z.known);
        const auto pixel = static_cast<std::size_t>(y * scene.raster.width + x);
        CHECK(std::abs(z.error - errors.depth_error_of_pixel[pixel]) <= 1e-22);
        inexact += z.error != 0;
      });
    }
    CHECK(count > 20);
    CHECK(inexact > 0);
  }
}
