// A run that is made while the window goes on.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

class RunBehind {
 public:
  /// Makes a run, telling how many steps it has so far; told false, it ends there.
  using Make = std::function<OtherRun(const RunWatch& watch)>;

  /// Begins at once, on a thread of its own. Throws std::system_error where the system has none.
  explicit RunBehind(Make make) : state_(std::make_shared<State>()) {
    thread_ = std::thread([state = state_, make = std::move(make)] {
      try {
        state->made = make([&](std::int64_t steps) {
          state->steps = steps;
          return !state->ended;
        });
      } catch (...) {
        state->fault = std::current_exception();
      }
      state->done = true;
    });
  }
  /// Ends it where it is, and waits for that.
  ~RunBehind() {
    state_->ended = true;
    thread_.join();
  }
  RunBehind(const RunBehind&) = delete;
  RunBehind& operator=(const RunBehind&) = delete;

  std::int64_t steps() const { return state_->steps; }
  bool done() const { return state_->done; }
  /// Once it is done: the run. Throws what making it threw.
  OtherRun take() {
    if (state_->fault) std::rethrow_exception(state_->fault);
    return *std::exchange(state_->made, std::nullopt);
  }

 private:
  struct State {
    std::atomic<std::int64_t> steps = 0;
    std::atomic<bool> ended = false, done = false;
    std::optional<OtherRun> made;
    std::exception_ptr fault;
  };
  std::shared_ptr<State> state_;
  std::thread thread_;
};

}  // namespace zstep::viewer
