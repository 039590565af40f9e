#include "sim/homework/homework.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/keys.hpp"
#include "algorithms/scene/scene_file/read_view.hpp"
#include "algorithms/scene/scene_file/toml_depth.hpp"
#include "sim/homework/own_scenes.hpp"
#include "traces/error.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;
using scene::fail_at, scene::Keys;

constexpr std::size_t largest_homework_file = 1 << 20;
constexpr std::size_t most_tasks = 200, most_parts = 50;

std::string text_of(const fs::path& path) {
  std::error_code ignored;
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path, ignored))
    throw InputError(path.string(), "cannot be opened",
                     "give the folder of a homework; make one with: zstep homework new z-buffer FOLDER");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  if (text.size() > largest_homework_file)
    throw InputError(path.string(), "is larger than 1 MiB", "a homework takes a few hundred lines");
  return text;
}

class Reader {
 public:
  Reader(const fs::path& folder, const std::string& student, const std::string& file, const toml::table& table)
      : student_(student), file_(file), table_(table), top_(table, file, "a homework") {
    homework_.folder = folder;
    key_ = key_of(folder);
  }

  Homework read() {
    homework_.title = needed(top_, table_, "title", "title = \"The Z-buffer\"");
    const std::string id = needed(top_, table_, "method", "method = \"z-buffer\"");
    std::vector<std::string_view> ids;
    for (const Method& method : methods()) {
      ids.push_back(method.id);
      if (method.id == id) homework_.method = &method;
    }
    if (homework_.method == nullptr)
      fail_at(*top_.find("method"), file_, fmt::format("there is no method '{}'", id), scene::suggestion(id, ids));
    page_ = homework_.method->page();
    read_free();
    read_method_options();
    homework_.digits = top_.whole("digits", 0, 17).value_or(homework_.digits);
    if (const toml::table* program = top_.table("program")) read_program(*program);
    const toml::array* also = top_.array("also");
    top_.find("options");  // read for each task, beside the scene's own
    const toml::array* tasks = top_.array("scene");
    const toml::array* parts = top_.array("part");
    top_.finish();
    if (tasks == nullptr || tasks->empty())
      throw InputError(file_, "there is no scene", "add [[scene]] with file = \"scenes/one.toml\"");
    if (parts == nullptr || parts->empty())
      throw InputError(file_, "nothing is graded", "add [[part]] with a name, steps and points");
    for (const toml::node& node : few(*parts, most_parts, "parts")) read_part(node);
    for (const toml::node& node : few(*tasks, most_tasks, "scenes")) read_task(node);
    if (homework_.tasks.empty())
      throw InputError(file_, "none of the scenes is here", "copy the files that it names beside it");
    for (const auto& [name, at] : texts(also)) printed_.insert(step_called(name, *at).name);
    for (const StepInfo& step : page_)  // of two modules' steps of one name, as `outline`, a program prints the first
      if (printed_.contains(step.name) && &step == find_step(page_, std::string_view(step.name)))
        homework_.steps.push_back(step);
    if (homework_.points() <= 0) throw InputError(file_, "all parts together are worth nothing", "give them points");
    return std::move(homework_);
  }

 private:
  std::string needed(Keys& keys, const toml::table& table, std::string_view key, const char* example) const {
    auto value = keys.text(key);
    if (value && !value->empty()) return *value;
    throw InputError(fmt::format("{}:{}", file_, std::max(1, scene::line_of(table))),
                     fmt::format("`{}` is missing", key), fmt::format("write {}", example));
  }
  const toml::array& few(const toml::array& list, std::size_t most, const char* what) const {
    if (list.size() > most)
      fail_at(list, file_, fmt::format("there are {} {}", list.size(), what), fmt::format("at most {}", most));
    return list;
  }
  const toml::table& entry(const toml::node& node, const char* key) const {
    if (!node.is_table()) fail_at(node, file_, fmt::format("{} is no table", key), fmt::format("write [[{}]]", key));
    return *node.as_table();
  }
  /// The texts of a list.
  std::vector<std::pair<std::string, const toml::node*>> texts(const toml::array* list) const {
    std::vector<std::pair<std::string, const toml::node*>> all;
    if (list == nullptr) return all;
    for (const toml::node& node : few(*list, 100, "words")) {
      const auto text = node.value<std::string>();
      if (!node.is_string() || !text) fail_at(node, file_, "this is no text", "write it in \"quotes\"");
      all.emplace_back(*text, &node);
    }
    return all;
  }

  void read_free() {
    std::vector<std::string> formats;
    std::vector<std::string_view> keys;
    for_each_convention([&](std::string_view key, auto) { keys.push_back(key); });
    for (const std::string_view format : words_of<NumberFormat>)
      formats.push_back(fmt::format("number_format {}", format));
    keys.insert(keys.end(), formats.begin(), formats.end());
    for (const auto& [key, node] : texts(top_.array("free"))) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail_at(*node, file_, fmt::format("there is no convention '{}'", key), scene::suggestion(key, keys));
      homework_.free.push_back(key);
    }
  }

  void read_method_options() {
    const toml::table* table = top_.table("method_options");
    if (table == nullptr) return;
    Keys keys(*table, file_, "[method_options]");
    for (const Option& option : homework_.method->options)
      if (const auto value = keys.text(option.name)) method_options_[std::string(option.name)] = *value;
    keys.finish();
  }

  void read_program(const toml::table& table) {
    Keys keys(table, file_, "[program]");
    homework_.program = needed(keys, table, "command", "command = \"python3 zbuffer.py\"");
    Limits& limits = homework_.limits;
    limits.seconds = keys.positive("seconds").value_or(limits.seconds);
    const auto whole = [&](std::string_view key, int& value) { value = keys.whole(key, 1, 1 << 20).value_or(value); };
    whole("memory", limits.memory), whole("output", limits.output), whole("files", limits.files);
    whole("processes", limits.processes);
    keys.finish();
  }

  void read_task(const toml::node& node) {
    const toml::table& table = entry(node, "scene");
    Keys keys(table, file_, "[[scene]]");
    keys.not_both("file", "generate", "a scene is read or made");
    Task task;
    task.hidden = keys.boolean("hidden").value_or(false);
    task.weight = keys.positive("weight").value_or(1);
    if (keys.has("generate")) read_made(keys, table, std::move(task));
    else read_given(keys, table, std::move(task));
  }
  void read_given(Keys& keys, const toml::table& table, Task task) {
    const std::string name = needed(keys, table, "file", "file = \"scenes/one.toml\"");
    keys.finish();
    if (task.hidden) homework_.instructors.push_back(name);
    const fs::path path = homework_.folder / name;
    std::error_code ignored;
    const bool there = fs::is_regular_file(path, ignored);
    if (!there && task.hidden) {
      ++homework_.left_out;
      return;
    }
    if (!there)
      fail_at(*table.get("file"), file_, fmt::format("there is no file {}", path.string()),
              "name a scene file, from the homework's folder");
    task.name = path.stem().string();
    take_scene(*table.get("file"), load_scene(path.string()), task);
    homework_.tasks.push_back(std::move(task));
  }
  void take_scene(const toml::node& at, SceneFile loaded, Task& task) {
    for (const Task& other : homework_.tasks)
      if (other.name == task.name)
        fail_at(at, file_, fmt::format("two scenes are called '{}'", task.name), "give one of them another name");
    task.conventions = loaded.conventions;
    Keys again(table_, file_, "a homework");
    scene::read_options(again, file_, false, task.conventions);
    for (const auto& [name, value] : method_options_) task.conventions.options[name] = value;
    task.scene = look_at_scene(std::move(loaded.scene), {});
    check_run(*homework_.method, task.scene, task.conventions, file_);
  }

  /// A scene of each student's own.
  void read_made(Keys& keys, const toml::table& table, Task task) {
    const toml::node& at = *table.get("generate");
    task.name = needed(keys, table, "name", "name = \"own\"");
    if (const std::string why = why_no_name(task.name); !why.empty())
      fail_at(*table.get("name"), file_, fmt::format("the scene's name {}", why), "write name = \"own\"");
    const Generator how = read_generator(keys, file_);
    keys.finish();
    const fs::path file = homework_.folder / "scenes" / (task.name + ".toml");
    std::error_code ignored;
    if (!key_) {
      const bool there = fs::is_regular_file(file, ignored);
      if (!there && task.hidden) {
        ++homework_.left_out;
        return;
      }
      if (!there)
        fail_at(
            at, file_,
            fmt::format("the scene '{}' is each student's own, and there is neither a {} nor {}", task.name, key_file,
                        file.string()),
            fmt::format("make both with: zstep homework seed {} --for NAMES.txt -o FOLDER", homework_.folder.string()));
      take_scene(at, load_scene(file.string()), task);
      homework_.tasks.push_back(std::move(task));
      return;
    }
    std::vector<StepInfo> needed_steps;
    for (const StepInfo& step : page_)
      if (graded_.contains(step.kind)) needed_steps.push_back(step);
    std::string why;
    auto made = make_own_scene(how, *key_, student_, *homework_.method, needed_steps, task, why,
                               [&](SceneFile scene, Task& into) { take_scene(at, std::move(scene), into); });
    if (!made) fail_at(at, file_, why, "widen the ranges, or let more be tried: tries = 5000");
    homework_.tasks.push_back(std::move(*made));
  }

  void read_part(const toml::node& node) {
    const toml::table& table = entry(node, "part");
    Keys keys(table, file_, "[[part]]");
    grade::Part part;
    part.name = needed(keys, table, "name", "name = \"edge table\"");
    part.level = static_cast<grade::Level>(keys.choice("level", {"matched", "ordered", "buffers"}).value_or(0));
    const bool buffers = part.level == grade::Level::buffers;
    part.value = points_of(keys, table, "value");
    part.computation = points_of(keys, table, "computation");
    if (buffers && part.computation > 0)
      fail_at(*table.get("computation"), file_, "buffers are not computed from anything", "give `value` all points");
    const toml::array* steps = keys.array("steps");
    keys.finish();
    if (buffers && steps != nullptr) fail_at(*steps, file_, "buffers have no steps", "leave `steps` out");
    for (const auto& [name, at] : texts(steps)) {
      const StepInfo& step = step_called(name, *at);
      // Steps of one kind, as move and clear_horizons, are counted together.
      const bool with_another = std::find(part.kinds.begin(), part.kinds.end(), step.kind) != part.kinds.end();
      const bool fresh = printed_.insert(step.name).second;
      if (with_another && fresh) continue;
      part.kinds.push_back(step.kind);
      if (!graded_.insert(step.kind).second)
        fail_at(*at, file_, fmt::format("the step '{}' is in two parts", name), "take it out of one of them");
    }
    if (!buffers && part.kinds.empty())
      fail_at(table, file_, fmt::format("the part '{}' has no steps", part.name), "write steps = [\"compare\"]");
    homework_.parts.push_back(std::move(part));
  }
  const StepInfo& step_called(const std::string& name, const toml::node& at) const {
    if (const StepInfo* step = find_step(page_, std::string_view(name))) return *step;
    std::vector<std::string_view> names;
    for (const StepInfo& step : page_) names.push_back(step.name);
    fail_at(at, file_, fmt::format("{} has no step '{}'", homework_.method->title, name),
            scene::suggestion(name, names));
  }
  double points_of(Keys& keys, const toml::table& table, std::string_view key) const {
    const double points = keys.number(key).value_or(0);
    if (points < 0 || points > 10000)
      fail_at(*table.get(key), file_, fmt::format("`{}` is {}", key, points), "points go from 0 to 10000");
    return points;
  }

  const std::string& student_;
  const std::string& file_;
  const toml::table& table_;
  std::optional<Key> key_;
  Keys top_;
  Page page_;
  std::set<std::uint8_t> graded_;
  std::set<std::string> printed_;  ///< the names of steps that are graded, or in `also`
  std::map<std::string, std::string> method_options_;
  Homework homework_;
};

}  // namespace

double Homework::share(const Task& task) const {
  double all = 0;
  for (const Task& one : tasks) all += one.weight;
  return task.weight / all;
}

double Homework::points() const {
  double all = 0;
  for (const grade::Part& part : parts) all += part.points();
  return all;
}

Trace reference_run(const Method& method, const Scene& scene, const Conventions& conventions) {
  TraceRecorder recorder(header_for(method, conventions), scene);
  method.record(scene, conventions, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "the reference");
}

bool Homework::seeded() const {
  return std::any_of(tasks.begin(), tasks.end(), [](const Task& task) { return task.made.has_value(); });
}

Homework load_homework(const fs::path& folder, const std::string& student) {
  const fs::path path = folder / "homework.toml";
  const std::string file = path.string(), text = text_of(path);
  scene::check_toml_depth(text, file);
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", file, static_cast<std::int64_t>(error.source().begin.line)),
                     fmt::format("is no TOML: {}", error.description()), "write key = value lines");
  }
  return Reader(folder, student, file, table).read();
}

}  // namespace zstep::homework
