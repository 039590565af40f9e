
#include "sim/homework/new_homework.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>

#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/homework/emitters.hpp"
#include "sim/homework/folders.hpp"
#include "sim/homework/handout.hpp"
#include "sim/homework/run_programs.hpp"
#include "traces/error.hpp"
#include "traces/near_word.hpp"

namespace zstep::homework {

namespace {

using scene::fail_at, scene::Keys;

constexpr std::int64_t most_steps = std::int64_t{1} << 24;

scene::PolygonSoup no_meshes(const std::string& path) {
  throw InputError(path, "a scene that is made has no meshes", "leave it out");
}

/// A number, or [least, most].
Range range(Keys& keys, const std::string& file, std::string_view key, Range allowed, Range usual) {
  const toml::node* node = keys.find(key);
  if (node == nullptr) return usual;
  std::vector<std::int64_t> numbers;
  const auto add = [&](const toml::node& one) {
    if (one.is_integer()) numbers.push_back(*one.value<std::int64_t>());
  };
  if (const auto* list = node->as_array()) {
    for (const toml::node& one : *list) add(one);
    if (list->size() != 2) numbers.clear();
  } else {
    add(*node), add(*node);
  }
  if (numbers.size() != 2 || numbers[0] > numbers[1] || !allowed.holds(numbers[0]) || !allowed.holds(numbers[1]))
    fail_at(*node, file,
            fmt::format("`{}` is neither a number from {} to {} nor two of them", key, allowed.least, allowed.most),
            fmt::format("write {} = [least, most]", key));
  return {numbers[0], numbers[1]};
}

/// Why a scene is not handed out.
std::string why_not(const Difficulty& found, const Generator& how, const std::vector<StepInfo>& needed) {
  for (const StepInfo& step : needed)
    if (!found.kinds.contains(step.kind)) return "shows no " + step.name;
  const auto outside = [](std::string_view what, std::int64_t is, Range asked) {
    return asked.holds(is) ? "" : fmt::format("has {} {}, not {} to {}", is, what, asked.least, asked.most);
  };
  std::string why = outside("steps", found.steps, how.steps);
  if (why.empty()) why = outside("compares that lose", found.losing, how.losing);
  if (why.empty()) why = outside("crossing spans", found.crossing, how.crossing);
  return why;
}

}  // namespace

Generator read_generator(Keys& keys, const std::string& file) {
  Generator how;
  how.what = static_cast<Generator::What>(keys.choice("generate", {"triangles", "polygons"}).value_or(0));
  how.count = range(keys, file, "count", {1, 26}, how.count);
  how.width = range(keys, file, "width", {4, 512}, how.width);
  how.height = range(keys, file, "height", {4, 512}, how.height);
  how.corners = range(keys, file, "corners", {3, 12}, how.corners);
  constexpr Range any{0, most_steps};
  how.steps = range(keys, file, "steps", any, any);
  how.losing = range(keys, file, "losing", any, any);
  how.crossing = range(keys, file, "crossing", any, any);
  how.tries = keys.whole("tries", 1, 10'000).value_or(2000);
  return how;
}

std::optional<Task> make_own_scene(const Generator& how, const Key& key, const std::string& student,
                                   const Method& method, const std::vector<StepInfo>& needed, const Task& task,
                                   std::string& why, const std::function<void(SceneFile, Task&)>& take) {
  const std::string who = student.empty() ? task.name : fmt::format("{} for {}", task.name, student);
  for (std::int32_t tried = 1; tried <= how.tries; ++tried) {
    Task one = task;
    one.made.emplace();
    one.made->tries = tried;
    one.made->text =
        generated_scene(how, task.name, keyed_number(key, fmt::format("{}\n{}\n{}", task.name, student, tried)));
    take(scene::read_scene(one.made->text, who, task.name, no_meshes), one);
    one.scene.source = who;
    one.made->difficulty = difficulty_of(reference_run(method, one.scene, one.conventions));
    why = why_not(one.made->difficulty, how, needed);
    if (why.empty()) return one;
  }
  why = fmt::format("none of {} scenes tried will do for {}; the last {}", how.tries, who, why);
  return std::nullopt;
}

namespace {

namespace fs = std::filesystem;

/// The folders homework/METHOD of the first place that has any.
std::vector<fs::path> templates() {
  for (const fs::path& place : lesson_folders()) {
    std::vector<fs::path> found;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(place / "homework", none))
      if (fs::exists(entry.path() / "homework.toml", none)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    if (!found.empty()) return found;
  }
  return {};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw InputError(path.string(), "cannot be written", "check the folder and the room on the disk");
}

/// Empty where there is none.
std::string text_of_file(const fs::path& path) {
  constexpr std::size_t largest = std::size_t{1} << 30;
  std::error_code ignored;
  return fs::exists(path, ignored) ? scene::read_bytes(path, largest) : std::string();
}

}  // namespace

std::vector<std::pair<fs::path, std::string>> made_files(const Homework& homework) {
  std::vector<std::pair<fs::path, std::string>> files;
  for (const Task& task : homework.tasks)
    if (!task.made)
      files.emplace_back(fs::path(task.scene.source).replace_extension(".txt"),
                         plain_numbers(*homework.method, task.scene));
  // Students write what is asked for; the solution may print more, and is not touched where less is asked.
  for (const auto& [place, steps] : {std::pair("starter", &homework.steps), std::pair("solution", &homework.page)}) {
    if (!fs::is_directory(homework.folder / place)) continue;
    for (std::size_t k = 0; k < languages.size(); ++k)
      files.emplace_back(homework.folder / place / languages[k].file, emitter(static_cast<Language>(k), *steps));
  }
  const fs::path starter = homework.folder / "starter";
  if (fs::is_directory(starter)) {
    files.emplace_back(starter / "run.schema.json", run_schema(homework.steps));
    for (const auto& entry : fs::directory_iterator(starter)) {
      const fs::path stem = entry.path().stem();
      if (!entry.is_regular_file() || !command_of_source(entry.path()) || stem == "emit" || stem == "Emit") continue;
      files.emplace_back(entry.path(), starter_asked(homework, text_of_file(entry.path())));
    }
  }
  const fs::path handout = homework.folder / "handout.md";
  if (const std::string words = text_of_file(handout); !words.empty()) {
    files.emplace_back(handout, handout_asked(homework, words, handout.string()));
    files.emplace_back(homework.folder / "handout.html", handout_html(homework, files.back().second));
  }
  std::erase_if(files, [](const auto& file) { return text_of_file(file.first) == file.second; });
  return files;
}

std::vector<std::string> refresh_homework(const fs::path& folder) {
  std::vector<std::string> written;
  for (const auto& [path, text] : made_files(load_homework(folder))) {
    write(path, text);
    written.push_back(path.lexically_relative(folder).generic_string());
  }
  return written;
}

std::vector<std::string> homework_methods() {
  std::vector<std::string> names;
  for (const fs::path& folder : templates()) names.push_back(folder.filename().string());
  return names;
}

std::vector<std::string> new_homework(const std::string& method, const fs::path& folder) {
  const std::vector<fs::path> all = templates();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const fs::path& one) { return one.filename().string() == method; });
  if (found == all.end()) {
    const std::vector<std::string> names = homework_methods();
    const std::vector<std::string_view> words(names.begin(), names.end());
    throw InputError(method, "there is no homework of this method",
                     words.empty() ? "set ZSTEP_LESSONS to the folder of the lessons"
                                   : near_word_or_list(method, words, "there are"));
  }
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !(fs::is_directory(folder, ignored) && fs::is_empty(folder, ignored)))
    throw InputError(folder.string(), "is there already", "give the name of a new folder");
  std::vector<std::string> written;
  try {
    UnfinishedFolder made(folder);
    fs::copy(*found, made.path(), fs::copy_options::recursive);
    if (fs::is_directory(made.path() / "class"))  // its programs differ, what makes them does not
      fs::copy(found->parent_path() / "make_class.py", made.path() / "class");
    refresh_homework(made.path());
    made.finish();
  } catch (const fs::filesystem_error& error) {
    throw InputError(folder.string(), "cannot be made: " + error.code().message(), "check the folder it lies in");
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) written.push_back(fs::relative(entry.path(), folder).generic_string());
  std::sort(written.begin(), written.end());
  return written;
}

}  // namespace zstep::homework
