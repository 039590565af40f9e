#include "sim/viewer/progress_file.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "sim/places/bookmarks.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "# zstep: settings, progress and bookmarks", settings_name = "viewer.ini",
                           folder_of_marks = "lessons/", end_of_marks = ".marks";
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 22;
constexpr const char* mend = "take a file that zstep saved: Ctrl+Shift+E in its window";

std::string whole_text(const fs::path& file) {
  const std::vector<std::uint8_t> bytes = read_file(file, most_bytes);
  return {bytes.begin(), bytes.end()};
}

/// "lessons/z-buffer.marks" -> "z-buffer"; empty for any other name.
std::string lesson_of(std::string_view part) {
  if (!part.starts_with(folder_of_marks) || !part.ends_with(end_of_marks)) return "";
  if (part.size() <= folder_of_marks.size() + end_of_marks.size()) return "";
  part.remove_prefix(folder_of_marks.size()), part.remove_suffix(end_of_marks.size());
  const bool plain =
      part.size() <= 100 && std::all_of(part.begin(), part.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
      });
  return plain ? std::string(part) : "";
}

struct Part {
  std::string name, text;
  int line = 0;  ///< its first
};

std::vector<Part> parts_in(const fs::path& file) {
  std::istringstream lines(whole_text(file));
  std::string line;
  if (!std::getline(lines, line) || line != first_line)
    throw InputError(file.string() + ":1", fmt::format("is not the line `{}`", first_line), mend);
  std::vector<Part> parts;
  for (int number = 2; std::getline(lines, line); ++number) {
    const bool begins = line.size() > 2 && line.front() == '[' && line.back() == ']';
    const std::string where = fmt::format("{}:{}", file.string(), number);
    if (begins) {
      const std::string name = line.substr(1, line.size() - 2);
      if (name != settings_name && lesson_of(name).empty())
        throw InputError(where, "names a part that there is none of", mend);
      parts.push_back({name, "", number + 1});
    } else if (!parts.empty()) parts.back().text += line + "\n";
    else if (!line.empty()) throw InputError(where, "belongs to no part", mend);
  }
  return parts;
}

void take_further(Settings& settings, const Settings& other) {
  for (const auto& [trace, position] : other.places)
    settings.remember(trace, std::max(position, settings.place(trace).value_or(0)));
  for (const auto& [lesson, stops] : other.lessons) settings.see_stop(lesson, static_cast<int>(stops));
}

}  // namespace

bool is_progress_file(const std::string& path) { return path.ends_with(".ini"); }

std::string progress_text(const fs::path& folder) {
  std::string text(first_line);
  text += '\n';
  const auto add = [&](std::string_view name) {
    std::error_code error;
    if (!fs::is_regular_file(folder / name, error)) return;
    std::string part;
    std::istringstream lines(whole_text(folder / name));
    for (std::string line; std::getline(lines, line);)
      if (!is_own_file(line)) part += line + "\n";
    text += fmt::format("[{}]\n{}", name, part);
  };
  add(settings_name);
  std::vector<std::string> marks;
  std::error_code error;
  for (fs::directory_iterator file(folder / folder_of_marks, error), end; !error && file != end; file.increment(error))
    marks.push_back(std::string(folder_of_marks) + file->path().filename().string());
  std::sort(marks.begin(), marks.end());
  for (const std::string& name : marks)
    if (!lesson_of(name).empty()) add(name);
  return text;
}

Settings take_progress(const fs::path& file, const fs::path& folder, const Settings& here) {
  Settings taken = here;
  struct Marks {
    fs::path file;
    std::string lesson;
    std::vector<places::Bookmark> all;
  };
  std::vector<Marks> all_marks;
  constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();
  for (const Part& part : parts_in(file)) {
    if (part.name == settings_name) {
      std::istringstream lines(part.text);
      const Settings theirs = read_settings(lines);
      const Settings before = std::exchange(taken, theirs);
      taken.width = before.width, taken.height = before.height, taken.embedded = before.embedded;  // of this screen
      taken.places = before.places, taken.lessons = before.lessons;
      take_further(taken, theirs);
      continue;
    }
    Marks marks{folder / part.name, lesson_of(part.name), {}};
    marks.all = places::read_bookmarks(marks.file, any);
    for (const places::Bookmark& mark : places::bookmarks_in(part.text, file.string(), part.line, any))
      if (std::none_of(marks.all.begin(), marks.all.end(), [&](const auto& one) { return one.name == mark.name; }))
        marks.all.push_back(mark);
    std::stable_sort(marks.all.begin(), marks.all.end(), [](const auto& a, const auto& b) { return a.step < b.step; });
    all_marks.push_back(std::move(marks));
  }
  if (!folder.empty())
    for (const Marks& marks : all_marks)
      places::write_bookmarks(marks.file, places::whose_marks(marks.lesson), marks.all);
  return taken;
}

}  // namespace zstep::viewer
