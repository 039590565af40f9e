#include "sim/viewer/draw/theme.hpp"

namespace zstep::viewer {
namespace {

constexpr ImU32 rgb(unsigned hex) { return to_im(0xff000000u | hex); }

// Accents: vermilion, blue and purple keep apart for red-green and blue-yellow deficiencies (Okabe and Ito, "Color universal
// design", 2008); darkened a little on white, lightened on black, to hold a contrast of 4.5 : 1 as text.
constexpr Theme light{
    rgb(0xe9e9e6), rgb(0xffffff), rgb(0x161616), rgb(0x5c5c5c), rgb(0xc9c9c4), rgb(0xf3f3f0),
    rgb(0xc24a00), rgb(0xfde7d6),
    rgb(0x00649c), rgb(0xdcedf8),
    rgb(0x8b2f74), rgb(0xf5e1ef),
    rgb(0x00664a), rgb(0xa83a00),
    rgb(0xe4e4e0), rgb(0xd3d9e2),
    rgb(0xb4b4b0),
    rgb(0xececea), rgb(0xd6d6d2),
};
constexpr Theme dark{
    rgb(0x101214), rgb(0x1a1d21), rgb(0xececec), rgb(0xa3a8ad), rgb(0x3a3f45), rgb(0x24282d),
    rgb(0xff9a4d), rgb(0x4a2c14),
    rgb(0x6cc3f5), rgb(0x16374c),
    rgb(0xe79bd0), rgb(0x47213d),
    rgb(0x4fcfa5), rgb(0xff9a6b),
    rgb(0x2d3238), rgb(0x3d4650),
    rgb(0x4a4f55),
    rgb(0x25292e), rgb(0x353a40),
};

}  // namespace

const Theme& light_theme() { return light; }
const Theme& dark_theme() { return dark; }

}  // namespace zstep::viewer
