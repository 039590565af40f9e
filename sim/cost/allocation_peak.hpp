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

/// From now on memory beyond so many bytes is refused as if there were none; 0: no more. What was taken before does not
/// count.
void limit_heap(std::int64_t bytes);
/// Whether some was.
bool met_heap_limit();

}  // namespace zstep::compare
