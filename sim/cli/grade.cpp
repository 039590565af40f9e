// zstep grade: what a submission of a homework earns, and where it first goes wrong.
#include <algorithm>
#include <array>
#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/homework/reports.hpp"
#include "sim/image/file.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/diff/diff.hpp"
#include "traces/error.hpp"

namespace zstep::cli {
namespace {

struct GradeOptions {
  std::string folder, submission, scene, student, format = "text", out;
  bool view = false;
  ShowOptions show;
};

const std::vector<std::string> grade_formats{"text", "json", "gradescope", "prairielearn", "junit"};

const homework::Task& task_called(const homework::Homework& given, const std::string& name) {
  std::vector<std::string> names;
  for (const homework::Task& task : given.tasks) {
    if (task.name == name) return task;
    names.push_back(task.name);
  }
  throw InputError("--scene", fmt::format("the homework has no scene '{}'", name),
                   did_you_mean(name, names, "it has " + enumerate(names, "and")));
}

std::string report(const homework::Assessment& all, const GradeOptions& options, double seconds) {
  switch (parse_choice("--format", options.format, grade_formats)) {
    case 0:
      return homework::report_text(
          all, fmt::format("zstep grade --homework {} {}", shell_word(options.folder), shell_word(options.submission)) +
                   (options.student.empty() ? "" : " --student " + shell_word(options.student)));
    case 1:
      return homework::report_json(all);
    case 2:
      return homework::report_gradescope(all, seconds);
    case 3:
      return homework::report_prairielearn(all);
    default:
      return homework::report_junit(all);
  }
}

/// The window with the reference and the run, at the first step that is wrong.
int show_runs(const homework::Homework& given, const homework::Assessment& all, const GradeOptions& options) {
  const auto wrong = std::find_if(all.tasks.begin(), all.tasks.end(), [](const homework::Graded& task) {
    return task.state == homework::Graded::State::judged && !task.from_picture && task.first;
  });
  const auto judged = wrong != all.tasks.end()
                          ? wrong
                          : std::find_if(all.tasks.begin(), all.tasks.end(), [](const homework::Graded& task) {
                              return task.state == homework::Graded::State::judged && !task.from_picture;
                            });
  if (judged == all.tasks.end())
    throw InputError("--view", "there is no run that can be shown", "hand in one that can be read");
  const homework::Runs runs = homework::runs_of(given, *judged->task, judged->file);
  const diff::DiffReport difference = diff::compare(runs.reference, runs.submission);
  const AgainstRun with{&runs.submission, &difference, options.show.at.empty()};
  return show(runs.reference, options.show, {.against = &with});
}

int run(const GradeOptions& options) {
  parse_choice("--format", options.format, grade_formats);
  if (!options.out.empty()) check_outputs({}, {options.folder + "/homework.toml", options.submission}, {options.out});
  check_view(options.view, options.show, {options.submission});
  const auto begin = std::chrono::steady_clock::now();
  const homework::Homework given = homework::load_homework(options.folder, options.student);
  if (given.seeded() && options.student.empty())
    throw InputError(options.folder, "has scenes of each student's own", "say whose they are: --student NAME");
  if (!options.scene.empty()) task_called(given, options.scene);
  Watch watch;
  const homework::Assessment all = homework::assess(
      given, options.submission, options.scene,
      [&](const homework::Task& task) { watch.show(fmt::format("grading: {} (Ctrl-C stops)", task.name)); });
  watch.clear_line();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string text = report(all, options, seconds);
  if (options.out.empty()) {
    fmt::print("{}", text);
  } else {
    write_file(options.out, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    say_written(options.out, "the grade");
  }
  if (options.view)
    if (const int code = show_runs(given, all, options); code != exit_code::done) return code;
  if (!all.gradable()) return exit_code::bad_input;
  const bool right = std::all_of(all.tasks.begin(), all.tasks.end(), [](const homework::Graded& task) {
    return task.state == homework::Graded::State::judged && !task.first && task.why.empty();
  });
  return right ? exit_code::done : exit_code::finding;
}

}  // namespace

void add_grade(CLI::App& app, Action& action) {
  const auto options = std::make_shared<GradeOptions>();
  CLI::App* command = app.add_subcommand("grade", "What does a submission of a homework earn?");
  command->add_option("submission", options->submission, "A run as JSON Lines, or a folder of SCENE.jsonl files")
      ->type_name("FILE.jsonl")
      ->required();
  command->add_option("--homework", options->folder, "The folder with homework.toml")->type_name("FOLDER")->required();
  command->add_option("--scene", options->scene, "Grade the run of this scene alone")->type_name("NAME");
  command->add_option("--student", options->student, "Whose submission it is, where scenes are each student's own")
      ->type_name("NAME");
  command->add_option("--format", options->format, "The report's format (default text)")
      ->type_name("text|json|gradescope|prairielearn|junit");
  command->add_option("-o,--output", options->out, "The file to write (default: print it)")->type_name("FILE");
  command->add_flag("--view", options->view, "Then open the viewer at the first wrong step, beside the reference");
  add_show_options(*command, options->show);
  command->footer(
      "The scene, the conventions and the reference are the homework's own: what the submission says of them is not\n"
      "looked at. Points are counted in steps, as docs/homework.md says. Exit code 0: all is right; 1: not; 2: "
      "nothing\n"
      "could be graded.\n"
      "\n"
      "Examples:\n"
      "  zstep grade --homework hw3 runs\n"
      "  zstep grade --homework hw3 triangle.jsonl --view\n"
      "  zstep grade --homework hw3 runs --format gradescope -o results.json");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace zstep::cli
