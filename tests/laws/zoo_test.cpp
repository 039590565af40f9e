// Law: of runs that zstep did not make, check and diff name the first wrong step, and doubt none that is right.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <span>

#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/sparse.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/mistakes/in_pixels.hpp"
#include "traces/mistakes/name.hpp"

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

std::string by_line(const zoo::Task& task) { return test::printed_by_file("by_line.py", task); }

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

// ---- Programs of today: no spans, and nothing printed but what becomes of each pixel -------------------------------

struct Style {
  const char* words;
  const char* number_format;
};
constexpr std::array<Style, 12> styles{{{"float64 products", "float64"},
                                        {"float64 increments", "float64"},
                                        {"float64 products last", "float64"},
                                        {"float64 lines", "float64"},
                                        {"float64 slopes", "float64"},
                                        {"float64 products rows", "float64"},
                                        {"float32 products", "float32"},
                                        {"float32 increments", "float32"},
                                        {"float32 products last tiles", "float32"},
                                        {"float32 lines", "float32"},
                                        {"float32 slopes rows", "float32"},
                                        {"float32 lines last", "float32"}}};

/// Triangles with coordinates that no power of two divides, and some that are thin, far outside or one on the other.
zoo::Task odd_triangles(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  zoo::Task task;
  task.width = 18, task.height = 14;
  const int count = 2 + static_cast<int>(random() % 4);
  for (int i = 0; i < count; ++i) {
    const bool far = random() % 6 == 0, thin = random() % 5 == 0, meets = i > 0 && random() % 3 == 0;
    const double beyond = far ? 200 : 3;
    for (int corner = 0; corner < 3; ++corner)
      task.points.push_back({between(-beyond, 18 + beyond), between(-beyond, 14 + beyond), between(0.1, 0.9)});
    if (thin) task.points[3 * i + 2].y = task.points[3 * i + 1].y + between(-0.4, 0.4);
    task.polygons.push_back({i, {3 * i, 3 * i + 1, 3 * i + 2}});
    if (meets) task.polygons.back().corners[0] = 3 * i - 1, task.polygons.back().corners[1] = 3 * i - 2;
  }
  return task;
}
zoo::Task random_task(std::uint64_t seed) {
  return seed % 2 == 0 ? odd_triangles(seed) : triangles(seed, 2 + static_cast<int>(seed % 5), 18);
}

/// A program that draws triangles by weights. Mistakes that are in the catalogue have its names.
struct DrawsByWeights {
  std::string name;
  std::vector<std::string> (*run)(std::span<const zoo::Task>);
  std::vector<Style> styles;
  std::vector<const char*> mistakes;

  const Style& style(std::uint64_t seed) const { return styles[seed % styles.size()]; }
};
const DrawsByWeights in_cpp{
    "C++",
    [](std::span<const zoo::Task> tasks) {
      std::vector<std::string> texts;
      for (const zoo::Task& task : tasks) texts.push_back(zoo::barycentric(task));
      return texts;
    },
    {styles.begin(), styles.end()},
    {"centres_half_off",   "vertices_rounded",       "vertices_truncated",   "picture_mirrored",
     "y_upside_down",      "one_pixel_off",          "x_y_exchanged",        "one_winding_only",
     "vertex_depth_twice", "box_too_small",          "box_without_last_row", "border_for_nobody",
     "border_for_both",    "border_for_other_side",  "inside_margin",        "edge_not_asked",
     "area_not_doubled",   "weights_exchanged",      "weights_turned",       "weight_negative",
     "weight_left_out",    "not_normalised",         "depth_is_mean",        "depth_of_one_vertex",
     "depth_truncated",    "depth_by_reciprocals",   "stride_is_height",     "compare_reversed",
     "equal_wins",         "depth_always",           "depth_not_kept",       "depth_squared",
     "colour_beside",      "colour_of_next",         "polygon_left_out",     "area_not_divided_by",
     "one_line_up",        "centres_left_of_pixels", "nearest_of_three"}};

/// Those whose interpreters are there.
std::vector<DrawsByWeights> in_other_languages() {
  std::vector<DrawsByWeights> all;
  if (there_is_python())
    all.push_back({"Python",
                   [](std::span<const zoo::Task> tasks) { return printed_by_file("half_space.py", tasks); },
                   {{"", "float64"}},
                   {"area_not_doubled",     "area_not_turned",   "area_of_first",         "begins_at_vertices",
                    "border_for_both",      "border_for_nobody", "border_for_other_side", "box_too_small",
                    "box_without_last_row", "centres_half_off",  "colour_beside",         "compare_reversed",
                    "depth_of_one_vertex",  "difference_turned", "edge_not_asked",        "equal_wins",
                    "first_depth_left_out", "goes_on_from_top",  "one_winding_only",      "stepped_downwards",
                    "stride_is_height",     "term_left_out",     "weight_left_out",       "weights_exchanged",
                    "y_upside_down"}});
  if (there_is_node())
    all.push_back({"JavaScript",
                   [](std::span<const zoo::Task> tasks) { return printed_by_file("barycentric.js", tasks); },
                   {{"", "float32"}},
                   {"area_not_divided_by",   "area_not_doubled",     "border_for_both",    "border_for_nobody",
                    "border_for_other_side", "colour_of_next",       "column_not_reset",   "compare_reversed",
                    "depth_always",          "depth_by_reciprocals", "depth_is_mean",      "depth_not_kept",
                    "depth_to_hundredths",   "depth_truncated",      "edge_asked_twice",   "equal_wins",
                    "inside_margin",         "one_pixel_off",        "one_winding_only",   "picture_mirrored",
                    "sorted_as_words",       "stride_is_height",     "vertex_depth_twice", "vertices_rounded",
                    "vertices_truncated",    "weight_left_out",      "weight_negative",    "weights_exchanged",
                    "weights_to_tenths",     "weights_turned",       "x_y_exchanged",      "y_upside_down"}});
  return all;
}

/// Runs without a mistake, in each style: visit(run).
template <class Visit>
void each_right_run(const DrawsByWeights& program, std::uint64_t scenes, Visit&& visit) {
  for (const Style& style : program.styles) {
    std::vector<zoo::Task> tasks;
    for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
      tasks.push_back(random_task(seed));
      tasks.back().style = style.words;
    }
    const std::vector<std::string> texts = program.run(tasks);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      INFO(program.name << " " << style.words << ", scene " << i + 1);
      visit(trace_of(head(tasks[i], style.number_format, "direct") + texts[i]));
    }
  }
}

/// Is it judged to the last one which pixels are drawn?
bool checked_as_right(const Trace& run) {
  const CheckReport report = check(run);
  for (const Cause& cause : report.causes)
    FAIL_CHECK("step " << cause.first.step << ": " << cause.first.field << " " << cause.first.impossible
                       << (cause.first.rule ? rule_text(*cause.first.rule).name : ""));
  return report.coverage;
}

TEST_CASE("zoo: right programs with barycentric weights are not doubted, of whatever they print nothing") {
  int runs = 0, whole = 0;
  each_right_run(in_cpp, 200 / test::sparse, [&](const Trace& run) { ++runs, whole += checked_as_right(run); });
  MESSAGE(runs, " runs, of ", whole, " which pixels are drawn is judged to the last one");
  CHECK(10 * whole > 7 * runs);
}

/// What such a program prints, without its compares.
std::string writes_alone(const std::string& text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    if (text.compare(at, 17, "{\"step\":\"compare\"") != 0) kept += text.substr(at, end - at);
    at = end;
  }
  return kept;
}

TEST_CASE("zoo: programs that print nothing but what they write are judged by what is seen") {
  const auto causes = [](const zoo::Task& task, const Style& style) {
    std::string text;
    const Trace run = trace_of(head(task, style.number_format, "direct") + writes_alone(zoo::barycentric(task)), &text);
    for (const Cause& cause : check(run).causes)
      text += fmt::format("{}@{} ", cause.first.rule ? rule_text(*cause.first.rule).name : cause.first.field,
                          cause.first.step);
    return text;
  };
  std::string table;
  for (const char* mistake : {"", "depth_not_kept", "depth_always", "colour_beside", "centres_half_off",
                              "weights_exchanged", "inside_margin", "box_without_last_row", "weights_turned"}) {
    int seen = 0, found = 0;
    for (std::uint64_t seed = 1; seed <= 60 / test::sparse; ++seed) {
      CAPTURE(seed);
      const Style& style = styles[seed % styles.size()];
      zoo::Task task = random_task(seed);
      task.style = style.words;
      const std::string right = writes_alone(zoo::barycentric(task));
      task.mistake = mistake;
      if (task.mistake.empty()) {
        CHECK(causes(task, style) == "");
        continue;
      }
      if (right == writes_alone(zoo::barycentric(task))) continue;
      ++seen, found += !causes(task, style).empty();
    }
    table += fmt::format("{:<26}{:>4}{:>6}\n", mistake, seen, found);
    // Where polygons cross in a pixel, or only the last one is changed, rounding or the end of the run may be why.
    INFO(table);
    CHECK(10 * found >= (test::sparse > 1 ? 7 : 9) * seen);  // of fewer, luck has a larger share
  }
  MESSAGE("mistake, scenes in which it shows, found\n", table);
}

/// What is named where a program makes one that is not in the catalogue under its name; "" where none is.
std::string name_for(const std::string& mistake) {
  static const std::map<std::string, std::string> others{
      {"box_without_last_row", "box_too_small"},      {"one_line_up", "one_pixel_off"},
      {"centres_left_of_pixels", "centres_half_off"}, {"nearest_of_three", "depth_of_one_vertex"},
      {"term_left_out", "vertex_depth_twice"},        {"depth_not_kept", "buffer_reset"}};
  if (const auto found = others.find(mistake); found != others.end()) return found->second;
  return mistakes::mistake_called(mistake) ? mistake : "";
}

/// Wrong runs of a program: visit(mistake, scene, step at which it first differs, run, why a step cannot be).
template <class Visit>
void each_wrong_run(const DrawsByWeights& program, std::uint64_t scenes, Visit&& visit) {
  std::vector<zoo::Task> tasks;
  for (std::uint64_t seed = 1; seed <= scenes + 1; ++seed) {
    tasks.push_back(seed <= scenes ? random_task(seed) : ties());
    tasks.back().style = program.style(seed).words;
  }
  const std::vector<std::string> right = program.run(tasks);
  for (const char* mistake : program.mistakes) {
    for (zoo::Task& task : tasks) task.mistake = mistake;
    const std::vector<std::string> wrong = program.run(tasks);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const std::int64_t step = first_difference(right[i], wrong[i]);
      if (step == 0) continue;
      const std::uint64_t seed = i + 1;
      std::string impossible;
      const Trace run = trace_of(head(tasks[i], program.style(seed).number_format, "direct") + wrong[i], &impossible);
      visit(mistake, seed, step, run, impossible);
    }
  }
}

struct WrongFound {
  int wrong = 0, found = 0, at_first = 0;  ///< but for those of which check says that it has not judged all
};
WrongFound found_of(const DrawsByWeights& program, std::uint64_t scenes) {
  struct Row {
    int seen = 0, found = 0, told = 0, at_first = 0;
    std::string missed;
  };
  std::map<std::string, Row> rows;
  each_wrong_run(program, scenes,
                 [&](const std::string& mistake, std::uint64_t seed, std::int64_t step, const Trace& run,
                     const std::string& impossible) {
                   Row& row = rows[mistake];
                   ++row.seen;
                   const CheckReport report = check(run);
                   if (report.causes.empty() && impossible.empty()) {
                     // The end of a run may be cut off: what is missing there is listed as not judged.
                     row.told += verdict_of(report) != Verdict::right;
                     row.missed += fmt::format(" {}", seed);
                     return;
                   }
                   ++row.found;
                   // What is missing of a polygon is noticed where the next one begins, at the latest.
                   const auto shows =
                       run.next<PolygonBegin>(step, [](const PolygonBegin&) { return true; }).value_or(run.size());
                   row.at_first += report.causes.empty() ||
                                   (step <= report.causes[0].first.step && report.causes[0].first.step <= shows);
                 });
  std::string table;
  WrongFound all;
  for (const auto& [mistake, row] : rows) {
    table +=
        fmt::format("{:<26}{:>4}{:>6}{:>6}{:>6}{}\n", mistake, row.seen, row.found, row.at_first, row.told, row.missed);
    all.wrong += row.seen - row.told, all.found += row.found, all.at_first += row.at_first;
  }
  MESSAGE(program.name,
          ": mistake, scenes in which it shows, found, at its first step, listed as not judged, scenes in which it is "
          "missed\n",
          table);
  MESSAGE(all.found, " of ", all.wrong, " found that are not listed as not judged, ", all.at_first,
          " at the first step");
  return all;
}

TEST_CASE("zoo: a wrong program with barycentric weights is found, at the first pixel that it changes") {
  const WrongFound all = found_of(in_cpp, 40 / test::sparse);
  CHECK(all.found >= (test::sparse > 1 ? 0.95 : 0.98) * all.wrong);  // of fewer, luck has a larger share
  CHECK(all.at_first >= (test::sparse > 1 ? 0.9 : 0.95) * all.found);
}

struct WrongNamed {
  std::size_t mistakes = 0;                                         ///< with runs that are found wrong
  int seen = 0, in_catalogue = 0, right = 0, among = 0, wrong = 0;  ///< such runs
};
WrongNamed named_of(const DrawsByWeights& program, std::uint64_t scenes) {
  struct Row {
    int seen = 0, right = 0, among = 0, none = 0, wrong = 0;
    std::map<std::string, int> others;
  };
  std::map<std::string, Row> rows;
  each_wrong_run(program, scenes,
                 [&](const std::string& mistake, std::uint64_t, std::int64_t, const Trace& run, const std::string&) {
                   const CheckReport report = check(run);
                   if (report.causes.empty()) return;
                   const mistakes::Diagnosis likely = mistakes::diagnosis_of(run, report);
                   const std::string name = name_for(mistake);
                   std::string said;
                   bool is_among = false;
                   for (const mistakes::Mistake one : likely.either) {
                     const std::string_view id = mistakes::text_of(one).id;
                     said += fmt::format("{}{}", said.empty() ? "" : "|", id), is_among = is_among || id == name;
                   }
                   if (likely.also) said += fmt::format("+{}", mistakes::text_of(*likely.also).id), is_among = false;
                   Row& row = rows[mistake];
                   ++row.seen;
                   ++(said.empty() ? row.none : said == name ? row.right : is_among ? row.among : row.wrong);
                   if (!said.empty() && said != name) ++row.others[said];
                 });
  std::string table;
  WrongNamed all;
  all.mistakes = rows.size();
  for (const auto& [mistake, row] : rows) {
    table +=
        fmt::format("{:<26}{:>4}{:>6}{:>6}{:>6}{:>6}", mistake, row.seen, row.right, row.among, row.none, row.wrong);
    for (const auto& [said, times] : row.others) table += fmt::format("  {} {}", said, times);
    table += '\n';
    all.seen += row.seen, all.right += row.right, all.among += row.among, all.wrong += row.wrong;
    if (!name_for(mistake).empty()) all.in_catalogue += row.seen;
  }
  MESSAGE(program.name,
          ": mistake, runs found wrong, named, named beside others that give the same, not named, named wrongly\n",
          table);
  MESSAGE(all.right, " of ", all.seen, " named, ", all.among, " more beside others that give the same, ", all.wrong,
          " wrongly; ", all.in_catalogue, " are of mistakes in the catalogue");
  return all;
}

TEST_CASE("zoo: the mistake of a wrong program with barycentric weights is named") {
  const WrongNamed all = named_of(in_cpp, 40 / test::sparse);
  CHECK(all.mistakes >= (test::sparse > 1 ? 30 : 35));
  CHECK(all.right >= 0.8 * all.seen);
  CHECK(all.wrong <= 0.02 * all.seen);
}

TEST_CASE("zoo: wrong programs with barycentric weights in other languages are found, and their mistakes named") {
  for (const DrawsByWeights& program : in_other_languages()) {
    CAPTURE(program.name);
    const WrongFound found = found_of(program, 20 / test::sparse);
    CHECK(found.found >= 0.95 * found.wrong);
    CHECK(found.at_first >= 0.9 * found.found);
    const WrongNamed named = named_of(program, 20 / test::sparse);
    CHECK(named.mistakes >= (test::sparse > 1 ? 15 : 20));
    CHECK(named.right >= 0.8 * named.in_catalogue);
    CHECK(named.wrong <= 0.02 * named.seen);
  }
}

/// What a run leaves in its buffers.
mistakes::Seen picture_left_by(const Trace& run) {
  const Picture picture = formulas::end_of(run).picture;
  mistakes::Seen seen;
  seen.width = picture.width, seen.height = picture.height;
  seen.polygons = picture.polygon, seen.depths = picture.depth;
  return seen;
}

double roundoff_of(const Trace& run) {
  return run.header().conventions.number_format == NumberFormat::float32 ? 0x1p-24 : 0x1p-53;
}
void picture_is_right(const Trace& run) {
  const auto likeness = mistakes::likenesses(run.scene(), run.header(), roundoff_of(run), picture_left_by(run)).front();
  CHECK(likeness.differ == 0);
}

TEST_CASE("zoo: a right program's picture alone is not doubted") {
  int pictures = 0;
  each_right_run(in_cpp, 40 / test::sparse, [&](const Trace& run) { ++pictures, picture_is_right(run); });
  MESSAGE(pictures, " pictures");
}

TEST_CASE("zoo: right programs with barycentric weights in other languages are not doubted, nor is their picture") {
  for (const DrawsByWeights& program : in_other_languages()) {
    int runs = 0, whole = 0;
    each_right_run(program, 40 / test::sparse, [&](const Trace& run) {
      ++runs, whole += checked_as_right(run);
      picture_is_right(run);
    });
    CHECK(10 * whole > 7 * runs);
  }
}

TEST_CASE("zoo: a picture alone names the mistake of the program that drew it") {
  struct Row {
    int seen = 0, right = 0, among = 0, none = 0, wrong = 0;
    std::map<std::string, int> others;
  };
  std::map<std::string, Row> rows;
  each_wrong_run(
      in_cpp, 12 / test::sparse,
      [&](const std::string& mistake, std::uint64_t, std::int64_t, const Trace& run, const std::string& impossible) {
        if (!impossible.empty()) return;
        const auto found = mistakes::likenesses(run.scene(), run.header(), roundoff_of(run), picture_left_by(run));
        if (found.front().differ == 0) return;  // it does not show in the picture
        Row& row = rows[mistake];
        ++row.seen;
        // In a picture nothing tells a depth that is not kept from one that is not written.
        const std::string name = mistake == "depth_not_kept" ? "depth_not_written" : name_for(mistake);
        std::vector<std::string> said;
        for (std::size_t i = 1; i < found.size() && found[i].differ == 0; ++i) {
          std::string ids;
          for (const mistakes::Way& way : found[i].ways)
            ids += (ids.empty() ? "" : "+") + std::string(mistakes::text_of(way.mistake).id);
          if (std::find(said.begin(), said.end(), ids) == said.end()) said.push_back(ids);
        }
        const bool is_among = std::find(said.begin(), said.end(), name) != said.end();
        ++(said.empty() ? row.none : is_among && said.size() == 1 ? row.right : is_among ? row.among : row.wrong);
        if (!said.empty() && !(is_among && said.size() == 1))
          ++row.others[fmt::format("{} of {}", said.front(), said.size())];
      });
  std::string table;
  int seen = 0, right = 0, among = 0, wrong = 0;
  for (const auto& [mistake, row] : rows) {
    table +=
        fmt::format("{:<26}{:>4}{:>6}{:>6}{:>6}{:>6}", mistake, row.seen, row.right, row.among, row.none, row.wrong);
    for (const auto& [said, times] : row.others) table += fmt::format("  {}: {}", said, times);
    table += '\n';
    seen += row.seen, right += row.right, among += row.among, wrong += row.wrong;
  }
  MESSAGE("mistake, pictures in which it shows, named, named beside others that draw the same, not named, wrongly\n",
          table);
  MESSAGE(right, " of ", seen, " named, ", among, " more beside others that draw the same, ", wrong, " wrongly");
  CHECK(right + among >= 0.8 * seen);
  CHECK(wrong <= 0.05 * seen);
}

}  // namespace
