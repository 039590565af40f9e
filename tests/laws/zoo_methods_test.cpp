// Law: programs of any method that compute right get all points for the steps that they print; of wrong ones the first
// wrong step is named.
#include <doctest/doctest.h>

#include <set>

#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"
#include "traces/grade/grade.hpp"

using namespace zstep;
using grade::Level, grade::Part;
using test::on_the_raster, test::WrongPrograms, test::ZooProgram;

namespace {

struct Judged {
  grade::Judgement found;
  std::vector<Part> parts;
  Trace run, reference;
};
/// By the buffers, and by each kind of step that is printed.
Judged judged(const ZooProgram& program, const Scene& scene, const std::string& text, std::string* impossible) {
  const Conventions conventions = test::conventions_of(program);
  Trace run = test::trace_of(test::head_of(program, scene) + text, impossible);
  Trace reference = test::recorded_by(program.method, scene, conventions);
  std::set<std::uint8_t> kinds;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    kinds.insert(static_cast<std::uint8_t>(recorded.event.index()));
    return true;
  });
  std::vector<Part> parts;
  if (program.paints) parts.push_back({"buffers", Level::buffers, {}, 0, 1});
  for (const std::uint8_t kind : kinds) parts.push_back({test::name_of(kind), Level::matched, {kind}, 1, 1});
  grade::Judgement found = grade::judge(reference, run, parts);
  return {std::move(found), std::move(parts), std::move(run), std::move(reference)};
}

void is_right(const ZooProgram& program, const std::vector<Scene>& scenes) {
  CHECK(scenes.size() >= 5);
  for (const Scene& scene : scenes) {
    CAPTURE(scene.name);
    const Judged result = judged(program, scene, test::printed_by(program, scene, ""), nullptr);
    if (result.found.first) FAIL_CHECK(test::said_of(*result.found.first));
    for (std::size_t k = 0; k < result.parts.size(); ++k) {
      CAPTURE(result.parts[k].name);
      const grade::PartCount& count = result.found.parts[k];
      CHECK(count.expected > 0);
      CHECK(count.same == count.all());
      if (result.parts[k].level != Level::buffers) CHECK(count.computed == count.all());
    }
  }
}

void is_wrong(const WrongPrograms& wrong, const char* mistake, bool has_name) {
  int seen = 0, at_once = 0, called = 0;
  std::string missed, names;
  for (const Scene& scene : wrong.scenes) {
    const test::Found found = test::found_in(wrong.program, scene, mistake);
    if (!found.shows) continue;
    CHECK(found.detected);
    const bool right_name = found.name == (has_name ? mistake : "");
    ++seen, at_once += found.at_once, called += right_name;
    if (!found.at_once) missed += fmt::format("\n    {}: {}", scene.name, found.said);
    if (!right_name) names += fmt::format("\n    {}: {}", scene.name, found.name.empty() ? "no name" : found.name);
  }
  MESSAGE(fmt::format("{}, {}: first wrong step named in {} of {}{}; called rightly in {}{}", wrong.what, mistake,
                      at_once, seen, missed, called, names));
  CAPTURE(mistake);
  if (wrong.at_once) CHECK(at_once >= 3);
  if (wrong.at_once) CHECK(at_once >= seen - 1);
  CHECK(called > 0);
  CHECK(called >= seen - 1);
}

/// Those that make no mistake get all points, and the mistakes of the others are named.
void are_judged_rightly(const std::string& method) {
  for (const WrongPrograms& wrong : test::wrong_programs(method)) {
    CAPTURE(std::string(wrong.what));
    is_right(wrong.program, wrong.scenes);
    for (const char* mistake : wrong.mistakes) is_wrong(wrong, mistake, true);
    for (const char* mistake : wrong.others) is_wrong(wrong, mistake, false);
  }
}

}  // namespace

TEST_CASE("zoo: ray casting") { are_judged_rightly("ray-casting"); }
TEST_CASE("zoo: scan line") { are_judged_rightly("scan-line"); }
TEST_CASE("zoo: viewing before the Z-buffer") { are_judged_rightly("z-buffer"); }
TEST_CASE("zoo: Warnock's areas") { are_judged_rightly("warnock"); }
TEST_CASE("zoo: floating horizon") { are_judged_rightly("floating-horizon"); }
TEST_CASE("zoo: depth sort") { are_judged_rightly("depth-sort"); }
TEST_CASE("zoo: BSP tree") { are_judged_rightly("bsp"); }

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
        is_right({"z-buffer", zoo::fixed_point, style.c_str(), {}, false, true, format,
                  adds ? Interpolation::increments : Interpolation::direct,
                  down ? Conventions::Rounding::down : Conventions::Rounding::nearest},
                 scenes);
      }
}

TEST_CASE("zoo: Z-buffers in Python get all points") {
  if (!test::there_is_python()) return;
  std::vector<Scene> scenes{on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), on_the_raster(11, 10, 26),
                            on_the_raster(5, 4, 16), on_the_raster(8, 5, 20)};
  is_right({"z-buffer", [](const zoo::Task& task) { return test::python("by_pixel.py", task); }, "", {}}, scenes);
  scenes.push_back(test::scene_of(test::concave()));
  is_right({"z-buffer", [](const zoo::Task& task) { return test::python("generators.py", task); }, "", {}}, scenes);
  is_right({"z-buffer", [](const zoo::Task& task) { return test::python("in_float32.py", task); }, "", {}, false, true,
            NumberFormat::float32},
           scenes);
}
