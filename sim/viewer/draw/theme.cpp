// The scale runs on a straight road through OKLab (B. Ottosson, "A perceptual color space for image processing", 2020):
// lightness falls evenly from near to far while the hue goes from yellow to blue, the two hues that the common colour
// deficiencies keep apart. Lightness alone orders it, so it survives a grey copy.

#include "sim/viewer/draw/theme.hpp"

#include <algorithm>
#include <cmath>

#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

constexpr ImU32 rgb(unsigned hex) { return to_im(0xff000000u | hex); }

// Accents: pink, green and violet, far from every colour that polygons get (those of Okabe and Ito, "Color universal
// design", 2008) and from each other, with a contrast of 4.5 : 1 as text. A test measures all three.
constexpr Theme light{
    rgb(0xe9e9e6), rgb(0xffffff), rgb(0x161616), rgb(0x5c5c5c), rgb(0xc9c9c4), rgb(0xf3f3f0), rgb(0xcc0066),
    rgb(0xfbe3ee), rgb(0x0a4d00), rgb(0xe0f0d8), rgb(0x7000ff), rgb(0xefe6ff), rgb(0x00664a), rgb(0xa83a00),
    rgb(0xe4e4e0), rgb(0xd3d9e2), rgb(0xb4b4b0), rgb(0xececea), rgb(0xd6d6d2),
};
constexpr Theme dark{
    rgb(0x101214), rgb(0x1a1d21), rgb(0xececec), rgb(0xa3a8ad), rgb(0x3a3f45), rgb(0x24282d), rgb(0xff2ea6),
    rgb(0x3e112b), rgb(0x40e040), rgb(0x163c1a), rgb(0xa46cff), rgb(0x2b1a4d), rgb(0x4fcfa5), rgb(0xff9a6b),
    rgb(0x2d3238), rgb(0x3d4650), rgb(0x4a4f55), rgb(0x25292e), rgb(0x353a40),
};

}  // namespace

const Theme& light_theme() { return light; }
const Theme& dark_theme() { return dark; }

namespace {

struct Lab {
  double L, a, b;
};

double encoded(double linear) {
  linear = std::clamp(linear, 0.0, 1.0);
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * portable::pow(linear, 1 / 2.4) - 0.055;
}

Pixel32 to_srgb(const Lab& c) {
  const double l = portable::pow(c.L + 0.3963377774 * c.a + 0.2158037573 * c.b, 3);
  const double m = portable::pow(c.L - 0.1055613458 * c.a - 0.0638541728 * c.b, 3);
  const double s = portable::pow(c.L - 0.0894841775 * c.a - 1.2914855480 * c.b, 3);
  const auto byte = [](double linear) { return nearest_byte(encoded(linear) * 255); };
  return opaque({byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                 byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                 byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)});
}

}  // namespace

DepthScale::DepthScale() {
  constexpr Lab near{0.94, -0.03, 0.155}, middle{0.62, -0.005, 0.0}, far{0.27, -0.015, -0.115};
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double t = ratio(i, 255);
    const Lab& from = t < 0.5 ? near : middle;
    const Lab& to = t < 0.5 ? middle : far;
    const double u = t < 0.5 ? 2 * t : 2 * t - 1;
    table_[i] = to_srgb({from.L + (to.L - from.L) * u, from.a + (to.a - from.a) * u, from.b + (to.b - from.b) * u});
  }
}

Pixel32 DepthScale::at(double t) const {
  if (!(t > 0)) t = 0;
  return table_[std::lround(std::min(t, 1.0) * 255)];
}

ImU32 ink_on(Pixel32 background) {
  const auto linear = [](unsigned byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : portable::pow((c + 0.055) / 1.055, 2.4);
  };
  const double luminance = 0.2126 * linear(background >> 16 & 255u) + 0.7152 * linear(background >> 8 & 255u) +
                           0.0722 * linear(background & 255u);
  // Where (L + 0.05) / 0.05 = 1.05 / (L + 0.05), and so at least 4.58 on either side (WCAG 2).
  return luminance > std::sqrt(1.05 * 0.05) - 0.05 ? IM_COL32(0, 0, 0, 255) : IM_COL32(255, 255, 255, 255);
}

const Theme& theme_on(Pixel32 background) {
  return ink_on(background) == IM_COL32(0, 0, 0, 255) ? light_theme() : dark_theme();
}

}  // namespace zstep::viewer
