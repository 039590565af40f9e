#include "tests/zoo/wrong_programs.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/mistakes/name.hpp"

namespace zstep::test {

namespace {

/// A scene of zstep's as it is seen from elsewhere.
Scene seen(const std::string& name, std::optional<double> theta, std::optional<double> phi, int width, int height,
           double rho = 0) {
  ViewOptions view;
  view.theta = theta, view.phi = phi, view.width = width, view.height = height;
  if (rho > 0) view.rho = rho;
  if (rho > 0) view.near = 0.25, view.far = 12;
  const bool file = name.ends_with(".toml");
  return look_at_scene(load_scene(file ? in_checkout("lessons/scenes/" + name) : name).scene, view);
}

/// A surface in perspective.
Scene surface(const std::string& name, double theta) {
  ViewOptions view;
  view.theta = theta, view.width = 18, view.height = 12, view.orthographic = false, view.d = 4, view.window = 1;
  const bool file = name.ends_with(".toml");
  return look_at_scene(load_scene(file ? in_checkout(name) : name).scene, view);
}

std::vector<WrongPrograms> of_rays() {
  std::vector<Scene> flat{on_the_raster(3, 3, 12), on_the_raster(6, 6, 14), on_the_raster(11, 10, 16)}, all = flat;
  for (const double theta : {2.0, 5.0, 11.0}) all.push_back(seen("rays.toml", theta, 87, 9, 6));
  all.push_back(seen("cyclic", 20, 60, 9, 8));
  all.push_back(seen("cyclic", 25, 70, 9, 8, 1.1));  // from amidst the polygons
  all.push_back(seen("pyramid-behind", 33, 62, 9, 8));
  return {{"rays",
           {"ray-casting", zoo::rays, "", {{"boxes", "none"}}},
           all,
           {"nearest_by_index", "negative_t"},
           {"inside_test_half"}},
          {"rays, boxes", {"ray-casting", zoo::rays, "boxes", {{"boxes", "facet"}}}, all, {"box_misses_at_0"}},
          {"rays, tight boxes", {"ray-casting", zoo::rays, "tight boxes", {{"boxes", "facet"}}}, all, {}}};
}

std::vector<WrongPrograms> of_flags() {
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18),
                                  on_the_raster(6, 6, 22),
                                  on_the_raster(11, 10, 26),
                                  seen("abc-def.toml", {}, {}, 22, 27),
                                  seen("five-tests.toml", {}, {}, 32, 20),
                                  on_the_raster(5, 4, 16)};
  return {{"flags",
           {"scan-line", zoo::scan_line_flags},
           scenes,
           {"flag_missed", "wrong_of_two", "slope_inverted", "not_sorted", "plane_d_sign", "closing_edge_missed",
            "implied_edge_missed", "right_end_included", "z_kept_along_span"}},
          // To move an edge once more than it is used is no mistake yet; its flag is.
          {"flags, late", {"scan-line", zoo::scan_line_flags}, scenes, {"retired_one_late"}, {}, false}};
}

std::vector<WrongPrograms> of_viewing() {
  return {{"viewing",
           {"z-buffer", zoo::viewing, "", {}, true},
           {seen("cyclic", 25, 70, 12, 10, 1.5), seen("pyramid-behind", 33, 62, 12, 10, 1.2),
            seen("rays.toml", 40, 80, 12, 8, 2), seen("cyclic", 60, 50, 12, 10, 1.3), seen("pyramid", 33, 62, 14, 12),
            seen("intersecting", 20, 65, 14, 12), seen("dodecahedron", 20, 65, 16, 14)},
           {"no_divide", "divide_twice", "not_clipped_near", "clockwise_front", "z_v_for_depth", "y_upside_down",
            "depth_axis_reversed", "centres_half_off"}}};
}

/// Squares that are cut along a diagonal, each with a neighbour, all in one plane: centres on edges of every kind.
Scene cut_square(int number) {
  zoo::Task task;
  task.width = 18 + number, task.height = 14;
  const int x = 2 + number % 3, y = 1 + number % 2, side = number % 2 == 0 ? 8 : 4;
  for (const auto& [across, down] : {std::pair(0, 0), {side, 0}, {side, side}, {0, side}, {side + 4, 0}})
    task.points.push_back({1.0 * (x + across), 1.0 * (y + down), 0.125 + (across + 2 * down) / 64.0});
  task.polygons = {{0, {0, 1, 2}}, {1, {0, 2, 3}}, {2, {1, 4, 2}}};
  Scene scene = scene_of(task);
  scene.name = fmt::format("a cut square {}", number);
  return scene;
}
/// Two triangles over most of a wide picture, the farther one last.
Scene wide(int number) {
  zoo::Task task;
  task.width = 26 + number, task.height = 10;
  const double w = task.width, h = task.height;
  task.points = {{0.5, 0.25, 0.25},      {w - 2.5, 1.25, 0.375},    {3.5 + number, h - 1.5, 0.3125},
                 {w - 1.5, 0.75, 0.625}, {w - 4.5, h - 1.25, 0.75}, {1.5, h - 2.75, 0.875}};
  task.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}};
  Scene scene = scene_of(task);
  scene.name = fmt::format("wide {}", number);
  return scene;
}

/// Programs of today, which print nothing of how they come to their pixels.
std::vector<WrongPrograms> of_weights() {
  ZooProgram program{"z-buffer", zoo::barycentric, "float64 products"};
  const ZooProgram with_camera = program;
  program.short_names = true;
  std::vector<Scene> borders, strides;
  for (int number = 0; number < 5; ++number) borders.push_back(cut_square(number)), strides.push_back(wide(number));
  return {{"weights",
           program,
           {on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), on_the_raster(11, 10, 26), on_the_raster(20, 8, 34),
            on_the_raster(31, 5, 40)},
           {"picture_mirrored",    "one_pixel_off",  "vertices_rounded", "vertices_truncated",   "one_winding_only",
            "edge_not_asked",      "box_too_small",  "inside_margin",    "area_not_doubled",     "area_not_divided_by",
            "weights_exchanged",   "weights_turned", "weight_negative",  "weight_left_out",      "vertex_depth_twice",
            "depth_of_one_vertex", "depth_is_mean",  "depth_truncated",  "depth_by_reciprocals", "colour_of_next",
            "colour_beside"},
           {"not_normalised", "depth_squared"}},
          {"weights, borders", program, borders, {"border_for_nobody", "border_for_both", "border_for_other_side"}},
          {"weights, strides", program, strides, {"stride_is_height"}},
          {"weights, camera",
           with_camera,
           {seen("cyclic", 25, 70, 16, 10), seen("intersecting", 20, 65, 18, 12), seen("cyclic", 10, 60, 20, 12),
            seen("intersecting", 40, 60, 16, 12), seen("cyclic", 40, 50, 18, 10)},
           {"window_taken_for_square", "z_v_for_depth"}}};
}

std::vector<WrongPrograms> of_areas() {
  return {{"areas",
           {"warnock", zoo::areas},
           {on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), on_the_raster(11, 10, 26), on_the_raster(5, 4, 16),
            seen("five-tests.toml", {}, {}, 32, 20), seen("quarters.toml", {}, {}, 16, 16)},
           {"surrounding_unchecked", "stops_one_early", "quarters_overlap"}}};
}

std::vector<WrongPrograms> of_horizon() {
  std::vector<Scene> scenes;
  for (const double theta : {-74.0, -60.0, -95.0}) scenes.push_back(surface("lessons/scenes/ridge-valley.toml", theta));
  for (const double theta : {-80.0, -65.0}) scenes.push_back(surface("y = sin(x) * cos(z)", theta));
  return {{"horizon",
           {"floating-horizon", zoo::horizon, "", {{"sides", "off"}}},
           scenes,
           {"only_upper", "not_interpolated", "farthest_first", "lower_never_moves", "crossing_from_end", "one_ink"},
           {"translation_left_out", "hidden_drawn"}}};
}

std::vector<WrongPrograms> of_depth_sort() {
  const ZooProgram program{"depth-sort", zoo::depth_sort};
  std::vector<Scene> equal;  // many of the farthest depths are the same
  for (const std::uint64_t seed : {3u, 6u, 8u, 9u, 10u}) {
    zoo::Task task = triangles(seed, 6, 18);
    for (zoo::Point& p : task.points) p.z = std::ceil(4 * p.z) / 4;
    equal.push_back(scene_of(task));
    equal.back().name = fmt::format("equal depths {}", seed);
  }
  return {{"depth sort",
           program,
           {on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), on_the_raster(11, 10, 26), on_the_raster(5, 4, 16),
            seen("five-tests.toml", {}, {}, 32, 20), seen("five-tests-ring.toml", {}, {}, 32, 20)},
           {"sorted_by_nearest", "tests_3_4_swapped", "pieces_lost"}},
          {"depth sort, ties", program, equal, {"ties_unstable"}}};
}

std::vector<WrongPrograms> of_tree() {
  const ZooProgram program{"bsp", zoo::bsp, "", {{"root", "first"}}};
  const std::vector<Scene> scenes{on_the_raster(3, 3, 18), on_the_raster(6, 6, 22), seen("cyclic", 20, 60, 9, 8),
                                  seen("intersecting", 20, 60, 9, 8), seen("cube", 25, 60, 9, 8)};
  std::vector<Scene> in_one_plane = scenes;
  in_one_plane.push_back(seen("pyramid-behind", 33, 62, 18, 16));  // a triangle of it is there twice
  // That the near side came too early shows when the far side comes, and not before.
  return {{"BSP tree", program, scenes, {"spanning_not_split", "side_by_normal"}, {"cleared_again"}},
          {"BSP tree, order", program, scenes, {"near_side_first"}, {}, false},
          {"BSP tree, one plane", program, in_one_plane, {}}};
}

}  // namespace

Scene on_the_raster(std::uint64_t seed, int count, int size) {
  Scene scene = scene_of(triangles(seed, count, size));
  scene.name = fmt::format("{} triangles", count);
  return scene;
}
std::vector<Scene> scenes_of_edge_table() {
  std::vector<Scene> scenes{on_the_raster(3, 3, 18),  on_the_raster(6, 6, 22),  on_the_raster(11, 10, 26),
                            on_the_raster(20, 8, 34), on_the_raster(31, 5, 40), scene_of(ties()),
                            scene_of(concave())};
  scenes[5].name = "ties", scenes[6].name = "concave";
  return scenes;
}

std::vector<WrongPrograms> wrong_programs(const std::string& method) {
  if (method == "ray-casting") return of_rays();
  if (method == "scan-line") return of_flags();
  if (method == "z-buffer") {
    std::vector<WrongPrograms> all = of_viewing();
    for (WrongPrograms& one : of_weights()) all.push_back(std::move(one));
    return all;
  }
  if (method == "warnock") return of_areas();
  if (method == "floating-horizon") return of_horizon();
  if (method == "depth-sort") return of_depth_sort();
  return of_tree();
}

Conventions conventions_of(const ZooProgram& program) {
  Conventions conventions;
  conventions.cull = program.cull, conventions.number_format = program.number_format;
  conventions.interpolation = program.interpolation, conventions.rounding = program.rounding;
  for (const auto& [name, value] : program.options) conventions.options[name] = value;
  return conventions;
}

std::string head_of(const ZooProgram& program, const Scene& scene) {
  const Conventions conventions = conventions_of(program);
  if (!program.short_names) return head(program.method, scene, conventions);
  return head(task_of(scene), std::string(word_of(conventions.number_format)).c_str(),
              std::string(word_of(conventions.interpolation)).c_str());
}

std::string printed_by(const ZooProgram& program, const Scene& scene, const std::string& mistake) {
  zoo::Task task = task_of(scene);
  task.style = program.style, task.mistake = mistake;
  return program.run(task);
}

namespace {

/// The picture, where there is one, and each kind of step that a run has.
std::vector<grade::Part> parts_of(const ZooProgram& program, const Trace& run) {
  std::vector<grade::Part> parts;
  if (program.paints) parts.push_back({"buffers", grade::Level::buffers, {}, 0, 1});
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (const auto one = static_cast<std::uint8_t>(kind); run.has(one))
      parts.push_back({name_of(one), grade::Level::matched, {one}, 1, 1});
  return parts;
}

}  // namespace

Found found_in(const ZooProgram& program, const Scene& scene, const std::string& mistake) {
  const std::string right = printed_by(program, scene, ""), text = printed_by(program, scene, mistake);
  const std::int64_t step = first_difference(right, text);
  Found found;
  found.shows = step != 0;
  std::string impossible;
  const Trace run = trace_of(head_of(program, scene) + text, &impossible);
  const Trace reference = recorded_by(program.method, run.scene(), run.header().conventions);
  const std::vector<grade::Part> parts = parts_of(program, run);
  const grade::Judgement judged = grade::judge(reference, run, parts);
  found.detected = judged.first || !impossible.empty();
  found.step = judged.first ? judged.first->step : 0;
  found.full_marks = true;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const grade::PartCount& count = judged.parts[k];
    const bool computed = parts[k].level == grade::Level::buffers || count.computed == count.all();
    found.full_marks = found.full_marks && count.expected > 0 && count.same == count.all() && computed;
  }
  if (const auto name = grade::mistake_in(reference, run, judged)) found.name = test::named(*name);
  found.said = judged.first ? said_of(*judged.first) : "nothing";
  if (!found.shows) return found;
  const std::int64_t shows = shown_at(run, step);
  found.at_once = judged.first && step <= judged.first->step && judged.first->step <= shows;
  const Trace without = trace_of(head_of(program, scene) + right);
  for (const diff::Cause& cause : judged.difference.causes) {
    if (cause.part != diff::Part::different) continue;
    found.at_once = found.at_once || is_at(cause, reference, judged.difference.alignment, without, step, shows);
    break;
  }
  found.said = fmt::format("from step {}, shown at {}; found: {}", step, shows,
                           judged.first ? said_of(*judged.first) : "nothing");
  return found;
}

PairsNamed pairs_of_edge_table() {
  const std::vector<Scene> scenes = scenes_of_edge_table();
  const auto printed = [&](std::size_t scene, const std::string& mistake) {
    return printed_by(edge_table_program, scenes[scene], mistake);
  };
  PairsNamed pairs;
  std::uint32_t turn = 0;
  for (const std::string one : of_edge_table)
    for (const std::string other : of_edge_table) {
      turn = turn * 1664525 + 1013904223;
      if (one >= other || turn >> 24 > 60) continue;
      const std::size_t scene = turn >> 8 & 3u;
      const std::string right = printed(scene, "");
      const std::int64_t first = first_difference(right, printed(scene, one)),
                         second = first_difference(right, printed(scene, other));
      if (first == 0 || second == 0) continue;
      const std::string name = found_in(edge_table_program, scenes[scene], one + "+" + other).name;
      const bool both = name == one + "+" + other || name == other + "+" + one;
      const bool is_right = both || (name == one && first <= second) || (name == other && second <= first);
      (is_right ? pairs.right : name.empty() ? pairs.none : pairs.wrong)++;
      if (!is_right) pairs.others += fmt::format("\n{}+{}: {}", one, other, name.empty() ? "no name" : name);
    }
  return pairs;
}

std::string named(const grade::Likely& likely) {
  std::string name(mistakes::text_of(likely.mistake).id);
  if (likely.also) name += "+" + std::string(mistakes::text_of(*likely.also).id);
  return name;
}

std::string name_of(std::uint8_t kind) {
  std::string_view name;
  for_each_kind([&]<class E>() {
    if (kind_of<E> == kind) name = description_of<E>.name;
  });
  return std::string(name);
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

}  // namespace zstep::test
