// Long work: progress on a terminal and Ctrl-C, what a command may cost, and answers that are worked out in a process
// of their own.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "sim/cli/messages.hpp"
#include "sim/homework/run_programs.hpp"
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

// What a command may cost. A small file that makes much work, whether it means to or not, ends it within seconds, and
// is told so.

/// --seconds and --memory, for commands that run a method. One command runs in a process, so these are its own.
void add_limit_options(CLI::App& command);
/// These and --strict, for commands that read a trace.
void add_budget_options(CLI::App& command);

/// From now on the command ends with exit_code::incomplete when it has taken more than is meant for a file of so many
/// bytes, or than a person gave it: what it printed stays, what it has half written goes. Another file adds to it.
/// Without a file, only what a person gave is a limit.
void begin_budget(std::optional<std::uintmax_t> file_bytes);
/// The same for work that has limits of its own: processor time, and MiB.
void begin_budget(double seconds, double memory);
/// What a person gave.
std::optional<double> seconds_given();
std::optional<double> memory_given();
/// Half a second before that, for who can end better by itself.
bool time_is_up();
/// Work that was asked for by its number, frames of a film say, may take its time.
void extend_budget(double seconds);
/// Two seconds from now, whatever is left, to end well.
void end_budget();

/// What to say once memory is refused: that this was the budget. Empty where it was not.
std::string memory_budget_met();

/// Whether every doubt is an error.
bool is_strict();

// An answer that is worked out in a process of its own, so that there is one whatever becomes of that process.

struct Answer {
  std::string text;
  int code = exit_code::done;
};

/// What `work` answers within these limits; where it comes to no end, what `otherwise` answers to why not ("took more
/// than 10 seconds …"), with exit_code::incomplete. Where there are no processes to be had, `work` is done in this one,
/// which the limits end.
Answer answer_apart(const homework::GradingLimits& limits, const std::function<Answer()>& work,
                    const std::function<std::string(const std::string&)>& otherwise, Watch& watch);

}  // namespace zstep::cli
