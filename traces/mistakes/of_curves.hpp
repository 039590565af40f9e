// Mistakes with the floating horizon (004).
#pragma once

#include <algorithm>

#include "traces/formulas/lines.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

inline void suppose(const HorizonTest& e, const Situation& at, Supposed& out) {
  const HorizonWork& work = at.method().horizon;
  const auto column = static_cast<std::size_t>(e.x);
  if (work.segment) {
    const auto a = at.on_raster(work.segment->vertex_0), b = at.on_raster(work.segment->vertex_1);
    if (a && b && a->x != b->x && e.x > std::min(a->x, b->x) && e.x < std::max(a->x, b->x))
      out.number(not_interpolated, e.y_curve, {Rounded(a->y), Rounded(b->y)},
                 formulas::on_line(Rounded(a->y), Rounded(b->y), Rounded(e.x), Rounded(a->x), Rounded(b->x)));
  }
  if (e.x < 0 || column >= work.upper.size() || column >= work.lower.size()) return;
  const bool above = !(e.y_curve > work.upper[column]), below = !(e.y_curve < work.lower[column]);
  if (!above && below) out.says(only_upper, e.verdict == Horizon::hidden, e.verdict == Horizon::below);
}

}  // namespace zstep::mistakes
