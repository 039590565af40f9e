// The depths along a span, as a trace foretells them.
#pragma once

#include <cstdint>

#include "traces/events/vocabulary.hpp"
#include "traces/formulas/lines.hpp"

namespace zstep::codec {

/// The depth at column x of a span, `last` being the one told before:
/// that on the line between the ends or, by increments, one more dz_dx.
inline double depth_along(const SpanBegin& span, bool increments, std::int32_t x, double last) {
  if (increments && x != span.first) return last + span.dz_dx;
  if (span.x_right == span.x_left) return span.z_left;
  return formulas::on_line<double>(span.z_left, span.z_right, x, span.x_left, span.x_right);
}

/// The same at columns first … first + count - 1; without a question for each where they are not asked one after
/// another, so that a compiler finds several at once.
inline void depths_along(const SpanBegin& span, bool increments, std::int32_t first, std::uint32_t count, double before,
                         double* depths) {
  if (increments || span.x_right == span.x_left) {
    double z = before;
    for (std::uint32_t k = 0; k < count; ++k)
      depths[k] = z = depth_along(span, increments, first + static_cast<std::int32_t>(k), z);
    return;
  }
  const double z_left = span.z_left, x_left = span.x_left, rise = span.z_right - z_left, width = span.x_right - x_left;
  for (std::uint32_t k = 0; k < count; ++k)
    depths[k] = z_left + rise * (static_cast<double>(first + static_cast<std::int32_t>(k)) - x_left) / width;
}

}  // namespace zstep::codec
