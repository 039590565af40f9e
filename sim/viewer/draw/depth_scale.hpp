// Depth as colour: near bright yellow, far dark blue, evenly spaced for the eye and safe for colour-blind readers.
#pragma once

#include <array>

#include <imgui.h>

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

/// Black or white, whichever has the higher contrast with this colour: at least 4.5 : 1.
ImU32 ink_on(Pixel32 background);

}  // namespace zstep::viewer
