// Colours: by name, from the palette, and shaded for surfaces that bring none.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "traces/scene.hpp"

namespace zstep::scene {

/// Eight colours that people with any of the common kinds of colour blindness tell apart: M. Okabe and K. Ito, "Color
/// Universal Design", 2002 (2008), with a grey in place of their black, which is kept for lines and text.
inline constexpr std::array<Color, 8> palette{{{230, 159, 0},
                                               {86, 180, 233},
                                               {0, 158, 115},
                                               {240, 228, 66},
                                               {0, 114, 178},
                                               {213, 94, 0},
                                               {204, 121, 167},
                                               {153, 153, 153}}};

/// A colour as scene files write it: "#rrggbb", "#rgb" or a name. Nothing if it is neither.
std::optional<Color> color_from_text(std::string_view text);

struct NamedColor {
  std::string_view name;
  Color color;
};
std::span<const NamedColor> named_colors();

/// What a surface without colours is made of.
inline constexpr Color clay{176, 196, 214};

/// The colour of a flat surface under a light that is fixed in the world, so that turning the camera does not change
/// it: brightness (1 + n·l)/2 (Valve's "half Lambert"), so that sides in the shade still differ. `normal` need not be
/// of unit length; of length zero, the surface counts as seen sideways.
Color shaded(Color base, glm::dvec3 normal);

}  // namespace zstep::scene
