// Are the pixels of a run those that its scene has? Which ones each facet covers, how deep it is there, and which is
// seen: from the scene, the header's conventions and the facet at work alone, however the run computes them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "traces/check/check.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

class ScenePixels {
  using Cover = formulas::DrawnFacet::Cover;
  using Rule = formulas::Rule;
  using Situation = formulas::Situation;

 public:
  /// Of methods that draw one polygon after another and compare depths.
  ScenePixels(const Trace& trace, const Header& header)
      : turn_of_(trace.has(AtPixel::verdict)            ? AtPixel::verdict
                 : trace.has(kind_of<DepthInterpolate>) ? AtPixel::depth
                 : trace.has(AtPixel::colors)           ? AtPixel::colors
                                                        : AtPixel::keeps),
        judges_(trace.has(kind_of<PolygonBegin>) && trace.has(turn_of_) && records<DepthCompare>(header) &&
                !records<PieceDraw>(header)),
        whole_(header.declares(Convention::coverage)),
        told_(judges_ ? pixel_count(trace.scene().raster.width, trace.scene().raster.height) : 0),
        begun_(trace.scene().facets.size()),
        trace_(trace) {}

  template <class E, class Out>
  void look_at(const E& e, const Situation& at, Out& out) {
    if (!judges_) return;
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>) {
      if (out.is_clean()) end_facet(at, out);
      ++turn_, inside_ = 0, open_ = std::is_same_v<E, PolygonBegin>, last_ = {-1, -1}, hidden_.clear();
      if constexpr (std::is_same_v<E, BuffersClear>) seen_.clear();
      if constexpr (std::is_same_v<E, PolygonBegin>)
        if (e.facet >= 0 && e.facet < std::ssize(begun_)) begun_[e.facet] = true;
    } else if constexpr (std::is_same_v<E, TileDepthTest>) {
      if (!e.nearer) hidden_.push_back(e);
    } else if constexpr (at_pixel<E> != AtPixel::nothing) {
      pixel(e, at, out);
    } else if (!out.is_clean()) {
      open_ = false;
    }
  }

  /// The run is over. What would still have come may be cut off: only what others came before is missing.
  template <class Out>
  void end(const Situation& at, Out& out) {
    if (!judges_) return;
    is_over_ = true;
    end_facet(at, out);
    std::size_t last = begun_.size();
    while (last > 0 && !begun_[last - 1]) --last;
    for (std::size_t facet = 0; facet < last; ++facet) {
      if (begun_[facet]) continue;
      const auto drawn = formulas::DrawnFacet::from_scene(at.scene, at.header, index32(facet), at.roundoff);
      if (!drawn || drawn->pixels_inside() == 0 || is_dropped(*drawn, at)) continue;
      if (!may_go_through(drawn->pixels_inside(), at)) return void(whole_ = false);
      Fault fault;
      fault.facet = index32(facet);
      drawn->each_pixel([&](std::int32_t x, std::int32_t y, Cover cover) {
        if (cover == Cover::inside && !fault.pixel) fault.pixel = Trace::Pixel{x, y};
      });
      out.rule(Rule::facet_is_drawn, false, fault);
    }
  }
  /// Need a run not draw the facet: it faces away, or has no pixel for certain?
  bool may_be_left_out(std::int32_t facet, const Situation& at) const {
    if (!judges_) return false;
    const auto drawn = formulas::DrawnFacet::from_scene(at.scene, at.header, facet, at.roundoff);
    return drawn && (is_dropped(*drawn, at) || drawn->pixels_inside() == 0);
  }
  /// Each pixel that is missing or too many would have been found.
  bool judges_all() const { return judges_ && whole_; }

 private:
  /// When a pixel was mentioned last, and whether it was compared, or painted, then.
  struct Told {
    std::uint32_t turn : 31 = 0;  ///< of the facet at work
    std::uint32_t had_turn : 1 = 0;
  };
  /// A depth as far as the scene says it: of a facet, or the nearest one so far at a pixel.
  struct Depth {
    double low, high;
  };

  static bool is_dropped(const formulas::DrawnFacet& facet, const Situation& at) {
    return facet.faces_away() && (at.header.conventions.cull || !at.header.declares(Convention::cull));
  }
  bool compares() const { return has(turn_of_, AtPixel::depth | AtPixel::verdict); }

  template <class E, class Out>
  void pixel(const E& e, const Situation& at, Out& out) {
    if (out.breaks(Rule::pixel_in_span)) open_ = false;
    if (at.method().pass == Pass::light) return;
    const formulas::DrawnFacet* facet = at.drawn_facet();
    if (!facet) return void(whole_ = whole_ && at.method().rejected);
    Told& told = told_[at.pixel(e.x, e.y)];
    const bool is_first = told.turn != (turn_ & most_turns);
    if (is_first) told.turn = turn_ & most_turns, told.had_turn = 0;
    const bool has_turn = has(at_pixel<E>, turn_of_);
    const bool is_turn = has_turn && told.had_turn == 0;
    if (is_turn) {
      told.had_turn = 1;
      come(e.x, e.y);
      inside_ += facet->cover(e.x, e.y) == Cover::inside;
      if (!compares()) paint(*facet, e.x, e.y, at, out);
    }
    const bool is_asked = compares() ? is_first && has(at_pixel<E>, AtPixel::depth) : is_turn;
    if (is_asked && open_ && out.is_clean()) {
      const bool back = facet->faces_away() && at.header.conventions.cull && at.header.declares(Convention::cull) &&
                        !at.method().rejected;
      out.rule(Rule::back_is_dropped, !back);
      if (!back) out.rule(Rule::pixel_on_facet, facet->cover(e.x, e.y) != Cover::outside);
    }
    // Where the run has what the depth was computed from, it has been held against that.
    if constexpr (requires { e.z; } && is_of_fragment(at_pixel<E>)) {
      const bool follows = std::is_same_v<E, DepthCompare> && at.fragment(e.x, e.y) && !at.fragment(e.x, e.y)->nearer;
      if ((at.records<SpanBegin>() || at.method().slopes) && !follows && out.is_clean())
        out.judged_by_scene([&] { formulas::detail::derive_depth_in_scene(e, at, out); });
    }
  }

  /// What every pixel of a facet that is over should have had.
  template <class Out>
  void end_facet(const Situation& at, Out& out) {
    if (!open_ || at.method().polygon == no_polygon || at.method().rejected) return;
    const formulas::DrawnFacet* facet = at.drawn_facet();
    if (!facet) return void(whole_ = false);
    if (is_dropped(*facet, at)) return;
    const bool goes_through = !compares() || inside_ < facet->pixels_inside();
    if (goes_through && begins_again(at.method().facet)) return void(whole_ = false);
    if (goes_through && !may_go_through(facet->pixels_inside(), at)) return void(whole_ = false);
    if (!compares()) return end_painted(*facet, at, out);
    Fault fault;
    if (goes_through)
      facet->each_pixel([&](std::int32_t x, std::int32_t y, Cover cover) {
        if (cover == Cover::inside) note_missing(fault, x, y, at);
      });
    out.rule(Rule::pixel_is_drawn, !fault.pixel, fault);
  }
  /// Where work goes line by line, a facet begins several times, each time with a part of its pixels.
  bool begins_again(std::int32_t facet) {
    if (begin_again_.empty()) {
      std::vector<bool> begin(begun_.size());
      begin_again_ = begin;
      trace_.next<PolygonBegin>(0, [&](const PolygonBegin& e) {
        if (e.facet < 0 || e.facet >= std::ssize(begin)) return false;
        if (begin[e.facet]) begin_again_[e.facet] = true;
        begin[e.facet] = true;
        return false;
      });
    }
    return begin_again_[facet];
  }
  /// A run of few steps may begin large facets without end, and leave out their pixels.
  bool may_go_through(std::int64_t pixels, const Situation& at) {
    pixels_seen_ += pixels;
    return pixels_seen_ <= 64 * at.before.position + 4 * std::ssize(told_) + 1'000'000;
  }
  /// Do the pixels of each facet come row by row, from the top or from the bottom?
  void come(std::int32_t x, std::int32_t y) {
    const bool first = last_.y < 0, along = y == last_.y && x > last_.x;
    comes_in_order_ = comes_in_order_ || !first;
    downwards_ = downwards_ && (first || y > last_.y || along);
    upwards_ = upwards_ && (first || y < last_.y || along);
    last_ = {x, y};
  }
  /// Is it one that would have come before the last one?
  bool was_due(std::int32_t x, std::int32_t y) const {
    const bool along = y == last_.y && x < last_.x;
    const bool from_top = y < last_.y || along, from_bottom = y > last_.y || along;
    return comes_in_order_ && (downwards_ || upwards_) && (from_top || !downwards_) && (from_bottom || !upwards_);
  }
  void note_missing(Fault& fault, std::int32_t x, std::int32_t y, const Situation& at) {
    const Told& told = told_[at.pixel(x, y)];
    if (told.turn == (turn_ & most_turns) && told.had_turn != 0) return;
    if (is_over_ && !was_due(x, y)) return void(whole_ = false);
    const auto is_in = [&](const TileDepthTest& tile) {
      return x >= tile.first_column && x < tile.end_column && y >= tile.first_row && y < tile.end_row;
    };
    if (std::any_of(hidden_.begin(), hidden_.end(), is_in)) return;
    if (!fault.pixel) fault.pixel = Trace::Pixel{x, y};
    else ++fault.more_pixels;
  }

  // Where no depth is compared in the run, which facet is seen follows from the scene.

  static std::optional<Depth> depth_at(const formulas::DrawnFacet& facet, std::int32_t x, std::int32_t y,
                                       const Situation& at) {
    if (!facet.has_depth() || !at.header.declares(Convention::nearer)) return std::nullopt;
    const double linear = facet.linear_at(x, y), off = facet.off();
    Depth depth{linear - off, linear + off};
    if (at.header.conventions.depth == Conventions::Depth::corrected) depth = {1 / depth.high, 1 / depth.low};
    // As if smaller were nearer.
    if (at.header.comparison.nearer == Comparison::Nearer::greater) depth = {-depth.high, -depth.low};
    return depth;
  }
  std::vector<Depth>& seen() {
    constexpr double none = std::numeric_limits<double>::infinity();
    if (seen_.empty()) seen_.assign(told_.size(), {none, none});
    return seen_;
  }
  template <class Out>
  void paint(const formulas::DrawnFacet& facet, std::int32_t x, std::int32_t y, const Situation& at, Out& out) {
    const auto depth = depth_at(facet, x, y, at);
    if (depth && out.is_clean()) out.rule(Rule::nearest_is_kept, depth->low <= seen()[at.pixel(x, y)].high);
  }
  template <class Out>
  void end_painted(const formulas::DrawnFacet& facet, const Situation& at, Out& out) {
    Fault fault;
    facet.each_pixel([&](std::int32_t x, std::int32_t y, Cover cover) {
      const auto depth = depth_at(facet, x, y, at);
      if (!depth) return;
      Depth& nearest = seen()[at.pixel(x, y)];
      if (cover == Cover::inside && depth->high < nearest.low) note_missing(fault, x, y, at);
      nearest.low = std::min(nearest.low, depth->low);
      if (cover == Cover::inside) nearest.high = std::min(nearest.high, depth->high);
    });
    out.rule(Rule::nearer_is_painted, !fault.pixel, fault);
  }

  AtPixel turn_of_;  ///< what a pixel's turn is: a compare, or where the run has none, a depth or a write
  bool judges_;
  bool whole_;         ///< nothing has been left open
  bool open_ = false;  ///< nothing is wrong with what the pixels of the facet at work come from
  bool is_over_ = false;
  bool downwards_ = true, upwards_ = true;  ///< see come()
  bool comes_in_order_ = false;             ///< of some facet there were two pixels, so that one shows
  Trace::Pixel last_{-1, -1};               ///< of the facet at work
  static constexpr std::uint32_t most_turns = (std::uint32_t{1} << 31) - 1;
  std::uint32_t turn_ = 1;
  std::int64_t pixels_seen_ = 0;  ///< that were gone through where they are not in the run
  std::int64_t inside_ = 0;       ///< pixels of the facet at work that had their turn and are its own for certain
  std::vector<Told> told_;
  std::vector<TileDepthTest> hidden_ = {};  ///< tiles of the facet at work that were rejected by their depths
  std::vector<bool> begun_;                 ///< by facet
  std::vector<bool> begin_again_ = {};      ///< likewise, once it is asked for
  const Trace& trace_;
  std::vector<Depth> seen_ = {};
};

}  // namespace zstep
