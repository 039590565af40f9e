// Programs that are made to break, to fool or to leave the grader: each is ended, earns nothing and touches nothing.
#include <doctest/doctest.h>

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
     "find / -name 'overlap*' -newer /bin/sh 2>/dev/null | grep -v \"$1\" | while read f; do cat \"$f\"; done; cat "
     "hidden.txt "
     "../../hw/hidden/overlap.toml"},
    {"reads its parents' memory", "cat /proc/1/environ /proc/$PPID/maps /proc/$PPID/cmdline"},
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
