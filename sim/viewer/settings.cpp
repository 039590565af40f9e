#include "sim/viewer/settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <sstream>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/image/file.hpp"
#include "sim/places/bookmarks.hpp"
#include "sim/viewer/commands.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

constexpr std::string_view file_line = "file = ";
constexpr std::size_t places_kept = 200, files_kept = 8;

float share_or(float given, float otherwise) {
  return std::isfinite(given) ? std::clamp(given, 0.05f, 0.95f) : otherwise;
}

std::optional<std::int64_t> find(const Settings::Kept& kept, const std::string& key) {
  for (const auto& [name, value] : kept)
    if (name == key) return value;
  return std::nullopt;
}

void put_last(Settings::Kept& kept, const std::string& key, std::int64_t value) {
  kept.erase(std::remove_if(kept.begin(), kept.end(), [&](const auto& one) { return one.first == key; }), kept.end());
  kept.emplace_back(key, value);
  if (kept.size() > places_kept) kept.erase(kept.begin(), kept.end() - places_kept);
}

}  // namespace

std::optional<std::int64_t> Settings::place(const std::string& key) const { return find(places, key); }
void Settings::remember(const std::string& key, std::int64_t position) { put_last(places, key, position); }

int Settings::stops_seen(const std::string& lesson) const {
  return static_cast<int>(find(lessons, lesson).value_or(0));
}
void Settings::see_stop(const std::string& lesson, int stops) {
  const bool known = !lessons.empty() && lessons.back().first == lesson && lessons.back().second >= stops;
  if (!known) put_last(lessons, lesson, std::max(stops, stops_seen(lesson)));
}

void Settings::see_file(const std::string& path) {
  if (path.find('\n') != std::string::npos) return;
  std::erase(files, path);
  files.push_back(path);
  if (files.size() > files_kept) files.erase(files.begin());
}

bool Settings::same_but_for_places(const Settings& other) const {
  const auto all = [](const Settings& s) {
    return std::tie(s.dark, s.presenter, s.reduced_motion, s.text_scale, s.width, s.height, s.speed, s.layout,
                    s.lessons, s.files);
  };
  return all(*this) == all(other);
}

Settings kept_settings(const Settings& stored, const Settings& begun, Settings ended) {
  if (ended.dark == begun.dark) ended.dark = stored.dark;
  if (ended.presenter == begun.presenter) ended.presenter = stored.presenter;
  return ended;
}

WindowSize opening_size(const Settings& left, const std::optional<WindowSize>& asked) {
  if (asked) return *asked;
  return left.width > 0 && left.height > 0 ? WindowSize{left.width, left.height} : WindowSize();
}

std::filesystem::path settings_path() {
  const std::filesystem::path folder = places::kept_folder();
  return folder.empty() ? folder : folder / "viewer.ini";
}

Settings read_settings(std::istream& from) {
  Settings s;
  for (std::string line; std::getline(from, line);) {
    if (is_own_file(line)) s.see_file(line.substr(file_line.size()));
    const std::size_t equals = line.rfind(" = ");  // a formula's name has one, too
    if (equals == std::string::npos || equals > 400) continue;
    const std::string key = line.substr(0, equals), value = line.substr(equals + 3);
    const float real = std::strtof(value.c_str(), nullptr);
    const long whole = std::strtol(value.c_str(), nullptr, 10);
    if (key == "dark") s.dark = whole == 1;
    else if (key == "presenter") s.presenter = whole == 1;
    else if (key == "reduced_motion") s.reduced_motion = whole == 1;
    else if (key == "text_scale") s.text_scale = std::isfinite(real) ? std::clamp(real, 0.5f, 3.0f) : 1;
    else if (key == "width") s.width = static_cast<int>(std::clamp(whole, 0L, 16384L));
    else if (key == "height") s.height = static_cast<int>(std::clamp(whole, 0L, 16384L));
    else if (key == "speed") s.speed = static_cast<int>(std::clamp(whole, 0L, 9L));
    else if (key == "left") s.layout.left = share_or(real, s.layout.left);
    else if (key == "right") s.layout.right = share_or(real, s.layout.right);
    else if (key == "code") s.layout.code = share_or(real, s.layout.code);
    else if (key == "stage") s.layout.stage = share_or(real, s.layout.stage);
    else if (key == "table") s.layout.table = share_or(real, s.layout.table);
    else if (key == "both") s.layout.both = share_or(real, s.layout.both);
    else if (key == "lesson") s.layout.lesson = share_or(real, s.layout.lesson);
    else if (key == "drawer_width") s.layout.drawer_width = share_or(real, s.layout.drawer_width);
    else if (key == "drawer_height") s.layout.drawer_height = share_or(real, s.layout.drawer_height);
    else if (key == "frame") s.layout.frame = share_or(real, s.layout.frame);
    else if (key.rfind("structure ", 0) == 0) s.layout.structures[key.substr(10)] = share_or(real, 0.3f);
    else if (key.rfind("place ", 0) == 0)
      s.remember(key.substr(6), std::max<std::int64_t>(0, std::strtoll(value.c_str(), nullptr, 10)));
    else if (key.rfind("lesson ", 0) == 0) s.see_stop(key.substr(7), static_cast<int>(std::clamp(whole, 0L, 9999L)));
  }
  return s;
}

bool is_own_file(std::string_view line) { return line.starts_with(file_line); }

Settings load_settings(const std::filesystem::path& path) try {
  InputStream file{InputFile(path)};
  return read_settings(file);
} catch (const InputError&) {
  return {};  // there are none yet
}

bool save_settings(const std::filesystem::path& path, const Settings& s) {
  if (path.empty()) return false;
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  std::string text =
      fmt::format("dark = {:d}\npresenter = {:d}\nreduced_motion = {:d}\ntext_scale = {}\n", s.dark, s.presenter,
                  s.reduced_motion, s.text_scale) +
      fmt::format("width = {}\nheight = {}\nspeed = {}\n", s.width, s.height, s.speed) +
      fmt::format("drawer_width = {}\ndrawer_height = {}\n", s.layout.drawer_width, s.layout.drawer_height) +
      fmt::format("left = {}\nright = {}\ncode = {}\nstage = {}\nframe = {}\ntable = {}\nboth = {}\nlesson = {}\n",
                  s.layout.left, s.layout.right, s.layout.code, s.layout.stage, s.layout.frame, s.layout.table,
                  s.layout.both, s.layout.lesson);
  for (const auto& [id, weight] : s.layout.structures) text += fmt::format("structure {} = {}\n", id, weight);
  for (const auto& [key, position] : s.places) text += fmt::format("place {} = {}\n", key, position);
  for (const auto& [id, stops] : s.lessons) text += fmt::format("lesson {} = {}\n", id, stops);
  for (const std::string& own : s.files) text += fmt::format("{}{}\n", file_line, own);
  try {
    rewrite_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  } catch (const InputError&) {
    return false;
  }
  return true;
}

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

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 40, most_looked_at = 5000;

bool can_be_opened(const fs::path& file) {
  constexpr std::array<std::string_view, 5> others{".toml", ".ztrace", ".jsonl", ".md", ".ini"};
  return scene::mesh_format(file) || std::find(others.begin(), others.end(), file.extension().string()) != others.end();
}

bool is_path(const std::string& typed) { return typed.find_first_of("/\\") != std::string::npos || typed[0] == '~'; }

/// With the reader's own folder for "~".
fs::path path_of(const std::string& typed) {
  const char* const home = std::getenv("HOME");
  if (typed[0] == '~' && home && *home && (typed.size() == 1 || typed[1] == '/'))
    return fs::path(home) / (typed.size() > 2 ? typed.substr(2) : "");
  return typed;
}

std::vector<Offer> in_folder(const std::string& typed) {
  std::vector<Offer> folders, files;
  if (typed.empty()) return files;
  const fs::path path = path_of(typed), folder = path.parent_path();
  const std::string begin = lower_case(path.filename().string());
  std::error_code error;
  const std::string where = "In " + fs::absolute(folder.empty() ? "." : folder, error).lexically_normal().string();
  std::size_t looked_at = 0;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (++looked_at > most_looked_at) break;
    const std::string name = entry->path().filename().string();
    if (!lower_case(name).starts_with(begin) || (name[0] == '.' && !begin.starts_with('.'))) continue;
    std::error_code of_entry;
    const std::string whole = (folder / name).string();
    if (entry->is_directory(of_entry)) {
      if (is_path(typed))
        folders.push_back({Offer::What::scene, whole + "/", name + "/", "Enter shows what is in it."});
    } else if (can_be_opened(name)) {
      files.push_back({Offer::What::scene, whole, name, whole});
    }
  }
  for (std::vector<Offer>* part : {&folders, &files})
    std::stable_sort(part->begin(), part->end(), [](const Offer& a, const Offer& b) { return a.title < b.title; });
  folders.insert(folders.end(), std::make_move_iterator(files.begin()), std::make_move_iterator(files.end()));
  if (folders.size() > most_listed) folders.resize(most_listed);
  for (Offer& offer : folders) offer.theme = where;
  return folders;
}

}  // namespace

bool is_folder(const Offer& offer) { return offer.what == Offer::What::scene && offer.id.ends_with('/'); }

void OwnFiles::look_for(const std::vector<std::string>& opened_before) {
  before_.clear(), listed_.clear(), listed_for_.clear();
  for (auto path = opened_before.rbegin(); path != opened_before.rend(); ++path)
    if (std::error_code error; fs::is_regular_file(*path, error))
      before_.push_back(
          {Offer::What::scene, *path, fs::path(*path).filename().string(), *path, 0, 0, {}, "Your files"});
}

std::vector<const Offer*> OwnFiles::find(const std::string& typed) {
  if (std::exchange(listed_for_, typed) != typed) {
    listed_ = in_folder(typed);
    const bool named = std::any_of(listed_.begin(), listed_.end(), [&](const Offer& one) { return one.id == typed; });
    if (typed.find_first_of("/.=\\") != std::string::npos && !named)
      listed_.push_back({Offer::What::scene, typed, "Open " + typed,
                         "A mesh, a scene, a trace, a program's JSON Lines, or a surface by its formula."});
  }
  std::vector<const Offer*> found;
  for (const Offer& offer : before_)
    if (lower_case(offer.id).find(lower_case(typed)) != std::string::npos) found.push_back(&offer);
  for (const Offer& offer : listed_) found.push_back(&offer);
  return found;
}

}  // namespace zstep::viewer
