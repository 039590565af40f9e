// Files that were made to harm: whatever is asked of them ends within ten seconds of processor time and a gigabyte,
// with an exit code of the table, and shows no character that does something. What is damaged or lies is told, and
// never an answer. POSIX only.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

namespace fs = std::filesystem;

std::string hostile(const std::string& name) { return in_checkout("tests/data/hostile/" + name); }

void check_harmless(const Folder& folder, const std::string& arguments) {
  CAPTURE(arguments);
  // A second more than the ten is a signal, and a code of 128 and more.
  const Outcome outcome = shell(folder, "ulimit -t 11; \"$zstep\" " + arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code >= 0);
  CHECK(outcome.code <= 3);
  for (const std::string& text : {outcome.out, outcome.err})
    CHECK(std::none_of(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) < ' ' && c != '\n') || c == 0x7f; }));
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  CHECK(used.ru_maxrss < 1024 * 1024);  // KiB, of the largest so far
}

void check_every_trace(const std::string& command, const std::string& options) {
  const Folder folder;
  int traces = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(in_checkout("tests/data/hostile"))) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".ztrace" && extension != ".jsonl") continue;
    ++traces;
    check_harmless(folder, command + " '" + entry.path().string() + "' " + options);
  }
  CHECK(traces > 10);
}

/// A whole trace of three blocks and more, and where its blocks begin.
std::string recorded(const Folder& folder) {
  REQUIRE(run(folder, "record teapot --size 64x48 -o run.ztrace").code == 0);
  return text_of(folder / "run.ztrace");
}

}  // namespace

TEST_CASE("hostile files: info and query") {
  check_every_trace("info", "");
  check_every_trace("query", "'select count(*) from buffers_clear'");
}
TEST_CASE("hostile files: dump") { check_every_trace("dump", "--jsonl"); }
TEST_CASE("hostile files: check") { check_every_trace("check", ""); }
TEST_CASE("hostile files: find") { check_every_trace("find", "'step > 0' --all"); }
TEST_CASE("hostile files: history") {
  for (const char* pixel : {"0 0", "1 1", "3 3 --why"}) check_every_trace("history", pixel);
}
TEST_CASE("hostile files: why-not") {
  check_every_trace("why-not", "0");
  check_every_trace("why-not", "0 1 1");
}
TEST_CASE("hostile files: explain") {
  check_every_trace("explain", "1 1");
  check_every_trace("explain", "--at 100%");
  check_every_trace("explain", "--at 100% --exact");
}
TEST_CASE("hostile files: export") {
  check_every_trace("export", "-o depth.npy");
  check_every_trace("export", "--buffer overdraw -o overdraw.csv");
}
TEST_CASE("hostile files: view") { check_every_trace("view", "--at 50% --screenshot out.png"); }

TEST_CASE("hostile files: lessons and scenes") {
  const Folder folder;
  for (const std::string name : {"lw.md", "lesson_long_word_50KB.md"})
    check_harmless(folder, "lesson '" + hostile(name) + "' --screenshot out.png");
  const std::string scene = "'" + hostile("long_name_20KB.toml") + "'";
  for (const std::string& command :
       {"render " + scene, "record " + scene + " -o run.ztrace", "view " + scene + " --screenshot out.png",
        std::string("history run.ztrace 8 8"), std::string("find run.ztrace 'step > 0' --all"),
        std::string("view run.ztrace --at 50% --screenshot out.png")})
    check_harmless(folder, command);
}

TEST_CASE("hostile files: a small scene that makes much work comes to the budget of render and record") {
  const Folder folder;
  // 1 KB each: a raster as large as there may be, and a surface that is in front of itself all over it.
  const std::string raster = "[raster]\nwidth = 7680\nheight = 4320\n";
  write_text(folder / "surface.toml", raster +
                                          "[surface]\nformula = \"y = sin(40 * x) * cos(40 * z)\"\n"
                                          "columns = 499\nrows = 499\n[camera]\nrho = 3\nphi = 80\n");
  check_harmless(folder, "render surface.toml");
  check_harmless(folder, "record surface.toml -o surface.ztrace");
  // What was recorded by then is a trace. On a busy machine time may be up before the scene is made, and there is none.
  Outcome cut;
  for (int seconds = 2; seconds <= 32 && !has(cut.err, "cut.ztrace: stopped after "); seconds *= 2) {
    cut = run(folder, fmt::format("record surface.toml -o cut.ztrace --seconds {}", seconds));
    CHECK(cut.code == 3);
  }
  CHECK(has(cut.err, "cut.ztrace: stopped after "));
  CHECK(has(cut.err, " steps, as time was up; the file holds them and can be opened; give --seconds more"));
  CHECK(run(folder, "info cut.ztrace").code != 2);
  CHECK(run(folder, "render surface.toml --seconds 0").code == 2);
  CHECK(run(folder, "render teapot --size 640x480 --memory 1").code == 3);
}

TEST_CASE("an index that says otherwise than its blocks is made anew") {
  const Folder folder;
  for (const std::string name :
       {"lying_index_steps.ztrace", "lying_index_tiles.ztrace", "lying_index_noblocks.ztrace"}) {
    CAPTURE(name);
    const Outcome info = run(folder, "info '" + hostile(name) + "'");
    CHECK((info.code == 2 || has(info.err, "its index is damaged and was made anew from its blocks; all ")));
    // What the index denies is found where the trace is read.
    const std::string steps = run(folder, "dump '" + hostile(name) + "'").out;
    const std::string found = run(folder, "find '" + hostile(name) + "' 'step > 0' --all").out;
    CHECK(times(steps, "\n") == times(found, "\n"));
    const Outcome strict = run(folder, "info --strict '" + hostile(name) + "'");
    CHECK((strict.code == 2 || strict.code == 3));
  }
}

TEST_CASE("a damaged block loses itself alone, and the steps that are lost are named") {
  const Folder folder;
  std::string bytes = recorded(folder);
  const std::string whole = run(folder, "dump run.ztrace").out;
  const std::size_t first = bytes.find("EVTS"), second = bytes.find("EVTS", first + 4);
  REQUIRE(second != std::string::npos);
  bytes[second + 300] = static_cast<char>(bytes[second + 300] ^ 0x10);
  write_text(folder / "hurt.ztrace", bytes);
  const auto end_of = [](const std::string& text) { return text.substr(text.size() - 200); };
  for (const std::string name : {"hurt.ztrace", "blocks.ztrace"}) {
    CAPTURE(name);
    if (name == "blocks.ztrace") write_text(folder / name, bytes.substr(0, bytes.rfind("INDX")));
    const Outcome dump = run(folder, "dump " + name);
    CAPTURE(dump.err);
    CHECK(dump.code == 3);
    CHECK(has(dump.err, " are lost: "));
    CHECK(times(dump.out, "\n") < times(whole, "\n"));
    CHECK(end_of(dump.out) == end_of(whole));  // the same steps by the same numbers
    CHECK(run(folder, "dump --strict " + name).code >= 2);
    const Outcome history = run(folder, "history " + name + " 30 20");
    CHECK(history.code == 3);
    CHECK(run(folder, "view " + name + " --at 9000 --screenshot a.png").code == 3);
    CHECK(run(folder, "query " + name + " 'select count(*) from depth_compare'").code == 3);
  }
}

TEST_CASE("a flipped bit in the end of a file is damage of its index, and costs nothing else") {
  const Folder folder;
  const std::string bytes = recorded(folder), whole = run(folder, "dump run.ztrace").out;
  const std::size_t index = bytes.rfind("INDX");
  for (const std::size_t at : {index, index + 9, index + 30, bytes.size() - 20, bytes.size() - 12, bytes.size() - 1}) {
    CAPTURE(at);
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x01);
    write_text(folder / "flipped.ztrace", flipped);
    const Outcome dump = run(folder, "dump flipped.ztrace");
    CHECK(dump.code == 0);
    CHECK(dump.out == whole);
    CHECK(has(dump.err, "flipped.ztrace: its index is damaged and was made anew from its blocks; all "));
    CHECK(times(dump.err, "flipped.ztrace: ") == 1);
  }
}

TEST_CASE("limits on time and memory end a command in one line, and can be raised") {
  const Folder folder;
  REQUIRE(run(folder, "record teapot --size 400x300 -o run.ztrace").code == 0);
  for (int hundredths = 1; hundredths < 10; ++hundredths) {  // each ends elsewhere, never within a line
    const Outcome hurried = run(folder, "dump run.ztrace --jsonl --seconds 0.0" + std::to_string(hundredths));
    CHECK(hurried.code == 3);
    CHECK(has(hurried.err, "zstep: stopped after "));
    CHECK(times(hurried.err, "\n") == 1);
    CHECK((hurried.out.empty() || hurried.out.back() == '\n'));
  }
  const Outcome narrow = run(folder, "export run.ztrace -o a.npy --memory 1");
  CHECK(narrow.code == 3);
  CHECK(has(narrow.err, "--memory"));
  CHECK(times(narrow.err, "\n") == 1);
  CHECK(folder.names() == std::vector<std::string>{"run.ztrace"});
  CHECK(run(folder, "export run.ztrace -o a.npy --memory 200 --seconds 20").code == 0);
  for (const std::string option : {"--seconds 0", "--memory -1"})
    CHECK(run(folder, "info run.ztrace " + option).code == 2);
}
