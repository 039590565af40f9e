// Which compares and writes of a pixel go together: for writes that do not come right after the compare of their own
// pixel, but later or before it, and for pixels whose colour is never written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "traces/file/trace.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

/// What only writes what a compare decided: it comes between a win and the write of its colour.
template <class E>
inline constexpr bool only_writes = std::is_same_v<E, DepthWrite> || std::is_same_v<E, PixelWrite> ||
                                    std::is_same_v<E, ColorWrite> || std::is_same_v<E, AttributeInterpolate>;
/// What comes once a pixel is done: the next one, or something that goes on without any.
template <class E>
inline constexpr bool ends_pixel =
    std::is_same_v<E, DepthInterpolate> || std::is_same_v<E, DepthCompare> || std::is_same_v<E, ScanLineBegin> ||
    std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear>;

/// What a run tells of its pixels' colours only later: gone through before its steps are judged. A write goes with the
/// last compare of its pixel since the polygon began; without one, with the next.
class ColorWrites {
 public:
  explicit ColorWrites(const Trace& trace);

  enum class Early : std::uint8_t { no, wins, loses, never_compared };
  /// Of a write that comes before the compare of its pixel: how that one ends.
  Early early(std::int64_t step) const;
  /// The compare at this step is won, and the pixel's colour is not written.
  bool is_unpainted(std::int64_t step) const { return std::binary_search(unpainted_.begin(), unpainted_.end(), step); }
  /// The last step that ends work on a pixel.
  std::int64_t last_end() const { return last_end_; }
  /// Colours that are still due when the run ends may only be cut off.
  bool all_known() const { return all_known_; }

 private:
  struct EarlyWrite {
    std::int64_t step = 0;
    Early early = Early::no;
  };
  std::vector<EarlyWrite> early_;        ///< by step
  std::vector<std::int64_t> unpainted_;  ///< likewise
  std::int64_t last_end_ = 0;
  bool all_known_ = true;
};

class Wins {
 public:
  explicit Wins(const Trace& trace) : colors_written_(trace) {}

  bool all_known() const { return colors_written_.all_known(); }

  /// A write at another pixel than the one at work is held to have been won there since the polygon began; and before
  /// something else begins the last win is held to have been written, as it is before the next pixel.
  template <class E, class Out>
  void look_at(const E& e, std::int64_t step, const formulas::Situation& at, Out& out) {
    using formulas::Rule;
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, SpanBegin> ||
                  std::is_same_v<E, BuffersClear>)
      if (formulas::detail::last_win_is_missing(at, out)) out.rule(Rule::win_is_written, false);
    // Where its depth is missing, too, that says it.
    if (unpainted_ && (ends_pixel<E> || (!only_writes<E> && step > colors_written_.last_end()))) {
      unpainted_ = false;
      if (!formulas::detail::last_win_is_missing(at, out)) out.rule(Rule::win_is_painted, false);
    }
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>) {
      ++turn_;
    } else if constexpr (std::is_same_v<E, DepthCompare>) {
      const std::size_t pixel = place(at, e.x, e.y);
      depths_[pixel] = colors_[pixel] = blends_[pixel] = e.nearer ? turn_ : 0;
      unpainted_ = colors_written_.is_unpainted(step);
    } else if constexpr (std::is_same_v<E, DepthWrite>) {
      written(depths_, e, at, out);
    } else if constexpr (std::is_same_v<E, ColorBlend>) {
      written(blends_, e, at, out);
    } else if constexpr (std::is_same_v<E, PixelWrite>) {
      const auto early = colors_written_.early(step);
      if (early == ColorWrites::Early::no) written(colors_, e, at, out);
      else out.rule(Rule::write_after_win, early == ColorWrites::Early::wins);
    }
  }

 private:
  std::size_t place(const formulas::Situation& at, std::int32_t x, std::int32_t y) {
    if (depths_.empty()) depths_.resize(at.before.picture.depth.size()), blends_ = colors_ = depths_;
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

  ColorWrites colors_written_;
  std::uint32_t turn_ = 1;  ///< of the polygon at work
  bool unpainted_ = false;  ///< the pixel before was won, and its colour is not written
  /// By pixel, the turn in which it was won and not yet written; else 0.
  std::vector<std::uint32_t> depths_{}, colors_{}, blends_{};
};

}  // namespace zstep
