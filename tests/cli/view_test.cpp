// view, lesson and zstep alone, on a machine without a display.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "traces/image/png.hpp"
#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;
using zstep::Image;
using zstep::read_png;

namespace {

void must(const Folder& folder, const std::string& arguments) {
  const Outcome outcome = run(folder, arguments);
  CAPTURE(arguments);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
}

}  // namespace

TEST_CASE("view and explain: a run of every depth and of every library's conventions is shown and told") {
  const Folder folder;
  for (const char* how :
       {"--depth view", "--depth corrected", "--depth reciprocal", "--depth reversed", "--depth foley",
        "--depth zero-to-one", "--like lecture", "--like opengl", "--like vulkan", "--like direct3d",
        "--seen-at corners", "--positions subpixels", "--coverage round-half-open"}) {
    CAPTURE(how);
    REQUIRE(run(folder, std::string("record pyramid -o run.ztrace ") + how).code == 0);
    const Outcome shown = run(folder, "view run.ztrace --at 900 --screenshot shown.png");
    CHECK_MESSAGE(shown.code == 0, shown.err);
    const Outcome told = run(folder, "explain run.ztrace 16 14");
    CHECK_MESSAGE(told.code == 0, told.err);
    const Outcome checked = run(folder, "check run.ztrace");
    CHECK_MESSAGE(checked.code == 0, checked.out);
  }
}

TEST_CASE("view: a mesh opens on its finished picture, a built-in scene and what --at names do not") {
  const Folder folder;
  write_text(folder / "facet.off", "OFF\n3 1 0\n-0.5 -0.5 0\n0.5 -0.5 0\n0 0.5 0\n3 0 1 2\n");
  const std::string of_mesh = "view facet.off --size 8x6 --describe";
  const Outcome opened = run(folder, of_mesh), last = run(folder, of_mesh + " --at 100%");
  REQUIRE(opened.code == 0);
  REQUIRE(last.code == 0);
  const auto first_line = [](const Outcome& one) { return one.out.substr(0, one.out.find('\n')); };
  CHECK(first_line(opened) == first_line(last));
  CHECK(first_line(run(folder, of_mesh + " --at 0")) != first_line(last));
  CHECK(first_line(run(folder, "view pyramid --describe")) ==
        first_line(run(folder, "view pyramid --describe --at 0")));
  must(folder, "view facet.off --size 8x6 --screenshot facet.png");
  must(folder, "view facet.off --size 8x6 --at 0 --screenshot first.png");
  CHECK(text_of(folder / "facet.png") != text_of(folder / "first.png"));
}

TEST_CASE("zstep alone without a display says so, writes the first picture and names what works") {
  const Folder folder;
  const Outcome outcome = run(folder, "");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(has(outcome.out, "no display"));
  CHECK(has(outcome.out, "wrote zstep.png"));
  for (const std::string command : {"list", "lesson z-buffer", "view", "render", "record", "info", "dump", "import"}) {
    CAPTURE(command);
    CHECK(has(outcome.out, "\n  zstep " + command));
  }
  CHECK(folder.names() == std::vector<std::string>{"zstep.png"});
  const Image image = read_png(folder / "zstep.png");
  CHECK(image.width == 1280);
  CHECK(image.height == 720);
  must(folder, "lesson z-buffer --screenshot lesson.png");
  CHECK(text_of(folder / "zstep.png") == text_of(folder / "lesson.png"));
  must(folder, "lesson --screenshot first.png");  // with or without the word, it is one lesson
  CHECK(text_of(folder / "zstep.png") == text_of(folder / "first.png"));
}

TEST_CASE("without a display a window is refused in one line, before any work") {
  const Folder folder;
  for (const std::string arguments : {"view teapot --size 4000x4000", "lesson", "view nothing.ztrace"}) {
    const Outcome outcome = run(folder, arguments);
    CHECK(outcome.code == 2);
    CHECK(times(outcome.err, "\n") == 1);
    CHECK(has(outcome.err, "there is no display"));
    CHECK(has(outcome.err, "--screenshot"));
  }
}

TEST_CASE("a trace, its JSON Lines and its scene give the same picture of the viewer") {
  const Folder folder;
  must(folder, "record pyramid --size 16x16 -o run.ztrace");
  CHECK(shell(folder, "\"$zstep\" dump run.ztrace --jsonl > run.jsonl").code == 0);
  must(folder, "view run.ztrace --at 100 --screenshot a.png --size-window 1024x640");
  const Image a = read_png(folder / "a.png");
  CHECK(a.width == 1024);
  CHECK(a.height == 640);
  must(folder, "view run.ztrace --at 101 --screenshot b.png --size-window 1024x640");
  CHECK(text_of(folder / "a.png") != text_of(folder / "b.png"));
  must(folder, "view run.ztrace --at 100 --screenshot light.png --size-window 1024x640 --light");
  CHECK(text_of(folder / "a.png") == text_of(folder / "light.png"));
  must(folder, "view run.ztrace --at 100 --screenshot dark.png --size-window 1024x640 --dark");
  CHECK(text_of(folder / "a.png") != text_of(folder / "dark.png"));
}

TEST_CASE("the run of a program that crashed is shown as far as it goes") {
  const Folder folder;
  write_text(folder / "run.jsonl", text_of(in_checkout("tests/data/foreign/torn.jsonl")));
  const Outcome outcome = run(folder, "view run.jsonl --at 150 --screenshot run.png --size-window 1024x640");
  CHECK(outcome.code == 3);
  CHECK(has(outcome.err, "run.jsonl:152: the recording was cut off here"));
  CHECK(read_png(folder / "run.png").width == 1024);
}

TEST_CASE("a stop is opened by its number, also where several speak at one step") {
  const Folder folder;
  write_text(folder / "two.md",
             "+++\ntitle = \"T\"\nsummary = \"s\"\nscene = \"pyramid\"\nmethod = \"z-buffer\"\n+++\n\n"
             "## First {at: compare}\n\nOne.\n\n## Second {at: here}\n\nTwo.\n\n## Third {at: end}\n\nThree.\n");
  for (const char* stop : {"1", "2"})
    must(folder, std::string("lesson two.md --at 'stop ") + stop + "' --pane lesson --screenshot " + stop + ".png");
  CHECK(text_of(folder / "1.png") != text_of(folder / "2.png"));
}

TEST_CASE("view and lesson refuse what cannot be") {
  const Folder folder;
  must(folder, "record pyramid --size 8x8 -o run.ztrace");
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    CAPTURE(arguments);
    const Outcome outcome = run(folder, arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, part));
    CHECK(times(outcome.err, "\n") == 1);
  };
  refused("view none.ztrace --screenshot a.png", "none.ztrace: there is no such file");
  refused("view run.ztrace --size 9x9 --screenshot a.png", "--size: run.ztrace was recorded already");
  refused("view run.ztrace --at 99999999 --screenshot a.png", "--at: the trace ends at step");
  refused("view run.ztrace --at x --screenshot a.png", "--at: 'x'");
  refused("view run.ztrace --screenshot none/a.png", "there is no folder none");
  refused("view run.ztrace --screenshot a.png --size-window 5", "--size-window: '5'");
  refused("view run.ztrace --screenshot a.png --dark --light", "--dark excludes --light");
  refused("view pyramid --screenshot a.png --near 2 --far 1", "--far: it is 1, but near is 2");
  refused("lesson nothing.md --screenshot a.png", "nothing.md");
  CHECK(folder.names() == std::vector<std::string>{"run.ztrace"});
}

TEST_CASE("the commands that zstep alone names do work without a display") {
  const Folder folder;
  const std::string said = run(folder, "").out;
  // import needs a trace of one's own: zstep's serves.
  REQUIRE(
      shell(folder, "\"$zstep\" record foley -o own.ztrace && \"$zstep\" dump own.ztrace --jsonl > run.jsonl").code ==
      0);
  int tried = 0;
  for (std::size_t at = said.find("\n  zstep "); at != std::string::npos; at = said.find("\n  zstep ", at + 1)) {
    const std::size_t begin = at + 9;
    const std::string line = said.substr(begin, said.find("  ", begin) - begin);
    CAPTURE(line);
    const Outcome outcome = run(folder, line);
    CHECK(outcome.code == 0);
    CHECK(times("\n" + outcome.err, "\n") - 1 == times("\n" + outcome.err, "\nnote: "));
    ++tried;
  }
  CHECK(tried == 8);
}
