// Holds the answers to "why not" against what is known of a trace by going through all of it.
#pragma once

#include <cstdint>
#include <set>

#include "sim/answers/why_not.hpp"
#include "traces/file/trace.hpp"

namespace zstep::test {

/// Asks why each polygon is not seen, of so many columns and rows of pixels and of the whole picture, and checks each
/// verdict: whether it is seen at all, the step that it names, its chain and its formulas. The kinds that occurred.
std::set<answers::Why> check_why_not(const Trace& trace, std::int32_t columns, std::int32_t rows);

}  // namespace zstep::test
