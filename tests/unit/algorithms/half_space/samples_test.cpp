// Several samples a pixel: where they are, whom each belongs to, and how near their shares come to areas.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/half_space/half_space.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/error.hpp"
#include "traces/formulas/samples.hpp"

using namespace zstep;

namespace {

Conventions with_samples(const std::string& samples) {
  Conventions conventions;
  conventions.options["samples"] = samples;
  return conventions;
}

CollectRecorder events_with(const Scene& scene, const Conventions& conventions) {
  CollectRecorder record;
  half_space::run(scene, conventions, record);
  return record;
}

/// Of one pixel, by polygon; where all samples show what the centre does, nothing.
std::map<std::int32_t, double> shares_of_pixel(const CollectRecorder& record, std::int32_t x, std::int32_t y) {
  std::map<std::int32_t, double> shares;
  for (const CoverageAdd& share : record.all<CoverageAdd>())
    if (share.x == x && share.y == y) shares[share.owner] = share.coverage;
  return shares;
}

/// Even-odd, by a ray to the right.
bool lies_in(const std::vector<glm::dvec3>& outline, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3 &p = outline[i], &q = outline[(i + 1) % outline.size()];
    if ((p.y > y) != (q.y > y) && x < p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x)) inside = !inside;
  }
  return inside;
}

/// How far the shares of a triangle are from its areas, which 64 by 64 points a pixel measure: the mean square.
double error_of(const std::vector<glm::dvec3>& outline, const std::string& samples) {
  constexpr std::int32_t side = 12, fine = 64;
  const CollectRecorder record = events_with(test::screen_scene(side, side, {outline}), with_samples(samples));
  std::vector<double> share(side * side, 0);
  for (const PixelWrite& e : record.all<PixelWrite>()) share[static_cast<std::size_t>(e.y * side + e.x)] = 1;
  for (const CoverageAdd& e : record.all<CoverageAdd>()) share[static_cast<std::size_t>(e.y * side + e.x)] = 0;
  for (const CoverageAdd& e : record.all<CoverageAdd>())
    if (e.owner == 0) share[static_cast<std::size_t>(e.y * side + e.x)] = e.coverage;
  double sum = 0;
  for (std::int32_t y = 0; y < side; ++y)
    for (std::int32_t x = 0; x < side; ++x) {
      int inside = 0;
      for (int j = 0; j < fine; ++j)
        for (int i = 0; i < fine; ++i)
          inside += lies_in(outline, x - 0.5 + (i + 0.5) / fine, y - 0.5 + (j + 0.5) / fine);
      const double off = share[static_cast<std::size_t>(y * side + x)] - inside / double(fine * fine);
      sum += off * off;
    }
  return sum;
}

}  // namespace

TEST_SUITE("half_space/samples") {
  TEST_CASE(
      "of a pixel's 2, 4, 8 or 16 samples no two stand in one row or column, as the standard patterns have them") {
    for (const int count : {2, 4, 8, 16}) {
      const std::string word = std::to_string(count);
      CAPTURE(word);
      const auto offsets = formulas::samples_of(with_samples(word));
      REQUIRE(std::ssize(offsets) == count);
      std::set<int> columns, rows;
      for (const formulas::SampleOffset& at : offsets) {
        columns.insert((at.right + 8) * count / 16), rows.insert((at.down + 8) * count / 16);
        CHECK(std::abs(at.dx()) <= 0.5);
        CHECK(std::abs(at.dy()) <= 0.5);
      }
      CHECK(std::ssize(columns) == count);
      CHECK(std::ssize(rows) == count);
    }
    CHECK(formulas::samples_of(Conventions{}).empty());
    CHECK(formulas::samples_of(with_samples("a-buffer")).empty());
  }

  TEST_CASE("an upright edge through a pixel gives each side the samples left and right of it") {
    // x = 4.25 cuts pixel 4, which goes from 3.5 to 4.5, at three quarters of its width.
    const Scene scene = test::screen_scene(
        8, 4,
        {{{-1, -1, 2}, {4.25, -1, 2}, {4.25, 5, 2}, {-1, 5, 2}}, {{4.25, -1, 2}, {9, -1, 2}, {9, 5, 2}, {4.25, 5, 2}}});
    for (const char* samples : {"4", "8", "16", "a-buffer"}) {
      CAPTURE(samples);
      const CollectRecorder record = events_with(scene, with_samples(samples));
      for (std::int32_t y = 0; y < 4; ++y)
        CHECK(shares_of_pixel(record, 4, y) == std::map<std::int32_t, double>{{0, 0.75}, {1, 0.25}});
      CHECK(record.all<CoverageAdd>().size() == 8);  // no other pixel is mixed
    }
  }

  TEST_CASE("watertight: where triangles share edges and vertices each sample lies in exactly one") {
    test::Numbers random(40);
    for (int round = 0; round < 20; ++round)
      for (const double snap : {0.0625, 1e-9}) {
        // Round a vertex: a fan that fills the raster, so that every sample has its triangle.
        const auto snapped = [&](double x) { return std::round(x / snap) * snap; };
        const glm::dvec3 middle(snapped(random.between(2, 6)), snapped(random.between(2, 6)), 1);
        const std::vector<glm::dvec3> rim{
            {-2, -2, 1}, {snapped(random.between(1, 7)), -2, 1}, {10, -2, 1}, {10, snapped(random.between(1, 7)), 1},
            {10, 10, 1}, {snapped(random.between(1, 7)), 10, 1}, {-2, 10, 1}};
        std::vector<std::vector<glm::dvec3>> triangles;
        for (std::size_t i = 0; i < rim.size(); ++i) triangles.push_back({middle, rim[i], rim[(i + 1) % rim.size()]});
        const Scene scene = test::screen_scene(8, 8, triangles);
        for (const char* samples : {"2", "4", "8", "16"}) {
          CAPTURE(round);
          CAPTURE(samples);
          std::map<std::tuple<int, int, int>, int> owners;
          const CollectRecorder record = events_with(scene, with_samples(samples));
          for (const SampleTest& e : record.all<SampleTest>()) owners[{e.x, e.y, e.sample}] += e.inside;
          CHECK(owners.size() == 64 * static_cast<std::size_t>(std::atoi(samples)));
          for (const auto& [sample, count] : owners) CHECK(count == 1);
        }
        std::map<std::pair<int, int>, std::uint32_t> masks;
        std::map<std::pair<int, int>, int> bits;
        const CollectRecorder record = events_with(scene, with_samples("a-buffer"));
        for (const SampleMask& e : record.all<SampleMask>()) {
          const std::uint32_t mask = formulas::samples_of(e);
          CHECK((masks[{e.x, e.y}] & mask) == 0);
          masks[{e.x, e.y}] |= mask;
        }
        CHECK(masks.size() == 64);
        for (const auto& [pixel, mask] : masks) CHECK(mask == 0xffffffffu);
      }
  }

  TEST_CASE("with vertices at 256ths edge functions are what whole numbers give, at centres and samples, in each way") {
    test::Numbers random(8);
    const auto units = [](double x) { return std::llround(x * 256); };
    for (int round = 0; round < 40; ++round) {
      std::vector<glm::dvec3> outline;
      const auto snapped = [&](double x) { return static_cast<double>(units(x)) / 256; };
      for (int i = 0; i < 3; ++i)
        outline.emplace_back(snapped(random.between(-3, 19)), snapped(random.between(-3, 15)), 1);
      const Scene scene = test::screen_scene(16, 12, {outline});
      for (const char* stepping : {"products", "increments"}) {
        Conventions conventions = with_samples("8");
        conventions.options["stepping"] = stepping;
        const CollectRecorder record = events_with(scene, conventions);
        REQUIRE(record.all<TriangleSetup>().size() == 1);
        const TriangleSetup setup = record.all<TriangleSetup>()[0];
        const std::int32_t vertices[3] = {setup.vertex_0, setup.vertex_1, setup.vertex_2};
        // E_i in 65536ths of a square pixel, at a point in 256ths.
        const auto value = [&](int i, std::int64_t x, std::int64_t y) {
          const glm::dvec3 &from = outline[static_cast<std::size_t>(vertices[(i + 1) % 3])],
                           &to = outline[static_cast<std::size_t>(vertices[(i + 2) % 3])];
          const std::int64_t a = units(from.y) - units(to.y), b = units(to.x) - units(from.x);
          return a * (x - units(from.x)) + b * (y - units(from.y));
        };
        for (const InsideTest& e : record.all<InsideTest>()) {
          CHECK(e.e_0 * 65536 == static_cast<double>(value(0, 256 * e.x, 256 * e.y)));
          CHECK(e.e_1 * 65536 == static_cast<double>(value(1, 256 * e.x, 256 * e.y)));
          CHECK(e.e_2 * 65536 == static_cast<double>(value(2, 256 * e.x, 256 * e.y)));
        }
        for (const SampleTest& e : record.all<SampleTest>()) {
          const formulas::SampleOffset at = formulas::samples_of(conventions)[static_cast<std::size_t>(e.sample)];
          const std::int64_t x = 256 * e.x + 16 * at.right, y = 256 * e.y + 16 * at.down;
          CHECK(e.s_0 * 65536 == static_cast<double>(value(0, x, y)));
          CHECK(e.s_1 * 65536 == static_cast<double>(value(1, x, y)));
          CHECK(e.s_2 * 65536 == static_cast<double>(value(2, x, y)));
        }
      }
    }
  }

  TEST_CASE("samples of concave outlines and of outlines that cross themselves go by the even-odd rule") {
    const std::vector<std::vector<glm::dvec3>> outlines{
        {{1.03, 1.01, 3},
         {13.03, 1.07, 3},
         {13.01, 13.03, 3},
         {9.07, 13.01, 3},
         {9.03, 5.01, 3},
         {5.01, 5.03, 3},
         {5.07, 13.07, 3},
         {1.01, 13.03, 3}},
        {{7.03, 0.53, 1}, {11.01, 13.07, 1}, {0.51, 5.03, 1}, {13.53, 5.01, 1}, {3.07, 13.01, 1}},
        {{1.03, 1.07, 2}, {13.01, 11.03, 2}, {13.07, 1.01, 2}, {1.01, 11.07, 2}}};
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      CAPTURE(i);
      const Scene scene = test::screen_scene(15, 15, {outlines[i]});
      const auto offsets = formulas::samples_of(with_samples("8"));
      std::set<std::tuple<int, int, int>> drawn;
      for (const SampleDepth& e : events_with(scene, with_samples("8")).all<SampleDepth>())
        CHECK(drawn.insert({e.x, e.y, e.sample}).second);
      std::map<std::pair<int, int>, std::uint32_t> masks;
      for (const SampleMask& e : events_with(scene, with_samples("a-buffer")).all<SampleMask>())
        masks[{e.x, e.y}] ^= formulas::samples_of(e);
      for (int y = 0; y < 15; ++y)
        for (int x = 0; x < 15; ++x) {
          for (int s = 0; s < 8; ++s) {
            const auto& at = offsets[static_cast<std::size_t>(s)];
            CHECK(drawn.contains({x, y, s}) == lies_in(outlines[i], x + at.dx(), y + at.dy()));
          }
          for (int bit = 0; bit < 32; ++bit) {
            const auto at = formulas::mask_offset(bit);
            CHECK((masks[{x, y}] >> bit & 1) == lies_in(outlines[i], x + at.dx(), y + at.dy()));
          }
        }
    }
  }

  TEST_CASE(
      "the more samples, the nearer the shares to the areas, and frame and depth buffer stay those of the centres") {
    test::Numbers random(1984);
    std::map<std::string, double> errors;
    for (int round = 0; round < 12; ++round) {
      const std::vector<glm::dvec3> outline{{random.between(0, 11), random.between(0, 11), 1},
                                            {random.between(0, 11), random.between(0, 11), 2},
                                            {random.between(0, 11), random.between(0, 11), 3}};
      for (const char* samples : {"1", "2", "4", "8", "16", "a-buffer"}) errors[samples] += error_of(outline, samples);
      NullRecorder nothing;
      const Scene scene = test::screen_scene(12, 12, {outline});
      const Picture one = half_space::run(scene, {}, nothing),
                    many = half_space::run(scene, with_samples("8"), nothing);
      CHECK(one.polygon == many.polygon);
      CHECK(one.depth == many.depth);
    }
    MESSAGE("mean square, 1 to 16 samples and the A-buffer: ", errors["1"], " ", errors["2"], " ", errors["4"], " ",
            errors["8"], " ", errors["16"], " ", errors["a-buffer"]);
    CHECK(errors["2"] < errors["1"]);
    CHECK(errors["4"] < errors["2"]);
    CHECK(errors["8"] < errors["4"]);
    CHECK(errors["16"] < errors["8"]);
    CHECK(errors["a-buffer"] < errors["8"]);
  }

  TEST_CASE(
      "where two polygons pass through each other samples see both and the A-buffer with its one depth only one") {
    const Scene scene = test::screen_scene(
        9, 3, {{{-1, -1, 0}, {9, -1, 10}, {9, 4, 10}, {-1, 4, 0}}, {{-1, -1, 10}, {9, -1, 0}, {9, 4, 0}, {-1, 4, 10}}});
    const auto by_samples = shares_of_pixel(events_with(scene, with_samples("8")), 4, 1);
    CHECK(by_samples == std::map<std::int32_t, double>{{0, 0.5}, {1, 0.5}});
    for (const auto& [polygon, share] : shares_of_pixel(events_with(scene, with_samples("a-buffer")), 4, 1))
      CHECK(share == 1);
  }

  TEST_CASE("a picture with more samples than can be kept is refused before memory is asked for") {
    Scene scene = test::screen_scene(7680, 4320, {{{0, 0, 1}, {9, 0, 1}, {0, 9, 1}}});
    half_space::check(scene, Conventions{});
    for (const char* samples : {"2", "16", "a-buffer"})
      CHECK_THROWS_AS(half_space::check(scene, with_samples(samples)), InputError);
    scene.raster = {1024, 768, false};
    for (const char* samples : {"2", "16", "a-buffer"}) half_space::check(scene, with_samples(samples));
  }

  TEST_CASE("samples go with neither tiles nor an attribute") {
    const auto refusal = [](Conventions conventions) -> std::string {
      try {
        half_space::check(conventions, "--option");
      } catch (const InputError& error) {
        return error.what();
      }
      return "";
    };
    Conventions conventions = with_samples("4");
    CHECK(refusal(conventions).empty());
    conventions.options["tiles"] = "8";
    CHECK(refusal(conventions).find("samples=4 with tiles") != std::string::npos);
    conventions = with_samples("a-buffer");
    conventions.attribute = Conventions::Attribute::linear;
    CHECK(refusal(conventions).find("attribute") != std::string::npos);
  }
}
