// Running a program that nobody vouches for: a student's, on one scene, with limits, and walled in where the machine
// lets us.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace zstep::homework {

struct Limits {
  double seconds = 10;  ///< of the processor; by the clock it may take three times as long
  int memory = 1024;    ///< MiB, of all of its processes
  int output = 256;     ///< MiB
  int files = 64;       ///< MiB of all files that it writes, and of its own folder
  int processes = 64;

  double clock_seconds() const { return 3 * seconds; }
  /// The system refuses further processes only here: one with more than `processes` is to be stopped, with that as the
  /// reason.
  int refused_from() const { return processes + 512; }
  static std::uint64_t bytes(int mebibytes) { return static_cast<std::uint64_t>(mebibytes) << 20; }
};

/// How a program ended.
struct Ended {
  enum class How : std::uint8_t { well, exit_code, signal, processor, clock, memory, processes, output, files };
  How how = How::well;
  int code = 0;  ///< exit code or signal
  double seconds = 0;
  std::string errors;  ///< what it printed to standard error, up to 8 KiB
};
/// "was stopped after 10 s of processor time". Without `exact`, nothing by which a program could say what it has read.
std::string text_of(const Ended& ended, const Limits& limits, bool exact = true);

/// Whether bubblewrap is there and works; tried once. Not if ZSTEP_SANDBOX=limits asks to do without.
bool has_walls();
/// What a program can do here that it should not; empty where it has walls.
std::string not_protected();

/// Runs `sh -c 'command "$1"'` in a copy of the folder `program`, with the path of a file NAME.txt of this text as $1.
/// What it prints to standard output is written to `out`, a new file. `tick` is called several times a second; if it
/// throws, the program is ended first. Throws InputError where the folder cannot be copied or no process started.
Ended run_in_sandbox(const std::string& command, const std::filesystem::path& program, const std::string& name,
                     const std::string& scene, const std::filesystem::path& out, const Limits& limits,
                     const std::function<void()>& tick);

}  // namespace zstep::homework
