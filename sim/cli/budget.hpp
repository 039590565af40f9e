// What a command may cost. A small file that makes much work, whether it means to or not, ends it within seconds, and
// is told so.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace zstep::cli {

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

}  // namespace zstep::cli
