// zstep header: the first line of a program's own trace.
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/words.hpp"
#include "sim/image/file.hpp"
#include "traces/file/jsonl.hpp"

namespace zstep::cli {
namespace {

struct HeaderOptions {
  RunOptions run;
  std::string writer = "a program", nearer, ties, out;
  std::optional<double> initial_depth;
  bool as_computed = false;
};

int write(const HeaderOptions& options) {
  if (!options.out.empty()) check_outputs({}, {options.run.scene}, {options.out});
  const Run run = prepare_within_budget(options.run);
  Header header = header_for(*run.method, run.conventions);
  header.writer = options.writer;
  const auto choice = [](const char* name, const std::string& given, const std::vector<std::string>& words) {
    return given.empty() ? std::size_t{0} : parse_choice(name, given, words);
  };
  if (!options.nearer.empty())
    header.comparison.nearer =
        static_cast<Comparison::Nearer>(choice("--nearer", options.nearer, {"smaller", "greater"}));
  header.comparison.ties = static_cast<Comparison::Ties>(choice("--ties", options.ties, {"first", "last"}));
  header.initial_depth = options.initial_depth;
  std::string line = jsonl_header(header, run.scene);
  if (options.as_computed) {
    auto all = nlohmann::ordered_json::parse(line);
    all["conventions"]["number_format"] = "as computed";
    line = all.dump();
  }
  line += '\n';
  if (options.out.empty()) {
    fmt::print("{}", line);
    return exit_code::done;
  }
  write_file(options.out, std::span(reinterpret_cast<const std::uint8_t*>(line.data()), line.size()));
  say_written(options.out, fmt::format("the header of a run of {} on {}", run.method->title, run.scene.name));
  return exit_code::done;
}

}  // namespace

void add_header(CLI::App& app, Action& action) {
  const auto options = std::make_shared<HeaderOptions>();
  CLI::App* command = app.add_subcommand("header", "The first line of your own program's trace");
  add_run_options(*command, options->run);
  add_scene(*command, options->run);
  add_limit_options(*command);
  command->add_option("--writer", options->writer, "The name of the program")->type_name("NAME");
  command
      ->add_option("--nearer", options->nearer,
                   "Which of two depths is nearer (default: the smaller one, but for some choices of --depth)")
      ->type_name("smaller|greater");
  command
      ->add_option("--ties", options->ties,
                   "Which of two polygons with equal depths stays: the one drawn first (default), or last")
      ->type_name("first|last");
  add_number(*command, "--initial-depth", options->initial_depth, "What the depth buffer is cleared to");
  command
      ->add_flag("--as-computed", options->as_computed,
                 "Say that the number format is not known: zstep infers it from the digits")
      ->excludes(command->get_option("--number-format"));
  command->add_option("-o,--output", options->out, "The file to write (default: print it)")->type_name("FILE.jsonl");
  command->footer(
      "Scene, conventions and pseudo-code as one line of JSON. Write it as the first line of your program's output, "
      "then\n"
      "one line for each step, which names a line of the pseudo-code: docs/trace-format.md.\n"
      "\n"
      "Examples:\n"
      "  zstep header delhi -o run.jsonl\n"
      "  zstep header pyramid --interpolation increments --number-format float32 --ties last");
  command->callback([options, &action] { action = [options] { return write(*options); }; });
}

}  // namespace zstep::cli
