// Replaces the global operator new and delete, as [replacement.functions] of the C++ standard allows: a branch more
// when nobody watches.
#include "sim/cost/allocation_peak.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__has_feature)
#define ZSTEP_HAS_FEATURE(feature) __has_feature(feature)
#else
#define ZSTEP_HAS_FEATURE(feature) 0
#endif
#if defined(_WIN32) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    ZSTEP_HAS_FEATURE(address_sanitizer) || ZSTEP_HAS_FEATURE(memory_sanitizer) || ZSTEP_HAS_FEATURE(thread_sanitizer)
#define ZSTEP_COUNTS_HEAP 0
#else
#define ZSTEP_COUNTS_HEAP 1
#endif

#if defined(__APPLE__)
#include <malloc/malloc.h>
#elif !defined(_WIN32)
#include <malloc.h>
#endif

namespace {

std::atomic<bool> watching{false};
std::atomic<std::int64_t> held{0}, most{0};
std::atomic<std::int64_t> limit{0};  // on what is held; 0: none
std::atomic<bool> limit_met{false};

#if ZSTEP_COUNTS_HEAP

std::int64_t size_of(void* memory) noexcept {
#if defined(__APPLE__)
  return malloc_size(memory);
#else
  return malloc_usable_size(memory);
#endif
}

bool counts() noexcept { return watching.load(std::memory_order_relaxed) || limit.load(std::memory_order_relaxed) > 0; }

void* given(void* memory) noexcept {
  if (!memory || !counts()) return memory;
  const std::int64_t size = size_of(memory), now = held.fetch_add(size) + size,
                     allowed = limit.load(std::memory_order_relaxed);
  if (allowed > 0 && now > allowed) {
    limit_met = true;
    held.fetch_sub(size);
    std::free(memory);
    return nullptr;
  }
  std::int64_t before = most.load();
  while (before < now && !most.compare_exchange_weak(before, now)) {
  }
  return memory;
}

void taken_back(void* memory) noexcept {
  if (memory && counts()) held.fetch_sub(size_of(memory));
  std::free(memory);
}

// As the standard has it: ask the new-handler to make room until there is none.
template <class Get>
void* get_or_throw(Get&& get) {
  for (;;) {
    if (void* memory = given(get())) return memory;
    const std::new_handler make_room = std::get_new_handler();
    if (!make_room) throw std::bad_alloc();
    make_room();
  }
}

#endif

}  // namespace

#if ZSTEP_COUNTS_HEAP

void* operator new(std::size_t size) {
  return get_or_throw([size] { return std::malloc(std::max<std::size_t>(size, 1)); });
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  const std::size_t whole = (std::max<std::size_t>(size, 1) + step - 1) / step * step;
  return get_or_throw([step, whole] { return std::aligned_alloc(step, whole); });
}
void operator delete(void* memory) noexcept { taken_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { taken_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { taken_back(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { taken_back(memory); }

#endif

namespace zstep::compare {

AllocationPeak::AllocationPeak() {
  held = most = 0;
  watching = true;
}

AllocationPeak::~AllocationPeak() { watching = false; }

void limit_heap(std::int64_t bytes) { limit = bytes; }
bool met_heap_limit() { return limit_met; }

std::int64_t AllocationPeak::peak() const { return ZSTEP_COUNTS_HEAP ? most.load() : -1; }

}  // namespace zstep::compare
