// zstep export: tables against the replay, sheets and films by their size, and nothing left behind by what failed.
#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/answers/pixel_counts.hpp"
#include "traces/image/png.hpp"
#include "traces/image/tables.hpp"
#include "tests/cli/program.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep::test;
using namespace zstep;

namespace {

void must(const Folder& folder, const std::string& arguments, const std::string& says) {
  CAPTURE(arguments);
  const Outcome outcome = run(folder, arguments);
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(has(outcome.out, says));
}

void refused(const Folder& folder, const std::string& arguments, const std::string& part) {
  CAPTURE(arguments);
  const Outcome outcome = run(folder, arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(has(outcome.err, part));
  CHECK(times(outcome.err, "\n") == 1);
}

/// From the top row on, of a picture whose rows count from the bottom.
template <class Value>
std::vector<Value> from_the_top(const std::vector<Value>& values, int width) {
  std::vector<Value> turned;
  for (auto row = values.end(); row != values.begin(); row -= width) turned.insert(turned.end(), row - width, row);
  return turned;
}

/// An ffmpeg that writes what it was given, and its own arguments, to its last one.
void fake_ffmpeg(const Folder& folder, const std::string& what) {
  write_text(folder / "bin_ffmpeg", "#!/bin/sh\nfor last; do :; done\n" + what);
  REQUIRE(shell(folder, "mkdir -p bin && mv bin_ffmpeg bin/ffmpeg && chmod +x bin/ffmpeg").code == 0);
}

}  // namespace

TEST_CASE("export: tables of any step are what the replay holds there") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o run.ztrace").code == 0);  // its row 0 is at the bottom
  const Trace trace = Trace::open(folder / "run.ztrace");
  Replay replay(trace);
  answers::PixelCounts counts(trace);
  for (const std::int64_t at : {std::int64_t{0}, std::int64_t{200}, trace.size()}) {
    CAPTURE(at);
    replay.go_to(at);
    const Picture& picture = replay.state().picture;
    const std::string step = at == trace.size() ? "" : " --at " + std::to_string(at);
    must(folder, "export run.ztrace -o depth.npy" + step,
         "wrote depth.npy: depth at step " + std::to_string(at) + ", float64 [8,8]");
    must(folder, "export run.ztrace --buffer frame -o frame.npy" + step, "int32 [8,8]");
    const Npy depth = read_npy(folder / "depth.npy"), frame = read_npy(folder / "frame.npy");
    CHECK((depth.height == 8 && depth.width == 8));
    CHECK(std::get<std::vector<double>>(depth.values) == from_the_top(picture.depth, 8));
    CHECK(std::get<std::vector<std::int32_t>>(frame.values) == from_the_top(picture.polygon, 8));
    must(folder, "export run.ztrace --buffer colors -o colors.npy" + step, "colors");
    const auto colors = std::get<std::vector<std::int32_t>>(read_npy(folder / "colors.npy").values);
    const Color corner = color_at(picture, trace.scene(), 7 * 8);
    CHECK(colors[0] == (corner.red << 16 | corner.green << 8 | corner.blue));
    counts.count_to(at);
    must(folder, "export run.ztrace --buffer failed -o failed.npy" + step, "failed");
    CHECK(std::get<std::vector<std::int32_t>>(read_npy(folder / "failed.npy").values) ==
          from_the_top(counts.of(answers::Count::failed), 8));
  }
  must(folder, "export run.ztrace -o depth.csv --at 200", "depth.csv");
  replay.go_to(200);
  std::istringstream lines(text_of(folder / "depth.csv"));
  std::vector<double> values;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
  }
  CHECK(count == 8);
  CHECK(values == from_the_top(replay.state().picture.depth, 8));
  refused(folder, "export run.ztrace --buffer light-depth -o l.npy", "makes no picture as the light sees it");
  REQUIRE(run(folder, "record " + in_checkout("lessons/scenes/lamp.toml") +
                          " --algorithm shadow-buffer --size 8x8 -o light.ztrace")
              .code == 0);
  must(folder, "export light.ztrace --buffer light-depth -o l.npy", "light-depth");
}

TEST_CASE("a place in a trace is a step, a percentage or a bookmark") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o run.ztrace").code == 0);  // 252 steps
  must(folder, "export run.ztrace --at 126 -o step.csv", "wrote step.csv");
  const std::string half = text_of(folder / "step.csv");
  for (const char* at : {"50%", "'50 %'", "49.9%", "50.1%"}) {
    CAPTURE(at);
    must(folder, std::string("export run.ztrace --at ") + at + " -o part.csv", "wrote part.csv");
    CHECK(text_of(folder / "part.csv") == half);
  }
  must(folder, "export run.ztrace --at 0% -o begin.csv", "wrote begin.csv");
  must(folder, "export run.ztrace --at 100% -o end.csv", "wrote end.csv");
  must(folder, "export run.ztrace -o whole.csv", "wrote whole.csv");
  CHECK(text_of(folder / "end.csv") == text_of(folder / "whole.csv"));
  CHECK(text_of(folder / "begin.csv") != half);
  CHECK(text_of(folder / "end.csv") != half);
  for (const char* at : {"101%", "-1%", "nan%"}) {
    CAPTURE(at);
    refused(folder, std::string("export run.ztrace --at=") + at + " -o x.csv",
            std::string("--at: '") + at + "' is no part of a trace; give 0% to 100%");
  }
  refused(folder, "export run.ztrace --at=% -o x.csv", "is no step, and no bookmark");
  write_text(folder / "run.ztrace.marks", "126 9%\n");
  must(folder, "export run.ztrace --at 9% -o marked.csv", "wrote marked.csv");
  CHECK(text_of(folder / "marked.csv") == half);  // a name that was given counts first
}

TEST_CASE("export: lines have no depths in a buffer, and an empty table is not what is asked for") {
  const Folder folder;
  for (const char* by : {"hidden-line", "wireframe", "floating-horizon"}) {
    CAPTURE(by);
    const std::string scene = std::string(by) == "floating-horizon" ? "'y = sin(x) * cos(z)'" : "pyramid";
    must(folder, fmt::format("record {} --algorithm {} --size 40x30 -o run.ztrace", scene, by), "wrote run.ztrace");
    refused(folder, "export run.ztrace -o depth.npy",
            fmt::format("--buffer: {} draws lines, which have no depth in a buffer; ask for colors", by));
    must(folder, "export run.ztrace --buffer depth -o depth.npy", "wrote depth.npy");
    must(folder, "export run.ztrace --buffer colors -o colors.npy", "wrote colors.npy");
  }
}

TEST_CASE("export: a pane, a sheet, and a sheet of bookmarks") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o run.ztrace").code == 0);
  must(folder, "export run.ztrace --at 100 --pane depth --size-window 300x200 -o pane.png", "300x200");
  must(folder, "view run.ztrace --at 100 --pane depth --size-window 300x200 --screenshot same.png", "wrote same.png");
  CHECK(text_of(folder / "pane.png") == text_of(folder / "same.png"));
  must(folder, "export run.ztrace --at 100 --pane frame --size-window 300x200 -o other.png", "300x200");
  CHECK(text_of(folder / "pane.png") != text_of(folder / "other.png"));
  must(folder, "export run.ztrace --sheet 5 --columns 3 --size-window 200x160 -o sheet.png",
       "wrote sheet.png: 5 steps");
  const Image sheet = read_png(folder / "sheet.png");
  CHECK(sheet.width >= 3 * 200);
  CHECK(sheet.width < 4 * 200);
  CHECK(sheet.height >= 2 * 160);
  write_text(folder / "run.ztrace.marks", "219 a tie\n");
  must(folder, "export run.ztrace --steps '40,a tie' --size-window 200x160 -o marks.png", "2 steps");
  refused(folder, "export run.ztrace --steps '40,none' -o marks.png", "--steps: 'none' is no step, and no bookmark");
  refused(folder, "export run.ztrace --steps 40, -o marks.png", "a step is missing");
  refused(folder, "export run.ztrace --pane fram -o x.png",
          "this trace has no pane 'fram'; its panes are frame, depth");
  refused(folder, "view run.ztrace --pane tree --screenshot x.png", "this trace has no pane 'tree'");
  refused(folder, "export run.ztrace --sheet 5000 -o x.png", "more than 100");
  refused(folder, "export run.ztrace --from 9 --to 3 --sheet 2 -o x.png", "the last step is 3");
  refused(folder, "export run.ztrace --sheet 3 -o x.npy", "--sheet: does not go with x.npy");
  refused(folder, "export run.ztrace --buffer depth -o x.png", "--buffer: does not go with x.png");
  refused(folder, "export run.ztrace -o x.txt", "does not say what to write");
  refused(folder, "export run.ztrace --buffer deph -o x.npy", "did you mean depth");
  refused(folder, "export run.ztrace --at 999 -o x.npy", "the trace ends at step 252");
  refused(folder, "export run.ztrace -o none/x.npy", "there is no folder none");
  CHECK(folder.names() == std::vector<std::string>{"marks.png", "other.png", "pane.png", "run.ztrace",
                                                   "run.ztrace.marks", "same.png", "sheet.png"});
}

TEST_CASE("export: a film is piped to ffmpeg, frame by frame, and put in its place when it is whole") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi -o run.ztrace").code == 0);
  const std::string film =
      "export run.ztrace --from 100 --to 103 --pane frame --size-window 64x48 --fps 4 -o 'a film.gif'";
  const Outcome without = shell(folder, "PATH=/nonexistent \"$zstep\" " + film);
  CHECK(without.code == 2);
  CHECK(has(without.err, "a film.gif: films are made by ffmpeg, which is not installed"));
  CHECK(times(without.err, "\n") == 1);

  fake_ffmpeg(folder, "cat > frames\nprintf '%s\\n' \"$@\" > arguments\ncp frames \"$last\"\n");
  const std::string with = "PATH=\"$PWD/bin:$PATH\" \"$zstep\" ";
  const Outcome made = shell(folder, with + film);
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(has(made.out, "wrote a film.gif: 4 frames at 4 a second, 64x48 pixels"));
  CHECK(has(text_of(folder / "arguments"), "-video_size\n64x48\n-framerate\n4\n"));
  const std::string frames = text_of(folder / "a film.gif");
  REQUIRE(frames.size() == 4 * 64 * 48 * 3);
  // The frames are the pictures of those steps.
  REQUIRE(run(folder, "export run.ztrace --at 102 --pane frame --size-window 64x48 -o one.png").code == 0);
  const Image one = read_png(folder / "one.png");
  CHECK(std::string(one.rgb.begin(), one.rgb.end()) == frames.substr(2 * 64 * 48 * 3, 64 * 48 * 3));

  // What fails, at once or at the end, keeps the film that was there and leaves nothing beside it.
  for (const char* what : {"exit 1\n", "cat > /dev/null\necho half > \"$last\"\nexit 3\n"}) {
    fake_ffmpeg(folder, what);
    const Outcome failed = shell(folder, with + film);
    CHECK(failed.code == 2);
    CHECK(has(failed.err, "a film.gif: ffmpeg could not make it"));
    CHECK(text_of(folder / "a film.gif") == frames);
  }
  CHECK(folder.names() ==
        std::vector<std::string>{"a film.gif", "arguments", "bin", "frames", "one.png", "run.ztrace"});
  refused(folder, "export run.ztrace --fps 0 -o b.mp4", "--fps: 0 is not more than 0");
  refused(folder, "export run.ztrace --at 3 -o b.mp4", "is a film");
}
