// The report of a submission: its first page, and that there is one whatever becomes of the grading.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/hostile_homework.hpp"
#include "tests/cli/homework_runs.hpp"
#include "tests/cli/result_rules.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

/// A run of so many bytes and more.
void hand_in_long(const Folder& folder, std::size_t bytes) {
  const std::string line = "{\"step\":\"compare\",\"x\":3,\"y\":2,\"z\":0.4375,\"nearer\":true}\n";
  std::string many;
  while (many.size() < bytes) many += line;
  write_text(folder / "runs/crossing.jsonl", many);
}

/// Each format says why there is no grade, to a file and to standard output.
void check_ungraded(const Folder& folder, const std::string& limit, const std::string& why) {
  for (const std::string format : {"text", "json", "gradescope", "prairielearn", "junit", "html"}) {
    CAPTURE(format);
    const std::string command = "grade --homework hw runs " + limit + " --format " + format;
    const Outcome outcome = run(folder, command + " -o results");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(has(outcome.err, "runs: could not be graded: the grading " + why));
    CHECK(times(outcome.err, "\n") == 1);
    const std::string text = text_of(folder / "results");
    CAPTURE(text);
    CHECK(has(text, "could not be graded: the grading " + why));
    CHECK_FALSE(shows_controls(text));
    check_result(format, text);
    if (format == "text" || format == "html") CHECK(has(text, "so there are no points yet"));
    if (format != "json" && format != "gradescope" && format != "prairielearn") continue;
    const json result = json::parse(text);
    if (format == "gradescope") CHECK(result["extra_data"]["gradable"] == false);
    else CHECK(result["gradable"] == false);
    if (format == "prairielearn") {
      CHECK_FALSE(result.contains("score"));
      CHECK(result["format_errors"].size() == 4);
    }
    const Outcome printed = run(folder, command);
    CHECK(printed.code == 3);
    CHECK(json::accept(printed.out));
  }
}

}  // namespace

TEST_CASE("grade: where time is used up, every format has a result that says so") {
  const Folder folder;
  set_up_runs(folder);
  hand_in_long(folder, 20'000'000);
  check_ungraded(folder, "--seconds 0.01", "took more than the 0.01 seconds of the processor");
}

TEST_CASE(
    "grade: PrairieLearn's result stays below 1 MB, however many scenes there are and however much programs complain") {
  const Folder folder;
  set_up_runs(folder);
  const std::string before = text_of(folder / "hw/homework.toml"), scene = text_of(folder / "hw/scenes/triangle.toml");
  const std::size_t at = before.find("[[scene]]"), end = before.find("# The rungs");
  std::string scenes;
  for (int k = 100; k < 300; ++k) {  // as many as there may be
    const std::string name = "scene-" + std::to_string(k);
    write_text(folder / ("hw/scenes/" + name + ".toml"), scene);
    write_text(folder / ("runs/" + name + ".jsonl"), "no step\n");
    write_text(folder / ("runs/" + name + ".ended.txt"), "exit code 1\n" + std::string(100'000, '"'));
    scenes += "[[scene]]\nfile = \"scenes/" + name + ".toml\"\n\n";
  }
  write_text(folder / "hw/homework.toml", before.substr(0, at) + scenes + before.substr(end));
  const std::string grade = "grade --homework hw runs --format prairielearn";
  const std::string none = run(folder, grade).out;
  check_prairielearn(none);
  CHECK(json::parse(none)["gradable"] == false);
  std::filesystem::copy_file(folder / "runs/triangle.jsonl", folder / "runs/scene-100.jsonl",
                             std::filesystem::copy_options::overwrite_existing);
  const std::string one = run(folder, grade).out;
  check_prairielearn(one);
  const json result = json::parse(one);
  CHECK(result["gradable"] == true);
  CHECK(result["score"] == doctest::Approx(1.0 / 200));
  CHECK(result["tests"].size() == 1200);
}

TEST_CASE("grade: where memory is used up, every format has a result that says so" * doctest::skip(sanitized)) {
  const Folder folder;
  set_up_runs(folder);
  hand_in_long(folder, 8'000'000);
  check_ungraded(folder, "--memory 2", "needs more than the 2 MiB");
}

TEST_CASE(
    "grade: where its process is killed, there is a result that says so, and the grader that is killed leaves none") {
  const Folder folder;
  set_up_runs(folder);
  hand_in_long(folder, 20'000'000);
  if (shell(folder, "pgrep -x no-such-name; [ $? = 1 ]").code != 0) return;
  const std::string grade =
      "\"$zstep\" grade --homework hw runs --format prairielearn -o results & p=$!; "
      "until c=$(pgrep -P $p); do kill -0 $p || exit 99; done; ";
  const Outcome child = shell(folder, grade + "kill -9 $c; wait $p");
  CAPTURE(child.err);
  CHECK(child.code == 3);
  CHECK(has(child.err, "runs: could not be graded: the grading was ended by signal 9"));
  const json result = json::parse(text_of(folder / "results"));
  CHECK(result["gradable"] == false);
  CHECK(has(result["format_errors"][0].get<std::string>(), "was ended by signal 9"));
  // What was there before is whole, and the child does not outlive who waits for it.
  write_text(folder / "results", "before");
  CHECK(shell(folder, grade +
                          "kill -9 $p; wait $p; n=0; while kill -0 $c 2>/dev/null && [ $n -lt 100 ]; do sleep 0.05; "
                          "n=$((n+1)); done; [ $n -lt 100 ]")
            .code == 0);
  CHECK(text_of(folder / "results") == "before");
  CHECK(folder.names() == std::vector<std::string>{"hw", "results", "runs"});
}

TEST_CASE("grade: a report of text has what works, the first wrong step and its command on its first page") {
  const Folder folder;
  set_up_runs(folder);
  for (const char* scene : {"crossing", "neighbours", "overlap"}) {
    const auto file = folder / (std::string("runs/") + scene + ".jsonl");
    std::string lines = text_of(file);
    replace_first(lines, "\"nearer\":true", "\"nearer\":false");
    write_text(file, lines);
  }
  const Outcome outcome = run(folder, "grade --homework hw runs");
  CHECK(outcome.code == 1);
  std::size_t end = 0;
  for (int line = 0; line < 25; ++line) end = outcome.out.find('\n', end) + 1;
  const std::string page = outcome.out.substr(0, end);
  CAPTURE(outcome.out);
  CHECK(has(page, "\nAll right: triangle\ncrossing: right are picture and depths, spans, edge table, active edges\n"));
  CHECK(page.find("All right") < page.find("The first thing to look at, in crossing, runs/crossing.jsonl:"));
  CHECK(has(page, "\n  expected  nearer = true"));
  CHECK(has(page, "\n  yours     nearer = false\n"));
  CHECK(has(page, "\n  zstep grade --homework hw runs --scene crossing --view\n"));
  // Then how each point comes about.
  const std::string rest = outcome.out.substr(outcome.out.find("\nHow the points come about\n"));
  for (const char* scene : {"triangle", "crossing", "neighbours", "overlap"})
    CHECK(has(rest, std::string("\n") + scene + ": "));
  CHECK(times(rest, "computed ") == 20);
}

TEST_CASE("grade: to declare a coarse number format buys nothing, unless the homework names it") {
  const Folder folder;
  set_up_runs(folder);
  const std::string right = text_of(folder / "runs/crossing.jsonl");
  const auto points = [&](const std::string& declared, const std::string& lines) {
    write_text(folder / "crossing.jsonl",
               "{\"ztrace\":1,\"conventions\":{\"number_format\":\"" + declared + "\"}}\n" + lines);
    return json::parse(run(folder, "grade --homework hw crossing.jsonl --scene crossing --format json").out)["points"]
        .get<double>();
  };
  std::string off = right;
  replace_first(off, "\"z_edge\":0.625", "\"z_edge\":0.62502");
  const double all = points("float64", right), wrong = points("float64", off);
  REQUIRE(wrong < all);
  CHECK(points("float32", right) == all);
  CHECK(points("fixed16", right) == all);
  CHECK(points("fixed16", off) == wrong);
  std::string text = text_of(folder / "hw/homework.toml");
  replace_first(text, "\"number_format\"", "\"number_format\", \"number_format fixed16\"");
  write_text(folder / "hw/homework.toml", text);
  CHECK(points("fixed16", off) > wrong);
  CHECK(points("fixed18", off) == wrong);
  replace_first(text, "number_format fixed16", "number_format fixed17");
  write_text(folder / "hw/homework.toml", text);
  const Outcome unknown = run(folder, "grade --homework hw runs");
  CHECK(unknown.code == 2);
  CHECK(has(unknown.err, "there is no convention 'number_format fixed17'"));
}
