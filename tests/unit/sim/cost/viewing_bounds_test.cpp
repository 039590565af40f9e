// What rounding may do to a depth on the way of its polygon's vertices to the raster.
#include "sim/cost/bounds.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/oracle/exact_depth.hpp"

using namespace zstep;

namespace {

/// A run that records neither its vertices nor its spans.
Trace without_vertices(const Trace& trace) {
  return test::changed(trace, [](std::int64_t, const Event& event) {
    return holds<BuffersClear>(event) || holds<PolygonBegin>(event) || holds<DepthCompare>(event) ||
           holds<DepthWrite>(event) || holds<PixelWrite>(event);
  });
}

struct Held {
  int pixels = 0, beyond_interpolation = 0, beyond_both = 0;
  double largest = 0;  ///< of the viewing bounds
};
Held held(const Trace& run) {
  const oracle::Errors errors = oracle::errors_of(run);
  const auto bounds = compare::bounds_in(run);
  REQUIRE(bounds);
  Held all;
  for (std::size_t pixel = 0; pixel < bounds->of_pixel.size(); ++pixel) {
    const double off = std::abs(errors.depth_error_of_pixel[pixel]);
    if (std::isnan(off) || errors.polygon_of_pixel[pixel] != bounds->picture.polygon[pixel]) continue;
    const auto more = compare::viewing_bound(run, errors.scene_facet_of_pixel[pixel]);
    if (!more) continue;
    ++all.pixels;
    all.beyond_interpolation += off > bounds->of_pixel[pixel];
    all.beyond_both += off > bounds->of_pixel[pixel] + *more;
    all.largest = std::max(all.largest, *more);
  }
  return all;
}

TEST_CASE("bound: where a run records no vertices, what viewing and projection round is in it") {
  using enum Conventions::Depth;
  int beyond_interpolation = 0, pixels = 0;
  for (const char* name : {"pyramid-behind", "dodecahedron", "cube", "intersecting"})
    for (const Conventions::Depth depth : {pseudodepth, reciprocal, reversed, foley})
      for (const NumberFormat format : {NumberFormat::float64, NumberFormat::float32}) {
        CAPTURE(name);
        CAPTURE(word_of(depth));
        CAPTURE(word_of(format));
        ViewOptions view;
        view.width = 40, view.height = 30;
        Conventions conventions;
        conventions.depth = depth, conventions.number_format = format;
        const Scene scene = look_at_scene(load_scene(name).scene, view);
        const Held of = held(without_vertices(test::recorded_by("z-buffer", scene, conventions)));
        CHECK(of.beyond_both == 0);
        // It is no more than rounding: a few last digits of numbers as large as a raster's.
        CHECK(of.largest < (format == NumberFormat::float64 ? 1e-12 : 1e-3));
        pixels += of.pixels;
        if (format == NumberFormat::float64) beyond_interpolation += of.beyond_interpolation;
      }
  CHECK(pixels > 1000);
  CHECK(beyond_interpolation > 0);  // without it, right depths would be called wrong
}

TEST_CASE("bound: a depth that is off by more than that is beyond it, and what has no such bound is not held to one") {
  ViewOptions view;
  view.width = 40, view.height = 30;
  const Scene scene = look_at_scene(load_scene("pyramid-behind").scene, view);
  const Trace right = without_vertices(test::recorded_by("z-buffer", scene));
  TraceRecorder recorder(right.header(), right.scene());
  right.each(0, right.size(), [&](std::int64_t, const RecordedEvent& read) {
    RecordedEvent made = read;
    if (auto* depth = get_if<DepthWrite>(&made.event)) depth->z += 1e-11;
    record_any(recorder, made.step, made.event);
    return true;
  });
  recorder.finish();
  const Held wrong = held(Trace::from_bytes(recorder.take_bytes(), "wrong"));
  CHECK(wrong.pixels > 100);
  CHECK(wrong.beyond_both == wrong.pixels);
  // z_v is interpolated as if it were linear, which is no rounding; a corner that is cut off is another vertex.
  Conventions conventions;
  conventions.depth = Conventions::Depth::view;
  CHECK(held(without_vertices(test::recorded_by("z-buffer", scene, conventions))).pixels == 0);
  Scene cut = scene;
  cut.camera.near = 0.5 * (scene.camera.near + scene.camera.far);
  CHECK(held(without_vertices(test::recorded_by("z-buffer", cut))).pixels < held(right).pixels);
}

TEST_CASE("exact: the plane of a facet as it is seen, and what a corner is off it") {
  const Scene flat = test::screen_scene(16, 16, {{{1, 1, 3}, {9, 1, 7}, {1, 5, 5}}, {{1, 1, 2}, {9, 1, 2}, {9, 9, 2}}});
  const auto plane = oracle::seen_plane(flat, Conventions::Depth::view, 0);
  REQUIRE(plane);
  CHECK(plane->dz_dx == 0.5);
  CHECK(plane->dz_dy == 0.5);
  CHECK(plane->bend == 0);
  const Scene bent = test::screen_scene(16, 16, {{{1, 1, 2}, {9, 1, 2}, {9, 9, 2}, {1, 9, 2.5}}});
  const auto off = oracle::seen_plane(bent, Conventions::Depth::view, 0);
  REQUIRE(off);
  CHECK(off->bend > 0.1);
  CHECK(off->bend < 0.5);
  const Scene edge_on = test::screen_scene(16, 16, {{{1, 1, 2}, {9, 1, 2}, {5, 1, 8}}});
  CHECK(!oracle::seen_plane(edge_on, Conventions::Depth::view, 0));
}

}  // namespace
