// Pictures beside each other, their numbers as CSV, and the book's table.
#include <doctest/doctest.h>

#include <cmath>

#include <glm/vec2.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "sim/cost/comparison.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;
using namespace zstep::compare;

TEST_SUITE("compare/comparison") {
  TEST_CASE("agreement counts equal pixels and what explains the others") {
    const Scene scene = test::screen_scene(
        8, 6, {{{1, 1, 2}, {5, 1, 2}, {5, 4, 2}, {1, 4, 2}}, {{1, 1, 2}, {5, 1, 2}, {5, 4, 2}, {1, 4, 2}}});
    NullRecorder nothing;
    const Picture first = method("z-buffer").render(scene, {}, nothing);
    Picture other = first;
    other.polygon[other.at(2, 2)] = 1;           // the same square once more: a tie
    other.polygon[other.at(1, 2)] = no_polygon;  // on its left edge
    other.polygon[other.at(3, 2)] = no_polygon;  // in its middle
    const Agreement a = agreement(scene, {}, first, other);
    CHECK(a.pixels == 48);
    CHECK(a.equal == 45);
    CHECK(a.differing() == 3);
    CHECK(a.ties == 1);
    CHECK(a.at_edges == 1);
    CHECK(a.unexplained == 1);
    CHECK(agreement(scene, {}, first, first).equal == 48);

    // The same polygon in another colour is not the same picture.
    Picture shaded = first;
    shaded.use_ink();
    shaded.ink[shaded.at(2, 2)] = ink_of({1, 2, 3});
    const Agreement b = agreement(scene, {}, first, shaded);
    CHECK(b.equal == 47);
    CHECK(b.colors == 1);
    CHECK(b.unexplained == 0);
    Compared compared;
    compared.comparable = true, compared.agreement = b;
    CHECK(!compared.wrong());  // the one shades, and the other does not
    compared.same_shading = true;
    CHECK(compared.wrong());
  }

  TEST_CASE("CSV: a line a number, quoted where it must be") {
    Compared compared;
    compared.id = "z-buffer";
    compared.measured.method = &method("z-buffer");
    compared.measured.seconds = {0.5, 0.25, 0.75};
    compared.measured.heap = 4096;
    compared.measured.count[64] = 1;
    compared.agreement = {100, 97, 2, 1, 0};
    compared.comparable = true;
    Compared late;
    late.id = "z-buffer";
    late.measured.method = &method("z-buffer");
    late.measured.end = Apart::End::out_of_time;
    const std::string text = csv_of("a, \"b\"", {compared, late});
    CHECK(text.starts_with("scene,method,measure,step,value\n\"a, \"\"b\"\"\",z-buffer,pixels,,100\n"));
    for (const std::string line : {"equal,,97", "differing,,3", "at_edges,,2", "ties,,1", "unexplained,,0", "colors,,0",
                                   "runs,,3", "time_s,,0.5", "heap_bytes,,4096", "steps,,1", "count,z_buffer.clear,1",
                                   "count,z_buffer.compare,0", "end,,out_of_time"}) {
      CAPTURE(line);
      CHECK(text.find(",z-buffer," + line + "\n") != std::string::npos);
    }
  }

  TEST_CASE("random scenes cover the picture alike, however many triangles there are") {
    for (const int count : {100, 2500, 60000}) {
      const Scene scene = random_scene(count, 2, 64, 1);
      REQUIRE(scene.polygons.size() == static_cast<std::size_t>(count));
      double area = 0;
      for (std::size_t i = 0; i < scene.points.size(); i += 3) {
        const glm::dvec2 a(scene.points[i]), b(scene.points[i + 1]), c(scene.points[i + 2]);
        area += std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
      }
      CAPTURE(count);
      CHECK(area / 4 == doctest::Approx(2).epsilon(count == 100 ? 0.2 : 0.04));
      NullRecorder nothing;
      Conventions conventions;
      conventions.cull = false;
      const Picture picture = method("z-buffer").render(scene, conventions, nothing);
      int covered = 0;
      for (const std::int32_t polygon : picture.polygon) covered += polygon != no_polygon;
      // 1 - exp(-2) of an endless picture; those that reach over its sides leave a little more open.
      CHECK(covered / 4096.0 == doctest::Approx(0.85).epsilon(0.08));
    }
    CHECK(random_scene(100, 2, 64, 1) == random_scene(100, 2, 64, 1));
    CHECK_FALSE(random_scene(100, 2, 64, 1) == random_scene(100, 2, 64, 2));
  }

  TEST_CASE("the book's middle column fits 2,500 polygons, not the 250 that are printed") {
    CHECK(growth_exponent(100, 3, 400, 6) == doctest::Approx(0.5));
    for (const BookRow& row : book_table) {
      if (row.method != "scan-line" && row.method != "warnock") continue;
      const auto bend = [&](int middle) {
        return growth_exponent(100, row.costs[0], middle, row.costs[1]) -
               growth_exponent(middle, row.costs[1], 60000, row.costs[2]);
      };
      CAPTURE(row.method);
      CHECK(std::abs(bend(table_sizes[1])) < 0.1);
      CHECK(std::abs(bend(printed_middle_size)) > 1);
    }
  }
}
