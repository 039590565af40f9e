// What a run holds in memory: the bytes that operator new has given out and not yet got back.
#pragma once

#include <cstdint>

namespace zstep::compare {

/// Counts while it lives; one at a time. Memory from before does not count, nor does what C libraries take by malloc.
class AllocationPeak {
 public:
  AllocationPeak();
  ~AllocationPeak();
  AllocationPeak(const AllocationPeak&) = delete;
  AllocationPeak& operator=(const AllocationPeak&) = delete;

  /// The most bytes held at once so far, as the allocator rounds them; -1 where they cannot be counted: on Windows, and
  /// under sanitizers, which have an operator new of their own.
  std::int64_t peak() const;
};

}  // namespace zstep::compare
