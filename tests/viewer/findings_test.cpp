// What check found, in the window: on the timeline, in the tables, at pixels, and in the words of the command.
#include <doctest/doctest.h>

#include "sim/viewer/model/findings.hpp"
#include "sim/viewer/pictures.hpp"
#include "sim/words/judged.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/with_mistake.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;
using Trust = Findings::Trust;

namespace {

Trace changed(const char* name, const std::string& from, const std::string& to) {
  return test::with_mistake(open_jsonl(test::in_checkout(std::string("tests/golden/") + name + ".jsonl")), from, to);
}

/// A slope that is wrong: an entry of the edge table, and what an edge by increments makes of it.
Trace wrong_slope() { return changed("foley", "\"dx_dy\":1.5", "\"dx_dy\":1.25"); }
/// A depth that is wrong at one pixel, and is written there.
Trace wrong_depth() {
  return changed("delhi", "{\"step\":\"interpolate_z\",\"x\":2,\"y\":2,\"z\":5.0}",
                 "{\"step\":\"interpolate_z\",\"x\":2,\"y\":2,\"z\":4.5}");
}

int bad_pixels(App& app) { return test::count_of(test::picture(app), to_pixel(light_theme().bad) & 0xffffffu); }

}  // namespace

TEST_CASE("law: the steps that are marked are those that the report counts, in every run that is wrong") {
  int wrong_runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::in_checkout("tests/data/foreign"))) {
    if (entry.path().extension() != ".jsonl") continue;
    CAPTURE(entry.path().filename().string());
    std::string impossible;
    const Trace trace = open_jsonl(entry.path(), &impossible);
    const CheckedRun run = judge_run(trace, nullptr, true);
    const auto wrong = std::count_if(run.marks.steps.begin(), run.marks.steps.end(),
                                     [](const CheckMarks::Step& mark) { return mark.wrong; });
    CHECK(wrong == run.report.wrong_steps);
    CHECK(static_cast<std::int64_t>(run.marks.steps.size()) - wrong == run.report.inherited);
    CHECK(static_cast<std::int64_t>(run.marks.faults.size()) >= run.report.wrong_steps);
    CHECK(run.texts.size() == run.report.causes.size());
    // Without marks it is the same report.
    const CheckReport plain = check(trace);
    CHECK(plain.wrong_steps == run.report.wrong_steps);
    CHECK(plain.inherited == run.report.inherited);
    wrong_runs += !run.report.causes.empty();
  }
  CHECK(wrong_runs > 10);
}

TEST_CASE("keys go from cause to cause and from mark to mark, and the pane says what the command says") {
  const Trace trace = wrong_slope();
  const CheckedRun run = judge_run(trace, nullptr, true);
  REQUIRE(run.report.causes.size() == 1);
  App app(trace, nullptr, {}, 1280, 720);
  app.show_findings(run);
  Session& s = app.session();
  test::send_text(app, ".");
  CHECK(s.position() == run.report.causes[0].first.step);
  const StepMarks::Told& told = app.ui().marks->told(s);
  REQUIRE(told.lines.size() == 1);
  CHECK(told.lines[0] == what_is_wrong(run.report.causes[0].first, run.texts[0]) + ".");
  CHECK(told.note.find(what_follows(run.report.causes[0])) != std::string::npos);
  test::send_text(app, ".");
  CHECK(s.message == "There is no later cause.");
  test::send_text(app, ">");
  CHECK(s.position() == run.marks.steps[1].step);
  // The later step with the same fault has its own numbers; one that only follows says from where.
  for (const CheckMarks::Step& mark : run.marks.steps) {
    s.go_to(mark.step);
    const StepMarks::Told& here = app.ui().marks->told(s);
    CHECK(here.lines.empty() != mark.wrong);
    if (!mark.wrong) CHECK(here.note.find("follows from what is wrong at step 10. Cause 1 of 1") != std::string::npos);
  }
  s.go_to(trace.size());
  test::send_text(app, ",");
  CHECK(s.position() == run.report.causes[0].first.step);
  test::send_text(app, "<");
  CHECK(s.message == "No earlier step is marked.");
}

TEST_CASE("what is said of a step that is wrong ends in one full stop, whether a rule says it or a formula") {
  int by_rule = 0, by_formula = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::in_checkout("tests/data/foreign"))) {
    if (entry.path().extension() != ".jsonl") continue;
    CAPTURE(entry.path().filename().string());
    std::string impossible;
    const Trace trace = open_jsonl(entry.path(), &impossible);
    const CheckedRun run = judge_run(trace, nullptr, true);
    if (run.report.causes.empty()) continue;
    App app(trace, nullptr, {}, 640, 360);
    app.show_findings(run);
    for (const Cause& cause : run.report.causes) {
      if (!cause.first.impossible.empty()) break;  // no replay goes through a step that cannot be
      app.session().go_to(cause.first.step);
      for (const std::string& line : app.ui().marks->told(app.session()).lines) {
        CAPTURE(line);
        CHECK(line.ends_with('.'));
        CHECK_FALSE(line.ends_with(".."));
      }
      ++(cause.first.rule ? by_rule : by_formula);
    }
  }
  CHECK(by_rule > 0);
  CHECK(by_formula > 0);
}

TEST_CASE("a step that cannot be ends the way there, and the window stays open before it") {
  const Trace trace = open_jsonl(test::in_checkout("tests/data/foreign/retire_early.jsonl"));
  App app(trace, nullptr, {}, 640, 360);
  Session& s = app.session();
  for (const bool by_steps : {false, true}) {
    CAPTURE(by_steps);
    s.go_to(0);
    if (by_steps)
      while (s.position() < 120 && s.message.empty()) s.go_to(s.position() + 1);
    else s.go_to(s.size());
    CHECK(s.position() == 108);
    CHECK(s.message.find("step 109 cannot be: edge 0 is not in the active edge list") != std::string::npos);
    const State there = s.state();
    s.go_to(50);
    CHECK(s.position() == 50);
    s.go_to(108);
    CHECK(s.state().picture == there.picture);
    CHECK(s.message.empty());
  }
  CHECK_THROWS_AS(go_to_or_throw(s, 200), InputError);

  // A window that is to open at such a step, as check names it, opens before it and says so.
  ViewerOptions options;
  options.at = 200;
  s.go_to(0);
  go_to_start(app, options);
  CHECK(s.position() == 108);
  CHECK(s.message.find("step 109 cannot be: edge 0 is not in the active edge list") != std::string::npos);
  const std::string text = described(trace, options);
  CHECK(text.find("Step 108 of ") == 0);
  CHECK(text.find("step 109 cannot be: edge 0 is not in the active edge list") != std::string::npos);
  Pictures pictures(trace, {});
  CHECK_THROWS_AS(pictures.at(200), InputError);
  CHECK_NOTHROW(pictures.at(200, true));
}

TEST_CASE("an entry of the edge table that is wrong is marked as long as it stands there") {
  const Trace trace = wrong_slope();
  const CheckedRun run = judge_run(trace, nullptr, true);
  const Findings findings(trace, run);
  const formulas::Place entry{formulas::Place::In::edge_table, 1};
  const std::int64_t at = run.report.causes[0].first.step;
  CHECK(findings.trust(entry, at - 1) == Trust::right);
  CHECK(findings.trust(entry, at) == Trust::wrong);
  CHECK(findings.trust(entry, trace.size()) == Trust::wrong);
  CHECK(findings.trust({formulas::Place::In::edge_table, 0}, trace.size()) == Trust::right);
  App plain(trace, nullptr, {}, 1280, 720), marked(trace, nullptr, {}, 1280, 720);
  marked.show_findings(run);
  plain.session().go_to(at + 40);
  marked.session().go_to(at + 40);
  CHECK(bad_pixels(plain) == 0);
  CHECK(bad_pixels(marked) > 100);
}

TEST_CASE("pixels that are written wrongly are marked, and those that follow are marked otherwise") {
  const Trace trace = wrong_depth();
  const CheckedRun run = judge_run(trace, nullptr, true);
  REQUIRE_FALSE(run.report.causes.empty());
  Findings findings(trace, run);
  CHECK(findings.pixels(run.report.causes[0].first.step - 1, false).empty());
  const std::vector<PixelMark> end = findings.pixels(trace.size(), false);
  // What every marked write up to the end wrote last.
  Replay replay(trace);
  replay.go_to(trace.size());
  const std::int64_t pixel = static_cast<std::int64_t>(replay.state().picture.at(2, 2));
  CHECK(std::any_of(end.begin(), end.end(), [&](const PixelMark& mark) { return mark.pixel == pixel; }));
  CHECK(end.size() < 4);
  App plain(trace, nullptr, {}, 1280, 720), marked(trace, nullptr, {}, 1280, 720);
  marked.show_findings(run);
  CHECK(marked.show_only("frame"));
  CHECK(plain.show_only("frame"));
  marked.session().go_to(trace.size());
  plain.session().go_to(trace.size());
  CHECK(bad_pixels(plain) == 0);
  CHECK(bad_pixels(marked) > 5);
}

TEST_CASE("law: a window with marks is the same, walked to or jumped to, and as its screenshot") {
  const Trace trace = wrong_depth();
  const CheckedRun run = judge_run(trace, nullptr, true);
  App walked(trace, nullptr, {}, 1280, 720);
  walked.show_findings(run);
  const std::int64_t from = run.report.causes[0].first.step - 3;
  walked.session().go_to(from);
  PictureOptions options;
  options.checked = &run;
  for (int i = 0; i < 9; ++i) {
    test::press(walked, SDLK_RIGHT);
    walked.frame();
    const std::int64_t at = walked.session().position();
    CAPTURE(at);
    const bool same = test::picture(walked) == Pictures(trace, options).at(at).rgb;
    CHECK(same);
  }
}
