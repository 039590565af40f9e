// Which parts of an outline that crosses itself are inside: those that it goes round an odd number of times (even-odd),
// or those that it goes round at all, counted with their sense (non-zero). Of other outlines the two are the same. Both
// are PostScript's ("PostScript Language Reference", 3rd edition, section 4.5.2, "Insideness Testing").
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "traces/conventions.hpp"

namespace zstep::formulas {

inline constexpr std::string_view fill_key = "fill", non_zero_fill = "non-zero";

inline bool fills_non_zero(const Conventions& conventions) {
  const auto given = conventions.options.find(std::string(fill_key));
  return given != conventions.options.end() && given->second == non_zero_fill;
}

inline bool is_inside(bool non_zero, std::int32_t winding) { return non_zero ? winding != 0 : winding % 2 != 0; }

/// Calls span(i, j) for each two of so many crossings of a line, from left to right, between which it is inside; way(i)
/// is 1 where the outline goes down there and -1 where it goes up.
template <class Way, class Span>
void each_span_inside(std::size_t count, bool non_zero, const Way& way, Span&& span) {
  std::int32_t winding = 0;
  std::size_t from = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool was = is_inside(non_zero, winding);
    winding += way(i);
    const bool is = is_inside(non_zero, winding);
    if (!was && is) from = i;
    if (was && !is) span(from, i);
  }
}

}  // namespace zstep::formulas
