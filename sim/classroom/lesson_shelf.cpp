// Where lessons lie: $ZSTEP_LESSONS, beside the program, in the source tree.
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>

#include <fmt/core.h>

#include "sim/classroom/evaluate.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/classroom/markdown.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep {

using namespace classroom;

namespace fs = std::filesystem;

std::vector<fs::path> lesson_folders() {
  std::vector<fs::path> found;
  if (const char* named = std::getenv("ZSTEP_LESSONS"); named && *named) return {fs::path(named)};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    found.push_back(program.parent_path() / "lessons");
    found.push_back(program.parent_path().parent_path() / "share" / "zstep" / "lessons");
  }
  found.emplace_back(ZSTEP_LESSONS_IN_SOURCE);
  return found;
}

double reading_minutes(const Lesson& lesson) {
  double minutes = 0;
  for (const Stop& stop : lesson.stops) {
    std::istringstream text(plain_text(parse_markdown(stop.text)));
    const auto words = std::distance(std::istream_iterator<std::string>(text), {});
    minutes += ratio(words, 200) + 0.2 + (stop.question || stop.task || stop.marking ? 0.5 : 0);
  }
  return minutes;
}

namespace {

/// The lesson files of the first folder that has any, in the order of their names: 1-…, 2-….
std::vector<fs::path> lesson_files() {
  for (const fs::path& folder : lesson_folders()) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename().string();
      if (entry.path().extension() == ".md" && name.front() >= '0' && name.front() <= '9')
        files.push_back(entry.path());
    }
    const auto number = [](const fs::path& path) { return std::atoi(path.filename().c_str()); };
    std::sort(files.begin(), files.end(), [&](const fs::path& a, const fs::path& b) {
      return number(a) != number(b) ? number(a) < number(b) : a < b;
    });
    if (!files.empty()) return files;
  }
  return {};
}

}  // namespace

std::vector<Lesson> all_lessons() {
  std::vector<Lesson> lessons;
  for (const fs::path& path : lesson_files()) lessons.push_back(load_lesson(path));
  return lessons;
}

Lesson find_lesson(const std::string& id_or_path) {
  if (fs::path(id_or_path).extension() == ".md") return load_lesson(id_or_path);
  std::vector<std::string> ids;
  std::optional<InputError> broken;  // another lesson than the one that is asked for, or just that one
  for (const fs::path& path : lesson_files()) {
    try {
      Lesson lesson = load_lesson(path);
      if (lesson.id == id_or_path) return lesson;
      ids.push_back(std::move(lesson.id));
    } catch (const InputError& error) {
      if (!broken) broken = error;
    }
  }
  if (broken) throw *broken;
  std::string list;
  for (const std::string& id : ids) list += (list.empty() ? "" : ", ") + id;
  throw InputError(id_or_path,
                   "there is no lesson of this name" +
                       did_you_mean(id_or_path, std::vector<std::string_view>(ids.begin(), ids.end())),
                   list.empty() ? "set ZSTEP_LESSONS to the folder of the lessons" : "the lessons are " + list);
}

}  // namespace zstep
