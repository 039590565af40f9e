// zstep grade: what a submission of a homework earns, and where it first goes wrong.

#include "sim/cli/grade.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/publish.hpp"
#include "sim/cli/words.hpp"
#include "sim/homework/batch.hpp"
#include "sim/homework/pictures.hpp"
#include "sim/homework/report_words.hpp"
#include "sim/homework/reports.hpp"
#include "traces/image/file.hpp"
#include "sim/pages/page.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/numbers.hpp"
#include "traces/diff/diff.hpp"
#include "traces/error.hpp"
#include "traces/file/container.hpp"
#include "traces/file/files.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/text.hpp"

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

std::string report(const homework::Assessment& all, const GradeOptions& options, double seconds,
                   const std::string& steps_page = "") {
  const std::string command = printable(
      fmt::format("zstep grade --homework {} {}", shell_word(options.folder), shell_word(options.submission)) +
      (options.student.empty() ? "" : " --student " + shell_word(options.student)));
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
      return homework::report_html(all, command, steps_page);
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
  const homework::Runs runs =
      homework::runs_of(given, *judged->task, judged->file,
                        judged->left_out.empty() ? homework::Look::at_all : homework::Look::at_what_is_there);
  const diff::DiffReport difference = diff::compare(*runs.reference, runs.submission);
  const AgainstRun with{&runs.submission, &difference, options.show.at.empty()};
  return show(*runs.reference, options.show, {.against = &with});
}

/// Time and memory by what was handed in.
homework::GradingLimits limits_of(const homework::Homework& given, const GradeOptions& options) {
  std::uintmax_t bytes = 0;
  for (const homework::Task& task : given.tasks) {
    if (!options.scene.empty() && task.name != options.scene) continue;
    std::error_code error;
    const auto file = homework::run_of(options.submission, given, task, !options.scene.empty());
    const std::uintmax_t size = file.empty() ? 0 : std::filesystem::file_size(file, error);
    if (!error) bytes += size;
    if (!file.empty()) note_input(file);  // no report is written over it
    for (const std::filesystem::path& picture : homework::pictures_of(options.submission, task)) note_input(picture);
  }
  return homework::limits_for(bytes, seconds_given(), memory_given());
}

int code_of(const homework::Assessment& all) {
  if (!all.gradable()) return exit_code::bad_input;
  return homework::all_right(all) ? exit_code::done : exit_code::finding;
}

/// The page of both runs, where one is asked for and was written, as a link in the report names it.
std::string made_steps_page(const homework::Homework& given, const homework::Assessment& all,
                            const GradeOptions& options) {
  if (options.steps_page.empty() || !write_steps_page(given, all, options)) return "";
  return std::filesystem::absolute(options.steps_page)
      .lexically_relative(std::filesystem::absolute(options.out).parent_path())
      .generic_string();
}

void check_steps_page(const GradeOptions& options) {
  if (options.steps_page.empty()) {
    if (!options.site.empty()) throw InputError("--site", "is of the page of both runs", "add --steps FILE.html");
    return;
  }
  if (format_of(options) != grade_formats.size() - 1 || options.out.empty())
    throw InputError("--steps", "is a page that a report of HTML leads to", "add --format html -o FILE.html");
  page_without_run(options.site);
}

/// Grades in a process of its own: whatever becomes of that, there is a report, and it says so.
Answer grade_apart(const homework::Homework& given, const GradeOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const auto grade = [&] {
    const homework::Assessment all = homework::assess(given, options.submission, options.scene);
    return Answer{report(all, options, seconds(), made_steps_page(given, all, options)), code_of(all)};
  };
  const auto say_why = [&](const std::string& why) {
    const std::string text = "could not be graded: the grading " + why;
    complain(fmt::format("{}: {}", options.submission, text));
    return report(homework::not_graded(given, options.submission, options.scene, text), options, seconds());
  };
  Watch watch;
  return answer_apart(limits_of(given, options), grade, say_why, watch);
}

void write_report(const std::string& text, const GradeOptions& options) {
  if (options.out.empty()) {
    fmt::print("{}", text);
    return;
  }
  write_file(options.out, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  say_written(options.out, "the grade");
  if (options.steps_page.empty()) return;
  if (text.find(homework::steps_link) != std::string::npos) say_written(options.steps_page, "both runs, from there on");
  else complain(fmt::format("{}: was not written, as no step that may be shown is wrong", options.steps_page));
}

/// Grades and opens the window. Who looks at it may take as long as it takes.
int grade_and_show(const homework::Homework& given, const GradeOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Watch watch;
  const homework::Assessment all = homework::assess(
      given, options.submission, options.scene,
      [&](const homework::Task& task) { watch.show(fmt::format("grading: {} (Ctrl-C stops)", task.name)); });
  watch.clear_line();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_report(report(all, options, seconds, made_steps_page(given, all, options)), options);
  const int code = show_runs(given, all, options);
  return code != exit_code::done ? code : code_of(all);
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
  std::vector<std::string> outputs;
  for (const std::string& path : {options.out, options.steps_page})
    if (!path.empty()) outputs.push_back(path);
  if (!outputs.empty()) check_outputs({}, {options.folder + "/homework.toml", options.submission}, outputs);
  check_steps_page(options);
  check_view(options.view, options.show, {options.submission});
  const homework::Homework given = homework::load_homework(options.folder, options.student);
  if (given.seeded() && options.student.empty())
    throw InputError(options.folder, "has scenes of each student's own", "say whose they are: --student NAME");
  if (!options.scene.empty()) task_called(given, options.scene);
  if (options.view) return grade_and_show(given, options);
  const Answer answer = grade_apart(given, options);
  write_report(answer.text, options);
  return answer.code;
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
  command
      ->add_option("--steps", options->steps_page,
                   "With --format html: a page that the report leads to, which shows both runs from the first wrong "
                   "step on, in any browser")
      ->type_name("FILE.html");
  add_site_option(*command, options->site);
  command->add_flag("--view", options->view, "Then open the viewer at the first wrong step, beside the reference");
  add_show_options(*command, options->show);
  command->footer(
      "The scene, the conventions and the reference are the homework's own: what the submission says of them is not\n"
      "looked at. Points are counted in steps, as docs/homework.md says. Exit code 0: all is right; 1: not; 2: "
      "nothing\n"
      "could be graded; 3: time or memory was used up, and the report says that it could not be graded.\n"
      "\n"
      "Examples:\n"
      "  zstep grade --homework hw3 runs\n"
      "  zstep grade --homework hw3 triangle.jsonl --view\n"
      "  zstep grade --homework hw3 runs --format gradescope -o results.json\n"
      "  zstep grade --homework hw3 runs --format html -o page.html\n"
      "  zstep grade --homework hw3 runs --format html -o page.html --steps steps.html\n"
      "  zstep grade --homework hw3 --batch submissions --jobs 4 -o gradebook.csv");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

// zstep grade --batch: a class, its gradebook and its report.

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_jobs = 256;

bool lies_in(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  const fs::path inner = fs::weakly_canonical(path, ignored), outer = fs::weakly_canonical(folder, ignored);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

void check_class(const GradeOptions& options) {
  const auto needless = [](const char* name, bool given) {
    if (given) throw InputError(name, "is of one submission", "leave it out, or leave out --batch");
  };
  needless("--format", options.format.has_value());
  needless("--view", options.view);
  needless("--student", !options.student.empty());
  needless("--steps", !options.steps_page.empty());
  needless("--site", !options.site.empty());
  if (!options.submission.empty())
    throw InputError(options.submission, "is one submission, and --batch grades a folder of them", "keep one of them");
  if (options.out.empty())
    throw InputError("--batch", "needs a file for the gradebook", "write for example -o gradebook.csv");
  std::vector<std::string> outputs{options.out};
  if (!options.report.empty()) outputs.push_back(options.report);
  check_outputs({}, {options.folder + "/homework.toml"}, outputs);
  for (const std::string& path : outputs)
    if (lies_in(path, options.batch))
      throw InputError(path, "lies among the submissions", "write it to another folder");
  if (options.jobs && (*options.jobs < 1 || *options.jobs > most_jobs))
    throw InputError("--jobs", fmt::format("is {}", *options.jobs), fmt::format("give 1 to {}", most_jobs));
}

void write_whole(const std::string& path, const std::string& text) {
  write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

/// "27 graded, 1 partly graded, 2 ungradable"
std::string counted_states(const homework::Batch& batch) {
  using State = homework::Result::State;
  std::string text;
  for (const State state : {State::graded, State::partly, State::ungradable, State::missing}) {
    const auto count = std::count_if(batch.results.begin(), batch.results.end(),
                                     [&](const homework::Result& result) { return result.state == state; });
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, homework::word_of(state));
  }
  return text;
}

}  // namespace

int grade_class(const homework::Homework& given, const GradeOptions& options) {
  check_class(options);
  homework::BatchOptions how;
  how.submissions = options.batch;
  how.results = options.out + ".results";
  how.scene = options.scene;
  how.seconds = seconds_given(), how.memory = memory_given();
  how.jobs = static_cast<int>(options.jobs.value_or(std::max(1u, std::thread::hardware_concurrency())));
  Watch watch;
  std::size_t done = 0, all = 0;
  homework::Batch batch;
  try {
    batch = homework::grade_batch(given, how, [&](std::size_t done_now, std::size_t all_now) {
      done = done_now, all = all_now;
      watch.check();
      watch.show(fmt::format("grading: {} of {} submissions (Ctrl-C stops and keeps them)", done, all));
    });
  } catch (const Interrupted&) {
    watch.clear_line();
    complain(fmt::format("{} of {} submissions are graded and kept in {}; the same command goes on from there", done,
                         all, how.results.string()));
    throw;
  }
  watch.clear_line();
  write_whole(options.out, homework::gradebook_csv(given, batch));
  say_written(options.out, counted(std::ssize(batch.results), "submission", "submissions") +
                               (batch.results.empty() ? "" : ": " + counted_states(batch)));
  if (!options.report.empty()) {
    write_whole(options.report, homework::class_html(given, batch));
    say_written(options.report, "the class on one page");
  }
  if (batch.taken_over > 0) fmt::print("{} of them had been graded before, and nothing changed\n", batch.taken_over);
  if (batch.left_out > 0) fmt::print("names that begin with a dot, left out: {}\n", batch.left_out);
  const bool gradable = std::none_of(batch.results.begin(), batch.results.end(), [](const homework::Result& result) {
    return result.state == homework::Result::State::ungradable;
  });
  return gradable ? exit_code::done : exit_code::finding;
}

// The page beside a report in which the reader steps through both runs.

namespace {

PublishedFile file_in_page(std::string name, const Trace& trace) {
  std::ostringstream lines;
  write_jsonl(trace, lines);
  const std::string text = without_paths_of_jsonl(std::move(lines).str());
  return {std::move(name), gzip({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()})};
}

}  // namespace

bool write_steps_page(const homework::Homework& given, const homework::Assessment& all, const GradeOptions& options) {
  const homework::Graded* const wrong = homework::first_to_mend(all);
  if (!wrong || wrong->from_picture) return false;
  const homework::Runs runs =
      homework::runs_of(given, *wrong->task, wrong->file,
                        wrong->left_out.empty() ? homework::Look::at_all : homework::Look::at_what_is_there);
  const std::filesystem::path empty_page = page_without_run(options.site);
  const std::vector<std::uint8_t> empty = read_file(empty_page);
  const std::vector<PublishedFile> files = {file_in_page("expected.jsonl", *runs.reference),
                                            file_in_page("yours.jsonl", runs.submission)};
  const std::vector<std::string> words = {"diff", files[0].name, files[1].name, "--view"};
  const std::string page = published({empty.begin(), empty.end()}, empty_page.string(), words, files);
  write_file(options.steps_page, {reinterpret_cast<const std::uint8_t*>(page.data()), page.size()});
  return true;
}

}  // namespace zstep::cli
