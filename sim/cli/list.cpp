// zstep list: what there is.
#include <memory>
#include <string>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/words.hpp"
#include "traces/mistakes/mistake.hpp"

namespace zstep::cli {
namespace {

using enum Table::Align;

std::string methods_text() {
  Table table({left, left, left});
  for (const Method& m : methods()) table.row({std::string(m.id), std::string(m.title), std::string(m.paper)});
  return table.text();
}

std::string options_text() {
  Table table({left, left, left, left});
  for (const Method& m : methods())
    for (const Option& option : m.options) {
      const std::string values =
          option.words.empty() ? fmt::format("{}…{}", option.least, option.most) : std::string(option.words);
      table.row(
          {std::string(m.id), fmt::format("{}={}", option.name, option.standard), values, std::string(option.meaning)});
    }
  return table.text();
}

std::string lessons_text() {
  Table table({left, left, left});
  for (const Lesson& lesson : all_lessons()) table.row({lesson.id, lesson.title, lesson.summary});
  const std::string text = table.text();
  return text.empty() ? "  none were found; set ZSTEP_LESSONS to the folder that holds them\n" : text;
}

std::string scenes_text() {
  Table table({left, left});
  for (const BuiltIn& scene : built_in_scenes()) table.row({std::string(scene.name), std::string(scene.description)});
  return table.text();
}

std::string mistakes_text() {
  Table table({left, left, left});
  for (std::size_t k = 0; k < mistakes::mistake_count; ++k) {
    const mistakes::MistakeText& text = mistakes::text_of(static_cast<mistakes::Mistake>(k));
    table.row({std::string(text.id), std::string(text.name), std::string(text.lesson)});
  }
  return table.text();
}

int list(const std::string& what) {
  const bool all = what.empty();
  if (all || what == "methods") fmt::print("{}{}", all ? "Methods (--algorithm NAME)\n" : "", methods_text());
  if (what == "options") fmt::print("{}", options_text());
  if (what == "mistakes") fmt::print("{}", mistakes_text());
  if (all || what == "lessons") fmt::print("{}{}", all ? "\nLessons (zstep lesson NAME)\n" : "", lessons_text());
  if (all || what == "scenes") {
    fmt::print("{}{}", all ? "\nScenes (zstep render NAME, record NAME, view NAME)\n" : "", scenes_text());
    fmt::print(
        "In place of a name: a .toml scene, a .obj, .off, .ply or .stl mesh, or a surface by its formula, \"y = sin(x) "
        "* cos(z)\".\n");
  }
  return exit_code::done;
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
  const auto what = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "list", "Name the methods and their options, the lessons, the scenes and the mistakes there are");
  const auto take = [what](const std::string& text) {
    const std::vector<std::string> words{"methods", "options", "lessons", "scenes", "mistakes"};
    *what = words.at(parse_choice("zstep list", text, words));
  };
  command->add_option_function<std::string>("what", take, "Only these")
      ->type_name("methods|options|lessons|scenes|mistakes");
  command->footer("Examples:\n  zstep list\n  zstep list lessons");
  command->callback([what, &action] { action = [what] { return list(*what); }; });
}

}  // namespace zstep::cli
