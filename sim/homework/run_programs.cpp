#include "sim/homework/run_programs.hpp"

#include <span>

#include <fmt/format.h>

#include "sim/homework/new_homework.hpp"
#include "sim/image/file.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/error.hpp"
#include "traces/file/input.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_noted = 4096;

fs::path note_beside(const fs::path& run) { return fs::path(run).replace_extension(".ended.txt"); }

bool lies_in(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  const fs::path inner = fs::weakly_canonical(path, ignored), outer = fs::weakly_canonical(folder, ignored);
  const fs::path way = inner.lexically_relative(outer);
  return !way.empty() && *way.begin() != "..";
}

/// An empty text removes the note.
void write_note(const fs::path& run, const std::string& text) {
  std::error_code ignored;
  if (text.empty()) fs::remove(note_beside(run), ignored);
  else write_file(note_beside(run), std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void check_folders(const Homework& homework, const fs::path& program, const fs::path& runs) {
  std::error_code ignored;
  if (!fs::is_directory(program, ignored))
    throw InputError(program.string(), "is no folder", "give the folder that the program is in");
  if (lies_in(homework.folder, program))
    throw InputError(program.string(), "holds the homework, which the program would see",
                     "put the program in a folder of its own");
  if (lies_in(runs, program))
    throw InputError(runs.string(), "lies in the program's folder", "give a folder beside it");
  if (fs::exists(fs::symlink_status(runs, ignored)) &&
      !(fs::is_directory(runs, ignored) && fs::is_empty(runs, ignored)))
    throw InputError(runs.string(), "is there already", "give the name of a new folder, or remove it");
  fs::create_directories(runs, ignored);
  if (!fs::is_directory(runs, ignored))
    throw InputError(runs.string(), "cannot be made", "check the folder it lies in");
}

}  // namespace

std::vector<ProgramRun> run_programs(const Homework& homework, const std::string& command, const fs::path& program,
                                     const fs::path& runs, const std::function<void(const Task&)>& on_task) {
  const std::string& typed = command.empty() ? homework.program : command;
  if (typed.empty())
    throw InputError((homework.folder / "homework.toml").string(), "says of no program how it is run",
                     "give --program 'python3 zbuffer.py', or write it under [program] as command");
  check_folders(homework, program, runs);
  const auto file_of = [&](const Task& task) { return runs / (task.name + ".jsonl"); };
  // Whatever ends this process, a run that is not there, or not to its end, is not taken for what the program did.
  for (const Task& task : homework.tasks)
    write_note(file_of(task),
               "The program was not run to its end: something stopped the grader from outside. Have it "
               "graded once more.\n");
  std::vector<ProgramRun> all;
  try {
    for (const Task& task : homework.tasks) {
      on_task(task);
      const fs::path file = file_of(task);
      const Ended ended = run_in_sandbox(typed, program, task.name, plain_numbers(*homework.method, task.scene), file,
                                         homework.limits, [&] { on_task(task); });
      write_note(file, ended.how == Ended::How::well
                           ? std::string()
                           : fmt::format("The program {}.\n{}", text_of(ended, homework.limits, !task.hidden),
                                         printable_lines(ended.errors)));
      all.push_back({&task, ended, file});
    }
  } catch (const InputError& error) {
    for (std::size_t left = all.size(); left < homework.tasks.size(); ++left) {
      try {
        write_note(file_of(homework.tasks[left]), fmt::format("The program was not run: {}\n", error.what()));
      } catch (const InputError&) {
        // What is thrown says why nothing can be written, too.
      }
    }
    throw;
  }
  return all;
}

std::string how_it_ended(const fs::path& run, bool hidden) {
  std::error_code ignored;
  const fs::path note = note_beside(run);
  if (!fs::is_regular_file(fs::symlink_status(note, ignored))) return "";
  InputFile in(note);
  std::string text(most_noted, '\0');
  text.resize(in.read(text.data(), text.size()));
  if (hidden) text.resize(std::min(text.size(), text.find('\n')));
  while (text.ends_with('\n')) text.pop_back();
  return printable_lines(text);
}

std::optional<SourceCommand> command_of_source(const fs::path& source) {
  const std::string name = source.filename().string(), word = shell_word(name), kind = source.extension().string();
  const char* then = " -o \"$TMPDIR/program\" && \"$TMPDIR/program\"";
  if (kind == ".py") return SourceCommand{"python3", "python3 " + word};
  if (kind == ".js") return SourceCommand{"node", "node " + word};
  if (kind == ".cpp") return SourceCommand{"c++", "c++ -std=c++17 -O1 " + word + then};
  if (kind == ".c") return SourceCommand{"cc", "cc -std=c99 -O1 " + word + " -lm" + then};
  if (kind == ".java")
    return SourceCommand{"javac",
                         "javac -d \"$TMPDIR\" *.java && java -cp \"$TMPDIR\" " + shell_word(source.stem().string())};
  return std::nullopt;
}

}  // namespace zstep::homework
