// Law: whatever was changed of a scene, saved as a scene file and loaded again it gives the same run to the bit, and
// every comment of the text that it came from is still there.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/save.hpp"
#include "tests/folder.hpp"
#include "traces/error.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;
namespace fs = std::filesystem;

namespace {

const fs::path saved_path = "saved.toml";

/// What a run records: as a trace of `scene`, whatever file that was read from.
std::vector<std::uint8_t> recorded(const Method& method, const Scene& scene, const Scene& run_on,
                                   const Conventions& conventions) {
  TraceRecorder recorder(header_for(method, conventions), scene);
  method.record(run_on, conventions, recorder);
  recorder.finish();
  return recorder.take_bytes();
}

/// "# …" of every line that has one, in order of the alphabet.
std::vector<std::string> comments_of(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t at = line.find("# "); at != std::string::npos) all.push_back(line.substr(at));
  std::sort(all.begin(), all.end());
  return all;
}

/// Another value for what can be changed.
std::string other_value(const Changeable& what) {
  if (!what.choices.empty()) return what.value == what.choices.front() ? what.choices.back() : what.choices.front();
  if (what.name.starts_with("vertex")) {
    double x = 0, y = 0, z = 0;
    std::istringstream(what.value) >> x >> y >> z;
    return fmt::format("{} {} {}", x + 0.1, y - 0.25, z + 1.0 / 3);
  }
  if (what.name.starts_with("colour")) return "#12ab9f";
  if (what.name == "size") return "17x13";
  if (what.name == "polygons") {
    std::istringstream words(what.value);
    std::string all, word;
    while (words >> word) all = word + (all.empty() ? "" : " " + all);
    return all;
  }
  return fmt::format("{}", what.name == "near" ? std::stod(what.value) * 1.1 : std::stod(what.value) * 1.25 + 0.1);
}

struct SavedScene {
  SceneText text;
  Scene scene;
  Conventions conventions;
};
SavedScene save(const Scene& scene, const Conventions& conventions) {
  SavedScene saved{text_of_scene(scene, conventions, saved_path), {}, {}};
  const SceneFile file = read_scene_text(saved.text.text, saved_path);
  saved.scene = look_at_scene(file.scene, {}), saved.conventions = file.conventions;
  saved.conventions.options = conventions.options;  // those of a method stand in no scene file
  return saved;
}

void check_same_run(const Method& method, const Scene& scene, const Conventions& conventions, const SavedScene& saved) {
  CHECK(runs_alike(scene, saved.scene));
  CHECK(conventions == saved.conventions);
  CHECK((recorded(method, scene, scene, conventions) == recorded(method, scene, saved.scene, saved.conventions)));
}

}  // namespace

TEST_CASE("law: a changed scene, saved and loaded, gives the same run, and keeps its comments") {
  int kinds = 0, in_place = 0;
  for (const std::string name :
       {"pyramid", "pyramid-behind", "foley", "delhi", "cyclic", "intersecting", "cube", "dodecahedron", "teapot:2"}) {
    const std::string origin = *scene::built_in_scene(name);
    const SceneFile file = load_scene(name);
    for (const char* id : {"z-buffer", "bsp"}) {
      const Method& by = method(id);
      const Scene scene = look_at_scene(file.scene, {});
      if (!can_draw(by, scene, file.conventions)) continue;
      int vertices = 0;
      for (const Changeable& what : changeables(by, scene, file.conventions)) {
        if (std::string(id) == "bsp" && !what.name.starts_with("polygons") && what.name != "vertex 1") continue;
        if (what.name.starts_with("vertex") && ++vertices > 6) break;
        Scene changed = scene;
        Conventions conventions = file.conventions;
        try {
          make_change(by, {what.name, other_value(what)}, changed, conventions);
        } catch (const InputError&) {
          continue;  // not every word goes with every other
        }
        INFO(name, " by ", id, ": ", what.name, " = ", other_value(what));
        ++kinds;
        const SavedScene saved = save(changed, conventions);
        in_place += saved.text.in_place;
        CHECK(comments_of(saved.text.text) == comments_of(origin));
        check_same_run(by, changed, conventions, saved);
        // A mesh has no place for what one of its vertices or polygons is.
        const bool of_mesh = origin.find("[[mesh]]") != std::string::npos &&
                             (what.name.starts_with("vertex") || what.name.starts_with("colour"));
        CHECK(saved.text.in_place == !of_mesh);
      }
    }
  }
  MESSAGE(kinds, " changes, ", in_place, " of them kept in place");
  CHECK(kinds > 150);
}

TEST_CASE("law: changes of every kind together, saved and loaded, give the same run") {
  for (const std::string name : {"pyramid", "pyramid-behind", "delhi", "cyclic", "cube"}) {
    SceneFile file = load_scene(name);
    Scene scene = look_at_scene(file.scene, {});
    const Method& by = method("z-buffer");
    for (const Changeable& what : changeables(by, scene, file.conventions)) {
      if (what.name == "attribute" || what.name == "number-format" || what.name == "rounding") continue;
      try {
        make_change(by, {what.name, other_value(what)}, scene, file.conventions);
      } catch (const InputError&) {
      }
    }
    INFO(name);
    const SavedScene saved = save(scene, file.conventions);
    CHECK(comments_of(saved.text.text) == comments_of(*scene::built_in_scene(name)));
    check_same_run(by, scene, file.conventions, saved);
  }
}

TEST_CASE("a saved scene whose vertices meet, or whose polygon was bent and flat again, gives the same run") {
  const Method& by = method("z-buffer");
  for (const std::vector<Change>& changes :
       {std::vector<Change>{{"vertex 1", "1 1 -1"}},
        {{"vertex 0", "1 1 -0.5"}},
        {{"vertex 0", "1 1 -0.5"}, {"vertex 1", "-1 1 -0.7"}},
        {{"vertex 0", "1 1 -0.5"}, {"vertex 0", "1 1 -1"}},
        {{"vertex 0", "1 1 -0.5"}, {"polygons", "E D C B A"}, {"vertex 2", "-0 0 1.5"}}}) {
    const SceneFile file = load_scene("pyramid");
    Scene scene = look_at_scene(file.scene, {});
    Conventions conventions = file.conventions;
    for (const Change& change : changes) make_change(by, change, scene, conventions);
    INFO(changes.size(), " ", changes.back().name, " ", changes.back().value);
    const SavedScene saved = save(scene, conventions);
    CHECK(comments_of(saved.text.text) == comments_of(*scene::built_in_scene("pyramid")));
    check_same_run(by, scene, conventions, saved);
  }
}

TEST_CASE("a change is written where its value stands, and all else stays to the byte") {
  const test::Folder folder;
  const std::string origin = R"(# A plate.
[raster]
width  = 16     # small
height = 12

[camera]
eye = [4.0, 0, 1]       # from x
field_of_view = 50

# the one of interest
[[polygon]]  # A
points = [[0, -1.0, -1],  # left
          [0, 1, -1], [ 0, 0, 1 ]]
)";
  const SceneFile file = load_scene(folder.write("origin.toml", origin));
  Scene scene = look_at_scene(file.scene, {});
  Conventions conventions = file.conventions;
  for (const Change& change : {Change{"size", "128x12"},
                               {"vertex 2", "0 0.5 1"},
                               {"colour A", "#ff0000"},
                               {"window", "0.75"},
                               {"cull", "off"}})
    make_change(method("z-buffer"), change, scene, conventions);
  const SavedScene saved = save(scene, conventions);
  CHECK(saved.text.in_place);
  CHECK(saved.text.text == R"(# A plate.
[raster]
width  = 128    # small
height = 12

[camera]
eye = [4.0, 0, 1]       # from x
window = 0.75

[options]
cull = false

# the one of interest
[[polygon]]  # A
points = [[0, -1.0, -1],  # left
          [0, 1, -1], [ 0, 0.5, 1 ]]
color = "#ff0000"
)");
  check_same_run(method("z-buffer"), scene, conventions, saved);
}

TEST_CASE("scenes of formulas and meshes, and those whose file is gone, are saved too") {
  const Method& by = method("z-buffer");
  const test::Folder folder;
  const std::string mesh =
      folder.write("mesh.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0.25\n0 1 0\n0 0 0\n4 0 1 2 3\n3 4 2 1\n");
  for (const std::string& name : {std::string("y = sin(x)"), mesh}) {
    const SceneFile file = load_scene(name);
    Scene scene = look_at_scene(file.scene, {});
    Conventions conventions = file.conventions;
    make_change(by, {"theta", "12"}, scene, conventions);
    make_change(by, {"size", "20x15"}, scene, conventions);
    INFO(name);
    const SavedScene saved = save(scene, conventions);
    CHECK(saved.text.in_place);
    check_same_run(by, scene, conventions, saved);
    if (scene.surface) continue;
    make_change(by, {"vertex 1", "1 0 0.5"}, scene, conventions);
    const SavedScene other = save(scene, conventions);
    CHECK(!other.text.in_place);
    check_same_run(by, scene, conventions, other);
    scene.source = "/no/such/file.toml";
    check_same_run(by, scene, conventions, save(scene, conventions));
  }
  fs::remove(mesh);
}

TEST_CASE("what no scene file can say is refused in one line") {
  const SceneFile file = load_scene("teapot:40");
  Scene scene = look_at_scene(file.scene, {});
  Conventions conventions = file.conventions;
  make_change(method("z-buffer"), {"vertex 0", "3 3 3"}, scene, conventions);
  CHECK_THROWS_WITH_AS(text_of_scene(scene, conventions, saved_path), doctest::Contains("too many"), InputError);
}
