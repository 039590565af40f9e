// zstep check, as a person runs it.
#include <doctest/doctest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"
#include "traces/check/rules.hpp"

using namespace zstep::test;

namespace {

std::string foreign(const std::string& name) {
  return "'" + in_checkout("tests/data/foreign/" + name + ".jsonl") + "'";
}

TEST_CASE("check: nothing wrong is exit code 0, something wrong is 1, what cannot be read is 2") {
  const Folder folder;
  CHECK(run(folder, "check " + foreign("big")).code == 0);
  CHECK(run(folder, "check " + foreign("wrongz")).code == 1);
  CHECK(run(folder, "check nowhere.jsonl").code == 2);
  CHECK(run(folder, "record pyramid -o run.ztrace").code == 0);
  const Outcome own = run(folder, "check run.ztrace");
  CHECK(own.code == 0);
  CHECK(times(own.out, "Nothing is wrong.") == 1);
}

TEST_CASE("check: the first wrong step stands with its file's line, its formula and what it should be") {
  const Folder folder;
  const Outcome wrong = run(folder, "check " + foreign("wrongz"));
  CAPTURE(wrong.out);
  CHECK(times(wrong.out, "wrongz.jsonl:15: interp, pixel (0, 0)\n") == 1);
  CHECK(times(wrong.out, "z = z_L + (z_R \u2212 z_L)(x \u2212 x_L)/(x_R \u2212 x_L) = ") == 1);
  CHECK(times(wrong.out, " = 0.5, but the trace has 0.55\n") == 1);
  CHECK(times(wrong.out, "1 cause: ") == 1);
  CHECK(times(wrong.out, "zstep view ") == 1);
}

TEST_CASE("check: JSON has the same, and parses") {
  const Folder folder;
  const auto report = nlohmann::json::parse(run(folder, "check --json " + foreign("unsorted")).out);
  CHECK(report["causes"][0]["rule"] == "edge_sorted");
  CHECK(report["causes"][0]["step"] == 10);
  CHECK(report["causes"][0]["line"] == 11);
  CHECK(report["steps"] == 271);
}

TEST_CASE("check: a run whose program crashed is judged up to its last whole line, and is incomplete") {
  const Folder folder;
  const Outcome torn = run(folder, "check " + foreign("torn"));
  CHECK(torn.code == 3);
  CHECK(times(torn.out, "Nothing that can be judged is wrong.") == 1);
}

TEST_CASE("check: each cause can be looked at, also where a step before it cannot be") {
  const Folder folder;
  REQUIRE(run(folder, "record foley -o run.ztrace").code == 0);
  REQUIRE(run(folder, "dump run.ztrace --jsonl | sed '/insert_edge.,.edge.:1,/s/1/7/' > wrong.jsonl").code == 0);
  const Outcome checked = run(folder, "check wrong.jsonl --json");
  REQUIRE(checked.code == 1);
  int beyond = 0;
  const auto report = nlohmann::json::parse(checked.out);
  for (const auto& cause : report["causes"]) {
    const std::string view = "view wrong.jsonl --at " + std::to_string(cause["step"].get<int>());
    const Outcome shown = run(folder, view + " --describe");
    CAPTURE(view);
    CHECK(shown.code == 0);
    CHECK(run(folder, view + " --screenshot window.png").code == 0);
    beyond += has(shown.out, " cannot be: ");
    const Outcome pane = run(folder, view + " --pane frame --screenshot pane.png");
    CHECK(pane.code == (has(shown.out, " cannot be: ") ? 2 : 0));  // a pane alone does not say it
  }
  CHECK(beyond > 1);
}

TEST_CASE("check --view: the report, then the window at the first cause, with the exit code of the report") {
  const Folder folder;
  const Outcome wrong = run(folder, "check " + foreign("wrongz") + " --view --screenshot window.png");
  CHECK(wrong.code == 1);
  CHECK(times(wrong.out, "1 cause: ") == 1);
  CHECK(times(wrong.out, "wrote window.png: the viewer, 1280x720 pixels") == 1);
  // The step of the first cause, marked; so not the picture that view draws.
  CHECK(run(folder, "check " + foreign("wrongz") + " --view --at 14 --screenshot there.png").code == 1);
  CHECK(run(folder, "view " + foreign("wrongz") + " --at 14 --screenshot plain.png").code == 0);
  const std::string window = text_of(folder / "window.png");
  CHECK(window == text_of(folder / "there.png"));
  CHECK(window != text_of(folder / "plain.png"));
  CHECK(run(folder, "record pyramid -o run.ztrace").code == 0);
  CHECK(run(folder, "check run.ztrace --view --screenshot right.png").code == 0);

  const Outcome without = run(folder, "check run.ztrace --screenshot x.png");
  CHECK(without.code == 2);
  CHECK(times(without.err, "--screenshot: is of the viewer; add --view") == 1);
  CHECK(run(folder, "check run.ztrace --view --json").code == 2);
  CHECK(run(folder, "check run.ztrace --view --screenshot run.ztrace").code == 2);
  CHECK(run(folder, "info run.ztrace").code == 0);
}

TEST_CASE("check: docs/checking-a-run.md has every rule, as the program has it") {
  const std::string page = text_of(in_checkout("docs/checking-a-run.md"));
  for (std::size_t number = 0; number < static_cast<std::size_t>(zstep::formulas::Rule::count); ++number) {
    const zstep::RuleText rule = zstep::rule_text(static_cast<zstep::formulas::Rule>(number));
    CHECK(times(page, "| `" + std::string(rule.name) + "` | " + std::string(rule.sentence) + " |\n") == 1);
  }
}

}  // namespace

TEST_CASE("check, diff and explain name the likely mistake of a run") {
  const Folder folder;
  const std::string third = "\"" + in_checkout("lessons/runs/third.jsonl") + "\"";
  const auto report = nlohmann::json::parse(run(folder, "check " + third + " --json").out);
  CHECK(report["likely"]["either"] == nlohmann::json{"equal_wins"});
  CHECK(!report["likely"].contains("also"));
  const std::string likely = "Likely: Of equal depths the later one wins.\n  Which polygon keeps";
  CHECK(has(run(folder, "check " + third).out, likely));
  REQUIRE(run(folder, "record delhi -o right.ztrace").code == 0);
  CHECK(has(run(folder, "diff right.ztrace " + third).out, "Of B:\n  " + likely));
  CHECK(has(run(folder, "explain " + third + " --at 219 nearer").out, likely));
  // Nothing is likely where nothing is wrong.
  CHECK(!has(run(folder, "check right.ztrace").out, "Likely"));
  CHECK(nlohmann::json::parse(run(folder, "check right.ztrace --json").out)["likely"]["either"].empty());
}
