// Methods beside each other on one scene, as numbers and as a file of them; and the comparison table of the lectures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "sim/cost/measure.hpp"
#include "traces/scene.hpp"

namespace zstep::compare {

// Who takes part in a race: a method, with something of it other than usual.

struct Entrant {
  const Method* method = nullptr;
  std::vector<Change> changes;  ///< options of the method, and conventions
  std::string text;             ///< "bsp:root=random"
  std::string title;            ///< "BSP tree, root = random"
};

/// "z-buffer", "z-buffer:interpolation=increments". Throws InputError, whose line begins with `who`.
Entrant read_entrant(const std::string& text, const std::string& who = "--race");

/// Each method that can draw a scene, and after it each word that its options and conventions may have instead. The
/// conventions are those of a run of the method named.
std::vector<Entrant> all_entrants(const Scene& scene, const Conventions& conventions);

/// How a picture stands to another one, pixel by pixel (explain_difference has the rule).
struct Agreement {
  std::int64_t pixels = 0;
  std::int64_t equal = 0;               ///< with the same polygon in the same colour
  std::int64_t at_edges = 0, ties = 0;  ///< with another polygon, and both may be right
  std::int64_t unexplained = 0;         ///< with another polygon, and one of them is wrong
  std::int64_t colors = 0;              ///< with the same polygon in another colour

  std::int64_t differing() const { return pixels - equal; }
};
Agreement agreement(const Scene& scene, const Conventions& conventions, const Picture& first, const Picture& other);

struct Compared {
  std::string id;     ///< "bsp", or with its options "bsp:root=random"
  std::string title;  ///< "BSP tree", "BSP tree, root=random"
  Measured measured;
  Agreement agreement;        ///< with the first method's picture
  bool comparable = false;    ///< both are done and have polygons at their pixels
  bool same_shading = false;  ///< and both should have the same colours there
  /// Is there a pixel that nothing explains?
  bool wrong() const { return comparable && agreement.unexplained + (same_shading ? agreement.colors : 0) > 0; }
};

/// The numbers as CSV, one a line: scene,method,measure,step,value. Measures: pixels, equal, differing, at_edges, ties,
/// unexplained, colors, runs, time_s (the median), heap_bytes, steps, count (of the step named). A method that was not
/// done has one line, measure `end`, value `out_of_time` or `failed`.
std::string csv_of(const std::string& scene, const std::vector<Compared>& methods);

/// A cell of CSV: quoted where it must be, on one line, and with nothing that a terminal would act on.
std::string csv_cell(const std::string& raw);

// The comparison table of the lectures (002, "Comparison"), and the scenes to measure it again.
//
// I. E. Sutherland, R. F. Sproull and R. A. Schumacker, "A Characterization of Ten Hidden-Surface Algorithms",
// Computing Surveys 6(1), 1974, estimated it; Foley, van Dam, Feiner and Hughes, "Computer Graphics: Principles and
// Practice", 2nd edition, print it as table 15.3, from where 002 has it.

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
