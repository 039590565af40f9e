// The zoo's table: programs, mistakes, scenes; what is detected, where, and by which name. For people: run it by
//   zstep_tests -tc="zoo: the table" -ns
// The totals, and what they must be at least, come last.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "tests/sparse.hpp"
#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"

using namespace zstep;
using test::ZooProgram;

namespace {

/// What a program is told to make, and the name in the catalogue that this is to get; "" for none.
struct Wrong {
  const char *mistake, *id;
  bool at_once = false, in_all = false;  ///< at its first wrong step, and so in all scenes but one
};

struct Table {
  std::string text = fmt::format("{:<32}{:<24}{:>6}{:>10}{:>10}{:>9}  names that are given\n", "program", "mistake",
                                 "runs", "detected", "at step", "rightly");
  struct Total {
    std::set<std::string> mistakes;  ///< of the catalogue by their ids, others by their own names
    int runs = 0, detected = 0, at_step = 0, rightly = 0, wrongly = 0;
    std::string share(int of) const { return fmt::format("{} of {} ({:.1f} %)", of, runs, 100.0 * of / runs); }
  };
  Total known, others;  ///< of the catalogue, and not
  int right_programs = 0, right_runs = 0, full_marks = 0, doubted = 0;

  void add_right(const char* what, const ZooProgram& program, const std::vector<Scene>& scenes) {
    CAPTURE(std::string(what));
    CHECK(scenes.size() >= 5);
    int full = 0, in_doubt = 0;
    for (const Scene& scene : scenes) {
      const test::Found found = test::found_in(program, scene, "");
      full += found.full_marks, in_doubt += found.detected || !found.name.empty();
    }
    const int runs = static_cast<int>(scenes.size());
    text += fmt::format("{:<32}{:<24}{:>6}{:>10}\n", what, "(right)", runs, in_doubt);
    ++right_programs, right_runs += runs, full_marks += full, doubted += in_doubt;
  }

  void add(const char* what, const ZooProgram& program, const std::vector<Scene>& scenes, const Wrong& wrong) {
    Total row;
    std::map<std::string, int> names;
    for (const Scene& scene : scenes) {
      const test::Found found = test::found_in(program, scene, wrong.mistake);
      if (!found.shows) continue;
      ++row.runs, row.detected += found.detected, row.at_step += found.at_once;
      (found.name == wrong.id ? row.rightly : row.wrongly)++;
      ++names[found.name.empty() ? "none" : found.name];
    }
    std::string given;
    for (const auto& [name, times] : names) given += fmt::format("{}{} {}", given.empty() ? "" : ", ", name, times);
    text += fmt::format("{:<32}{:<24}{:>6}{:>10}{:>10}{:>9}  {}\n", what, wrong.mistake, row.runs, row.detected,
                        row.at_step, row.rightly, given);
    CAPTURE(std::string(what));
    CAPTURE(std::string(wrong.mistake));
    CHECK(row.rightly > 0);
    if (wrong.in_all) CHECK(row.rightly >= row.runs - 1);
    if (wrong.at_once) CHECK(row.at_step >= std::max(3, row.runs - 1));
    const bool is_known = wrong.id[0] != '\0';
    Total& total = is_known ? known : others;
    total.mistakes.insert(is_known ? wrong.id : std::string(what) + ", " + wrong.mistake);
    total.runs += row.runs, total.detected += row.detected, total.at_step += row.at_step;
    total.rightly += row.rightly, total.wrongly += row.wrongly;
  }
  void add_all(const char* what, const ZooProgram& program, const std::vector<Scene>& scenes,
               const std::vector<Wrong>& all) {
    add_right(what, program, scenes);
    for (const Wrong& one : all) add(what, program, scenes, one);
  }
};

template <class Named, class Others>
std::vector<Wrong> rows(const Named& named, const Others& others, bool at_once = false, bool in_all = false) {
  std::vector<Wrong> all;
  for (const char* mistake : named) all.push_back({mistake, mistake, at_once, in_all});
  for (const char* mistake : others) all.push_back({mistake, "", at_once, in_all});
  return all;
}

/// Z-buffers that are built otherwise; all of them are right.
void add_other_builds(Table& table, const std::vector<Scene>& scenes) {
  using enum NumberFormat;
  for (const char* style : {"rows crossings span", "rows edge_functions weights", "upwards crossings weights",
                            "upwards edge_functions plane", "columns crossings plane", "quarters edge_functions plane",
                            "pixels crossings span"})
    table.add_right(style, {"z-buffer", zoo::variants, style}, scenes);
  for (const char* style : {"float32 rows crossings span", "float32 quarters edge_functions weights"})
    table.add_right(style, {"z-buffer", zoo::variants, style, {}, false, true, float32}, scenes);
  for (const auto& [format, bits] : {std::pair(fixed16, "16"), {fixed20, "20"}, {fixed24, "24"}})
    table.add_right(bits, {"z-buffer", zoo::fixed_point, bits, {}, false, true, format}, scenes);
}

}  // namespace

TEST_CASE("zoo: the table") {
  if (test::sparse > 1) return;  // it counts, and the tests of each method run the same programs under sanitizers
  Table table;
  std::vector<Scene> scenes = test::scenes_of_edge_table();
  table.add_all("edge table", test::edge_table_program, scenes, rows(test::of_edge_table, test::others_of_edge_table));
  for (const Wrong& one : {Wrong{"x_y_read_exchanged", "x_y_exchanged"}, {"colour_one_to_the_right", "colour_beside"}})
    table.add("edge table", test::edge_table_program, scenes, one);
  if (test::there_is_python()) {
    ZooProgram python = test::edge_table_program;
    python.run = [](const zoo::Task& task) { return test::printed_by_file("by_line.py", task); };
    // It prints compares alone: what a span does wrong shows by pixels that are missing, or too many.
    table.add_all("by line (Python)", python, scenes,
                  {{"last_line_in", ""},
                   {"unsorted", ""},
                   {"truncated", ""},
                   {"begins_at_edge", ""},
                   {"buffer_of_line_before", "buffer_of_one_line"}});
  }
  ZooProgram crossings = test::edge_table_program, half_planes = crossings;
  crossings.run = zoo::crossings, crossings.number_format = NumberFormat::float32, half_planes.run = zoo::half_planes;
  for (ZooProgram* program : {&crossings, &half_planes}) program->interpolation = Conventions::Interpolation::direct;
  table.add_all("crossings", crossings, scenes,
                {{"both_ends_met", ""},
                 {"z_along_x", ""},
                 {"z_from_the_right", ""},
                 {"z_of_the_line", ""},
                 {"one_depth_off", ""},
                 {"farther_wins", "compare_reversed"},
                 {"depth_kept", "buffer_reset"},
                 {"colour_of_the_next", "colour_of_next"}});
  scenes.pop_back();  // not triangles alone
  table.add_all("half-planes", half_planes, scenes,
                {{"border_for_nobody", "border_for_nobody"},
                 {"border_for_all", "border_for_both"},
                 {"weights_turned", "weights_turned"},
                 {"or_equal", "equal_wins"},
                 {"half_the_depth", ""}});
  add_other_builds(table, scenes);
  for (const char* method : test::methods_with_mistakes)
    for (const test::WrongPrograms& wrong : test::wrong_programs(method))
      table.add_all(wrong.what, wrong.program, wrong.scenes, rows(wrong.mistakes, wrong.others, wrong.at_once, true));
  const test::PairsNamed pairs = test::pairs_of_edge_table();
  const Table::Total &known = table.known, &others = table.others;
  MESSAGE(fmt::format("\n{}\n"
                      "{} mistakes of the catalogue: detected {}, at the first wrong step {}, named rightly {}\n"
                      "{} pairs of two mistakes: the earlier one is named in {} ({:.1f} %), none in {}, another in {}\n"
                      "{} right programs, {} runs: full marks {}, doubted {}\n"
                      "{} mistakes that are not in the catalogue: detected {}, without a name {}",
                      table.text, known.mistakes.size(), known.share(known.detected), known.share(known.at_step),
                      known.share(known.rightly), pairs.all(), pairs.right, 100.0 * pairs.right / pairs.all(),
                      pairs.none, pairs.wrong, table.right_programs, table.right_runs, table.full_marks, table.doubted,
                      others.mistakes.size(), others.share(others.detected), others.share(others.rightly)),
          pairs.others);
  CHECK(known.mistakes.size() >= 40);
  CHECK(known.detected == known.runs);
  CHECK(known.at_step >= 0.95 * known.runs);
  CHECK(known.rightly >= 0.95 * known.runs);
  CHECK(pairs.all() > 60);
  CHECK(pairs.right >= 0.85 * pairs.all());
  CHECK(table.right_programs >= 20);
  CHECK(table.full_marks == table.right_runs);
  CHECK(table.doubted == 0);
  CHECK(others.mistakes.size() >= 10);
  CHECK(others.detected == others.runs);
  CHECK(others.rightly == others.runs);
}
