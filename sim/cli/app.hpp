// The command line: from its words to an exit code.
#pragma once

#include <string>
#include <vector>

namespace zstep::cli {

/// Runs the command that `words` (without the program's name) asks for. Bad input gives one line on stderr and 2.
int run(const std::vector<std::string>& words);

}  // namespace zstep::cli
