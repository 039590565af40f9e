// How many additions, multiplications and divisions the numbers of a run cost: each recorded number's formula is
// evaluated once more with numbers that count.
#pragma once

#include <cstdint>

#include "traces/file/trace.hpp"

namespace zstep::compare {

struct Operations {
  std::int64_t additions = 0, multiplications = 0, divisions = 0;  ///< subtractions are additions
  std::int64_t pixels = 0;                                         ///< depths that were interpolated
  double each(std::int64_t count) const {
    return pixels == 0 ? 0 : static_cast<double>(count) / static_cast<double>(pixels);
  }
};

/// Of edges, spans, planes and pixels; not of the vertices before them, nor of an attribute. The slope along a span is
/// counted where it is added.
Operations operations_of(const Trace& trace);

/// Of an attribute: of the vertices at the ends of a span's edges, of both edges on its scan line, and of its pixels
/// that are shaded, which `pixels` counts. Without a division by z_v there is no 1/z_v to be interpolated either.
Operations attribute_operations_of(const Trace& trace);

}  // namespace zstep::compare
