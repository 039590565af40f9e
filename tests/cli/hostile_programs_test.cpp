// Programs that are made to break, to fool or to leave the grader: each is ended, earns nothing and touches nothing.
#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/hostile_homework.hpp"

using namespace zstep::test;
namespace fs = std::filesystem;

namespace {

/// A program, run on both scenes, that earns nothing.
struct Program {
  std::string name, text;
};
const std::vector<Program> hostile_programs{
    {"prints nothing", "true"},
    {"hangs", "while :; do :; done"},
    {"waits", "sleep 1717"},
    {"waits for input", "cat; sleep 1717"},
    {"starts programs without end", "f() { f | f & }; f; sleep 1717"},
    {"fills memory", "a=x; while :; do a=$a$a$a$a; done"},
    {"fills memory by files", "while :; do cat /bin/sh /bin/sh >> /dev/shm/x || exit 1; done"},
    {"fills the disk", "while :; do cat /bin/sh /bin/sh >> $TMPDIR/x || exit 1; done"},
    {"prints without end", "while :; do cat /bin/sh; done"},
    {"complains without end", "while :; do cat /bin/sh >&2; done"},
    {"kills its parent", "kill -9 $PPID; kill -9 -1; echo '{\"score\":100}'"},
    {"prints a result", "echo '{\"score\":1000,\"gradable\":true,\"tests\":[{\"score\":1000,\"max_score\":1}]}'"},
    {"closes its output", "exec 0<&- 1>&- 2>&-; sleep 0.3; exit 0"},
    {"leaves a process behind", "(setsid sh -c 'sleep 5; echo late > $TMPDIR/late' &) ; exit 0"},
    {"writes where it should not",
     "for f in ../escaped /escaped \"$1\" ./escaped \"$OUT\"; do echo x > \"$f\"; done; rm -rf /program/* \"$1\""},
    {"reads hidden scenes",
     "find / -name 'overlap.t*' -newer /bin/sh 2>/dev/null | grep -v \"$1\" | while read f; do cat \"$f\"; done; cat "
     "hidden.txt "
     "../../hw/hidden/overlap.toml"},
    {"reads its parents' memory", "cat /proc/1/environ /proc/$PPID/maps /proc/$PPID/cmdline"},
    {"nests folders",
     "python3 -c 'import os\nos.chdir(os.environ[\"TMPDIR\"])\nwhile 1: os.mkdir(\"d\"); os.chdir(\"d\")'"},
    {"ends by a signal", "kill -SEGV $$"},
    {"ends by an exit code of a signal", "exit 137"},
    {"prints escapes and HTML",
     "printf '\\033[2J<script>alert(1)</script>&\\377\\000' ; printf '\\033[2J<b>\\377' >&2; exit 1"},
};

}  // namespace

TEST_CASE("hostile submissions: programs earn nothing, are ended, and touch nothing else") {
  const Folder folder;
  hostile_homework(folder);
  fs::create_directory(folder / "program");
  fs::create_symlink("../hw/hidden/overlap.txt", folder / "program/hidden.txt");
  const std::string hidden = text_of(folder / "hw/hidden/overlap.toml").substr(0, 100);
  for (const char* sandbox : {"ZSTEP_SANDBOX=", "ZSTEP_SANDBOX=limits"}) {
    const auto run_it = [&](const std::string& text) {
      fs::remove_all(folder / "runs");
      write_text(folder / "program/program.sh", text);
      return shell(folder, std::string("export OUT=$PWD/escaped ") + sandbox +
                               "; ulimit -t 120; \"$zstep\" homework run hw program -o runs");
    };
    // As the user who tests they would do what they are here for.
    const Outcome harmless = run_it("true");
    if (has(harmless.err, "run as you")) continue;
    const bool walls = harmless.err.empty();
    for (const Program& one : hostile_programs) {
      CAPTURE(one.name);
      CAPTURE(walls);
      write_text(folder / "program/program.sh", one.text);
      const std::string before = everything_in(folder);
      const Outcome outcome = run_it(one.text);
      CAPTURE(outcome.out);
      CAPTURE(outcome.err);
      CHECK(outcome.code <= 1);
      CHECK_FALSE(shows_controls(outcome.out));
      for (const char* scene : {"triangle", "overlap"})
        CHECK(fs::exists(folder / "runs" / (scene + std::string(".jsonl"))));
      // Without walls they see what everybody may read.
      if (walls) CHECK_FALSE(has(text_of(folder / "runs/triangle.jsonl"), hidden));
      CHECK(grade_in_every_format(folder) == 0);
      CHECK(everything_in(folder) == before);
      CHECK(shell(folder, "pgrep -f 'sleep 171[7]'").out.empty());
    }
  }
}

namespace {

/// A folder for temporary files that every user may reach, and nothing else uses.
struct ReachableFolder {
  fs::path path;
  ReachableFolder() {
    std::string pattern = "/tmp/zstep-reachable-XXXXXX";
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path = pattern;
    fs::permissions(path, fs::perms(0755));
  }
  ~ReachableFolder() { shell(Folder(), "rm -rf '" + path.string() + "'"); }
};

/// What the program did on its first scene, with limits alone.
std::string ended_with_limits(const Folder& folder, const ReachableFolder& place, const std::string& text) {
  fs::remove_all(folder / "runs");
  fs::create_directories(folder / "program");
  write_text(folder / "program/program.sh", text);
  const Outcome outcome = shell(
      folder, "TMPDIR='" + place.path.string() + "' ZSTEP_SANDBOX=limits \"$zstep\" homework run hw program -o runs");
  CAPTURE(outcome.err);
  CHECK(outcome.code <= 1);
  const fs::path note = folder / "runs/triangle.ended.txt";
  return fs::exists(note) ? text_of(note) : "";
}

}  // namespace

TEST_CASE(
    "hostile submissions: without walls nothing is left where everybody may write, however deep and however much") {
  const Folder folder;
  const ReachableFolder place;
  hostile_homework(folder);
  const fs::path homework = folder / "hw/homework.toml";
  write_text(homework, with_changed(text_of(homework), "seconds = 1\n", "seconds = 8\n"));
  fs::create_directory(folder / "program");
  write_text(folder / "program/program.sh", "true");
  if (has(shell(folder, "ZSTEP_SANDBOX=limits \"$zstep\" homework run hw program -o runs").err, "run as you")) return;
  const std::string nest =
      "import os\nos.chdir(os.environ[\"TMPDIR\"])\nfor i in range(3000): os.mkdir(NAME); os.chdir(NAME)";
  for (const auto& [name, text, reason] : std::vector<std::array<std::string, 3>>{
           {"deep", "python3 -c '" + with_changed(nest, "NAME", "\"d\"") + "'", "200 deep"},
           {"long and deep", "python3 -c '" + with_changed(nest, "NAME", "\"d\"*200") + "'", "200 deep"},
           {"many", "i=0; while [ $i -lt 12000 ]; do : > $TMPDIR/$i; i=$((i+1)); done", "10000 files"},
           {"shared memory", "for i in 1 2 3 4 5 6 7 8 9; do head -c 1000000 /dev/zero > /dev/shm/zstep-left-$i; done",
            "4 MiB"},
           {"temporary",
            "mkdir -p /tmp/zstep-left/a/b; head -c 9000000 /dev/zero > /tmp/zstep-left/a/b/c || true; for i in 1 2 3; "
            "do "
            "head -c 2000000 /dev/zero > /tmp/zstep-left/$i; done",
            "4 MiB"},
           {"a little", "echo x > /dev/shm/zstep-left; mkdir -m 000 /var/tmp/zstep-left; chmod 500 $TMPDIR", ""},
       }) {
    CAPTURE(name);
    const std::string ended = ended_with_limits(folder, place, text);
    CHECK(has(ended, reason));
    CHECK(fs::is_empty(place.path));
    CHECK(shell(folder, "ls -d /dev/shm/zstep-left* /tmp/zstep-left* /var/tmp/zstep-left* 2>/dev/null").out.empty());
  }
}

TEST_CASE("hostile submissions: memory that processes share counts once, and too many of them are told as that") {
  const Folder folder;
  const ReachableFolder place;
  hostile_homework(folder);  // 128 MiB, 12 processes
  const std::string forks =
      "python3 -c 'import os, time\nx = bytearray(os.urandom(1)) * (40 << 20)\n"
      "for i in range(COUNT):\n  if os.fork() == 0:\n    time.sleep(0.6)\n    os._exit(0)\n"
      "time.sleep(0.7)'";
  const std::string few = ended_with_limits(folder, place, with_changed(forks, "COUNT", "6"));
  CHECK(few == "");
  const std::string many = ended_with_limits(folder, place, with_changed(forks, "COUNT", "40"));
  CHECK(has(many, "more than 12 processes"));
}

TEST_CASE("hostile submissions: who grades may be killed, and the program ends too, with all that was made for it") {
  const Folder folder;
  const ReachableFolder place;
  hostile_homework(folder);
  fs::create_directory(folder / "program");
  write_text(folder / "program/program.sh", "exec 1>&- 2>&-; (setsid sleep 1723 &); sleep 1723");
  for (const char* sandbox : {"ZSTEP_SANDBOX=", "ZSTEP_SANDBOX=limits"}) {
    CAPTURE(sandbox);
    fs::remove_all(folder / "runs");
    const Outcome outcome = shell(
        folder, std::string("TMPDIR='") + place.path.string() + "' " + sandbox +
                    " \"$zstep\" homework run hw program -o runs > /dev/null 2>&1 & grader=$!\n"
                    "n=0; until pgrep -f 'sleep 172[3]' > /dev/null || [ $n -gt 200 ]; do sleep 0.1; n=$((n+1)); done\n"
                    "pgrep -f 'sleep 172[3]' > /dev/null && echo begun\n"
                    "kill -KILL $grader\n"
                    "n=0; while pgrep -f 'sleep 172[3]' > /dev/null && [ $n -lt 100 ]; do sleep 0.1; n=$((n+1)); done\n"
                    "pgrep -f 'sleep 172[3]'; sleep 0.5");
    CHECK(outcome.out == "begun\n");
    CHECK(fs::is_empty(place.path));
  }
}
