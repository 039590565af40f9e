// The comparison table of the lectures (002, "Comparison"), and the scenes to measure it again.
//
// I. E. Sutherland, R. F. Sproull and R. A. Schumacker, "A Characterization of Ten Hidden-Surface Algorithms",
// Computing Surveys 6(1), 1974, estimated it; Foley, van Dam, Feiner and Hughes, "Computer Graphics: Principles and
// Practice", 2nd edition, print it as table 15.3, from where 002 has it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "traces/scene.hpp"

namespace zstep::compare {

/// How many polygons the three columns stand for. 002 prints 250 for the second; the costs fit 2,500: with it the scan
/// line's and Warnock's grow roughly as the square root of the number all the way, 20 and 28 times for 600 times as
/// many.
inline constexpr std::array<int, 3> table_sizes{100, 2500, 60000};
inline constexpr int printed_middle_size = 250;

struct BookRow {
  std::string_view method;      ///< id
  std::array<double, 3> costs;  ///< depth sort of 100 polygons = 1
};
inline constexpr std::array<BookRow, 4> book_table{{{"depth-sort", {1, 10, 507}},
                                                    {"z-buffer", {54, 54, 54}},
                                                    {"scan-line", {5, 21, 100}},
                                                    {"warnock", {11, 64, 307}}}};

/// Triangles anywhere in a box, turned anyhow, as large as it takes for their projections' areas to sum to `layers`
/// times the window whatever their number. Seen in parallel, back faces as well; on a raster of side x side pixels. The
/// same numbers give the same scene.
Scene random_scene(int triangles, double layers, std::int32_t side, unsigned seed);

/// The exponent e for which cost grows as n^e between two measurements.
double growth_exponent(double n_0, double cost_0, double n_1, double cost_1);

}  // namespace zstep::compare
