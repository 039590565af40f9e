// A process of a program that nobody vouches for, and all that it starts.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <array>
#include <string>

#include "sim/homework/sandbox_stage.hpp"

namespace zstep::homework {

/// Where bubblewrap is looked for.
inline constexpr std::array bubblewrap_places{"/usr/bin/bwrap", "/usr/local/bin/bwrap"};

/// Ended with it, and with the process that has it, whatever has left its group or session.
class Process {
 public:
  /// Throws InputError where none can be started.
  Process(const Stage& stage, const std::string& command, bool walls, const Limits& limits);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// What standard output and standard error can be read from, without waiting; -1 once closed.
  const std::array<int, 2>& pipes() const { return pipes_; }
  void close_pipe(std::size_t which);
  /// Whether it has ended.
  bool look();
  void end();
  int status() const { return status_; }    ///< as wait() has it
  pid_t keeper() const { return keeper_; }  ///< all of the program's processes are below it
  double seconds() const;                   ///< of the processor

 private:
  pid_t keeper_ = 0;
  int lifeline_ = -1;
  std::array<int, 2> pipes_{-1, -1};
  bool ended_ = false;
  int status_ = 0;
  rusage taken_{};
};

}  // namespace zstep::homework
