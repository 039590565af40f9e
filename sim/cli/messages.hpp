// What a command says besides its answer, and the exit code that it ends with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace zstep::cli {

/// docs/command-line.md has this table for who writes scripts.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int finding = 1;     ///< done, and something is not as it should be
inline constexpr int bad_input = 2;   ///< or an output that cannot be written there
inline constexpr int incomplete = 3;  ///< a part of the file, or of the work, is missing
inline constexpr int exhausted = 4;   ///< memory, or room on the disk
inline constexpr int mistake = 70;    ///< of zstep's own
inline constexpr int interrupted = 130;
}  // namespace exit_code

/// A text with the commands in it as this reader types them: `./zstep view` where the launcher, called so, says it in
/// ZSTEP_CALLED.
std::string as_typed(std::string text);
void set_commands(std::vector<std::string> names);  ///< those that as_typed() knows

/// A message on standard error: one line, with nothing in it that acts, whatever it quotes. That nobody can read it
/// stops nothing.
void complain(std::string_view line);
/// Several of them; what they quote must have been made printable() before they were put together.
void complain_lines(std::string_view lines);
/// The same for what is missing: a command that is done ends with exit_code::incomplete from now on.
void complain_incomplete(std::string_view line);
bool is_incomplete();

/// "wrote PATH: what", on standard output.
void say_written(std::string_view path, std::string_view what);
/// Where no standard input, output or error is given (`>&-`), the next files to be opened would be taken for them. From
/// now on they are there, and refuse.
void hold_standard_streams();
/// The exit code of a command that ends with `code` once all that it printed is written: exit_code::exhausted, and a
/// line that says why, where that cannot be.
int after_printing(int code);

/// As JSON has it, and what JSON has no number for (nan, inf) as its word.
nlohmann::ordered_json json_number(double value);

}  // namespace zstep::cli
