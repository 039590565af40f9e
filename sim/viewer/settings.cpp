#include "sim/viewer/settings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "sim/places/bookmarks.hpp"
#include "traces/error.hpp"
#include "traces/file/input.hpp"

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
  if (kept.size() > places_kept) kept.erase(kept.begin(), kept.end() - static_cast<std::ptrdiff_t>(places_kept));
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
    else if (key == "words") s.layout.words = share_or(real, s.layout.words);
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
      fmt::format("left = {}\nright = {}\ncode = {}\nstage = {}\nframe = {}\ntable = {}\nboth = {}\nwords = {}\n",
                  s.layout.left, s.layout.right, s.layout.code, s.layout.stage, s.layout.frame, s.layout.table,
                  s.layout.both, s.layout.words);
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

}  // namespace zstep::viewer
