#include "sim/homework/new_homework.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/homework/assess.hpp"
#include "sim/homework/emitters.hpp"
#include "sim/homework/folders.hpp"
#include "sim/homework/handout.hpp"
#include "sim/homework/report_words.hpp"
#include "sim/homework/run_programs.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/text.hpp"

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
    for (std::size_t k = 0; k < homework_languages; ++k) {
      const auto language = static_cast<Language>(k);
      files.emplace_back(homework.folder / place / emitter_file(language, "emit"), emitter(language, *steps));
    }
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

namespace {

namespace fs = std::filesystem;

bool tool_is_there(const std::string& tool) {
  for (const char* folder : {"/usr/local/bin", "/usr/bin", "/bin"})  // where programs that are run look
    if (std::error_code ignored; fs::exists(fs::path(folder) / tool, ignored)) return true;
  return false;
}

constexpr std::size_t largest_text = std::size_t{1} << 30;

/// Whether a file has this text.
bool has_text(const fs::path& path, const std::string& text) {
  std::error_code error;
  return fs::file_size(path, error) == text.size() && !error && scene::read_bytes(path, largest_text) == text;
}

class Trial {
 public:
  Trial(const fs::path& folder, const std::function<void(Tried, const std::string&)>& say,
        const std::function<void(const std::string&)>& on_work)
      : folder_(folder), homework_(load_homework(folder)), say_(say), on_work_(on_work) {}

  bool run() {
    say_(Tried::right, fmt::format("homework.toml: {} scenes, {} points", homework_.tasks.size(),
                                   number(homework_.points(), 2, true)));
    if (homework_.left_out > 0)
      wrong(fmt::format("{} of the hidden scenes that homework.toml names are not here", homework_.left_out),
            "copy them to where it says; students alone go without");
    look_at_steps();
    look_at_made_files();
    look_at_hidden();
    look_at_handout();
    if (const std::string open = not_protected(); !open.empty()) say_(Tried::note, open);
    look_at_programs("solution", true);
    look_at_programs("starter", false);
    return right_;
  }

 private:
  void wrong(const std::string& what, const std::string& mend) {
    right_ = false;
    say_(Tried::wrong, what + "; " + mend);
  }

  void look_at_steps() {
    std::map<std::uint8_t, std::int64_t> everywhere;
    bool shown = true;
    for (const Task& task : homework_.tasks) {
      on_work_(task.name);
      const Trace reference = reference_of(homework_, task);
      std::map<std::uint8_t, std::int64_t> here;
      reference.each(0, reference.size(), [&](std::int64_t, const RecordedEvent& recorded) {
        ++here[static_cast<std::uint8_t>(recorded.event.index())];
        return true;
      });
      for (const auto& [kind, count] : here) everywhere[kind] += count;
      for (const grade::Part& part : homework_.parts) {
        if (part.level == grade::Level::buffers) continue;
        if (std::none_of(part.kinds.begin(), part.kinds.end(), [&](std::uint8_t kind) { return here.contains(kind); }))
          shown = false, wrong(fmt::format("{}: has no step of the part '{}', so every run earns its points there",
                                           task.name, part.name),
                               "change the scene, or take it out");
      }
    }
    for (const grade::Part& part : homework_.parts) {
      if (part.points() <= 0)
        wrong(fmt::format("the part '{}' is worth nothing", part.name), "give it points, or name its steps in `also`");
      for (const std::uint8_t kind : part.kinds)
        if (!everywhere.contains(kind))
          say_(Tried::note,
               fmt::format("no scene has a step {}, of the part '{}': it is never tried", name_of(kind), part.name));
    }
    if (shown) say_(Tried::right, "every scene has steps of every part");
  }
  std::string name_of(std::uint8_t kind) const {
    for (const StepInfo& step : homework_.steps)
      if (step.kind == kind) return step.name;
    return "";
  }

  void look_at_made_files() {
    const auto old = made_files(homework_);
    for (const auto& [path, text] : old)
      wrong(fmt::format("{} does not agree with homework.toml and the scenes", in_folder(path)),
            "write it anew: zstep homework refresh " + shell_word(folder_.string()));
    if (old.empty()) say_(Tried::right, "scenes in plain numbers, and the files that write steps, are as they must be");
  }
  std::string in_folder(const fs::path& path) const { return path.lexically_relative(folder_).generic_string(); }

  /// What lies beside a public scene, or in starter/, is what students get.
  void look_at_hidden() {
    std::set<fs::path> given{folder_ / "starter"};
    std::map<std::string, std::string> public_scenes;
    bool any = false, apart = true;
    for (const Task& task : homework_.tasks)
      if (!task.hidden) {
        given.insert(fs::path(task.scene.source).parent_path());
        public_scenes[plain_numbers(*homework_.method, task.scene)] = task.name;
      }
    const auto lies_open = [&](const std::string& what, const std::string& mend) { apart = false, wrong(what, mend); };
    for (const Task& task : homework_.tasks) {
      if (!task.hidden) continue;
      any = true;
      const std::string numbers = plain_numbers(*homework_.method, task.scene),
                        source = scene::read_bytes(task.scene.source, largest_text);
      if (const auto same = public_scenes.find(numbers); same != public_scenes.end())
        lies_open(fmt::format("the hidden scene {} is the same as {}, which students have", task.name, same->second),
                  "change one of them");
      for (const fs::path& place : given) {
        std::error_code ignored;
        for (const auto& entry : fs::recursive_directory_iterator(place, ignored)) {
          if (!entry.is_regular_file(ignored)) continue;
          if (!has_text(entry.path(), numbers) && !has_text(entry.path(), source)) continue;
          lies_open(fmt::format("{} is the hidden scene {}, and lies where students look", in_folder(entry.path()),
                                task.name),
                    "move it to a folder of its own, as hidden/");
        }
      }
    }
    if (any && apart) say_(Tried::right, "hidden scenes lie apart from what students get");
  }

  void look_at_handout() {
    const fs::path handout = folder_ / "handout.md";
    std::error_code ignored;
    if (!fs::exists(handout, ignored)) {
      say_(Tried::note, "there is no handout.md");
      return;
    }
    const std::string text = scene::read_bytes(handout, largest_text);
    for (const grade::Part& part : homework_.parts)
      for (const StepInfo& step : homework_.steps)
        if (std::find(part.kinds.begin(), part.kinds.end(), step.kind) != part.kinds.end() &&
            text.find('`' + step.name + '`') == std::string::npos)
          say_(Tried::note,
               fmt::format("handout.md does not name the step {}, of the part '{}'; where the part was put "
                           "back, take the text from a new homework",
                           step.name, part.name));
    const auto missing = missing_in_handout(text, folder_);
    for (const auto& [line, name] : missing)
      wrong(fmt::format("handout.md:{}: names {}, which is not there", line, name), "write the name of a file that is");
    if (missing.empty()) say_(Tried::right, "handout.md names files that are there");
  }

  void look_at_programs(const std::string& place, bool is_solution) {
    std::vector<fs::path> sources;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder_ / place, ignored)) {
      const std::string stem = entry.path().stem().string();
      if (stem != "emit" && stem != "Emit" && command_of_source(entry.path())) sources.push_back(entry.path());
    }
    std::sort(sources.begin(), sources.end());
    if (sources.empty() && is_solution)
      say_(Tried::note, "there is no program in solution/, so nothing shows that all points can be had");
    for (const fs::path& source : sources) {
      const SourceCommand run = *command_of_source(source);
      if (tool_is_there(run.tool)) try_program(source, run.command, is_solution);
      else say_(Tried::note, fmt::format("{} was not tried: {} is not here", in_folder(source), run.tool));
    }
  }

  void try_program(const fs::path& source, const std::string& command, bool is_solution) {
    const std::string name = in_folder(source);
    const TemporaryFolder scratch("zstep-homework");
    std::string failed;
    const auto runs = run_programs(homework_, command, source.parent_path(), scratch.path() / "runs",
                                   [&](const Task& task) { on_work_(name + " on " + task.name); });
    for (const ProgramRun& run : runs) {
      if (run.ended.how == Ended::How::well) continue;
      const std::string errors = printable_lines(run.ended.errors);
      return wrong(fmt::format("{} {} on {}{}", name, text_of(run.ended, homework_.limits), run.task->name,
                               errors.empty() ? "" : ":\n" + errors),
                   "mend the program");
    }
    const Assessment all = assess(homework_, scratch.path() / "runs");
    const double most = homework_.points();
    const std::string points = fmt::format("{} of {} points", number(all.points(), 2, true), number(most, 2, true));
    for (const Graded& graded : all.tasks) {
      if (graded.state != Graded::State::judged)
        return wrong(fmt::format("what {} prints on {} cannot be graded: {}", name, graded.task->name, graded.why),
                     "mend the program");
      if (graded.passed_over.any())
        return wrong(fmt::format("what {} prints on {} cannot be graded whole: {}", name, graded.task->name,
                                 graded.passed_over.faults.front()),
                     "mend the program");
      if (is_solution && graded.first)
        return wrong(fmt::format("{} gets {}; on {} its {} is wrong: {}", name, points, graded.task->name,
                                 graded.first->step, graded.first->what),
                     "mend the solution, or what homework.toml says of conventions");
    }
    for (const Graded& graded : all.tasks)
      for (std::size_t part = 0; is_solution && part < graded.counts.size(); ++part)
        if (const std::string lost = losses_text(homework_, graded.counts[part], false); !lost.empty())
          return wrong(fmt::format("{} gets {}; on {} it lacks points of {}: {}", name, points, graded.task->name,
                                   homework_.parts[part].name, lost),
                       "mend the solution");
    say_(Tried::right, fmt::format("{} runs and gets {}", name, points));
  }

  fs::path folder_;
  Homework homework_;
  const std::function<void(Tried, const std::string&)>& say_;
  const std::function<void(const std::string&)>& on_work_;
  bool right_ = true;
};

}  // namespace

bool try_homework(const fs::path& folder, const std::function<void(Tried, const std::string&)>& say,
                  const std::function<void(const std::string&)>& on_work) {
  return Trial(folder, say, on_work).run();
}

}  // namespace zstep::homework
