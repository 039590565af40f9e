// A scene that is one surface y = f(x, z): its formula, sampled.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/load.hpp"

namespace zstep::scene {

// A formula in x and z, as a person types it: "sin(x) * cos(z)".

/// Numbers, x, z, pi, e, + - * / ^ ( ) and a fixed list of functions; angles in radians. Evaluated as it is written, by
/// portable functions, so that the same formula gives the same bits everywhere.
class Formula {
 public:
  /// A "y =" before it is passed over. Throws InputError at `where` (FILE:LINE, or what the command line calls it) that
  /// names the formula and the character at fault.
  Formula(std::string_view text, const std::string& where);
  ~Formula();
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  /// f(x, z); throws InputError where that is no finite number of ordinary size.
  double at(double x, double z);

  /// Without "y =" and the blanks around it.
  const std::string& text() const { return text_; }

 private:
  struct Parser;
  std::string text_, where_;
  std::unique_ptr<Parser> parser_;
};

/// Whether a scene's name is a formula: "y = …".
bool is_formula(std::string_view name);

// A surface y = f(x, z) as points and quads.

/// What a formula alone is sampled on.
inline Surface default_surface() { return {{}, -3, 3, -3, 3, 40, 30}; }

/// Column c has x = x_min + (x_max - x_min) c / (columns - 1), row r the like with z; a single column or row stands at
/// the minimum. The sample's point is (x, z, y) in the world, whose third axis is upwards in Eckert's pictures: the
/// surface is looked at from above. Each cell is a polygon, counter-clockwise seen from above, row after row. Throws
/// InputError where f has no value.
PolygonSoup sample(const Surface& surface, Formula& formula, const std::string& where);

/// Samples `surface` into `file`, whose camera, raster and conventions stay as they are. Throws InputError at `where`
/// for a formula that cannot be read or has no value somewhere.
SceneFile surface_scene(Surface surface, const std::string& where, SceneFile file, const SceneBuilder::Style& style);

/// The scene that a formula alone stands for: default ranges, seen from above.
SceneFile formula_scene(const std::string& formula);

}  // namespace zstep::scene
