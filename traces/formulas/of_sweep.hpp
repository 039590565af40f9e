// The scan-line method: flags, intervals, implied edges (002, "Scan Line Algorithm").
#pragma once

#include <algorithm>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/of_pieces.hpp"

namespace zstep::formulas {

template <class Out>
void derive(const FlagFlip& e, const Situation& at, Out& out) {
  const auto& inside = at.method().sweep.inside;
  out.is(&FlagFlip::inside, std::find(inside.begin(), inside.end(), e.piece) == inside.end());
}

template <class Out>
void derive(const SpanFlags& e, const Situation& at, Out& out) {
  out.is(&SpanFlags::flags, static_cast<std::int32_t>(at.method().sweep.inside.size()));
  if (at.method().scan_line) out.rule(Rule::span_line, *at.method().scan_line == e.y);
}

template <class Out>
void derive(const ImpliedEdge& e, const Situation& at, Out& out) {
  const auto plane = detail::plane_of(out, at, e.piece);
  if (!plane || !at.method().scan_line) return;
  out.gives(&ImpliedEdge::z, plane_depth(plane->a, plane->b, plane->c, plane->d, out.number("x", e.x_at, Place{}),
                                         out.number("y", *at.method().scan_line, Place{})));
}

}  // namespace zstep::formulas
