// A process of a program that nobody vouches for, and all that it starts.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <sys/types.h>
#include <vector>

#include "sim/homework/folders.hpp"
#include "sim/homework/sandbox.hpp"

namespace zstep::homework {

// The folder that a walled-in program sees, and how its process begins.

/// A folder with a copy of the program, the one scene and room to write; gone with it.
class Stage {
 public:
  Stage(const std::filesystem::path& program, const std::string& name, const std::string& scene, const Limits& limits);

  /// The words of the process that runs the command: bubblewrap's, or a shell's.
  std::vector<std::string> words(const std::string& command, bool walls, const Limits& limits) const;
  std::vector<std::string> environment(bool walls) const;
  /// Where it begins.
  const std::filesystem::path& folder(bool walls) const { return walls ? folder_.path() : program_; }
  /// Where it may write, without walls.
  const std::filesystem::path& scratch() const { return scratch_; }
  /// All of it.
  const std::filesystem::path& whole() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  std::filesystem::path program_, scene_, scratch_;
  std::string name_;
};

/// The user whom programs run as where zstep runs as root: one who has no name, owns nothing, and is this process's
/// alone, so that what they start, take and leave behind is known for theirs. None where zstep runs as somebody else,
/// or as the root of a container that has no other user: then they run as who zstep runs as.
std::optional<unsigned> program_user();

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
