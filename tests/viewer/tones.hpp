// Colours as they are seen: how far two of them are apart.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "sim/viewer/draw/canvas.hpp"
#include "traces/scene.hpp"

namespace zstep::test {

/// Linear light of a colour of sRGB.
struct Tone {
  double red, green, blue;
  Tone(double r, double g, double b) : red(r), green(g), blue(b) {}
  explicit Tone(Color c) : red(linear(c.red)), green(linear(c.green)), blue(linear(c.blue)) {}
  explicit Tone(viewer::Pixel32 c)
      : red(linear(c >> 16 & 255u)), green(linear(c >> 8 & 255u)), blue(linear(c & 255u)) {}
  double luminance() const { return 0.2126 * red + 0.7152 * green + 0.0722 * blue; }

 private:
  static double linear(double byte) {
    const double c = byte / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
};

/// As WCAG 2 defines it.
inline double contrast(const Tone& a, const Tone& b) {
  const double high = std::max(a.luminance(), b.luminance()), low = std::min(a.luminance(), b.luminance());
  return (high + 0.05) / (low + 0.05);
}

/// In OKLab: 0.02 can just be told apart side by side.
inline double distance(const Tone& p, const Tone& q) {
  const auto lab = [](const Tone& c) {
    const double l = std::cbrt(0.4122214708 * c.red + 0.5363325363 * c.green + 0.0514459929 * c.blue);
    const double m = std::cbrt(0.2119034982 * c.red + 0.6806995451 * c.green + 0.1073969566 * c.blue);
    const double s = std::cbrt(0.0883024619 * c.red + 0.2817188376 * c.green + 0.6299787005 * c.blue);
    return glm::dvec3(0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
                      1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
                      0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s);
  };
  return glm::length(lab(p) - lab(q));
}

/// As a dichromat sees a colour, whose eye lacks one of three receptors (G. M. Machado, M. M. Oliveira and L. A. F.
/// Fernandes, "A physiologically-based model for simulation of color vision deficiency", 2009, severity 1).
enum class Sight { full, protanopia, deuteranopia, tritanopia };
inline Tone as_seen(const Tone& tone, Sight sight) {
  if (sight == Sight::full) return tone;
  // Columns: what red, green and blue light gives.
  static const glm::dmat3 protan(0.152286, 0.114503, -0.003882, 1.052583, 0.786281, -0.048116, -0.204868, 0.099216,
                                 1.051998),
      deutan(0.367322, 0.280085, -0.011820, 0.860646, 0.672501, 0.042940, -0.227968, 0.047413, 0.968881),
      tritan(1.255528, -0.078411, 0.004733, -0.076749, 0.930809, 0.691367, -0.178779, 0.147602, 0.303900);
  const glm::dmat3& matrix = sight == Sight::protanopia ? protan : sight == Sight::deuteranopia ? deutan : tritan;
  const glm::dvec3 seen = glm::clamp(matrix * glm::dvec3(tone.red, tone.green, tone.blue), 0.0, 1.0);
  return {seen.x, seen.y, seen.z};
}
inline constexpr Sight every_sight[] = {Sight::full, Sight::protanopia, Sight::deuteranopia, Sight::tritanopia};

}  // namespace zstep::test
