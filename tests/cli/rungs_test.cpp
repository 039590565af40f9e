// A program that is not yet written to its end earns what it has: each part of a homework is graded without the steps
// of the others, and nothing that it does not print is called wrong.
#include <doctest/doctest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

struct Part {
  std::string name;
  std::set<std::string> steps;
};

/// The parts of a homework that consist of steps, as homework.toml has them, each with the steps that say where others
/// belong ("also").
std::vector<Part> parts_of(const std::string& toml) {
  std::vector<Part> parts;
  std::istringstream lines(toml);
  std::string name;
  std::set<std::string> also;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("name = \"", 0) == 0) name = line.substr(8, line.size() - 9);
    if (line.rfind("also = ", 0) == 0) also = json::parse(line.substr(7)).get<std::set<std::string>>();
    if (line.rfind("steps = [\"", 0) != 0) continue;
    auto steps = json::parse(line.substr(8)).get<std::set<std::string>>();
    steps.insert(also.begin(), also.end());
    parts.push_back({name, std::move(steps)});
  }
  return parts;
}

bool has_python() {
  const Folder folder;
  return shell(folder, "python3 --version").code == 0;
}

/// A homework, and the runs of one program on its scenes.
struct Runs {
  Folder folder;
  std::vector<std::string> scenes;

  Runs(const std::string& method, const std::string& program) {
    REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
    REQUIRE(shell(folder,
                  "test -d hw/class && python3 hw/class/make_class.py class; mkdir printed runs; "
                  "for s in hw/scenes/*.txt hw/hidden/*.txt; do python3 " +
                      program + " $s > printed/$(basename $s .txt).jsonl; done")
                .code == 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "printed"))
      scenes.push_back(entry.path().filename().string());
  }
  /// The grade of what is left of the runs where only these steps are printed, and of each no more than so many lines.
  json grade(const std::set<std::string>& steps, std::size_t lines = 1000000) const {
    for (const std::string& scene : scenes) {
      std::istringstream in(text_of(folder / ("printed/" + scene)));
      std::string kept;
      std::size_t count = 0;
      for (std::string line; std::getline(in, line) && count < lines; ++count)
        if (const json step = json::parse(line); !step.contains("step") || steps.contains(step["step"]))
          kept += line + "\n";
      write_text(folder / ("runs/" + scene), kept);
    }
    return json::parse(run(folder, "grade --homework hw runs --format json").out);
  }
};

std::set<std::string> names_in(const json& report) {
  std::set<std::string> names;
  for (const json& scene : report["scenes"])
    if (scene.contains("first"))
      names.insert(scene.contains("mistake") ? scene["mistake"]["id"].get<std::string>() : "");
  return names;
}

using Names = std::set<std::string>;

/// Parts whose steps speak of what others' steps make: these are printed, too.
const std::map<std::string, std::set<std::string>> needs{
    {"spans", {"edge table"}},
    {"active edges", {"edge table"}},
    {"flags", {"edges"}},
    {"nearest hits", {"rays"}},
    {"polygons of an area", {"areas"}},
    {"planes and sides", {"pieces and cuts"}},
    {"tree", {"pieces and cuts"}},
    {"order of painting", {"pieces and cuts", "planes and sides", "tree"}}};

}  // namespace

TEST_CASE("rungs: each part of a homework earns all its points without those that it does not speak of") {
  if (!has_python()) return;
  const std::vector<std::pair<std::string, std::string>> programs{
      {"z-buffer", "zbuffer"}, {"scan-line", "scanline"}, {"ray-casting", "raycast"}, {"floating-horizon", "horizon"},
      {"bsp", "bsp"},          {"warnock", "warnock"}};
  for (const auto& [method, program] : programs) {
    CAPTURE(method);
    const Runs runs(method, "hw/solution/" + program + ".py");
    const std::vector<Part> parts = parts_of(text_of(runs.folder / "hw/homework.toml"));
    REQUIRE(parts.size() >= 4);
    for (const Part& part : parts) {
      CAPTURE(part.name);
      std::set<std::string> steps = part.steps;
      for (const Part& other : parts)
        if (needs.contains(part.name) && needs.at(part.name).contains(other.name))
          steps.insert(other.steps.begin(), other.steps.end());
      const json report = runs.grade(steps);
      CHECK(names_in(report) == Names{});
      for (const json& scene : report["scenes"]) {
        CAPTURE(scene["scene"]);
        for (const json& one : scene["parts"])
          if (one["name"] == part.name) CHECK(one["points"] == one["of"]);
        CHECK(scene["left_out"].size() >= 1);
      }
      const Outcome text = run(runs.folder, "grade --homework hw runs");
      CHECK(text.code == 1);
      CHECK(text.out.find("What the program prints is right. Next come the ") != std::string::npos);
    }
  }
}

TEST_CASE("rungs: that all is right is not said where a hidden scene is not") {
  if (!has_python()) return;
  const Runs runs("z-buffer", "hw/solution/zbuffer.py");
  runs.grade({"compare"});
  const std::string hidden = text_of(runs.folder / "runs/overlap.jsonl");
  REQUIRE(times(hidden, "\"nearer\": true") > 0);
  std::string wrong = hidden;
  wrong.replace(wrong.find("\"nearer\": true"), 14, "\"nearer\": false");
  write_text(runs.folder / "runs/overlap.jsonl", wrong);
  const Outcome text = run(runs.folder, "grade --homework hw runs");
  CHECK(text.out.find("What the program prints is right.") == std::string::npos);
  CHECK(text.out.find("\nNext come the writes: the program prints no write_depth, write_pixel yet.\n") !=
        std::string::npos);
}

TEST_CASE("rungs: compares alone are judged, and called only what they show") {
  if (!has_python()) return;
  const auto named = [](const std::string& student, const std::set<std::string>& steps) {
    return names_in(Runs("z-buffer", "class/" + student + "/zbuffer.py").grade(steps));
  };
  // All compares lose, whether they are reversed or the buffer was cleared to 0: nothing tells which.
  CHECK(named("02-compare_reversed", {"compare"}) == Names{""});
  CHECK(named("26-buffer_begins_at_0", {"compare"}) == Names{""});
  CHECK(named("02-compare_reversed", {"clear", "compare"}) == Names{"compare_reversed"});
  CHECK(named("26-buffer_begins_at_0", {"clear", "compare"}) == Names{"buffer_begins_at_0"});
  CHECK(named("03-equal_wins", {"compare"}) == Names{"equal_wins"});
  CHECK(named("27-buffer_of_one_line", {"compare"}) == Names{"buffer_of_one_line"});
  CHECK(named("02-compare_reversed", {"clear", "polygon", "compare", "write_depth", "write_pixel"}) ==
        Names{"compare_reversed"});
}

TEST_CASE("rungs: compares at other pixels do not make a run one that broke off") {
  if (!has_python()) return;
  const Runs runs("z-buffer", "hw/solution/zbuffer.py");
  const std::string solution = text_of(runs.folder / "hw/solution/zbuffer.py"), place = "emit.compare(x, y,";
  REQUIRE(times(solution, place) == 1);
  std::string turned = solution;
  turned.replace(turned.find(place), place.size(), "emit.compare(y, x,");
  write_text(runs.folder / "hw/solution/zbuffer.py", turned);
  REQUIRE(shell(runs.folder,
                "for s in hw/scenes/*.txt hw/hidden/*.txt; do python3 hw/solution/zbuffer.py $s > "
                "printed/$(basename $s .txt).jsonl; done")
              .code == 0);
  for (const json& scene : runs.grade({"compare"})["scenes"]) {
    CHECK(scene["left_out"].size() == 4);
    CHECK(scene["first"]["what"] == "This step is missing.");
  }
}

TEST_CASE("rungs: a run that broke off before a part began is missing it") {
  if (!has_python()) return;
  const Runs runs("z-buffer", "hw/solution/zbuffer.py");
  const std::set<std::string> all{"clear",     "polygon",     "scan_line", "insert_edge",   "skip_edge", "enter_edge",
                                  "step_edge", "retire_edge", "span",      "interpolate_z", "compare"};
  for (const json& scene : runs.grade(all, 8)["scenes"]) {
    CHECK_FALSE(scene.contains("left_out"));
    CHECK(scene.contains("first"));
  }
}
