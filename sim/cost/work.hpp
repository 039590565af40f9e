// What kind of work each step of a run is, and how much of each was done by a moment: in words that all methods have in
// common, so that a test of Warnock's and a compare of the Z-buffer stand beside each other.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::compare {

using Work = WorkKind;
inline constexpr std::size_t work_count = static_cast<std::size_t>(Work::bookkeeping) + 1;
using WorkCounts = std::array<std::int64_t, work_count>;

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
  WorkCounts all() const { return at(static_cast<std::int64_t>(kinds_.size())); }
  /// The position at which so many operations are just done.
  std::int64_t position_of(std::int64_t operations) const;

 private:
  std::vector<Work> kinds_;       ///< of each step
  std::vector<WorkCounts> sums_;  ///< before every so many of them
};

}  // namespace zstep::compare
