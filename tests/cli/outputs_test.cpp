// What is written never replaces what is read, and how a command ends is told by its exit code. POSIX only.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/hostile_homework.hpp"
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

TEST_CASE("a pipe in the place of any file that is read is refused at once, in one line") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid --size 16x16 -o run.ztrace").code == 0);
  REQUIRE(shell(folder,
                "mkfifo a.jsonl a.npy a.pfm a.png a.md a.toml a.off names run.ztrace.journal run.ztrace.marks "
                "&& mkdir hw zstep && mkfifo hw/homework.toml zstep/viewer.ini")
              .code == 0);
  for (const std::string command :
       {"info a.jsonl", "check a.jsonl", "dump a.jsonl", "diff run.ztrace a.jsonl", "import a.jsonl -o b.ztrace",
        "view a.jsonl --screenshot b.png", "diff run.ztrace a.npy", "diff run.ztrace a.pfm", "diff run.ztrace a.png",
        "lesson ./a.md --screenshot b.png", "render a.toml", "render a.off",
        "view run.ztrace --at 5 --screenshot b.png"}) {
    CAPTURE(command);
    const Outcome outcome = shell(folder, "timeout 20 \"$zstep\" " + command + " < /dev/null");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(times(outcome.err, "\n") == 1);
  }
  // What stands beside a trace, or is zstep's own, is left alone.
  check_ends(folder, "timeout 20 \"$zstep\" info run.ztrace", 0);
  check_ends(folder, "XDG_CONFIG_HOME=. timeout 20 \"$zstep\" view pyramid --screenshot b.png", 0);
  CHECK(std::filesystem::is_fifo(folder / "run.ztrace.journal"));
}

TEST_CASE("what the machine refuses is one line about the machine, and no mistake in zstep") {
  const Folder folder;
  hostile_homework(folder);
  std::filesystem::create_directory(folder / "program");
  write_text(folder / "program/program.sh", "true");
  const auto one_line = [&](const std::string& line, const std::string& part) {
    CAPTURE(line);
    const Outcome outcome = shell(folder, line);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, part));
    CHECK_FALSE(has(outcome.err, "mistake in zstep"));
    CHECK(times(outcome.err, "\n") <= 2);  // with a note of what does not protect
  };
  for (const std::string walls : {"", "limits"})
    one_line("TMPDIR=/nowhere/at/all ZSTEP_SANDBOX=" + walls + " \"$zstep\" homework run hw program -o runs" + walls,
             "/nowhere/at/all: no folder can be made there");
  one_line("TMPDIR=/nowhere/at/all \"$zstep\" homework try hw", "/nowhere/at/all: no folder can be made there");
  if (!std::filesystem::exists("/proc/self/mem")) return;
  for (const std::string name : {"a.jsonl", "a.ztrace", "a.toml", "a.off", "a.npy", "a.png", "a.md"})
    std::filesystem::create_symlink("/proc/self/mem", folder / name);
  REQUIRE(run(folder, "record pyramid --size 16x16 -o run.ztrace").code == 0);
  for (const std::string command :
       {"info a.jsonl", "check a.jsonl", "import a.jsonl -o b.ztrace", "import - -o b.ztrace < a.jsonl",
        "render a.toml", "render a.off", "diff run.ztrace a.npy", "diff run.ztrace a.png",
        "lesson ./a.md --screenshot b.png"})
    one_line("\"$zstep\" " + command, "cannot be read");
  check_ends(folder, "\"$zstep\" info a.ztrace", 2);
}

TEST_CASE("an answer that could not be written is noticed, whatever else the exit code would say") {
  if (!std::filesystem::exists("/dev/full")) return;
  const Folder folder;
  REQUIRE(run(folder, "record pyramid --size 16x16 -o first.ztrace").code == 0);
  REQUIRE(run(folder, "record cube --size 16x16 -o other.ztrace").code == 0);
  REQUIRE(
      shell(folder,
            "\"$zstep\" dump first.ztrace --jsonl > right.jsonl && "
            "sed '/\"depth_compare\"\\|\"compare\"/s/true/false/' right.jsonl > run.jsonl; head -c 1900 first.ztrace "
            "> cut.ztrace")
          .code == 0);
  hostile_homework(folder);
  for (const auto& [command, code] : std::vector<std::pair<std::string, int>>{
           {"check run.jsonl", 1},
           {"check run.jsonl --json", 1},
           {"diff first.ztrace other.ztrace", 1},
           {"diff first.ztrace other.ztrace --json", 1},
           {"grade --homework hw overlap.right --scene triangle", 1},
           {"info cut.ztrace", 3},
           {"homework try hw", 1},
       }) {
    CAPTURE(command);
    CHECK(run(folder, command).code == code);
    const Outcome full = shell(folder, "\"$zstep\" " + command + " > /dev/full");
    CAPTURE(full.err);
    CHECK(full.code == 4);
    CHECK(has(full.err, "standard output: cannot be written; make room on the disk\n"));
  }
  for (const std::string command : {"diff first.ztrace other.ztrace --html /dev/full",
                                    "grade --homework hw overlap.right --scene triangle -o /dev/full"})
    check_ends(folder, "\"$zstep\" " + command, 4);
}

TEST_CASE("a standard output that is closed is noticed, and no file is taken for it") {
  const Folder folder;
  const Outcome outcome = shell(folder, "\"$zstep\" record pyramid --size 16x16 -o run.ztrace >&-");
  CHECK(outcome.code == 4);
  CHECK(outcome.err == "standard output: cannot be written; it is closed: redirect it to a file or to a program\n");
  REQUIRE(run(folder, "record pyramid --size 16x16 -o same.ztrace").code == 0);
  CHECK(text_of(folder / "run.ztrace") == text_of(folder / "same.ztrace"));
  check_ends(folder, "\"$zstep\" record pyramid --size 16x16 -o run.ztrace >&- 2>&- <&-", 4);
  CHECK(text_of(folder / "run.ztrace") == text_of(folder / "same.ztrace"));
}

TEST_CASE("what a full disk leaves is told as it is: no trace, the one before, or one that can be opened") {
  const Folder folder;
  REQUIRE(run(folder, "record pyramid --size 16x16 -o run.ztrace").code == 0);
  REQUIRE(run(folder, "record teapot --size 400x300 -o long.ztrace").code == 0);
  REQUIRE(shell(folder, "\"$zstep\" dump long.ztrace --jsonl > long.jsonl").code == 0);
  const std::string before = text_of(folder / "run.ztrace");
  const auto without_room = [&](const std::string& command, int kibibytes) {  // for any file
    Outcome outcome = shell(folder, "trap '' XFSZ; ulimit -f " + std::to_string(kibibytes) + "; \"$zstep\" " + command);
    CAPTURE(command);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 4);
    CHECK(times(outcome.err, "\n") == times(outcome.err, "note: ") + 1);
    return outcome.err;
  };
  CHECK(has(without_room("import long.jsonl -o new.ztrace", 64),
            "new.ztrace: there was no room for all of the trace; "
            "no trace is left"));
  CHECK_FALSE(std::filesystem::exists(folder / "new.ztrace"));
  CHECK(has(without_room("import long.jsonl -o run.ztrace", 64), "what had this name before still has it"));
  CHECK(text_of(folder / "run.ztrace") == before);
  CHECK(has(without_room("record teapot --size 400x300 -o run.ztrace", 1), "what had this name before still has it"));
  CHECK(text_of(folder / "run.ztrace") == before);
  CHECK(has(without_room("record teapot --size 400x300 -o run.ztrace", 128), "what was written so far can be opened"));
  check_ends(folder, "\"$zstep\" info run.ztrace", 3);
  CHECK_FALSE(has(run(folder, "record pyramid -o /dev/full").err, "can be opened"));
  for (const std::string& name : folder.names()) {
    CAPTURE(name);
    CHECK_FALSE((has(name, ".part") || has(name, ".begun")));
  }
}

TEST_CASE("a formula that asks for much work has the limits of a file, and what was recorded by then can be opened") {
  const Folder folder;
  const Outcome outcome =
      run(folder, "record 'y = sin(x) * cos(z)' --algorithm ray-casting --size 1280x960 -o run.ztrace");
  CHECK(outcome.code == 3);
  CHECK(has(outcome.err, "as time was up; the file holds them and can be opened"));
  check_ends(folder, "\"$zstep\" dump run.ztrace --from 1 --to 3", 0);
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
