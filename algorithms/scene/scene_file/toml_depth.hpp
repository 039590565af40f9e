// A guard in front of toml++, and the scan that it shares with those who look into a file's text.
#pragma once

#include <string>
#include <string_view>

namespace zstep::scene {

/// toml++ nests a table for every part of a dotted key (a.b.c) and follows them by recursion, so a long enough key
/// overflows the stack (toml++ 3.3: a hundred thousand parts; arrays and inline tables it limits itself). Throws
/// InputError at FILE:LINE when a key has more than 32 parts; `first_line` numbers the first line of `text`.
void check_toml_depth(std::string_view text, const std::string& name, int first_line = 1);

/// The end of the string that opens at `at`; strings of one line end with their line at the latest. Counts the lines
/// that it passes.
std::size_t skip_string(std::string_view text, std::size_t at, int& line);

}  // namespace zstep::scene
