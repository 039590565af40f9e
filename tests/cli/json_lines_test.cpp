// JSON Lines of other programs at the command line: whole, wrong, and cut off by a crash.
#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

std::string foreign(const std::string& name) { return text_of(in_checkout("tests/data/foreign/") + name); }

}  // namespace

TEST_CASE("the run of a program that crashed is opened by the commands, with its last words on standard error") {
  const Folder folder;
  write_text(folder / "run.jsonl", foreign("torn_trace.jsonl"));
  for (const char* command :
       {"info run.jsonl", "dump run.jsonl", "find run.jsonl compare", "history run.jsonl 1 1",
        "why-not run.jsonl A 1 1", "explain run.jsonl 1 1", "query run.jsonl \"select count(*) from depth_compare\"",
        "export run.jsonl -o depth.csv", "import run.jsonl -o run.ztrace"}) {
    CAPTURE(command);
    const Outcome outcome = run(folder, command);
    CHECK(outcome.code == 3);
    CHECK(!outcome.out.empty());
    CHECK(times(outcome.err, "\n") == 1);
    CHECK(has(outcome.err,
              "run.jsonl:152: the recording was cut off here, at \u201cTraceback (most recent call last):\u201d"));
    CHECK(has(outcome.err, "ZeroDivisionError"));
    CHECK(has(outcome.err, "150 steps could be read"));
  }
  // What was made of it is known to be cut off as well.
  const Outcome imported = run(folder, "info run.ztrace");
  CHECK(imported.code == 3);
  CHECK(has(imported.err, "cut off"));
  CHECK(has(imported.out, "150 steps"));
}

TEST_CASE("mistakes in JSON Lines are told one a line, with line, column and cure") {
  const Folder folder;
  std::string text = foreign("greater.jsonl");
  for (const char* line :
       {"{\"step\":\"wp\",\"x\":-1,\"y\":1,\"polygon\":0}", "{\"step\":\"wq\"}", "{\"step\":\"scan\",\"y\":NaN}"})
    text += std::string(line) + "\n";
  write_text(folder / "run.jsonl", text);
  const std::string first = "run.jsonl:" + std::to_string(times(foreign("greater.jsonl"), "\n") + 1) +
                            ":14: column -1 lies outside the raster; ";
  for (const char* command : {"info run.jsonl", "import run.jsonl -o run.ztrace"}) {
    const Outcome outcome = run(folder, command);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(times(outcome.err, "\n") == 3);
    CHECK(outcome.err.starts_with(first));
    CHECK(has(outcome.err, "NaN is no number of JSON's; write \"nan\", in quotes"));
  }
  CHECK(folder.names() == std::vector<std::string>{"run.jsonl"});
}

TEST_CASE("what a header declares stays declared, and what it does not is no fact") {
  const Folder folder;
  const std::string greater = foreign("greater.jsonl"), declared = R"({"nearer": "greater"})";
  write_text(folder / "run.jsonl", greater);
  CHECK(run(folder, "import run.jsonl -o run.ztrace").code == 0);
  for (const char* file : {"run.jsonl", "run.ztrace"}) {
    CAPTURE(file);
    CHECK(has(run(folder, std::string("dump --jsonl ") + file).out, R"("conventions":{"nearer":"greater"},"steps")"));
    const std::string info = run(folder, std::string("info ") + file).out;
    CHECK(has(info, "nearer         the greater depth wins\n"));
    CHECK(has(info, "ties           not declared\n"));
    CHECK(has(info, "coverage       not declared\n"));
    const Outcome found = run(folder, std::string("find ") + file + " compare");
    CHECK(has(found.out, "5 > 0"));
    CHECK(!has(found.out, "should not win"));
  }
  std::string undeclared = greater;
  write_text(folder / "open.jsonl", undeclared.replace(undeclared.find(declared), declared.size(), "{}"));
  CHECK(has(run(folder, "find open.jsonl compare").out, "its header does not declare which depth is nearer"));
}
