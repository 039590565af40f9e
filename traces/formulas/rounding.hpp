// When a recorded number is what its formula gives: the one tolerance of all commands and of the viewer; and which
// depths a depth buffer can hold.
//
// Of a number that a program has recorded, some last digits are rounding: it may write fewer digits than it computes
// with, multiply before it divides, or go on with what it did not record. So each operand counts as known to so many
// digits, and a result as known to what these leave of it: a difference of two numbers that are nearly equal has few
// digits left, and is held to no more of them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

/// By what share of itself a number may be off. Of the 15.9 digits of float64 nine are asked for, as many as "%.10g"
/// keeps, and of the 7.2 of float32 six.
inline constexpr double rounding_of_float64 = 1e-9, rounding_of_float32 = 1e-6;
/// For the numbers of a trace. A fixed-point number is off by units, whatever its size: see Tolerance.
inline double rounding_of(const Header& header) {
  const NumberFormat format = header.conventions.number_format;
  if (bits_of(format) > 0) return 0.01;
  return format == NumberFormat::float32 ? rounding_of_float32 : rounding_of_float64;
}

/// The distance from a number to the next one of the format; `unit` is that of fixed-point depths.
inline double last_digit(double value, NumberFormat format, double unit) {
  if (unit > 0) return unit;
  const double size = std::abs(value);
  if (format != NumberFormat::float32) return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  const auto narrow = static_cast<float>(size);
  return std::nextafter(narrow, std::numeric_limits<float>::infinity()) - narrow;
}

/// A number, and how far what it was made of lets it be off, as a multiple of the rounding.
struct Rounded {
  double value = 0, spread = 0;
  /// Of a whole number: the least rounding by which what it was made of could have made another one.
  double turns = std::numeric_limits<double>::infinity();

  Rounded() = default;
  Rounded(double known) : value(known), spread(std::abs(known)) {}  // NOLINT: an operand as it stands
  Rounded(double known, double off) : value(known), spread(off) {}
  Rounded(double known, double off, double turning) : value(known), spread(off), turns(turning) {}
};

inline Rounded operator+(Rounded a, Rounded b) {
  return {a.value + b.value, a.spread + b.spread, std::min(a.turns, b.turns)};
}
inline Rounded operator-(Rounded a, Rounded b) {
  return {a.value - b.value, a.spread + b.spread, std::min(a.turns, b.turns)};
}
inline Rounded operator-(Rounded a) { return {-a.value, a.spread}; }
inline Rounded operator*(Rounded a, Rounded b) {
  return {a.value * b.value, a.spread * std::abs(b.value) + b.spread * std::abs(a.value)};
}
inline Rounded operator/(Rounded a, Rounded b) {
  const double value = a.value / b.value;
  return {value, (a.spread + b.spread * std::abs(value)) / std::abs(b.value)};
}
inline Rounded sqrt(Rounded a) {
  const double root = std::sqrt(a.value);
  return {root, root > 0 ? a.spread / (2 * root) : 0};
}
inline Rounded abs(Rounded a) { return {std::abs(a.value), a.spread}; }
/// Whole numbers: which of two it is hangs on the number as it was recorded, unless that is as near to where the other
/// one begins as rounding may move it.
inline Rounded made_whole(double value, const Rounded& made_of, double away) {
  return {value, 0, away == 0 ? 0 : away / made_of.spread};
}
inline double from_whole(double x) { return std::abs(x - std::round(x)); }
inline Rounded floor(Rounded a) { return made_whole(std::floor(a.value), a, from_whole(a.value)); }
inline Rounded ceil(Rounded a) { return made_whole(std::ceil(a.value), a, from_whole(a.value)); }
inline Rounded round(Rounded a) { return made_whole(std::round(a.value), a, 0.5 - from_whole(a.value)); }

/// Is this what the formula gives, but for rounding?
inline bool gives(const Rounded& formula, double recorded, double rounding) {
  if (recorded == formula.value || (std::isnan(recorded) && std::isnan(formula.value))) return true;
  const double off = std::abs(recorded - formula.value);
  if (!std::isfinite(off)) return false;
  return off <= rounding * std::max(std::max(formula.spread, std::abs(formula.value)), std::abs(recorded));
}

/// By how much a recorded number may differ from its formula where the two are shown together. (`zstep check` knows
/// more of each operand, and allows less.)
struct Tolerance {
  double relative = 0, absolute = 0;
  bool allows(const Rounded& formula, double recorded) const {
    return gives(formula, recorded, relative) || std::abs(recorded - formula.value) <= absolute;
  }
};
inline Tolerance tolerance_of(const Scene& scene, const Header& header) {
  const double unit = depth_unit(scene, header.conventions);
  return {rounding_of(header), unit > 0 ? 16 * std::max(unit, 1 / fixed_positions_a_pixel) : 0};
}

// Which depths a depth buffer can hold: how far apart they are, and how many there are.

/// How far apart in z_v two neighbouring numbers of the depth buffer are at this z_v: what it cannot tell apart.
inline double resolution(const Scene& scene, const Conventions& conventions, double z_v) {
  const double depth = buffer_depth(scene.camera, conventions, z_v);
  const double unit = last_digit(depth, conventions.number_format, depth_unit(scene, conventions));
  return std::abs(view_depth_error(scene.camera, conventions, depth, unit));
}

/// How many numbers the depth buffer has between two depths z_v, counting one of the two.
inline double depths_between(const Scene& scene, const Conventions& conventions, double z_v, double other) {
  const double a = buffer_depth(scene.camera, conventions, z_v), b = buffer_depth(scene.camera, conventions, other);
  if (const double unit = depth_unit(scene, conventions); unit > 0) return std::abs(a - b) / unit;
  // The bits of a floating-point number, read as a whole one, count the numbers from 0 to it.
  const auto place = [&](double depth) {
    const double size = conventions.number_format == NumberFormat::float32
                            ? static_cast<double>(std::bit_cast<std::uint32_t>(static_cast<float>(std::abs(depth))))
                            : static_cast<double>(std::bit_cast<std::uint64_t>(std::abs(depth)));
    return depth < 0 ? -size : size;
  };
  return std::abs(place(a) - place(b));
}

/// The z_v between the near plane and the far one that as many of the buffer's depths are nearer than as are farther.
inline double middle_depth(const Scene& scene, const Conventions& conventions) {
  double from = scene.camera.near, to = scene.camera.far;
  const double half = depths_between(scene, conventions, from, to) / 2;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = (from + to) / 2;
    (depths_between(scene, conventions, scene.camera.near, middle) < half ? from : to) = middle;
  }
  return (from + to) / 2;
}

// Fixed-point depths: N bits hold 2ᴺ numbers, 0 for the least depth that there can be and 2ᴺ − 1 for the greatest.
// depth_unit() is how far apart they are.

/// The greatest number that a depth of the format can be, 2ᴺ − 1; 0 where the format is floating point.
constexpr double greatest_number(NumberFormat format) {
  return static_cast<double>((std::uint64_t{1} << bits_of(format)) - 1);
}

/// What fixed-point depths are counted from: the least one between the near plane and the far one; in a screen scene,
/// the least z of its points. depth_range() is the distance from it to the greatest.
double least_depth(const Scene& scene, Conventions::Depth depth);

}  // namespace zstep::formulas

namespace zstep {

// Where a run may have NaN or an infinity: everywhere else a finite number must stand.

/// Of a number that no formula gives: may it be this one, which is not finite? docs/trace-format.md says so of each.
inline bool may_be(const Header& header, std::uint8_t kind, std::string_view field, double value) {
  struct Field {
    std::uint8_t kind;
    std::string_view name;
  };
  // A horizon begins nowhere, nothing was drawn in a tile, nothing is met, nothing is shared, a vertex lies behind the
  // eye, or a ray runs along a plane.
  static constexpr std::array<Field, 9> not_finite{{{kind_of<HorizonMove>, "y_curve"},
                                                    {kind_of<TileDepthTest>, "z_farthest"},
                                                    {kind_of<OverlapTest>, "x_at"},
                                                    {kind_of<OverlapTest>, "y_at"},
                                                    {kind_of<FacingTest>, "projected_normal_z"},
                                                    {kind_of<RayPlane>, "t"},
                                                    {kind_of<RayEnd>, "t"},
                                                    {kind_of<BoxTest>, "t_enter"},
                                                    {kind_of<BoxTest>, "t_leave"}}};
  for (const Field& one : not_finite)
    if (one.kind == kind && one.name == field) return true;
  if (kind == kind_of<BuffersClear>) return std::isinf(value);
  // What is written may be the depth of nothing: a buffer may be cleared pixel by pixel.
  return (kind == kind_of<DepthWrite> || kind == kind_of<PixelPaint>)&&value == header.empty_depth();
}

}  // namespace zstep
