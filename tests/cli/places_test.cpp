// "at", the place in the program's source: every command that names a step names it.
#include <doctest/doctest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

/// right.ztrace, and run.jsonl with a wrong slope in it, each of whose steps says where it was printed.
void make_runs(const Folder& folder) {
  REQUIRE(shell(folder,
                "$zstep record foley -o right.ztrace && $zstep dump right.ztrace --jsonl | "
                "sed -e 's/\"dx_dy\":1.5/\"dx_dy\":1.25/' -e '2,$ s/\"step\":\"\\([a-z_]*\\)\".*/&\\1/' "
                "-e '2,$ s/}\\([a-z_]*\\)$/,\"at\":\"src\\/\\1.c:7\"}/' > run.jsonl")
              .code == 0);
}

}  // namespace

TEST_CASE("at: check, diff, explain, history, why-not, find and dump say where a step was printed") {
  const Folder folder;
  make_runs(folder);
  const Outcome checked = run(folder, "check run.jsonl");
  CAPTURE(checked.out);
  CHECK(checked.code == 1);
  CHECK(has(checked.out, "1. run.jsonl:11, printed at src/insert_edge.c:7: insert_edge, edge e1"));
  CHECK(json::parse(run(folder, "check run.jsonl --json").out)["causes"][0]["at"] == "src/insert_edge.c:7");

  CHECK(has(run(folder, "diff right.ztrace run.jsonl").out, "   B  run.jsonl:11, printed at src/insert_edge.c:7\n"));
  CHECK(json::parse(run(folder, "diff right.ztrace run.jsonl --json").out)["causes"][0]["b"]["at"] ==
        "src/insert_edge.c:7");

  REQUIRE(run(folder, "import run.jsonl -o run.ztrace").code == 0);
  CHECK(shell(folder, "$zstep dump run.ztrace --jsonl | cmp - run.jsonl").code == 0);
  CHECK(shell(folder, "$zstep dump run.ztrace --jsonl --from 2 --to 4 > some && sed -n 3,5p run.jsonl | cmp - some")
            .code == 0);
  CHECK(has(run(folder, "dump run.ztrace --from 1 --to 1").out, "  at=src/clear.c:7\n"));
  CHECK(has(run(folder, "check run.ztrace").out, "1. run.ztrace, step 10, printed at src/insert_edge.c:7: "));
  const std::string explained = run(folder, "explain run.ztrace 9 3").out;
  CAPTURE(explained);
  CHECK(has(explained, "depth written at pixel (9, 3)   printed at src/write_depth.c:7\n"));
  CHECK(has(run(folder, "explain run.ztrace 9 3 --json").out, "\"at\": \"src/write_depth.c:7\""));
  const std::string history = run(folder, "history run.ztrace 9 3").out;
  CAPTURE(history);
  CHECK(has(history, "PRINTED AT\n"));
  CHECK(has(history, "  src/compare.c:7\n"));
  CHECK(has(run(folder, "why-not run.ztrace 0 9 3").out, "  src/write_pixel.c:7\n"));
  CHECK(has(run(folder, "find run.ztrace nearer").out, "   printed at src/compare.c:7\n"));
  // A run that says nothing of it is told as ever.
  for (const char* command :
       {"history right.ztrace 9 3", "explain right.ztrace 9 3", "dump right.ztrace", "check right.ztrace"}) {
    CAPTURE(command);
    const std::string told = run(folder, command).out;
    CHECK_FALSE(has(told, "rinted at"));
    CHECK_FALSE(has(told, "PRINTED"));
    CHECK_FALSE(has(told, " \n"));
  }
}

TEST_CASE("at: the window's words say where the step was printed") {
  const Folder folder;
  make_runs(folder);
  CHECK(has(run(folder, "view run.jsonl --at 10 --describe").out, "Printed at src/insert_edge.c:7\n"));
}

TEST_CASE("at: the grader says where the first wrong step was printed") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  write_text(folder / "triangle.jsonl",
             "{\"step\":\"compare\",\"x\":2,\"y\":2,\"z\":0.75,\"nearer\":true,\"at\":\"zbuffer.py:41\"}\n");
  const Outcome graded = run(folder, "grade --homework hw --scene triangle triangle.jsonl");
  CAPTURE(graded.out);
  CHECK(has(graded.out, "triangle.jsonl:1, printed at zbuffer.py:41"));
}

TEST_CASE("at: check --view opens the first cause's place in the editor, as one word that no shell reads") {
  const Folder folder;
  make_runs(folder);
  write_text(folder / "editor", "#!/bin/sh\nprintf '[%s]' \"$@\" > words.part\nmv words.part words\n");
  REQUIRE(shell(folder, "chmod +x editor && mkdir src 'my src' && touch src/insert_edge.c 'my src/a.c'").code == 0);
  const auto opened = [&](const std::string& editor, const std::string& command) {
    return shell(folder, "rm -f words; export ZSTEP_EDITOR='" + editor + "'; $zstep " + command +
                             " --view --describe > said 2> err; for i in 1 2 3 4 5 6 7 8 9; do [ -f words ] && break; "
                             "sleep 0.1; done; cat words 2> /dev/null; cat err");
  };
  CHECK(opened("./editor -g {}", "check run.jsonl").out == "[-g][src/insert_edge.c:7]");
  CHECK(opened("./editor -g {}", "diff right.ztrace run.jsonl").out == "[-g][src/insert_edge.c:7]");
  CHECK(opened("./editor", "check run.jsonl").out ==
        "ZSTEP_EDITOR: has no {} for the place; write for example ZSTEP_EDITOR=\"code -g {}\"\n");
  CHECK(has(opened("./no-editor {}", "check run.jsonl").out, "ZSTEP_EDITOR: ./no-editor cannot be started: "));
  CHECK(opened("./editor {}", "check right.ztrace").out == "");
  // A run may name anything.
  const auto with_place = [&](const std::string& place) {
    REQUIRE(shell(folder, "sed 's|src/insert_edge.c:7|" + place + "|' run.jsonl > other.jsonl").code == 0);
    return opened("./editor {}", "check other.jsonl").out;
  };
  CHECK(with_place("my src/a.c:12") == "[my src/a.c:12]");
  const std::string refused =
      ": there is no such file in this folder, or no such line is named; run zstep in the program's folder\n";
  for (const char* place : {"$(touch hacked):1", "src/insert_edge.c", "src/insert_edge.c:", "src/insert_edge.c:x",
                            "src:1", "--extension=x:1"})
    CHECK(with_place(place) == place + refused);
  CHECK_FALSE(has(shell(folder, "ls").out, "hacked"));
}

TEST_CASE("standard input: check, diff, explain and view read a run from it, of either kind") {
  const Folder folder;
  make_runs(folder);
  const Outcome checked = shell(folder, "cat run.jsonl | $zstep check -");
  CAPTURE(checked.out);
  CHECK(checked.code == 1);
  CHECK(has(checked.out, "standard input: 334 steps"));
  CHECK(has(checked.out, "1. standard input:11, printed at src/insert_edge.c:7: insert_edge"));
  CHECK_FALSE(has(checked.out, "zstep view"));
  CHECK(shell(folder, "$zstep check - < right.ztrace").code == 0);
  const Outcome differ = shell(folder, "cat run.jsonl | $zstep diff right.ztrace -");
  CHECK(differ.code == 1);
  CHECK(has(differ.out, "B: standard input\n"));
  CHECK(has(differ.out, "   B  standard input:11, printed at"));
  CHECK(shell(folder, "cat right.ztrace | $zstep explain - 9 3").out == run(folder, "explain right.ztrace 9 3").out);
  CHECK(shell(folder, "cat run.jsonl | $zstep view - --at 10 --describe").out ==
        run(folder, "view run.jsonl --at 10 --describe").out);
  const Outcome both = shell(folder, "cat run.jsonl | $zstep diff - -");
  CHECK(both.code == 2);
  CHECK(both.err == "-: standard input can be read once; write one of the two runs to a file\n");
  const Outcome none = shell(folder, "$zstep check - < /dev/null");
  CHECK(none.code == 2);
  CHECK(has(none.err, "standard input:1:1: there is no header line"));
  CHECK(shell(folder, "printf ztr | $zstep check -").code == 2);
}

TEST_CASE("check --view --pixel: opens at what is wrong there, at its cause, or at the pixel's last step") {
  const Folder folder;
  // A span's depth at its left edge is wrong, and pixel (0, 2) follows from it; a compare at (1, 2) is wrong itself.
  REQUIRE(shell(folder,
                "$zstep record delhi -o right.ztrace && $zstep dump right.ztrace --jsonl | "
                "sed -e '21s/\"z_left\":5.0/\"z_left\":4.0/' -e '22,25s/\\(\"x\":0,\"y\":2,\"z\":\\)5.0/\\14.0/' "
                "-e '26,27s/\"nearer\":true/\"nearer\":false/' > run.jsonl")
              .code == 0);
  const auto opened = [&](const std::string& pixel) {
    const std::string said = run(folder, "check run.jsonl --view --describe --pixel " + pixel).out;
    const std::size_t at = said.find("Pixel ("), step = said.find("\nStep ");
    if (at == said.npos || step == said.npos) return said;
    return said.substr(at, said.find('\n', at) - at) + said.substr(step, said.find(" of ", step) - step);
  };
  CHECK(opened("0,2") == "Pixel (0, 2): opened at step 20, from which something wrong there follows\nStep 20");
  CHECK(opened("1,2") == "Pixel (1, 2): opened at step 26, the first there that is wrong\nStep 26");
  CHECK(opened("1,6") ==
        "Pixel (1, 6): opened at step 100, the last there: none of its steps is known to be wrong\nStep 100");
  CHECK(opened("7,0") == "Pixel (7, 0): opened at step 20, as no step is about it\nStep 20");
  CHECK(
      has(run(folder, "check run.jsonl --view --describe --pixel 8,0").err, "--pixel 8,0: the raster has 8x8 pixels"));
}
