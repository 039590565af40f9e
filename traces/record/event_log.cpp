#include "traces/record/event_log.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "traces/scene.hpp"

namespace zstep {

namespace {

constexpr std::size_t largest_event() {
  std::size_t largest = 0;
  for_each_kind([&]<class E>() { largest = std::max(largest, sizeof(E)); });
  return largest;
}

/// Whether these bytes, as many as an event of this kind has, can be one: a truth value that is neither true nor false
/// is none.
template <class E>
bool can_be(const std::uint8_t* bytes) {
  bool possible = true;
  const E event{};
  for_each_index<E>([&]<std::size_t I>() {
    using Value = FieldValue<E, I>;
    const auto at = reinterpret_cast<const std::uint8_t*>(&(event.*field_at<E, I>.member)) -
                    reinterpret_cast<const std::uint8_t*>(&event);
    if constexpr (std::is_same_v<Value, bool>) {
      possible = possible && bytes[at] <= 1;
    } else if constexpr (std::is_enum_v<Value>) {
      std::underlying_type_t<Value> value;
      std::memcpy(&value, bytes + at, sizeof value);
      possible = possible && value >= 0 && static_cast<std::size_t>(value) < words_of<Value>.size();
    }
  });
  return possible;
}

}  // namespace

const std::size_t EventLog::most_bytes = block_events * (largest_event() + 2) + 1;

// What is not needed is never touched, and costs no memory.
EventLog::EventLog() : own_(new std::uint8_t[most_bytes]), begin_(own_.get()), end_(begin_) {
  static_assert(2 + sizeof(RunHead) + sizeof(double) <= largest_event() + 2,
                "a run of one pixel takes no more than an event");
  *end_ = end_mark;
}

EventLog::EventLog(std::uint8_t* memory) : begin_(memory), end_(memory) { *end_ = end_mark; }

EventLog::EventLog(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, 128>& kind_of_step)
    : EventLog() {
  bytes = bytes.first(std::min(bytes.size(), most_bytes - 1));
  std::copy(bytes.begin(), bytes.end(), begin_);
  codec::RunSteps steps;
  while (const std::size_t left = bytes.size() - static_cast<std::size_t>(end_ - begin_)) {
    const auto [size, events] = left < 2            ? Whole{}
                                : *end_ == run_mark ? whole_run(left, steps)
                                                    : whole_event(left, kind_of_step, steps);
    if (size == 0 || events > block_events - count_) break;
    end_ += size, count_ += events;
  }
  *end_ = end_mark;
}

EventLog::Whole EventLog::whole_run(std::size_t left, const codec::RunSteps& steps) const {
  RunHead head;
  if (left < 2 + sizeof head) return {};
  std::memcpy(&head, end_ + 2, sizeof head);
  const bool painted = end_[1] == 1;
  if (end_[1] > 1 || head.count == 0 || head.count > codec::run_limit || head.x < 0 || head.x > largest_side) return {};
  if ((head.nearer & ~(~std::uint64_t{0} >> (64 - head.count))) != 0 || (painted && head.nearer != 0)) return {};
  const std::size_t told = painted ? 0 : head.nearer != 0 ? 4 : 2;  // one of each must have come singly
  for (std::size_t i = 0; i < told; ++i)
    if (steps.fragment[i] == codec::unknown_step) return {};
  if (painted && steps.paint == codec::unknown_step) return {};
  const std::size_t size = 2 + sizeof head + head.count * sizeof(double);
  if (size > left) return {};
  return {size, painted ? head.count : 2 * (head.count + static_cast<std::uint32_t>(std::popcount(head.nearer)))};
}

EventLog::Whole EventLog::whole_event(std::size_t left, const std::array<std::uint8_t, 128>& kind_of_step,
                                      codec::RunSteps& steps) const {
  const std::uint8_t step = end_[0], kind = end_[1];
  if (step >= codec::row_token || kind >= kind_count || kind_of_step[step] != kind) return {};
  Whole whole;
  const auto look = [&]<class E>() {
    if (kind != kind_of<E> || logged_size < E >> left || !can_be<E>(end_ + 2)) return;
    steps.learn<E>(step);
    whole = {logged_size<E>, 1};
  };
  for_each_kind(look);
  return whole;
}

void EventLog::close() {
  close_run();
  in_span_ = false;
  steps_ = {};
}

void EventLog::clear() {
  close();
  end_ = begin_;
  *end_ = end_mark;
  count_ = 0;
}

void EventLog::swap(EventLog& other) noexcept {
  std::swap(own_, other.own_);
  std::swap(begin_, other.begin_);
  std::swap(end_, other.end_);
  std::swap(count_, other.count_);
}

}  // namespace zstep
