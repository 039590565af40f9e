#include "sim/viewer/draw/theme.hpp"

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

}  // namespace zstep::viewer
