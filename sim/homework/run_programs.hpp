// The programs of a submission, run on the scenes of a homework.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

// Work in a process of its own, with limits: whatever becomes of it, who started it goes on.

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

struct ProgramRun {
  const Task* task = nullptr;
  Ended ended;
  std::filesystem::path file;  ///< what it printed
};

/// Runs the command, or the homework's own where it is empty, once for each scene in a copy of the folder `program`.
/// What it prints is SCENE.jsonl in the folder `runs`, which is made; how it ended, where it did not end well, is
/// SCENE.ended.txt; so is why it was not run. Throws InputError where there is no command or a folder is not as it must
/// be.
std::vector<ProgramRun> run_programs(const Homework& homework, const std::string& command,
                                     const std::filesystem::path& program, const std::filesystem::path& runs,
                                     const std::function<void(const Task&)>& on_task);

/// What is noted of the program beside its run: "The program was stopped after 10 s of processor time." Of a run that
/// may not be shown its first line alone. Empty where nothing is.
std::string how_it_ended(const std::filesystem::path& run, bool hidden);

/// The command that compiles and runs a source file, by its name: "python3 zbuffer.py"; none where it is no program.
struct SourceCommand {
  std::string tool, command;  ///< the tool that must be there, "python3"
};
std::optional<SourceCommand> command_of_source(const std::filesystem::path& source);

}  // namespace zstep::homework
