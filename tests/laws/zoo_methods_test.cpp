// Law: Z-buffers that compute right get all points for the steps that they print, however they are built. Those of the
// other methods stand in the zoo's table.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"

using namespace zstep;
using test::on_the_raster, test::ZooProgram;

namespace {

void is_right(const ZooProgram& program, const std::vector<Scene>& scenes) {
  CHECK(scenes.size() >= 5);
  for (const Scene& scene : scenes) {
    CAPTURE(scene.name);
    const test::Found found = test::found_in(program, scene, "");
    CHECK_MESSAGE(!found.detected, found.said);
    CHECK(found.name.empty());
    CHECK(found.full_marks);
  }
}

}  // namespace

TEST_CASE("zoo: Z-buffers that are built otherwise get all points") {
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), on_the_raster(11, 10, 26),
                                  on_the_raster(5, 4, 16), on_the_raster(8, 5, 20)};
  const auto is_right_in = [&](NumberFormat format, const char* style) {
    CAPTURE(style);
    is_right({"z-buffer", zoo::variants, style, {}, false, true, format}, scenes);
  };
  for (const char* style : {"rows crossings span", "rows crossings plane", "rows edge_functions weights",
                            "upwards crossings weights", "upwards edge_functions plane", "columns crossings plane",
                            "columns edge_functions span", "quarters edge_functions plane",
                            "quarters crossings weights", "pixels crossings span", "pixels edge_functions weights"})
    is_right_in(NumberFormat::float64, style);
  for (const char* style : {"float32 rows crossings span", "float32 upwards edge_functions plane",
                            "float32 quarters edge_functions weights", "float32 pixels crossings plane"})
    is_right_in(NumberFormat::float32, style);
}

TEST_CASE("zoo: Z-buffers in fixed point get all points") {
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), on_the_raster(11, 10, 26),
                                  on_the_raster(5, 4, 16), on_the_raster(20, 8, 34)};
  using enum NumberFormat;
  for (const auto& [format, bits] : {std::pair(fixed16, "16"), {fixed20, "20"}, {fixed24, "24"}})
    for (const bool adds : {false, true})
      for (const bool down : {false, true}) {
        const std::string style = std::string(bits) + (adds ? " adds" : "") + (down ? " down" : "");
        CAPTURE(style);
        using Interpolation = Conventions::Interpolation;
        is_right({"z-buffer",
                  zoo::fixed_point,
                  style.c_str(),
                  {},
                  false,
                  true,
                  format,
                  adds ? Interpolation::increments : Interpolation::direct,
                  down ? Conventions::Rounding::down : Conventions::Rounding::nearest},
                 scenes);
      }
}

TEST_CASE("zoo: Z-buffers in Python get all points") {
  if (!test::there_is_python()) return;
  std::vector<Scene> scenes{on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), on_the_raster(11, 10, 26),
                            on_the_raster(5, 4, 16), on_the_raster(8, 5, 20)};
  is_right({"z-buffer", [](const zoo::Task& task) { return test::printed_by_file("by_pixel.py", task); }, "", {}},
           scenes);
  scenes.push_back(test::scene_of(test::concave()));
  is_right({"z-buffer", [](const zoo::Task& task) { return test::printed_by_file("generators.py", task); }, "", {}},
           scenes);
  is_right({"z-buffer",
            [](const zoo::Task& task) { return test::printed_by_file("in_float32.py", task); },
            "",
            {},
            false,
            true,
            NumberFormat::float32},
           scenes);
}
