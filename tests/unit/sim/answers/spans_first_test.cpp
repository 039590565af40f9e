// What is told of runs whose spans come before their pixels: of a polygon, a scan line or the whole scene. It is what
// is told of the same run in zstep's order.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "sim/answers/explain_value.hpp"
#include "sim/answers/pixel_counts.hpp"
#include "sim/answers/pixel_history.hpp"
#include "sim/answers/why_not.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/unit/sim/answers/reordered_runs.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"

using namespace zstep;
using answers::Outcome, answers::Verdict, answers::Visit;

namespace {

Trace golden_run(const char* name) {
  return open_jsonl(test::in_checkout(std::string("tests/golden/") + name + ".jsonl"));
}

/// Two polygons over the same pixels, on both sides of each other.
Scene two_crossing() { return look_at_scene(load_scene("intersecting").scene, {}); }

enum class Order { polygon, scene, picture };
Trace in_order(const Trace& right, Order order) {
  return order == Order::polygon ? test::pixels_last(right, [](auto&) {})
         : order == Order::scene ? test::all_pixels_last(right, test::as_they_are)
                                 : test::all_pixels_last(right, test::by_picture);
}

/// The steps at which depths are interpolated, by pixel and polygon in their order.
std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int64_t>> depths_by_pixel(const Trace& trace) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int64_t>> steps;
  trace.each(0, trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
    if (const auto* depth = get_if<DepthInterpolate>(&recorded.event)) steps[{depth->x, depth->y}].push_back(step);
    return true;
  });
  return steps;
}

/// All of a chain but the numbers of its steps.
std::string lines_of(const answers::Chain& chain) {
  std::string lines;
  for (const answers::ChainLink& link : chain.links) {
    lines += fmt::format("{} {} {}\n", link.depth, link.what, link.source);
    for (const answers::ChainValue& value : link.values)
      lines += fmt::format("{} {}\n", answers::line_text(value), answers::doubt_text(value));
  }
  return lines;
}

/// Of every nth pixel: the depths there come from the same numbers.
void check_origins(const Trace& right, const Trace& run, int every) {
  const auto theirs = depths_by_pixel(run);
  int tried = 0;
  for (const auto& [pixel, steps] : depths_by_pixel(right)) {
    if (tried++ % every != 0) continue;
    const auto found = theirs.find(pixel);
    REQUIRE(found != theirs.end());
    REQUIRE(found->second.size() == steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::int64_t there = found->second[i];
      CAPTURE(there);
      CHECK(lines_of(answers::explain_value(run, {there})) == lines_of(answers::explain_value(right, {steps[i]})));
    }
  }
  CHECK(tried > 10);
}

/// No number of a chain contradicts those that it comes from.
void check_no_doubt(const Trace& run) {
  for (const auto& [pixel, steps] : depths_by_pixel(run))
    for (const std::int64_t step : steps) {
      CAPTURE(step);
      for (const answers::ChainLink& link : answers::explain_value(run, {step}).links)
        for (const answers::ChainValue& value : link.values) CHECK(answers::doubt_text(value) == "");
    }
}

/// "0 won 5 ∞ -1 takes 0", a line a visit; what is dropped without a step at the pixel is left out.
std::vector<std::string> visits_in(const Trace& trace, Trace::Pixel pixel) {
  std::vector<std::string> lines;
  for (const Visit& visit : answers::pixel_history(trace, pixel))
    if (visit.outcome != Outcome::rejected)
      lines.push_back(fmt::format("{} {} {} {} {} {} {} {}", visit.polygon, static_cast<int>(visit.outcome),
                                  visit.z.value_or(-7), visit.stored.value_or(-7), visit.stored_polygon, visit.takes,
                                  visit.shows, visit.remark.empty()));
  return lines;
}

void check_visits(const Trace& right, const Trace& run) {
  const Raster& raster = right.scene().raster;
  int visited = 0;
  for (std::int32_t y = 0; y < raster.height; ++y)
    for (std::int32_t x = 0; x < raster.width; ++x) {
      const auto lines = visits_in(right, {x, y});
      visited += !lines.empty();
      CAPTURE(x);
      CAPTURE(y);
      CHECK(visits_in(run, {x, y}) == lines);
      for (std::int32_t polygon = 0; polygon < std::ssize(right.scene().polygons) && !lines.empty(); ++polygon) {
        CAPTURE(polygon);
        const Verdict its = answers::why_not(run, polygon, {x, y}), own = answers::why_not(right, polygon, {x, y});
        CHECK(its.kind == own.kind);
        CHECK(its.other == own.other);
        CHECK(its.gap == own.gap);
        CHECK(its.formulas == own.formulas);
        CHECK(its.chain.size() == own.chain.size());
      }
    }
  CHECK(visited > 10);
  answers::PixelCounts own(right), its(run);
  own.count_to(right.size()), its.count_to(run.size());
  for (std::size_t count = 0; count < answers::count_kinds; ++count)
    CHECK_MESSAGE(its.of(static_cast<answers::Count>(count)) == own.of(static_cast<answers::Count>(count)),
                  answers::count_names[count]);
}

}  // namespace

TEST_CASE("spans first: the origin of a depth is told of its own span, edges and scan line") {
  using enum Conventions::Interpolation;
  for (const char* name : {"delhi", "pyramid-view", "clipping", "with-attribute"}) {
    CAPTURE(std::string(name));
    const Trace right = golden_run(name);
    const bool adds = right.header().conventions.interpolation != direct;
    for (const Order order : {Order::polygon, Order::scene, Order::picture}) {
      CAPTURE(static_cast<int>(order));
      // In the picture's order what is added to may be an earlier pixel's depth that is not followed further.
      if (!adds || order != Order::picture) check_origins(right, in_order(right, order), 5);
      check_no_doubt(in_order(right, order));
    }
  }
  Conventions conventions;
  conventions.interpolation = increments;
  for (const auto depth : {Conventions::Depth::pseudodepth, Conventions::Depth::corrected}) {
    conventions.depth = depth;
    ViewOptions view;
    view.width = 24, view.height = 18;
    const Trace right =
        test::recorded_by("z-buffer", look_at_scene(load_scene("pyramid-behind").scene, view), conventions);
    for (const Order order : {Order::polygon, Order::scene}) {
      CAPTURE(static_cast<int>(order));
      check_origins(right, in_order(right, order), 7);
    }
  }
}

TEST_CASE("spans first: pieces have an edge table each, also where a tree keeps them all") {
  for (const char* name : {"transparency", "transparency-clipping", "transparency-edges"}) {
    CAPTURE(std::string(name));
    const Trace right = golden_run(name), run = in_order(right, Order::scene);
    check_no_doubt(run);
    check_origins(right, run, 1);
  }
}

TEST_CASE("spans first: where two polygons cover a pixel, its origin is its own polygon, also of the same span") {
  const std::vector<glm::dvec3> triangle{{3.25, 2, 2.5}, {4.25, 13, 2.5}, {12.6875, 7.3125, 9.40625}};
  Conventions conventions;
  for (const auto how : {Conventions::Interpolation::direct, Conventions::Interpolation::increments}) {
    CAPTURE(static_cast<int>(how));
    conventions.interpolation = how;
    const Trace crossing = test::recorded_by("z-buffer", two_crossing(), conventions);
    check_origins(crossing, in_order(crossing, Order::scene), 1);
    const Trace same = test::recorded_by("z-buffer", test::screen_scene(16, 16, {triangle, triangle}), conventions);
    check_origins(same, in_order(same, Order::scene), 1);
    // Spans of the second polygon end where those of the first begin.
    const Trace beside = test::recorded_by(
        "z-buffer",
        test::screen_scene(16, 16, {{{4, 1, 2}, {4, 12, 3}, {13, 6, 9}}, {{0.5, 2, 5}, {4.5, 1, 7}, {4.5, 12, 6}}}),
        conventions);
    check_no_doubt(in_order(beside, Order::picture));
  }
}

TEST_CASE("spans first: history, why-not and pixel counts go by the polygon of a pixel's span") {
  for (const char* name : {"delhi", "pyramid-view", "pyramid-behind", "clipping"}) {
    CAPTURE(std::string(name));
    const Trace right = golden_run(name);
    for (const Order order : {Order::polygon, Order::scene, Order::picture}) {
      CAPTURE(static_cast<int>(order));
      check_visits(right, in_order(right, order));
    }
  }
  const Trace right = test::recorded_by("z-buffer", two_crossing());
  for (const Order order : {Order::scene, Order::picture}) check_visits(right, in_order(right, order));
}

TEST_CASE("spans first: where one table has all polygons, a pixel is of its span's") {
  const Trace right = golden_run("scan-line-buffer");
  const Trace run = test::pixels_last<ScanLineBegin>(right, [](auto&) {});
  check_origins(right, run, 3);
  check_visits(right, run);
}
