// zstep emit: a file by which a program of one's own prints its run.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/words.hpp"
#include "sim/homework/emitters.hpp"
#include "traces/image/file.hpp"
#include "traces/error.hpp"
#include "traces/file/jsonl.hpp"

namespace zstep::cli {
namespace {

struct EmitOptions {
  std::size_t language = 0;
  RunOptions run;
  std::string folder;
};

constexpr std::size_t most_of_header = std::size_t{1} << 20;  ///< that a compiler takes

/// As ASCII, which every compiler reads.
std::string in_ascii(const std::string& header) { return nlohmann::ordered_json::parse(header).dump(-1, ' ', true); }

int emit(const EmitOptions& options) {
  const auto language = static_cast<homework::Language>(options.language);
  const std::filesystem::path to = std::filesystem::path(options.folder) / homework::emitter_file(language, "zstep");
  check_outputs({}, {options.run.scene}, {to.string()});
  Header header;
  std::string first_line;
  if (options.run.scene.empty()) {
    for (const CLI::Option* option : options.run.declared)
      if (option->count() > 0 && !option->check_lname("algorithm"))
        throw InputError(option->get_name(), "is of a scene", "name the scene behind the language, as delhi");
    const Method& by = method(options.run.algorithm);
    header = header_for(by, conventions_for(by, {}));
  } else {
    const Run run = prepare_within_budget(options.run);
    header = header_of(run);
    header.writer = "a program";
    first_line = in_ascii(jsonl_header(header, run.scene));
    if (first_line.size() > most_of_header)
      throw InputError(options.run.scene, "is too large a scene to stand in a program's text",
                       "leave it out, write zstep header SCENE -o head.jsonl, and call header(\"head.jsonl\")");
  }
  const std::string text = homework::emitter(language, header.page, first_line, "zstep");
  write_file(to, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  say_written(to.string(), fmt::format("for {}, {} of {}{}", homework::languages[options.language].name,
                                       counted(std::ssize(header.page), "step", "steps"), header.title,
                                       first_line.empty() ? "" : ", and the header of " + options.run.scene));
  return exit_code::done;
}

}  // namespace

void add_emit(CLI::App& app, Action& action) {
  const auto options = std::make_shared<EmitOptions>();
  CLI::App* command = app.add_subcommand("emit", "Write a file by which your own program prints its run");
  std::vector<std::string> ids;
  for (const homework::LanguageText& language : homework::languages) ids.emplace_back(language.id);
  command
      ->add_option_function<std::string>(
          "language",
          [options, ids](const std::string& text) { options->language = parse_choice("zstep emit", text, ids); },
          "The language of your program")
      ->type_name(fmt::format("{}", fmt::join(ids, "|")))
      ->required();
  command
      ->add_option("scene", options->run.scene,
                   "The scene that it draws, whose header is then in the file; without one, header() reads what zstep "
                   "header has written")
      ->type_name("SCENE|MESH");
  command->add_option("-o,--output", options->folder, "The folder in which to write it")
      ->type_name("FOLDER")
      ->required()
      ->group("Output");
  add_run_options(*command, options->run);
  add_written_options(*command, options->run);
  add_limit_options(*command);
  command->footer(
      "The file needs nothing but the language. It has a call for each step of the method, which prints the step and\n"
      "the line of your program that called it; header() prints the first line. It can be switched off at no cost.\n"
      "\n"
      "Examples:\n"
      "  zstep emit python delhi -o .\n"
      "  zstep emit cpp -o src\n"
      "  zstep emit rust teapot --size 64x48 --interpolation increments -o src");
  command->callback([options, &action] { action = [options] { return emit(*options); }; });
}

}  // namespace zstep::cli
