#include "traces/record/event_log.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace zstep {

namespace {

constexpr std::size_t largest_entry() {
  std::size_t largest = sizeof(codec::LoggedRun);
  for_each_kind([&]<class E>() { largest = std::max(largest, sizeof(E)); });
  return largest + 2;
}

}  // namespace

// Room for a block of the largest events; what is not needed is never touched, and costs no memory.
EventLog::EventLog(bool increments) : bytes_(new std::uint8_t[block_events * largest_entry()]), end_(bytes_.get()), increments_(increments) {}

void EventLog::close_run() {
  const Stage stage = std::exchange(stage_, Stage::closed);
  const bool half_nearer = stage == Stage::compared || stage == Stage::depth_written;
  if (pixels_ > 0) {
    if (half_nearer) nearer_ &= ~(std::uint64_t{1} << pixels_);
    const codec::LoggedRun run{x_ - static_cast<std::int32_t>(pixels_), pixels_, nearer_, last_z_};
    end_[0] = painted_ ? codec::paints_token : codec::fragments_token, end_[1] = 0;
    std::memcpy(end_ + 2, &run, sizeof run);
    end_ += 2 + sizeof run;
    count_ += painted_ ? pixels_ : 2 * (pixels_ + static_cast<std::uint32_t>(std::popcount(nearer_)));
  }
  pixels_ = 0, nearer_ = 0;
  painting_ = painted_ = false;
  if (stage <= Stage::ready) return;
  // A pixel that was told in part: its events one by one.
  const std::int32_t x = x_, y = y_;
  const double z = z_;
  append(steps_.fragment[0], DepthInterpolate{x, y, z});
  if (half_nearer) append(steps_.fragment[1], DepthCompare{x, y, z, true});
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
