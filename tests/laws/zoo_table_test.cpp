// The zoo's table: programs, mistakes, scenes; what is detected, where, and by which name. For people: run it by
//   zstep_tests -tc="zoo: the table" -ns
#include <doctest/doctest.h>

#include <map>

#include <fmt/format.h>

#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"

using namespace zstep;
using test::ZooProgram;

namespace {

struct Table {
  std::string text = fmt::format("{:<20}{:<24}{:>6}{:>10}{:>10}  names that are given\n", "program", "mistake", "runs",
                                 "detected", "at step");
  int doubted = 0, wrong = 0, detected = 0, at_step = 0;

  void add(const char* what, const ZooProgram& program, const std::vector<Scene>& scenes, const std::string& mistake) {
    int runs = 0, found_in = 0, at_once = 0;
    std::map<std::string, int> names;
    for (const Scene& scene : scenes) {
      const test::Found found = test::found_in(program, scene, mistake);
      if (!mistake.empty() && !found.shows) continue;
      ++runs, found_in += found.detected, at_once += found.at_once;
      if (found.detected) ++names[found.name.empty() ? "none" : found.name];
    }
    std::string given;
    for (const auto& [name, times] : names) given += fmt::format("{}{} {}", given.empty() ? "" : ", ", name, times);
    text += fmt::format("{:<20}{:<24}{:>6}{:>10}{:>10}  {}\n", what, mistake.empty() ? "(right)" : mistake, runs,
                        found_in, at_once, given);
    if (mistake.empty()) doubted += found_in;
    else wrong += runs, detected += found_in, at_step += at_once;
  }
  template <class Mistakes>
  void add_all(const char* what, const ZooProgram& program, const std::vector<Scene>& scenes, const Mistakes& all) {
    for (const char* mistake : all) add(what, program, scenes, mistake);
  }
};

}  // namespace

TEST_CASE("zoo: the table" * doctest::skip()) {
  Table table;
  std::vector<Scene> scenes = test::scenes_of_edge_table();
  table.add("edge table", test::edge_table_program, scenes, "");
  table.add_all("edge table", test::edge_table_program, scenes, test::of_edge_table);
  table.add_all("edge table", test::edge_table_program, scenes, test::others_of_edge_table);
  if (test::there_is_python()) {
    ZooProgram python = test::edge_table_program;
    python.run = [](const zoo::Task& task) { return test::python("by_line.py", task); };
    table.add_all("by line (Python)", python, scenes,
                  std::vector{"", "last_line_in", "unsorted", "truncated", "begins_at_edge", "buffer_of_line_before"});
  }
  ZooProgram crossings = test::edge_table_program, half_planes = crossings;
  crossings.run = zoo::crossings, crossings.number_format = NumberFormat::float32, half_planes.run = zoo::half_planes;
  for (ZooProgram* program : {&crossings, &half_planes}) program->interpolation = Conventions::Interpolation::direct;
  table.add_all("crossings", crossings, scenes,
                std::vector{"", "both_ends_met", "z_along_x", "z_from_the_right", "z_of_the_line", "one_depth_off",
                            "farther_wins", "depth_kept", "colour_of_the_next"});
  scenes.pop_back();  // not triangles alone
  table.add_all("half-planes", half_planes, scenes,
                std::vector{"", "border_for_nobody", "border_for_all", "weights_turned", "or_equal", "half_the_depth"});
  for (const char* method : test::methods_with_mistakes)
    for (const test::WrongPrograms& wrong : test::wrong_programs(method)) {
      table.add(wrong.what, wrong.program, wrong.scenes, "");
      table.add_all(wrong.what, wrong.program, wrong.scenes, wrong.mistakes);
      table.add_all(wrong.what, wrong.program, wrong.scenes, wrong.others);
    }
  MESSAGE(fmt::format("\n{}{} of {} wrong runs are detected, {} at the first wrong step; {} right runs are doubted",
                      table.text, table.detected, table.wrong, table.at_step, table.doubted));
  CHECK(table.detected == table.wrong);
  CHECK(table.doubted == 0);
}
