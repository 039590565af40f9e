// zstep homework and zstep grade, as a course uses them.
#include <doctest/doctest.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/cli/result_rules.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

bool there_is(const char* program) {
  return std::system((std::string(program) + " --version >/dev/null 2>&1").c_str()) == 0;
}
bool in(const Folder& folder, const std::string& command) {
  return std::system(("cd '" + folder.path().string() + "' && " + command).c_str()) == 0;
}
/// A folder hw with the homework, and in runs/ what its solution prints.
void set_up(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  REQUIRE(in(folder, "mkdir runs"));
  for (const char* scene : {"scenes/triangle", "scenes/crossing", "scenes/neighbours", "hidden/overlap"})
    REQUIRE(in(folder, std::string("python3 hw/solution/zbuffer.py hw/") + scene + ".txt > runs/$(basename " + scene +
                           ").jsonl"));
}

}  // namespace

TEST_CASE("homework: a new folder has all that it needs, and nothing is written over") {
  const Folder folder;
  const Outcome made = run(folder, "homework new z-buffer hw");
  CHECK(made.code == 0);
  for (const char* file :
       {"hw/homework.toml", "hw/handout.md", "hw/scenes/triangle.txt", "hw/starter/emit.py", "hw/starter/emit.h",
        "hw/starter/emit.js", "hw/starter/Emit.java", "hw/solution/zbuffer.py"}) {
    CAPTURE(file);
    CHECK(has(made.out, file));
    CHECK_FALSE(text_of(folder / file).empty());
  }
  const Outcome again = run(folder, "homework new z-buffer hw");
  CHECK(again.code == 2);
  CHECK(has(again.err, "hw: is there already; give the name of a new folder"));
  const Outcome other = run(folder, "homework new z-bufer other");
  CHECK(other.code == 2);
  CHECK(has(other.err, "z-buffer"));
  CHECK(folder.names() == std::vector<std::string>{"hw"});
}

TEST_CASE("homework: the files that write steps compile and print lines that zstep reads") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  for (const char* file : {"hw/starter/emit.h", "hw/starter/emit.py", "hw/starter/emit.js", "hw/starter/Emit.java"}) {
    CAPTURE(file);
    const std::string text = text_of(folder / file);
    CHECK(times(text, "\n") <= 80);
  }
  write_text(folder / "main.c",
             "#include \"hw/starter/emit.h\"\n"
             "int main(void) { emit_clear(INFINITY); emit_skip_edge(0, 1, \"horizontal\");\n"
             "  emit_compare(3, 2, 0.1, 1); return 0; }\n");
  const std::string expected =
      "{\"step\":\"clear\",\"z\":\"inf\",\"at\":\"main.c:2\"}\n"
      "{\"step\":\"skip_edge\",\"vertex_0\":0,\"vertex_1\":1,\"why\":\"horizontal\",\"at\":\"main.c:2\"}\n"
      "{\"step\":\"compare\",\"x\":3,\"y\":2,\"z\":0.10000000000000001,\"nearer\":true,\"at\":\"main.c:3\"}\n";
  if (there_is("cc")) {
    REQUIRE(in(folder, "cc -std=c99 -Wall -Wextra -Wpedantic -Werror -o emits main.c -lm && ./emits > c.txt"));
    CHECK(text_of(folder / "c.txt") == expected);
  }
  if (there_is("c++")) {
    REQUIRE(in(folder, "c++ -x c++ -std=c++17 -Wall -Wextra -Werror -o emits main.c && ./emits > cpp.txt"));
    CHECK(text_of(folder / "cpp.txt") == expected);
    CHECK(in(folder,
             "c++ -std=c++17 -Wall -o starter hw/starter/zbuffer.cpp && ./starter hw/scenes/triangle.txt > s.txt"));
    CHECK(has(text_of(folder / "s.txt"), "\"step\":\"polygon\""));
  }
  const auto same_lines = [&](const char* printed, const std::string& program,
                              int first) {  // numbers may be written in fewer digits
    int number = first;
    std::istringstream wanted(expected), found(text_of(folder / printed));
    std::string line, other;
    while (std::getline(wanted, line)) {
      REQUIRE(std::getline(found, other));
      json same = json::parse(line);
      same["at"] = program + ":" + std::to_string(number++);
      CHECK(same == json::parse(other));
    }
    CHECK_FALSE(std::getline(found, other));
  };
  if (there_is("python3")) {
    write_text(folder / "hw/starter/main.py",
               "import emit, math\nemit.clear(math.inf)\nemit.skip_edge(0, 1, 'horizontal')\n"
               "emit.compare(3, 2, 0.1, True)\n");
    REQUIRE(in(folder, "python3 hw/starter/main.py > py.txt"));
    same_lines("py.txt", "hw/starter/main.py", 2);
  }
  if (there_is("javac")) {
    write_text(folder / "hw/starter/Main.java",
               "final class Main {\n  public static void main(String[] arguments) {\n"
               "    Emit.clear(Double.POSITIVE_INFINITY);\n    Emit.skipEdge(0, 1, \"horizontal\");\n"
               "    Emit.compare(3, 2, 0.1, true);\n  }\n}\n");
    REQUIRE(in(folder, "cd hw/starter && javac -Xlint:all -Werror Main.java Emit.java && java Main > ../../java.txt"));
    same_lines("java.txt", "Main.java", 3);
  }
  if (there_is("node")) {
    write_text(folder / "hw/starter/main.js",
               "const emit = require('./emit.js');\nemit.clear(Infinity);\nemit.skip_edge(0, 1, 'horizontal');\n"
               "emit.compare(3, 2, 0.1, true);\n");
    REQUIRE(in(folder, "node hw/starter/main.js > lines.txt"));
    same_lines("lines.txt", "hw/starter/main.js", 2);
    CHECK(in(folder, "node hw/starter/zbuffer.js hw/scenes/triangle.txt > js.txt"));
    CHECK(has(text_of(folder / "js.txt"), "\"step\":\"polygon\""));
  }
}

TEST_CASE("grade: the solution gets all points, in every format") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  const Outcome text = run(folder, "grade --homework hw runs");
  CAPTURE(text.out);
  CAPTURE(text.err);
  CHECK(text.code == 0);
  CHECK(has(text.out, "65 of 65 points"));
  CHECK(has(text.out, "Every step is right."));
  for (const std::string format : {"json", "gradescope", "prairielearn", "junit", "html"})
    check_result(format, run(folder, "grade --homework hw runs --format " + format).out);

  const json all = json::parse(run(folder, "grade --homework hw runs --format json").out);
  CHECK(all["points"] == doctest::Approx(65));
  CHECK(all["scenes"].size() == 4);
  const json gradescope = json::parse(run(folder, "grade --homework hw runs --format gradescope").out);
  double sum = 0, most = 0;
  for (const json& test : gradescope["tests"])
    sum += test["score"].get<double>(), most += test["max_score"].get<double>();
  CHECK(sum == doctest::Approx(65));
  CHECK(most == doctest::Approx(65));
  CHECK(gradescope["tests"].size() == 24);
  const json prairielearn = json::parse(run(folder, "grade --homework hw runs --format prairielearn").out);
  CHECK(prairielearn["gradable"] == true);
  CHECK(prairielearn["score"] == doctest::Approx(1));
  const Outcome junit = run(folder, "grade --homework hw runs --format junit -o junit.xml");
  CHECK(junit.code == 0);
  CHECK(has(text_of(folder / "junit.xml"), "tests=\"24\" failures=\"0\" errors=\"0\""));
}

TEST_CASE("grade: one wrong line of the program is named with both numbers, and costs once") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  std::string program = text_of(folder / "hw/solution/zbuffer.py");
  const std::string right = "nearer = z < depth[y][x]", wrong = "nearer = z > depth[y][x]";
  REQUIRE(has(program, right));
  program.replace(program.find(right), right.size(), wrong);
  write_text(folder / "hw/solution/wrong.py", program);
  REQUIRE(in(folder, "python3 hw/solution/wrong.py hw/scenes/triangle.txt > triangle.jsonl"));
  const Outcome outcome = run(folder, "grade --homework hw triangle.jsonl --scene triangle");
  CAPTURE(outcome.out);
  CHECK(outcome.code == 1);
  CHECK(has(outcome.out, "The first thing to look at, in triangle, triangle.jsonl:11, printed at "));
  CHECK(has(outcome.out, "compare, pixel (2, 2)"));
  CHECK(has(outcome.out, "expected  nearer = true"));
  CHECK(has(outcome.out, "yours     nearer = false"));
  CHECK(has(outcome.out, "grade --homework hw triangle.jsonl --scene triangle --view"));
  const Outcome shown = run(folder, "grade --homework hw triangle.jsonl --scene triangle --view --screenshot both.png");
  CHECK(shown.code == 1);
  CHECK(text_of(folder / "both.png").substr(1, 3) == "PNG");
}

TEST_CASE("grade: the grader's scene and conventions hold, not what a submission says of them") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  const std::string lines = text_of(folder / "runs/crossing.jsonl");
  const Outcome plain = run(folder, "grade --homework hw runs/crossing.jsonl");
  REQUIRE(plain.code == 0);
  // Another scene, and a depth that is nearer where it is greater: nobody asked.
  write_text(folder / "crossing.jsonl",
             "{\"ztrace\":1,\"conventions\":{\"nearer\":\"greater\",\"coverage\":\"inclusive\"},\"scene\":{\"raster\":"
             "{\"width\":2,\"height\":2}}}\n" +
                 lines);
  const Outcome forged = run(folder, "grade --homework hw crossing.jsonl");
  CAPTURE(forged.out);
  CHECK(forged.code == 0);
  const std::string after_name = plain.out.substr(plain.out.find('\n'));
  CHECK(forged.out.substr(forged.out.find('\n')) == after_name);
  // What the homework leaves free is taken from the header.
  write_text(folder / "crossing.jsonl", "{\"ztrace\":1,\"conventions\":{\"interpolation\":\"increments\"}}\n" + lines);
  CHECK(run(folder, "grade --homework hw crossing.jsonl").code != 2);
}

TEST_CASE("grade: what cannot be graded says so and why, and is told apart from what is wrong") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  const std::string lines = text_of(folder / "runs/crossing.jsonl");
  const auto graded = [&](const std::string& text, const std::string& format = "text") {
    write_text(folder / "crossing.jsonl", text);
    return run(folder, "grade --homework hw crossing.jsonl --scene crossing --format " + format);
  };
  for (const std::string& text : {std::string(), std::string("hello\n"), std::string("{}\n"), std::string("\0\1\2", 3),
                                  std::string("{\"step\":\"no such step\"}\n"), std::string(100000, '[')}) {
    const Outcome outcome = graded(text);
    CAPTURE(text.substr(0, 40));
    CAPTURE(outcome.out);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.out, "This cannot be graded:\n  crossing.jsonl"));
    const json result = json::parse(graded(text, "prairielearn").out);
    CHECK(result["gradable"] == false);
    CHECK_FALSE(result.contains("score"));
    CHECK_FALSE(result["format_errors"].empty());
  }
  // A program that crashed is graded up to its last whole line, and it says so.
  const std::string half = lines.substr(0, lines.size() / 2) + "\nTraceback (most recent call last):\n";
  const Outcome crashed = graded(half);
  CAPTURE(crashed.out);
  CHECK(crashed.code == 1);
  CHECK(has(crashed.out, "was cut off here"));
  CHECK(has(crashed.out, "Traceback"));
  // A pixel outside the raster ends the judging there.
  const Outcome outside = graded(lines + "{\"step\":\"write_pixel\",\"x\":99,\"y\":0,\"polygon\":0}\n");
  CHECK(outside.code == 1);
  CHECK(has(outside.out, "up to a step that cannot be"));
  // Nothing handed in.
  const Outcome missing = run(folder, "grade --homework hw hw");
  CHECK(missing.code == 2);
  CHECK(has(missing.out, "Nothing was handed in"));
}

TEST_CASE("grade: a student without the hidden scenes grades the others, and is told") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  REQUIRE(in(folder, "rm -r hw/hidden"));
  const Outcome outcome = run(folder, "grade --homework hw runs");
  CHECK(outcome.code == 0);
  CHECK(has(outcome.out, "65 of 65 points"));
  CHECK(has(outcome.out, "The hidden scenes are not here; their points are not counted."));
  REQUIRE(in(folder, "rm -r hw/scenes"));
  CHECK(run(folder, "grade --homework hw runs").code == 2);
}

TEST_CASE("grade: no report is written over a run or a scene") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  for (const std::string file : {"runs/crossing.jsonl", "hw/scenes/crossing.toml", "hw/homework.toml"}) {
    CAPTURE(file);
    const std::string before = text_of(folder / file);
    CHECK(run(folder, "grade --homework hw runs -o " + file).code == 2);
    CHECK(text_of(folder / file) == before);
  }
}

TEST_CASE("grade: numbers of a hidden scene stay hidden") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  std::string lines = text_of(folder / "runs/overlap.jsonl");
  const std::string right = "\"nearer\": true";
  REQUIRE(has(lines, right));
  lines.replace(lines.find(right), right.size(), "\"nearer\": false");
  write_text(folder / "runs/overlap.jsonl", lines);
  for (const std::string format : {"text", "gradescope", "prairielearn", "junit"}) {
    const Outcome outcome = run(folder, "grade --homework hw runs --format " + format);
    CAPTURE(outcome.out);
    CHECK(outcome.code == 1);
    CHECK_FALSE(has(outcome.out, "overlap.jsonl:"));
    CHECK_FALSE(has(outcome.out, "yours"));
  }
}

TEST_CASE("grade: few digits do not turn errors into rounding, and the report says what to print") {
  if (!there_is("python3")) return;
  const Folder folder;
  set_up(folder);
  // Every depth is off by 0.0004 and rounded to three decimals, which hides it.
  const auto printed = [&](const std::string& off, const std::string& format) {
    std::string emitter = text_of(folder / "hw/solution/emit.py");
    const std::string before = "    out.write(json.dumps(";
    REQUIRE(has(emitter, before));
    emitter.insert(emitter.find(before),
                   "    for one in fields:\n        if isinstance(fields[one], float) and "
                   "math.isfinite(fields[one]):\n            fields[one] = float('" +
                       format + "' % (fields[one] + (" + off + " if 'z' in one else 0)))\n");
    REQUIRE(in(folder, "cp -r hw/solution printing"));
    write_text(folder / "printing/emit.py", emitter);
    REQUIRE(in(folder, "python3 printing/zbuffer.py hw/hidden/overlap.txt > overlap.jsonl && rm -r printing"));
    return run(folder, "grade --homework hw overlap.jsonl --format json");
  };
  const double all = json::parse(printed("0", "%.17g").out)["points"];
  CHECK(json::parse(printed("0", "%f").out)["points"] == doctest::Approx(all));
  CHECK(json::parse(printed("0", "%g").out)["points"] == doctest::Approx(all));
  const json few = json::parse(printed("0.0004", "%.3f").out);
  CHECK(few["points"] < 0.8 * all);
  CHECK(has(few["scenes"][0]["why"], "written with 3 decimals, held to 6: print more of their digits"));
  std::string text = text_of(folder / "hw/homework.toml");
  write_text(folder / "hw/homework.toml", "digits = 3\n" + text);
  CHECK(json::parse(run(folder, "grade --homework hw overlap.jsonl --format json").out)["points"] > few["points"]);
}

TEST_CASE("homework.toml: what is wrong with it is named by its line, with the cure") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  const std::string good = text_of(folder / "hw/homework.toml");
  struct Case {
    std::string from, to, message;
  };
  for (const Case& one :
       {Case{"method = \"z-buffer\"", "method = \"zbuffer\"", "there is no method 'zbuffer'; did you mean 'z-buffer'?"},
        Case{"[\"compare\"]", "[\"compar\"]", "has no step 'compar'; did you mean 'compare'?"},
        Case{"file = \"scenes/triangle.toml\"", "file = \"scenes/triangel.toml\"", "there is no file"},
        Case{"value = 10", "valeu = 10", "did you mean 'value'?"},
        Case{"value = 10", "value = -1", "points go from 0 to 10000"},
        Case{"level = \"buffers\"", "level = \"pictures\"", "buffers"},
        Case{"[\"interpolation\", \"number_format\"]", "[\"ties\"]", "there is no convention 'ties'"},
        Case{"title = ", "title ", "is no TOML"}}) {
    std::string text = good;
    REQUIRE(has(text, one.from));
    text.replace(text.find(one.from), one.from.size(), one.to);
    write_text(folder / "hw/homework.toml", text);
    const Outcome outcome = run(folder, "grade --homework hw hw/handout.md");
    CAPTURE(one.to);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, "hw/homework.toml:"));
    CHECK(has(outcome.err, one.message));
    CHECK(times(outcome.err, "\n") == 1);
  }
  CHECK(has(run(folder, "grade --homework nowhere x").err, "homework new z-buffer"));
}
