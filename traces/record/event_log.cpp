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

void EventLog::close_run() {
  const Stage stage = std::exchange(stage_, Stage::closed);
  const std::uint32_t pixels = std::exchange(pixels_, 0);
  const std::uint64_t nearer = std::exchange(nearer_, 0);
  const bool painted = painted_;
  painting_ = painted_ = false;
  if (pixels > 0) {
    const RunHead head{x_ - static_cast<std::int32_t>(pixels), pixels, nearer & (~std::uint64_t{0} >> (64 - pixels))};
    end_[0] = run_mark, end_[1] = painted;
    std::memcpy(end_ + 2, &head, sizeof head);
    std::memcpy(end_ + 2 + sizeof head, depths_.data(), pixels * sizeof(double));
    end_ += 2 + sizeof head + pixels * sizeof(double);
    count_ += painted ? pixels : 2 * (pixels + static_cast<std::uint32_t>(std::popcount(head.nearer)));
  }
  if (stage <= Stage::ready) return;
  // A pixel that was told in part: its events one by one.
  const std::int32_t x = x_, y = y_;
  const double z = depths_[pixels];
  append(steps_.fragment[0], DepthInterpolate{x, y, z});
  if (stage > Stage::interpolated) append(steps_.fragment[1], DepthCompare{x, y, z, true});
  if (stage == Stage::depth_written) append(steps_.fragment[2], DepthWrite{x, y, z});
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
