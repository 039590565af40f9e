// Work that is done beside the caller's own, one piece at a time.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace zstep {

/// A thread that waits for work. Where the system gives none, the caller does the work itself.
class Beside {
 public:
  Beside() {
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

  /// Waits for the piece before, throws what it threw, and begins this one.
  void begin(std::function<void()> work) {
    wait();
    if (!thread_.joinable()) {
      work();
      return;
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      work_ = std::move(work);
    }
    changed_.notify_all();
  }
  /// Waits until nothing is being done; throws what the last piece threw, once.
  void wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return !work_; });
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return ends_ || work_; });
      if (!work_) return;
      lock.unlock();
      std::exception_ptr fault;
      try {
        work_();
      } catch (...) {
        fault = std::current_exception();
      }
      lock.lock();
      fault_ = fault;
      work_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> work_;  ///< empty when nothing is to be done
  std::exception_ptr fault_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace zstep
