#include "sim/homework/homework.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "sim/homework/new_homework.hpp"
#include "sim/homework/plain_scene.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/error.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;
using scene::fail_at, scene::Keys;

constexpr std::size_t largest_homework_file = 1 << 20;
constexpr std::size_t most_tasks = 200, most_parts = 50;

std::string text_of(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw InputError(path.string(), "there is no such file",
                     "give the folder of a homework; make one with: zstep homework new z-buffer FOLDER");
  return scene::read_bytes(path, largest_homework_file);
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
    convex_ = top_.choice("polygons", {"any", "convex"}).value_or(0) == 1;
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
    for (const auto& [name, at] : texts(also)) printed_.insert(step_called(name, *at).name);
    for (const StepInfo& step : page_) {
      // Of two modules' steps of one name, as `outline`, a program prints the first.
      if (&step != find_step(page_, std::string_view(step.name))) continue;
      homework_.page.push_back(step);
      if (printed_.contains(step.name)) homework_.steps.push_back(step);
    }
    for (const toml::node& node : few(*tasks, most_tasks, "scenes")) read_task(node);
    if (homework_.tasks.empty())
      throw InputError(file_, "none of the scenes is here", "copy the files that it names beside it");
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
    const toml::node& at = *table.get("file");
    const fs::path within = fs::path(name).lexically_normal();
    if (within.is_absolute() || *within.begin() == "..")
      fail_at(at, file_, fmt::format("the scene {} lies outside the homework's folder", name),
              "copy it into scenes/, with what it names, so that it comes along where the homework goes");
    if (task.hidden) homework_.instructors.push_back(name);
    const fs::path path = homework_.folder / name;
    std::error_code ignored;
    const bool there = fs::is_regular_file(path, ignored);
    if (!there && task.hidden) {
      ++homework_.left_out;
      return;
    }
    if (!there)
      fail_at(at, file_, fmt::format("there is no file {}", path.string()),
              "name a scene file, from the homework's folder");
    task.name = path.stem().string();
    if (const std::string why = why_no_name(task.name); !why.empty())
      fail_at(at, file_, fmt::format("the scene's name, '{}', {}", printable(task.name), why),
              "call the file otherwise");
    take_scene(at, load_scene(path.string()), task);
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
    Scene scene = look_at_scene(std::move(loaded.scene), {});
    if (const Raster& raster = scene.raster; std::int64_t{raster.width} * raster.height > most_scene_pixels)
      fail_at(at, file_, fmt::format("the scene {} has {}x{} pixels", task.name, raster.width, raster.height),
              fmt::format("make its raster smaller: a homework's has at most {}", most_scene_pixels));
    check_run(*homework_.method, scene, task.conventions, file_);
    if (formulas::shading_of(scene, task.conventions).shade != formulas::Shade::stripes)
      fail_at(at, file_,
              fmt::format("{} = \"{}\" needs values at the vertices, and the scenes of a homework give programs none",
                          formulas::shade_key, word_of(formulas::shade_of(task.conventions))),
              "leave it out, or write shade = \"stripes\"");
    if (const std::string why = why_not_plain(*homework_.method, scene); !why.empty())
      fail_at(at, file_, fmt::format("the scene {} {}", task.name, why),
              "give it another camera, or take it out: programs could not be told");
    PolygonsAsked asked = polygons_asked(*homework_.method, task.conventions, printed_kinds(), homework_.free);
    asked.convex = convex_;
    task.scene = scene_for_programs(std::move(scene), task.conventions, asked);
  }
  std::set<std::uint8_t> printed_kinds() const {
    std::set<std::uint8_t> kinds;
    for (const StepInfo& step : homework_.steps) kinds.insert(step.kind);
    return kinds;
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
    const toml::array* needs = keys.array("needs");
    keys.finish();
    for (const auto& [name, at] : texts(needs)) printed_.insert(step_called(name, *at).name);
    if (buffers && steps != nullptr) fail_at(*steps, file_, "buffers have no steps", "leave `steps` out");
    for (const auto& [name, at] : texts(steps)) {
      const StepInfo& step = step_called(name, *at);
      // Steps of one kind, as move and clear_horizons, are counted together.
      const bool with_another = std::find(part.kinds.begin(), part.kinds.end(), step.kind) != part.kinds.end();
      printed_.insert(step.name);
      const bool fresh = listed_.insert(step.name).second;
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
  std::set<std::string> listed_;   ///< the names of steps that are graded
  std::set<std::string> printed_;  ///< and of those that are in `also` or that a part needs
  bool convex_ = false;            ///< scenes' concave polygons are cut
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
  TraceRecorder recorder(header_for(method, conventions, scene.camera.kind), scene);
  recorder.on_block([&](std::int64_t steps) {
    if (steps > most_scene_steps)
      throw InputError(scene.source, fmt::format("a right run of it has more than {} steps", most_scene_steps),
                       "make its raster smaller, or take fewer polygons");
  });
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
