// A surface y = f(x, z) as points and quads.
#pragma once

#include <string>

#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/surface/formula.hpp"

namespace zstep::scene {

/// What a formula alone is sampled on.
inline Surface default_surface() { return {{}, -3, 3, -3, 3, 40, 30}; }

/// Column c has x = x_min + (x_max - x_min) c / (columns - 1), row r the like with z; a single column or row stands at
/// the minimum. The sample's point is (x, z, y) in the world, whose third axis is upwards in Eckert's pictures: the
/// surface is looked at from above. Each cell is a polygon, counter-clockwise seen from above, row after row. Throws
/// InputError where f has no value.
PolygonSoup sample(const Surface& surface, Formula& formula, const std::string& where);

}  // namespace zstep::scene
