// zstep homework try and run: whether a homework can be handed out, and programs that nobody vouches for.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
namespace fs = std::filesystem;

namespace {

bool has_python() { return fs::exists("/usr/bin/python3"); }

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = text_of(file);
  REQUIRE(has(text, from));
  text.replace(text.find(from), from.size(), to);
  write_text(file, text);
}

/// A folder hw with one public and one hidden scene and small limits, without programs.
void small_homework(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  for (const char* scene : {"crossing", "neighbours"}) {
    replace_in(folder / "hw/homework.toml", std::string("[[scene]]\nfile = \"scenes/") + scene + ".toml\"\n", "");
    for (const char* kind : {".toml", ".txt"}) fs::remove(folder / (std::string("hw/scenes/") + scene + kind));
  }
  for (const char* place : {"hw/starter", "hw/solution"}) fs::remove_all(folder / place);
  replace_in(folder / "hw/homework.toml", "\n[options]\n",
             "\n[program]\ncommand = \"sh program.sh\"\nseconds = 1\nmemory = 128\noutput = 1\nfiles = 4\n"
             "processes = 12\n\n[options]\n");
}
void write_program(const Folder& folder, const std::string& text) {
  fs::create_directories(folder / "program");
  write_text(folder / "program/program.sh", text);
  fs::remove_all(folder / "runs");
}

}  // namespace

TEST_CASE("homework try: a new homework can be handed out") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  const Outcome outcome = run(folder, "homework try hw");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(has(outcome.out, "It can be handed out."));
  CHECK(has(outcome.out, "hidden scenes lie apart"));
  if (has_python()) CHECK(has(outcome.out, "solution/zbuffer.py runs and gets 65 of 65 points"));
  CHECK(folder.names() == std::vector<std::string>{"hw"});
}

TEST_CASE("homework try: what would go wrong is named, with how to mend it") {
  struct Case {
    const char* change;
    const char* message;
  };
  for (const Case& one : {
           Case{"rm hw/scenes/triangle.txt",
                "scenes/triangle.txt does not agree with homework.toml and the scenes; write it anew: zstep homework "
                "refresh hw"},
           Case{"echo 1 > hw/hidden/overlap.txt", "hidden/overlap.txt does not agree"},
           Case{"mkdir hw/starter && echo '#' > hw/starter/emit.py", "starter/emit.py does not agree"},
           Case{"cp hw/hidden/overlap.txt hw/scenes/more.txt",
                "scenes/more.txt is the hidden scene overlap, and lies where students look; move it"},
           Case{"cp hw/scenes/triangle.toml hw/hidden/overlap.toml && ./refresh hw",
                "the hidden scene overlap is the same as triangle"},
           Case{"rm hw/hidden/overlap.toml", "1 of the hidden scenes that homework.toml names are not here"},
           Case{"echo 'Run `python3 start.py scenes/triangle.txt`.' >> hw/handout.md", "names start.py, which is not"},
           Case{"sed -i 's/^value = 10$/value = 0/' hw/homework.toml",
                "the part 'picture and depths' is worth nothing"},
           Case{"sed -i 's/^points.*/points = [[1, 1.2, 1], [9, 1.2, 1], [4, 1.8, 1]]/' hw/scenes/triangle.toml "
                "&& ./refresh hw",
                "triangle: has no step of the part 'spans', so every run earns its points there"},
       }) {
    const Folder folder;
    small_homework(folder);
    write_text(folder / "refresh", "#!/bin/sh\n\"$zstep\" homework refresh $1\n");
    const Outcome changed = shell(folder, "export zstep; chmod +x refresh; " + std::string(one.change));
    CAPTURE(one.change);
    CAPTURE(changed.err);
    REQUIRE(changed.code == 0);
    const Outcome outcome = run(folder, "homework try hw");
    CAPTURE(outcome.out);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(has(outcome.out, std::string("no  ")));
    CHECK(has(outcome.out, one.message));
    CHECK(has(outcome.out, "Mend what is marked with no."));
  }
}

TEST_CASE("homework refresh: what is made from the rest is written anew, and nothing else") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  CHECK(run(folder, "homework refresh hw").out == "All is as it must be.\n");
  const std::string right = text_of(folder / "hw/starter/emit.py");
  write_text(folder / "hw/starter/emit.py", "print(1)\n");
  const Outcome outcome = run(folder, "homework refresh hw");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "hw/starter/emit.py\n");
  CHECK(text_of(folder / "hw/starter/emit.py") == right);
}

TEST_CASE("homework try: programs that are wrong, crash or print no run are named") {
  if (!has_python()) return;
  struct Case {
    const char *file, *from, *to, *message;
  };
  for (const Case& one : {Case{"hw/solution/zbuffer.py", "nearer = z <", "nearer = z >", "its compare is wrong"},
                          Case{"hw/solution/zbuffer.py", "def main():", "def main():\n    1 / 0",
                               "solution/zbuffer.py ended with exit code 1 on triangle:"},
                          Case{"hw/starter/zbuffer.py", "    emit.clear(math.inf)", "    print('hello')",
                               "what starter/zbuffer.py prints on triangle cannot be graded"}}) {
    const Folder folder;
    REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
    for (const char* other : {"hw/starter/zbuffer.cpp", "hw/starter/zbuffer.js"}) fs::remove(folder / other);
    replace_in(folder / one.file, one.from, one.to);
    const Outcome outcome = run(folder, "homework try hw");
    CAPTURE(outcome.out);
    CHECK(outcome.code == 1);
    CHECK(has(outcome.out, one.message));
  }
}

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
      // Where processes cannot be counted by the user, the shell is refused the 13th, and says so.
      const bool refused = has(outcome.out, "ended with exit code 2") && has(one.says, "it started");
      CHECK(outcome.code == (well ? 0 : 1));
      CHECK((has(outcome.out, one.says) || refused));
      CHECK(has(outcome.err, "bubblewrap (bwrap) does not work here") == (std::string(sandbox).size() > 14));
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
    if (format != "text") continue;
    CHECK(has(outcome.out, "The program ended with exit code 7."));
    CHECK(has(outcome.out, "triangle.txt"));
    CHECK(has(outcome.out, "The program ended with an exit code other than 0."));
  }
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
