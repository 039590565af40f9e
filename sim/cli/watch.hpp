// Watching long work: progress on a terminal, and Ctrl-C.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "traces/record/trace_recorder.hpp"

namespace zstep::cli {

/// Thrown out of the work when Ctrl-C was pressed.
struct Interrupted {
  std::int64_t events;  ///< of a recording
};

/// While it lives, Ctrl-C stops the recordings it is attached to at their next block, and other work where it next
/// shows how far it is; a second Ctrl-C kills as always. On a terminal it shows that on stderr, once it takes longer
/// than a moment. A recording whose time is up ends in Incomplete.
class Watch {
 public:
  Watch();
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void attach(TraceRecorder& recorder);
  /// Shows the line in place of the one before, if it is time; throws Interrupted if Ctrl-C was pressed.
  void show(const std::string& line) { show(line, 0); }
  /// Throws Interrupted if Ctrl-C was pressed.
  void check() const;
  /// Was Ctrl-C pressed?
  bool interrupted() const;
  /// Takes the line away, before something is printed for good.
  void clear_line();

 private:
  using Clock = std::chrono::steady_clock;
  void tick(std::int64_t events);
  void show(const std::string& line, std::int64_t events);
  bool due() const;

  void (*before_)(int) = nullptr;  ///< what Ctrl-C did until now
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
  bool shown_ = false;
};

}  // namespace zstep::cli
