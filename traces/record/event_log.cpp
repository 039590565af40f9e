#include "traces/record/event_log.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace zstep {

namespace {

constexpr std::size_t largest_event() {
  std::size_t largest = 0;
  for_each_kind([&]<class E>() { largest = std::max(largest, sizeof(E)); });
  return largest;
}

}  // namespace

// Room for a block of the largest events; what is not needed is never touched, and costs no memory.
EventLog::EventLog() : bytes_(new std::uint8_t[block_events * (largest_event() + 2)]), end_(bytes_.get()) {
  static_assert(2 + sizeof(RunHead) + sizeof(double) <= largest_event() + 2, "a run of one pixel takes no more than an event");
}

void EventLog::close() {
  close_run();
  in_span_ = false;
  steps_ = {};
}

void EventLog::clear() {
  close();
  end_ = bytes_.get();
  count_ = 0;
}

void EventLog::swap(EventLog& other) noexcept {
  std::swap(bytes_, other.bytes_);
  std::swap(end_, other.end_);
  std::swap(count_, other.count_);
}

}  // namespace zstep
