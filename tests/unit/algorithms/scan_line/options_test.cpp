// What the options promise: the line buffer gives the Z-buffer's picture, coherence changes no bit of it and saves
// compares, area coverage leaves polygon and depth as they are.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "algorithms/scan_line/scan_line.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/laws/agreement/scenes.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/error.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using test::screen_scene;

namespace {

using Depth = Conventions::Depth;
using Interpolation = Conventions::Interpolation;
using RasterCoverage = Conventions::Coverage;

Conventions with(std::map<std::string, std::string> options, bool cull = false) {
  Conventions conventions;
  conventions.cull = cull;
  conventions.options = std::move(options);
  return conventions;
}

Picture draw(const Scene& scene, const Conventions& conventions) {
  NullRecorder nothing;
  return scan_line::run(scene, conventions, nothing);
}

bool same_bits(const Picture& a, const Picture& b) {
  return a.polygon == b.polygon && a.ink == b.ink &&
         std::memcmp(a.depth.data(), b.depth.data(), a.depth.size() * sizeof(double)) == 0;
}

std::int64_t count(const CountRecorder& counts, std::uint8_t step) { return counts.count[step]; }

std::string refusal(const Conventions& conventions) {
  try {
    scan_line::check(conventions, "--option");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// The shares of one pixel, by polygon.
std::map<std::int32_t, double> shares_at(const CollectRecorder& record, std::int32_t x, std::int32_t y) {
  std::map<std::int32_t, double> shares;
  for (const CoverageAdd& share : record.all<CoverageAdd>()) {
    if (share.x == x && share.y == y) shares[share.owner] = share.coverage;
  }
  return shares;
}

Scene two_colors(const std::vector<std::vector<glm::dvec3>>& polygons) {
  Scene scene = screen_scene(6, 4, polygons);
  scene.background = {0, 0, 0};
  scene.polygons[0].color = {200, 100, 0};
  if (scene.polygons.size() > 1) scene.polygons[1].color = {0, 0, 240};
  return scene;
}

}  // namespace

TEST_SUITE("scan_line/options") {
  TEST_CASE("a line buffer gives the Z-buffer's picture, to the bit, under every convention") {
    for (const test::AgreementScene& subject : test::agreement_scenes()) {
      CAPTURE(subject.name);
      for (const auto depth : {Depth::pseudodepth, Depth::view}) {
        for (const auto interpolation : {Interpolation::direct, Interpolation::increments}) {
          for (const auto coverage : {RasterCoverage::top_left, RasterCoverage::inclusive}) {
            if (!subject.small && coverage == RasterCoverage::inclusive) continue;
            Conventions conventions = with({{"resolve", "line-buffer"}}, subject.cull);
            conventions.depth = depth;
            conventions.interpolation = interpolation;
            conventions.coverage = coverage;
            NullRecorder nothing;
            CHECK(same_bits(draw(subject.scene, conventions), z_buffer::run(subject.scene, conventions, nothing)));
          }
        }
      }
    }
  }

  TEST_CASE("planes cover the pixels that the Z-buffer covers, every one of them") {
    for (const test::AgreementScene& subject : test::agreement_scenes()) {
      CAPTURE(subject.name);
      const Conventions conventions = with({}, subject.cull);
      NullRecorder nothing;
      const Picture planes = draw(subject.scene, conventions);
      const Picture buffer = z_buffer::run(subject.scene, conventions, nothing);
      int differing = 0;
      for (std::size_t i = 0; i < planes.polygon.size(); ++i) {
        differing += (planes.polygon[i] == no_polygon) != (buffer.polygon[i] == no_polygon);
      }
      CHECK(differing == 0);
    }
  }

  TEST_CASE("coherence changes no bit, and saves more compares than its tests cost on scenes that have any") {
    std::int64_t saved = 0, depths = 0, less = 0, tests = 0;
    for (const test::AgreementScene& subject : test::agreement_scenes()) {
      CAPTURE(subject.name);
      CountRecorder off, on;
      const Picture plain = scan_line::run(subject.scene, with({}, subject.cull), off);
      const Picture coherent = scan_line::run(subject.scene, with({{"coherence", "on"}}, subject.cull), on);
      CHECK(same_bits(plain, coherent));
      depths += count(off, scan_line::step::depth.id);
      less += count(on, scan_line::step::depth.id);
      tests += count(on, scan_line::step::penetrate.id);
      saved += count(on, scan_line::step::saved.id);
    }
    CHECK(saved > 0);
    CHECK(less < depths);
    MESSAGE(depths, " depths from plane equations without coherence, ", less, " with it, and ", tests,
            " tests whether polygons can penetrate each other");
  }

  TEST_CASE("what coherence says it saved is what it saved") {
    const Scene scene = screen_scene(
        12, 40, {{{1, 0, 5}, {11, 0, 5}, {11, 39, 5}, {1, 39, 5}}, {{3, 2, 2}, {9, 2, 3}, {9, 35, 3}, {3, 35, 2}}});
    CollectRecorder off, on;
    scan_line::run(scene, with({}), off);
    scan_line::run(scene, with({{"coherence", "on"}}), on);
    std::int32_t saved = 0;
    for (const Saved& row : on.all<Saved>()) saved += row.tests;
    CHECK(off.all<PlaneDepth>().size() == 4 * 33);
    CHECK(on.all<PlaneDepth>().size() == 4);
    CHECK(saved == 4 * 32);
    CHECK(on.all<SideTest>().size() == 1);
    CHECK(on.all<SideTest>()[0].piece == 0);
    CHECK(on.all<SideTest>()[0].side == Side::behind);
  }

  TEST_CASE("coherence gives way where polygons penetrate each other, or touch") {
    // z = 5 against z = y/2: the one comes through the other in row 10, while the active edges stay the same.
    const Scene scene = screen_scene(
        12, 40,
        {{{1, 0, 5}, {11, 0, 5}, {11, 39, 5}, {1, 39, 5}}, {{3, 2, 1}, {9, 2, 1}, {9, 35, 17.5}, {3, 35, 17.5}}});
    CollectRecorder record;
    const Picture coherent = scan_line::run(scene, with({{"coherence", "on"}}), record);
    CHECK(record.all<Saved>().empty());
    CHECK(record.all<SideTest>().size() == 2);
    CHECK(same_bits(coherent, draw(scene, with({}))));
    CHECK(coherent.polygon[coherent.at(5, 9)] == 1);
    CHECK(coherent.polygon[coherent.at(5, 11)] == 0);
  }

  TEST_CASE("an implied edge goes on in a straight line: found once, then known, until it leaves the interval") {
    // z = x/2 against z = 5 − y/8: they meet at x = 10 − y/4, from column 10 in row 0 to column 1 in row 36; B is in
    // from 2 to 9.
    const Scene scene = screen_scene(
        16, 40,
        {{{1, 0, 0.5}, {14, 0, 7}, {14, 39, 7}, {1, 39, 0.5}}, {{2, 0, 5}, {9, 0, 5}, {9, 39, 0.125}, {2, 39, 0.125}}});
    CollectRecorder off, on;
    const Picture plain = scan_line::run(scene, with({}), off);
    const Picture coherent = scan_line::run(scene, with({{"coherence", "on"}}), on);
    CHECK(same_bits(plain, coherent));
    // In rows 0 to 4 A is in front all along the interval; the two penetrate each other, so depths must be compared. In
    // row 5 the implied edge is found, at 8.75, and in rows 6 to 38 it is known; at 9 and at 2 it is on an end, where
    // depths decide.
    const std::vector<ImpliedEdge> found = off.all<ImpliedEdge>(), known = on.all<ImpliedEdge>();
    REQUIRE(found.size() == known.size());
    REQUIRE(found.size() == 27);
    for (std::size_t k = 0; k < found.size(); ++k) {
      CHECK(known[k].x_at == doctest::Approx(found[k].x_at).epsilon(1e-12));
      CHECK(found[k].x_at == doctest::Approx(10 - (5.0 + static_cast<double>(k)) / 4));
    }
    std::int32_t saved = 0;
    for (const Saved& row : on.all<Saved>()) {
      CHECK(row.coherence == zstep::Coherence::implied_edge);
      saved += row.tests;
    }
    CHECK(saved > 4 * 25);
    CHECK(static_cast<std::int64_t>(off.all<PlaneDepth>().size()) -
              static_cast<std::int64_t>(on.all<PlaneDepth>().size()) ==
          saved);
  }

  TEST_CASE("area coverage: upright edges to the digit") {
    // Columns 1.25 to 3.5 of row 1: pixel 1 spans 0.5 to 1.5, so a quarter of it is covered.
    const Scene scene = two_colors({{{1.25, 0.5, 1}, {3.5, 0.5, 1}, {3.5, 2.5, 1}, {1.25, 2.5, 1}}});
    CollectRecorder record;
    const Picture picture = scan_line::run(scene, with({{"antialias", "on"}}), record);
    CHECK(shares_at(record, 1, 1) == std::map<std::int32_t, double>{{-1, 0.75}, {0, 0.25}});
    CHECK(shares_at(record, 2, 1).empty());
    CHECK(shares_at(record, 4, 1).empty());
    CHECK(picture.ink[picture.at(1, 1)] == ink_of({50, 25, 0}));
    CHECK(picture.ink[picture.at(2, 1)] == no_ink);
    CHECK(picture.polygon[picture.at(1, 1)] == no_polygon);  // its centre is not covered
  }

  TEST_CASE("area coverage: where one polygon hides part of another, and where they penetrate") {
    const std::vector<glm::dvec3> all{{-1, -1, 4}, {7, -1, 4}, {7, 5, 4}, {-1, 5, 4}};
    CollectRecorder hides, implied;
    scan_line::run(two_colors({all, {{2.25, -1, 1}, {7, -1, 1}, {7, 5, 1}, {2.25, 5, 1}}}), with({{"antialias", "on"}}),
                   hides);
    CHECK(shares_at(hides, 2, 1) == std::map<std::int32_t, double>{{0, 0.75}, {1, 0.25}});
    // z = 4 against z = 6.25 - x: they meet in column 2.25.
    scan_line::run(two_colors({all, {{-1, -1, 7.25}, {7, -1, -0.75}, {7, 5, -0.75}, {-1, 5, 7.25}}}),
                   with({{"antialias", "on"}}), implied);
    const auto shares = shares_at(implied, 2, 1);
    REQUIRE(shares.size() == 2);
    CHECK(shares.at(0) == doctest::Approx(0.75).epsilon(1e-9));
    CHECK(shares.at(1) == doctest::Approx(0.25).epsilon(1e-9));
  }

  TEST_CASE("area coverage: shares of a pixel add up to 1, a slope's to its area, and slivers are not lost") {
    const Scene scene =
        two_colors({{{0, -0.5, 1}, {4, -0.5, 1}, {0, 3.5, 1}}, {{4.9, -1, 1}, {5.1, -1, 1}, {5.1, 5, 1}, {4.9, 5, 1}}});
    CollectRecorder record;
    const Picture picture = scan_line::run(scene, with({{"antialias", "on"}}), record);
    double area = 0;
    for (std::int32_t y = 0; y < 4; ++y) {
      for (std::int32_t x = 0; x < 6; ++x) {
        const auto shares = shares_at(record, x, y);
        double sum = 0;
        for (const auto& [owner, share] : shares) sum += share;
        if (!shares.empty()) CHECK(sum == doctest::Approx(1));
        area += shares.contains(0) ? shares.at(0) : shares.empty() && picture.polygon[picture.at(x, y)] == 0 ? 1 : 0;
      }
    }
    CHECK(area == doctest::Approx(8));  // half of 4 x 4
    CHECK(shares_at(record, 5, 2).at(1) == doctest::Approx(0.2));

    // A bar that no pixel's centre and no row of centres meets.
    const Scene thin = two_colors({{{1, 1.1, 1}, {4, 1.1, 1}, {4, 1.4, 1}, {1, 1.4, 1}}});
    CollectRecorder thin_record;
    const Picture none = scan_line::run(thin, with({{"antialias", "on"}}), thin_record);
    CHECK(std::count(none.polygon.begin(), none.polygon.end(), no_polygon) == 24);
    CHECK(shares_at(thin_record, 2, 1) == std::map<std::int32_t, double>{{-1, 0.5}, {0, 0.5}});
  }

  TEST_CASE("area coverage leaves polygons and depths as they are") {
    for (const test::AgreementScene& subject : test::agreement_scenes()) {
      if (!subject.small) continue;
      CAPTURE(subject.name);
      const Picture plain = draw(subject.scene, with({}, subject.cull));
      Picture mixed = draw(subject.scene, with({{"antialias", "on"}}, subject.cull));
      CHECK(mixed.ink.size() == mixed.polygon.size());
      mixed.ink.clear();
      CHECK(same_bits(plain, mixed));
    }
  }

  TEST_CASE("what does not go together is refused, with a way out") {
    CHECK(refusal(with({})).empty());
    CHECK(refusal(with({{"antialias", "on"}, {"coherence", "on"}})).empty());
    Conventions conventions = with({});
    conventions.depth = Depth::view;
    CHECK(refusal(conventions).find("resolve=line-buffer") != std::string::npos);
    conventions.options["resolve"] = "line-buffer";
    CHECK(refusal(conventions).empty());
    conventions.options["antialias"] = "on";
    CHECK(refusal(conventions).find("resolve=planes") != std::string::npos);
    CHECK(refusal(with({{"resolve", "line-buffer"}, {"coherence", "on"}})).find("coherence=on") != std::string::npos);
  }
}
