// Scenes that an instructor adds to a homework: what zstep draws can be handed out, and what cannot is said in a line.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/small_homework.hpp"

using namespace zstep::test;
namespace fs = std::filesystem;

namespace {

struct SceneCase {
  const char *name, *file, *text;
};

constexpr const char* screen = "coordinates = \"screen\"\n[raster]\nwidth = 10\nheight = 8\n";
constexpr const char* behind =  // something that a second polygon lies before
    "[[polygon]]\nname = \"Z\"\npoints = [[0.5, 0.5, 0.9], [8.25, 0.75, 0.8], [8.5, 6.5, 0.7], [0.75, 6.25, 0.8]]\n";

const std::vector<SceneCase>& on_the_screen() {
  static const std::vector<SceneCase> cases{
      {"not planar", "bent.toml",
       "[[polygon]]\nname = \"Q\"\npoints = [[1, 1, 0.1], [8, 1, 0.6], [8, 6, 0.2], [1, 6, 0.5]]\n"},
      {"concave", "concave.toml",
       "[[polygon]]\nname = \"C\"\npoints = [[1, 1, 0.25], [4.5, 3, 0.25], [8, 1, 0.25], [7, 6.5, 0.25], [2, 6.5, "
       "0.25]]\n"},
      {"to each border", "border.toml",
       "[[polygon]]\nname = \"B\"\npoints = [[0, 0, 0.5], [9, 0, 0.25], [9, 7, 0.25], [0, 7, 0.5]]\n"},
      {"beyond each border", "beyond.toml",
       "[[polygon]]\nname = \"B\"\npoints = [[-3, -2, 0.5], [12, -4, 0.5], [14, 11, 0.5], [-5, 9, 0.5]]\n"},
      {"with a hole", "hole.toml",
       "[[polygon]]\nname = \"H\"\npoints = [[1, 1, 0.5], [8, 1, 0.5], [8, 6.5, 0.5], [1, 6.5, 0.5], [1, 1, 0.5], "
       "[3, 2.5, 0.5], [3, 5, 0.5], [6, 5, 0.5], [6, 2.5, 0.5], [3, 2.5, 0.5]]\n"},
      {"without area, and edge-on", "flat.toml",
       "[[polygon]]\npoints = [[1, 1, 0.5], [4, 4, 0.5], [7, 7, 0.5]]\n[[polygon]]\nname = \"T\"\npoints = [[2, 1, "
       "0.25], "
       "[7.5, 2, 0.25], [4, 6, 0.25]]\n[[polygon]]\npoints = [[5, 1, 0.1], [5, 5, 0.1], [5, 5, 0.9]]\n"},
  };
  return cases;
}

/// A homework with one scene, this one, and its solution alone.
void homework_of_scene(const Folder& folder, const std::string& method, const std::string& file,
                       const std::string& text) {
  REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
  std::string toml = text_of(folder / "hw/homework.toml");
  const std::size_t first = toml.find("\n[[scene]]\n");
  std::size_t last = first;
  for (std::size_t at = first; at != std::string::npos; at = toml.find("\n[[scene]]\n", at + 1)) last = at;
  toml.replace(first, toml.find("\n\n", last) - first, "\n[[scene]]\nfile = \"scenes/" + file + "\"");
  write_text(folder / "hw/homework.toml", toml);
  write_text(folder / ("hw/scenes/" + file), text);
  for (const char* other : {"hw/starter", "hw/handout.md"}) fs::remove_all(folder / other);
}
Outcome tried(const Folder& folder) {
  const Outcome refreshed = run(folder, "homework refresh hw");
  return refreshed.code == 0 ? run(folder, "homework try hw") : refreshed;
}

/// Six sides, of which one is not planar.
const std::string box =
    "v -1 -1 -1.1\nv 1 -1 -0.7\nv 1 1 -0.9\nv -1 1 -1.3\nv -1 -1 1.2\nv 1 -1 1\nv 1 1 1.3\nv -1 1 1.7\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const std::string seen =
    "[camera]\nrho = 5\ntheta = 35\nphi = 55\n[raster]\nwidth = 14\nheight = 12\n[[mesh]]\nfile = \"box.obj\"\n";

}  // namespace

TEST_CASE("homework scenes: polygons of any kind on the screen are taken by each homework that draws them") {
  if (!fs::exists("/usr/bin/python3")) return;
  for (const char* method : {"z-buffer", "scan-line", "depth-sort", "bsp", "warnock"})
    for (const SceneCase& one : on_the_screen()) {
      CAPTURE(method);
      CAPTURE(one.name);
      const Folder folder;
      homework_of_scene(folder, method, one.file, std::string(screen) + behind + one.text);
      const Outcome outcome = tried(folder);
      CHECK_MESSAGE(outcome.code == 0, outcome.out << outcome.err);
    }
}

TEST_CASE("homework scenes: scenes in space are handed out as they are seen") {
  if (!fs::exists("/usr/bin/python3")) return;
  const std::vector<SceneCase> cases{
      {"a mesh whose faces are not planar", "mesh.toml", ""},
      {"in parallel projection", "parallel.toml", "orthographic = true\n"},
      {"the eye inside", "inside.toml", "rho = 0.5\n"},
      {"a surface", "surface.toml", "surface"},
  };
  for (const char* method : {"z-buffer", "scan-line", "ray-casting", "depth-sort", "bsp", "warnock"})
    for (const SceneCase& one : cases) {
      if (one.file != std::string("mesh.toml") && method == std::string("z-buffer")) continue;
      CAPTURE(method);
      CAPTURE(one.name);
      const Folder folder;
      std::string text = seen;
      const std::string camera = one.text;
      if (camera == "surface")
        text.replace(text.find("[[mesh]]"), text.size(),
                     "[surface]\nformula = \"sin(x) * cos(z)\"\ncolumns = 5\nrows = 4\n");
      else if (camera.starts_with("rho")) text.replace(text.find("rho = 5\n"), 8, camera + "near = 0.05\nfar = 8\n");
      else if (!camera.empty()) text.insert(text.find("rho"), camera);
      if (camera.starts_with("rho")) text += "[options]\ncull = false\n";
      homework_of_scene(folder, method, one.file, text);
      write_text(folder / "hw/scenes/box.obj", box);
      const Outcome outcome = tried(folder);
      CHECK_MESSAGE(outcome.code == 0, outcome.out << outcome.err);
    }
}

TEST_CASE(
    "homework scenes: the text has as many polygons as the reference, and the triangles of one that is not planar") {
  const Folder folder;
  homework_of_scene(folder, "z-buffer", "bent.toml", std::string(screen) + on_the_screen().front().text);
  REQUIRE(run(folder, "homework refresh hw").code == 0);
  CHECK(has(text_of(folder / "hw/scenes/bent.txt"), "\n2\n3 0 1 2\n3 2 3 0\n"));
}

TEST_CASE("homework scenes: what a homework cannot take is said in a line, and nothing is begun") {
  struct Case {
    const char *method, *file, *text, *message;
  };
  for (const Case& one : {
           Case{"ray-casting", "flat.toml",
                "coordinates = \"screen\"\n[[polygon]]\npoints = [[1,1,0],[5,1,0],[3,5,0]]\n",
                "has no eye that rays could come from"},
           Case{"floating-horizon", "parallel.toml",
                "[camera]\northographic = true\n[surface]\nformula = \"sin(x)\"\ncolumns = 9\nrows = 5\n",
                "is not seen in perspective"},
           Case{"floating-horizon", "flat.toml",
                "coordinates = \"screen\"\n[[polygon]]\npoints = [[1,1,0],[5,1,0],[3,5,0]]\n", "draws a surface"},
           Case{"z-buffer", "large.toml",
                "coordinates = \"screen\"\n[raster]\nwidth = 16384\nheight = 2048\n[[polygon]]\npoints = "
                "[[1,1,0],[16000,1,0],[8000,2000,0]]\n",
                "the scene large has 16384x2048 pixels; make its raster smaller: a homework's has at most 1048576"},
           Case{"z-buffer", "many.toml",
                "coordinates = \"screen\"\n[raster]\nwidth = 1024\nheight = 1024\n[[polygon]]\npoints = "
                "[[0,0,0],[1023,0,0],[1023,1023,0],[0,1023,0]]\n[[polygon]]\npoints = "
                "[[0,0,1],[1023,0,1],[1023,1023,1],[0,1023,1]]\n",
                "a right run of it has more than 4194304 steps"},
           Case{"z-buffer", "away.toml", "[camera]\nrho = 3\n[[polygon]]\npoints = [[0,0,9],[1,0,9],[0,1,9]]\n",
                "no polygon of it can be seen"},
           Case{"z-buffer", "a'b.toml", "", "there is no file"},
       }) {
    CAPTURE(one.file);
    const Folder folder;
    homework_of_scene(folder, one.method, one.file, one.text);
    if (std::string(one.text).empty()) fs::remove(folder / (std::string("hw/scenes/") + one.file));
    for (const char* command : {"homework refresh hw", "homework try hw", "grade --homework hw ."}) {
      if (has(one.message, "steps") && !has(command, "try")) continue;  // no reference is needed, or scene by scene
      const Outcome outcome = run(folder, command);
      CHECK(outcome.code == 2);
      CHECK(times(outcome.err, "\n") == 1);
      CHECK_MESSAGE(has(outcome.err, one.message), outcome.err);
    }
  }
}

TEST_CASE("homework scenes: one outside the folder, or a link, is refused by whatever copies the homework") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  REQUIRE(shell(folder, "cp hw/scenes/crossing.toml evil.toml; printf 'ana\\n' > names.txt").code == 0);
  const std::string toml = text_of(folder / "hw/homework.toml"),
                    own = "\n[[scene]]\ngenerate = \"triangles\"\nname = \"own\"\n";
  const auto refused = [&](const std::string& more, const std::string& command, const std::string& message) {
    CAPTURE(command);
    CAPTURE(more);
    write_text(folder / "hw/homework.toml", toml + more);
    const Outcome outcome = run(folder, command);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(times(outcome.err, "\n") == 1);
    CHECK_MESSAGE(has(outcome.err, message), outcome.err);
    CHECK(folder.names() == std::vector<std::string>{"evil.toml", "hw", "names.txt"});
    CHECK_FALSE(fs::exists(folder / "hw/secret.key"));
  };
  const std::string outside = "\n[[scene]]\nfile = \"../evil.toml\"\n",
                    link = "\n[[scene]]\nfile = \"scenes/link.toml\"\n",
                    skipped = "\n[[scene]]\nfile = \"solution/kept.toml\"\nhidden = true\n";
  fs::create_symlink(folder / "evil.toml", folder / "hw/scenes/link.toml");
  fs::copy_file(folder / "evil.toml", folder / "hw/solution/kept.toml");
  for (const char* command : {"homework pack hw --gradescope -o a.zip", "homework pack hw --prairielearn -o grader",
                              "homework pack hw --github -o repository"}) {
    refused(outside, command, "the scene ../evil.toml lies outside the homework's folder");
  }
  refused(outside + own, "homework seed hw --for names.txt -o st", "lies outside the homework's folder");
  refused(link + own, "homework seed hw --for names.txt -o st", "hw: cannot be copied whole: ");
  refused(link, "homework pack hw --github -o repository", "cannot be copied whole: ");
  refused(skipped, "homework pack hw --gradescope -o a.zip", "hw: cannot be copied whole: the scene kept is not in it");
  refused(skipped, "homework pack hw --prairielearn -o grader", "the scene kept is not in it");
  refused("", "homework pack hw --prairielearn -o hw/grader", "lies in the folder of the homework");
}

TEST_CASE("homework seed: what a killed run left gives way to the next one") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  write_text(folder / "hw/homework.toml",
             text_of(folder / "hw/homework.toml") + "\n[[scene]]\ngenerate = \"triangles\"\nname = \"own\"\n");
  write_text(folder / "names.txt", "ana\nana.part\nbo\n");
  // As long as it makes the folders, it is killed again and again, each time a little later.
  for (int wait = 1; wait <= 24; ++wait)
    shell(folder, "\"$zstep\" homework seed hw --for names.txt -o st --seed a & sleep 0.0" + std::to_string(wait) +
                      "; kill -9 $!; wait $! 2> /dev/null");
  fs::create_directories(folder / "st/.bo.part/scenes");
  write_text(folder / "st/.bo.part/scenes/own.txt", "half");
  fs::remove_all(folder / "st/bo");
  const Outcome outcome = run(folder, "homework seed hw --for names.txt -o st");
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  CHECK(shell(folder, "ls -A st").out == "ana\nana.part\nbo\n");
  for (const char* student : {"ana", "ana.part", "bo"})
    CHECK(has(text_of(folder / ("st/" + std::string(student) + "/scenes/own.txt")), "\n"));
}

TEST_CASE("homework: a pipe, a device or what is far too large in place of its files is refused at once") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  write_text(folder / "names.txt", "ana\n");
  const auto refused = [&](const std::string& file, const std::string& put, const std::string& command) {
    CAPTURE(put);
    CAPTURE(command);
    REQUIRE(shell(folder, "mv " + file + " kept 2> /dev/null; " + put + " " + file).code == 0);
    const Outcome outcome = shell(folder, "ulimit -v 4000000; timeout 20 \"$zstep\" " + command);
    CHECK(outcome.code == 2);
    CHECK(times(outcome.err, "\n") == 1);
    CHECK_MESSAGE(has(outcome.err, file), outcome.err);
    REQUIRE(shell(folder, "rm " + file + "; mv kept " + file + " 2> /dev/null || true").code == 0);
  };
  for (const char* put : {"mkfifo", "ln -s /dev/zero", "truncate -s 3G"}) {
    refused("hw/homework.toml", put, "homework try hw");
    refused("hw/handout.md", put, "homework refresh hw");
    refused("hw/scenes/triangle.toml", put, "homework refresh hw");
    refused("hw/secret.key", put, "homework run hw hw/solution --program true -o runs");
    refused("names.txt", put, "homework seed hw --for names.txt -o st");
  }
  REQUIRE(run(folder, "record hw/scenes/triangle.toml -o t.ztrace").code == 0);
  for (const char* put : {"mkfifo", "ln -s /dev/zero", "truncate -s 3G"})
    refused("t.ztrace.marks", put, "explain t.ztrace 3 3 --at there");
}
