// Law: a mistake of the catalogue is named where a program makes it, another one never is, and a program that makes
// none is not said to.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"
#include "traces/check/check.hpp"
#include "traces/events/fields.hpp"
#include "traces/grade/grade.hpp"
#include "traces/mistakes/name.hpp"

using namespace zstep;
using mistakes::Mistake;

namespace {

std::vector<zoo::Task> tasks() {
  return {test::triangles(3, 3, 18),
          test::triangles(6, 6, 22),
          test::triangles(11, 10, 26),
          test::triangles(20, 8, 34),
          test::triangles(31, 5, 40),
          test::ties(),
          test::concave()};
}

/// The text of lessons/NUMBER-NAME.md.
std::string lesson_called(const std::string& name) {
  for (const auto& entry : std::filesystem::directory_iterator(test::in_checkout("lessons"))) {
    const std::string file = entry.path().stem().string();
    if (file.substr(file.find('-') + 1) != name) continue;
    std::ifstream in(entry.path());
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const char* mark : {"{\"", "\"}"})  // around numbers that are no values of the run
      for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) text.erase(at, 2);
    return text;
  }
  return {};
}

struct Program {
  std::string (*run)(const zoo::Task&) = zoo::edge_table;
  const char *number_format = "float64", *interpolation = "increments";
};

/// The name that a run of this program gets; "" where it gets none, "-" where the run is the right one's.
std::string named(zoo::Task task, const std::string& mistake, const Program& program = {}) {
  const std::string right = program.run(task);
  task.mistake = mistake;
  const std::string text = program.run(task);
  if (!mistake.empty() && test::first_difference(right, text) == 0) return "-";
  std::string impossible;
  const Trace run = test::trace_of(test::head(task, program.number_format, program.interpolation) + text, &impossible);
  const Trace reference = test::recorded_by("z-buffer", run.scene(), run.header().conventions);
  const grade::Judgement found = grade::judge(reference, run, {});
  const auto name = grade::mistake_in(reference, run, found);
  return name ? test::named(*name) : "";
}

/// Which program of the zoo makes it in which of its scenes, and the first step that is wrong then.
struct BrokenProgram {
  const char *mistake, *program;
  std::size_t scene;
  std::int64_t step;
};
constexpr BrokenProgram broken_programs[] = {
    {"depth_axis_reversed", "viewing", 0, 2},
    {"no_divide", "viewing", 0, 3},
    {"divide_twice", "viewing", 0, 3},
    {"z_v_for_depth", "viewing", 0, 3},
    {"not_clipped_near", "viewing", 0, 6},
    {"y_upside_down", "edge table", 1, 10},
    {"centres_half_off", "viewing", 0, 4},
    {"clockwise_front", "viewing", 4, 18},
    {"horizontal_inserted", "edge table", 5, 3},
    {"ends_one_late", "edge table", 0, 3},
    {"starts_one_early", "edge table", 0, 3},
    {"slope_inverted", "edge table", 0, 3},
    {"slope_whole", "edge table", 0, 3},
    {"z_slope_of_x", "edge table", 0, 3},
    {"z_not_swapped", "edge table", 1, 3},
    {"x_at_vertex", "edge table", 0, 3},
    {"z_at_vertex", "edge table", 0, 3},
    {"stepped_too_early", "edge table", 0, 11},
    {"stepped_twice", "edge table", 0, 15},
    {"rounded_then_stepped", "edge table", 4, 11},
    {"z_not_carried", "edge table", 4, 11},
    {"retired_one_late", "edge table", 0, 14},
    {"never_retired", "edge table", 0, 14},
    {"not_sorted", "edge table", 6, 813},
    {"right_end_included", "edge table", 0, 9},
    {"left_end_excluded", "edge table", 5, 9},
    {"ends_rounded", "edge table", 0, 9},
    {"ends_truncated", "edge table", 0, 9},
    {"z_by_slope_of_x", "edge table", 2, 14},
    {"z_by_slope_of_edge", "edge table", 2, 14},
    {"z_not_to_centre", "edge table", 1, 10},
    {"z_stepped_before_use", "edge table", 1, 10},
    {"z_kept_along_span", "flags", 0, 43},
    {"adds_in_float32", "edge table", 2, 14},
    {"compare_reversed", "edge table", 2, 183},
    {"equal_wins", "edge table", 5, 294},
    {"buffer_begins_at_0", "edge table", 0, 1},
    {"buffer_reset", "edge table", 2, 183},
    {"buffer_of_one_line", "edge table", 4, 27},
    {"written_before_test", "edge table", 1, 12},
    {"depth_not_written", "edge table", 1, 12},
    {"depth_always", "edge table", 2, 184},
    {"colour_not_written", "edge table", 2, 173},
    {"colour_always", "edge table", 2, 184},
    {"x_y_exchanged", "edge table", 1, 13},
    {"picture_mirrored", "weights", 1, 3},
    {"one_pixel_off", "weights", 1, 3},
    {"vertices_rounded", "weights", 1, 3},
    {"vertices_truncated", "weights", 1, 3},
    {"one_winding_only", "weights", 1, 132},
    {"border_for_nobody", "weights, borders", 0, 3},
    {"border_for_both", "weights, borders", 0, 27},
    {"border_for_other_side", "weights, borders", 0, 3},
    {"edge_not_asked", "weights", 1, 3},
    {"box_too_small", "weights", 1, 129},
    {"inside_margin", "weights", 1, 3},
    {"area_not_doubled", "weights", 1, 3},
    {"area_not_divided_by", "weights", 1, 3},
    {"weights_exchanged", "weights", 1, 3},
    {"weights_turned", "weights", 1, 3},
    {"weight_negative", "weights", 1, 3},
    {"weight_left_out", "weights", 1, 3},
    {"vertex_depth_twice", "weights", 1, 3},
    {"depth_of_one_vertex", "weights", 1, 3},
    {"depth_is_mean", "weights", 1, 3},
    {"depth_truncated", "weights", 1, 3},
    {"depth_by_reciprocals", "weights", 1, 3},
    {"stride_is_height", "weights, strides", 0, 283},
    {"colour_of_next", "weights", 1, 5},
    {"colour_beside", "weights", 1, 5},
    {"window_taken_for_square", "weights, camera", 0, 3},
    {"flag_missed", "flags", 0, 34},
    {"wrong_of_two", "flags", 1, 130},
    {"plane_d_sign", "flags", 0, 8},
    {"closing_edge_missed", "flags", 0, 23},
    {"implied_edge_missed", "flags", 1, 331},
    {"sorted_by_nearest", "depth sort", 0, 26},
    {"ties_unstable", "depth sort, ties", 1, 46},
    {"tests_3_4_swapped", "depth sort", 1, 57},
    {"pieces_lost", "depth sort", 3, 60},
    {"near_side_first", "BSP tree, order", 4, 152},
    {"side_by_normal", "BSP tree", 0, 49},
    {"spanning_not_split", "BSP tree", 3, 18},
    {"surrounding_unchecked", "areas", 5, 106},
    {"stops_one_early", "areas", 3, 68},
    {"quarters_overlap", "areas", 0, 29},
    {"nearest_by_index", "rays", 3, 233},
    {"negative_t", "rays", 8, 5},
    {"box_misses_at_0", "rays, boxes", 0, 33},
    {"only_upper", "horizon", 0, 139},
    {"not_interpolated", "horizon", 0, 136},
    {"farthest_first", "horizon", 0, 139},
    {"lower_never_moves", "horizon", 0, 139},
    {"crossing_from_end", "horizon", 1, 217},
    {"one_ink", "horizon", 4, 3906},
};

}  // namespace

TEST_CASE("mistakes: each has a text, and its id is the one that the code has for it") {
  std::set<std::string_view> ids;
  for (std::size_t k = 0; k < mistakes::mistake_count; ++k) {
    const mistakes::MistakeText& text = mistakes::text_of(static_cast<Mistake>(k));
    CAPTURE(text.id);
    CHECK(ids.insert(text.id).second);
    CHECK(mistakes::mistake_called(text.id) == static_cast<Mistake>(k));
    CHECK(text.name.ends_with('.'));
    CHECK(text.question.ends_with('?'));
    const std::string lesson = lesson_called(std::string(text.lesson));
    CHECK(lesson.find("\n## " + std::string(text.stop) + " {") != std::string::npos);
  }
  CHECK(ids.size() >= 40);
  CHECK(mistakes::text_of(Mistake::slope_inverted).id == "slope_inverted");
  CHECK(mistakes::text_of(Mistake::equal_wins).id == "equal_wins");
  CHECK(mistakes::text_of(Mistake::not_interpolated).id == "not_interpolated");
}

TEST_CASE("mistakes: the classic ones are in the catalogue") {
  const struct {
    const char* known_as;
    std::vector<const char*> ids;
  } classics[] = {
      {"scan line off by one at y_max", {"ends_one_late"}},
      {"horizontal edges inserted", {"horizontal_inserted"}},
      {"x stepped before drawing", {"stepped_too_early"}},
      {"x rounded and then incremented", {"rounded_then_stepped"}},
      {"slope inverted", {"slope_inverted"}},
      {"integer division in the slope", {"slope_whole"}},
      {"active list not re-sorted", {"not_sorted"}},
      {"edge not retired", {"never_retired", "retired_one_late"}},
      {"span with the wrong end in or out", {"right_end_included", "left_end_excluded"}},
      {"z interpolated with x's slope", {"z_slope_of_x", "z_by_slope_of_x"}},
      {"z interpolated along the wrong axis", {"z_by_slope_of_edge"}},
      {"z_v where pseudodepth is due", {"z_v_for_depth"}},
      {"z not carried across lines", {"z_not_carried"}},
      {"z not moved from x_L to the first pixel's centre", {"z_not_to_centre"}},
      {"compare reversed", {"compare_reversed"}},
      {"<= for <", {"equal_wins"}},
      {"depth buffer initialised to 0", {"buffer_begins_at_0"}},
      {"depth buffer reset too often, or not for the next line", {"buffer_reset", "buffer_of_one_line"}},
      {"depth written before the test", {"written_before_test"}},
      {"colour written without depth, and the reverse", {"depth_not_written", "colour_not_written"}},
      {"z of vertices not swapped with them", {"z_not_swapped"}},
      {"clockwise taken as front", {"clockwise_front"}},
      {"y flipped", {"y_upside_down"}},
      {"x and y exchanged in the buffer's index", {"x_y_exchanged"}},
      {"perspective divide missing, or made twice", {"no_divide", "divide_twice"}},
      {"vertices before the near plane divided by a negative w", {"not_clipped_near"}},
      {"flag not toggled at a shared vertex", {"flag_missed"}},
      {"the wrong one of two flagged polygons", {"wrong_of_two"}},
      {"tests 3 and 4 of depth sort swapped", {"tests_3_4_swapped"}},
      {"split pieces not put back", {"pieces_lost"}},
      {"sorted by nearest z", {"sorted_by_nearest"}},
      {"stable order lost at ties", {"ties_unstable"}},
      {"tree traversed from the near side", {"near_side_first"}},
      {"a node's side from the normal's sign", {"side_by_normal"}},
      {"spanning polygon not split", {"spanning_not_split"}},
      {"surrounding polygon accepted without a check of depths", {"surrounding_unchecked"}},
      {"recursion stopped a level early", {"stops_one_early"}},
      {"a quarter overlaps its neighbour", {"quarters_overlap"}},
      {"nearest hit by index instead of t", {"nearest_by_index"}},
      {"t < 0 accepted", {"negative_t"}},
      {"box test fails for a component of 0", {"box_misses_at_0"}},
      {"only the upper horizon kept", {"only_upper"}},
      {"horizon not interpolated between samples", {"not_interpolated"}},
      {"float32 accumulated over a long span", {"adds_in_float32"}},
  };
  for (const auto& classic : classics) {
    CAPTURE(std::string(classic.known_as));
    for (const char* id : classic.ids) CHECK(mistakes::mistake_called(id));
  }
}

TEST_CASE("mistakes: each is named where a program of the zoo makes it, at the step where the run goes wrong") {
  std::map<std::string, test::WrongPrograms> programs;
  std::set<std::string> rows;
  programs["edge table"] = {"edge table",
                            test::edge_table_program,
                            test::scenes_of_edge_table(),
                            {std::begin(test::of_edge_table), std::end(test::of_edge_table)}};
  for (const char* method : test::methods_with_mistakes)
    for (const test::WrongPrograms& wrong : test::wrong_programs(method)) programs[wrong.what] = wrong;
  for (const BrokenProgram& broken : broken_programs) {
    const std::string mistake = broken.mistake;
    CAPTURE(mistake);
    const test::WrongPrograms& wrong = programs[broken.program];
    REQUIRE(broken.scene < wrong.scenes.size());
    const test::Found found = test::found_in(wrong.program, wrong.scenes[broken.scene], mistake);
    CAPTURE(found.said);
    CHECK(found.name == mistake);
    CHECK(found.at_once);
    CHECK(found.step == broken.step);
    rows.insert(mistake);
  }
  for (std::size_t k = 0; k < mistakes::mistake_count; ++k) {
    const std::string id(mistakes::text_of(static_cast<Mistake>(k)).id);
    CAPTURE(id);
    CHECK(rows.contains(id));
  }
  // Tests that go through all scenes hold what the programs are said to make to the name that it has.
  for (const auto& program : programs)
    for (const char* mistake : program.second.mistakes) {
      CAPTURE(program.first);
      CAPTURE(std::string(mistake));
      CHECK(mistakes::mistake_called(mistake));
    }
}

TEST_CASE("mistakes: those of the Z-buffer are named as what they are") {
  int right = 0, none = 0, wrong = 0;
  std::string table;
  for (const char* mistake : test::of_edge_table) {
    std::map<std::string, int> names;
    for (const zoo::Task& task : tasks()) ++names[named(task, mistake)];
    CAPTURE(mistake);
    CHECK(names[mistake] > 0);
    for (const auto& [name, times] : names) {
      if (name == "-") continue;
      (name == mistake ? right : name.empty() ? none : wrong) += times;
      if (times > 0 && name != mistake)
        table += std::string("\n") + mistake + ": " + (name.empty() ? "no name" : name) + " " + std::to_string(times);
    }
  }
  MESSAGE(right, " of ", right + none + wrong, " named rightly, ", none, " not, ", wrong, " wrongly", table);
  CHECK(right >= 0.95 * (right + none + wrong));
}

TEST_CASE("mistakes: two in one number, or in one step, are named together, where none does alone") {
  for (const auto& two : {std::pair("z_slope_of_x_inverted", "slope_inverted+z_slope_of_x"),
                          {"z_at_vertex+z_not_swapped", "z_not_swapped+z_at_vertex"},
                          {"x_at_vertex+z_at_vertex", "x_at_vertex+z_at_vertex"}}) {
    const char *const made = two.first, *const name = two.second;
    CAPTURE(std::string(made));
    std::map<std::string, int> names;
    for (const zoo::Task& task : tasks()) ++names[named(task, made)];
    std::string table;
    for (const auto& [one, times] : names) table += "\n" + one + ": " + std::to_string(times);
    MESSAGE(std::string(made), table);
    const std::string both = name, one = both.substr(0, both.find('+')), other = both.substr(both.find('+') + 1);
    const int right = names[both] + names[other + "+" + one];
    CHECK(right >= 3);
    const int one_of_two = names[one] + names[other];
    CHECK(right + one_of_two + names["-"] + names[""] == static_cast<int>(tasks().size()));
  }
}

TEST_CASE("mistakes: a right program makes none, and of one that is not in the catalogue no name is given") {
  for (const zoo::Task& task : tasks()) CHECK(named(task, "").empty());
  int seen = 0, wrongly = 0;
  std::string table;
  for (const char* mistake : test::others_of_edge_table) {
    for (const zoo::Task& task : tasks()) {
      const std::string name = named(task, mistake);
      seen += name != "-";
      if (name == "-" || name.empty()) continue;
      ++wrongly;
      table += std::string("\n") + mistake + ": " + name;
    }
  }
  MESSAGE(wrongly, " of ", seen, " runs with other mistakes get a name", table);
  CHECK(seen > 30);
  CHECK(wrongly == 0);
}

TEST_CASE("mistakes: programs that print less are treated alike") {
  const Program crossings{zoo::crossings, "float32", "direct"}, half_planes{zoo::half_planes, "float64", "direct"};
  struct Wrong {
    const Program& program;
    const char *mistake, *name;  ///< "" where the catalogue does not have it
  };
  std::string table;
  for (const Wrong& one :
       {Wrong{crossings, "farther_wins", "compare_reversed"}, Wrong{crossings, "", ""},
        Wrong{crossings, "z_along_x", ""}, Wrong{crossings, "z_from_the_right", ""},
        Wrong{crossings, "z_of_the_line", ""}, Wrong{crossings, "one_depth_off", ""},
        Wrong{crossings, "colour_of_the_next", "colour_of_next"}, Wrong{crossings, "both_ends_met", ""},
        Wrong{half_planes, "or_equal", "equal_wins"}, Wrong{half_planes, "", ""},
        Wrong{half_planes, "border_for_nobody", "border_for_nobody"},
        Wrong{half_planes, "border_for_all", "border_for_both"}, Wrong{half_planes, "weights_turned", "weights_turned"},
        Wrong{half_planes, "half_the_depth", ""}}) {
    int as_it_is = 0;
    for (const zoo::Task& task : tasks()) {
      if (one.program.run == zoo::half_planes && task.polygons.front().corners.size() > 3) continue;
      const std::string name = named(task, one.mistake, one.program);
      if (name == "-") continue;
      as_it_is += name == one.name;
      // Where other mistakes would give the same, none is named.
      if (name != one.name && !name.empty())
        table += std::string("\n") + one.mistake + ": " + (name.empty() ? "no name" : name);
    }
    CAPTURE(std::string(one.mistake));
    CHECK(as_it_is > 0);
  }
  CHECK_MESSAGE(table.empty(), table);
}

TEST_CASE("mistakes: numbers that are none get no name") {
  const zoo::Task task = test::triangles(6, 6, 22);
  const Trace right = test::trace_of(test::head(task, "float64", "increments") + zoo::edge_table(task));
  for (const bool all : {true, false}) {
    const Trace wrong = test::changed(right, [&](std::int64_t, Event& event) {
      if (!holds<EdgeTableInsert>(event)) return true;
      for (const FieldOfKind& field : fields_of_kind(event.index()))
        if (field.type == FieldOfKind::Type::real && (all || field.name == "dx_dy" || field.name == "dz_dy"))
          field.write(event, std::numeric_limits<double>::quiet_NaN());
      return true;
    });
    const CheckReport report = check(wrong);
    REQUIRE_FALSE(report.causes.empty());
    const std::int64_t first = report.causes.front().first.step;
    CHECK(mistakes::mistakes_of(wrong, first, 0, false, report.precision).empty());
    CHECK_FALSE(mistakes::pair_of(wrong, first, report.precision));
  }
}
