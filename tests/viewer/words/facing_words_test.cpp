// The back-face test: three vertices are called three vertices, and the sum over the fan has a name of its own.
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "sim/words/explain.hpp"
#include "tests/folder.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/words/printed.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

const std::string triple = "V_0\u00b7(V_1 \u00d7 V_2)", fan = "sum over the fan = ";

/// What is said of the first facing test of this polygon.
std::vector<std::string> facing_formulas(const Trace& trace, const std::string& polygon) {
  Replay replay(trace);
  while (replay.position() < trace.size()) {
    replay.step_forward();
    if (!holds<FacingTest>(replay.current()->event)) continue;
    if (polygon_label(trace.scene(), replay.state().machine.polygon) != polygon) continue;
    const Explanation told = explain(trace, replay.state(), *replay.current());
    CHECK(!told.doubt);
    return told.formulas;
  }
  return {};
}

/// The line that begins so, without its verdict; "" where there is none.
std::string line_of(const std::vector<std::string>& lines, const std::string& begin) {
  for (const std::string& line : lines)
    if (line.starts_with(begin)) return line.substr(0, line.find("   "));
  return "";
}

}  // namespace

TEST_CASE("back-face test: of four corners three vertices say 250880, and the sum over the fan 501760") {
  const Trace trace = test::record_run(test::in_checkout("lessons/scenes/wall.toml"));
  const auto quad = facing_formulas(trace, "W"), triangle = facing_formulas(trace, "A");
  CHECK(line_of(quad, triple) == triple + " = 250880");
  CHECK(line_of(quad, fan) == fan + triple + " + V_0\u00b7(V_2 \u00d7 V_3) = 250880 + 250880 = 501760");
  CHECK(
      line_of(quad, "n = ") ==
      "n = (p_1 \u2212 p_0) \u00d7 (p_2 \u2212 p_0) + (p_2 \u2212 p_0) \u00d7 (p_3 \u2212 p_0), the sum over the fan");
  CHECK(line_of(triangle, triple) == triple + " = 44580");
  CHECK(line_of(triangle, fan).empty());
  CHECK(line_of(triangle, "n = ") == "n = (p_1 \u2212 p_0) \u00d7 (p_2 \u2212 p_0)");
}

TEST_CASE("back-face test: of a concave polygon three vertices say the opposite of the sum") {
  const test::Folder folder;
  const std::string file = folder.write("concave.toml",
                                        "points = [[0, -1, -1], [0, 0, -0.5], [0, 1, -1], [0, 0, 1]]\n"
                                        "[raster]\nwidth = 9\nheight = 9\n[camera]\nrho = 8\ntheta = 0\nphi = 90\n"
                                        "[[polygon]]\nname = \"K\"\ncorners = [0, 1, 2, 3]\n");
  const Trace trace = test::record_run(file);
  const auto lines = facing_formulas(trace, "K");
  CHECK(line_of(lines, triple) == triple + " = \u22128");
  CHECK(line_of(lines, fan) == fan + triple + " + V_0\u00b7(V_2 \u00d7 V_3) = \u22128 + 32 = 24");
}

TEST_CASE("law: what is called the triple product of three vertices is that of these three, in every golden trace") {
  int triangles = 0, others = 0, parallel = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const auto* test = get_if<FacingTest>(&replay.current()->event);
      if (!test) continue;
      const auto step = replay.position();
      CAPTURE(step);
      const Scene& scene = trace.scene();
      const Facet& facet = scene.facets[static_cast<std::size_t>(replay.state().machine.facet)];
      const auto view = [&](int i) {
        return replay.state()
            .vertices[static_cast<std::size_t>(scene.corners[static_cast<std::size_t>(facet.first_corner + i)])]
            .view;
      };
      const auto lines = explain(trace, replay.state(), *replay.current()).formulas;
      const std::string three = line_of(lines, triple), sum = line_of(lines, fan);
      if (scene.camera.kind == Camera::Kind::orthographic) {
        CHECK(three.empty());
        ++parallel;
        continue;
      }
      REQUIRE_FALSE(three.empty());
      const std::string number = test::parts(three, " = ").back();
      const auto said = test::number_of(number);
      REQUIRE(said);
      CHECK(*said == doctest::Approx(glm::dot(view(0), glm::cross(view(1), view(2)))).epsilon(1e-3));
      CHECK(sum.empty() == (facet.corner_count == 3));
      if (!sum.empty()) CHECK(shown_as(test->determinant, test::parts(sum, " = ").back()));
      ++(facet.corner_count == 3 ? triangles : others);
    }
  });
  CHECK(triangles > 0);
  CHECK(others > 0);
  CHECK(parallel > 0);
}

TEST_CASE("a projection divides by the view depth, which is no distance from the eye") {
  const Trace trace = test::record_run("pyramid");
  Replay replay(trace);
  while (replay.position() < trace.size()) {
    replay.step_forward();
    if (!holds<Projection>(replay.current()->event)) continue;
    const std::string sentence = explain(trace, replay.state(), *replay.current()).sentence;
    CHECK(sentence.find("view depth z_v") != std::string::npos);
    CHECK(sentence.find("distance") == std::string::npos);
    break;
  }
}
