// Methods beside each other on one scene, as numbers and as a file of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "sim/cost/measure.hpp"

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

}  // namespace zstep::compare
