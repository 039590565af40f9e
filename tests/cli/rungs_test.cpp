// A program that is not yet written to its end earns what it has: each part of a homework is graded without the steps
// of the others, and nothing that it does not print is called wrong.
#include <doctest/doctest.h>

#include <set>
#include <sstream>
#include <string>
#include <utility>
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
/// belong ("also"), and those that it says it needs.
std::vector<Part> parts_of(const std::string& toml) {
  std::vector<Part> parts;
  std::istringstream lines(toml);
  std::string name;
  std::set<std::string> also;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("name = \"", 0) == 0) name = line.substr(8, line.size() - 9);
    if (line.rfind("also = ", 0) == 0) also = json::parse(line.substr(7)).get<std::set<std::string>>();
    if (line.rfind("needs = [\"", 0) == 0 && !parts.empty() && parts.back().name == name)
      parts.back().steps.merge(json::parse(line.substr(8)).get<std::set<std::string>>());
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

  /// `right`: a piece of the program, in place of which there is `wrong`.
  Runs(const std::string& method, const std::string& program, const std::string& right = "",
       const std::string& wrong = "") {
    REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
    if (!right.empty()) {
      std::string text = text_of(folder / program);
      REQUIRE(times(text, right) == 1);
      write_text(folder / program, text.replace(text.find(right), right.size(), wrong));
    }
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

}  // namespace

TEST_CASE("rungs: each part of a homework earns all its points without those that it does not speak of") {
  if (!has_python()) return;
  const std::vector<std::pair<std::string, std::string>> programs{
      {"z-buffer", "zbuffer"}, {"scan-line", "scanline"}, {"ray-casting", "raycast"}, {"floating-horizon", "horizon"},
      {"bsp", "bsp"},          {"warnock", "warnock"},    {"depth-sort", "depthsort"}};
  for (const auto& named : programs) {
    const std::string &method = named.first, &program = named.second;
    CAPTURE(method);
    const Runs runs(method, "hw/solution/" + program + ".py");
    const std::vector<Part> parts = parts_of(text_of(runs.folder / "hw/homework.toml"));
    REQUIRE(parts.size() >= 4);
    for (const Part& part : parts) {
      CAPTURE(part.name);
      const json report = runs.grade(part.steps);
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

/// The runs of the Z-buffer's solution with another line in it.
Runs with_line(const std::string& right, const std::string& wrong) {
  return Runs("z-buffer", "hw/solution/zbuffer.py", right, wrong);
}

TEST_CASE("rungs: spans alone may call their edges by any numbers") {
  if (!has_python()) return;
  const Runs runs("z-buffer", "hw/solution/zbuffer.py");
  for (const std::string& scene : runs.scenes) {
    std::istringstream in(text_of(runs.folder / ("printed/" + scene)));
    std::string other;
    for (std::string line; std::getline(in, line);) {
      json step = json::parse(line);
      if (step.contains("left_edge")) step["left_edge"] = 0, step["right_edge"] = 0;
      other += step.dump() + "\n";
    }
    write_text(runs.folder / ("printed/" + scene), other);
  }
  for (const json& scene : runs.grade({"polygon", "scan_line", "span", "interpolate_z"})["scenes"]) {
    CHECK_FALSE(scene.contains("first"));
    for (const json& part : scene["parts"]) CHECK((part["points"] == part["of"]) == (part["name"] == "spans"));
  }
}

TEST_CASE("rungs: active edges without an edge table are left aside, and a line says what they lack") {
  if (!has_python()) return;
  const Runs runs("z-buffer", "hw/solution/zbuffer.py");
  const std::set<std::string> steps{"clear",     "polygon",     "scan_line", "enter_edge",
                                    "step_edge", "retire_edge", "span",      "interpolate_z"};
  for (const json& scene : runs.grade(steps)["scenes"]) {
    CHECK_FALSE(scene.contains("first"));
    CHECK(scene["note"] ==
          "enter_edge, step_edge, retire_edge name edges, and the run has no edge table that says which: "
          "they are left aside until it is printed, too.");
    for (const json& part : scene["parts"]) CHECK((part["points"] == part["of"]) == (part["name"] == "spans"));
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

TEST_CASE("rungs: compares alone at pixels that are turned over or exchanged get the name of that") {
  if (!has_python()) return;
  const std::string place = "emit.compare(x, y,";
  CHECK(names_in(with_line(place, "emit.compare(x, len(depth) - 1 - y,").grade({"compare"})) == Names{"y_upside_down"});
  CHECK(names_in(with_line(place, "emit.compare(y, x,").grade({"polygon", "compare"})) == Names{"x_y_exchanged"});
}

TEST_CASE("rungs: compares alone of other depths get no name, whichever wins by what is printed") {
  if (!has_python()) return;
  for (const std::string depth : {"1 / (1 + z)", "3 * z", "-z"}) {
    CAPTURE(depth);
    const Runs runs = with_line("emit.compare(x, y, z,", "emit.compare(x, y, " + depth + ",");
    for (const std::set<std::string>& steps : {std::set<std::string>{"compare"}, {"clear", "polygon", "compare"}})
      CHECK(names_in(runs.grade(steps)) == Names{""});
  }
}

TEST_CASE("rungs: a buffer that is never asked, or never written, is told by what earlier polygons count for") {
  if (!has_python()) return;
  const std::string asks = "nearer = z < depth[y][x]", writes = "            depth[y][x] = z\n";
  for (const auto& [right, wrong] : {std::pair(asks, std::string("nearer = True")), {writes, ""}}) {
    const Runs runs = with_line(right, wrong);
    for (const std::set<std::string>& steps : {std::set<std::string>{"compare"},
                                               {"polygon", "compare"},
                                               {"clear", "polygon", "compare"},
                                               {"clear", "polygon", "compare", "write_depth", "write_pixel"}})
      for (const json& scene : runs.grade(steps)["scenes"]) {
        CAPTURE(steps.size());
        if (scene.contains("first")) CHECK(scene["mistake"]["id"] == "buffer_reset");
      }
  }
}

TEST_CASE("rungs: compares at other pixels do not make a run one that broke off") {
  if (!has_python()) return;
  const Runs runs = with_line("emit.compare(x, y,", "emit.compare(y, x,");
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
