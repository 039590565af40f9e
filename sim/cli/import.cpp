// zstep import: JSON Lines, as students' programs write them, into a trace.
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "sim/cli/commands.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/words.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/trace.hpp"

namespace zstep::cli {
namespace {

struct ImportOptions {
  std::string from, to;
};

int import_trace(const ImportOptions& options) {
  const bool standard_input = options.from == "-" || options.from == "/dev/stdin";
  check_outputs({}, {standard_input ? "/dev/stdin" : options.from}, {options.to});
  InputFile from = standard_input ? InputFile::standard_input() : InputFile(options.from);
  if (const auto cut = import_jsonl(std::move(from), options.to)) complain_incomplete(*cut);
  say_written(options.to, counted(Trace::open(options.to).size(), "step", "steps"));
  return exit_code::done;
}

}  // namespace

void add_import(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command = app.add_subcommand("import", "Turn JSON Lines into a trace");
  command->add_option("jsonl", options->from, "The JSON Lines file, or - for standard input")
      ->type_name("FILE.jsonl")
      ->required();
  command->add_option("-o,--output", options->to, "The trace to write")
      ->type_name("FILE.ztrace")
      ->required()
      ->group("Output");
  command->footer(
      "An existing file is replaced; nothing is written when the input has a mistake.\n"
      "\n"
      "Examples:\n"
      "  zstep import homework.jsonl -o homework.ztrace\n"
      "  python3 my_zbuffer.py | zstep import - -o homework.ztrace");
  command->callback([options, &action] { action = [options] { return import_trace(*options); }; });
}

}  // namespace zstep::cli
