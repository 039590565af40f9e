// What is asked of a polygon's pixels as a whole: which compares and writes go together, and whether all pixels are
// there, from the outline to the edge table, the spans and the pixels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "traces/file/trace.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/formulas/of_edges.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

/// What only writes what a compare decided: it comes between a win and the write of its colour.
template <class E>
inline constexpr bool only_writes = std::is_same_v<E, DepthWrite> || std::is_same_v<E, PixelWrite> ||
                                    std::is_same_v<E, ColorWrite> || std::is_same_v<E, AttributeInterpolate>;
/// What comes once a pixel is done: the next one, or something that goes on without any.
template <class E>
inline constexpr bool ends_pixel = is_of_fragment(at_pixel<E>) || std::is_same_v<E, ScanLineBegin> ||
                                   std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear>;

/// What a run tells of its pixels' colours, and depths, only later. A write goes with the last compare of its pixel
/// since the polygon began; without one, with the next.
class ColorWrites {
 public:
  explicit ColorWrites(const Trace& trace);

  enum class Early : std::uint8_t { no, wins, loses, never_compared };
  /// Of a write that comes before the compare of its pixel: how that one ends.
  Early early(std::int64_t step) const;
  /// The compare at this step is won, and the pixel's colour is not written.
  bool is_unpainted(std::int64_t step) const { return std::binary_search(unpainted_.begin(), unpainted_.end(), step); }
  /// The same of its depth.
  bool is_unwritten(std::int64_t step) const { return std::binary_search(unwritten_.begin(), unwritten_.end(), step); }
  /// The last step that ends work on a pixel.
  std::int64_t last_end() const { return last_end_; }
  /// Colours that are still due when the run ends may only be cut off.
  bool all_known() const { return all_known_; }

 private:
  struct EarlyWrite {
    std::int64_t step = 0;
    Early early = Early::no;
  };
  std::vector<EarlyWrite> early_;                    ///< by step
  std::vector<std::int64_t> unpainted_, unwritten_;  ///< likewise
  std::int64_t last_end_ = 0;
  bool all_known_ = true;
};

class Wins {
 public:
  explicit Wins(const Trace& trace)
      : trace_(trace),
        has_colors_(trace.has(kind_of<PixelWrite>)),
        has_depths_(trace.has(kind_of<DepthWrite>)),
        all_at_once_(trace.has(AtPixel::verdict)) {}

  bool all_known() { return (all_at_once_ && !unpainted_ && !unwritten_) || later().all_known(); }
  std::optional<Trace::Pixel> last_compared() const { return last_compared_; }

  /// A write at another pixel than the one at work is held to have been won there since the polygon began; and before
  /// something else begins the last win is held to have been written, as it is before the next pixel.
  template <class E, class Out>
  void look_at(const E& e, std::int64_t step, const formulas::Situation& at, Out& out) {
    using formulas::Rule;
    constexpr bool begins = std::is_same_v<E, PolygonBegin> || std::is_same_v<E, ScanLineBegin> ||
                            std::is_same_v<E, SpanBegin> || std::is_same_v<E, BuffersClear>;
    // Whether the depth at the pixel at work is missing.
    const bool asks = begins || std::is_same_v<E, DepthInterpolate> ||
                      (has(at_pixel<E>, AtPixel::verdict) && !at.template records<DepthInterpolate>());
    const bool missing = asks && formulas::detail::last_win_is_missing(at, out);
    if constexpr (begins)
      if (missing) out.rule(Rule::win_is_written, false);
    if constexpr (ends_pixel<E>)
      if (std::exchange(unwritten_, false) && later().is_unwritten(win_) && !asks)
        out.rule(Rule::win_is_written, false);
    // Where its depth is missing, too, that says it.
    if (unpainted_ && (ends_pixel<E> || (!only_writes<E> && step > later().last_end()))) {
      unpainted_ = false;
      if (later().is_unpainted(win_) && !missing) out.rule(Rule::win_is_painted, false);
    }
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>) {
      ++turn_;
    } else if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
      const std::size_t pixel = place(at, e.x, e.y);
      depths_[pixel] = colors_[pixel] = blends_[pixel] = e.nearer ? turn_ : 0;
      last_compared_ = Trace::Pixel{e.x, e.y}, win_ = step;
      const bool wins = e.nearer && at.method().pass != Pass::light;
      unpainted_ = wins && has_colors_, unwritten_ = wins && has_depths_ && at.stored(e.x, e.y) != e.z;
    } else if constexpr (std::is_same_v<E, DepthWrite>) {
      if (is_last_compared(e.x, e.y)) unwritten_ = false;
      written(depths_, e, at, out);
    } else if constexpr (std::is_same_v<E, ColorBlend>) {
      written(blends_, e, at, out);
    } else if constexpr (std::is_same_v<E, PixelWrite>) {
      // The write that the win of the pixel at work waits for.
      const bool is_due = unpainted_ && is_last_compared(e.x, e.y);
      if (is_due) unpainted_ = false;
      const auto early = is_due ? ColorWrites::Early::no : later().early(step);
      if (early == ColorWrites::Early::no) written(colors_, e, at, out);
      else out.rule(Rule::write_after_win, early == ColorWrites::Early::wins);
    } else if constexpr (std::is_same_v<E, ColorWrite>) {
      if (is_last_compared(e.x, e.y)) unpainted_ = false;
    }
  }

 private:
  std::size_t place(const formulas::Situation& at, std::int32_t x, std::int32_t y) {
    if (depths_.empty()) depths_.resize(at.before.picture.depth.size()), blends_ = colors_ = depths_;
    return at.pixel(x, y);
  }
  template <class E, class Out>
  void written(std::vector<std::uint32_t>& won, const E& e, const formulas::Situation& at, Out& out) {
    const auto& fragment = at.method().fragment;
    const bool compared = fragment && fragment->nearer, here = at.fragment(e.x, e.y) != nullptr;
    const std::size_t pixel = place(at, e.x, e.y);
    if (compared && !here) out.rule(formulas::Rule::write_after_win, won[pixel] == turn_);
    won[pixel] = 0;
  }

  bool is_last_compared(std::int32_t x, std::int32_t y) const {
    return last_compared_ && last_compared_->x == x && last_compared_->y == y;
  }
  /// Goes through the run, once: of most each write comes before the next pixel's turn, and it is never asked.
  const ColorWrites& later() {
    all_at_once_ = false;
    if (!later_) later_.emplace(trace_);
    return *later_;
  }

  const Trace& trace_;
  bool has_colors_, has_depths_;  ///< the run has steps that write them
  bool all_at_once_;
  std::optional<ColorWrites> later_;
  std::optional<Trace::Pixel> last_compared_;
  std::int64_t win_ = 0;    ///< its step
  std::uint32_t turn_ = 1;  ///< of the polygon at work
  bool unpainted_ = false;  ///< it was won, and its colour is not written yet
  bool unwritten_ = false;  ///< nor its depth
  /// By pixel, the turn in which it was won and not yet written; else 0.
  std::vector<std::uint32_t> depths_{}, colors_{}, blends_{};
};

// Are all pixels of a polygon there? From its outline to the edge table, from there to the active edges, from these to
// spans and from spans to pixels nothing may be left out. Judged of runs that record each of these and fill by the
// even-odd rule.

class Filling {
  using Situation = formulas::Situation;
  using Rule = formulas::Rule;

 public:
  Filling(const Trace& trace, const Header& header)
      : pixel_(trace.has(AtPixel::verdict) ? AtPixel::verdict : AtPixel::depth),
        judges_(!formulas::fills_non_zero(header.conventions) && trace.has(kind_of<EdgeTableInsert>) &&
                trace.has(kind_of<EdgeEnter>) && trace.has(kind_of<EdgeStep>) && trace.has(kind_of<ScanLineBegin>) &&
                trace.has(kind_of<SpanBegin>) && trace.has(pixel_) &&
                (trace.has(kind_of<PolygonBegin>) || trace.has(kind_of<PieceDraw>))),
        pieces_(trace.has(kind_of<PieceDraw>)),
        interpolates_(trace.has(kind_of<DepthInterpolate>)) {}

  /// Nothing of the run was left open.
  bool judges_all() const { return judges_; }

  template <class E, class Out>
  void look_at(const E& e, const Situation& at, Out& out) {
    if (!judges_) return;
    constexpr bool begins_polygon = std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>;
    constexpr bool begins_line = std::is_same_v<E, ScanLineBegin>, begins_span = std::is_same_v<E, SpanBegin>;
    if constexpr (begins_line || begins_span)
      if (at.ahead.has_pixels()) end_spans(out);
    if constexpr (begins_polygon)
      if (!at.ahead.of_all) end_spans(out);
    if constexpr (begins_polygon || begins_line) end_line(at, out);
    if constexpr (begins_polygon) end_polygon(at, out);
    if constexpr (begins_line) {
      if (at.method().keeps_all) judges_ = false;  // a table of all polygons
      else if (!at.method().scan_line) edges_are_whole(at, out);
      line_ = e.y;
    }
    if constexpr (begins_span) {
      if (active_.empty()) active_ = formulas::detail::active_on(at, e.y);
      spans_ += e.first <= e.last;
      open_.push_back({e, at.scene.raster.width});
    }
    if constexpr (requires { e.x, e.y; })
      if (has(at_pixel<E>, pixel_)) visit(e.x, e.y, at.span_of(e), visited);
    if constexpr (std::is_same_v<E, DepthInterpolate>) visit(e.x, e.y, at.span_of(e), interpolated);
  }

  /// The run is over. Where something is still due its end may be missing, or more.
  void end(const Situation& at) {
    struct Due {
      bool all_done = true;
      void rule(Rule, bool holds) { all_done = all_done && holds; }
      bool equal(double one, double other) const { return one == other; }
      bool every_digit() const { return true; }
    } due;
    if (!judges_) return;
    end_spans(due);
    end_line(at, due);
    end_polygon(at, due);
    judges_ = judges_ && due.all_done && !formulas::detail::last_win_is_missing(at, due);
  }

 private:
  enum Came : std::uint8_t { nothing = 0, visited = 1, interpolated = 2 };
  struct OpenSpan {
    SpanBegin span;
    std::int32_t from;               ///< its first column in the raster
    std::vector<std::uint8_t> came;  ///< by column from there, what came of it

    OpenSpan(const SpanBegin& begun, std::int32_t width)
        : span(begun),
          from(std::max(0, begun.first)),
          came(static_cast<std::size_t>(std::max(0, std::min(begun.last, width - 1) - from + 1)), nothing) {}
  };

  void visit(std::int32_t x, std::int32_t y, const Situation::SpanOfPixel& of, Came what) {
    const std::size_t number = of.place.number;
    if (!of || number >= open_.size() || open_[number].span.y != y) return void(judges_ = false);
    OpenSpan& open = open_[number];
    if (x >= open.from && x - open.from < std::ssize(open.came)) open.came[x - open.from] |= what;
  }
  /// Their pixels may come after several spans.
  template <class Out>
  void end_spans(Out& out) {
    if (open_.empty()) return;
    // Where each pixel's depth is compared, and is said to be interpolated before, both.
    const std::uint8_t all = interpolates_ ? visited | interpolated : visited;
    const bool filled = std::all_of(open_.begin(), open_.end(), [&](const OpenSpan& open) {
      return std::all_of(open.came.begin(), open.came.end(), [&](std::uint8_t came) { return (came & all) == all; });
    });
    out.rule(Rule::span_is_filled, filled);
    open_.clear();
  }

  /// How many spans with pixels lie between these edges. `sure`: so much of a pixel beside a centre rounding may
  /// decide.
  static int spans_between(std::vector<ActiveEdge> edges, const Situation& at, double sure) {
    std::sort(edges.begin(), edges.end(),
              [](const ActiveEdge& one, const ActiveEdge& other) { return one.x < other.x; });
    const std::int32_t width = at.scene.raster.width;
    const auto has_pixels = [&](double left, double right, Conventions::Coverage coverage) {
      return std::max(0, formulas::limited_column(formulas::first_pixel(left + sure, coverage), width)) <
             formulas::limited_column(formulas::last_pixel(right - sure, coverage) + 1, width);
    };
    int count = 0;
    using enum Conventions::Coverage;
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
      const double left = edges[i].x, right = edges[i + 1].x;
      count += at.header.declares(Convention::coverage)
                   ? has_pixels(left, right, at.header.conventions.coverage)
                   : has_pixels(left, right, top_left) && has_pixels(left, right, round);
    }
    return count;
  }
  template <class Out>
  void end_line(const Situation& at, Out& out) {
    if (line_ == none) return;
    const std::int32_t y = line_;
    line_ = none;
    int due = 0;
    constexpr double rounded = 1e-3, added = 1e-6;
    if (!active_.empty()) {
      due = spans_between(std::move(active_), at, out.every_digit() ? 0 : rounded);
    } else {
      // Of those that entered, as the table has them: some may have moved on to the next line, or left too early.
      std::vector<ActiveEdge> edges;
      const auto& table = at.method().edge_table;
      for (std::size_t edge = 0; edge < table.size(); ++edge)
        if (const EdgeTableInsert& entry = table[edge];
            at.method().edge_stages[edge] != EdgeStage::waiting && entry.first_row <= y && y < entry.end_row)
          edges.push_back({entry.edge, entry.x_edge + (y - entry.first_row) * entry.dx_dy, 0});
      due = spans_between(std::move(edges), at, out.every_digit() ? added : rounded);
    }
    active_.clear();
    out.rule(Rule::pair_has_span, std::exchange(spans_, 0) >= due);
  }

  /// Each edge of the outline at work that meets a scan line is in the table.
  template <class Out>
  void edges_are_whole(const Situation& at, Out& out) {
    const MethodState& method = at.method();
    std::span<const std::int32_t> outline = method.outline;
    if (const Piece* piece = at.piece(method.piece)) outline = piece->outline;
    if (outline.empty() && at.on_screen()) outline = formulas::detail::corners_of(at, method.facet);
    if (outline.size() < 3) return void(judges_ = false);
    const auto is_there = [&](std::int32_t one, std::int32_t other) {
      const auto a = at.on_raster(one), b = at.on_raster(other);
      const std::int32_t height = at.scene.raster.height;
      if (!a || !b) return void(judges_ = false), true;
      if (formulas::row_from(a->y, height) == formulas::row_from(b->y, height)) return true;
      for (const EdgeTableInsert& entry : method.edge_table)
        if (std::minmax(entry.vertex_0, entry.vertex_1) == std::minmax(one, other)) return true;
      return false;
    };
    bool whole = true;
    for (std::size_t i = 0; i < outline.size(); ++i)
      whole = whole && is_there(outline[i], outline[(i + 1) % outline.size()]);
    // Without any edge the polygon may be dropped for a reason that the run does not have.
    if (!whole && method.edge_table.empty()) return void(judges_ = false);
    out.rule(Rule::outline_is_closed, whole);
  }
  template <class Out>
  void end_polygon(const Situation& at, Out& out) {
    const MethodState& method = at.method();
    if (method.keeps_all || method.rejected || method.polygon == no_polygon || (pieces_ && method.piece < 0)) return;
    if (!method.scan_line) edges_are_whole(at, out);
    bool all_entered = true, all_ended = true;
    for (std::size_t edge = 0; edge < method.edge_table.size(); ++edge) {
      const EdgeTableInsert& entry = method.edge_table[edge];
      all_entered = all_entered && (method.edge_stages[edge] != EdgeStage::waiting || entry.first_row >= entry.end_row);
    }
    for (const ActiveEdge& active : method.active)
      if (const EdgeTableInsert* entry = at.edge(active.edge); entry && method.scan_line)
        all_ended = all_ended && entry->end_row <= *method.scan_line + 1;
    out.rule(Rule::edge_missing, all_entered);
    out.rule(Rule::line_is_next, all_ended);
  }

  static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();
  AtPixel pixel_;  ///< what is done at each pixel of a span
  bool judges_;
  bool pieces_;                       ///< what is drawn are pieces, after all polygons began
  bool interpolates_;                 ///< each pixel of a span has its depth interpolated, besides
  std::int32_t line_ = none;          ///< the scan line at work
  std::vector<ActiveEdge> active_{};  ///< as its first span found them
  int spans_ = 0;                     ///< of this line, with pixels
  std::vector<OpenSpan> open_{};      ///< spans that no pixel came between, as Situation::ahead has them
};

}  // namespace zstep
