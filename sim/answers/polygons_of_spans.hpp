// Of which polygon a step at a pixel is, in runs that print spans of several polygons before their pixels: there the
// polygon at work is another one.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <type_traits>

#include "traces/events/vocabulary.hpp"
#include "traces/file/trace.hpp"
#include "traces/formulas/spans_ahead.hpp"

namespace zstep::answers {

/// The polygon at work at a step, and where that work began.
struct AtWork {
  std::int32_t polygon = no_polygon;
  std::int64_t since = 0;
  auto operator<=>(const AtWork&) const = default;
};

/// Goes through a run step by step.
class PolygonsOfSpans {
 public:
  /// Before its first step; none where each pixel is of the polygon at work, or of the span before it.
  static std::optional<PolygonsOfSpans> of(const Trace& trace) {
    if (trace.spans_at_once() == Trace::SpansAtOnce::of_polygon) return std::nullopt;
    PolygonsOfSpans spans;
    spans.ahead_ = formulas::spans_ahead_of(trace, trace.header().conventions);
    return spans;
  }

  /// Of a step at a pixel that comes next: the polygon of its span, since that span began. Where it has none, and the
  /// polygon at work is the one whose spans came last, no polygon.
  template <class E>
  std::optional<AtWork> at(const E& e) const {
    const auto& spans = ahead_.spans();
    if (const auto number = ahead_.span_of(e)) return AtWork{spans[*number].polygon, spans[*number].step};
    if (!ahead_.of_all || spans.empty() || spans.back().step < turn_) return std::nullopt;
    return AtWork{};
  }
  template <class E>
  void pass(std::int64_t step, const E& e) {
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>)
      ahead_.begin(e.polygon), turn_ = step;
    // In one table the edges of all polygons have numbers of their own.
    if constexpr (std::is_same_v<E, EdgeTableInsert>)
      if (!ahead_.of_all) polygons_[e.edge] = e.polygon;
    if constexpr (std::is_same_v<E, SpanBegin>) {
      const auto left = polygons_.find(e.left_edge);
      std::optional<std::int32_t> polygon;  // else the one at work
      if (!ahead_.of_all) polygon = left != polygons_.end() ? left->second : no_polygon;
      ahead_.add(e, polygon, step);
    }
    ahead_.pass(e);
  }

 private:
  formulas::SpansAhead ahead_;
  std::map<std::int32_t, std::int32_t> polygons_;  ///< by edge
  std::int64_t turn_ = 0;                          ///< where work on a polygon began last
};

}  // namespace zstep::answers
