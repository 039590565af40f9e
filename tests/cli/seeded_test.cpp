// Scenes of each student's own: zstep homework seed, and grading by the key.
#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

const char* own_scene =
    "[[scene]]\ngenerate = \"triangles\"\nname = \"own\"\ncount = [2, 3]\nwidth = [12, 16]\nheight = 12\n"
    "steps = [200, 900]\nlosing = [5, 60]\ncrossing = [2, 8]\n\n[[part]]";

/// hw with a scene of each student's own, and names.txt.
void set_up_seeded(const Folder& folder, const std::string& scene = own_scene, const std::string& key = "a course") {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  std::string text = text_of(folder / "hw/homework.toml");
  text.replace(text.find("[[part]]"), 8, scene);
  write_text(folder / "hw/homework.toml", text);
  write_text(folder / "names.txt", "ana\nbo lee\r\n\nC\xc3\xa9line\n");
  if (key.empty()) return;
  const Outcome made = run(folder, "homework seed hw --for names.txt -o students --seed '" + key + "'");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
}
/// The right run of a student's own scene, as a file.
void record_own(const Folder& folder, const std::string& student, const std::string& to) {
  const Outcome made = shell(folder, "mkdir -p \"$(dirname '" + to + "')\" && $zstep record 'students/" + student +
                                         "/scenes/own.toml' --coverage top-left -o own.ztrace && $zstep dump "
                                         "own.ztrace --jsonl | tail -n +2 > '" +
                                         to + "' && rm own.ztrace");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
}
double points_of(const Outcome& outcome) { return json::parse(outcome.out)["points"].get<double>(); }

}  // namespace

TEST_CASE("seed: a folder for each student, with a scene of its own and nothing of the instructor's") {
  const Folder folder;
  set_up_seeded(folder);
  std::set<std::string> scenes;
  for (const std::string student : {"ana", "bo lee", "C\xc3\xa9line"}) {
    CAPTURE(student);
    const std::string home = "students/" + student + "/";
    for (const char* file : {"homework.toml", "handout.md", "scenes/own.toml", "scenes/own.txt", "scenes/crossing.txt",
                             "starter/zbuffer.py", "starter/emit.h"})
      CHECK_FALSE(text_of(folder / (home + file)).empty());
    for (const char* file : {"solution", "hidden", "class", "secret.key"})
      CHECK_FALSE(std::filesystem::exists(folder / (home + file)));
    scenes.insert(text_of(folder / (home + "scenes/own.toml")));
  }
  CHECK(scenes.size() == 3);
  CHECK(text_of(folder / "hw/secret.key").size() == 33);

  // Who comes later gets a folder, too; those that are there stay, even changed.
  write_text(folder / "students/ana/handout.md", "mine");
  write_text(folder / "names.txt", "ana\ndora\n");
  const Outcome later = run(folder, "homework seed hw --for names.txt -o students");
  CHECK(later.code == 0);
  CHECK(has(later.out, "students/ana: is there already, and stays as it is\nstudents/dora: own: seed "));
  CHECK(text_of(folder / "students/ana/handout.md") == "mine");
}

TEST_CASE("seed: the same key and name make the same scene, on every machine") {
  const Folder folder;
  set_up_seeded(folder);
  const std::string first = text_of(folder / "students/ana/scenes/own.toml");
  REQUIRE(shell(folder, "rm -r students").code == 0);
  REQUIRE(run(folder, "homework seed hw --for names.txt -o students").code == 0);
  CHECK(text_of(folder / "students/ana/scenes/own.toml") == first);
  CHECK(text_of(folder / "hw/secret.key") == "5588d1baa31ebe2c7d39f9e7e2a299d5\n");
  CHECK(first == R"(name = "own"
coordinates = "screen"

[raster]
width = 14
height = 12

[[polygon]]
name = "A"
points = [[6, 10.25, 0.65625], [9.5, 10.25, 0.265625], [0.25, 2.75, 0.875]]

[[polygon]]
name = "B"
points = [[4.5, 2, 0.640625], [9.5, 8.75, 0.6875], [0.25, 8.75, 0.625]]

[[polygon]]
name = "C"
points = [[4.5, 9, 0.625], [5, 4.5, 0.6875], [10, 3.75, 0.875]]
)");
}

TEST_CASE("seed: what is made shows every step that is graded, and is as hard as asked for") {
  const Folder folder;
  for (const std::string what : {"triangles", "polygons"}) {
    CAPTURE(what);
    REQUIRE(shell(folder, "rm -rf hw students").code == 0);
    std::string scene = own_scene;
    scene.replace(scene.find("triangles"), 9, what);
    set_up_seeded(folder, scene, "");
    std::string names;
    for (int i = 0; i < 12; ++i) names += "student" + std::to_string(i) + "\n";
    write_text(folder / "names.txt", names);
    const Outcome made = run(folder, "homework seed hw --for names.txt -o students --seed " + what);
    CAPTURE(made.out);
    CAPTURE(made.err);
    REQUIRE(made.code == 0);
    for (int i = 0; i < 12; ++i) {
      const std::string student = "student" + std::to_string(i);
      record_own(folder, student, "own.jsonl");
      const std::string lines = text_of(folder / "own.jsonl");
      for (const char* step : {"compare", "write_depth", "write_pixel", "span", "interpolate_z", "insert_edge",
                               "skip_edge", "enter_edge", "step_edge", "retire_edge"})
        CHECK(has(lines, std::string("\"step\":\"") + step + '"'));
      const int losing = times(lines, "\"nearer\":false"), steps = times(lines, "\n");
      CHECK(losing >= 5);
      CHECK(losing <= 60);
      CHECK(steps >= 200);
      CHECK(steps <= 900);
      const Outcome graded =
          run(folder, "grade --homework hw --student " + student + " own.jsonl --scene own --format json");
      CHECK(graded.code == 0);
      CHECK(points_of(graded) == doctest::Approx(13));
    }
  }
}

TEST_CASE("seed: the grader makes the scene, whatever a submission brings") {
  const Folder folder;
  set_up_seeded(folder);
  record_own(folder, "ana", "runs/own.jsonl");
  std::filesystem::create_directory(folder / "program");
  const std::string grade = "grade --homework hw runs --scene own --format json --student ";
  const double most = 13;
  CHECK(points_of(run(folder, grade + "ana")) == doctest::Approx(most));
  // Another student's run is another scene's.
  CHECK(points_of(run(folder, grade + "'bo lee'")) < most / 2);
  // Nor does it help to bring ana's scene along.
  REQUIRE(shell(folder,
                "cp -r students/ana/scenes students/ana/homework.toml runs && $zstep record "
                "students/ana/scenes/own.toml -o own.ztrace && $zstep dump own.ztrace --jsonl > runs/own.jsonl")
              .code == 0);
  CHECK(points_of(run(folder, grade + "'bo lee'")) < most / 2);
  const Outcome nobody = run(folder, "grade --homework hw runs");
  CHECK(nobody.code == 2);
  CHECK(has(nobody.err, "hw: has scenes of each student's own; say whose they are: --student NAME"));
  const Outcome packed = run(folder, "homework pack hw --github -o classroom");
  CHECK(packed.code == 2);
  CHECK(has(packed.err, "hw: has scenes of each student's own, which cannot be packed"));
  CHECK_FALSE(std::filesystem::exists(folder / "classroom"));
  write_text(folder / "program/cat.sh", "cat $1\n");
  const Outcome whose = run(folder, "homework run hw program --program 'sh cat.sh' -o printed");
  CHECK(whose.code == 2);
  CHECK(has(whose.err, "say whose program it is: --student NAME"));
  CHECK(run(folder, "homework run hw program --program 'sh cat.sh' -o printed --student ana").code == 0);
  CHECK(text_of(folder / "printed/own.jsonl") == text_of(folder / "students/ana/scenes/own.txt"));
  // At home, without the key, the student's own copy says the same, and its command needs no name.
  record_own(folder, "ana", "runs/own.jsonl");
  const Outcome home = run(folder, "grade --homework students/ana runs --scene own");
  CAPTURE(home.out);
  CAPTURE(home.err);
  CHECK(home.code == 0);
  CHECK(has(home.out, "16.25 of 16.25 points"));
  CHECK(has(run(folder, "grade --homework hw runs --student ana --scene own").out, "13 of 13 points"));
}

TEST_CASE("seed: in a batch, each folder is graded by the scene of the student that it is called after") {
  const Folder folder;
  set_up_seeded(folder, own_scene, "");
  write_text(folder / "names.txt", "ana\nbo.lee\n");
  REQUIRE(run(folder, "homework seed hw --for names.txt -o students --seed one").code == 0);
  for (const std::string student : {"ana", "bo.lee"}) record_own(folder, student, "class/" + student + "/own.jsonl");
  record_own(folder, "ana", "class/carl/own.jsonl");
  const Outcome graded = run(folder, "grade --homework hw --batch class --scene own -o gradebook.csv");
  CAPTURE(graded.err);
  const std::string book = text_of(folder / "gradebook.csv");
  CAPTURE(book);
  CHECK(has(book, "\n\"ana\",13.00,13.00,"));
  CHECK(has(book, "\n\"bo.lee\",13.00,13.00,"));
  CHECK(has(book, "\n\"carl\","));
  CHECK_FALSE(has(book, "\n\"carl\",13.00,"));
}

TEST_CASE("seed: what cannot be made says so in one line, and leaves nothing behind") {
  const Folder folder;
  set_up_seeded(folder, own_scene, "");
  const auto refused = [&](const std::string& command, const std::string& message) {
    const Outcome outcome = run(folder, command);
    CAPTURE(command);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, message));
    CHECK(times(outcome.err, "\n") == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "students/ana"));
    CHECK_FALSE(std::filesystem::exists(folder / "hw/secret.key"));
  };
  refused("grade --homework hw hw", "the scene 'own' is each student's own, and there is neither a secret.key nor");
  refused("homework seed hw -o students", "type zstep homework seed FOLDER --for NAMES.txt -o STUDENTS");
  refused("homework seed hw --for names.txt", "type zstep homework seed");
  refused("homework seed hw --for names.txt -o hw/students", "lies in the folder of the homework");
  refused("homework seed hw --for none.txt -o students", "none.txt: there is no such file");
  for (const auto& [names, message] :
       {std::pair{std::string("ana\n../bo\n"), "names.txt:2: '../bo' begins with '.'"},
        std::pair{std::string("a/b\n"), "names.txt:1: 'a/b' has a sign"},
        std::pair{std::string("ana\n\nana\n"), "names.txt:3: 'ana' is there twice"},
        std::pair{std::string("-rf\n"), "begins with '-'"}, std::pair{std::string("a\x1b[2J\n"), "cannot be printed"},
        std::pair{std::string(200, 'a'), "is longer than 100 bytes"}, std::pair{std::string("\n\n"), "has no names"}}) {
    write_text(folder / "names.txt", names);
    refused("homework seed hw --for names.txt -o students", message);
  }
  write_text(folder / "names.txt", "ana\n");
  const std::string good = text_of(folder / "hw/homework.toml");
  for (const auto& [from, to, message] :
       {std::tuple{"crossing = [2, 8]", "crossing = [500, 600]\ntries = 20",
                   "none of 20 scenes tried will do for own for ana; the last "},
        std::tuple{"\"triangles\"", "\"triangels\"", "triangles"},
        std::tuple{"name = \"own\"", "", "`name` is missing"},
        std::tuple{"name = \"own\"", "name = \"../own\"", "the scene's name begins with '.'"},
        std::tuple{"[12, 16]", "[16, 12]", "`width` is neither a number from 4 to 512 nor two of them"},
        std::tuple{"height = 12", "height = 1e9", "`height` is neither"},
        std::tuple{"height = 12", "hieght = 12", "did you mean 'height'?"},
        std::tuple{"name = \"own\"", "name = \"crossing\"", "two scenes are called 'crossing'"},
        std::tuple{"name = \"own\"", "name = \"own\"\nfile = \"scenes/crossing.toml\"", "a scene is read or made"}}) {
    std::string text = good;
    const std::size_t place = text.find(from, text.find("[[scene]]\ngenerate"));
    REQUIRE(place != std::string::npos);
    text.replace(place, std::string(from).size(), to);
    write_text(folder / "hw/homework.toml", text);
    refused("homework seed hw --for names.txt -o students", message);
  }
  write_text(folder / "hw/homework.toml",
             good.substr(0, good.find("[[scene]]\ngenerate")) + good.substr(good.find("[[part]]")));
  refused("homework seed hw --for names.txt -o students", "has no scene of each student's own");
  write_text(folder / "hw/homework.toml", good);
  REQUIRE(run(folder, "homework seed hw --for names.txt -o students --seed one").code == 0);
  CHECK(has(run(folder, "homework seed hw --for names.txt -o others --seed two").err, "hw has another key already"));
  write_text(folder / "hw/secret.key", "1234\n");
  CHECK(has(run(folder, "grade --homework hw hw --student ana").err, "hw/secret.key:1: is no key"));
}
