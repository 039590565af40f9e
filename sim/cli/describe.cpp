// zstep completion: scripts that teach a shell to complete zstep's command lines, made from the commands' declarations.

#include "sim/cli/describe.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/words.hpp"
#include "traces/events/fields.hpp"

namespace zstep::cli {

std::string camera_text(const Camera& camera) {
  if (camera.kind == Camera::Kind::screen) return "none: the points are (x_s, y_s, z) of the screen";
  const std::string where = camera.polar ? fmt::format("rho {}, theta {}, phi {}", camera.rho, camera.theta, camera.phi)
                                         : fmt::format("eye ({}, {}, {})", camera.eye.x, camera.eye.y, camera.eye.z);
  const std::string far = is_infinitely_far(camera) ? "infinite" : fmt::format("{}", camera.far);
  if (camera.matrices)
    return fmt::format("perspective, {}, by a projection matrix, near {}, far {}", where, camera.near, far);
  const std::string range = fmt::format("window {}, near {}, far {}", camera.window, camera.near, far);
  if (camera.kind == Camera::Kind::orthographic) return fmt::format("orthographic, {}, {}", where, range);
  return fmt::format("perspective, {}, d {}, {}", where, camera.d, range);
}

std::string raster_text(const Raster& raster) {
  return fmt::format("{}x{}, row 0 {}{}", raster.width, raster.height, raster.y_up ? "at the bottom" : "on top",
                     raster.corners ? ", pixels seen at their corners" : "");
}

std::string written_text(const WrittenAs& written) {
  std::string text;
  if (written.centre == WrittenAs::Centre::half) text = "pixel centres at halves: 1/2 is taken from its positions";
  if (written.axes == WrittenAs::Axes::right_handed)
    text += std::string(text.empty() ? "" : "; ") + "right-handed view coordinates: its z_v change their sign";
  return text;
}

std::string depth_text(const Camera& camera, Conventions::Depth depth) {
  if (camera.kind == Camera::Kind::screen) return "the points' own z";
  constexpr ByEnum<Conventions::Depth, const char*> texts{"pseudodepth (linear on the picture)",
                                                          "view (z_v)",
                                                          "corrected (z_v, by way of 1/z_v)",
                                                          "reciprocal (1/z_v)",
                                                          "reversed (1 at the near plane, 0 at the far one)",
                                                          "foley (0 at the near plane, -1 at the far one)",
                                                          "zero_to_one (0 at the near plane, 1 at the far one)"};
  const auto [low, high] = camera.depth_range;
  if (camera.depth_range.is_standard()) return texts[depth];
  if (depth == Conventions::Depth::reversed)
    return fmt::format("reversed ({} at the near plane, {} at the far one)", high, low);
  if (depth == Conventions::Depth::zero_to_one)
    return fmt::format("zero_to_one, in its range ({} at the near plane, {} at the far one)", low, high);
  return texts[depth];
}

std::string interpolation_text(Conventions::Interpolation interpolation) {
  constexpr ByEnum<Conventions::Interpolation, const char*> texts{
      "direct formula", "increments", "the plane's slopes -A/C and -B/C", "the plane's slopes -A/C and -B/C, added"};
  return texts[interpolation];
}

std::string coverage_text(Conventions::Coverage coverage, const Raster& raster) {
  switch (coverage) {
    case Conventions::Coverage::inclusive:
      return "inclusive (every x from x_L to x_R)";
    case Conventions::Coverage::round:
      return "round(x_L) to round(x_R)";
    case Conventions::Coverage::round_half_open:
      return "round(x_L) to round(x_R) - 1";
    case Conventions::Coverage::ceil_floor:
      return "ceil(x_L) to floor(x_R)";
    case Conventions::Coverage::top_left:
      break;
  }
  return fmt::format("top-left (centres inside, ties to the left edge and to that of the smaller y, the {} one)",
                     raster.y_up ? "bottom" : "top");
}

std::string nearer_text(Comparison::Nearer nearer) {
  return nearer == Comparison::Nearer::smaller ? "the smaller depth wins" : "the greater depth wins";
}

std::string ties_text(Comparison::Ties ties) {
  return ties == Comparison::Ties::first ? "of equal depths the first stays" : "of equal depths the last wins";
}

std::string numbers_text(const Conventions& conventions) {
  std::string text(word_of(conventions.number_format));
  if (bits_of(conventions.number_format) > 0)
    text += conventions.rounding == Conventions::Rounding::nearest ? ", rounded" : ", cut off";
  if (conventions.positions == Conventions::Positions::integer) text += ", vertices at whole pixels";
  if (conventions.positions == Conventions::Positions::subpixels) text += ", vertices at 256ths of a pixel";
  if (conventions.positions == Conventions::Positions::sixteenths) text += ", vertices at 16ths of a pixel";
  if (conventions.attribute == Conventions::Attribute::linear) text += ", attribute linear on the picture";
  if (conventions.attribute == Conventions::Attribute::perspective) text += ", attribute perspective-correct";
  return text;
}

std::string value_text(double value) { return fmt::format("{}", value); }

std::string fields_text(const Event& event) {
  std::string text;
  for (const FieldOfKind& field : fields_of_kind(event.index())) {
    text += fmt::format("{}{}=", text.empty() ? "" : " ", field.name);
    switch (field.type) {
      case FieldOfKind::Type::whole:
        text += std::to_string(field.whole_in(event));
        break;
      case FieldOfKind::Type::real:
        text += value_text(field.read(event));
        break;
      case FieldOfKind::Type::truth:
        text += field.true_in(event) ? "true" : "false";
        break;
      case FieldOfKind::Type::word:
        text += field.word_in(event);
        break;
    }
  }
  return text;
}

namespace {

struct OptionWords {
  std::vector<std::string> names;  ///< "--depth", "-o"
  std::string help;
  bool takes_value = false;
  bool takes_file = false;
  std::vector<std::string> values;  ///< what may follow, where that is known
};

struct CommandWords {
  std::string name, help;
  std::vector<OptionWords> options;
  std::vector<std::string> places;  ///< words that may stand as its argument
  bool takes_file = false;
};

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const BuiltIn& scene : built_in_scenes()) names.emplace_back(scene.name);
  return names;
}

/// The words behind a type name: "pseudodepth|view" are themselves, METHOD and SCENE are looked up.
std::vector<std::string> words_behind(std::string_view type) {
  std::vector<std::string> words;
  while (!type.empty()) {
    const std::size_t bar = std::min(type.find('|'), type.size());
    const std::string_view word = type.substr(0, bar);
    type.remove_prefix(std::min(bar + 1, type.size()));
    if (word == "METHOD") {
      for (const Method& m : methods()) words.emplace_back(m.id);
    } else if (word == "SCENE") {
      for (std::string& name : scene_names()) words.push_back(std::move(name));
    } else if (word == "NAME") {
      for (const Lesson& lesson : all_lessons()) words.push_back(lesson.id);
    } else if (word.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string_view::npos) {
      words.emplace_back(word);
    }
  }
  return words;
}

bool names_file(std::string_view type) {
  return type.find("FILE") != std::string_view::npos || type.find("MESH") != std::string_view::npos;
}

CommandWords words_of_command(const CLI::App& command) {
  CommandWords words{command.get_name(), command.get_description(), {}, {}, false};
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    if (option->get_positional()) {
      words.places = words_behind(type);
      words.takes_file = names_file(type);
      continue;
    }
    OptionWords entry{{}, option->get_description(), option->get_items_expected_max() > 0, names_file(type), {}};
    if (entry.takes_value) entry.values = words_behind(type);
    for (const std::string& name : option->get_lnames()) entry.names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) entry.names.push_back("-" + name);
    words.options.push_back(std::move(entry));
  }
  return words;
}

std::vector<CommandWords> all_commands(const CLI::App& app) {
  std::vector<CommandWords> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(words_of_command(*command));
  return commands;
}

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

/// For a shell's single quotes.
std::string shell_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string bash_script(const std::vector<CommandWords>& commands) {
  std::string values, arguments, names;
  for (const CommandWords& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    std::vector<std::string> options;
    for (const OptionWords& option : command.options) {
      options.insert(options.end(), option.names.begin(), option.names.end());
      if (!option.takes_value) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) patterns.push_back(command.name + ":" + name);
      const std::string what =
          option.takes_file ? "files=1" : fmt::format("words={}", shell_quoted(joined(option.values)));
      values += fmt::format("    {}) {} ;;\n", joined(patterns, "|"), what);
    }
    arguments += fmt::format("        {}) options={}; words={};{} ;;\n", command.name, shell_quoted(joined(options)),
                             shell_quoted(joined(command.places)), command.takes_file ? " files=1" : "");
  }
  return fmt::format(R"(# bash completion for zstep. To use it now:   source <(zstep completion bash)
# In every shell:   zstep completion bash > ~/.local/share/bash-completion/completions/zstep
_zstep() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command= options= words= files= word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    [[ $word == -* ]] || {{ command=$word; break; }}
  done
  case $command:$previous in
{}    *)
      case $command in
        '') options='--help --version'; words='{}' ;;
{}      esac
      [[ $current == -* ]] && words=$options files= ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  if [[ $files ]]; then
    compopt -o filenames 2> /dev/null
    local IFS=$'\n'
    COMPREPLY+=($(compgen -f -- "$current"))
  fi
}}
complete -F _zstep zstep ./zstep
)",
                     values, names, arguments);
}

/// A zsh description may not hold an unescaped bracket or colon.
std::string zsh_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_values(bool file, const std::vector<std::string>& words) {
  if (file && !words.empty())
    return fmt::format("_alternative \"words:name:({})\" \"files:file:_files\"", joined(words));
  return file ? "_files" : words.empty() ? " " : fmt::format("({})", joined(words));
}

std::string zsh_script(const std::vector<CommandWords>& commands) {
  std::string names, cases;
  for (const CommandWords& command : commands) {
    names += fmt::format("    {}\n", shell_quoted(command.name + ":" + command.help));
    cases += fmt::format("    {})\n      _arguments \\\n", command.name);
    for (const OptionWords& option : command.options)
      for (const std::string& name : option.names)
        cases += fmt::format(
            "        {} \\\n",
            shell_quoted(name + "[" + zsh_text(option.help) + "]" +
                         (option.takes_value ? ":value:" + zsh_values(option.takes_file, option.values) : "")));
    cases +=
        fmt::format("        {} ;;\n", shell_quoted("*:argument:" + zsh_values(command.takes_file, command.places)));
  }
  return fmt::format(R"(#compdef zstep
# zsh completion for zstep. To use it now:   source <(zstep completion zsh)
# In every shell:   zstep completion zsh > "${{fpath[1]}}/_zstep"
_zstep() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
if [[ $funcstack[1] == _zstep ]]; then _zstep "$@"; else compdef _zstep zstep; fi
)",
                     names, cases);
}

std::string fish_script(const std::vector<CommandWords>& commands) {
  std::string text =
      "# fish completion for zstep. To use it now:   zstep completion fish | source\n"
      "# In every shell:   zstep completion fish > ~/.config/fish/completions/zstep.fish\n"
      "complete -c zstep -n __fish_use_subcommand -f\n"
      "complete -c zstep -n __fish_use_subcommand -l version -d 'Print the version'\n";
  for (const CommandWords& command : commands) {
    const std::string condition = fmt::format("complete -c zstep -n '__fish_seen_subcommand_from {}'", command.name);
    text += fmt::format("complete -c zstep -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        shell_quoted(command.help));
    if (!command.takes_file) text += condition + " -f\n";
    if (!command.places.empty()) text += fmt::format("{} -a {}\n", condition, shell_quoted(joined(command.places)));
    for (const OptionWords& option : command.options) {
      text += condition;
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (option.takes_file) text += " -r -F";
      else if (option.takes_value)
        text += option.values.empty() ? " -x" : " -x -a " + shell_quoted(joined(option.values));
      text += " -d " + shell_quoted(option.help) + "\n";
    }
  }
  return text;
}

int completion(const CLI::App& app, const std::string& shell) {
  const std::vector<CommandWords> commands = all_commands(app);
  fmt::print("{}", shell == "bash"  ? bash_script(commands)
                   : shell == "zsh" ? zsh_script(commands)
                                    : fish_script(commands));
  return exit_code::done;
}

}  // namespace

void add_completion(CLI::App& app, Action& action) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("completion", "Print a script that lets a shell complete zstep's commands");
  const auto take = [shell](const std::string& text) {
    const std::vector<std::string> shells{"bash", "zsh", "fish"};
    *shell = shells.at(parse_choice("zstep completion", text, shells));
  };
  command->add_option_function<std::string>("shell", take, "The shell")->type_name("bash|zsh|fish")->required();
  command->footer(
      "Examples:\n  source <(zstep completion bash)\n  zstep completion fish > ~/.config/fish/completions/zstep.fish");
  command->callback([&app, shell, &action] { action = [&app, shell] { return completion(app, *shell); }; });
}

}  // namespace zstep::cli
