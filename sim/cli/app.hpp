// The command line: from its words to an exit code.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace zstep::cli {

/// Declares commands; parsing a command line chooses the action of one.
using Commands = void (*)(CLI::App&, std::function<int()>&);
void add_all_commands(CLI::App& app, std::function<int()>& action);

/// The command that `words` (without the program's name) ask for, before it does anything; a link stands for the words
/// of a command. Throws InputError.
std::function<int()> parse(std::vector<std::string> words, Commands commands = add_all_commands);

/// Runs the command that `words` asks for. Bad input gives one line on stderr and 2.
int run(const std::vector<std::string>& words, Commands commands = add_all_commands);

}  // namespace zstep::cli
