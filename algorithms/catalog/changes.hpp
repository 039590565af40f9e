// What of a run can be changed, by name: the camera, vertices, colours, the order of polygons, the raster, conventions
// and options. The same names serve the window, the command line (--change) and lessons.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// One thing that is to be other than it was: "theta" and "60", "vertex 3" and "1 0 2.5", "coverage" and "inclusive".
struct Change {
  std::string name, value;
  bool operator==(const Change&) const = default;
};
/// "theta = 60". Throws InputError, the line of which begins with `who`.
Change read_change(std::string_view text, const std::string& who = "--change");

/// Something that can be changed, as it is now.
struct Changeable {
  std::string name, value;
  std::string meaning;                    ///< a phrase, with the unit
  std::vector<std::string> choices = {};  ///< where it is one of some words
  double nudge = 0;                       ///< of a single number, by how much a hand changes it; 0: it is none
};
/// In the order in which a reader looks for them; vertices last, of many the first thousand. Of the vertices of a
/// surface, of a camera that is no place in polar coordinates and of the rest that has no name there are none.
std::vector<Changeable> changeables(const Method& method, const Scene& scene, const Conventions& conventions);

/// Whether a run has something of this name to change.
bool can_change(const Method& method, const Scene& scene, const Conventions& conventions, std::string_view name);

/// Makes a run's scene and conventions so. Throws InputError, with both as they were, where there is no such thing or
/// it cannot be so. A vertex that moves parts its scene from the files that it came from: no vertex has a line there
/// any more. A polygon that is bent by it is cut into triangles (docs/degenerate-input.md).
void make_change(const Method& method, const Change& change, Scene& scene, Conventions& conventions,
                 const std::string& who = "--change");

}  // namespace zstep
