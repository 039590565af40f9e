#include "sim/cli/app.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/words.hpp"
#include "sim/words/link.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"

#if ZSTEP_HAS_VIEWER
#include "sim/viewer/settings.hpp"
#endif

namespace zstep::cli {
namespace {

constexpr std::size_t help_column = 32;

void declare(CLI::App& app, Action& action, Commands commands) {
  app.get_formatter()->column_width(help_column);
  app.set_version_flag("--version", "zstep " ZSTEP_VERSION, "Print the version");
  app.require_subcommand(0, 1);
  commands(app, action);
  app.footer(
      "Without a command a page opens to choose a lesson, a method, a scene or a file.\n"
      "\n"
      "Examples:\n"
      "  zstep\n"
      "  zstep view pyramid\n"
      "  zstep record teapot --size 640x480 -o teapot.ztrace\n"
      "  zstep record --help");
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

bool is_option(const std::string& word) {
  const bool number = word.size() > 1 && (word[1] == '.' || (word[1] >= '0' && word[1] <= '9'));
  return word.size() > 1 && word[0] == '-' && !number;
}

/// An option must have its value (after it, or joined to it), and stand once.
void check_option(const std::string& command, const CLI::Option& option, const std::string& name, bool value_follows,
                  const std::string& next, std::vector<const CLI::Option*>& given) {
  const bool takes_value = option.get_items_expected_min() > 0;
  if (takes_value && value_follows && (next.empty() || next.starts_with("--")))
    throw InputError(command, fmt::format("{} needs a value", name),
                     fmt::format("write {} {}", name, option.get_type_name()));
  if (takes_value && option.get_multi_option_policy() == CLI::MultiOptionPolicy::Throw &&
      std::find(given.begin(), given.end(), &option) != given.end())
    throw InputError(command, fmt::format("{} is given twice", name), "keep one of them");
  given.push_back(&option);
}

/// Says what is wrong with a mistyped command or option before CLI11 does, because it knows what was probably meant.
void check_words(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string name = "zstep";
  if (!words.empty() && !words[0].starts_with("-")) {
    const std::vector<std::string> commands = command_names(app);
    if (std::find(commands.begin(), commands.end(), words[0]) == commands.end()) {
      const bool file = words[0].find('.') != std::string::npos;
      throw InputError(
          "zstep", fmt::format("there is no command '{}'", words[0]),
          file ? fmt::format("to open it: zstep view {}", words[0])
               : did_you_mean(words[0], commands, fmt::format("the commands are {}", enumerate(commands, "and"))));
    }
    command = app.get_subcommand(words[0]);
    name += " " + words[0];
  }
  const std::vector<std::string> known = option_names(*command);
  std::vector<const CLI::Option*> given;
  for (std::size_t k = 0; k < words.size() && words[k] != "--"; ++k) {
    if (!is_option(words[k])) continue;
    const bool is_long = words[k].starts_with("--");
    const std::string option = words[k].substr(0, is_long ? words[k].find('=') : 2);
    if (std::find(known.begin(), known.end(), option) == known.end()) {
      const std::string typed = is_long ? option : words[k];
      throw InputError(name, fmt::format("there is no option {}", typed),
                       did_you_mean(typed, known, fmt::format("'{} --help' names them", name)));
    }
    check_option(name, *command->get_option(option), option, words[k] == option,
                 k + 1 < words.size() ? words[k + 1] : "", given);
  }
}

const CLI::App& chosen(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

/// What prints a text.
Action printing(std::string text) {
  return [text = std::move(text)] {
    fmt::print("{}", text);
    return exit_code::done;
  };
}

}  // namespace

std::function<int()> parse(std::vector<std::string> words, Commands commands) {
  if (!words.empty() && is_link(words[0])) {
    std::vector<std::string> meant = words_of_link(words[0]);
    if (meant[0] == "view") meant.emplace_back("--patient");
    meant.insert(meant.end(), words.begin() + 1, words.end());
    words = std::move(meant);
  }
  Action action = start;
  // Kept by what is returned: a command may ask for the others.
  const auto kept = std::make_shared<CLI::App>(
      "zstep shows how a computer decides what is visible: every step of a method, recorded and replayed.", "zstep");
  CLI::App& app = *kept;
  declare(app, action, commands);
  set_commands(command_names(app));
  try {
    check_words(app, words);
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::CallForHelp&) {
    return printing(as_typed(chosen(app).help(&chosen(app) == &app ? "" : "zstep")));
  } catch (const CLI::CallForVersion&) {
    return printing(fmt::format("zstep {}\n", ZSTEP_VERSION));
  } catch (const CLI::ParseError& error) {
    const CLI::App& command = chosen(app);
    const std::string name = &command == &app ? "zstep" : "zstep " + command.get_name();
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !command.remaining().empty())
      what = fmt::format("does not know what to do with '{}'", command.remaining().front());
    throw InputError(name, what, fmt::format("see '{} --help'", name));
  }
  return [kept, action] { return action(); };
}

namespace {

/// What the machine refused is no mistake in zstep: a folder that is gone, a disk that is full, no more processes.
int refused_by_system(const std::system_error& error) {
  constexpr std::array lacking{std::errc::no_space_on_device,  std::errc::file_too_large,
                               std::errc::not_enough_memory,   std::errc::resource_unavailable_try_again,
                               std::errc::too_many_files_open, std::errc::too_many_files_open_in_system};
  const bool lacks = std::find(lacking.begin(), lacking.end(), error.code()) != lacking.end();
  const auto* of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  const std::string where = of_file != nullptr && !of_file->path1().empty() ? of_file->path1().string() : "the system";
  complain(fmt::format("{}: {}; {}", where, of_file != nullptr ? error.code().message() : error.what(),
                       lacks                ? "make room on the disk, or close other programs"
                       : of_file != nullptr ? "see that it is there, and that you may read and write it"
                                            : "try it again"));
  return lacks ? exit_code::exhausted : exit_code::bad_input;
}

int run_command(const std::vector<std::string>& words, Commands commands) {
  try {
    const int code = parse(words, commands)();
    return code == exit_code::done && is_incomplete() ? exit_code::incomplete : code;
  } catch (const Exhausted& error) {
    complain(error.what());
    return exit_code::exhausted;
  } catch (const Incomplete& error) {
    complain(error.what());
    return exit_code::incomplete;
  } catch (const InputErrors& error) {
    complain_lines(error.what());
    return exit_code::bad_input;
  } catch (const InputError& error) {
    complain(error.what());
    return exit_code::bad_input;
  } catch (const Interrupted&) {
    complain("stopped by Ctrl-C");
    return exit_code::interrupted;
  } catch (const std::bad_alloc&) {
    const std::string met = memory_budget_met();
    complain(met.empty() ? "zstep: there is not enough memory; try a smaller --size" : met);
    return met.empty() ? exit_code::exhausted : exit_code::incomplete;
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0) return exit_code::done;  // of which after_printing() says more
    return refused_by_system(error);
  } catch (const std::exception& error) {
    complain(fmt::format("zstep: this is a mistake in zstep itself, please report it: {}", error.what()));
  }
  return exit_code::mistake;
}

}  // namespace

int run(const std::vector<std::string>& words, Commands commands) {
#if ZSTEP_HAS_VIEWER
  note_input(viewer::settings_path());
#endif
  return after_printing(run_command(words, commands));
}

void add_all_commands(CLI::App& app, Action& action) {
  add_list(app, action);
  add_lesson(app, action);
  add_view(app, action);
  add_render(app, action);
  add_record(app, action);
  add_info(app, action);
  add_dump(app, action);
  add_find(app, action);
  add_history(app, action);
  add_why_not(app, action);
  add_explain(app, action);
  add_check(app, action);
  add_diff(app, action);
  add_homework(app, action);
  add_grade(app, action);
  add_error(app, action);
  add_header(app, action);
  add_emit(app, action);
  add_query(app, action);
  add_export(app, action);
  add_import(app, action);
  add_publish(app, action);
  add_compare_methods(app, action);
  add_completion(app, action);
}

}  // namespace zstep::cli
