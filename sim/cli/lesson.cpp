// zstep lesson, and zstep alone.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/classroom/lesson.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/words.hpp"
#include "traces/error.hpp"

namespace zstep::cli {
namespace {

struct LessonOptions {
  std::string name;
  ShowOptions show;
};

/// What opens where no lesson is named: the first about the Z-buffer in teaching order.
Lesson first_lesson(std::vector<Lesson> lessons) {
  if (lessons.empty())
    throw InputError("zstep lesson", "no lessons were found", "set ZSTEP_LESSONS to the folder that holds them");
  const std::string id = "z-buffer";
  for (Lesson& lesson : lessons)
    if (lesson.id.starts_with(id)) return std::move(lesson);
  for (Lesson& lesson : lessons)
    if (lesson.method == id) return std::move(lesson);
  return std::move(lessons.front());
}

Lesson lesson_named(const std::string& name) {
  std::vector<Lesson> lessons = all_lessons();
  if (name.empty()) return first_lesson(std::move(lessons));
  if (name.find_first_of("./\\") != std::string::npos) return find_lesson(name);
  std::vector<std::string> ids;
  for (Lesson& lesson : lessons) {
    if (lesson.id == name) return lesson;
    ids.push_back(lesson.id);
  }
  throw InputError(name, "there is no such lesson",
                   did_you_mean(name, ids, fmt::format("the lessons are {}", enumerate(ids, "and"))));
}

int open(Lesson lesson, const ShowOptions& options, bool at_start = false) {
  check_can_show(options);
  struct Shown {
    Lesson lesson;
    Trace trace;
  };
  Trace trace = run_lesson(lesson);
  const auto shown = std::make_shared<const Shown>(Shown{std::move(lesson), std::move(trace)});
  return show(shown->trace, options, {.lesson = &shown->lesson, .at_start = at_start, .kept = shown});
}

[[maybe_unused]] std::string first_steps_without_display(const std::string& lesson) {
  Table table({Table::Align::left, Table::Align::left});
  table.row({"zstep list", "name the methods, lessons and scenes"});
  table.row(
      {fmt::format("zstep lesson {} --at 600 --screenshot later.png", lesson), "a later step of the same lesson"});
  table.row({"zstep view pyramid --at 100 --screenshot step.png", "a step of another scene"});
  table.row({"zstep render teapot", "draw a picture"});
  table.row({"zstep record pyramid -o run.ztrace", "record every step"});
  table.row({"zstep info run.ztrace", "count them"});
  table.row({"zstep dump run.ztrace --to 40", "read them"});
  table.row({"zstep import run.jsonl -o run.ztrace", "bring in a trace of your own program"});
  return as_typed("These commands work without a display:\n" + table.text());
}

}  // namespace

int start() {
  Lesson lesson = lesson_named("");
  ShowOptions options;
#if ZSTEP_HAS_VIEWER
  if (!display_available()) {
    options.screenshot = "zstep.png";
    const std::string id = lesson.id;
    fmt::print("There is no display here, so the first picture of the lesson \"{}\" goes to a file.\n", lesson.title);
    const int code = open(std::move(lesson), options);
    fmt::print("{}", first_steps_without_display(id));
    return code;
  }
  // The one that was open last waits behind the start page.
  for (Lesson& one : all_lessons())
    if (one.id == last_lesson()) lesson = std::move(one);
#endif
  return open(std::move(lesson), options, true);
}

void add_lesson(CLI::App& app, Action& action) {
  const auto options = std::make_shared<LessonOptions>();
  CLI::App* command =
      app.add_subcommand("lesson", "Open a lesson in the viewer; without a name, the one about the Z-buffer");
  command->add_option("name", options->name, "One of 'zstep list lessons', or the path of a lesson's .md")
      ->type_name("NAME");
  add_show_options(*command, options->show);
  add_notes_option(*command, options->show);
  add_race_options(*command, options->show);
  command->footer(
      "Examples:\n"
      "  zstep lesson\n"
      "  zstep lesson z-buffer --presenter\n"
      "  zstep lesson my-lesson.md --at 40 --screenshot lesson.png");
  command->callback(
      [options, &action] { action = [options] { return open(lesson_named(options->name), options->show); }; });
}

}  // namespace zstep::cli
