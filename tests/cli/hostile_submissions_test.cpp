// Submissions that are made to break, to fool or to leave the grader: each ends in a result that every format's reader
// takes, earns no more than its honest part, and touches nothing outside its folder.
#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/hostile_homework.hpp"

using namespace zstep::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// What a submission may earn at most.
enum class Earns {
  nothing,
  half,     ///< what the first half of the right run earns
  less,     ///< less than the right run
  noted,    ///< as the right run, as it has all of that and a line too many: a line that cannot be read costs itself
            ///< alone; but it is named, and not all is right
  as_much,  ///< as the right run: the attack is beside it
};

struct Case {
  std::string name;
  Earns earns = Earns::nothing;
  std::function<void(const Folder&)> hand_in;
};

std::string repeated(const std::string& part, std::size_t times) {
  std::string all;
  all.reserve(part.size() * times);
  for (std::size_t k = 0; k < times; ++k) all += part;
  return all;
}

Case of_text(const std::string& name, Earns earns, const std::function<std::string(const std::string& right)>& text) {
  return {name, earns,
          [text](const Folder& folder) { write_text(folder / "runs/triangle.jsonl", text(right_run(folder))); }};
}
Case of_lines(const std::string& name, const std::string& text) {
  return of_text(name, Earns::nothing, [text](const std::string&) { return text; });
}
/// The right run up to half, then the text, then the rest.
Case amid(const std::string& name, const std::string& text, Earns earns = Earns::as_much) {
  return of_text(name, earns, [text](const std::string& right) {
    const std::size_t half = right.find('\n', right.size() / 2) + 1;
    return right.substr(0, half) + text + "\n" + right.substr(half);
  });
}
Case of_shell(const std::string& name, Earns earns, const std::string& line) {
  return {name, earns, [line](const Folder& folder) {
            const Outcome outcome = shell(folder, line);
            CAPTURE(outcome.err);
            REQUIRE(outcome.code == 0);
          }};
}

const std::string png_of_4_gigapixels("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\xff\xff\0\0\xff\xff\0\0\x08\x02\0\0\0\0\0\0\0",
                                      33);

std::vector<Case> hostile_files() {
  using enum Earns;
  const std::string escapes = "\\u001b[2J\\u001b]0;owned\\u0007<script>alert(1)</script>&\\\"'\\u202e]]>";
  return {
      of_lines("empty", ""),
      of_lines("one line end", "\n"),
      of_lines("a million blanks", std::string(1'000'000, ' ')),
      of_lines("zero bytes", std::string(5000, '\0')),
      of_lines("a program", std::string("\x7f\x45\x4c\x46\x02\x01\x01\0\0\0\xff\xfe", 12)),
      of_lines("a picture", png_of_4_gigapixels),
      of_lines("UTF-16", std::string("\xff\xfe{\0\"\0s\0t\0e\0p\0\"\0", 16)),
      of_shell("10 GB of nothing", nothing, "truncate -s 10G runs/triangle.jsonl"),
      of_shell("500 MB of nothing", nothing, "truncate -s 500M runs/triangle.jsonl"),
      of_shell("compressed zeros", nothing, "head -c 50000000 /dev/zero | gzip > runs/triangle.jsonl"),
      of_shell("compressed zeros by another name", nothing,
               "head -c 5000000 /dev/zero | gzip > runs/triangle.jsonl.gz"),
      of_lines("an endless line", "{\"step\":\"" + std::string(40'000'000, 'a')),
      of_lines("an endless number", "{\"step\":\"clear\",\"z\":" + std::string(20'000'000, '9')),
      of_lines("nesting of lists", std::string(1'000'000, '[')),
      of_lines("nesting of objects", repeated("{\"a\":", 1'000'000)),
      amid("nesting in a field", "{\"step\":\"clear\",\"z\":" + std::string(1'000'000, '['), noted),
      of_lines("an object that says nothing", repeated("{}\n", 1000)),
      of_lines("lines of other JSON", "null\n[]\n1\n\"step\"\ntrue\n"),
      of_text("NaN for every depth", less,
              [](const std::string& right) { return with_changed(right, "\"z\":0", "\"z\":\"nan\",\"w\":0"); }),
      of_text("infinity for every depth", less,
              [](const std::string& right) { return with_changed(right, "\"z\":0", "\"z\":\"inf\",\"w\":0"); }),
      amid("NaN that is no JSON", "{\"step\":\"clear\",\"z\":NaN}", noted),
      amid("a number beyond all", "{\"step\":\"clear\",\"z\":1e999}", noted),
      amid("a number of 100000 digits", "{\"step\":\"clear\",\"z\":0." + std::string(100'000, '3') + "}", less),
      amid("a whole number of 100000 digits",
           "{\"step\":\"write_depth\",\"x\":" + std::string(100'000, '1') + ",\"y\":1,\"z\":1}", noted),
      amid("a tiny number of 100000 digits", "{\"step\":\"clear\",\"z\":0." + std::string(100'000, '0') + "1}", less),
      of_text("every key twice, the second one right", less,
              [](const std::string& right) { return with_changed(right, "\"z\":0", "\"z\":7,\"z\":0"); }),
      of_text("the step twice", less,
              [](const std::string& right) {
                return with_changed(right, "{\"step\":\"compare\"", "{\"step\":\"clear\",\"step\":\"compare\"");
              }),
      of_text("keys missing", less,
              [](const std::string& right) { return with_changed(right, ",\"nearer\":true", ""); }),
      of_text("no step", less, [](const std::string& right) { return with_changed(right, "\"step\":\"span\",", ""); }),
      of_text("text for numbers", less,
              [](const std::string& right) { return with_changed(right, "\"nearer\":true", "\"nearer\":\"true\""); }),
      of_text("numbers for words", less,
              [](const std::string& right) { return with_changed(right, "\"nearer\":true", "\"nearer\":1"); }),
      amid("half a pixel", "{\"step\":\"write_depth\",\"x\":1.5,\"y\":1,\"z\":1}", noted),
      amid("null", "{\"step\":\"write_depth\",\"x\":null,\"y\":1,\"z\":1}", noted),
      amid("no UTF-8", "{\"step\":\"\xff\xfe\xc0\xaf\"}", noted),
      amid("half a surrogate", "{\"step\":\"\\ud800\"}", noted),
      amid("a pixel outside", "{\"step\":\"write_depth\",\"x\":99999999,\"y\":1,\"z\":1}", less),
      amid("a pixel before the first", "{\"step\":\"write_depth\",\"x\":-1,\"y\":-1,\"z\":1}", less),
      amid("a pixel beyond 64 bits", "{\"step\":\"write_depth\",\"x\":9223372036854775808,\"y\":1,\"z\":1}", noted),
      amid("an edge of a great number",
           "{\"step\":\"retire_edge\",\"edge\":2147483647}\n{\"step\":\"step_edge\",\"edge\":2147483647,\"x_edge\":1,"
           "\"z_edge\":1}",
           less),
      amid("a polygon that is none", "{\"step\":\"polygon\",\"polygon\":-5,\"facet\":2147483647}", less),
      amid("vertices that are none", "{\"step\":\"skip_edge\",\"vertex_0\":99999,\"vertex_1\":-7,\"why\":\"outside\"}",
           less),
      amid("points that it gives itself",
           "{\"step\":\"score\",\"score\":100,\"points\":65,\"gradable\":true,\"tests\":[{\"score\":100}]}", noted),
      of_text("points in every line", as_much,
              [](const std::string& right) {
                return with_changed(right, "{\"step\"", "{\"score\":100,\"max_score\":1,\"points\":65,\"step\"");
              }),
      of_text("a friendlier scene", nothing,
              [](const std::string&) {
                return std::string(
                    "{\"ztrace\":1,\"method\":\"z-buffer\",\"scene\":{\"raster\":{\"width\":1,\"height\":1},"
                    "\"points\":[],\"polygons\":[]}}\n");
              }),
      of_text("another number format", as_much,
              [](const std::string& right) {
                return "{\"ztrace\":1,\"conventions\":{\"number_format\":\"fixed16\"}}\n" + right;
              }),
      of_text("other conventions, with a run by them", less,
              [](const std::string& right) {
                std::string flipped = with_changed(right, "\"nearer\":true", "\"nearer\":yes");
                flipped = with_changed(flipped, "\"nearer\":yes", "\"nearer\":false");
                return "{\"ztrace\":1,\"conventions\":{\"nearer\":\"greater\",\"coverage\":\"inclusive\"}}\n" + flipped;
              }),
      of_text("another method", as_much,
              [](const std::string& right) { return "{\"ztrace\":1,\"method\":\"painter\"}\n" + right; }),
      // The names of the method stay.
      of_text("a table of steps that is none", noted,
              [](const std::string& right) {
                return "{\"ztrace\":1,\"steps\":[{\"name\":\"compare\",\"kind\":\"pixel_write\"}]}\n" + right;
              }),
      of_text("steps under other names", less,
              [](const std::string& right) {
                return "{\"ztrace\":1,\"steps\":[{\"id\":1,\"name\":\"compare\",\"event\":\"depth_compare\"},"
                       "{\"id\":2,\"name\":\"write_pixel\",\"event\":\"depth_write\"}]}\n" +
                       right;
              }),
      {"the right run of another scene", less,
       [](const Folder& folder) { write_text(folder / "runs/triangle.jsonl", right_run(folder, "crossing")); }},
      {"the reference of another scene, with its header", less,
       [](const Folder& folder) { fs::copy_file(folder / "crossing.right", folder / "runs/triangle.jsonl"); }},
      of_text("the right run a hundred times", less, [](const std::string& right) { return repeated(right, 100); }),
      of_text("one compare a hundred thousand times", less,
              [](const std::string& right) {
                const std::size_t at = right.find("{\"step\":\"compare\"");
                const std::string line = right.substr(at, right.find('\n', at) + 1 - at);
                return right.substr(0, at) + repeated(line, 100'000) + right.substr(at);
              }),
      of_text("the last line first", less,
              [](const std::string& right) {
                std::istringstream in(right);
                std::vector<std::string> lines;
                for (std::string line; std::getline(in, line);) lines.push_back(line);
                std::string all;
                for (auto line = lines.rbegin(); line != lines.rend(); ++line) all += *line + "\n";
                return all;
              }),
      of_text("cut off in a line", half, [](const std::string& right) { return right.substr(0, right.size() / 2); }),
      of_text("said to be cut off", half,
              [](const std::string& right) { return right.substr(0, right.size() / 2) + "\n{\"cut_off\":true}\n"; }),
      amid("escapes and HTML in a step's name", "{\"step\":\"" + escapes + "\"}", noted),
      amid("escapes and HTML in a key", "{\"step\":\"clear\",\"z\":\"inf\",\"" + escapes + "\":1}", as_much),
      amid("escapes and HTML in a word",
           "{\"step\":\"skip_edge\",\"vertex_0\":0,\"vertex_1\":1,\"why\":\"" + escapes + "\"}", noted),
      amid("a word of 10 MB",
           "{\"step\":\"skip_edge\",\"vertex_0\":0,\"vertex_1\":1,\"why\":\"" + std::string(10'000'000, 'w') + "\"}",
           noted),
      of_text("escapes and HTML in the header", as_much,
              [escapes](const std::string& right) {
                return "{\"ztrace\":1,\"writer\":\"" + escapes + "\",\"comment\":\"" + escapes + "\"}\n" + right;
              }),
      {"results written in advance", as_much,
       [](const Folder& folder) {
         write_text(folder / "runs/triangle.jsonl", right_run(folder));
         for (const char* name : {"results.json", "runs.json", "gradebook.csv", "triangle.xml"})
           write_text(folder / "runs" / name, "{\"score\":1000,\"tests\":[]}");
         write_text(folder / "runs/triangle.ended.txt",
                    "\x1b[31mAll is right: 1000 points <b>\n" + std::string(1 << 20, 'x'));
       }},
      of_shell("a link to the homework", nothing, "ln -s ../hw/homework.toml runs/triangle.jsonl"),
      of_shell("a link to a hidden scene", nothing, "ln -s ../hw/hidden/overlap.toml runs/triangle.jsonl"),
      of_shell("a link to the right run", nothing, "ln -s ../triangle.right runs/triangle.jsonl"),
      of_shell("a link to itself", nothing, "ln -s triangle.jsonl runs/triangle.jsonl"),
      of_shell("a link to a device without end", nothing, "ln -s /dev/zero runs/triangle.jsonl"),
      of_shell("a pipe that nobody writes to", nothing, "mkfifo runs/triangle.jsonl"),
      of_shell("a folder", nothing, "mkdir -p runs/triangle.jsonl/triangle.jsonl"),
      of_shell("a name that leads elsewhere", nothing, "cp triangle.right 'runs/..triangle.jsonl'"),
      of_shell("a picture of 4 gigapixels", nothing, "cp gigapixels runs/triangle.png"),
      of_shell("an array that is larger than the world", nothing,
               "printf '\\223NUMPY\\001\\000\\166\\000%-117s\\n' \"{'descr': '<f8', 'fortran_order': False, 'shape': "
               "(1000000000, 1000000000), }\" > runs/triangle.npy"),
      of_shell(
          "an array of Python's objects", nothing,
          "printf '\\223NUMPY\\001\\000\\166\\000%-117s\\ncos\\nsystem\\n' \"{'descr': '|O', 'fortran_order': False, "
          "'shape': (10, 12), }\" > runs/triangle.npy"),
  };
}

}  // namespace

TEST_CASE("hostile submissions: files earn nothing, end in a result in every format, and touch nothing else") {
  const Folder folder;
  hostile_homework(folder);
  write_text(folder / "gigapixels", png_of_4_gigapixels);
  const auto points_of = [&](const std::string& text) {
    fs::remove_all(folder / "runs");
    fs::create_directory(folder / "runs");
    write_text(folder / "runs/triangle.jsonl", text);
    return grade_in_every_format(folder);
  };
  const std::string right = right_run(folder);
  const double all = points_of(right), half = points_of(right.substr(0, right.rfind('\n', right.size() / 2) + 1));
  REQUIRE(all > half);
  REQUIRE(half > 0);
  const std::string before = everything_in(folder);
  const std::vector<Case> cases = hostile_files();
  CHECK(cases.size() >= 60);
  for (const Case& one : cases) {
    CAPTURE(one.name);
    fs::remove_all(folder / "runs");
    fs::create_directory(folder / "runs");
    one.hand_in(folder);
    const double points = grade_in_every_format(folder);
    CAPTURE(points);
    switch (one.earns) {
      case Earns::nothing:
        CHECK(points == 0);
        break;
      case Earns::half:
        CHECK(points <= half + 1e-9);
        break;
      case Earns::less:
        CHECK(points < all - 1e-9);
        break;
      case Earns::noted: {
        CHECK(points == doctest::Approx(all));
        const Outcome outcome = run(folder, "grade --homework hw runs --scene triangle --format json");
        CHECK(outcome.code == 1);
        CHECK(json::parse(outcome.out)["scenes"][0]["unreadable"]["lines"].get<int>() >= 1);
        const std::string text = run(folder, "grade --homework hw runs --scene triangle").out;
        CHECK(has(text, "points\n\nruns/triangle.jsonl:"));
        CHECK_FALSE(has(text, "Every step is right."));
        break;
      }
      case Earns::as_much:
        CHECK(points <= all + 1e-9);
        break;
    }
    CHECK(everything_in(folder) == before);
  }
}

TEST_CASE("hostile submissions: what a link leads to is not handed in") {
  const Folder folder;
  hostile_homework(folder);
  write_text(folder / "gigapixels", png_of_4_gigapixels);
  for (const char* name : {"triangle.jsonl", "triangle.png", "triangle.npy", "triangle.depth.npy", "triangle.pfm"}) {
    fs::remove_all(folder / "runs");
    fs::create_directory(folder / "runs");
    fs::create_symlink("../gigapixels", folder / "runs" / name);
    const Outcome outcome = run(folder, "grade --homework hw runs --format json");
    CAPTURE(name);
    CAPTURE(outcome.out);
    CHECK(outcome.code == 2);
    CHECK(times(outcome.out, "\"state\": \"missing\"") == 2);
  }
}

TEST_CASE("hostile submissions: what a hidden scene's run holds is quoted in no report for students") {
  const Folder folder;
  hostile_homework(folder);
  for (const std::string line :
       {"the scene is SECRET", "{\"step\":\"SECRET\"}", "{\"step\":\"clear\",\"z\":\"SECRET\"}",
        "{\"step\":\"write_depth\",\"x\":99999,\"y\":1,\"z\":1,\"SECRET\":1}"}) {
    for (const bool late : {false, true}) {
      fs::remove_all(folder / "runs");
      fs::create_directory(folder / "runs");
      write_text(folder / "runs/overlap.jsonl", (late ? right_run(folder, "overlap") : "") + line + "\n");
      for (const std::string format : {"text", "gradescope", "prairielearn", "junit"}) {
        const Outcome outcome = run(folder, "grade --homework hw runs --format " + format);
        CAPTURE(line);
        CAPTURE(outcome.out);
        CHECK_FALSE(has(outcome.out, "SECRET"));
      }
    }
  }
}
