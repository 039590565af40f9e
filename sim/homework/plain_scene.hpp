// A scene as students' programs get it: polygons that a program can be asked to draw, in plain numbers.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

/// What a homework asks of the polygons of its scenes.
struct PolygonsAsked {
  enum class Space : std::uint8_t {
    as_given,  ///< nothing is done to the scene: programs read its file
    world,     ///< rays meet the polygons where they are
    screen,    ///< viewing is no part of the homework: polygons are handed out culled, clipped and projected
  };
  Space space = Space::as_given;
  bool convex = false;  ///< concave ones are cut into triangles
  bool planar = false;  ///< so are those whose vertices leave their plane by more than rounding
};

/// What a method whose homework prints these kinds of steps asks, under these conventions, of which those in `free` are
/// a program's own choice; all but `convex`, which the homework itself says.
PolygonsAsked polygons_asked(const Method& method, const Conventions& conventions,
                             const std::set<std::uint8_t>& printed, const std::vector<std::string>& free);

/// The scene with polygons of which each is one facet and can be seen: those that have no area or are seen edge-on are
/// left out, those that are not planar are several. They are numbered anew, in their order, so that a program may call
/// polygon and facet by the same number. A scene that is so already stays as it is. Throws InputError, at the scene's
/// file, where nothing is left or concave polygons would take too long to cut.
Scene scene_for_programs(Scene scene, const Conventions& conventions, const PolygonsAsked& asked);

/// Why programs cannot be given such a scene in plain numbers, for a method that needs more of its camera than they
/// say; empty where they can.
std::string why_not_plain(const Method& method, const Scene& scene);

/// A scene as programs read it: width and height, the points, each polygon as the number of its vertices and these, and
/// the colours, for programs that draw: of the background and of each polygon. Then, of a scene in space, the rays
/// through the pixels' centres: X_0 of pixel (0, 0), its change by a column and by a row, the same of dX, and the least
/// and the greatest t. For a method that draws surfaces: width and height, how many rows of how many samples, the
/// points of these, T_v, d, half the height of the window, near and far.
std::string plain_numbers(const Method& method, const Scene& scene);

}  // namespace zstep::homework
