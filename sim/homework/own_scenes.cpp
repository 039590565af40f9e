#include "sim/homework/own_scenes.hpp"

#include <fmt/format.h>

#include "algorithms/scene/scene_file/read_scene.hpp"
#include "traces/error.hpp"

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

}  // namespace zstep::homework
