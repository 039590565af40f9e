// zstep homework: makes the folder of a homework and one for each student, tries it, runs programs of submissions, and
// packs it for courses.

#include "sim/cli/homework.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/words.hpp"
#include "sim/homework/folders.hpp"
#include "sim/homework/new_homework.hpp"
#include "sim/homework/own_scenes.hpp"
#include "sim/homework/pack_homework.hpp"
#include "sim/homework/run_programs.hpp"
#include "sim/words/escaped.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

struct HomeworkOptions {
  std::string what, program, out, names, seed, student;
  std::vector<std::string> words;
  bool gradescope = false, prairielearn = false, github = false;
};

/// The words after `what`: as many as it takes.
const std::vector<std::string>& words_for(const HomeworkOptions& options, std::size_t count, const char* usage) {
  if (options.words.size() == count) return options.words;
  throw InputError("homework " + options.what,
                   options.words.size() < count ? "too little is given" : "too much is given", usage);
}

int make_new(const HomeworkOptions& options) {
  const auto& words = words_for(options, 2, "type zstep homework new METHOD FOLDER");
  for (const std::string& file : homework::new_homework(words[0], words[1]))
    fmt::print("{}\n", printable(words[1] + "/" + file));
  return exit_code::done;
}

int refresh(const HomeworkOptions& options) {
  const auto& words = words_for(options, 1, "type zstep homework refresh FOLDER");
  const auto written = homework::refresh_homework(words[0]);
  for (const std::string& file : written) fmt::print("{}\n", printable(words[0] + "/" + file));
  if (written.empty()) fmt::print("All is as it must be.\n");
  return exit_code::done;
}

int try_it(const HomeworkOptions& options) {
  const auto& words = words_for(options, 1, "type zstep homework try FOLDER");
  Watch watch;
  const bool right = homework::try_homework(
      words[0],
      [&](homework::Tried tried, const std::string& text) {
        watch.clear_line();
        fmt::print("{}  {}\n",
                   tried == homework::Tried::right   ? "ok"
                   : tried == homework::Tried::wrong ? "no"
                                                     : "--",
                   printable_lines(text));
      },
      [&](const std::string& work) { watch.show(fmt::format("trying: {} (Ctrl-C stops)", work)); });
  watch.clear_line();
  fmt::print("\n{}\n", right ? "It can be handed out." : "Mend what is marked with no.");
  return right ? exit_code::done : exit_code::finding;
}

int run_them(const HomeworkOptions& options) {
  const auto& words =
      words_for(options, 2, "type zstep homework run FOLDER PROGRAM-FOLDER --program 'python3 zbuffer.py' -o RUNS");
  if (options.out.empty()) throw InputError("homework run", "there is no place for the runs", "give -o FOLDER");
  const homework::Homework given = homework::load_homework(words[0], options.student);
  if (given.seeded() && options.student.empty())
    throw InputError(words[0], "has scenes of each student's own", "say whose program it is: --student NAME");
  Watch watch;
  bool begun = false;
  const auto runs =
      homework::run_programs(given, options.program, words[1], options.out, [&](const homework::Task& task) {
        if (const std::string open = homework::not_protected(); !begun && !open.empty())
          fmt::print(stderr, "zstep: {}\n", open);
        begun = true;
        watch.show(fmt::format("running: {} (Ctrl-C stops)", task.name));
      });
  watch.clear_line();
  bool well = true;
  for (const homework::ProgramRun& run : runs) {
    const bool ended_well = run.ended.how == homework::Ended::How::well;
    well = well && ended_well;
    fmt::print("{}: the program {}\n", printable(run.file.string()), homework::text_of(run.ended, given.limits));
    if (!ended_well) fmt::print("{}", printable_lines(run.ended.errors));
  }
  return well ? exit_code::done : exit_code::finding;
}

int pack(const HomeworkOptions& options) {
  const auto& words = words_for(options, 1, "type zstep homework pack FOLDER --gradescope -o autograder.zip");
  const int services = options.gradescope + options.prairielearn + options.github;
  if (services != 1)
    throw InputError("homework pack", services == 0 ? "for which service?" : "there are several services",
                     "give one of --gradescope, --prairielearn and --github");
  if (options.out.empty())
    throw InputError("homework pack", "there is no place for it", "give -o FILE.zip or a folder");
  const homework::Service service = options.gradescope     ? homework::Service::gradescope
                                    : options.prairielearn ? homework::Service::prairielearn
                                                           : homework::Service::github;
  for (const std::string& note : homework::pack_homework(words[0], service, options.out)) fmt::print("{}\n", note);
  return exit_code::done;
}

int seed(const HomeworkOptions& options) {
  const auto& words = words_for(options, 1, "type zstep homework seed FOLDER --for NAMES.txt -o STUDENTS");
  return seed_homework(words[0], options.names, options.out, options.seed);
}

}  // namespace

void add_homework(CLI::App& app, Action& action) {
  const auto options = std::make_shared<HomeworkOptions>();
  CLI::App* command = app.add_subcommand("homework", "Make a homework, try it, run programs, pack it for a course");
  command->add_option("what", options->what, "What is to be done")
      ->type_name("new|seed|try|run|pack|refresh")
      ->required();
  command
      ->add_option("words", options->words,
                   "new: the method (" + enumerate(homework::homework_methods(), "or") +
                       ") and the folder to make. Else the homework's folder; run: and the program's")
      ->type_name("FOLDER")
      ->required();
  command
      ->add_option("--program", options->program,
                   "run: the command that runs the program; the scene's file follows it (default: homework.toml's)")
      ->type_name("COMMAND");
  command->add_flag("--gradescope", options->gradescope, "pack: the zip of an autograder for Gradescope");
  command->add_flag("--prairielearn", options->prairielearn, "pack: the folder of an external grader for PrairieLearn");
  command->add_flag("--github", options->github, "pack: a folder with a workflow for GitHub Classroom");
  command->add_option("--for", options->names, "seed: a file with the students' names, one a line")
      ->type_name("NAMES.txt");
  command->add_option("--student", options->student, "run: whose program it is, where scenes are each student's own")
      ->type_name("NAME");
  command->add_option("--seed", options->seed, "seed: what the secret key is made from (default: chance)")
      ->type_name("TEXT");
  command
      ->add_option("-o,--output", options->out,
                   "seed: the folder for the students' folders; run: that for the runs; pack: the file or folder to "
                   "make")
      ->type_name("FILE");
  command->footer(
      "new      makes a folder: scenes, what is graded and its points, hand-out, starters, and a solution apart. All "
      "of\n"
      "         it may be changed; docs/homework.md says what is what.\n"
      "seed     makes a folder for each student, with scenes of the student's own in it. They follow from the\n"
      "         homework's secret key and the student's name: `zstep grade --student NAME` makes them again.\n"
      "try      does once all that a class will do, and says what would go wrong.\n"
      "run      runs a student's program on each scene, with limits and where bubblewrap (bwrap) is there without\n"
      "         network and other files; `zstep grade` then grades the runs.\n"
      "pack     makes what Gradescope, PrairieLearn or GitHub Classroom take.\n"
      "refresh  writes anew what is made from homework.toml and the scenes: emit.*, scenes as plain numbers, and the\n"
      "         hand-out and starters without the steps that are not asked for.\n"
      "\n"
      "Examples:\n"
      "  zstep homework new z-buffer my-homework\n"
      "  zstep homework seed hw4 --for names.txt -o students\n"
      "  zstep homework try hw3\n"
      "  zstep homework run hw3 hw3/solution --program 'python3 zbuffer.py' -o her-runs\n"
      "  zstep homework pack hw3 --gradescope -o autograder.zip");
  command->callback([options, &action] {
    action = [options] {
      switch (parse_choice("homework", options->what,
                           std::vector<std::string>{"new", "try", "run", "pack", "refresh", "seed"})) {
        case 0:
          return make_new(*options);
        case 1:
          return try_it(*options);
        case 2:
          return run_them(*options);
        case 3:
          return pack(*options);
        case 4:
          return refresh(*options);
        default:
          return seed(*options);
      }
    };
  });
}

namespace {

namespace fs = std::filesystem;

std::string made_text(const homework::Task& task) {
  const homework::Difficulty& is = task.made->difficulty;
  return fmt::format("{}: seed {}, {} steps, {} compares that lose, {} crossing spans", task.name, task.made->tries,
                     is.steps, is.losing, is.crossing);
}

/// Those that are not there yet. `on_made` is called after each that is there.
void make_folders(const std::string& folder, const std::vector<std::string>& students, const fs::path& out,
                  const std::function<void()>& on_made) {
  Watch watch;
  for (const std::string& student : students) {
    const fs::path own = out / student;
    std::error_code ignored;
    if (fs::exists(own, ignored)) {
      on_made();
      fmt::print("{}: is there already, and stays as it is\n", printable(own.string()));
      continue;
    }
    watch.show(fmt::format("making: {} (Ctrl-C stops)", student));
    const homework::Homework made = homework::make_student_folder(folder, student, out);
    watch.clear_line();
    on_made();
    for (const homework::Task& task : made.tasks)
      if (task.made && !task.hidden) fmt::print("{}: {}\n", printable(own.string()), made_text(task));
  }
}

}  // namespace

int seed_homework(const std::string& folder, const std::string& names, const std::string& out,
                  const std::string& seed) {
  const char* usage = "type zstep homework seed FOLDER --for NAMES.txt -o STUDENTS";
  if (names.empty()) throw InputError("homework seed", "has no file with the students' names", usage);
  if (out.empty()) throw InputError("homework seed", "has no folder for the students' folders", usage);
  const auto students = homework::names_in(names);
  const auto key = homework::key_of(folder);
  const homework::Key wanted = homework::new_key(seed);
  if (key && !seed.empty() && *key != wanted)
    throw InputError("--seed", fmt::format("{} has another key already", folder), "leave --seed out, and it is used");
  std::error_code error;
  const fs::path home = fs::weakly_canonical(folder, error), place = fs::weakly_canonical(out, error);
  if (const auto from_home = place.lexically_relative(home); !from_home.empty() && *from_home.begin() != "..")
    throw InputError(out, "lies in the folder of the homework", "choose a place beside it");
  const fs::path key_path = fs::path(folder) / homework::key_file;
  if (!key) homework::write_key(folder, wanted);
  bool made_out = false, made_any = false;
  try {
    if (!homework::load_homework(folder, students.front()).seeded())
      throw InputError(folder, "has no scene of each student's own",
                       "add to homework.toml: [[scene]], generate = \"triangles\", name = \"own\"");
    made_out = fs::create_directories(out, error);
    if (error) throw InputError(out, "cannot be made: " + error.message(), "check the folder it lies in");
    make_folders(folder, students, out, [&] {
      if (!key && !made_any) fmt::print("{}: made; keep it, and give it to nobody\n", printable(key_path.string()));
      made_any = true;
    });
  } catch (...) {
    // As long as nobody has a scene that was made from it, the key is not needed.
    if (!key && !made_any) fs::remove(key_path, error);
    if (made_out && !made_any) fs::remove(out, error);
    throw;
  }
  return exit_code::done;
}

}  // namespace zstep::cli
