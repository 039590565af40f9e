// Law: z extents that meet but for rounding are apart or not, as a program's digits have it; what follows in depth sort
// is right either way. And a plane through the origin has a D that is 0 but for rounding.
#include <doctest/doctest.h>

#include <cmath>

#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"
#include "traces/grade/grade.hpp"

using namespace zstep;

namespace {

/// All points that a right program's steps lose, by kind of step.
std::string lost(const test::ZooProgram& program, const Scene& given, const Scene& scene) {
  const Conventions conventions = test::conventions_of(program);
  const Trace run = test::trace_of(test::head_of(program, scene) + test::printed_by(program, given, ""));
  const Trace reference = test::recorded_by(program.method, scene, conventions);
  std::vector<grade::Part> parts;
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (run.has(static_cast<std::uint8_t>(kind)))
      parts.push_back({test::name_of(static_cast<std::uint8_t>(kind)),
                       grade::Level::matched,
                       {static_cast<std::uint8_t>(kind)},
                       1,
                       1});
  const grade::Judgement found = grade::judge(reference, run, parts);
  std::string text;
  if (found.first) text += test::said_of(*found.first);
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (found.parts[k].same != found.parts[k].all() || found.parts[k].computed != found.parts[k].all())
      text += fmt::format(" {} {} of {}", parts[k].name, found.parts[k].same, found.parts[k].all());
  return text;
}

}  // namespace

TEST_CASE("near extents: depth sort may go on, or not, where z extents meet but for rounding") {
  const test::ZooProgram program{"depth-sort", zoo::depth_sort};
  int other = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    zoo::Task task = test::triangles(seed, 5, 18);
    for (std::size_t i = 0; i < task.points.size(); ++i)  // each extent begins where the last but one ends
      task.points[i].z = 0.15 + 0.1 * static_cast<double>(i / 3 + i % 3);
    const Scene scene = test::scene_of(task);
    for (const double off : {-1.0, 1.0}) {
      Scene given = scene;  // as a program's own rounding leaves it
      for (std::size_t i = 0; i < given.points.size(); ++i)
        given.points[i].z *= 1 + off * (i / 3 % 2 == 0 ? 1e-15 : -1e-15);
      CAPTURE(seed);
      CAPTURE(off);
      const std::string text = lost(program, given, scene);
      CHECK_MESSAGE(text.empty(), text);
      other += test::printed_by(program, given, "").size() != test::printed_by(program, scene, "").size();
    }
  }
  MESSAGE(other, " runs make other tests");
  CHECK(other > 3);
}

TEST_CASE("near extents: right depth-sort programs lose nothing on many scenes") {
  const test::ZooProgram program{"depth-sort", zoo::depth_sort};
  int whole = 0;
  std::string table;
  constexpr std::uint64_t seeds = 24;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Scene scene = test::on_the_raster(seed, 3 + static_cast<int>(seed % 6), 20);
    const std::string text = lost(program, scene, scene);
    whole += text.empty();
    if (!text.empty()) table += fmt::format("\n{}: {}", seed, text);
  }
  MESSAGE(whole, " of ", seeds, " runs get all points", table);
  // Where pieces are cut again and again, a cut may lie on the other side of a pixel's centre, or of another cut's z,
  // by its rounding alone.
  CHECK(whole >= 19);
}

TEST_CASE("near extents: planes through the origin lose nothing") {
  for (const char* method : {"scan-line", "depth-sort"})
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      zoo::Task task = test::triangles(seed, 4, 18);
      for (std::size_t i = 0; i < task.points.size(); ++i) {  // z = a x + b y, on which 0 lies
        const double a = 0.013 * static_cast<double>(1 + i / 3), b = 0.007 * static_cast<double>(3 - i / 3 % 2);
        task.points[i].z = a * task.points[i].x + b * task.points[i].y;
      }
      CAPTURE(std::string(method));
      CAPTURE(seed);
      const Scene scene = test::scene_of(task);
      const test::ZooProgram program{method,
                                     std::string(method) == "scan-line" ? zoo::scan_line_flags : zoo::depth_sort};
      const std::string text = lost(program, scene, scene);
      CHECK_MESSAGE(text.empty(), text);
    }
}
