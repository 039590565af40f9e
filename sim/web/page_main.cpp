// The program of the page. It has the commands that links and published pages ask for, and no others, which would have
// to be fetched, too.
#include <string>
#include <vector>

#include "sim/cli/app.hpp"
#include "sim/cli/commands.hpp"

namespace {

void add_commands_of_page(CLI::App& app, zstep::cli::Action& action) {
  zstep::cli::add_lesson(app, action);
  zstep::cli::add_view(app, action);
  zstep::cli::add_check(app, action);
  zstep::cli::add_diff(app, action);
}

}  // namespace

int main(int argc, char** argv) {
  return zstep::cli::run(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc), add_commands_of_page);
}
