// A guard in front of toml++.
#pragma once

#include <string>
#include <string_view>

namespace zstep::scene {

/// toml++ nests a table for every part of a dotted key (a.b.c) and follows them by recursion, so a long enough key
/// overflows the stack (toml++ 3.3: a hundred thousand parts; arrays and inline tables it limits itself). Throws
/// InputError at FILE:LINE when a key has more than 32 parts; `first_line` numbers the first line of `text`.
void check_toml_depth(std::string_view text, const std::string& name, int first_line = 1);

}  // namespace zstep::scene
