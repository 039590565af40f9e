// What a command says besides its answer, and the exit code that it ends with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace zstep::cli {

/// docs/command-line.md has this table for who writes scripts.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int finding = 1;       ///< done, and something is not as it should be
inline constexpr int bad_input = 2;     ///< or an output that cannot be written there
inline constexpr int incomplete = 3;    ///< a part of the file, or of the work, is missing
inline constexpr int exhausted = 4;     ///< memory, or room on the disk
inline constexpr int mistake = 70;      ///< of zstep's own
inline constexpr int interrupted = 130;
}  // namespace exit_code

/// A text with the commands in it as this reader types them: `./zstep view` where the launcher, called so, says it in
/// ZSTEP_CALLED.
std::string as_typed(std::string text);
void set_commands(std::vector<std::string> names);  ///< those that as_typed() knows

/// A message on standard error, a line or several, with nothing in it that acts. That nobody can read it stops nothing.
void complain(std::string_view line);
/// The same for what is missing: a command that is done ends with exit_code::incomplete from now on.
void complain_incomplete(std::string_view line);
bool is_incomplete();

/// "wrote PATH: what", on standard output.
void say_written(std::string_view path, std::string_view what);
/// Throws what a standard output that takes no more means.
[[noreturn]] void stdout_failed();

}  // namespace zstep::cli
