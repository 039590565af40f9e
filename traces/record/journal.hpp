// What recording leaves to others: work that is done beside it, and memory for what is not written yet, kept so that it
// outlives the recording. A process that is killed, or falls, takes its own memory with it, but not that of a file
// which it has mapped.
//
// The file stands beside the trace, as "run.ztrace.journal", while it is recorded. Whoever opens a trace without an end
// finds in it the blocks that come next (file/open_trace.cpp).
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <queue>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "traces/file/container.hpp"

namespace zstep {

// Work that is done beside the caller's own, one piece after another.

/// A thread that sleeps until there is work. To be put to sleep and woken costs as much as a small piece, and to look
/// out instead takes from the caller what two processors of one core share: so the thread is woken for several pieces
/// at once, and a caller who found no room waits until there is room for several. Where the system gives no thread, the
/// caller does the work itself.
class BackgroundWorker {
 public:
  /// `most`: pieces that may wait or be at work.
  explicit BackgroundWorker(std::size_t most) : most_(most) {
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {
    }
  }
  ~BackgroundWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends_ = true;
    }
    for_thread_.notify_one();
    if (thread_.joinable()) thread_.join();
  }
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;

  /// Waits until there is room for another piece; throws what a piece before threw, once.
  void wait_for_room() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (pieces_.size() >= most_) wait_until_at_most(most_ / 2, lock);
    tell_fault();
  }
  /// Waits until nothing is being done; throws likewise.
  void wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    wait_until_at_most(0, lock);
    tell_fault();
  }
  /// Begins a piece, for which there must be room. After one that threw, no other is done until that was told.
  void begin(std::function<void()> work) { take(std::move(work), 1); }
  /// The same, but not before several wait.
  void begin_with_others(std::function<void()> work) { take(std::move(work), most_ / 2 + 1); }

 private:
  void wait_until_at_most(std::size_t count, std::unique_lock<std::mutex>& lock) {
    if (pieces_.size() <= count) return;
    enough_ = count;
    awake_ = true;
    for_thread_.notify_one();
    for_caller_.wait(lock, [&] { return pieces_.size() <= count; });
  }
  void take(std::function<void()> work, std::size_t enough_to_wake) {
    if (!thread_.joinable()) return work();
    bool wake = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      pieces_.push(std::move(work));
      wake = !awake_ && pieces_.size() >= enough_to_wake;
      awake_ = awake_ || wake;
    }
    if (wake) for_thread_.notify_one();
  }
  void tell_fault() {
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  }

  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      for_thread_.wait(lock, [this] { return awake_ || ends_; });
      while (!pieces_.empty()) {
        const std::function<void()>& work = pieces_.front();  // stays where it is until it is popped
        if (!fault_) {
          lock.unlock();
          std::exception_ptr fault;
          try {
            work();
          } catch (...) {
            fault = std::current_exception();
          }
          lock.lock();
          fault_ = fault;
        }
        pieces_.pop();
        if (pieces_.size() == enough_) for_caller_.notify_one();
      }
      awake_ = false;
      if (ends_) return;
    }
  }

  const std::size_t most_;
  std::mutex mutex_;  ///< of all that follows
  std::condition_variable for_thread_, for_caller_;
  std::queue<std::function<void()>> pieces_;  ///< the first may be at work
  std::exception_ptr fault_;
  std::size_t enough_ = 0;             ///< so many pieces left, and the caller who waits goes on
  bool awake_ = false, ends_ = false;  ///< the thread has been woken and not yet run out of work; it is to end
  std::thread thread_;
};

class Journal {
 public:
  /// Room for `logs` logs of `log_size` bytes. Where the trace will be no ordinary file (an empty path: none at
  /// all), or the system gives no such memory, it is memory as any other.
  Journal(const std::filesystem::path& trace, std::size_t logs, std::size_t log_size);
  /// Whatever is not written by now was lost for another reason: the file goes.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// What the logs hold can be read after the recording was killed.
  bool outlives() const { return mapped_ != nullptr; }
  std::uint8_t* log(std::size_t number) const { return logs_ + number * log_size_; }
  /// From now on this memory holds the block of this number, the first being 1; call it when the log in it is empty.
  void holds(const std::uint8_t* log, std::uint64_t block);
  /// That is the trace it belongs to, by the checksum of its head.
  void belongs_to(std::uint64_t head_checksum);

 private:
  std::size_t log_size_;
  std::filesystem::path path_;
  std::uint8_t* mapped_ = nullptr;  ///< the file, if there is one
  std::size_t mapped_size_ = 0;
  std::unique_ptr<std::uint8_t[]> own_;
  std::uint8_t* logs_ = nullptr;
};

std::filesystem::path journal_of(const std::filesystem::path& trace);

/// The logs of blocks `first`, `first + 1` and so on that the journal of a trace holds, as they stood in memory; none
/// where there is no journal, or it is another trace's or another zstep's. They are hostile until checked.
std::vector<Bytes> logs_in_journal(const std::filesystem::path& trace, std::uint64_t head_checksum,
                                   std::uint64_t first);

}  // namespace zstep
