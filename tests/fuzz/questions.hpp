// What everyone asks of a trace, for fuzzing: whatever it holds is answered or refused in one line.
#pragma once

#include <cstdlib>

#include "traces/error.hpp"
#include "traces/file/trace.hpp"

namespace zstep::fuzz {

inline void check(bool holds) {
  if (!holds) std::abort();
}

/// What bad input may cause, and nothing else.
template <class Ask>
bool answered(Ask&& ask) {
  try {
    ask();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Reads all of it, replays it, and asks one thing more, which `choice` says: whether it can be written as JSON Lines
/// and read again, what some step did, what happened to some pixel, where a number comes from, why a polygon is not
/// seen.
void ask_everything(const Trace& trace, unsigned choice);

}  // namespace zstep::fuzz
