// Perspective-correct attributes: that they are right, how far linear ones are off, and that a run with them is
// recorded, replayed and judged like any other.
#include "traces/formulas/attributes.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/viewing/camera.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/oracle/attribute_errors.hpp"
#include "traces/oracle/exact_geometry.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

using Attribute = Conventions::Attribute;
using oracle::Rational;

Scene small(const std::string& name, bool parallel = false) {
  ViewOptions view;
  view.width = 24, view.height = 20;
  if (parallel) view.orthographic = true;
  return look_at_scene(load_scene(name).scene, view);
}

/// A floor that the near plane cuts, so that clipping makes vertices of it.
Scene clipped_floor() {
  ViewOptions view;
  view.width = 30, view.height = 22, view.near = 2.5;
  return look_at_scene(load_scene(test::in_checkout("lessons/scenes/floor.toml")).scene, view);
}

/// The floor with colours and texture coordinates at its vertices, and a seam between its triangles.
Scene colored_floor() {
  Scene scene = clipped_floor();
  VertexAttribute color{color_attribute, 3, {}, {}, {}, {}}, uv{uv_attribute, 2, {}, {}, {}, {}};
  for (std::int32_t point = 0; point < size32(scene.points); ++point) {
    const double part = point / 4.0;
    color.values.insert(color.values.end(), {part, 1 - part, 0.5});
    uv.values.insert(uv.values.end(), {scene.points[point].x, scene.points[point].y});
    color.of_point.push_back(point), uv.of_point.push_back(point);
  }
  const Facet& last = scene.facets.back();
  uv.values.insert(uv.values.end(), {0.25, 3});
  uv.own.push_back({last.polygon, scene.corners[last.first_corner], size32(scene.points)});
  scene.attributes = {color, uv};
  return scene;
}

/// All numbers that a run interpolates, by pixel.
std::map<std::pair<std::int32_t, std::int32_t>, std::vector<double>> numbers_of(const Trace& trace) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<double>> numbers;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* write = get_if<PixelWrite>(&recorded.event)) numbers[{write->x, write->y}].clear();
    if (const auto* e = get_if<AttributeInterpolate>(&recorded.event)) numbers[{e->x, e->y}].push_back(e->attribute);
    return true;
  });
  return numbers;
}

/// Between two vertices: their attributes and depths, and a place t of the way from one to the other.
struct Between {
  double a_0, a_1, z_0, z_1, t;
};
Between any_between(std::mt19937& random) {
  std::uniform_real_distribution<double> attribute(-10, 10), exponent(-2, 3), share(0, 1);
  return {attribute(random), attribute(random), std::exp2(exponent(random)), std::exp2(exponent(random)),
          share(random)};
}

template <class T, class Known>
T perspective(const Between& of, const Known& known) {
  const auto p_0 = formulas::over_depth<T>(known(of.a_0), known(of.z_0)),
             p_1 = formulas::over_depth<T>(known(of.a_1), known(of.z_1));
  const auto here = formulas::on_line<T>(p_0, p_1, known(of.t), T(0), T(1));
  return here.over_z / here.one_over_z;
}
Rational exact(const Between& of) {
  return perspective<Rational>(of, [](double value) { return oracle::exactly(value); });
}

template <class T>
double share_of_bound(const Between& of) {
  const auto known = [](double value) {
    const T kept = static_cast<T>(value);
    return Bounded<T>(kept, std::abs(static_cast<double>(kept) - value));
  };
  const Bounded<T> a = perspective<Bounded<T>>(of, known);
  const double off = std::abs(oracle::rounded(oracle::exactly(static_cast<double>(a)) - exact(of)));
  return off / a.error;
}

template <class Visit>
void for_each_way(const Scene& scene, Visit&& visit) {
  std::vector<Attribute> attributes{Attribute::linear};
  if (scene.camera.kind == Camera::Kind::perspective) attributes.push_back(Attribute::perspective);
  for (const Attribute attribute : attributes)
    for (const NumberFormat format : {NumberFormat::float64, NumberFormat::float32})
      for (int how = 0; how < 4; ++how)
        for (int covers = 0; covers < 4; ++covers) {
          Conventions c;
          c.attribute = attribute, c.number_format = format;
          c.interpolation = static_cast<Conventions::Interpolation>(how);
          c.coverage = static_cast<Conventions::Coverage>(covers);
          check_run(method("z-buffer"), scene, c);
          visit(c);
        }
}
std::string name_of(const Conventions& c) {
  std::string name;
  for_each_convention([&](std::string_view, auto member) { name += std::string(word_of(c.*member)) + " "; });
  return name;
}

}  // namespace

TEST_CASE(
    "attributes: taken for linear on the picture, one is off by exactly (a_1 - a_0) t(1 - t)(z_1 - z_0)/(z_1 - "
    "t(z_1 - z_0))") {
  std::mt19937 random(1992);
  for (int n = 0; n < 3000; ++n) {
    const Between of = any_between(random);
    const Rational a_0 = oracle::exactly(of.a_0), a_1 = oracle::exactly(of.a_1), t = oracle::exactly(of.t);
    const Rational linear = formulas::part_of_way(a_0, a_1, t);
    const Rational error =
        formulas::linear_attribute_error<Rational>(a_0, a_1, oracle::exactly(of.z_0), oracle::exactly(of.z_1), t);
    CHECK(linear - exact(of) == error);
  }
}

TEST_CASE("attributes: perspective-correct ones are never farther off than their bound, and reach a quarter of it") {
  std::mt19937 random(1991);
  double most_64 = 0, most_32 = 0;
  for (int n = 0; n < 20000; ++n) {
    const Between of = any_between(random);
    most_64 = std::max(most_64, share_of_bound<double>(of));
    most_32 = std::max(most_32, share_of_bound<float>(of));
  }
  CAPTURE(most_64);
  CAPTURE(most_32);
  CHECK(most_64 <= 1);
  CHECK(most_32 <= 1);
  CHECK(most_64 > 0.25);
  CHECK(most_32 > 0.25);
}

TEST_CASE(
    "attributes, in every way: recording changes nothing, the replay rebuilds the picture, check doubts no "
    "number, and none is farther off than its bound") {
  int ways = 0;
  for (const Scene& scene :
       {small("pyramid-behind"), small("pyramid-behind", true), load_scene("delhi").scene, clipped_floor()}) {
    for_each_way(scene, [&](const Conventions& c) {
      CAPTURE(scene.name);
      CAPTURE(name_of(c));
      ++ways;
      NullRecorder nothing;
      const Picture picture = interpolation::run(scene, c, nothing);
      Conventions plain = c;
      plain.attribute = Attribute::none;
      const Picture unshaded = interpolation::run(scene, plain, nothing);
      CHECK(picture.depth == unshaded.depth);
      CHECK(picture.polygon == unshaded.polygon);

      const Trace trace = test::recorded_by("z-buffer", scene, c);
      Replay replay(trace);
      replay.go_to(trace.size());
      CHECK(replay.state().picture == picture);

      const CheckReport report = check(trace);
      for (const Cause& cause : report.causes)
        FAIL_CHECK("step " << cause.first.step << ": " << cause.first.field << cause.first.impossible << ", "
                           << cause.first.recorded << " for " << cause.first.expected);
      const oracle::AttributeErrors errors = oracle::attribute_errors_of(trace);
      CHECK(errors.attributes > 0);
      CHECK(errors.not_judged == 0);
      const interpolation::Bounds bounds = interpolation::bounds_of(scene, c);
      for (std::size_t pixel = 0; pixel < bounds.of_attribute.size(); ++pixel) {
        const double off = errors.rounding_of_pixel[pixel];
        if (!std::isnan(off) && off > bounds.of_attribute[pixel])
          FAIL_CHECK("pixel " << pixel << " is off by " << off << ", its bound is " << bounds.of_attribute[pixel]);
      }
      const bool right = c.attribute == Attribute::perspective || scene.camera.kind != Camera::Kind::perspective;
      if (right) CHECK(errors.largest == errors.rounding);
      else CHECK(errors.largest > 1e-2);
    });
  }
  CHECK(ways == (2 + 1 + 1 + 2) * 32);
}

TEST_CASE("attributes: a perspective-correct one is the x_w of the very point that is seen at the pixel") {
  for (const Scene& scene : {small("pyramid-behind"), clipped_floor()}) {
    Conventions c;
    c.attribute = Attribute::perspective, c.depth = Conventions::Depth::corrected;
    const interpolation::Bounds run = interpolation::bounds_of(scene, c);
    const Raster& raster = scene.raster;
    const glm::dmat4 world_of_view = glm::inverse(scene.camera.view);
    int seen = 0;
    for (std::int32_t y = 0; y < raster.height; ++y)
      for (std::int32_t x = 0; x < raster.width; ++x) {
        const std::size_t pixel = run.picture.at(x, y);
        if (run.picture.polygon[pixel] == no_polygon) continue;
        const double z_v = run.picture.depth[pixel], w = scene.camera.window;
        const double x_p = ((x + 0.5) / raster.width * 2 - 1) * w * raster.width / raster.height,
                     y_p = (1 - (y + 0.5) / raster.height * 2) * w;
        const glm::dvec4 point =
            world_of_view * glm::dvec4(x_p * z_v / scene.camera.d, y_p * z_v / scene.camera.d, z_v, 1);
        CHECK(run.attribute[pixel] == doctest::Approx(point.x).epsilon(1e-11));
        ++seen;
      }
    CHECK(seen > 25);
  }
}

TEST_CASE("attributes: check finds those that were interpolated linearly and declared perspective-correct") {
  const Scene scene = small("pyramid-behind");
  Conventions linear, declared;
  linear.attribute = Attribute::linear, declared.attribute = Attribute::perspective;
  const Method& z_buffer = method("z-buffer");
  TraceRecorder recorder(header_for(z_buffer, declared), scene);
  z_buffer.record(scene, linear, recorder);
  recorder.finish();
  const CheckReport report = check(Trace::from_bytes(recorder.take_bytes(), "linear"));
  REQUIRE(!report.causes.empty());
  CHECK(report.causes.front().first.field == "over_z");
}

TEST_CASE("attributes: fixed-point numbers are refused, and other methods have none") {
  Conventions c;
  c.attribute = Attribute::linear;
  CHECK_THROWS_AS(check_run(method("bsp"), small("cyclic"), c), InputError);
  CHECK_THROWS_AS(check_run(method("scan-line"), small("cyclic"), c), InputError);
  c.number_format = NumberFormat::fixed16;
  CHECK_THROWS_AS(check_run(method("z-buffer"), small("cyclic"), c), InputError);
}

TEST_CASE("attributes of the scene: recorded, replayed and never doubted, and edges and half-planes agree in them") {
  const Scene scene = colored_floor();
  for (const char* shade : {"colors", "checker"})
    for (const Attribute attribute : {Attribute::linear, Attribute::perspective})
      for (const NumberFormat format : {NumberFormat::float64, NumberFormat::float32}) {
        CAPTURE(shade);
        Conventions c;
        c.attribute = attribute, c.number_format = format, c.options["shade"] = shade;
        std::map<std::pair<std::int32_t, std::int32_t>, std::vector<double>> by_edges;
        for (const char* name : {"z-buffer", "half-space"}) {
          CAPTURE(name);
          check_run(method(name), scene, c);
          const Trace trace = test::recorded_by(name, scene, c);
          CHECK(trace.scene() == scene);
          CHECK(check(trace).causes.empty());
          NullRecorder nothing;
          Replay replay(trace);
          replay.go_to(trace.size());
          if (name == std::string("z-buffer")) CHECK(replay.state().picture == interpolation::run(scene, c, nothing));
          const auto numbers = numbers_of(trace);
          CHECK(numbers.size() > 25);
          if (by_edges.empty()) by_edges = numbers;
          for (const auto& [pixel, values] : numbers) {
            REQUIRE(values.size() == (shade == std::string("colors") ? 3u : 2u));
            // Linearly, what clipping made bends the attribute, and triangles are cut another way.
            if (attribute == Attribute::linear || !by_edges.contains(pixel)) continue;
            for (std::size_t k = 0; k < values.size(); ++k)
              CHECK(values[k] ==
                    doctest::Approx(by_edges[pixel][k]).epsilon(format == NumberFormat::float64 ? 1e-9 : 1e-3));
          }
        }
      }
}

TEST_CASE("attributes of the scene: one number wrong is found, and where a scene lacks them the run is refused") {
  const Scene scene = colored_floor();
  Conventions linear, declared;
  linear.attribute = Attribute::linear, declared.attribute = Attribute::perspective;
  linear.options["shade"] = declared.options["shade"] = "colors";
  for (const char* name : {"z-buffer", "half-space"}) {
    TraceRecorder recorder(header_for(method(name), declared), scene);
    method(name).record(scene, linear, recorder);
    recorder.finish();
    const CheckReport report = check(Trace::from_bytes(recorder.take_bytes(), "linear"));
    REQUIRE(!report.causes.empty());
    CHECK(report.causes.front().first.field == "over_z");
  }
  CHECK_THROWS_AS(interpolation::check(clipped_floor(), declared), InputError);
  declared.attribute = Attribute::none;
  CHECK_THROWS_AS(interpolation::check(scene, declared), InputError);
}
