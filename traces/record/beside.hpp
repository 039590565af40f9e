// Work that is done beside the caller's own, one piece after another.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <queue>
#include <system_error>
#include <thread>
#include <utility>

namespace zstep {

/// A thread that waits for work. Where the system gives none, the caller does the work itself.
class Beside {
 public:
  /// `most`: pieces that may wait or be at work.
  explicit Beside(std::size_t most) : most_(most) {
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {
    }
  }
  ~Beside() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  /// Waits until there is room for another piece; throws what a piece before threw, once.
  void wait_for_room() { wait_until_at_most(most_ - 1); }
  /// Waits until nothing is being done; throws likewise.
  void wait() { wait_until_at_most(0); }
  /// Begins a piece, for which there must be room. After one that threw, no other is done until that was told.
  void begin(std::function<void()> work) {
    if (!thread_.joinable()) return work();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      pieces_.push(std::move(work));
      ++unfinished_;
    }
    changed_.notify_all();
  }

 private:
  void wait_until_at_most(std::size_t count) {
    await([&] { return unfinished_ <= count; });
    if (!faulty_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    faulty_ = false;
    std::rethrow_exception(std::exchange(fault_, nullptr));
  }
  /// To be put to sleep and woken takes longer than most waits here, so one looks some times first, without the other's having to wait.
  template <class Condition>
  void await(Condition&& condition) {
    for (int look = 0; look < looks; ++look) {
      if (condition()) return;
      std::this_thread::yield();
    }
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, condition);
  }

  void run() {
    for (;;) {
      await([this] { return ends_ || unfinished_ > 0; });
      std::unique_lock<std::mutex> lock(mutex_);
      if (pieces_.empty()) return;
      const std::function<void()>& work = pieces_.front();  // stays where it is until it is popped
      if (!faulty_) {
        lock.unlock();
        std::exception_ptr fault;
        try {
          work();
        } catch (...) {
          fault = std::current_exception();
        }
        lock.lock();
        fault_ = fault;
        faulty_ = fault != nullptr;
      }
      pieces_.pop();
      --unfinished_;
      lock.unlock();
      changed_.notify_all();
    }
  }

  static constexpr int looks = 640;  ///< less than a millisecond

  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<std::function<void()>> pieces_;  ///< the first is at work
  std::exception_ptr fault_;
  // What is waited for: read without the lock, and changed under it, so that nobody goes to sleep just before.
  std::atomic<std::size_t> unfinished_ = 0;
  std::atomic<bool> faulty_ = false, ends_ = false;
  std::thread thread_;
};

}  // namespace zstep
