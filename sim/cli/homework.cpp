// zstep homework: makes the folder of a homework.
#include <memory>

#include <fmt/format.h>

#include "sim/cli/commands.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/words.hpp"
#include "sim/homework/new_homework.hpp"

namespace zstep::cli {

void add_homework(CLI::App& app, Action& action) {
  struct HomeworkOptions {
    std::string what, method, folder;
  };
  const auto options = std::make_shared<HomeworkOptions>();
  CLI::App* command = app.add_subcommand("homework", "Make a homework: a folder with all that it needs");
  command->add_option("what", options->what, "What is to be done: new")->type_name("new")->required();
  command->add_option("method", options->method, "The method: " + enumerate(homework::homework_methods(), "or"))
      ->type_name("METHOD")
      ->required();
  command->add_option("folder", options->folder, "The folder, which is made")->type_name("FOLDER")->required();
  command->footer(
      "Scenes, what is graded and its points, hand-out, starters, and a solution apart: docs/homework.md says what is\n"
      "what. All of it may be changed.\n"
      "\n"
      "Examples:\n"
      "  zstep homework new z-buffer my-homework");
  command->callback([options, &action] {
    action = [options] {
      parse_choice("homework", options->what, std::vector<std::string>{"new"});
      for (const std::string& file : homework::new_homework(options->method, options->folder))
        fmt::print("{}/{}\n", options->folder, file);
      return exit_code::done;
    };
  });
}

}  // namespace zstep::cli
