// Which pixels are still to be written, as their depths were found nearer: for writes that do not come right after the
// compare of their own pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

class Wins {
 public:
  /// A write at another pixel than the one at work is held to have been won there since the polygon began; and before
  /// something else begins the last win is held to have been written, as it is before the next pixel.
  template <class E, class Out>
  void look_at(const E& e, const formulas::Situation& at, Out& out) {
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, SpanBegin>)
      if (formulas::detail::last_win_is_missing(at, out)) out.rule(formulas::Rule::win_is_written, false);
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>) {
      ++turn_;
    } else if constexpr (std::is_same_v<E, DepthCompare>) {
      const std::size_t pixel = place(at, e.x, e.y);
      depths_[pixel] = colors_[pixel] = e.nearer ? turn_ : 0;
    } else if constexpr (std::is_same_v<E, DepthWrite>) {
      written(depths_, e, at, out);
    } else if constexpr (std::is_same_v<E, PixelWrite>) {
      written(colors_, e, at, out);
    }
  }

 private:
  std::size_t place(const formulas::Situation& at, std::int32_t x, std::int32_t y) {
    if (depths_.empty()) depths_.resize(at.before.picture.depth.size()), colors_ = depths_;
    return static_cast<std::size_t>(at.pixel(x, y));
  }
  template <class E, class Out>
  void written(std::vector<std::uint32_t>& won, const E& e, const formulas::Situation& at, Out& out) {
    const auto& fragment = at.method().fragment;
    const bool compared = fragment && fragment->nearer, here = at.fragment(e.x, e.y) != nullptr;
    const std::size_t pixel = place(at, e.x, e.y);
    if (compared && !here) out.rule(formulas::Rule::write_after_win, won[pixel] == turn_);
    won[pixel] = 0;
  }

  std::uint32_t turn_ = 1;                      ///< of the polygon at work
  std::vector<std::uint32_t> depths_, colors_;  ///< by pixel, the turn in which it was won and not yet written; else 0
};

}  // namespace zstep
