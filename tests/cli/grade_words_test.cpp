// What grade says of the first wrong step is said of that step: its name, its numbers, its line.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/homework_runs.hpp"
#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

/// Changes a step of the run of "crossing", 14 pixels wide and 12 high; false: it is left out.
using Change = std::function<bool(json& step)>;

std::vector<json> steps_in(const std::string& text) {
  std::vector<json> steps;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) steps.push_back(json::parse(line));
  return steps;
}
std::string changed_run(const Folder& folder, const std::string& scene, const Change& change) {
  std::string text;
  for (json step : steps_in(text_of(folder / ("runs/" + scene + ".jsonl"))))
    if (change(step)) text += step.dump() + "\n";
  return text;
}
json graded(const Folder& folder, const std::string& scene, const std::string& text) {
  write_text(folder / (scene + ".jsonl"), text);
  return json::parse(run(folder, "grade --homework hw " + scene + ".jsonl --format json").out)["scenes"][0];
}

bool is(const json& step, const char* name) { return step["step"] == name; }

/// The line of the run that a place names, as "crossing.jsonl:12".
json line_at(const Folder& folder, const std::string& scene, const std::string& where) {
  const std::size_t number = std::stoul(where.substr(where.rfind(':') + 1));
  return steps_in(text_of(folder / (scene + ".jsonl"))).at(number - 1);
}

}  // namespace

TEST_CASE("grade: a sentence about a step of the run names that step, its own numbers and its line") {
  const Folder folder;
  set_up_runs(folder);
  const std::vector<std::pair<const char*, Change>> changes{
      {"flipped",
       [](json& step) {
         if (is(step, "write_pixel")) step["y"] = 11 - step["y"].get<int>();
         return true;
       }},
      {"one to the right",
       [](json& step) {
         if (is(step, "write_pixel")) step["x"] = std::min(13, step["x"].get<int>() + 1);
         return true;
       }},
      {"x and y exchanged",
       [](json& step) {
         if (is(step, "write_pixel") && step["x"] < 12) std::swap(step["x"], step["y"]);
         return true;
       }},
      {"vertices counted anew",
       [](json& step) {
         if (is(step, "insert_edge"))
           for (const char* end : {"vertex_0", "vertex_1"}) step[end] = step[end].get<int>() % 3;
         return true;
       }},
      {"vertices from 1",
       [](json& step) {
         if (is(step, "insert_edge"))
           for (const char* end : {"vertex_0", "vertex_1"}) step[end] = std::min(5, step[end].get<int>() + 1);
         return true;
       }},
      {"colour of every pixel",
       [](json& step) {
         if (is(step, "compare") && !step["nearer"].get<bool>())
           step = {{"step", "write_pixel"}, {"x", step["x"]}, {"y", step["y"]}, {"polygon", 1}};
         return true;
       }},
  };
  for (const auto& one : changes) {
    CAPTURE(std::string(one.first));
    const json scene = graded(folder, "crossing", changed_run(folder, "crossing", one.second));
    REQUIRE(scene.contains("first"));
    const json& first = scene["first"];
    CAPTURE(first.dump());
    if (first["what"].get<std::string>().starts_with("This step is missing.")) {
      CHECK(first["where"] == "");
      continue;
    }
    REQUIRE(first["where"] != "");
    const json line = line_at(folder, "crossing", first["where"]);
    CHECK(first["step"] == line["step"]);
    const std::string subject = first["subject"];
    if (line.contains("x")) CHECK(subject == "pixel (" + line["x"].dump() + ", " + line["y"].dump() + ")");
    if (line.contains("vertex_0"))
      CHECK(has(subject, "(" + line["vertex_0"].dump() + "–" + line["vertex_1"].dump() + ")"));
  }
  // The step after what is missing is as it should be: then that is the first thing to look at.
  bool on_line = false;
  const json missing = graded(folder, "crossing", changed_run(folder, "crossing", [&](const json& step) {
                                if (is(step, "scan_line")) on_line = step["y"] == 3;
                                if (is(step, "polygon")) on_line = false;
                                const bool of_span = is(step, "span") || is(step, "interpolate_z") ||
                                                     is(step, "compare") || is(step, "write_depth") ||
                                                     is(step, "write_pixel");
                                return !(on_line && of_span);
                              }))["first"];
  CHECK(missing["step"] == "span");
  CHECK(has(missing["subject"], "scan line 3"));
  CHECK(missing["what"] == "This step is missing.");
}

TEST_CASE("grade: of polygons that are numbered from 1 that is said, and no step that is there is called missing") {
  const Folder folder;
  set_up_runs(folder);
  for (const char* scene : {"triangle", "crossing", "neighbours"}) {
    CAPTURE(std::string(scene));
    const json found = graded(folder, scene, changed_run(folder, scene, [](json& step) {
                                for (const char* number : {"polygon", "facet"})
                                  if (step.contains(number)) step[number] = step[number].get<int>() + 1;
                                return true;
                              }));
    CHECK(has(found.value("why", ""), "Polygons are numbered from 0"));
    CHECK((scene != std::string("triangle") || !found.contains("first")));  // nothing is wrong before what cannot be
    for (const json& part : found["parts"])
      for (const json& lost : part["lost"]) {
        CHECK(lost["why"] != "missing");
        CHECK(lost["why"] != "never");
        CHECK_FALSE(has(lost["text"], "missing"));
        CHECK_FALSE(has(lost["text"], "not printed"));
      }
  }
  // A program may number only what it begins so.
  const json begun = graded(folder, "triangle", changed_run(folder, "triangle", [](json& step) {
                              if (is(step, "polygon")) step["polygon"] = step["facet"] = 1;
                              return true;
                            }));
  CHECK(has(begun.value("why", ""), "Polygons are numbered from 0"));
  // A vertex that no point is could be one that clipping made: then the edges tell.
  const json triangle = graded(folder, "triangle", changed_run(folder, "triangle", [](json& step) {
                                 for (const char* end : {"vertex_0", "vertex_1"})
                                   if (step.contains(end)) step[end] = step[end].get<int>() + 1;
                                 return true;
                               }));
  CHECK(has(triangle["first"]["what"], "Vertices are numbered from 0"));
  // One polygon too many is no numbering.
  const json beyond = graded(folder, "triangle", changed_run(folder, "triangle", [](json& step) {
                               if (is(step, "write_pixel") && step["y"] == 5) step["polygon"] = 1;
                               return true;
                             }));
  CHECK(has(beyond.value("why", ""), "polygon 1 does not exist"));
  CHECK_FALSE(has(beyond.value("why", ""), "numbered from 0, in"));
}
