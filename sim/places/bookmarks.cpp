#include "sim/places/bookmarks.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "sim/classroom/expression.hpp"
#include "traces/image/file.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::places {
namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 20;
constexpr std::size_t most_marks = 10'000, longest_name = 200;
constexpr const char* mend_bookmarks = "write lines like `219 the first tie`, or remove the file";

/// Are these whole characters of UTF-8, none of them a control character?
bool is_text(std::string_view name) {
  for (std::size_t i = 0; i < name.size();) {
    const std::uint8_t first = byte_of(name[i]);
    if (first < 0x20 || first == 0x7f) return false;
    const std::size_t more = first < 0x80                    ? 0
                             : first >= 0xc2 && first < 0xe0 ? 1
                             : first >= 0xe0 && first < 0xf0 ? 2
                             : first >= 0xf0 && first < 0xf5 ? 3
                                                             : 9;
    if (more == 9 || i + more >= name.size()) return false;
    for (std::size_t k = 1; k <= more; ++k)
      if (!continues_character(name[i + k])) return false;
    i += more + 1;
  }
  return true;
}

/// What is wrong with a name; empty if nothing is.
std::string fault_of(std::string_view name) {
  if (name.empty()) return "a bookmark needs a name";
  if (name.size() > longest_name) return fmt::format("a name has more than {} letters", longest_name);
  if (!is_text(name)) return "a name has characters that cannot be shown";
  if (std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return "a name of digits alone would be a step";
  if (name.front() == '#') return "a name begins with #";
  return "";
}

bool is_file(const std::string& name) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(name, ignored);
}

void sort(std::vector<Bookmark>& all) {
  std::stable_sort(all.begin(), all.end(), [](const Bookmark& a, const Bookmark& b) { return a.step < b.step; });
}

}  // namespace

std::vector<Bookmark> bookmarks_in(std::string_view left, const std::string& file, int line, std::int64_t size) {
  std::vector<Bookmark> all;
  for (; !left.empty(); ++line) {
    const std::size_t end = std::min(left.find('\n'), left.size());
    const std::string_view text = classroom::trim(left.substr(0, end));
    left.remove_prefix(std::min(end + 1, left.size()));
    if (text.empty() || text.front() == '#') continue;
    const std::string where = fmt::format("{}:{}", file, line);
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    if (digits == 0 || digits > 18 || (digits < text.size() && text[digits] != ' ' && text[digits] != '\t'))
      throw InputError(where, "does not begin with a step", mend_bookmarks);
    const std::int64_t step = std::stoll(std::string(text.substr(0, digits)));
    const std::string_view name = classroom::trim(text.substr(digits));
    if (const std::string fault = fault_of(name); !fault.empty()) throw InputError(where, fault, mend_bookmarks);
    if (step > size)
      throw InputError(where, fmt::format("step {} is beyond the trace's end, {}", step, size),
                       "correct it, or remove the line");
    if (std::any_of(all.begin(), all.end(), [&](const Bookmark& mark) { return mark.name == name; }))
      throw InputError(where, "its name was given before", "give each bookmark a name of its own");
    if (all.size() == most_marks)
      throw InputError(where, fmt::format("there are more than {} bookmarks", most_marks), "remove some");
    all.push_back({step, std::string(name)});
  }
  sort(all);
  return all;
}

std::vector<Bookmark> read_bookmarks(const std::filesystem::path& file, std::int64_t size) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  const std::vector<std::uint8_t> bytes = read_file(file, most_bytes);
  return bookmarks_in({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string(), 1, size);
}

void write_bookmarks(const std::filesystem::path& file, const std::string& whose, const std::vector<Bookmark>& all) {
  std::string text = fmt::format("# bookmarks of {}\n", whose);
  for (const Bookmark& mark : all) text += fmt::format("{} {}\n", mark.step, mark.name);
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  rewrite_file(file, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::filesystem::path marks_file(const std::string& trace) { return trace + ".marks"; }

std::filesystem::path marks_file(const Lesson& lesson) {
  const std::filesystem::path folder = kept_folder();
  return folder.empty() || lesson.id.empty() ? std::filesystem::path() : folder / "lessons" / (lesson.id + ".marks");
}

std::string whose_marks(const std::string& lesson) { return "the lesson " + lesson; }

std::filesystem::path kept_folder() {
  const auto from = [](const char* variable) -> std::filesystem::path {
    const char* value = std::getenv(variable);
    return value && *value ? std::filesystem::path(value) : std::filesystem::path();
  };
  std::filesystem::path folder = from("XDG_CONFIG_HOME");
#ifdef _WIN32
  if (folder.empty()) folder = from("APPDATA");
#endif
  if (folder.empty() && !from("HOME").empty()) folder = from("HOME") / ".config";
  return folder.empty() ? folder : folder / "zstep";
}

void Bookmarks::open(const Trace& trace, const std::filesystem::path& file, const std::string& whose) {
  all_ = read_bookmarks(file, trace.size());
  file_ = file, whose_ = whose;
}

Bookmarks::Bookmarks(const Trace& trace) {
  if (is_file(trace.name()))
    open(trace, marks_file(trace.name()), std::filesystem::path(trace.name()).filename().string());
}

Bookmarks::Bookmarks(const Trace& trace, const Lesson* lesson) {
  if (!lesson) *this = Bookmarks(trace);
  else if (const auto file = marks_file(*lesson); !file.empty()) open(trace, file, whose_marks(lesson->id));
}

std::optional<std::int64_t> Bookmarks::find(const std::string& name) const {
  for (const Bookmark& mark : all_)
    if (mark.name == name) return mark.step;
  return std::nullopt;
}

void Bookmarks::set(std::int64_t step, const std::string& name) {
  const std::string trimmed(classroom::trim(name));
  if (const std::string fault = fault_of(trimmed); !fault.empty())
    throw InputError("bookmark", fault, "type a short one, like `the first tie`");
  std::vector<Bookmark> all = all_;
  std::erase_if(all, [&](const Bookmark& mark) { return mark.name == trimmed; });
  if (all.size() >= most_marks)
    throw InputError("bookmark", fmt::format("there are {} already", most_marks), "remove some");
  all.push_back({step, trimmed});
  sort(all);
  keep(std::move(all));
}

void Bookmarks::remove(std::size_t place) {
  std::vector<Bookmark> all = all_;
  if (place >= all.size()) return;
  all.erase(all.begin() + place);
  keep(std::move(all));
}

void Bookmarks::check_can_keep() const {
  if (file_.empty())
    throw InputError("bookmark", "this run was recorded to memory, and there is no file to keep it beside",
                     "record it: zstep record SCENE -o run.ztrace");
}

void Bookmarks::keep(std::vector<Bookmark> all) {
  check_can_keep();
  write_bookmarks(file_, whose_, all);
  all_ = std::move(all);
}

}  // namespace zstep::places
