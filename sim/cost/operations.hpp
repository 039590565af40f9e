// How many additions, multiplications and divisions the numbers of a run cost: each recorded number's formula is
// evaluated once more with numbers that count.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::compare {

// What kind of work each step of a run is, and how much of each was done by a moment: in words that all methods have in
// common, so that a test of Warnock's and a compare of the Z-buffer stand beside each other.

using Work = WorkKind;
inline constexpr std::size_t work_count = index_of(Work::bookkeeping) + 1;
using WorkCounts = ByEnum<Work, std::int64_t, work_count>;

/// What it is called, in the plural: "depth compares".
std::string_view word_of(Work work);
/// Of an event's kind.
Work work_of(std::uint8_t kind);

/// All but bookkeeping.
std::int64_t operations(const WorkCounts& counts);

/// Of a whole run, by how often each step of its page ran.
WorkCounts work_in(const Page& page, const std::array<std::int64_t, step_limit>& count);

/// The work of a run up to any of its steps.
class WorkDone {
 public:
  explicit WorkDone(const Trace& trace);
  WorkCounts at(std::int64_t position) const;
  WorkCounts all() const { return at(std::ssize(kinds_)); }
  /// The position at which so many operations are just done.
  std::int64_t position_of(std::int64_t operations) const;

 private:
  std::vector<Work> kinds_;       ///< of each step
  std::vector<WorkCounts> sums_;  ///< before every so many of them
};

struct Operations {
  std::int64_t additions = 0, multiplications = 0, divisions = 0;  ///< subtractions are additions
  std::int64_t pixels = 0;                                         ///< depths that were interpolated
  double each(std::int64_t count) const { return pixels == 0 ? 0 : ratio(count, pixels); }
};

/// Of edges, spans, planes and pixels; not of the vertices before them, nor of an attribute. The slope along a span is
/// counted where it is added.
Operations operations_of(const Trace& trace);

/// Of an attribute: of the vertices at the ends of a span's edges, of both edges on its scan line, and of its pixels
/// that are shaded, which `pixels` counts. Without a division by z_v there is no 1/z_v to be interpolated either.
Operations attribute_operations_of(const Trace& trace);

}  // namespace zstep::compare
