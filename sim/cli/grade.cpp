// zstep grade: what a submission of a homework earns, and where it first goes wrong.
#include <algorithm>
#include <array>
#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/grade.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/homework/child.hpp"
#include "sim/homework/reports.hpp"
#include "sim/image/file.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/diff/diff.hpp"
#include "traces/error.hpp"

namespace zstep::cli {
namespace {

const std::vector<std::string> grade_formats{"text", "json", "gradescope", "prairielearn", "junit", "html"};

std::size_t format_of(const GradeOptions& options) {
  return parse_choice("--format", options.format.value_or("text"), grade_formats);
}

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
  const std::string command =
      fmt::format("zstep grade --homework {} {}", shell_word(options.folder), shell_word(options.submission)) +
      (options.student.empty() ? "" : " --student " + shell_word(options.student));
  switch (format_of(options)) {
    case 0:
      return homework::report_text(all, command);
    case 1:
      return homework::report_json(all);
    case 2:
      return homework::report_gradescope(all, seconds);
    case 3:
      return homework::report_prairielearn(all);
    case 4:
      return homework::report_junit(all);
    default:
      return homework::report_html(all, command);
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
  const diff::DiffReport difference = diff::compare(*runs.reference, runs.submission);
  const AgainstRun with{&runs.submission, &difference, options.show.at.empty()};
  return show(*runs.reference, options.show, {.against = &with});
}

/// Time and memory by what was handed in; who looks at a window may take longer.
void limit_grading(const homework::Homework& given, const GradeOptions& options) {
  constexpr double mib = 1048576;
  std::uintmax_t bytes = 0;
  for (const homework::Task& task : given.tasks) {
    if (!options.scene.empty() && task.name != options.scene) continue;
    std::error_code error;
    const auto file = homework::run_of(options.submission, given, task, !options.scene.empty());
    const std::uintmax_t size = file.empty() ? 0 : std::filesystem::file_size(file, error);
    if (!error) bytes += size;
  }
  const homework::GradingLimits limits = homework::limits_for(bytes, seconds_given(), memory_given());
  begin_budget(limits.seconds, static_cast<double>(limits.memory) / mib);
}

int run(const GradeOptions& options) {
  if (!options.batch.empty()) {
    const homework::Homework given = homework::load_homework(options.folder);
    if (!options.scene.empty()) task_called(given, options.scene);
    return grade_class(given, options);
  }
  if (options.submission.empty())
    throw InputError("zstep grade", "what is to be graded is missing",
                     "give a run, the folder of one submission, or --batch FOLDER");
  for (const auto& [name, is_given] :
       {std::pair{"--jobs", options.jobs.has_value()}, {"--report", !options.report.empty()}})
    if (is_given) throw InputError(name, "is of a class", "leave it out, or give the class with --batch FOLDER");
  format_of(options);
  if (!options.out.empty()) check_outputs({}, {options.folder + "/homework.toml", options.submission}, {options.out});
  check_view(options.view, options.show, {options.submission});
  const auto begin = std::chrono::steady_clock::now();
  const homework::Homework given = homework::load_homework(options.folder, options.student);
  if (given.seeded() && options.student.empty())
    throw InputError(options.folder, "has scenes of each student's own", "say whose they are: --student NAME");
  if (!options.scene.empty()) task_called(given, options.scene);
  if (!options.view) limit_grading(given, options);
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
      ->type_name("FILE.jsonl");
  command->add_option("--homework", options->folder, "The folder with homework.toml")->type_name("FOLDER")->required();
  command->add_option("--scene", options->scene, "Grade the run of this scene alone")->type_name("NAME");
  command->add_option("--student", options->student, "Whose submission it is, where scenes are each student's own")
      ->type_name("NAME");
  command->add_option("--format", options->format, "The report's format (default text)")
      ->type_name("text|json|gradescope|prairielearn|junit|html");
  command->add_option("-o,--output", options->out, "The file to write (default: print it)")->type_name("FILE");
  command->add_option("--batch", options->batch, "A class: the folder with one file or one folder for each student")
      ->type_name("FOLDER");
  add_whole(*command, "--jobs", options->jobs, 1, "So many submissions at a time (default: one for each processor)")
      ->type_name("NUMBER");
  command->add_option("--report", options->report, "A page of the class: what fails most, points, all submissions")
      ->type_name("FILE.html");
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
      "  zstep grade --homework hw3 runs --format gradescope -o results.json\n"
      "  zstep grade --homework hw3 runs --format html -o page.html\n"
      "  zstep grade --homework hw3 --batch submissions --jobs 4 -o gradebook.csv");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace zstep::cli
