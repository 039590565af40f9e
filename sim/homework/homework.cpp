#include "sim/homework/homework.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/keys.hpp"
#include "algorithms/scene/scene_file/read_view.hpp"
#include "algorithms/scene/scene_file/toml_depth.hpp"
#include "traces/error.hpp"

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
  Reader(const fs::path& folder, const std::string& file, const toml::table& table)
      : file_(file), table_(table), top_(table, file, "a homework") {
    homework_.folder = folder;
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
    for (const toml::node& node : few(*tasks, most_tasks, "scenes")) read_task(node);
    if (homework_.tasks.empty())
      throw InputError(file_, "none of the scenes is here", "copy the files that it names beside it");
    for (const toml::node& node : few(*parts, most_parts, "parts")) read_part(node);
    std::set<std::uint8_t> printed = graded_;
    for (const auto& [name, at] : texts(also)) printed.insert(step_called(name, *at).kind);
    for (const StepInfo& step : page_)
      if (printed.contains(step.kind)) homework_.steps.push_back(step);
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
    std::vector<std::string_view> keys;
    for_each_convention([&](std::string_view key, auto) { keys.push_back(key); });
    for (const auto& [key, node] : texts(top_.array("free"))) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail_at(*node, file_, fmt::format("there is no convention '{}'", key), scene::suggestion(key, keys));
      homework_.free.push_back(key);
    }
  }

  void read_program(const toml::table& table) {
    Keys keys(table, file_, "[program]");
    homework_.program = needed(keys, table, "command", "command = \"python3 zbuffer.py\"");
    Limits& limits = homework_.limits;
    limits.seconds = keys.positive("seconds").value_or(limits.seconds);
    const auto whole = [&](std::string_view key, int& value) {
      value = keys.whole(key, 1, 1 << 20).value_or(value);
    };
    whole("memory", limits.memory), whole("output", limits.output), whole("files", limits.files);
    whole("processes", limits.processes);
    keys.finish();
  }

  void read_task(const toml::node& node) {
    const toml::table& table = entry(node, "scene");
    Keys keys(table, file_, "[[scene]]");
    const std::string name = needed(keys, table, "file", "file = \"scenes/one.toml\"");
    Task task;
    task.hidden = keys.boolean("hidden").value_or(false);
    task.weight = keys.positive("weight").value_or(1);
    keys.finish();
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
    for (const Task& other : homework_.tasks)
      if (other.name == task.name)
        fail_at(*table.get("file"), file_, fmt::format("two scenes are called '{}'", task.name), "rename a file");
    SceneFile loaded = load_scene(path.string());
    task.conventions = loaded.conventions;
    Keys again(table_, file_, "a homework");
    scene::read_options(again, file_, false, task.conventions);
    task.scene = look_at_scene(std::move(loaded.scene), {});
    check_run(*homework_.method, task.scene, task.conventions, file_);
    homework_.tasks.push_back(std::move(task));
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
      part.kinds.push_back(step_called(name, *at).kind);
      if (!graded_.insert(part.kinds.back()).second)
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

  const std::string& file_;
  const toml::table& table_;
  Keys top_;
  Page page_;
  std::set<std::uint8_t> graded_;
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

Homework load_homework(const fs::path& folder) {
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
  return Reader(folder, file, table).read();
}

}  // namespace zstep::homework
