// Colours. Three accents mean the same in every pane, each with a second sign: now (frame, arrow), changed by this step
// (filled corner), selected (double frame).
#pragma once

#include <array>
#include <imgui.h>

#include "sim/viewer/draw/canvas.hpp"

namespace zstep::viewer {

struct Theme {
  ImU32 window, pane, text, muted, rule, head;  ///< head: behind a pane's title
  ImU32 now, now_soft;                          ///< soft: a band behind text
  ImU32 changed, changed_soft;
  ImU32 selected, selected_soft;
  ImU32 good, bad;  ///< replies to answers
  ImU32 button, button_hovered;
  ImU32 grid;                ///< between a raster's cells
  ImU32 empty, empty_hatch;  ///< a depth of infinity
};

const Theme& light_theme();
const Theme& dark_theme();
/// The one whose ink is read on this colour.
const Theme& theme_on(Pixel32 background);

constexpr Pixel32 to_pixel(ImU32 c) { return 0xff000000u | (c & 0xffu) << 16 | (c & 0xff00u) | (c >> 16 & 0xffu); }
constexpr ImU32 to_im(Pixel32 c) { return 0xff000000u | (c & 0xffu) << 16 | (c & 0xff00u) | (c >> 16 & 0xffu); }

// Depth as colour: near bright yellow, far dark blue, evenly spaced for the eye and safe for colour-blind readers.

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
