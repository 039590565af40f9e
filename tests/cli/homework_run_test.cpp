// zstep homework run: programs that nobody vouches for.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/small_homework.hpp"

using namespace zstep::test;
using nlohmann::json;
namespace fs = std::filesystem;

TEST_CASE("homework run: how a program ended is said in words, walled in or not") {
  const Folder folder;
  small_homework(folder);
  struct Case {
    const char *program, *says;
  };
  for (const char* sandbox : {"ZSTEP_SANDBOX=", "ZSTEP_SANDBOX=limits"})
    for (const Case& one :
         {Case{"cat \"$1\"", "the program ended well"}, Case{"exit 3", "the program ended with exit code 3"},
          Case{"kill -SEGV $$", "was ended by SIGSEGV, as after an access to memory that is not its own"},
          Case{"./nothing-of-this-name", "could not be started (exit code 127)"},
          Case{"sleep 1000", "was stopped after 3 s: it waited for something, or had no end"},
          Case{"yes", "was stopped: it printed more than 1 MiB"},
          Case{"for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do sleep 1000 & done; wait",
               "was stopped: it started"},
          Case{"exec >&- 2>&-; sleep 0.2; exit 4", "ended with exit code 4"}}) {
      write_program(folder, one.program);
      const Outcome outcome =
          shell(folder, std::string("export ") + sandbox + "; \"$zstep\" homework run hw program -o runs");
      CAPTURE(one.program);
      CAPTURE(sandbox);
      CAPTURE(outcome.out);
      CAPTURE(outcome.err);
      const bool well = has(one.says, "well");
      CHECK(outcome.code == (well ? 0 : 1));
      CHECK(has(outcome.out, one.says));
      CHECK(has(outcome.err, "bubblewrap (bwrap) is not used, as ZSTEP_SANDBOX=limits asks for") ==
            (std::string(sandbox).size() > 14));
    }
  write_program(folder, "cat \"$1\"");
  REQUIRE(run(folder, "homework run hw program -o runs").code == 0);
  CHECK(text_of(folder / "runs/triangle.jsonl") == text_of(folder / "hw/scenes/triangle.txt"));
}

TEST_CASE("homework run: what a program complained of stands in the report, but for hidden scenes") {
  const Folder folder;
  small_homework(folder);
  write_program(folder, "echo '{\"step\":\"clear\",\"z\":\"inf\"}'; echo \"secret of $1\" >&2; exit 7");
  REQUIRE(run(folder, "homework run hw program -o runs").code == 1);
  for (const std::string format : {"text", "gradescope", "prairielearn", "junit"}) {
    const Outcome outcome = run(folder, "grade --homework hw runs --format " + format);
    CAPTURE(outcome.out);
    CHECK(outcome.code == 1);
    CHECK_FALSE(has(outcome.out, "overlap.txt"));
    // That it crashed stands in every format: by its first wrong step alone it would be a wrong program as any.
    if (format != "prairielearn") CHECK(has(outcome.out, "The program ended with exit code 7."));
    else CHECK(has(json::parse(outcome.out)["output"].get<std::string>(), "The program ended with exit code 7."));
    if (format != "text") continue;
    CHECK(has(outcome.out, "triangle.txt"));
    CHECK(has(outcome.out, "The program ended with an exit code other than 0."));
  }
}

TEST_CASE("homework run: why a program was not run, or not to its end, stands in the report") {
  const Folder folder;
  small_homework(folder);
  write_program(folder, "true");
  write_text(folder / "program/large", std::string(5 << 20, ' '));
  const auto check = [&](const std::string& why) {
    for (const std::string format : {"text", "gradescope", "prairielearn", "junit", "html"}) {
      CAPTURE(format);
      const Outcome outcome = run(folder, "grade --homework hw runs --format " + format);
      CAPTURE(outcome.out);
      CHECK(outcome.code == 2);
      CHECK(has(outcome.out, why));
      CHECK_FALSE(has(outcome.out, "Nothing was handed in"));
    }
    fs::create_directory(folder / "class");
    fs::rename(folder / "runs", folder / "class/ada");
    const Outcome batch = run(folder, "grade --homework hw --batch class -o gradebook.csv");
    CHECK(has(batch.out, "1 ungradable"));
    fs::remove_all(folder / "class");
  };
  CHECK(run(folder, "homework run hw program -o runs").code == 2);
  check("The program was not run: program: holds more than ");
  // Killed while the first program runs: of the second nothing is known either.
  fs::remove(folder / "program/large");
  write_program(folder, "sleep 3");
  CHECK(shell(folder,
              "\"$zstep\" homework run hw program -o runs & p=$!; until [ -e runs/triangle.jsonl ]; do kill -0 "
              "$p || exit 99; done; kill -9 $p; wait $p")
            .code == 128 + 9);
  check("The program was not run to its end: something stopped the grader from outside.");
}

TEST_CASE("homework run: where memory is short, the system ends a student's program before the grader") {
  const Folder folder;
  small_homework(folder);
  write_program(folder, "cat /proc/self/oom_score_adj");
  for (const char* sandbox : {"ZSTEP_SANDBOX=", "ZSTEP_SANDBOX=limits"}) {
    REQUIRE(
        shell(folder, std::string("rm -rf runs; export ") + sandbox + "; \"$zstep\" homework run hw program -o runs")
            .code == 0);
    CHECK(text_of(folder / "runs/triangle.jsonl") == "1000\n");
  }
}

TEST_CASE("homework run: bubblewrap that is not installed is told apart from one that does not work here") {
  const Folder folder;
  small_homework(folder);
  write_program(folder, "true");
  write_text(folder / "broken", "#!/bin/sh\necho 'bwrap: No permissions' >&2\nexit 1\n");
  fs::permissions(folder / "broken", fs::perms(0755));
  struct Case {
    const char *instead, *says;
  };
  for (const Case& one :
       {Case{"/dev/null", "bubblewrap (bwrap) is not installed (apt-get install bubblewrap): programs run as "},
        Case{"$PWD/broken",
             "bubblewrap (bwrap) is installed and does not work here: “bwrap: No permissions” (it must be "
             "allowed to make namespaces and to mount; docs/homework.md says how): programs run as "}}) {
    const std::string root = std::string("bwrap --dev-bind / / --bind ") + one.instead + " /usr/bin/bwrap -- ";
    if (shell(folder, "[ ! -e /usr/local/bin/bwrap ] && " + root + "true").code != 0) return;  // no bubblewrap at all
    const Outcome outcome =
        shell(folder, "rm -rf runs; ZSTEP_SANDBOX= " + root + "\"$zstep\" homework run hw program -o runs");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(has(outcome.err, one.says));
    CHECK(times(outcome.err, "\n") == 1);
  }
}

TEST_CASE("homework run: what else runs as the same user takes no processes from a program") {
  const Folder folder;
  small_homework(folder);
  write_program(folder, "(sleep 0.1; echo started) & wait");
  const std::string others = "for i in $(seq 20); do setpriv --reuid 65534 --clear-groups sleep 20 & done; sleep 0.5; ";
  const Outcome outcome =
      shell(folder, others +
                        "ZSTEP_SANDBOX=limits \"$zstep\" homework run hw program -o runs; code=$?; kill $(jobs -p); "
                        "exit $code");
  CAPTURE(outcome.out);
  CHECK(outcome.code == 0);
  CHECK(text_of(folder / "runs/triangle.jsonl") == "started\n");
}

TEST_CASE("homework run: what cannot be run is refused before it is said what a program could reach") {
  const Folder folder;
  small_homework(folder);
  write_program(folder, "true");
  const Outcome outcome = shell(folder, "ZSTEP_SANDBOX=limits \"$zstep\" homework run hw nowhere -o runs");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(has(outcome.err, "is no folder"));
  CHECK(times(outcome.err, "\n") == 1);
}

TEST_CASE("homework run: folders that would show a program too much, or lose runs, are refused") {
  const Folder folder;
  small_homework(folder);
  write_program(folder, "true");
  struct Case {
    const char *words, *message;
  };
  for (const Case& one :
       {Case{"hw . -o runs", "holds the homework, which the program would see"},
        Case{"hw hw -o runs", "holds the homework"}, Case{"hw program -o program/runs", "lies in the program's folder"},
        Case{"hw nowhere -o runs", "is no folder"}, Case{"hw program -o hw", "is there already"},
        Case{"hw program", "give -o FOLDER"}, Case{"hw", "too little is given"}}) {
    const Outcome outcome = run(folder, std::string("homework run ") + one.words);
    CAPTURE(one.words);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, one.message));
    CHECK(times(outcome.err, "\n") == 1);
  }
  CHECK(folder.names() == std::vector<std::string>{"hw", "program"});
}
