// The exact oracle, against depths that were found in another way: by the plane through three points, in fractions.
#include "traces/oracle/exact_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include <boost/multiprecision/cpp_int.hpp>
#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/oracle/exact_geometry.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using Fraction = boost::multiprecision::cpp_rational;

namespace {

/// z of the plane through a, b, c at (x, y), by Cramer's rule.
Fraction depth_of_plane(const oracle::Vertex& a, const oracle::Vertex& b, const oracle::Vertex& c, int x, int y) {
  const Fraction ax(a.x), ay(a.y), az(a.z), ux = Fraction(b.x) - ax, uy = Fraction(b.y) - ay, uz = Fraction(b.z) - az,
                                            vx = Fraction(c.x) - ax, vy = Fraction(c.y) - ay, vz = Fraction(c.z) - az;
  const Fraction normal_x = uy * vz - uz * vy, normal_y = uz * vx - ux * vz, normal_z = ux * vy - uy * vx;
  return az - (normal_x * (Fraction(x) - ax) + normal_y * (Fraction(y) - ay)) / normal_z;
}

TEST_CASE("exact: on 10 000 random triangles the depth between two edges is that of the plane, as a fraction") {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(-40, 60), deep(-1, 1);
  int points = 0;
  for (int trial = 0; trial < 10'000; ++trial) {
    oracle::Vertex corner[3];
    const int scale = static_cast<int>(random() % 30) - 20;  // also very small depths
    for (oracle::Vertex& vertex : corner) vertex = {place(random), place(random), std::ldexp(deep(random), scale)};
    const int x = static_cast<int>(random() % 20), y = static_cast<int>(random() % 20);
    const oracle::Edge left{corner[0], corner[1]}, right{corner[2], corner[0]};
    const auto depth = oracle::ExactDepth::between(left, right, y);
    REQUIRE(depth);
    const Fraction plane = depth_of_plane(corner[0], corner[1], corner[2], x, y);
    const double rounded = static_cast<double>(plane);
    // The rational's own conversion rounds, too, but not always to the nearest.
    CHECK(std::abs(depth->at(x) - rounded) <= std::nextafter(std::abs(rounded), 1e300) - std::abs(rounded));
    const Fraction above = abs(Fraction(depth->at(x)) - plane);
    CHECK(above <= abs(Fraction(std::nextafter(depth->at(x), 1e300)) - plane));
    CHECK(above <= abs(Fraction(std::nextafter(depth->at(x), -1e300)) - plane));
    const double z = std::nextafter(rounded, 1e300) + 3e-12;
    const double off = static_cast<double>(Fraction(z) - plane);
    CHECK(depth->error_of(z, x) == doctest::Approx(off).epsilon(1e-15));
    points += off != 0;
  }
  CHECK(points > 9'900);
}

TEST_CASE("exact: two depths are told apart where doubles are not, and an upright crossing has one depth") {
  // Two planes that differ by 2⁻⁸⁰ at x = 5.
  const double tiny = std::ldexp(1.0, -80);
  const oracle::Edge left{{0, 0, 1}, {0, 10, 1}}, right{{10, 0, 2}, {10, 10, 2}}, raised{{10, 0, 2}, {10, 10, 2}};
  const oracle::Edge lifted{{0, 0, tiny}, {0, 10, tiny}}, flat{{10, 0, -tiny}, {10, 10, -tiny}};
  const auto one = oracle::ExactDepth::between(left, right, 3), same = oracle::ExactDepth::between(left, raised, 3),
             a = oracle::ExactDepth::between(lifted, flat, 3);
  REQUIRE(one);
  REQUIRE(a);
  CHECK(one->compare(*same, 5) == 0);
  CHECK(one->at(5) == 1.5);
  CHECK(a->at(5) == 0);
  CHECK(a->at(4) == tiny / 5);
  CHECK(a->compare(*one, 5) == -1);
  CHECK(one->compare(*a, 5) == 1);
  const auto upright = oracle::ExactDepth::between(left, left, 3);
  REQUIRE(upright);
  CHECK(upright->at(7) == 1);
  CHECK(!oracle::ExactDepth::between({{0, 1, 0}, {4, 1, 0}}, right, 1));
  CHECK(!oracle::ExactDepth::between({{0, 0, std::nan("")}, {4, 1, 0}}, right, 1));
}

oracle::Errors errors_of_run(const char* scene_name, Conventions::Interpolation interpolation,
                             NumberFormat format = NumberFormat::float64) {
  ViewOptions view;
  view.width = 64, view.height = 48;
  const Scene scene = look_at_scene(load_scene(scene_name).scene, view);
  Conventions conventions;
  conventions.interpolation = interpolation;
  conventions.number_format = format;
  return oracle::errors_of(test::recorded_by("z-buffer", scene, conventions));
}

TEST_CASE(
    "error: direct interpolation is off by few last digits, increments by more, and neither decides wrongly here") {
  for (const char* scene : {"pyramid-behind", "teapot:3", "intersecting", "dodecahedron"}) {
    CAPTURE(scene);
    const oracle::Errors direct = errors_of_run(scene, Conventions::Interpolation::direct),
                         steps = errors_of_run(scene, Conventions::Interpolation::increments);
    CHECK(direct.all.depths > 100);
    CHECK(direct.not_judged == 0);
    CHECK(direct.all.depths == steps.all.depths);
    CHECK(direct.all.largest_depth < 1e-13);
    CHECK(steps.all.largest_depth < 1e-12);
    CHECK(steps.all.root_mean_square() > direct.all.root_mean_square());
    CHECK(direct.all.decided_wrong == 0);
    CHECK(direct.wrong_pixels == 0);
    std::int64_t depths = 0;
    for (const oracle::ErrorOf& polygon : direct.polygons) depths += polygon.depths;
    CHECK(depths == direct.all.depths);
  }
}

TEST_CASE(
    "error: increments in fixed point add up along the longest span and edge, as many units as they are long at most") {
  const oracle::Errors direct =
                           errors_of_run("pyramid-behind", Conventions::Interpolation::direct, NumberFormat::fixed16),
                       steps = errors_of_run("pyramid-behind", Conventions::Interpolation::increments,
                                             NumberFormat::fixed16);
  for (const auto along : {&oracle::Errors::along_span, &oracle::Errors::along_edge}) {
    const std::vector<double>&one = direct.*along, &other = steps.*along;
    REQUIRE(one.size() == other.size());
    REQUIRE(one.size() > 20);
    CHECK(*std::max_element(one.begin(), one.end()) < 4);
    CHECK(*std::max_element(other.begin(), other.end()) > 2 * *std::max_element(one.begin(), one.end()));
    for (std::size_t n = 0; n < other.size(); ++n) CHECK(other[n] < 100);
  }
}

TEST_CASE("error: each depth of a span is told with its places, and what adds up along an edge is of one edge") {
  ViewOptions view;
  view.width = 64, view.height = 48;
  const Scene scene = look_at_scene(load_scene("pyramid-behind").scene, view);
  Conventions conventions;
  conventions.interpolation = Conventions::Interpolation::increments;
  conventions.number_format = NumberFormat::fixed16;
  const Trace trace = test::recorded_by("z-buffer", scene, conventions);
  std::vector<oracle::DepthError> told;
  const oracle::Errors errors = oracle::errors_of(trace, nullptr, oracle::Truth::formula,
                                                  [&](const oracle::DepthError& depth) { told.push_back(depth); });
  CHECK(std::ssize(told) == errors.all.depths);
  std::map<std::int64_t, std::vector<double>> first_ones;
  double largest = 0;
  for (const oracle::DepthError& depth : told) {
    const Event event = trace.event(depth.step).event, begun = trace.event(depth.span).event,
                inserted = trace.event(depth.edge).event;
    const auto* z = get_if<DepthInterpolate>(&event);
    const auto* span = get_if<SpanBegin>(&begun);
    const auto* edge = get_if<EdgeTableInsert>(&inserted);
    REQUIRE((z && span && edge));
    CHECK(z->z == depth.z);
    CHECK(z->x == span->first + depth.along_span);
    CHECK(z->y == edge->first_row + depth.along_edge);
    CHECK(span->left_edge == edge->edge);
    largest = std::max(largest, std::abs(depth.error));
    std::vector<double>& along = first_ones[depth.edge];
    const auto row = static_cast<std::size_t>(depth.along_edge);
    if (row >= along.size()) along.resize(row + 1);
    if (depth.along_span == 0) along[row] = std::abs(depth.error);
  }
  CHECK(largest == errors.all.largest);
  bool of_one_edge = false;
  for (const auto& [edge, along] : first_ones) of_one_edge = of_one_edge || along == errors.along_edge;
  CHECK(of_one_edge);
}

TEST_CASE("error: a decision that rounding turned is found, and a depth that is exact has no error") {
  // Two triangles, the second nearer by less than a float64 of this size can hold after interpolating.
  zoo::Task task;
  task.width = 24, task.height = 20;
  task.points = {{1.125, 1.375, 0.3}, {22.625, 2.25, 0.7}, {9.5, 18.875, 0.9}};
  for (const zoo::Point& p : std::vector<zoo::Point>(task.points))
    task.points.push_back({p.x, p.y, std::nextafter(p.z, 0.0)});
  task.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}};
  const Trace run = test::trace_of(test::head(task, "float64", "increments") + zoo::edge_table(task));
  const oracle::Errors errors = oracle::errors_of(run);
  CHECK(errors.all.depths > 300);
  // The exact depths of the second are nearer at every pixel.
  std::int64_t lost = 0;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    const auto* compare = get_if<DepthCompare>(&recorded.event);
    lost += compare && !compare->nearer;
    return true;
  });
  CHECK(lost > 0);
  CHECK(errors.all.decided_wrong == lost);
  CHECK(errors.wrong_pixels == lost);
  if (lost > 0) {
    REQUIRE(!errors.decisions.empty());
    CHECK(errors.decisions[0].polygon == 1);
    CHECK(errors.decisions[0].z_exact <= errors.decisions[0].stored_exact);
  }

  for (zoo::Point& point : task.points) point.z = 0.5;
  const oracle::Errors flat =
      oracle::errors_of(test::trace_of(test::head(task, "float64", "increments") + zoo::edge_table(task)));
  CHECK(flat.all.largest == 0);
}

TEST_CASE("error: the smallest gap, the steepest step and the compares that are counted, of planes that are known") {
  // Three planes at one z each, the last of them again as deep as the first.
  zoo::Task task;
  task.width = 16, task.height = 14;
  for (const double z : {0.5, 0.25, 0.75, 0.5})
    for (const auto& [x, y] : {std::pair(1.0, 1.0), {13.5, 2.0}, {4.0, 12.5}}) task.points.push_back({x, y, z});
  task.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}, {2, {6, 7, 8}}, {3, {9, 10, 11}}};
  const std::string run = test::head(task, "float64", "direct") + zoo::edge_table(task);
  const oracle::Errors flat = oracle::errors_of(test::trace_of(run));
  const std::int64_t pixels = flat.all.depths / 4;
  CHECK(flat.all.depths == 4 * pixels);
  CHECK(flat.compares == 3 * pixels);  // the first of each pixel meets the empty buffer
  REQUIRE(flat.least_gap);
  CHECK(*flat.least_gap == 0.25);
  CHECK(flat.gap_at == 0.25);
  CHECK(flat.wrong_pixels == 0);

  // One depth is wrong, by far more than rounding does; the polygon drawn later has it right.
  std::string wrong = run;
  const std::size_t at = wrong.find("\"z\":0.5", wrong.size() / 8);
  REQUIRE(at != std::string::npos);
  wrong.replace(at, 7, "\"z\":0.4");
  const Trace trace = test::trace_of(wrong);
  const oracle::Errors off = oracle::errors_of(trace);
  CHECK(off.all.largest_depth == doctest::Approx(0.1));
  const Event steepest = trace.event(off.steepest_step).event;
  CHECK((holds<DepthInterpolate>(steepest) ? get<DepthInterpolate>(steepest).z : get<DepthCompare>(steepest).z) == 0.4);
}

TEST_CASE("error: of a shadow buffer's run only the eye's pass is judged") {
  const Trace trace = open_jsonl(test::in_checkout("tests/golden/shadow-buffer.jsonl"));
  std::int64_t of_eye = 0;
  Pass pass = Pass::eye;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* begun = get_if<PassBegin>(&recorded.event)) pass = begun->pass;
    of_eye += pass == Pass::eye && holds<DepthInterpolate>(recorded.event);
    return true;
  });
  REQUIRE(of_eye > 0);
  const oracle::Errors errors = oracle::errors_of(trace);
  CHECK(errors.all.depths + errors.not_judged == of_eye);
}

/// The same run without steps of these kinds.
template <class... E>
Trace run_without(const Trace& trace) {
  TraceRecorder recorder(trace.header(), trace.scene());
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& step) {
    if (!(holds<E>(step.event) || ...)) record_any(recorder, step.step, step.event);
    return true;
  });
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "without");
}

TEST_CASE("error: the largest error in ulps and the largest one in depth are named at their own steps") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  std::int64_t steepest = 0, deepest = 0;
  TraceRecorder recorder(right.header(), right.scene());
  right.each(0, right.size(), [&](std::int64_t step, const RecordedEvent& read) {
    RecordedEvent made = read;
    if (auto* depth = get_if<DepthInterpolate>(&made.event); depth && (steepest == 0 || deepest == 0)) {
      REQUIRE(depth->z > 0.01);
      // Near 0 an ulp is small: many of them, but not far off.
      if (steepest == 0) depth->z = 0x1p-10, steepest = step;
      else depth->z *= 5, deepest = step;
    }
    record_any(recorder, made.step, made.event);
    return true;
  });
  recorder.finish();
  const oracle::Errors errors = oracle::errors_of(Trace::from_bytes(recorder.take_bytes(), "two depths are off"));
  CHECK(errors.steepest_step == steepest);
  CHECK(errors.deepest_step == deepest);
}

TEST_CASE("error: a scan line that is printed kind by kind has no more depths, and the same errors") {
  for (const char* name : {"delhi", "foley", "scan-line-buffer", "pyramid-behind"}) {
    CAPTURE(name);
    const Trace right = open_jsonl(test::in_checkout(std::string("tests/golden/") + name + ".jsonl"));
    const auto rank = [](const RecordedEvent& step) {
      return holds<DepthInterpolate>(step.event) ? 1
             : holds<DepthCompare>(step.event)   ? 2
             : holds<DepthWrite>(step.event)     ? 3
             : holds<PixelWrite>(step.event)     ? 4
                                                 : 0;
    };
    std::vector<RecordedEvent> pixels;
    TraceRecorder recorder(right.header(), right.scene());
    const auto put = [&] {
      std::stable_sort(pixels.begin(), pixels.end(),
                       [&](const RecordedEvent& one, const RecordedEvent& other) { return rank(one) < rank(other); });
      for (const RecordedEvent& step : pixels) record_any(recorder, step.step, step.event);
      pixels.clear();
    };
    right.each(0, right.size(), [&](std::int64_t, const RecordedEvent& step) {
      if (rank(step) > 0) return pixels.push_back(step), true;
      put();
      record_any(recorder, step.step, step.event);
      return true;
    });
    put();
    recorder.finish();
    const oracle::Errors ours = oracle::errors_of(right),
                         theirs = oracle::errors_of(Trace::from_bytes(recorder.take_bytes(), "kind by kind"));
    CHECK(theirs.all.depths == ours.all.depths);
    CHECK(theirs.not_judged == ours.not_judged);
    CHECK(theirs.all.largest == ours.all.largest);
    CHECK(theirs.all.sum_of_squares == doctest::Approx(ours.all.sum_of_squares));
    CHECK(theirs.compares == ours.compares);
    CHECK(theirs.wrong_pixels == ours.wrong_pixels);
    CHECK(theirs.polygon_of_pixel == ours.polygon_of_pixel);
    REQUIRE(theirs.polygons.size() == ours.polygons.size());
    for (std::size_t i = 0; i < ours.polygons.size(); ++i) CHECK(theirs.polygons[i].depths == ours.polygons[i].depths);
    for (std::size_t i = 0; i < ours.of_pixel.size(); ++i)
      CHECK(
          (theirs.of_pixel[i] == ours.of_pixel[i] || (std::isnan(theirs.of_pixel[i]) && std::isnan(ours.of_pixel[i]))));
  }
}

TEST_CASE("error: without spans or edges the slopes, and without these the polygons say what depths are exactly") {
  ViewOptions view;
  view.width = 40, view.height = 30;
  const Scene scene = look_at_scene(load_scene("pyramid-behind").scene, view);
  Conventions by_plane;
  by_plane.interpolation = Conventions::Interpolation::plane;
  const Trace whole = test::recorded_by("z-buffer", scene, by_plane);
  const oracle::Errors all = oracle::errors_of(whole);
  CHECK(all.by_polygon == 0);
  const Trace no_spans =
      run_without<EdgeTableInsert, EdgeTableSkip, EdgeEnter, EdgeStep, EdgeRetire, EdgeSwap, SpanBegin>(whole);
  const oracle::Errors by_slopes = oracle::errors_of(no_spans);
  CHECK(by_slopes.all.depths == all.all.depths);
  CHECK(by_slopes.all.largest == all.all.largest);
  CHECK(by_slopes.by_polygon == all.all.depths);
  const Trace no_slopes =
      run_without<PlaneSlopes, ViewTransform, Projection, ViewportTransform, OutlineVertex>(no_spans);
  const oracle::Errors by_polygons = oracle::errors_of(no_slopes);
  CHECK(by_polygons.all.depths == all.all.depths);
  CHECK(by_polygons.not_judged == 0);
  CHECK(by_polygons.all.largest_depth < 1e-13);
  const Trace edges_only = run_without<EdgeTableInsert, EdgeTableSkip, EdgeEnter, EdgeStep, EdgeRetire, EdgeSwap>(
      test::recorded_by("z-buffer", scene));
  CHECK(oracle::errors_of(edges_only).all.depths == all.all.depths);
}

TEST_CASE("error: a depth that is no finite number has no error of 0") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/foley.jsonl"));
  for (const double z : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::int64_t made = 0, first = 0;
    TraceRecorder recorder(right.header(), right.scene());
    right.each(0, right.size(), [&](std::int64_t step, const RecordedEvent& read) {
      RecordedEvent made_of = read;
      if (auto* depth = get_if<DepthInterpolate>(&made_of.event)) {
        depth->z = z;
        if (++made == 1) first = step;
      }
      record_any(recorder, made_of.step, made_of.event);
      return true;
    });
    recorder.finish();
    const oracle::Errors errors = oracle::errors_of(Trace::from_bytes(recorder.take_bytes(), "not finite"));
    CHECK(made > 0);
    CHECK(errors.not_finite == made);
    CHECK(errors.not_finite_step == first);
    CHECK(errors.all.depths == made);
    CHECK(std::isinf(errors.all.largest));
    CHECK(std::isinf(errors.all.root_mean_square()));
    CHECK(errors.along_span.empty());
  }
}

using Exact3 = std::array<Fraction, 3>;
Exact3 minus(const Exact3& a, const Exact3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Exact3 as_fractions(const glm::dvec3& p) { return {Fraction(p.x), Fraction(p.y), Fraction(p.z)}; }
Fraction determinant(const Exact3& a, const Exact3& b, const Exact3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
}

TEST_CASE("exact: t of a ray is also what Cramer's rule gives for X_0 + t dX = a + u(b - a) + v(c - a)") {
  test::Numbers random(12);
  for (int trial = 0; trial < 500; ++trial) {
    Scene scene;
    scene.raster = {24, 20, false};
    const std::vector<glm::dvec3> corners{random.in_box(1), random.in_box(1), random.in_box(1)};
    test::add_polygon(scene, corners);
    test::look(scene, Camera::Kind::perspective, 4 + trial * 0.01, 30, 60, 1, 8);
    const Camera& camera = scene.camera;
    const int x = trial % 24, y = trial % 20;
    const Fraction w_y(camera.window), w_x = w_y * 24 / 20;
    const Fraction x_p = (Fraction(x) + Fraction(1, 2)) * 2 * w_x / 24 - w_x,
                   y_p = w_y - (Fraction(y) + Fraction(1, 2)) * 2 * w_y / 20;
    Exact3 along;
    for (int axis = 0; axis < 3; ++axis)
      along[static_cast<std::size_t>(axis)] =
          x_p * camera.view[axis][0] + y_p * camera.view[axis][1] + Fraction(camera.d) * camera.view[axis][2];
    const Exact3 a = as_fractions(corners[0]), u = minus(as_fractions(corners[1]), a),
                 v = minus(as_fractions(corners[2]), a), away = minus(a, as_fractions(camera.eye));
    const Exact3 minus_u{-u[0], -u[1], -u[2]}, minus_v{-v[0], -v[1], -v[2]};
    const Fraction t = determinant(away, minus_u, minus_v) / determinant(along, minus_u, minus_v);
    oracle::ExactRays rays(scene, Conventions::Depth::pseudodepth);
    const auto met = rays.meet(0, x, y);
    REQUIRE(met);
    CHECK(Fraction(*met) == t);
    const Fraction near(camera.near), far(camera.far), z = t * Fraction(camera.d);
    CHECK(Fraction(rays.depth(*met)) == (far + near - 2 * far * near / z) / (far - near));
  }
}

TEST_CASE("error: rays, planes, trees and depth sort are judged at each pixel, and rounding turns nothing here") {
  for (const char* method_id : {"ray-casting", "ray-tracing", "bsp", "depth-sort", "warnock", "scan-line"})
    for (const char* name : {"pyramid-behind", "intersecting", "cube"}) {
      CAPTURE(method_id);
      CAPTURE(name);
      ViewOptions view;
      view.width = 40, view.height = 30;
      const Scene scene = look_at_scene(load_scene(name).scene, view);
      const Trace trace = test::recorded_by(method_id, scene);
      const oracle::Errors errors = oracle::errors_of(trace);
      std::int64_t painted = 0;
      trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
        painted += holds<PixelPaint>(recorded.event);
        return true;
      });
      CHECK(painted > 100);
      CHECK(errors.all.depths == painted);
      CHECK(errors.not_judged == 0);
      CHECK(errors.all.largest_depth > 0);
      CHECK(errors.all.largest_depth < 1e-13);
      CHECK(errors.all.decided_wrong == 0);
      CHECK(errors.wrong_pixels == 0);
    }
}

TEST_CASE("error: a piece is as deep as the whole that it was cut from, to the last digit of the exact depth") {
  test::Numbers random(5);
  int pieces = 0;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<std::vector<glm::dvec3>> triangles;
    for (int i = 0; i < 4; ++i) {
      std::vector<glm::dvec3> corners;
      for (int k = 0; k < 3; ++k) corners.push_back(random.in_box(12) + glm::dvec3(12, 12, 14));
      triangles.push_back(corners);
    }
    const Scene scene = test::screen_scene(24, 24, triangles);
    for (const char* method_id : {"bsp", "depth-sort", "ray-casting"}) {
      CAPTURE(trial);
      CAPTURE(method_id);
      const Trace trace = test::recorded_by(method_id, scene);
      trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
        const auto* piece = get_if<PieceMake>(&recorded.event);
        pieces += piece && piece->parent >= 0;
        return true;
      });
      const oracle::Errors errors = oracle::errors_of(trace);
      Replay replay(trace);
      replay.go_to(trace.size());
      const Picture& picture = replay.state().picture;
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
          const std::size_t pixel = picture.at(x, y);
          if (picture.polygon[pixel] == no_polygon) continue;
          const auto& corners = triangles[static_cast<std::size_t>(picture.polygon[pixel])];
          const auto vertex = [&](std::size_t i) { return oracle::Vertex{corners[i].x, corners[i].y, corners[i].z}; };
          const Fraction exact = depth_of_plane(vertex(0), vertex(1), vertex(2), x, y);
          CHECK(errors.depth_error_of_pixel[pixel] ==
                doctest::Approx(static_cast<double>(Fraction(picture.depth[pixel]) - exact)).epsilon(1e-12));
        }
    }
  }
  CHECK(pieces > 20);
}

TEST_CASE("error: of two planes that a ray takes for the wrong one, the step and the pixel are found") {
  // One plane, of which rounding makes two: the second triangle has other vertices in it.
  test::Numbers random(8);
  std::int64_t wrong = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<glm::dvec3> whole;
    for (int i = 0; i < 3; ++i) whole.push_back(random.in_box(8) + glm::dvec3(8, 8, 9));
    const auto mixed = [&](double a, double b) { return a * whole[0] + b * whole[1] + (1 - a - b) * whole[2]; };
    const Scene scene = test::screen_scene(16, 16, {whole, {mixed(0.8, 0.1), mixed(0.1, 0.8), mixed(0.1, 0.1)}});
    const Trace trace = test::recorded_by("ray-casting", scene);
    const oracle::Errors errors = oracle::errors_of(trace);
    CHECK(errors.wrong_pixels == errors.all.decided_wrong);
    wrong += errors.all.decided_wrong;
    for (const oracle::WrongDecision& found : errors.decisions) {
      CHECK(holds<RayHit>(trace.event(found.step).event));
      CHECK(std::abs(found.z - found.z_exact) < 1e-11);
      CHECK((found.z - found.stored) * (found.z_exact - found.stored_exact) <= 0);
    }
  }
  CHECK(wrong > 0);
}

}  // namespace
