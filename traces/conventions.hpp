// What was interpolated, how, in which numbers, and which pixels it covers: what every trace states about its run
// (docs/trace-format.md, docs/interpolation.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "traces/enumeration.hpp"

namespace zstep {

/// What a run computes in. Its numbers stand in a trace as doubles. fixedN: whole numbers of units, depths from 0 for
/// the least that there can be to 2ᴺ − 1 for the greatest (formulas/fixed_depths.hpp), positions in 1/65536 of a pixel.
enum class NumberFormat : std::uint8_t { float64, float32, fixed16, fixed18, fixed20, fixed24, fixed32 };

/// The bits of a fixed-point depth; 0 where the format is floating point.
constexpr int bits_of(NumberFormat format) {
  constexpr ByEnum<NumberFormat, int, 7> bits{0, 0, 16, 18, 20, 24, 32};
  return bits[format];
}

struct Conventions {
  /// What the depth buffer holds. Under parallel projection each is a linear function of z_v.
  enum class Depth : std::uint8_t {
    pseudodepth,  ///< z* of 003: near −1, far +1
    view,         ///< z_v, interpolated as if it were linear on the picture, as 000 does
    corrected,    ///< z_v once more, but 1/z_v is interpolated and its reciprocal taken at each pixel
    reciprocal,   ///< 1/z_v; greater is nearer
    reversed,     ///< near 1, far 0; greater is nearer
    foley,        ///< of 001, after Foley et al.: near 0, far −1; greater is nearer
    zero_to_one,  ///< near 0, far 1, as Direct3D, Vulkan and the window depth of OpenGL have it
  };
  /// How depths go along edges and spans.
  enum class Interpolation : std::uint8_t {
    direct,            ///< the formula of the line, each time anew
    increments,        ///< by adding slopes
    plane,             ///< from the slopes −A/C and −B/C of the polygon's plane, each time anew
    plane_increments,  ///< by adding those, from pixel to pixel and from line to line (004)
  };
  enum class Coverage : std::uint8_t {
    top_left,         ///< centres inside; of those on an edge, the left and the upper ones
    inclusive,        ///< the textbook's `for x = x_L to x_R`, and the last scan line too
    round,            ///< round(x_L) … round(x_R)
    ceil_floor,       ///< ceil(x_L) … floor(x_R)
    round_half_open,  ///< round(x_L) … round(x_R) - 1
  };
  enum class Rounding : std::uint8_t { nearest, down };  ///< of fixed-point quotients
  /// Of vertices on the raster: as they are, or at the nearest whole pixel, or 256th of one, as GPUs have it.
  enum class Positions : std::uint8_t { exact, integer, subpixels, sixteenths };
  /// How an attribute of the vertices goes over a polygon, and shades it: x_w, as a texture coordinate.
  enum class Attribute : std::uint8_t {
    none,         ///< polygons have one colour
    linear,       ///< as it stands, as if it were linear on the picture
    perspective,  ///< by way of a/z_v and 1/z_v, which are
  };

  Depth depth = Depth::pseudodepth;
  Interpolation interpolation = Interpolation::direct;
  Coverage coverage = Coverage::top_left;
  NumberFormat number_format = NumberFormat::float64;
  Rounding rounding = Rounding::nearest;
  Positions positions = Positions::exact;
  Attribute attribute = Attribute::none;
  bool cull = true;  ///< back faces are dropped
  /// The method's own options that were given, by name ("root" -> "random"); those left out have their standard values.
  std::map<std::string, std::string> options;
  bool operator==(const Conventions&) const = default;
};

// As in a trace's header; the command line has "-" for "_".
template <>
inline constexpr std::array<std::string_view, 7> words_of<Conventions::Depth>{
    "pseudodepth", "view", "corrected", "reciprocal", "reversed", "foley", "zero_to_one"};
template <>
inline constexpr std::array<std::string_view, 4> words_of<Conventions::Interpolation>{"direct", "increments", "plane",
                                                                                      "plane_increments"};
template <>
inline constexpr std::array<std::string_view, 5> words_of<Conventions::Coverage>{"top_left", "inclusive", "round",
                                                                                 "ceil_floor", "round_half_open"};
template <>
inline constexpr std::array<std::string_view, 7> words_of<NumberFormat>{"float64", "float32", "fixed16", "fixed18",
                                                                        "fixed20", "fixed24", "fixed32"};
template <>
inline constexpr std::array<std::string_view, 2> words_of<Conventions::Rounding>{"nearest", "down"};
template <>
inline constexpr std::array<std::string_view, 4> words_of<Conventions::Positions>{"exact", "integer", "subpixels",
                                                                                  "sixteenths"};
template <>
inline constexpr std::array<std::string_view, 3> words_of<Conventions::Attribute>{"none", "linear", "perspective"};

/// Calls visit(key, member) for each convention that is one of some words. The first three are those that all methods
/// with edges and spans have; the others the Z-buffer alone.
template <class Visit>
void for_each_convention(Visit&& visit) {
  visit("depth", &Conventions::depth);
  visit("interpolation", &Conventions::interpolation);
  visit("coverage", &Conventions::coverage);
  visit("number_format", &Conventions::number_format);
  visit("rounding", &Conventions::rounding);
  visit("positions", &Conventions::positions);
  visit("attribute", &Conventions::attribute);
}

/// Some conventions that are to be other than they were.
struct ConventionChoices {
  std::map<std::string, std::string, std::less<>> words;  ///< by key, as words_of has them

  void apply(Conventions& conventions) const {
    for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
      const auto given = words.find(key);
      if (given == words.end()) return;
      if (const auto value = value_called<E>(given->second)) conventions.*member = *value;
    });
  }
};

/// The parts of a pixel at which vertices lie; 0 where they lie anywhere.
constexpr int parts_of_pixel(Conventions::Positions positions) {
  constexpr ByEnum<Conventions::Positions, int> parts{0, 1, 256, 16};
  return parts[positions];
}

/// Are x and z computed by adding to what they were?
inline bool adds_slopes(const Conventions& conventions) {
  using enum Conventions::Interpolation;
  return conventions.interpolation == increments || conventions.interpolation == plane_increments;
}

/// Is of two such depths the greater one nearer?
constexpr bool greater_is_nearer(Conventions::Depth depth) {
  using enum Conventions::Depth;
  return depth == reciprocal || depth == reversed || depth == foley;
}

}  // namespace zstep
