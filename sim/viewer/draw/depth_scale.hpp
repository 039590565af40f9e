// Depth as colour: near bright yellow, far dark blue, evenly spaced for the eye and safe for colour-blind readers.
#pragma once

#include <array>

#include "sim/viewer/draw/canvas.hpp"

namespace zstep::viewer {

class DepthScale {
 public:
  DepthScale();
  /// `t` from 0 (nearest) to 1 (farthest), clamped.
  Pixel32 at(double t) const;

 private:
  std::array<Pixel32, 256> table_{};
};

/// Black or white, whichever reads better on this colour.
bool wants_dark_text(Pixel32 background);

}  // namespace zstep::viewer
