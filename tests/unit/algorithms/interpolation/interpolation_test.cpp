// Ways of interpolating: published cases, and what has to hold in all of them.
#include "algorithms/interpolation/interpolation.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <xxhash.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/viewing/camera.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/oracle/exact_depth.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

using Depth = Conventions::Depth;
using How = Conventions::Interpolation;

Scene small(const std::string& name, bool parallel = false) {
  ViewOptions view;
  view.width = 24, view.height = 20;
  if (parallel) view.orthographic = true;
  return look_at_scene(load_scene(name).scene, view);
}

/// Every way, as far as the scene can be drawn so.
template <class Visit>
void for_each_way(const Scene& scene, Visit&& visit) {
  for (int what = 0; what < 6; ++what)
    for (int how = 0; how < 4; ++how)
      for (int format = 0; format < 7; ++format)
        for (int covers = 0; covers < 4; ++covers) {
          if (covers > 0 && (what + how + format + covers) % 4 != 0) continue;  // each pair of two of them, still
          Conventions c;
          c.depth = static_cast<Depth>(what), c.interpolation = static_cast<How>(how);
          c.number_format = static_cast<NumberFormat>(format);
          c.coverage = static_cast<Conventions::Coverage>(covers);
          if (bits_of(c.number_format) > 0 && how % 2 == 1) c.rounding = Conventions::Rounding::down;
          if (what % 2 == 1 && scene.camera.kind != Camera::Kind::screen) c.positions = Conventions::Positions::integer;
          try {
            check_run(method("z-buffer"), scene, c);
          } catch (const InputError&) {
            continue;
          }
          visit(c);
        }
}

std::string name_of(const Conventions& c) {
  std::string name;
  for_each_convention([&](std::string_view, auto member) { name += std::string(word_of(c.*member)) + " "; });
  return name;
}

TEST_CASE(
    "001: (100, 100, 100) and (200, 200, 200) with d = 10 both come to (10, 10), and its depth tells them apart") {
  Camera camera;
  camera.d = 10, camera.near = 50, camera.far = 250, camera.window = 20;
  const viewing::Lens lens(camera, {64, 64, false}, Depth::foley);
  const glm::dvec3 one = lens.project({100, 100, 100}), other = lens.project({200, 200, 200});
  CHECK(glm::dvec2(one) == glm::dvec2(10, 10));
  CHECK(glm::dvec2(other) == glm::dvec2(10, 10));
  // "( x/(-z), y/(-z), (z - zmin)/(-z)(1 + zmin) )" with z = -z_v/F: -0.4 and -0.8, z_min = -0.2.
  CHECK(one.z == doctest::Approx((-0.4 + 0.2) / (0.4 * 0.8)).epsilon(1e-15));
  CHECK(other.z == doctest::Approx((-0.8 + 0.2) / (0.8 * 0.8)).epsilon(1e-15));
  CHECK(one.z > other.z);  // greater is nearer
}

TEST_CASE(
    "004: the worked example has A/C = B/C = -1, and every way gives z = x + y + 1 and keeps the first of equals") {
  const Scene scene = load_scene("delhi").scene;
  NullRecorder nothing;
  const Picture taught = interpolation::run(scene, Conventions{}, nothing);
  int ways = 0;
  for_each_way(scene, [&](const Conventions& c) {
    if (c.coverage != Conventions::Coverage::top_left || c.depth != Depth::pseudodepth) return;
    CAPTURE(name_of(c));
    CollectRecorder record;
    const Picture picture = interpolation::run(scene, c, record);
    ++ways;
    const auto slopes = record.all<PlaneSlopes>();
    CHECK(slopes.empty() == (c.interpolation == How::direct || c.interpolation == How::increments));
    if (!slopes.empty()) {
      CHECK(slopes.front().dz_dx == 0);  // the first polygon has z = 5
      CHECK(slopes.back().dz_dx == doctest::Approx(1).epsilon(1e-4));
      CHECK(slopes.back().dz_dy == doctest::Approx(1).epsilon(1e-4));
    }
    if (bits_of(c.number_format) > 0) return;  // there 7 - 1 and 6 are other units: ties may fall either way
    CHECK(picture.polygon == taught.polygon);
    for (std::size_t pixel = 0; pixel < picture.depth.size(); ++pixel)
      if (picture.polygon[pixel] != no_polygon)
        CHECK(picture.depth[pixel] == doctest::Approx(taught.depth[pixel]).epsilon(1e-6));
  });
  CHECK(ways == 28);
}

TEST_CASE(
    "in every way: recording changes nothing, the replay rebuilds the picture, check doubts no number, and no depth "
    "is farther off than its bound") {
  int ways = 0, changed = 0;
  for (const Scene& scene : {small("pyramid-behind"), small("foley"), small("cyclic"), small("pyramid-behind", true),
                             load_scene("delhi").scene}) {
    for_each_way(scene, [&](const Conventions& c) {
      CAPTURE(scene.name);
      CAPTURE(name_of(c));
      ++ways;
      NullRecorder nothing;
      const Picture picture = interpolation::run(scene, c, nothing);
      const Trace trace = test::recorded_by("z-buffer", scene, c);
      changed += c.depth != Depth::pseudodepth;
      Replay replay(trace);
      replay.go_to(trace.size());
      CHECK(replay.state().picture.polygon == picture.polygon);
      CHECK(replay.state().picture.depth == picture.depth);

      const CheckReport report = check(trace);
      for (const Cause& cause : report.causes)
        FAIL_CHECK("step " << cause.first.step << ": " << cause.first.field << cause.first.impossible
                           << (cause.first.rule ? rule_text(*cause.first.rule).name : "") << ", "
                           << cause.first.recorded << " for " << cause.first.expected);
      const interpolation::Bounds bounds = interpolation::bounds_of(scene, c);
      CHECK(bounds.picture.depth == picture.depth);
      const oracle::Errors errors = oracle::errors_of(trace);
      for (std::size_t pixel = 0; pixel < bounds.of_pixel.size(); ++pixel) {
        const double off = std::abs(errors.depth_error_of_pixel[pixel]);
        if (!std::isnan(off) && off > bounds.of_pixel[pixel])
          FAIL_CHECK("pixel " << pixel << " is off by " << off << ", its bound is " << bounds.of_pixel[pixel]);
      }
    });
  }
  CHECK(ways > 500);
  CHECK(changed > 300);
}

TEST_CASE("parallel projection: whatever is interpolated, and however, z_v is the same but for rounding") {
  const Scene scene = small("pyramid-behind", true);
  for_each_way(scene, [&](const Conventions& c) {
    if (c.positions == Conventions::Positions::integer) return;
    CAPTURE(name_of(c));
    const Trace trace = test::recorded_by("z-buffer", scene, c);
    const oracle::Errors errors = oracle::errors_of(trace, nullptr, oracle::Truth::surface);
    const interpolation::Bounds bounds = interpolation::bounds_of(scene, c);
    for (std::size_t pixel = 0; pixel < bounds.of_pixel.size(); ++pixel) {
      const double off = std::abs(errors.depth_error_of_pixel[pixel]);
      constexpr double bent = 1e-15;  // what rounding makes of a plane's own vertices
      if (!std::isnan(off)) CHECK(off <= bounds.of_pixel[pixel] + bent);
    }
  });
}

TEST_CASE("perspective: z_v that is interpolated on the picture is off by t(1 - t)(z_1 - z_0)^2/(z_1 - t(z_1 - z_0))") {
  const Scene scene = small("pyramid-behind");
  Conventions c;
  c.depth = Depth::view;
  const Trace trace = test::recorded_by("z-buffer", scene, c);
  int spans = 0;
  Replay replay(trace);
  trace.each(0, trace.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    const auto* span = get_if<SpanBegin>(&recorded.event);
    if (!span || span->last < span->first) return true;
    replay.go_to(position);
    const auto vertex = [&](std::int32_t number) {
      const VertexStages& at = replay.state().vertices[static_cast<std::size_t>(number)];
      return oracle::Vertex{at.raster.x, at.raster.y, at.plane.z};
    };
    const auto edge = [&](std::int32_t number) {
      const EdgeTableInsert& entry = replay.state().machine.edge_table[static_cast<std::size_t>(number)];
      return oracle::Edge{vertex(entry.vertex_0), vertex(entry.vertex_1)};
    };
    // The ends of the span on the surface: only between them is the depth linear in 1/z_v.
    const auto surface = oracle::ExactDepth::between(edge(span->left_edge), edge(span->right_edge), span->y,
                                                     oracle::Along::through_inverses);
    REQUIRE(surface);
    const double z_0 = surface->at(span->first), z_1 = surface->at(span->last), width = span->last - span->first;
    for (std::int32_t x = span->first; x <= span->last && width > 0; ++x) {
      const double t = (x - span->first) / width, gain = z_1 - z_0;
      const double linear = z_0 + t * gain, off = t * (1 - t) * gain * gain / (z_1 - t * gain);
      CHECK(std::abs(surface->error_of(linear, x) - off) <= 4e-16 * (std::abs(z_0) + std::abs(z_1)));
    }
    ++spans;
    return true;
  });
  CHECK(spans > 20);
  const oracle::Errors linear = oracle::errors_of(trace, nullptr, oracle::Truth::surface);
  CHECK(linear.all.largest_view > 1e-3);
  for (const Depth right : {Depth::pseudodepth, Depth::corrected, Depth::reciprocal, Depth::reversed, Depth::foley}) {
    c.depth = right;
    const oracle::Errors exact =
        oracle::errors_of(test::recorded_by("z-buffer", scene, c), nullptr, oracle::Truth::surface);
    CHECK(exact.all.largest_view < 1e-12);
  }
}

TEST_CASE("perspective: of a wall from z_v = 10 to 40 the error of z_v is the closed formula's") {
  // The wall's upright edges lie on columns 2 and 18, so that t is a whole number of sixteenths, and what is multiplied
  // with the divisor z_1 - t(z_1 - z_0) is exact: to the last bit where the vertices are, as on the raster.
  const Scene seen = look_at_scene(load_scene(test::in_checkout("lessons/scenes/receding.toml")).scene, {});
  const Scene on_raster = test::screen_scene(21, 17, {{{2, 14, 10}, {18, 14, 40}, {18, 2, 40}, {2, 2, 10}}});
  for (const Scene* scene : {&seen, &on_raster})
    for (const How how : {How::direct, How::increments, How::plane, How::plane_increments}) {
      CAPTURE(how);
      Conventions c;
      c.depth = Depth::view, c.interpolation = how;
      const double vertices = scene == &seen ? 1e-12 : 0;  // what rounding moves them
      const Trace trace = test::recorded_by("z-buffer", *scene, c);
      int depths = 0;
      double largest = 0;
      trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
        const auto* depth = get_if<DepthInterpolate>(&recorded.event);
        if (!depth || depth->z == 20) return true;  // the card's, which has no error
        const double z_0 = 10, z_1 = 40, t = (depth->x - 2) / 16.0, divisor = z_1 - t * (z_1 - z_0);
        const double above = t * (1 - t) * (z_1 - z_0) * (z_1 - z_0);
        CHECK(std::abs(depth->z * divisor - z_0 * z_1 - above) <= vertices);
        largest = std::max(largest, above / divisor);
        ++depths;
        return true;
      });
      CHECK(depths > 100);
      if (scene == &seen)
        CHECK(oracle::errors_of(trace, nullptr, oracle::Truth::surface).all.largest_view ==
              doctest::Approx(largest).epsilon(1e-14));
    }
}

TEST_CASE(
    "resolution: a unit of b bits is (F - f) z_v^2/(f F)/(2^b - 1) of z_v, at 16 to 32 bits and any near and far") {
  for (const double near : {0.01, 0.1, 1.0})
    for (const double far : {10.0, 1000.0})
      for (const NumberFormat format : {NumberFormat::fixed16, NumberFormat::fixed18, NumberFormat::fixed20,
                                        NumberFormat::fixed24, NumberFormat::fixed32}) {
        Scene scene;
        scene.camera.near = near, scene.camera.far = far;
        Conventions c;
        c.depth = Depth::reversed, c.number_format = format;
        const double z = std::sqrt(near * far), unit = 1 / (std::ldexp(1.0, bits_of(format)) - 1);
        CHECK(depth_unit(scene, c) == doctest::Approx(unit).epsilon(1e-14));
        const double depth = buffer_depth(scene.camera, c, z);
        const double next = view_depth(scene.camera, c, depth - unit);
        CHECK(std::abs(view_depth_error(scene.camera, c, depth - unit, -unit)) ==
              doctest::Approx(next - z).epsilon(1e-6));
        CHECK((next - z) == doctest::Approx((far - near) * z * next / (near * far) * unit).epsilon(1e-6));
      }
}

TEST_CASE("fixed point: N bits hold 2^N numbers, 0 for the least depth and 2^N - 1 for the greatest") {
  const Scene ramp = load_scene(test::in_checkout("lessons/scenes/ramp.toml")).scene;  // z from 0 to 65535
  for (const NumberFormat format : {NumberFormat::fixed16, NumberFormat::fixed18, NumberFormat::fixed20,
                                    NumberFormat::fixed24, NumberFormat::fixed32})
    for (const auto rounding : {Conventions::Rounding::nearest, Conventions::Rounding::down})
      for (const Scene& scene : {ramp, small("pyramid-behind"), small("foley"), small("cyclic", true)}) {
        Conventions c;
        c.number_format = format, c.rounding = rounding;
        CAPTURE(name_of(c));
        CAPTURE(scene.name);
        CollectRecorder record;
        interpolation::run(scene, c, record);
        const double most = std::ldexp(1.0, bits_of(format)) - 1, unit = depth_unit(scene, c);
        const double origin = scene.camera.kind == Camera::Kind::screen ? 0 : -1;
        CHECK(unit * most == doctest::Approx(depth_range(scene, c.depth)).epsilon(1e-14));
        double least = most, greatest = 0, off = 0;
        for (const DepthInterpolate& depth : record.all<DepthInterpolate>()) {
          const double units = (depth.z - origin) / unit;
          off = std::max(off, std::abs(units - std::round(units)));
          least = std::min(least, std::round(units)), greatest = std::max(greatest, std::round(units));
        }
        CHECK(off < 1e-5);
        CHECK(least >= 0);
        CHECK(greatest <= most);
        if (scene.name != ramp.name) continue;  // of others no pixel is as near or as far as can be
        CHECK(least == 0);
        CHECK(greatest == most);
      }
}

TEST_CASE("depths of all conventions turn back into the z_v that they were made of") {
  for (const Camera::Kind kind : {Camera::Kind::perspective, Camera::Kind::orthographic})
    for (int what = 0; what < 6; ++what) {
      Camera camera;
      camera.kind = kind, camera.near = 0.5, camera.far = 20;
      Conventions c;
      c.depth = static_cast<Depth>(what);
      if (kind == Camera::Kind::orthographic && (c.depth == Depth::reciprocal || c.depth == Depth::corrected)) continue;
      const viewing::Lens lens(camera, {8, 8, false}, c.depth);
      for (const double z : {0.5, 1.0, 3.0, 20.0}) {
        CHECK(view_depth(camera, c, buffer_depth(camera, c, z)) == doctest::Approx(z).epsilon(1e-12));
        const double at_vertex = lens.project({0, 0, z}).z;  // of `corrected`, what is interpolated: 1/z_v
        CHECK((c.depth == Depth::corrected ? 1 / at_vertex : at_vertex) ==
              doctest::Approx(buffer_depth(camera, c, z)).epsilon(1e-12));
      }
    }
}

TEST_CASE("what does not go together is refused in one line") {
  const Scene flat = load_scene("delhi").scene, parallel = small("pyramid-behind", true);
  const auto refused = [](const char* id, const Scene& scene, auto change) {
    Conventions c;
    change(c);
    try {
      check_run(method(id), scene, c);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refused("z-buffer", flat, [](Conventions& c) { c.depth = Depth::foley; }).find("needs a camera") !=
        std::string::npos);
  CHECK(refused("z-buffer", parallel, [](Conventions& c) { c.depth = Depth::reciprocal; }).find("divides by z_v") !=
        std::string::npos);
  CHECK(refused("z-buffer", flat, [](Conventions& c) { c.rounding = Conventions::Rounding::down; }).find("fixed") !=
        std::string::npos);
  CHECK(refused("shadow-buffer", small(test::in_checkout("lessons/scenes/lamp.toml")), [](Conventions& c) {
          c.number_format = NumberFormat::fixed16;
        }).find("in float64") != std::string::npos);
  CHECK(refused("bsp", flat, [](Conventions& c) { c.interpolation = How::plane; }).find("--interpolation direct") !=
        std::string::npos);
}

TEST_CASE("every way gives the same bits whatever compiled it") {
  // The sums were written by g++ at -O3; this test is compiled by clang at -O0 as well.
  const auto path = test::in_checkout("tests/golden/ways_of_interpolating.txt");
  std::string now;
  for (const bool parallel : {false, true}) {
    const Scene scene = small("pyramid-behind", parallel);
    std::map<std::string, std::uint64_t> sums;  // by what is interpolated, and how
    for_each_way(scene, [&](const Conventions& c) {
      NullRecorder nothing;
      const Picture picture = interpolation::run(scene, c, nothing);
      std::uint64_t& sum = sums[std::string(word_of(c.depth)) + " " + std::string(word_of(c.interpolation))];
      sum = XXH64(picture.depth.data(), picture.depth.size() * sizeof(double), sum);
      sum = XXH64(picture.polygon.data(), picture.polygon.size() * sizeof(std::int32_t), sum);
    });
    for (const auto& [name, sum] : sums)
      now += fmt::format("{} {} {:016x}\n", parallel ? "parallel" : "perspective", name, sum);
  }
  std::ifstream file(path);
  const std::string then((std::istreambuf_iterator<char>(file)), {});
  CHECK_MESSAGE(now == then, "now:\n" << now);
}

}  // namespace
