// The programs of the zoo with the scenes that they draw and the mistakes that they can make; and what zstep finds.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/zoo/programs.hpp"
#include "traces/conventions.hpp"
#include "traces/file/trace.hpp"
#include "traces/grade/grade.hpp"

namespace zstep::test {

/// A program of the zoo, and what the first line of its runs says.
struct ZooProgram {
  const char* method;
  std::string (*run)(const zoo::Task&);
  const char* style = "";
  std::vector<std::pair<std::string, std::string>> options{};  ///< of the method, by which the reference does the same
  bool cull = false;
  bool paints = true;  ///< and so is graded by its picture, too
  NumberFormat number_format = NumberFormat::float64;
  Conventions::Interpolation interpolation = Conventions::Interpolation::direct;
  Conventions::Rounding rounding = Conventions::Rounding::nearest;
  bool short_names = false;  ///< of the steps: those of `head(task, …)`, not the method's own
};
Conventions conventions_of(const ZooProgram& program);
std::string head_of(const ZooProgram& program, const Scene& scene);
std::string printed_by(const ZooProgram& program, const Scene& scene, const std::string& mistake);

struct WrongPrograms {
  const char* what;  ///< as a table calls it
  ZooProgram program;
  std::vector<Scene> scenes;
  std::vector<const char*> mistakes;  ///< of the catalogue, under its names
  std::vector<const char*> others{};  ///< that get no name
  bool at_once = true;                ///< they show at the first wrong step
};
/// Of this method, but for those of the Z-buffer's edges, spans and pixels.
std::vector<WrongPrograms> wrong_programs(const std::string& method);
/// The methods that have some.
inline constexpr const char* methods_with_mistakes[] = {"ray-casting",      "scan-line",  "z-buffer", "warnock",
                                                        "floating-horizon", "depth-sort", "bsp"};
/// Mistakes of the catalogue that zoo::edge_table makes, under the same names, and others.
inline constexpr const char* of_edge_table[] = {
    "horizontal_inserted", "ends_one_late",        "starts_one_early",   "slope_inverted",       "slope_whole",
    "z_slope_of_x",        "z_not_swapped",        "x_at_vertex",        "z_at_vertex",          "stepped_too_early",
    "stepped_twice",       "rounded_then_stepped", "z_not_carried",      "retired_one_late",     "never_retired",
    "not_sorted",          "right_end_included",   "left_end_excluded",  "ends_rounded",         "ends_truncated",
    "z_by_slope_of_x",     "z_by_slope_of_edge",   "z_not_to_centre",    "z_stepped_before_use", "adds_in_float32",
    "compare_reversed",    "equal_wins",           "buffer_begins_at_0", "buffer_reset",         "buffer_of_one_line",
    "written_before_test", "depth_not_written",    "depth_always",       "colour_not_written",   "colour_always",
    "x_y_exchanged",       "y_upside_down"};
inline constexpr const char* others_of_edge_table[] = {
    "swapped_vertex",       "dropped_increment",     "wrong_rounding",      "missing_retirement", "entered_in_front",
    "mean_depth",           "depth_doubled_at_ends", "spans_of_even_lines", "slope_negative",     "z_slope_halved",
    "first_polygon_always", "rows_rounded_down",     "colour_upside_down",  "dz_dx_of_first_span"};
std::vector<Scene> scenes_of_edge_table();
inline const ZooProgram edge_table_program{"z-buffer",
                                           zoo::edge_table,
                                           "",
                                           {},
                                           false,
                                           true,
                                           NumberFormat::float64,
                                           Conventions::Interpolation::increments,
                                           Conventions::Rounding::nearest,
                                           true};

Scene on_the_raster(std::uint64_t seed, int count, int size);

/// What is found of a program that makes a mistake, or none.
struct Found {
  bool shows = false;       ///< it prints something else than the right one
  bool detected = false;    ///< something is wrong
  bool at_once = false;     ///< and that from the first step on that is wrong, or from the one that it shows in
  std::int64_t step = 0;    ///< the first one that is wrong; 0 where none is
  bool full_marks = false;  ///< by the picture, and by each kind of step that is printed
  std::string name;         ///< of the catalogue; "" where none is given
  std::string said;         ///< where it shows, and what was found, for who looks into it
};
Found found_in(const ZooProgram& program, const Scene& scene, const std::string& mistake);

/// Of two mistakes of zoo::edge_table in one program: the one whose first wrong step, alone, comes first is named;
/// where both do at one step, either will do.
struct PairsNamed {
  int right = 0, none = 0, wrong = 0;
  std::string others;  ///< the pairs that are not named rightly, a line each
  int all() const { return right + none + wrong; }
};
PairsNamed pairs_of_edge_table();

/// The first wrong step in words.
std::string said_of(const grade::Divergence& first);
std::string name_of(std::uint8_t kind);
/// The ids of what is named, with a + between two.
std::string named(const grade::Likely& likely);

}  // namespace zstep::test
