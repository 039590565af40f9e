// zstep homework try: whether a homework can be handed out.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/small_homework.hpp"

using namespace zstep::test;
namespace fs = std::filesystem;

namespace {

bool has_python() { return fs::exists("/usr/bin/python3"); }

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
