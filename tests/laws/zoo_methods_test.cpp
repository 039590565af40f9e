// Law: programs of any method that compute right get all points for the steps that they print; of wrong ones the first
// wrong step is named.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/grade/grade.hpp"

using namespace zstep;
using grade::Level, grade::Part;

namespace {

struct Program {
  const char* method;
  std::string (*run)(const zoo::Task&);
  const char* style;
  std::vector<std::pair<std::string, std::string>> options;  ///< of the method, by which the reference does the same
  bool cull = false;
  bool paints = true;  ///< and so is graded by its picture, too
  NumberFormat number_format = NumberFormat::float64;
  Conventions::Interpolation interpolation = Conventions::Interpolation::direct;
  Conventions::Rounding rounding = Conventions::Rounding::nearest;
};

Conventions conventions_of(const Program& program) {
  Conventions conventions;
  conventions.cull = program.cull, conventions.number_format = program.number_format;
  conventions.interpolation = program.interpolation, conventions.rounding = program.rounding;
  for (const auto& [name, value] : program.options) conventions.options[name] = value;
  return conventions;
}

std::string name_of(std::uint8_t kind) {
  std::string_view name;
  for_each_kind([&]<class E>() {
    if (kind_of<E> == kind) name = kind_text<E>.name;
  });
  return std::string(name);
}

struct Judged {
  grade::Judgement found;
  std::vector<Part> parts;
  Trace run, reference;
};
/// By the buffers, and by each kind of step that is printed.
Judged judged(const Program& program, const Scene& scene, const std::string& text, std::string* impossible) {
  const Conventions conventions = conventions_of(program);
  Trace run = test::trace_of(test::head(program.method, scene, conventions) + text, impossible);
  Trace reference = test::recorded_by(program.method, scene, conventions);
  std::set<std::uint8_t> kinds;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    kinds.insert(static_cast<std::uint8_t>(recorded.event.index()));
    return true;
  });
  std::vector<Part> parts;
  if (program.paints) parts.push_back({"buffers", Level::buffers, {}, 0, 1});
  for (const std::uint8_t kind : kinds) parts.push_back({name_of(kind), Level::matched, {kind}, 1, 1});
  grade::Judgement found = grade::judge(reference, run, parts);
  return {std::move(found), std::move(parts), std::move(run), std::move(reference)};
}

std::string said_of(const grade::Divergence& first) {
  std::string text = fmt::format("step {}", first.step);
  if (first.fault)
    text += fmt::format(", check: {} {} {} {}", name_of(first.fault->kind), first.fault->field, first.fault->impossible,
                        first.fault->rule ? rule_text(*first.fault->rule).name : "");
  if (first.parts)
    text += fmt::format(", diff: {} a {} b {} fields {:b}", name_of(first.parts->kind), first.parts->a, first.parts->b,
                        first.parts->fields);
  return text;
}

void is_right(const Program& program, const std::vector<Scene>& scenes) {
  CHECK(scenes.size() >= 5);
  for (const Scene& scene : scenes) {
    CAPTURE(scene.name);
    zoo::Task task = test::task_of(scene);
    task.style = program.style;
    const Judged result = judged(program, scene, program.run(task), nullptr);
    if (result.found.first) FAIL_CHECK(said_of(*result.found.first));
    for (std::size_t k = 0; k < result.parts.size(); ++k) {
      CAPTURE(result.parts[k].name);
      const grade::PartCount& count = result.found.parts[k];
      CHECK(count.expected > 0);
      CHECK(count.same == count.all());
      if (result.parts[k].level != Level::buffers) CHECK(count.computed == count.all());
    }
  }
}

/// `has_name`: the catalogue knows the mistake by what such a program prints; else the name is no more than shown.
void is_wrong(const Program& program, const std::vector<Scene>& scenes, const std::vector<const char*>& mistakes,
              bool has_name = true, bool at_once = true) {
  for (const char* mistake : mistakes) {
    int seen = 0, named = 0, called = 0;
    std::string missed, names;
    for (const Scene& scene : scenes) {
      zoo::Task task = test::task_of(scene);
      task.style = program.style;
      const std::string right = program.run(task);
      task.mistake = mistake;
      const std::string wrong = program.run(task);
      const std::int64_t step = test::first_difference(right, wrong);
      if (step == 0) continue;
      ++seen;
      std::string impossible;
      const Judged result = judged(program, scene, wrong, &impossible);
      const std::int64_t shows = test::shown_at(result.run, step);
      bool found = result.found.first && step <= result.found.first->step && result.found.first->step <= shows;
      // A mistake of the catalogue gets its name, and another one none.
      const auto mistake_found = grade::mistake_in(result.run, result.found);
      const bool right_name = mistake_found == mistakes::mistake_called(mistake);
      called += right_name;
      if (!right_name)
        names +=
            fmt::format("\n    {}: {}", scene.name, mistake_found ? mistakes::text_of(*mistake_found).id : "no name");
      const Trace without = test::trace_of(test::head(program.method, scene, conventions_of(program)) + right);
      for (const diff::Cause& cause : result.found.difference.causes) {
        if (cause.part != diff::Part::different) continue;
        found = found || test::is_at(cause, result.reference, result.found.difference.alignment, without, step, shows);
        break;
      }
      named += found;
      if (!found)
        missed += fmt::format("\n    {}: from step {}, shown at {}; found: {}", scene.name, step, shows,
                              result.found.first ? said_of(*result.found.first) : "nothing");
    }
    MESSAGE(fmt::format("{}, {}: first wrong step named in {} of {}{}; called rightly in {}{}", program.method, mistake,
                        named, seen, missed, called, names));
    CAPTURE(mistake);
    if (at_once) CHECK(named >= 3);
    if (at_once) CHECK(named >= seen - 1);
    if (has_name) CHECK(called >= seen - 1);
  }
}

Scene on_the_raster(std::uint64_t seed, int count, int size) {
  Scene scene = test::scene_of(test::triangles(seed, count, size));
  scene.name = fmt::format("{} triangles", count);
  return scene;
}
/// A scene of zstep's as it is seen from elsewhere.
Scene seen(const std::string& name, std::optional<double> theta, std::optional<double> phi, int width, int height,
           double rho = 0) {
  ViewOptions view;
  view.theta = theta, view.phi = phi, view.width = width, view.height = height;
  if (rho > 0) view.rho = rho;
  if (rho > 0) view.near = 0.25, view.far = 12;
  const bool file = name.ends_with(".toml");
  return look_at_scene(load_scene(file ? test::in_checkout("lessons/scenes/" + name) : name).scene, view);
}

/// A surface in perspective.
Scene surface(const std::string& name, double theta) {
  ViewOptions view;
  view.theta = theta, view.width = 18, view.height = 12, view.orthographic = false, view.d = 4, view.window = 1;
  const bool file = name.ends_with(".toml");
  return look_at_scene(load_scene(file ? test::in_checkout(name) : name).scene, view);
}

}  // namespace

TEST_CASE("zoo: ray casting") {
  std::vector<Scene> scenes{on_the_raster(3, 3, 12), on_the_raster(6, 6, 14), on_the_raster(11, 10, 16)};
  const Program plain{"ray-casting", zoo::rays, "", {{"boxes", "none"}}};
  const Program boxes{"ray-casting", zoo::rays, "boxes", {{"boxes", "facet"}}};
  is_wrong(boxes, scenes, {"box_misses_at_0"});
  for (const double theta : {2.0, 5.0, 11.0}) scenes.push_back(seen("rays.toml", theta, 87, 9, 6));
  scenes.push_back(seen("cyclic", 20, 60, 9, 8));
  scenes.push_back(seen("cyclic", 25, 70, 9, 8, 1.1));  // from amidst the polygons
  scenes.push_back(seen("pyramid-behind", 33, 62, 9, 8));
  is_right(plain, scenes);
  is_right(boxes, scenes);
  is_wrong(plain, scenes, {"nearest_by_index", "negative_t", "inside_test_half"});
}

TEST_CASE("zoo: scan line") {
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18),
                                  on_the_raster(6, 6, 22),
                                  on_the_raster(11, 10, 26),
                                  seen("abc-def.toml", {}, {}, 22, 27),
                                  seen("five-tests.toml", {}, {}, 32, 20),
                                  on_the_raster(5, 4, 16)};
  const Program program{"scan-line", zoo::scan_line_flags, "", {}};
  is_right(program, scenes);
  is_wrong(program, scenes, {"flag_missed", "wrong_of_two", "slope_inverted", "not_sorted"});
}

TEST_CASE("zoo: viewing before the Z-buffer") {
  std::vector<Scene> scenes{seen("cyclic", 25, 70, 12, 10, 1.5), seen("pyramid-behind", 33, 62, 12, 10, 1.2),
                            seen("rays.toml", 40, 80, 12, 8, 2), seen("cyclic", 60, 50, 12, 10, 1.3)};
  scenes.push_back(seen("pyramid", 33, 62, 14, 12));
  scenes.push_back(seen("intersecting", 20, 65, 14, 12));
  scenes.push_back(seen("dodecahedron", 20, 65, 16, 14));
  const Program program{"z-buffer", zoo::viewing, "", {}, true};
  is_right(program, scenes);
  is_wrong(program, scenes,
           {"no_divide", "divide_twice", "not_clipped_near", "clockwise_front", "z_v_for_depth", "y_upside_down"});
}

TEST_CASE("zoo: Warnock's areas") {
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18),
                                  on_the_raster(6, 6, 22),
                                  on_the_raster(11, 10, 26),
                                  on_the_raster(5, 4, 16),
                                  seen("five-tests.toml", {}, {}, 32, 20),
                                  seen("quarters.toml", {}, {}, 16, 16)};
  const Program program{"warnock", zoo::areas, "", {}};
  is_right(program, scenes);
  is_wrong(program, scenes, {"surrounding_unchecked", "stops_one_early", "quarters_overlap"});
}

TEST_CASE("zoo: floating horizon") {
  std::vector<Scene> scenes;
  for (const double theta : {-74.0, -60.0, -95.0}) scenes.push_back(surface("lessons/scenes/ridge-valley.toml", theta));
  for (const double theta : {-80.0, -65.0}) scenes.push_back(surface("y = sin(x) * cos(z)", theta));
  const Program program{"floating-horizon", zoo::horizon, "", {{"sides", "off"}}, false, false};
  is_right(program, scenes);
  is_wrong(program, scenes, {"only_upper", "not_interpolated"});
}

TEST_CASE("zoo: depth sort") {
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18),
                                  on_the_raster(6, 6, 22),
                                  on_the_raster(11, 10, 26),
                                  on_the_raster(5, 4, 16),
                                  seen("five-tests.toml", {}, {}, 32, 20),
                                  seen("five-tests-ring.toml", {}, {}, 32, 20)};
  const Program program{"depth-sort", zoo::depth_sort, "", {}};
  is_right(program, scenes);
  is_wrong(program, scenes, {"sorted_by_nearest"});
  is_wrong(program, scenes, {"tests_3_4_swapped", "pieces_lost"});
  std::vector<Scene> equal;  // many of the farthest depths are the same
  for (const std::uint64_t seed : {3u, 6u, 8u, 9u, 10u}) {
    zoo::Task task = test::triangles(seed, 6, 18);
    for (zoo::Point& p : task.points) p.z = std::ceil(4 * p.z) / 4;
    equal.push_back(test::scene_of(task));
    equal.back().name = fmt::format("equal depths {}", seed);
  }
  is_wrong(program, equal, {"ties_unstable"});
}

TEST_CASE("zoo: BSP tree") {
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), seen("cyclic", 20, 60, 9, 8),
                                  seen("intersecting", 20, 60, 9, 8), seen("cube", 25, 60, 9, 8)};
  const Program program{"bsp", zoo::bsp, "", {{"root", "first"}}};
  is_right(program, scenes);
  is_wrong(program, scenes, {"spanning_not_split", "side_by_normal"});
  // That the near side came too early shows when the far side comes, and not before.
  is_wrong(program, scenes, {"near_side_first"}, true, false);
}

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
