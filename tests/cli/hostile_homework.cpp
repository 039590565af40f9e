#include "tests/cli/hostile_homework.hpp"

#include <doctest/doctest.h>

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "tests/cli/result_rules.hpp"

namespace zstep::test {

namespace fs = std::filesystem;
using nlohmann::json;

std::string with_changed(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(has(text, from));
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

void hostile_homework(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  std::string text = text_of(folder / "hw/homework.toml");
  for (const char* scene : {"crossing", "neighbours"})
    text = with_changed(text, std::string("[[scene]]\nfile = \"scenes/") + scene + ".toml\"\n", "");
  write_text(folder / "hw/homework.toml",
             with_changed(text, "\n[options]\n",
                          "\n[program]\ncommand = \"sh program.sh\"\nseconds = 1\nmemory = 128\noutput = 2\nfiles = 4\n"
                          "processes = 12\n\n[options]\n"));
  for (const char* scene : {"scenes/triangle", "hidden/overlap", "scenes/crossing"}) {
    const std::string name = fs::path(scene).filename().string();
    REQUIRE(run(folder, std::string("record hw/") + scene + ".toml -o run.ztrace").code == 0);
    REQUIRE(run(folder, "dump run.ztrace --jsonl > " + name + ".right").code == 0);
  }
  fs::remove(folder / "run.ztrace");
}

std::string right_run(const Folder& folder, const std::string& scene) {
  const std::string text = text_of(folder / (scene + ".right"));
  return text.substr(text.find('\n') + 1);
}

std::string everything_in(const Folder& folder) {
  return shell(folder,
               "find . -path ./runs -prune -o -path './result*' -prune -o -type f -print0 | sort -z | xargs -0 cksum; "
               "find . -path ./runs -prune -o -path './result*' -prune -o -print | sort")
      .out;
}

bool shows_controls(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 32 && c != '\n' && c != '\t') || code == 127;
  });
}

double grade_in_every_format(const Folder& folder) {
  const auto graded = [&](const std::string& format) {
    const Outcome outcome = shell(folder, "ulimit -t 60; \"$zstep\" grade --homework hw runs --format " + format);
    CAPTURE(format);
    CAPTURE(outcome.err);
    CHECK(outcome.code <= 2);
    CHECK_FALSE(outcome.out.empty());
    CHECK(outcome.out.size() < 1'000'000);
    CHECK_FALSE(shows_controls(outcome.out));
    CHECK_FALSE(shows_controls(outcome.err));
    check_result(format, outcome.out);
    return outcome;
  };
  CHECK(has(graded("text").out, " points"));
  // What a small submission may take, of all that any process took so far.
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  constexpr long allowed = 1024 * 1024;  // KiB
  if (!sanitized) CHECK(used.ru_maxrss < allowed);
  graded("junit");
  graded("html");
  const json all = json::parse(graded("json").out);
  const json gradescope = json::parse(graded("gradescope").out);
  const json prairielearn = json::parse(graded("prairielearn").out);
  const double points = all["points"];
  CHECK(points >= 0);
  CHECK(gradescope["score"] == doctest::Approx(points));
  double sum = 0;
  for (const json& test : gradescope["tests"]) {
    CHECK(test["score"].get<double>() <= test["max_score"].get<double>());
    sum += test["score"].get<double>();
  }
  CHECK(sum == doctest::Approx(points));
  CHECK(prairielearn["gradable"] == all["gradable"]);
  if (prairielearn["gradable"]) CHECK(prairielearn["score"] == doctest::Approx(points / all["of"].get<double>()));
  else CHECK_FALSE(prairielearn["format_errors"].empty());
  return points;
}

}  // namespace zstep::test
