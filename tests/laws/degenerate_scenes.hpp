// Degenerate input, as scene files, and what is to be seen of it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::test {

/// A raster of 13 x 13 as letters: A for the first polygon of the file, B for the second …, a point for none. Equal
/// rows stand once, with how often; "" is a row without a polygon, and so is every row after the last.
using Rows = std::vector<std::pair<int, std::string>>;

/// What makes two layers equally deep, and so who is seen.
enum class Tie : std::uint8_t {
  none,
  same_numbers,  ///< depths are the same bits: the first of the file
  seen_by_rays,  ///< they are, but for rays: a plane's equation depends on the order of the corners
  rounding,      ///< in one plane that slants: the first of the file where planes are compared, either where pixels are
};

struct Degenerate {
  std::string name;
  std::string polygons;           ///< as in a scene file; at x = 0, z = 0 is the centre of the middle pixel, y is away
  std::vector<Rows> layers = {};  ///< what is nearest; if that is glass, what is next; and so on
  Rows painted = {};              ///< what the painter's algorithm shows, where that is not the nearest
  Tie tie = Tie::none;

  /// Drawn as lines, in parallel, both sides: how many, in how many pieces, and how many pixels are to be seen.
  struct Lines {
    int edges, visible, hidden;
    double length, visible_length;
  } lines{};
};

/// Every class of degenerate input.
const std::vector<Degenerate>& degenerate_inputs();

/// A surface whose curves or cells are degenerate, and its picture by the floating horizon: # from above, o from below.
struct DegenerateSurface {
  std::string name;
  Scene scene;
  std::vector<std::string> drawn;
};
const std::vector<DegenerateSurface>& degenerate_surfaces();

/// The scene of such input, loaded and looked at along y, in parallel or from far away: a unit is a pixel.
Scene degenerate_scene(const std::string& polygons, Camera::Kind kind);

/// The layer's letter at each pixel, row by row, '.' where it has none.
std::string letters_of(const Rows& layer);
/// The same of a picture.
std::string letters_of(const Picture& picture);

}  // namespace zstep::test
