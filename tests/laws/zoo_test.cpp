// Law: of runs that zstep did not make, check and diff name the first wrong step, and doubt none that is right.
#include <doctest/doctest.h>

#include <algorithm>

#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

// ---- Scenes in screen coordinates --------------------------------------------------------------------------------

struct Named {
  std::string name;
  zoo::Task task;
};

std::vector<Named> scenes() {
  std::vector<Named> all;
  zoo::Task one;
  one.width = 14, one.height = 12;
  one.points = {{1, 1, 0.25}, {12.5, 4, 0.75}, {4, 10.5, 0.5}};
  one.polygons = {{0, {0, 1, 2}}};
  all.push_back({"one triangle", one});
  all.push_back({"ties", ties()});
  zoo::Task through = one;
  through.points = {{1, 1, 0.125}, {12, 2, 0.875}, {6, 10, 0.5}, {2, 9, 0.25}, {12.5, 8, 0.375}, {7, 1, 0.75}};
  through.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}};
  all.push_back({"through each other", through});
  all.push_back({"three triangles", triangles(3, 3, 18)});
  all.push_back({"six triangles", triangles(6, 6, 22)});
  all.push_back({"ten triangles", triangles(11, 10, 26)});
  return all;
}

/// What zstep itself does with the scene.
Trace reference(const Scene& scene) {
  Conventions conventions;
  conventions.cull = false;
  return test::recorded_by("z-buffer", scene, conventions);
}

// ---- Programs ----------------------------------------------------------------------------------------------------

std::string by_line(const zoo::Task& task) { return test::python("by_line.py", task); }

struct Program {
  const char* name;
  std::string (*run)(const zoo::Task&);
  const char* number_format;
  const char* interpolation;
  std::vector<const char*> mistakes;
};
const std::vector<Program>& programs() {
  static const std::vector<Program> all{
      {"edge table",
       zoo::edge_table,
       "float64",
       "increments",
       {"z_not_swapped",       "slope_inverted",       "slope_whole",        "z_slope_of_x",
        "x_at_vertex",         "ends_one_late",        "compare_reversed",   "equal_wins",
        "written_before_test", "colour_always",        "depth_not_written",  "colour_not_written",
        "right_end_included",  "ends_rounded",         "z_not_to_centre",    "z_by_slope_of_x",
        "never_retired",       "rounded_then_stepped", "z_not_carried",      "stepped_twice",
        "not_sorted",          "entered_in_front",     "buffer_begins_at_0", "buffer_reset",
        "buffer_of_one_line"}},
      {"crossings",
       zoo::crossings,
       "float32",
       "direct",
       {"both_ends_met", "z_along_x", "z_from_the_right", "z_of_the_line", "one_depth_off", "farther_wins",
        "depth_kept", "colour_of_the_next"}},
      {"half-planes",
       zoo::half_planes,
       "float64",
       "direct",
       {"border_for_nobody", "border_for_all", "weights_turned", "or_equal", "half_the_depth"}},
      {"by line (Python)",
       by_line,
       "float64",
       "increments",
       {"last_line_in", "unsorted", "truncated", "begins_at_edge", "buffer_of_line_before"}},
  };
  return all;
}

TEST_CASE("zoo: runs of right programs are not doubted, and are the same as zstep's own but for rounding") {
  int runs = 0;
  for (const Program& program : programs()) {
    if (program.run == by_line && !there_is_python()) continue;
    std::vector<Named> all = scenes();
    if (program.run != zoo::half_planes) all.push_back({"concave", concave()});
    for (const Named& scene : all) {
      CAPTURE(program.name);
      CAPTURE(scene.name);
      const Trace run =
          trace_of(head(scene.task, program.number_format, program.interpolation) + program.run(scene.task));
      const CheckReport report = check(run);
      for (const Cause& cause : report.causes)
        FAIL_CHECK("step " << cause.first.step << ": " << cause.first.field << " " << cause.first.impossible
                           << (cause.first.rule ? rule_text(*cause.first.rule).name : ""));
      const Trace own = reference(run.scene());
      const diff::DiffReport against = diff::compare(own, run);
      CHECK(against.alignment.complete);
      for (const diff::Cause& cause : against.causes)
        if (cause.part == diff::Part::different)
          FAIL_CHECK("kind " << int{cause.first.kind} << " a " << cause.first.a << " b " << cause.first.b << " fields "
                             << cause.first.fields);
      ++runs;
    }
  }
  CHECK(runs >= 18);
}

TEST_CASE("zoo: of wrong programs the first wrong step is named, by check or by diff") {
  std::string table;
  int wrong = 0, named = 0;
  for (const Program& program : programs()) {
    if (program.run == by_line && !there_is_python()) continue;
    for (const char* mistake : program.mistakes) {
      int seen = 0, by_check = 0, by_diff = 0, by_either = 0, unnoticed = 0;
      std::string missed;
      std::vector<Named> all = scenes();
      if (program.run != zoo::half_planes) all.push_back({"concave", concave()});
      for (Named& scene : all) {
        const std::string right = program.run(scene.task);
        scene.task.mistake = mistake;
        const std::string text = program.run(scene.task);
        const std::int64_t first = first_difference(right, text);
        if (first == 0) continue;
        ++seen;
        std::string impossible;
        const Trace run = trace_of(head(scene.task, program.number_format, program.interpolation) + text, &impossible);
        const CheckReport report = check(run);
        const Trace own = reference(run.scene());
        // The programs are told to print each line of their page, as in a homework.
        const diff::DiffReport against = diff::compare(own, run, nullptr, diff::Way::fast, {}, diff::most_differences,
                                                       diff::Unrecorded::missing_of_pixels);
        // What is missing, or comes too often, is noticed by the first span or pixel that comes after it, at the
        // latest.
        const std::int64_t shows = shown_at(run, first);
        const bool checked =
            !report.causes.empty() && first <= report.causes[0].first.step && report.causes[0].first.step <= shows;
        const auto cause = std::find_if(against.causes.begin(), against.causes.end(),
                                        [](const diff::Cause& one) { return one.part == diff::Part::different; });
        const Trace without = trace_of(head(scene.task, program.number_format, program.interpolation) + right);
        const bool differed =
            cause != against.causes.end() && is_at(*cause, own, against.alignment, without, first, shows);
        by_check += checked, by_diff += differed, by_either += checked || differed;
        unnoticed += report.causes.empty() && cause == against.causes.end() && impossible.empty();
        if (!checked && !differed)
          missed += fmt::format(" [{}: step {}, check {}, diff {}/{}]", scene.name, first,
                                report.causes.empty() ? 0 : report.causes[0].first.step,
                                cause == against.causes.end() ? 0 : cause->first.a,
                                cause == against.causes.end() ? 0 : cause->first.b);
      }
      table += fmt::format("{:<18}{:<24}{:>4}{:>8}{:>8}{:>8}{}\n", program.name, mistake, seen, by_check, by_diff,
                           by_either, missed);
      CAPTURE(mistake);
      CHECK(seen > 0);
      CHECK(unnoticed == 0);
      // In one scene a mistake may have no effect where it is made first, or the two orders of work may be opposite.
      CHECK(by_either >= seen - 1);
      wrong += seen, named += by_either;
    }
  }
  MESSAGE("program, mistake, scenes in which it shows; named at its first step by check, by diff, by either\n", table);
  CHECK(named >= 0.98 * wrong);
  MESSAGE(named, " of ", wrong, " wrong runs named at the first wrong step");
}

}  // namespace
