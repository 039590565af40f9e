#include "sim/homework/try_homework.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "algorithms/scene/files/bytes.hpp"
#include "sim/homework/assess.hpp"
#include "sim/homework/folders.hpp"
#include "sim/homework/handout.hpp"
#include "sim/homework/losses.hpp"
#include "sim/homework/new_homework.hpp"
#include "sim/homework/run_programs.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/error.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

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
