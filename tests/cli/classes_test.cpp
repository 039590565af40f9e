// The classes of thirty that homeworks come with: each wrong program loses points from the step that its wrong line is
// about; its mistake is named where the catalogue has it, and no name is given where it has none.
#include <doctest/doctest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

/// The steps that are the first wrong ones, by what follows the number in a student's folder.
using FirstSteps = std::map<std::string, std::set<std::string>>;

const FirstSteps z_buffer_steps{
    {"slope_inverted", {"insert_edge"}},
    {"slope_whole", {"insert_edge"}},
    {"z_slope_of_x", {"insert_edge"}},
    {"z_not_swapped", {"insert_edge"}},
    {"ends_one_late", {"insert_edge"}},
    {"starts_one_early", {"insert_edge"}},
    {"retired_one_late", {"retire_edge", "scan_line"}},
    {"never_retired", {"retire_edge", "scan_line", "span"}},
    {"right_end_included", {"span"}},
    {"left_end_excluded", {"span"}},
    {"ends_truncated", {"span"}},
    {"ends_rounded", {"span"}},
    {"z_not_to_centre", {"interpolate_z"}},
    {"z_stepped_before_use", {"interpolate_z"}},
    {"compare_reversed", {"compare"}},
    {"equal_wins", {"compare"}},
    {"buffer_reset", {"compare"}},
    {"buffer_of_one_line", {"compare"}},
    {"buffer_begins_at_0", {"clear"}},
    {"depth_not_written", {"write_depth"}},
    {"colour_always", {"write_pixel"}},
    {"x_y_exchanged", {"write_pixel"}},
    {"crashes", {"compare"}},
};

const FirstSteps scan_line_steps{
    {"plane_d_sign", {"plane"}},
    {"other-plane_sums_negative", {"plane"}},
    {"slope_inverted", {"insert_edge"}},
    {"slope_whole", {"insert_edge"}},
    {"z_slope_of_x", {"insert_edge"}},
    {"z_not_swapped", {"insert_edge"}},
    {"ends_one_late", {"insert_edge"}},
    {"starts_one_early", {"insert_edge", "skip_edge"}},
    {"x_at_vertex", {"insert_edge"}},
    {"horizontal_inserted", {"skip_edge", "insert_edge"}},
    {"other-retired_one_late", {"retire_edge", "flags", "flip"}},
    {"never_retired", {"retire_edge", "flags", "flip"}},
    {"not_sorted", {"flags"}},
    {"other-entered_in_front", {"flip", "flags"}},
    {"flag_missed", {"flip"}},
    {"right_end_included", {"flags"}},
    {"left_end_excluded", {"flags"}},
    {"wrong_of_two", {"winner"}},
    {"other-first_of_two", {"winner", "implied_edge"}},
    {"implied_edge_missed", {"winner"}},
    {"z_kept_along_span", {"paint"}},
    {"other-depth_of_line_above", {"paint"}},
    {"other-colour_of_first", {"paint"}},
    {"crashes", {"paint"}},
};

const FirstSteps horizon_steps{
    {"depth_axis_reversed", {"view_vertex"}},
    {"z_v_for_depth", {"project"}},
    {"no_divide", {"project"}},
    {"divide_twice", {"project"}},
    {"y_upside_down", {"to_viewport"}},
    {"centres_half_off", {"to_viewport"}},
    {"other-square_window", {"to_viewport"}},
    {"other-eye_at_origin", {"view_vertex"}},
    {"other-whole_window", {"to_viewport"}},
    {"other-sign_of_pseudodepth", {"project"}},
    {"farthest_first", {"move"}},
    {"not_interpolated", {"test"}},
    {"only_upper", {"test"}},
    {"lower_never_moves", {"move"}},
    {"other-upper_never_moves", {"move"}},
    {"other-moved_when_lower", {"move"}},
    {"other-horizons_begin_at_0", {"test"}},
    {"other-begins_a_column_early", {"test"}},
    {"other-curves_joined", {"draw"}},
    {"crossing_from_end", {"cross"}},
    {"other-crosses_other_horizon", {"draw", "cross"}},
    {"one_ink", {"draw"}},
    {"other-pixels_truncated", {"draw"}},
    {"other-gaps_in_steep_lines", {"draw"}},
    {"crashes", {"move"}},
};

const FirstSteps ray_steps{
    {"nearest_by_index", {"hit"}},
    {"negative_t", {"hit"}},
    {"other-d_sign", {"plane"}},
    {"other-d_forgotten", {"plane"}},
    {"other-numerator_sign", {"plane"}},
    {"other-fraction_turned", {"plane"}},
    {"other-normal_of_two_corners", {"plane"}},
    {"other-through_corners", {"ray"}},
    {"other-rows_for_columns", {"ray"}},
    {"other-first_row_at_bottom", {"ray"}},
    {"other-counted_by_columns", {"ray"}},
    {"other-point_from_origin", {"hit"}},
    {"other-always_without_z", {"hit"}},
    {"other-without_widest", {"hit"}},
    {"other-once_inside_always", {"hit"}},
    {"other-last_side_forgotten", {"hit"}},
    {"other-plane_is_enough", {"hit"}},
    {"other-farther_than_infinity", {"hit"}},
    {"other-first_kept", {"hit"}},
    {"other-far_plane_forgotten", {"hit"}},
    {"other-depth_is_t", {"paint"}},
    {"other-depth_sign", {"paint"}},
    {"other-colours_to_255", {"ray_end"}},
    {"other-hits_counted", {"ray_end"}},
    {"crashes", {"plane"}},
};

const FirstSteps depth_sort_steps{
    {"plane_d_sign", {"plane"}},
    {"other-d_forgotten", {"plane"}},
    {"other-normal_turned", {"cut"}},
    {"sorted_by_nearest", {"insert"}},
    {"other-sorted_by_middle", {"insert", "insert_part"}},
    {"other-nearest_first", {"insert"}},
    {"ties_unstable", {"insert", "insert_part"}},
    {"tests_3_4_swapped", {"test_4", "test_5", "pair", "move"}},
    {"other-test_5_forgotten", {"test_3_swapped", "pair"}},
    {"other-plane_not_turned", {"test_3"}},
    {"other-turned_away", {"test_3", "test_4", "pair"}},
    {"pieces_lost", {"insert_part"}},
    {"other-one_part_lost", {"insert_part"}},
    {"other-put_back_at_end", {"insert_part"}},
    {"other-split_at_once", {"test_3_swapped", "test_4_swapped"}},
    {"other-moved_unasked", {"move", "test_3", "test_3_swapped"}},
    {"other-painters_algorithm", {"draw", "outline"}},
    {"other-in_plane_is_no", {"test_4"}},
    {"other-last_vertex_forgotten", {"extent"}},
    {"other-t_from_other_end", {"cut"}},
    {"other-depth_kept_along_span", {"paint"}},
    {"crashes", {"paint"}},
};

const FirstSteps bsp_steps{
    {"other-d_sign", {"plane"}},
    {"other-normal_turned", {"vertex_side"}},
    {"other-d_forgotten", {"plane"}},
    {"spanning_not_split", {"part"}},
    {"near_side_first", {"draw"}},
    {"other-eye_turned_round", {"eye_side"}},
    {"side_by_normal", {"eye_side"}},
    {"other-sides_exchanged", {"node", "vertex_side"}},
    {"other-in_plane_to_back", {"node", "vertex_side"}},
    {"other-first_in_plane_first", {"draw"}},
    {"other-back_first", {"vertex_side"}},
    {"other-part_behind_lost", {"node", "vertex_side"}},
    {"other-t_from_other_end", {"cut"}},
    {"other-parts_exchanged", {"node"}},
    {"other-last_vertex_forgotten", {"vertex_side"}},
    {"other-side_of_first_vertex", {"part"}},
    {"other-list_turned", {"node"}},
    {"other-a_pixel_more", {"paint", "draw"}},
    {"other-ends_truncated", {"paint", "draw"}},
    {"other-depth_sign", {"paint"}},
    {"other-depth_kept_along_span", {"paint"}},
    {"other-all_in_one_colour", {"paint"}},
    {"crashes", {"paint"}},
};

const FirstSteps warnock_steps{
    {"plane_d_sign", {"plane"}},
    {"other-sum_negative", {"plane"}},
    {"other-last_side_forgotten", {"plane"}},
    {"surrounding_unchecked", {"corner_depth", "front_surrounder"}},
    {"stops_one_early", {"pixel", "center_depth"}},
    {"quarters_overlap", {"area"}},
    {"other-quarters_of_the_picture", {"area"}},
    {"other-three_quarters", {"area"}},
    {"other-area_by_centres", {"disjoint", "intersecting"}},
    {"other-half_a_pixel_off", {"intersecting"}},
    {"other-edges_of_no_length", {"disjoint"}},
    {"other-surrounding_forgotten", {"disjoint"}},
    {"other-contained_is_intersecting", {"intersecting"}},
    {"other-around_not_handed_on", {"still_surrounding"}},
    {"other-last_at_centre", {"pixel"}},
    {"other-last_of_equals", {"pixel"}},
    {"other-three_corners", {"corner_depth"}},
    {"other-one_corner_is_enough", {"front_surrounder"}},
    {"other-corners_at_centres", {"corner_depth"}},
    {"other-depth_sign", {"paint"}},
    {"other-whole_area_filled", {"paint"}},
    {"other-all_in_one_colour", {"paint"}},
    {"crashes", {"paint"}},
};

/// Mistakes that leave no name in some scenes, where what they change cannot be told from what another would. Where
/// nothing is hidden a program that prints no depths may have written them all the same.
const std::set<std::string> seldom_told{"retired_one_late", "never_retired",      "flag_missed",
                                        "only_upper",       "spanning_not_split", "depth_not_written"};

struct Names {
  int right = 0, none = 0, wrong = 0;
};

bool is_nameless(const std::string& mistake) {
  return mistake == "right" || mistake == "prints-nothing" || mistake == "crashes" || mistake.starts_with("other-");
}

/// One student's report: which names are given, and where the first divergences are.
void hold(const json& report, const std::string& mistake, const FirstSteps& steps, Names& names) {
  const bool right = mistake == "right", nothing = mistake == "prints-nothing";
  CHECK(report["gradable"] == !nothing);
  CHECK((report["points"] == doctest::Approx(report["of"].get<double>())) == right);
  bool named = false, differs = false;
  const bool nameless = is_nameless(mistake);
  for (const json& scene : report["scenes"]) {
    const std::string name = scene.contains("mistake") ? scene["mistake"]["id"].get<std::string>() : "";
    if (nameless) CHECK(name == "");
    if (!scene.contains("first")) continue;
    differs = true;
    REQUIRE(steps.contains(mistake));
    const std::string step = scene["first"]["step"].get<std::string>();
    CAPTURE(step);
    CHECK(steps.at(mistake).contains(step));
    if (nameless) continue;
    named = named || name == mistake;
    if (!seldom_told.contains(mistake)) CHECK(name == mistake);
    (name == mistake ? names.right : name.empty() ? names.none : names.wrong)++;
  }
  CHECK(differs == !(right || nothing));
  CHECK((named || nameless));
}

bool has_python() {
  const Folder folder;
  return shell(folder, "python3 --version").code == 0;
}

Names each_is_told(const std::string& method, const std::string& program, const FirstSteps& steps) {
  Names names;
  const Folder folder;
  REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
  REQUIRE(shell(folder, "python3 hw/class/make_class.py class").code == 0);
  REQUIRE(shell(folder, "python3 '" + in_checkout("tests/cli/run_class.py") + "' class " + program +
                            " runs hw/scenes/*.txt hw/hidden/*.txt")
              .code == 0);
  int students = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "class")) {
    const std::string student = entry.path().filename().string();
    ++students;
    CAPTURE(student);
    const std::string mistake = student.substr(3);
    hold(json::parse(run(folder, "grade --homework hw runs/" + student + " --format json").out), mistake, steps, names);
    // Students read the name, too, also where it is told by a hidden scene alone.
    CHECK(has(run(folder, "grade --homework hw runs/" + student).out, "Likely: ") == !is_nameless(mistake));
  }
  CHECK(students == 30);
  MESSAGE(method, ": ", names.right, " named rightly, ", names.none, " not, ", names.wrong, " wrongly");
  return names;
}

}  // namespace

TEST_CASE("classes: of thirty Z-buffers, each is told the own mistake") {
  if (!has_python()) return;
  const Names names = each_is_told("z-buffer", "zbuffer.py", z_buffer_steps);
  CHECK(names.wrong == 0);
  CHECK(names.right >= 0.95 * (names.right + names.none + names.wrong));
}

TEST_CASE("classes: of thirty scan-line programs, each is told the own mistake") {
  if (!has_python()) return;
  const Names names = each_is_told("scan-line", "scanline.py", scan_line_steps);
  CHECK(names.wrong == 0);
  CHECK(names.right >= 0.9 * (names.right + names.none + names.wrong));
}

TEST_CASE("classes: of thirty floating horizons, each is told the own mistake") {
  if (!has_python()) return;
  const Names names = each_is_told("floating-horizon", "horizon.py", horizon_steps);
  CHECK(names.wrong == 0);
  CHECK(names.right >= 0.95 * (names.right + names.none + names.wrong));
}

TEST_CASE("classes: of thirty ray casters, each is told the own mistake") {
  if (!has_python()) return;
  const Names names = each_is_told("ray-casting", "raycast.py", ray_steps);
  CHECK(names.right >= 6);
  CHECK(names.none + names.wrong == 0);
}

TEST_CASE("classes: of thirty depth sorts, each is told the own mistake") {
  if (!has_python()) return;
  const Names names = each_is_told("depth-sort", "depthsort.py", depth_sort_steps);
  CHECK(names.right >= 30);
  CHECK(names.none + names.wrong == 0);
}

TEST_CASE("classes: of thirty BSP trees, each is told the own mistake") {
  if (!has_python()) return;
  const Names names = each_is_told("bsp", "bsp.py", bsp_steps);
  CHECK(names.wrong == 0);
  CHECK(names.right >= 0.85 * (names.right + names.none));
}

TEST_CASE("classes: of thirty programs by Warnock's algorithm, each is told the own mistake") {
  if (!has_python()) return;
  const Names names = each_is_told("warnock", "warnock.py", warnock_steps);
  CHECK(names.right >= 16);
  CHECK(names.none + names.wrong == 0);
}
