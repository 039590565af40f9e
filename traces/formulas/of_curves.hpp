// The floating horizon (004, "Some of the methods of hidden surface elimination"), and edges as lines of the picture.
#pragma once

#include <algorithm>
#include <cmath>

#include "traces/formulas/lines.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

template <class Out>
void derive(const HorizonTest& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  if (work.segment) {
    const auto a = at.on_raster(work.segment->vertex_0), b = at.on_raster(work.segment->vertex_1);
    // A curve that is seen edge-on between two columns stands on the nearest one.
    if (a && b && a->x != b->x && e.x >= std::min(a->x, b->x) && e.x <= std::max(a->x, b->x)) {
      const Place from{Place::In::vertex, work.segment->vertex_0}, to{Place::In::vertex, work.segment->vertex_1};
      out.gives(&HorizonTest::y_curve, on_line(out.number("y_0", a->y, from["y_s"]), out.number("y_1", b->y, to["y_s"]),
                                               out.number("x", e.x, Place{}), out.number("x_0", a->x, from["x_s"]),
                                               out.number("x_1", b->x, to["x_s"])));
    }
  }
  const auto column = static_cast<std::size_t>(e.x);
  if (e.x < 0 || column >= work.upper.size() || column >= work.lower.size()) return;
  const double upper = work.upper[column], lower = work.lower[column];
  out.reads(Place{Place::In::horizon, e.x});
  const auto option = at.header.conventions.options.find("horizons");
  const bool one = option != at.header.conventions.options.end() && option->second == "one";
  // An entry is NaN while nothing was drawn in its column.
  const bool above = !(e.y_curve > upper), below = !one && !(e.y_curve < lower);
  out.is(&HorizonTest::verdict, above ? Horizon::above : below ? Horizon::below : Horizon::hidden);
}

template <class Out>
void derive(const CurveBegin& e, const Situation& at, Out& out) {
  const auto& last = at.method().horizon.curve;
  out.rule(Rule::number_is_next, e.curve == (last ? last->curve + 1 : 0));
}

template <class Out>
void derive(const HorizonMove& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  const auto column = static_cast<std::size_t>(e.x);
  const auto& own = e.upper ? work.upper : work.lower;
  if (e.x < 0 || column >= own.size() || !std::isfinite(e.y_curve)) return;
  out.reads(Place{Place::In::horizon, e.x});
  const double before = own[column];
  out.rule(Rule::horizon_moves_out, std::isnan(before) || (e.upper ? e.y_curve <= before : e.y_curve >= before));
  if (work.test && work.test->x == e.x) out.is(&HorizonMove::y_curve, work.test->y_curve);
}

template <class Out>
void derive(const HorizonCross& e, const Situation& at, Out& out) {
  if (const auto& test = at.method().horizon.test) out.rule(Rule::cross_beside, std::abs(e.x_at - test->x) <= 1);
}

/// Parts of a line follow one another, and those that a face hides are not seen.
template <class Out>
void derive(const LinePiece& e, const Situation& at, Out& out) {
  const auto line = static_cast<std::size_t>(e.line);
  if (e.line < 0 || line >= at.method().lines.size()) return;
  const LineRow& row = at.method().lines[line];
  out.is(&LinePiece::t_0, row.pieces.empty() ? 0.0 : row.pieces.back().t_1);
  out.rule(Rule::hides_of_line, e.t_0 <= e.t_1 && e.t_1 <= 1);
  const double middle = (e.t_0 + e.t_1) / 2;
  const bool hidden = std::any_of(row.hidden.begin(), row.hidden.end(),
                                  [&](const LineHide& hide) { return hide.t_0 <= middle && middle <= hide.t_1; });
  // Edges between faces that all face away are dropped as a whole.
  if (at.has_step<LineHide>() && row.entry.kind != LineKind::back) out.is(&LinePiece::visible, !hidden);
}

template <class Out>
void derive(const LineHide& e, const Situation&, Out& out) {
  out.rule(Rule::hides_of_line, 0 <= e.t_0 && e.t_0 <= e.t_1 && e.t_1 <= 1);
}

template <class Out>
void derive(const LineCross& e, const Situation& at, Out& out) {
  const auto line = static_cast<std::size_t>(e.line);
  if (e.line < 0 || line >= at.method().lines.size()) return;
  const LineBegin& entry = at.method().lines[line].entry;
  const auto a = at.on_raster(entry.vertex_0), b = at.on_raster(entry.vertex_1);
  if (!a || !b) return;
  const Place from{Place::In::vertex, entry.vertex_0}, to{Place::In::vertex, entry.vertex_1};
  const auto t = out.number("t", e.t, Place{});
  out.gives(&LineCross::x_at, part_of_way(out.number("x_0", a->x, from["x_s"]), out.number("x_1", b->x, to["x_s"]), t));
  out.gives(&LineCross::y_at, part_of_way(out.number("y_0", a->y, from["y_s"]), out.number("y_1", b->y, to["y_s"]), t));
}

}  // namespace zstep::formulas
