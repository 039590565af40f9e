#include "sim/homework/student_folders.hpp"

#include <algorithm>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "sim/homework/new_homework.hpp"
#include "sim/homework/seeds.hpp"
#include "sim/homework/unfinished_folder.hpp"
#include "traces/error.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

/// Whether a path in the folder of a homework is for students.
bool is_for_students(const fs::path& path, const Homework& homework) {
  for (const std::string& hidden : homework.instructors) {
    const fs::path scene(hidden);
    if (path == scene.lexically_normal() || path == fs::path(scene).replace_extension(".txt").lexically_normal())
      return false;
  }
  const std::string first = path.begin()->string();
  return first != "hidden" && first != "solution" && first != "class" && first != key_file;
}

void put_text(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) throw InputError(path.string(), "cannot be written", "check the folder and the room on the disk");
}

}  // namespace

void copy_for_students(const Homework& homework, const fs::path& to) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(homework.folder)) {
    const fs::path path = fs::relative(entry.path(), homework.folder).lexically_normal();
    if (!entry.is_regular_file() || entry.is_symlink() || !is_for_students(path, homework)) continue;
    fs::create_directories((to / path).parent_path());
    fs::copy_file(entry.path(), to / path);
  }
}

Homework load_copy(const Homework& homework, const fs::path& copy, bool for_students) {
  const auto missing = [&](const std::string& what) -> InputError {
    return {homework.folder.string(), "cannot be copied whole: " + what,
            "keep all that its scenes need in its folder, as files and not as links, and not in solution/, class/ or "
            "starter/"};
  };
  std::optional<Homework> loaded;
  try {
    loaded = load_homework(copy);
  } catch (const InputError& error) {
    std::string what = error.what();
    const std::string place = copy.string();
    for (std::size_t at = what.find(place); at != std::string::npos; at = what.find(place))
      what.replace(at, place.size(), homework.folder.string());
    throw missing(what);
  }
  for (const Task& task : homework.tasks) {
    if (for_students && task.hidden) continue;
    if (std::none_of(loaded->tasks.begin(), loaded->tasks.end(),
                     [&](const Task& one) { return one.name == task.name; }))
      throw missing(fmt::format("the scene {} is not in it", task.name));
  }
  return std::move(*loaded);
}

Homework make_student_folder(const fs::path& folder, const std::string& student, const fs::path& out) {
  Homework homework = load_homework(folder, student);
  try {
    UnfinishedFolder made(out / student);
    copy_for_students(homework, made.path());
    for (const Task& task : homework.tasks) {
      if (!task.made || task.hidden) continue;
      put_text(made.path() / "scenes" / (task.name + ".toml"), task.made->text);
      put_text(made.path() / "scenes" / (task.name + ".txt"), plain_numbers(*homework.method, task.scene));
    }
    load_copy(homework, made.path(), true);
    made.finish();
  } catch (const fs::filesystem_error& error) {
    throw InputError((out / student).string(), "cannot be made: " + error.code().message(),
                     "check the folder it lies in");
  }
  return homework;
}

}  // namespace zstep::homework
