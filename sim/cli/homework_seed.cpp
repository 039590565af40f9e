#include "sim/cli/homework_seed.hpp"

#include <filesystem>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/watch.hpp"
#include "sim/homework/seeds.hpp"
#include "sim/homework/student_folders.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::cli {

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
