// Work in a process of its own, with limits: whatever becomes of it, who started it goes on.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace zstep::homework {

struct GradingLimits {
  double seconds = 60;  ///< of the processor; three times as long, and a while, by the clock
  std::uintmax_t memory = std::uintmax_t{2} << 30;  ///< bytes, of addresses
  std::uintmax_t file = std::uintmax_t{64} << 20;   ///< bytes of a file that it writes
};

/// What a submission of so many bytes may take; seconds and MiB as a person gave them.
GradingLimits limits_for(std::uintmax_t bytes, std::optional<double> seconds, std::optional<double> memory);

class Child {
 public:
  /// Starts `work` in a child; it ends with what that returns. It reads nothing and prints nothing; what it says on
  /// standard error is kept. Throws InputError where there are no processes to be had.
  Child(const GradingLimits& limits, const std::function<int()>& work);
  /// Kills what is still running.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Whether it has ended; one that takes too long is ended.
  bool ended();
  int code() const { return code_; }                 ///< what `work` returned; −1 where it did not come to its end
  const std::string& why() const { return why_; }    ///< it did not
  const std::string& said() const { return said_; }  ///< the first of what it said on standard error

  /// Waits until one of them may have ended, or a moment has passed.
  template <class Children>
  static void wait_for_one(const Children& children);

 private:
  static void wait(const int* pipes, std::size_t count);
  void hear();

  GradingLimits limits_;
  int id_ = 0, pipe_ = -1, code_ = -1;
  std::string why_, said_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

template <class Children>
void Child::wait_for_one(const Children& children) {
  std::vector<int> pipes;
  for (const auto& child : children) pipes.push_back(child->pipe_);
  wait(pipes.data(), pipes.size());
}

}  // namespace zstep::homework
