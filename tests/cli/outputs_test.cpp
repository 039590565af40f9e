// What is written never replaces what is read, and how a command ends is told by its exit code. POSIX only.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/program.hpp"

using namespace zstep::test;

namespace {


/// Every file with what is in it.
std::vector<std::pair<std::string, std::string>> contents(const Folder& folder) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const std::string& name : folder.names())
    if (std::filesystem::is_regular_file(folder / name)) all.emplace_back(name, text_of(folder / name));
  return all;
}

void check_kept(const Folder& folder, const std::string& arguments) {
  CAPTURE(arguments);
  const auto before = contents(folder);
  const Outcome outcome = run(folder, arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(has(outcome.err, "would overwrite the input; write to another file"));
  CHECK(contents(folder) == before);
}

void check_ends(const Folder& folder, const std::string& line, int code) {
  CAPTURE(line);
  const Outcome outcome = shell(folder, line);
  CAPTURE(outcome.err);
  CHECK(outcome.code == code);
}

}  // namespace

TEST_CASE("a screenshot or table never replaces the trace, by whatever name it is called, nor what stands beside it") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid --size 16x16 -o run.ztrace").code == 0);
  write_text(folder / "run.ztrace.marks", "5 a place\n");
  std::filesystem::create_symlink("run.ztrace", folder / "link.png");
  std::filesystem::create_symlink("run.ztrace", folder / "link.ztrace");
  std::filesystem::create_hard_link(folder / "run.ztrace", folder / "hard.npy");
  check_kept(folder, "view run.ztrace --screenshot run.ztrace");
  check_kept(folder, "view run.ztrace --screenshot link.png");
  check_kept(folder, "view link.ztrace --screenshot run.ztrace");
  check_kept(folder, "view run.ztrace --screenshot run.ztrace.marks");
  check_kept(folder, "export run.ztrace -o hard.npy");
  REQUIRE(shell(folder, "\"$zstep\" dump run.ztrace --jsonl > run.jsonl").code == 0);
  check_kept(folder, "view run.jsonl --screenshot run.jsonl");
  check_kept(folder, "import run.jsonl -o run.jsonl");
  check_kept(folder, "import - -o run.jsonl < run.jsonl");
}

TEST_CASE("what a scene, a mesh or a lesson names is never written over, and no command writes over the settings") {
  const Folder folder;
  write_text(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_text(folder / "a.mtl", "newmtl red\nKd 1 0 0\n  map_Kd -s 1 1 1 wood.png\n");
  write_text(
      folder / "b.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile tex.png\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  write_text(folder / "wood.png", "wood");
  write_text(folder / "tex.png", "linen");
  write_text(folder / "scene.toml", "[[mesh]]\nfile = \"a.obj\"\n");
  for (const std::string output : {"a.obj", "a.mtl", "wood.png"}) {
    check_kept(folder, "render a.obj --save " + output);
    check_kept(folder, "record a.obj -o " + output);
    check_kept(folder, "render scene.toml --save " + output);
    check_kept(folder, "view scene.toml --screenshot " + output);
    check_kept(folder, "compare-methods scene.toml --methods z-buffer --csv " + output);
  }
  check_kept(folder, "render b.ply --save tex.png");
  write_text(folder / "a-lesson.md",
             "+++\ntitle = \"T\"\nsummary = \"S\"\nscene = \"scene.toml\"\nmethod = \"z-buffer\"\n+++\n\n## Stop {at: "
             "end}\n\nText.\n");
  check_kept(folder, "lesson ./a-lesson.md --screenshot a-lesson.md");
  check_kept(folder, "lesson ./a-lesson.md --screenshot a.obj");
  std::filesystem::create_directories(folder / "zstep");
  write_text(folder / "zstep/viewer.ini", "dark = 1\n");
  check_ends(folder, "XDG_CONFIG_HOME=. \"$zstep\" render pyramid --save zstep/viewer.ini", 2);
  CHECK(text_of(folder / "zstep/viewer.ini") == "dark = 1\n");
}

TEST_CASE("a trace that is being recorded is nobody else's to write") {
  const Folder folder;
  const Outcome outcome = shell(folder,
                                "\"$zstep\" record teapot --size 6000x4000 -o run.ztrace > /dev/null 2>&1 & first=$!\n"
                                "while [ ! -s run.ztrace ]; do sleep 0.02; done\n"
                                "\"$zstep\" record pyramid -o run.ztrace; echo $?\n"
                                "\"$zstep\" render pyramid --save run.ztrace; echo $?\n"
                                "kill -KILL $first; wait $first\n"
                                "\"$zstep\" record pyramid -o run.ztrace > /dev/null; echo $?");
  CHECK(outcome.out == "2\n2\n0\n");
  CHECK(times(outcome.err,
              "run.ztrace: another zstep is recording to it; wait until it has ended, or write to another file") == 2);
  CHECK(folder.names() == std::vector<std::string>{"run.ztrace"});
}

TEST_CASE("a pipe or a device is read and written, or refused at once") {
  const Folder folder;
  REQUIRE(shell(folder, "mkfifo pipe pipe.ztrace").code == 0);
  check_ends(folder, "timeout 20 \"$zstep\" render pyramid --save pipe", 2);
  check_ends(folder, "timeout 20 \"$zstep\" record pyramid -o pipe", 2);
  check_ends(folder, "timeout 20 \"$zstep\" info pipe.ztrace", 2);
  check_ends(folder, "timeout 20 \"$zstep\" view pipe --screenshot a.png", 2);
  check_ends(folder, "timeout 20 \"$zstep\" info /dev/zero", 2);
  check_ends(folder, "timeout 20 \"$zstep\" import /dev/zero -o a.ztrace", 2);
  check_ends(folder, "cat pipe > got.png & sleep 0.1; timeout 20 \"$zstep\" render pyramid --save pipe && wait", 0);
  CHECK(text_of(folder / "got.png").substr(1, 3) == "PNG");
  check_ends(folder, "\"$zstep\" render pyramid --save /dev/null", 0);
}

TEST_CASE("the exit code says how a command ended") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid --size 16x16 -o run.ztrace").code == 0);
  check_ends(folder, "\"$zstep\" info run.ztrace", 0);
  check_ends(folder, "\"$zstep\" redner", 2);
  check_ends(folder, "\"$zstep\" redner 2> /dev/full", 2);
  check_ends(folder, "\"$zstep\" redner 2>&-", 2);
  check_ends(folder, "head -c 1900 run.ztrace > cut.ztrace; \"$zstep\" info cut.ztrace", 3);
  check_ends(folder, "\"$zstep\" list > /dev/full", 4);
  check_ends(folder, "\"$zstep\" render pyramid --save /dev/full", 4);
  check_ends(folder, "\"$zstep\" record pyramid -o /dev/full", 4);
  check_ends(folder, "ulimit -v 200000; \"$zstep\" record teapot --size 5000x5000 -o big.ztrace", 4);
}
