// Surfaces y = f(x, z): formulas, samples, the [surface] of a scene file, the formula on the command line.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "algorithms/scene/surface/surface_scene.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

double value(const std::string& text, double x, double z) { return Formula(text, "here").at(x, z); }

std::string error_of_formula(const std::string& text) {
  return input_error([&] { Formula(text, "s.toml:3"); });
}

SceneFile read(const std::string& text) {
  return read_scene(text, "s.toml", "s",
                    [](const std::string& path) -> PolygonSoup { throw InputError(path, "there are no files", ""); });
}
std::string error_of(const std::string& text) {
  return input_error([&] { read(text); });
}

}  // namespace

TEST_SUITE("surfaces") {
  TEST_CASE("a formula is evaluated as it is written") {
    CHECK(value("2*x + z", 3, 4) == 10);
    CHECK(value("y = 2*x + z", 3, 4) == 10);
    CHECK(value(" y=x ", 3, 4) == 3);
    CHECK(value("-x^2", 3, 0) == -9);
    CHECK(value("2^3^2", 0, 0) == 512);
    CHECK(value("8/4/2 - 1 - 1", 0, 0) == -1);
    CHECK(value("x^-2", 2, 0) == 0.25);
    CHECK(value("1.5e-3 * .5", 0, 0) == 1.5e-3 * .5);
    CHECK(value("sin(x) * cos(z)", 0.3, 0.7) == portable::sin(0.3) * portable::cos(0.7));
    CHECK(value("min(x, z) + max(x, z) - atan2(x, z)", 1, 2) == 3 - portable::atan2(1, 2));
    CHECK(value("sign(-3) + abs(-2) + floor(1.5) + ceil(1.5)", 0, 0) == 4);
    CHECK(value("ln(e) + log10(1000) + sqrt(16)", 0, 0) == doctest::Approx(8));
    CHECK(value("cos(pi)", 0, 0) == -1);
    CHECK(value("x^0.3 - -z^1.5/2*-x", 1.7, 2.9) == portable::pow(1.7, 0.3) - -portable::pow(2.9, 1.5) / 2 * -1.7);
    CHECK(value("-2^2 + (-2)^2 + 2^-x", 1, 0) == 0.5);
    CHECK(value("6 - -x - - 1 / + 2", 1, 0) == 7.5);
    CHECK(std::signbit(value("0 * x", -1, 0)) == false);
    CHECK(Formula("  y  =  x+ 1 ", "here").text() == "x+ 1");
  }

  TEST_CASE("a formula that cannot be read: where it stands, which character, what may be written") {
    const auto says = [](const std::string& formula, const std::string& part) {
      const std::string message = error_of_formula(formula);
      CAPTURE(message);
      CHECK(message.substr(0, 10) == "s.toml:3: ");
      CHECK(contains(message, part));
      CHECK(!contains(message, "\n"));
    };
    says("sin(x", "in the formula 'sin(x': at character 7: a closing parenthesis is missing; it may have x, z");
    says("x + q", "in the formula 'x + q': at character 5: 'q' is not known");
    says("Sin(x)", "at character 1: 'Sin' is not known");
    says("2x", "at character 2: an operator is missing before 'x'");
    says("x +", "the formula ends too early");
    says("x)", "at character 2: the parenthesis ')' stands in a wrong place");
    says("x */ z", "at character 4: '/' stands in a wrong place");
    says("^x", "at character 1: '^' stands in a wrong place");
    says("sin(x, z)", "'sin' is given too many numbers");
    says("max(x)", "'max' is given too few numbers");
    says("x, z", "it gives more than one number");
    says("", "the formula is empty");
    says("y =", "the formula is empty");
    says("x = 3", "character 3, '=', has no meaning");
    says("x > 0 ? 1 : 0", "character 3, '>', has no meaning");
    says("\"x\"", "character 1, '\"', has no meaning");
    says("x\nz", "character 2, '?', has no meaning");
    says("y", "'y' is not known");
    says("_pi", "'_pi' is not known");
    says("rnd", "is not known");
    says("1e999", "is not known");
    says(std::string(201, '1'), "it has 201 characters; write at most 200");
    says(std::string(100, '(') + std::string(100, ')'), "stands in a wrong place");
    CHECK(value(std::string(99, '(') + "xx"[0] + std::string(99, ')'), 5, 0) == 5);
  }

  TEST_CASE("a formula without a value names the place") {
    const auto says = [](const std::string& formula, double x, double z, const std::string& part) {
      const std::string message = input_error([&] { value(formula, x, z); });
      CAPTURE(message);
      CHECK(contains(message, part));
    };
    says("1/x", 0, 2, "here: the formula '1/x' gives inf at x = 0, z = 2; choose ranges");
    says("sqrt(x)", -1, 0.5, "gives no number at x = -1, z = 0.5");
    says("ln(z)", 0, 0, "gives -inf at x = 0, z = 0");
    says("10^40", 1, 1, "gives 1e+40 at x = 1, z = 1");
  }

  TEST_CASE("samples are rows of constant z, heights go upwards, cells face upwards") {
    const SceneFile file = read("[surface]\nformula = \"10*x + z\"\nx = [0, 2]\nz = [1, 2]\ncolumns = 3\nrows = 2\n");
    const Scene& scene = file.scene;
    CHECK(scene.surface == Surface{"10*x + z", 0, 2, 1, 2, 3, 2});
    REQUIRE(scene.points.size() == 6);
    CHECK(scene.points[0] == glm::dvec3(0, 1, 1));
    CHECK(scene.points[1] == glm::dvec3(1, 1, 11));
    CHECK(scene.points[2] == glm::dvec3(2, 1, 21));
    CHECK(scene.points[5] == glm::dvec3(2, 2, 22));
    REQUIRE(scene.polygons.size() == 2);
    CHECK(scene.polygons[0].name == "A");
    CHECK(scene.polygons[0].source_line == 1);
    REQUIRE(scene.facets.size() == 2);  // in a plane, so not cut
    CHECK(scene.corners == std::vector<std::int32_t>{0, 1, 4, 3, 1, 2, 5, 4});
    CHECK_FALSE(file.conventions.cull);
    CHECK(file.notes.empty());
  }

  TEST_CASE("the last column and row stand at the ends of their ranges to the bit") {
    const Scene scene =
        read("[surface]\nformula = \"x\"\nx = [-0.1, 0.7]\nz = [0.1, 0.3]\ncolumns = 8\nrows = 7\n").scene;
    CHECK(scene.points[7].x == 0.7);
    CHECK(scene.points.back() == glm::dvec3(0.7, 0.3, 0.7));
  }

  TEST_CASE("cells that are not planar are cut, without a note") {
    const SceneFile file = read("[surface]\nformula = \"x*z\"\ncolumns = 4\nrows = 3\n");
    CHECK(file.scene.polygons.size() == 6);
    CHECK(file.scene.facets.size() == 12);
    CHECK(file.notes.empty());
  }

  TEST_CASE("one row, one column, one sample: points, and no polygon") {
    for (const char* grid : {"columns = 1\nrows = 5\n", "columns = 5\nrows = 1\n", "columns = 1\nrows = 1\n"}) {
      const Scene scene = look_at_scene(read(std::string("[surface]\nformula = \"x\"\n") + grid).scene, {});
      CHECK(scene.polygons.empty());
      CHECK(scene.points.size() == static_cast<std::size_t>(scene.surface->columns * scene.surface->rows));
      CHECK(scene.points[0] == glm::dvec3(-3, -3, -3));
      CHECK(scene.camera.near < scene.camera.far);
    }
  }

  TEST_CASE("colour, material and conventions of a surface") {
    const SceneFile file = read(
        "[options]\ncull = true\n[surface]\nformula = \"0\"\ncolor = \"orange\"\nopacity = 0.5\nrows = 2\ncolumns = "
        "2\n");
    CHECK(file.conventions.cull);
    CHECK(file.scene.polygons[0].color == shaded(palette[0], {0, 0, 1}));
    CHECK(file.scene.polygons[0].material == Material{0.5, 0, 1});
  }

  TEST_CASE("a wrong [surface] is said with its line") {
    const std::string surface = "[surface]\nformula = \"x\"\n";
    CHECK(contains(error_of("[surface]\n"), "s.toml:1: the surface has no formula"));
    CHECK(contains(error_of(surface + "x = [3, -3]\n"), "s.toml:3: x goes from 3 to -3"));
    CHECK(contains(error_of(surface + "x = [3, 3]\n"), "s.toml:3: x goes from 3 to 3"));
    CHECK(contains(error_of(surface + "z = [3]\n"), "s.toml:3: z is no range"));
    CHECK(contains(error_of(surface + "rows = 0\n"), "s.toml:3: rows is not a whole number from 1 to 250000"));
    CHECK(contains(error_of(surface + "rows = 501\ncolumns = 500\n"), "s.toml:1: the surface has more than 250000"));
    CHECK(contains(error_of(surface + "colums = 3\n"), "did you mean 'columns'?"));
    CHECK(contains(error_of("\n[surface]\n\nformula = \"1/x\"\nx = [-1, 1]\ncolumns = 3\n"),
                   "s.toml:4: the formula '1/x' gives inf at x = 0, z = -3"));
    CHECK(contains(error_of("coordinates = \"screen\"\n" + surface), "a surface cannot stand in a scene in screen"));
    CHECK(contains(error_of(surface + "[[mesh]]\nbuiltin = \"cube\"\n"), "a surface is a scene by itself"));
    CHECK(contains(error_of("points = [[0, 0, 0]]\n" + surface), "a surface is a scene by itself"));
  }

  TEST_CASE("a formula is a scene's name") {
    const SceneFile file = load_scene("y = sin(x)*cos(z)");
    CHECK(file.scene.name == "y = sin(x)*cos(z)");
    CHECK(file.scene.surface == Surface{"sin(x)*cos(z)", -3, 3, -3, 3, 40, 30});
    CHECK(file.scene.polygons.size() == 39 * 29);
    CHECK_FALSE(file.conventions.cull);
    CHECK(load_scene("y=x").scene.surface->formula == "x");
    CHECK(names_formula("y ="));
    CHECK_FALSE(names_formula("yard.obj"));
    CHECK_FALSE(names_formula("y"));
    CHECK(contains(input_error([] { load_scene("y = sin("); }), "'y = sin(': in the formula 'sin(': "));
    CHECK(contains(input_error([] { load_scene("y ="); }), "the formula is empty"));
    CHECK(contains(input_error([] { load_scene("y = ln(x)"); }), "gives no number at x = -3, z = -3"));
  }
}
