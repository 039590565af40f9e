// Prints what grading costs: one long submission of JSON Lines, right and with a wrong step; and a class, each
// submission in a process of its own. As one table in Markdown; seconds are those of the clock, as a teacher waits.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/homework/assess.hpp"
#include "sim/homework/batch.hpp"
#include "sim/homework/new_homework.hpp"
#include "sim/homework/own_scenes.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;
namespace fs = std::filesystem;

namespace {

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// A homework of the Z-buffer on one scene, with the parts of the one that zstep makes.
homework::Homework homework_on(const fs::path& folder, const char* scene, int width, int height) {
  ViewOptions view;
  view.width = width, view.height = height;
  homework::Homework made;
  made.folder = folder;
  write(folder / "homework.toml", "");  // by what stands there a class knows whether its grades are still good
  made.title = "The Z-buffer";
  made.method = &method("z-buffer");
  made.free = {"interpolation", "number_format"};
  made.tasks.push_back({"scene", false, 1, look_at_scene(load_scene(scene).scene, view), {}, {}});
  const auto kind = [&](std::string_view name) { return find_step(made.method->page(), name)->kind; };
  made.parts.push_back({"picture and depths", grade::Level::buffers, {}, 0, 10});
  made.parts.push_back(
      {"compares", grade::Level::matched, {kind("compare"), kind("write_depth"), kind("write_pixel")}, 5, 5});
  made.parts.push_back({"spans", grade::Level::matched, {kind("span"), kind("interpolate_z")}, 10, 5});
  made.parts.push_back({"edge table", grade::Level::matched, {kind("insert_edge"), kind("skip_edge")}, 5, 10});
  return made;
}

/// The reference's steps as a program prints them.
std::string right_lines(const homework::Homework& made) {
  const homework::Task& task = made.tasks.front();
  TraceRecorder recorder(header_for(*made.method, task.conventions), task.scene);
  made.method->record(task.scene, task.conventions, recorder);
  recorder.finish();
  std::ostringstream out;
  write_jsonl(Trace::from_bytes(recorder.take_bytes(), "run"), out);
  const std::string lines = out.str();
  return lines.substr(lines.find('\n') + 1);
}

/// The same with one wrong compare in the middle.
std::string wrong_lines(std::string lines) {
  const std::string right = "\"nearer\":true", wrong = "\"nearer\":false";
  const std::size_t at = lines.find(right, lines.size() / 2);
  return at == std::string::npos ? lines : lines.replace(at, right.size(), wrong);
}

void time_one(const fs::path& folder) {
  const homework::Homework made = homework_on(folder, "teapot:4", 1600, 1200);
  const std::string lines = right_lines(made);
  const auto steps = std::count(lines.begin(), lines.end(), '\n');
  for (const bool right : {true, false}) {
    const fs::path file = folder / "scene.jsonl";
    write(file, right ? lines : wrong_lines(lines));
    std::vector<double> seconds;
    for (int turn = 0; turn < 5; ++turn) seconds.push_back(seconds_of([&] { homework::assess(made, file); }));
    std::sort(seconds.begin(), seconds.end());
    fmt::print("| one submission, {} steps, {:.0f} MB, {} | {:.2f} |\n", steps, static_cast<double>(lines.size()) / 1e6,
               right ? "right" : "with a wrong compare", seconds[seconds.size() / 2]);
  }
}

void time_class(const fs::path& folder, int count, int jobs) {
  const homework::Homework made = homework_on(folder, "teapot:4", 210, 160);
  const std::string lines = right_lines(made);
  const auto steps = std::count(lines.begin(), lines.end(), '\n');
  homework::BatchOptions options;
  options.submissions = folder / "class", options.results = folder / "results", options.jobs = jobs;
  for (int i = 0; i < count; ++i) {
    const fs::path student = options.submissions / fmt::format("student{:03}", i);
    fs::create_directories(student);
    write(student / "scene.jsonl", i % 2 == 0 ? lines : wrong_lines(lines));
  }
  const auto grade = [&] { homework::grade_batch(made, options, [](std::size_t, std::size_t) {}); };
  fmt::print("| {} submissions of {} steps, every other one wrong, {} at a time | {:.1f} |\n", count, steps, jobs,
             seconds_of(grade));
  fmt::print("| the same once more, nothing changed | {:.1f} |\n", seconds_of(grade));
}

/// A class whose students have scenes of their own: each submission's reference is recorded anew, and what two of them
/// have in common is looked for. Each tenth hands in what the student before did.
void time_own_scenes(const fs::path& folder, int count, int jobs) {
  const fs::path at = folder / "own";
  homework::new_homework("z-buffer", at);
  const fs::path file = at / "homework.toml";
  std::stringstream toml;
  toml << std::ifstream(file).rdbuf();
  std::string text = toml.str();
  text.erase(text.find("[[scene]]"), text.find("[[part]]") - text.find("[[scene]]"));
  text.insert(text.find("[[part]]"),
              "[[scene]]\ngenerate = \"triangles\"\nname = \"own\"\ncount = 9\nwidth = 120\nheight = 100\n"
              "steps = [45000, 60000]\nlosing = [1, 20000]\ncrossing = [0, 1000]\n\n");
  write(file, text);
  homework::write_key(at, homework::new_key("benchmark"));
  homework::BatchOptions options;
  options.submissions = folder / "own-class", options.results = folder / "own-results", options.jobs = jobs;
  std::int64_t steps = 0;
  std::string lines;
  const double making = seconds_of([&] {
    for (int i = 0; i < count; ++i) {
      const std::string name = fmt::format("student{:03}", i);
      if (i % 10 != 9) lines = right_lines(homework::load_homework(at, name));
      steps += std::count(lines.begin(), lines.end(), '\n');
      fs::create_directories(options.submissions / name);
      write(options.submissions / name / "own.jsonl", i % 2 == 0 ? lines : wrong_lines(lines));
    }
  });
  const homework::Homework made = homework::load_homework(at);
  std::size_t alike = 0;
  const auto grade = [&] {
    alike = homework::grade_batch(made, options, [](std::size_t, std::size_t) {}).alike.size();
  };
  const double seconds = seconds_of(grade);
  fmt::print(
      "| {} submissions of {} steps (mean), each on a scene of its own, {} at a time; {} pairs are found alike "
      "| {:.1f} |\n| making their scenes and runs, one after another | {:.1f} |\n",
      count, steps / count, jobs, alike, seconds, making);
}

}  // namespace

int main(int count, char** values) {
  const int submissions = count > 1 ? std::atoi(values[1]) : 500;
  const fs::path folder = fs::temp_directory_path() / fmt::format("zstep-grade-bench-{}", std::random_device()());
  fs::create_directories(folder);
  fmt::print("| | seconds |\n|---|---|\n");
  time_one(folder);
  time_class(folder, submissions, 2);
  time_own_scenes(folder, submissions, 2);
  fs::remove_all(folder);
}
