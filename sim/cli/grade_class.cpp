// zstep grade --batch: a class, its gradebook and its report.
#include <algorithm>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "sim/cli/budget.hpp"
#include "sim/cli/grade.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/homework/batch.hpp"
#include "sim/image/file.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
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
  say_written(options.out, counted(static_cast<std::int64_t>(batch.results.size()), "submission", "submissions") +
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

}  // namespace zstep::cli
