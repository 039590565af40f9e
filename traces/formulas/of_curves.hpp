// The floating horizon (004, "Some of the methods of hidden surface elimination").
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

}  // namespace zstep::formulas
