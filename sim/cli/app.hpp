// The command line: from its words to an exit code.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace zstep::cli {

/// The command that `words` (without the program's name) ask for, before it does anything; a link stands for the words
/// of a command. Throws InputError.
std::function<int()> parse(std::vector<std::string> words);

/// Runs the command that `words` asks for. Bad input gives one line on stderr and 2.
int run(const std::vector<std::string>& words);

}  // namespace zstep::cli
