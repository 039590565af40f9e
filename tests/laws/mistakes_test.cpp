// Law: a mistake of the catalogue is named where a program makes it, another one never is, and a program that makes
// none is not said to.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"
#include "traces/grade/grade.hpp"
#include "traces/mistakes/name.hpp"

using namespace zstep;
using mistakes::Mistake;

namespace {

std::vector<zoo::Task> tasks() {
  return {test::triangles(3, 3, 18),
          test::triangles(6, 6, 22),
          test::triangles(11, 10, 26),
          test::triangles(20, 8, 34),
          test::triangles(31, 5, 40),
          test::ties(),
          test::concave()};
}

/// The text of lessons/NUMBER-NAME.md.
std::string lesson_called(const std::string& name) {
  for (const auto& entry : std::filesystem::directory_iterator(test::in_checkout("lessons"))) {
    const std::string file = entry.path().stem().string();
    if (file.substr(file.find('-') + 1) != name) continue;
    std::ifstream in(entry.path());
    return {std::istreambuf_iterator<char>(in), {}};
  }
  return {};
}

struct Program {
  std::string (*run)(const zoo::Task&) = zoo::edge_table;
  const char *number_format = "float64", *interpolation = "increments";
};

/// The name that a run of this program gets; "" where it gets none, "-" where the run is the right one's.
std::string named(zoo::Task task, const std::string& mistake, const Program& program = {}) {
  const std::string right = program.run(task);
  task.mistake = mistake;
  const std::string text = program.run(task);
  if (!mistake.empty() && test::first_difference(right, text) == 0) return "-";
  std::string impossible;
  const Trace run = test::trace_of(test::head(task, program.number_format, program.interpolation) + text, &impossible);
  const Trace reference = test::recorded_by("z-buffer", run.scene(), run.header().conventions);
  const grade::Judgement found = grade::judge(reference, run, {});
  const auto name = grade::mistake_in(run, found);
  return name ? test::named(*name) : "";
}

}  // namespace

TEST_CASE("mistakes: each has a text, and its id is the one that the code has for it") {
  std::set<std::string_view> ids;
  for (std::size_t k = 0; k < mistakes::mistake_count; ++k) {
    const mistakes::MistakeText& text = mistakes::text_of(static_cast<Mistake>(k));
    CAPTURE(text.id);
    CHECK(ids.insert(text.id).second);
    CHECK(mistakes::mistake_called(text.id) == static_cast<Mistake>(k));
    CHECK(text.name.ends_with('.'));
    CHECK(text.question.ends_with('?'));
    const std::string lesson = lesson_called(std::string(text.lesson));
    CHECK(lesson.find("\n## " + std::string(text.stop) + " {") != std::string::npos);
  }
  CHECK(ids.size() >= 40);
  CHECK(mistakes::text_of(Mistake::slope_inverted).id == "slope_inverted");
  CHECK(mistakes::text_of(Mistake::equal_wins).id == "equal_wins");
  CHECK(mistakes::text_of(Mistake::not_interpolated).id == "not_interpolated");
}

TEST_CASE("mistakes: a program of the zoo makes each of them, under its name") {
  // Other tests see to it that each of these is named in some scene.
  std::set<std::string_view> made(std::begin(test::of_edge_table), std::end(test::of_edge_table));
  for (const char* method : test::methods_with_mistakes)
    for (const test::WrongPrograms& wrong : test::wrong_programs(method))
      made.insert(wrong.mistakes.begin(), wrong.mistakes.end());
  for (std::size_t k = 0; k < mistakes::mistake_count; ++k) {
    const std::string_view id = mistakes::text_of(static_cast<Mistake>(k)).id;
    CAPTURE(id);
    CHECK(made.erase(id) == 1);
  }
  CHECK(made.empty());
}

TEST_CASE("mistakes: those of the Z-buffer are named as what they are") {
  int right = 0, none = 0, wrong = 0;
  std::string table;
  for (const char* mistake : test::of_edge_table) {
    std::map<std::string, int> names;
    for (const zoo::Task& task : tasks()) ++names[named(task, mistake)];
    CAPTURE(mistake);
    CHECK(names[mistake] > 0);
    for (const auto& [name, times] : names) {
      if (name == "-") continue;
      (name == mistake ? right : name.empty() ? none : wrong) += times;
      if (times > 0 && name != mistake)
        table += std::string("\n") + mistake + ": " + (name.empty() ? "no name" : name) + " " + std::to_string(times);
    }
  }
  MESSAGE(right, " of ", right + none + wrong, " named rightly, ", none, " not, ", wrong, " wrongly", table);
  CHECK(right >= 0.95 * (right + none + wrong));
}

TEST_CASE("mistakes: of two in one program the earlier one is named") {
  // The earlier one is the one whose first wrong step, alone, comes first; where both do at one step, either will do.
  int right = 0, none = 0, wrong = 0;
  std::string table;
  std::uint32_t turn = 0;
  for (const char* one : test::of_edge_table) {
    for (const char* other : test::of_edge_table) {
      turn = turn * 1664525 + 1013904223;
      if (std::string(one) >= other || turn >> 24 > 60) continue;
      zoo::Task task = tasks()[turn >> 8 & 3u];
      const std::string text = zoo::edge_table(task);
      std::int64_t shows[2];
      const char* const both[2] = {one, other};
      for (const int k : {0, 1}) {
        zoo::Task wrong_task = task;
        wrong_task.mistake = both[k];
        shows[k] = test::first_difference(text, zoo::edge_table(wrong_task));
      }
      if (shows[0] == 0 || shows[1] == 0) continue;
      const std::string name = named(task, std::string(one) + "+" + other);
      const bool is_right = (name == one && shows[0] <= shows[1]) || (name == other && shows[1] <= shows[0]);
      (is_right ? right : name.empty() ? none : wrong)++;
      if (!is_right) table += std::string("\n") + one + "+" + other + ": " + (name.empty() ? "no name" : name);
    }
  }
  MESSAGE(right, " of ", right + none + wrong, " pairs named rightly, ", none, " not, ", wrong, " wrongly", table);
  CHECK(right + none + wrong > 60);
  CHECK(right >= 0.85 * (right + none + wrong));
}

TEST_CASE("mistakes: two in one number are named together, where none does alone") {
  for (const auto& two : {std::pair("z_slope_of_x_inverted", "slope_inverted+z_slope_of_x"),
                          {"z_at_vertex+z_not_swapped", "z_not_swapped+z_at_vertex"}}) {
    const char *const made = two.first, *const name = two.second;
    CAPTURE(std::string(made));
    std::map<std::string, int> names;
    for (const zoo::Task& task : tasks()) ++names[named(task, made)];
    std::string table;
    for (const auto& [one, times] : names) table += "\n" + one + ": " + std::to_string(times);
    MESSAGE(std::string(made), table);
    const std::string both = name, one = both.substr(0, both.find('+')), other = both.substr(both.find('+') + 1);
    const int right = names[both] + names[other + "+" + one];
    CHECK(right >= 3);
    const int one_of_two = names[one] + names[other];
    CHECK(right + one_of_two + names["-"] + names[""] == static_cast<int>(tasks().size()));
  }
}

TEST_CASE("mistakes: a right program makes none, and of one that is not in the catalogue no name is given") {
  for (const zoo::Task& task : tasks()) CHECK(named(task, "").empty());
  int seen = 0, wrongly = 0;
  std::string table;
  for (const char* mistake : test::others_of_edge_table) {
    for (const zoo::Task& task : tasks()) {
      const std::string name = named(task, mistake);
      seen += name != "-";
      if (name == "-" || name.empty()) continue;
      ++wrongly;
      table += std::string("\n") + mistake + ": " + name;
    }
  }
  MESSAGE(wrongly, " of ", seen, " runs with other mistakes get a name", table);
  CHECK(seen > 30);
  CHECK(wrongly == 0);
}

TEST_CASE("mistakes: programs that print less are treated alike") {
  const Program crossings{zoo::crossings, "float32", "direct"}, half_planes{zoo::half_planes, "float64", "direct"};
  struct Wrong {
    const Program& program;
    const char *mistake, *name;  ///< "" where the catalogue does not have it
  };
  std::string table;
  for (const Wrong& one : {Wrong{crossings, "farther_wins", "compare_reversed"}, Wrong{crossings, "", ""},
                           Wrong{crossings, "z_along_x", ""}, Wrong{crossings, "z_from_the_right", ""},
                           Wrong{crossings, "z_of_the_line", ""}, Wrong{crossings, "one_depth_off", ""},
                           Wrong{crossings, "colour_of_the_next", ""}, Wrong{crossings, "both_ends_met", ""},
                           Wrong{half_planes, "or_equal", "equal_wins"}, Wrong{half_planes, "", ""},
                           Wrong{half_planes, "border_for_nobody", ""}, Wrong{half_planes, "border_for_all", ""},
                           Wrong{half_planes, "weights_turned", ""}, Wrong{half_planes, "half_the_depth", ""}}) {
    int as_it_is = 0;
    for (const zoo::Task& task : tasks()) {
      if (one.program.run == zoo::half_planes && task.polygons.front().corners.size() > 3) continue;
      const std::string name = named(task, one.mistake, one.program);
      if (name == "-") continue;
      as_it_is += name == one.name;
      if (name != one.name) table += std::string("\n") + one.mistake + ": " + (name.empty() ? "no name" : name);
    }
    CAPTURE(std::string(one.mistake));
    CHECK(as_it_is > 0);
  }
  CHECK_MESSAGE(table.empty(), table);
}
