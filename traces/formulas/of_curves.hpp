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
