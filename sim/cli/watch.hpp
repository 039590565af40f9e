// Watching a long recording: progress on a terminal, and Ctrl-C.
#pragma once

#include <chrono>
#include <cstdint>

#include "traces/record/trace_recorder.hpp"

namespace zstep::cli {

/// Thrown out of a recording when Ctrl-C was pressed.
struct Interrupted {
  std::int64_t events;
};

/// While it lives, Ctrl-C stops the recordings it is attached to at their next block; a second Ctrl-C kills as always.
/// On a terminal it shows on stderr how far they are, once they take longer than a moment.
class Watch {
 public:
  Watch();
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void attach(TraceRecorder& recorder);

 private:
  using Clock = std::chrono::steady_clock;
  void tick(std::int64_t events);
  void clear_line();

  void (*before_)(int) = nullptr;  ///< what Ctrl-C did until now
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
  bool shown_ = false;
};

}  // namespace zstep::cli
