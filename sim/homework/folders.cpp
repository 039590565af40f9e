#include "sim/homework/folders.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "sim/homework/new_homework.hpp"
#include "sim/homework/own_scenes.hpp"
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

namespace {

namespace fs = std::filesystem;

/// A folder that is open while this lives; one that was closed to its owner is opened to them first.
class OpenFolder {
 public:
  OpenFolder(int in, const char* name) : number_(open(in, name)) {
    if (number_ < 0 && errno == EACCES && fchmodat(in, name, S_IRWXU, 0) == 0) number_ = open(in, name);
  }
  ~OpenFolder() {
    if (number_ >= 0) close(number_);
  }
  OpenFolder(const OpenFolder&) = delete;
  OpenFolder& operator=(const OpenFolder&) = delete;
  int number() const { return number_; }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    const int copy = openat(number_, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* const entries = copy < 0 ? nullptr : fdopendir(copy);
    if (entries == nullptr) return all;
    while (const dirent* entry = readdir(entries))
      if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0)
        all.emplace_back(entry->d_name);
    closedir(entries);
    return all;
  }

 private:
  static int open(int in, const char* name) {
    return openat(in, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  }
  int number_;
};

/// Removes `name` of a folder, a file or a folder. Folders in it come up beside it, to be removed in their turn: then
/// `more` is set.
bool remove_or_lift(const OpenFolder& top, const std::string& name, std::uint64_t& number, bool& more) {
  if (unlinkat(top.number(), name.c_str(), 0) == 0) return true;
  const OpenFolder inner(top.number(), name.c_str());
  if (inner.number() < 0) return false;
  for (const std::string& file : inner.names()) {
    if (unlinkat(inner.number(), file.c_str(), 0) == 0 || unlinkat(inner.number(), file.c_str(), AT_REMOVEDIR) == 0)
      continue;
    const std::string free = ".zstep-lifted-" + std::to_string(number++);
    const auto lift = [&] { return renameat(inner.number(), file.c_str(), top.number(), free.c_str()) == 0; };
    // What is moved is written to, as it holds who it is in.
    more |= lift() || (fchmodat(inner.number(), file.c_str(), S_IRWXU, 0) == 0 && lift());
  }
  return unlinkat(top.number(), name.c_str(), AT_REMOVEDIR) == 0;
}

}  // namespace

bool remove_all_of(const fs::path& path) {
  if (unlink(path.c_str()) == 0 || errno == ENOENT) return true;
  {
    const OpenFolder top(AT_FDCWD, path.c_str());
    if (top.number() < 0) return false;
    std::uint64_t number = 0;
    for (bool more = true; more;) {
      more = false;
      for (const std::string& name : top.names()) remove_or_lift(top, name, number, more);
    }
  }
  return rmdir(path.c_str()) == 0;
}

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::error_code error;
  const char* const wish = std::getenv("TMPDIR");
  const fs::path place = fs::temp_directory_path(error);
  const std::string where = !error ? place.string() : wish != nullptr ? wish : "/tmp";
  std::string pattern = (fs::path(where) / (name + "-XXXXXX")).string();
  if (error || mkdtemp(pattern.data()) == nullptr)
    throw InputError(where,
                     std::string("no folder can be made there: ") + (error ? error.message() : std::strerror(errno)),
                     "set TMPDIR to a folder that can be written to");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() { remove_all_of(path_); }

namespace fs = std::filesystem;

UnfinishedFolder::UnfinishedFolder(const fs::path& becomes)
    : becomes_((fs::absolute(becomes) / "").lexically_normal().parent_path()),
      path_(becomes_.parent_path() / ("." + becomes_.filename().string() + ".part")) {
  fs::remove_all(path_);
  fs::create_directory(path_);
}

UnfinishedFolder::~UnfinishedFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void UnfinishedFolder::finish() { fs::rename(path_, becomes_); }

}  // namespace zstep::homework
