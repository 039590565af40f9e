// Running a program that nobody vouches for: a student's, on one scene, with limits, and walled in where the machine
// lets us.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

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

// What a process and all that it has started take.

struct Usage {
  std::vector<pid_t> processes;  ///< those below this one, as the system lists them; none where it has no /proc
  std::uint64_t memory = 0;      ///< bytes, of all of them
  double seconds = 0;  ///< of the processor, of all of them and of those that they, or this one, have waited for
};
/// Memory that several processes share counts once, in parts: their proportional set size. The system needs a while to
/// tell it, so it is asked only where all of their pages are more than `allowed`; where it does not tell, those count.
Usage usage_below(pid_t process, std::uint64_t allowed = ~std::uint64_t{0});

// What the programs of a user write where everybody may: counted while they run, removed after them.

/// Files and folders of a program may be nested so deep, and there may be so many of them.
inline constexpr int most_files = 10000, deepest_folders = 200;

/// Whether a user has more in a folder, and in those where everybody may write (/tmp, /dev/shm …), than `limits` allow.
/// Without a user of their own, programs are looked for in the folder alone.
bool writes_too_much(std::optional<unsigned> user, const std::filesystem::path& folder, const Limits& limits);
/// Removes what a user has where everybody may write.
void remove_files_of(unsigned user);

}  // namespace zstep::homework
