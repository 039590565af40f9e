// Every command on real scenes: what it prints and what it writes.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "traces/image/png.hpp"
#include "traces/image/tables.hpp"
#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;
using zstep::Image;
using zstep::Npy;
using zstep::read_npy;
using zstep::read_png;

namespace {

Outcome must(const Folder& folder, const std::string& arguments) {
  const Outcome outcome = run(folder, arguments);
  CAPTURE(arguments);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(times("\n" + outcome.err, "\n") - 1 == times("\n" + outcome.err, "\nnote: "));  // and nothing else
  return outcome;
}

}  // namespace

TEST_CASE("info says which border the half-open rule keeps: that of the smaller y, wherever it is drawn") {
  const Folder folder;
  REQUIRE(run(folder, "record delhi --coverage top-left -o up.ztrace").code == 0);
  REQUIRE(run(folder, "record cube -o down.ztrace").code == 0);
  CHECK(run(folder, "info up.ztrace").out.find("ties to the left edge and to that of the smaller y, the bottom one)") !=
        std::string::npos);
  CHECK(run(folder, "info down.ztrace").out.find("ties to the left edge and to that of the smaller y, the top one)") !=
        std::string::npos);
}

TEST_CASE("list names methods, lessons and scenes") {
  const Folder folder;
  const std::string all = must(folder, "list").out;
  for (const char* name : {"z-buffer", "pyramid", "teapot", "foley", "delhi", "Catmull"}) {
    CAPTURE(name);
    CHECK(has(all, name));
  }
  const std::string methods = must(folder, "list methods").out, scenes = must(folder, "list scenes").out,
                    lessons = must(folder, "list lessons").out;
  CHECK(has(methods, "z-buffer"));
  CHECK_FALSE(has(methods, "teapot"));
  CHECK(has(scenes, "teapot"));
  CHECK_FALSE(has(scenes, "Catmull"));
  CHECK(times(lessons, "\n") >= 5);
  CHECK(has(all, methods));
  CHECK(has(all, scenes));
  CHECK(has(all, lessons));
}

TEST_CASE("render alone writes NAME.png and says so") {
  const Folder folder;
  const Outcome outcome = must(folder, "render pyramid --size 48x32");
  CHECK(has(outcome.out, "wrote pyramid.png: picture, 48x32 pixels"));
  CHECK(folder.names() == std::vector<std::string>{"pyramid.png"});
  const Image image = read_png(folder / "pyramid.png");
  CHECK(image.width == 48);
  CHECK(image.height == 32);
  std::set<std::vector<std::uint8_t>> colors;
  for (std::size_t k = 0; k < image.rgb.size(); k += 3)
    colors.insert({image.rgb[k], image.rgb[k + 1], image.rgb[k + 2]});
  CHECK(colors.size() >= 3);
}

TEST_CASE("the saved files agree with each other") {
  const Folder folder;
  must(folder,
       "render teapot --size 40x30 --save a.png --save-ids ids.npy --save-depth depth.npy --save-depth-raw raw.npy");
  CHECK(folder.names() == std::vector<std::string>{"a.png", "depth.npy", "ids.npy", "raw.npy"});
  const Image image = read_png(folder / "a.png");
  const Npy ids = read_npy(folder / "ids.npy"), depth = read_npy(folder / "depth.npy"),
            raw = read_npy(folder / "raw.npy");
  for (const Npy* table : {&ids, &depth, &raw}) {
    CHECK(table->height == 30);
    CHECK(table->width == 40);
  }
  const auto& id = std::get<std::vector<std::int32_t>>(ids.values);
  const auto& z = std::get<std::vector<float>>(depth.values);
  const auto& buffer = std::get<std::vector<double>>(raw.values);
  int seen = 0;
  for (std::size_t k = 0; k < id.size(); ++k) {
    CHECK((id[k] == -1) == std::isinf(z[k]));
    CHECK((id[k] == -1) == std::isinf(buffer[k]));
    if (id[k] == -1) continue;
    ++seen;
    CHECK(z[k] > 0);
    CHECK(buffer[k] < 1.0 + 1e-12);
  }
  CHECK(seen > 50);
  CHECK(seen < 1200);

  must(folder,
       "render teapot --size 40x30 --save b.png --enlarge 3 --depth view --save-depth view.npy --save-depth-raw "
       "view_raw.npy");
  const Image large = read_png(folder / "b.png");
  CHECK(large.width == 120);
  for (std::size_t y = 0; y < 90; ++y)
    for (std::size_t x = 0; x < 120; ++x) REQUIRE(large.rgb[(y * 120 + x) * 3] == image.rgb[(y / 3 * 40 + x / 3) * 3]);
  const auto own = std::get<std::vector<float>>(read_npy(folder / "view.npy").values);
  const auto own_raw = std::get<std::vector<double>>(read_npy(folder / "view_raw.npy").values);
  for (std::size_t k = 0; k < own.size(); ++k) CHECK(own[k] == static_cast<float>(own_raw[k]));
}

TEST_CASE("outputs put the top row first, also where a scene counts its rows from the bottom") {
  const Folder folder;
  // Foley's polygon is lowest at (7, 1): the top row first means that this pixel comes last.
  must(folder, "render foley --save-ids ids.npy");
  const Npy ids = read_npy(folder / "ids.npy");
  const auto& id = std::get<std::vector<std::int32_t>>(ids.values);
  int first = -1, last = -1;
  for (int row = 0; row < ids.height; ++row)
    for (int x = 0; x < ids.width; ++x)
      if (id[static_cast<std::size_t>(row * ids.width + x)] != -1) {
        if (first < 0) first = row;
        last = row;
      }
  REQUIRE(first >= 0);
  const auto drawn_in = [&](int row) {
    int count = 0;
    for (int x = 0; x < ids.width; ++x) count += id[static_cast<std::size_t>(row * ids.width + x)] != -1;
    return count;
  };
  // The tip at the bottom is narrow, the two horns at the top are wide.
  CHECK(ids.height - 1 - last <= 2);
  CHECK(drawn_in(last) < drawn_in((first + last) / 2));
}

TEST_CASE("record, info, dump, import: the same steps all the way round") {
  const Folder folder;
  const Outcome recorded = must(folder, "record pyramid --size 16x16 -o run.ztrace --save a.png");
  CHECK(has(recorded.out, "wrote run.ztrace: "));
  CHECK(has(recorded.out, "wrote a.png"));
  CHECK(folder.names() == std::vector<std::string>{"a.png", "run.ztrace"});
  must(folder, "render pyramid --size 16x16 --save b.png");
  CHECK(text_of(folder / "a.png") == text_of(folder / "b.png"));

  const std::string info = must(folder, "info run.ztrace").out;
  for (const char* part : {"method", "Z-buffer (z-buffer)", "16x16", "perspective", "pseudodepth", "z_buffer.compare",
                           "depth_compare", "if z < zbuffer[x,y]"}) {
    CAPTURE(part);
    CHECK(has(info, part));
  }
  const std::string dump = must(folder, "dump run.ztrace").out;
  const std::string compares = must(folder, "dump run.ztrace --step compare").out;
  CHECK(compares == must(folder, "dump run.ztrace --kind depth_compare").out);
  CHECK(compares == must(folder, "dump run.ztrace --step z_buffer.compare").out);
  CHECK(times(compares, "\n") == times(dump, "compare "));
  CHECK(times(compares, "nearer=") == times(compares, "\n"));
  const std::string count = std::to_string(times(compares, "\n"));
  CHECK(has(info, " " + count + " "));
  CHECK(times(must(folder, "dump run.ztrace --from 3 --to 7").out, "\n") == 5);
  CHECK(times(must(folder, "dump run.ztrace --from 3 --to 7 --jsonl").out, "{\"step\":") == 5);
  CHECK(times(must(folder, "dump run.ztrace --step compare --step write_pixel").out, "\n") > times(compares, "\n"));

  CHECK(shell(folder, "\"$zstep\" dump run.ztrace --jsonl > run.jsonl").code == 0);
  CHECK(times(text_of(folder / "run.jsonl"), "\n") == times(dump, "\n") + 1);
  must(folder, "import run.jsonl -o back.ztrace");
  CHECK(must(folder, "dump back.ztrace --jsonl").out == text_of(folder / "run.jsonl"));
  CHECK(must(folder, "dump run.jsonl").out == dump);
  CHECK(shell(folder, "\"$zstep\" dump run.ztrace --jsonl | \"$zstep\" import - -o pipe.ztrace").code == 0);
  CHECK(must(folder, "dump pipe.ztrace").out == dump);
}

TEST_CASE("the default names of outputs come from the scene") {
  const Folder folder;
  write_text(folder / "my triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  must(folder, "render 'my triangle.obj' --size 8x8 --no-cull");
  must(folder, "record 'my triangle.obj' --size 8x8 --no-cull");
  CHECK(folder.names() == std::vector<std::string>{"my triangle.obj", "my-triangle.png", "my-triangle.ztrace"});
}

TEST_CASE("options change what they say they change") {
  const Folder folder;
  must(folder, "render teapot --size 64x48 --save plain.png");
  const std::string plain = text_of(folder / "plain.png");
  const auto differs = [&](const std::string& option) {
    CAPTURE(option);
    must(folder, "render teapot --size 64x48 --save other.png " + option);
    CHECK(text_of(folder / "other.png") != plain);
  };
  for (const std::string option : {"--rho 9", "--theta 100", "--phi 20", "--d 3", "--window 2", "--ortho", "--fit"})
    differs(option);
  // Only where an edge goes through a pixel's centre can the two rules of coverage differ.
  must(folder, "render foley --save top-left.png --coverage top-left");
  must(folder, "render foley --save inclusive.png --coverage inclusive");
  CHECK(text_of(folder / "top-left.png") != text_of(folder / "inclusive.png"));
  const auto states = [&](const std::string& option, const std::string& stated) {
    CAPTURE(option);
    must(folder, "record pyramid --size 8x8 -o o.ztrace " + option);
    CHECK(has(must(folder, "info o.ztrace").out, stated));
  };
  states("--depth view", "view (z_v)");
  states("--interpolation increments", "increments");
  states("--coverage inclusive", "inclusive");
  states("--no-cull", "drawn");
  states("--ortho", "orthographic");
  states("--near 2 --far 9", "near 2, far 9");
  states("--algorithm z-buffer", "Z-buffer");
}

TEST_CASE("dump refuses what the trace does not have") {
  const Folder folder;
  must(folder, "record pyramid --size 8x8 -o run.ztrace");
  const auto refused = [&](const std::string& options, const std::string& part) {
    CAPTURE(options);
    const Outcome outcome = run(folder, "dump run.ztrace " + options);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, part));
    CHECK(times(outcome.err, "\n") == 1);
  };
  refused("--kind depth_compar", "did you mean depth_compare?");
  refused("--step comprae", "did you mean compare?");
  refused("--from 9 --to 4", "--from");
  refused("--from 99999999", "ends at step");
  refused("--from 0", "--from: '0'");
  if (std::filesystem::exists("/dev/full")) {
    for (const std::string command : {"dump run.ztrace", "info run.ztrace", "list", "history run.ztrace 3 3",
                                      "explain run.ztrace 3 3", "why-not run.ztrace 0", "find run.ztrace 'not nearer'",
                                      "query run.ztrace 'select * from depth_compare'", "query run.ztrace"}) {
      CAPTURE(command);
      const Outcome full = shell(folder, "\"$zstep\" " + command + " > /dev/full");
      CHECK(full.code == 4);
      CHECK(full.err == "standard output: cannot be written; make room on the disk\n");
    }
  }
}

TEST_CASE("no answer of a query reaches the terminal raw, and JSON gives it back as it was") {
  const Folder folder;
  must(folder, "record delhi -o run.ztrace");
  const std::string question = "'select char(97, 127, 133, 155, 27, 8238, 228) as \"n\u009b\" from buffers_clear'";
  CHECK(must(folder, "query run.ztrace --json " + question).out ==
        "[\n{\"n\\u009b\":\"a\\u007f\\u0085\\u009b\\u001b\\u202e\u00e4\"}\n]\n");
  CHECK(must(folder, "query run.ztrace --csv " + question).out == "n\\u009b\na\\x7f\\u0085\\u009b\\x1b\\u202e\u00e4\n");
}

TEST_CASE("explain takes a step, a part of the trace or a bookmark, and refuses what is none of them") {
  const Folder folder;
  must(folder, "record delhi -o run.ztrace");
  const std::string by_step = must(folder, "explain run.ztrace --at 126").out;
  CHECK(has(by_step, "STEP"));
  CHECK(must(folder, "explain run.ztrace --at 50%").out == by_step);  // of 252
  std::ofstream(folder / "run.ztrace.marks") << "126 here\n";
  CHECK(must(folder, "explain run.ztrace --at here").out == by_step);
  for (const std::string at : {"there", "253", "0", "150%"}) {
    CAPTURE(at);
    const Outcome refused = run(folder, "explain run.ztrace --at " + at);
    CHECK(refused.code == 2);
    CHECK(refused.err.rfind("--at: ", 0) == 0);
  }
}

TEST_CASE("a step can be copied from one answer into the next question, and too many words are refused in words") {
  const Folder folder;
  must(folder, "record pyramid-behind -o run.ztrace");
  const std::string history = must(folder, "history run.ztrace 15 12").out;
  const std::size_t space = history.find("\u00a0");  // the first step beyond 999
  REQUIRE(space != std::string::npos);
  const std::size_t begin = history.find_last_of(" \n", space) + 1;
  const std::string step = history.substr(begin, history.find_first_of(" \n", begin) - begin);
  CAPTURE(step);
  std::string plain = step;
  for (std::size_t at = plain.find("\u00a0"); at != std::string::npos; at = plain.find("\u00a0")) plain.erase(at, 2);
  CHECK(must(folder, "explain run.ztrace --at " + step).out == must(folder, "explain run.ztrace --at " + plain).out);
  const Outcome refused = run(folder, "explain run.ztrace 15 12 z");
  CHECK(refused.code == 2);
  CHECK(has(refused.err,
            "zstep explain: asks about one pixel or one field, not about '15 12 z'; give X Y, or --at STEP FIELD"));
}

TEST_CASE("a trace in a scene's place, and a scene in a trace's, are told apart") {
  const Folder folder;
  must(folder, "record foley -o run.ztrace");
  for (const std::string arguments : {"render run.ztrace", "record run.ztrace -o other.ztrace"}) {
    const Outcome outcome = run(folder, arguments);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, "run.ztrace: is a recorded trace, not a scene; to open it: zstep view run.ztrace"));
  }
  write_text(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome outcome = run(folder, "info a.obj");
  CHECK(outcome.code == 2);
  CHECK(times(outcome.err, "\n") == 1);
  CHECK(has(outcome.err, "a.obj"));
  CHECK(folder.names() == std::vector<std::string>{"a.obj", "run.ztrace"});
}

TEST_CASE("bad JSON Lines leave nothing behind") {
  const Folder folder;
  must(folder, "record foley -o run.ztrace");
  shell(folder, "\"$zstep\" dump run.ztrace --jsonl > run.jsonl");
  std::string text = text_of(folder / "run.jsonl");
  text += "{\"step\":\"compare\",\"x\":1}\n";
  write_text(folder / "bad.jsonl", text);
  const Outcome outcome = run(folder, "import bad.jsonl -o bad.ztrace");
  CHECK(outcome.code == 2);
  CHECK(has(outcome.err, "bad.jsonl:" + std::to_string(times(text, "\n"))));
  CHECK(folder.names() == std::vector<std::string>{"bad.jsonl", "run.jsonl", "run.ztrace"});
}

TEST_CASE("a trace that is cut off or damaged is opened as far as it goes, or refused in one line") {
  const Folder folder;
  must(folder, "record pyramid --size 16x16 -o run.ztrace");
  const std::string whole = text_of(folder / "run.ztrace");
  for (std::size_t size = 0; size < whole.size(); size += whole.size() / 16 + 1) {
    CAPTURE(size);
    write_text(folder / "cut.ztrace", whole.substr(0, size));
    const Outcome outcome = run(folder, "info cut.ztrace");
    CHECK((outcome.code == 3 || outcome.code == 2));
    CHECK(times(outcome.err, "\n") == 1);
    CHECK(times(outcome.err, "cut.ztrace") == 1);
  }
}

TEST_CASE("what there is to know about a mesh is noted") {
  const Folder folder;
  write_text(folder / "open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 2\n");
  for (const char* command : {"render open.obj", "record open.obj", "view open.obj --screenshot open.png"}) {
    CAPTURE(command);
    const Outcome outcome = run(folder, command);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(has(outcome.err, "note: "));
    CHECK(has(outcome.err, "not drawn, having fewer than three different corners"));
    CHECK(times(outcome.err, "\n") == times(outcome.err, "note: "));
  }
}

TEST_CASE("why-not says why, and what may be typed") {
  const Folder folder;
  must(folder, "record pyramid-behind -o run.ztrace");
  const std::string lost = must(folder, "why-not run.ztrace F 15 12").out;
  CHECK(has(lost, "F is not seen at pixel (15, 12)"));
  CHECK(has(lost, "until D was found to be nearer"));
  CHECK(must(folder, "why-not run.ztrace 0 15 12").out == lost);
  CHECK(must(folder, "why-not run.ztrace P0 15 12").out == lost);
  CHECK(has(must(folder, "why-not run.ztrace D 15 12").out, "D is what is seen at pixel (15, 12)"));
  CHECK(has(must(folder, "why-not run.ztrace B").out, "(p \u2212 e)\u00b7n"));
  std::string scene = text_of(in_checkout("tests/golden/no-area.toml"));
  scene.replace(scene.find("name = \"A\""), 10, "name = \"floor\"");
  write_text(folder / "named.toml", scene);
  must(folder, "record named.toml -o named.ztrace");
  for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
           {"run.ztrace roof",
            "roof: is no polygon of this trace; its polygons are numbered from 0 to 6, the first is called F"},
           {"run.ztrace 7", "7: is no polygon of this trace"},
           {"run.ztrace F 15",
            "Y: is missing: a pixel has a column and a row; write for example zstep why-not run.ztrace B 15 12"},
           {"run.ztrace F 32 0", "32 0: is no pixel: the picture has 32 by 32"},
           {"run.ztrace F -1 0", "-1"},
           {"named.ztrace flor", "flor: is no polygon of this trace; did you mean floor?"},
           {"none.ztrace F", "none.ztrace"}}) {
    const std::string given = arguments;
    CAPTURE(given);
    const Outcome outcome = run(folder, "why-not " + arguments);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(has(outcome.err, said));
  }
}
