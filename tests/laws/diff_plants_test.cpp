// Law: a mistake that a program makes once, and goes on from, is the first cause of what parts from the run without it;
// and, where it is more than rounding, of what is wrong in the run itself.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "tests/zoo/runs.hpp"
#include "tests/zoo/programs.hpp"
#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"

using namespace zstep;

namespace {

TEST_CASE("diff: of mistakes that are made once, a hundred of each sort, each is named as the first cause") {
  for (const char* mistake :
       {"slope_ulp", "swapped_vertex", "dropped_increment", "wrong_rounding", "missing_retirement"}) {
    int made = 0, named = 0, checked = 0;
    std::string unchecked;
    std::string missed;
    for (std::uint64_t seed = 1; made < 100 && seed < 400; ++seed) {
      zoo::Task task = test::triangles(seed, 4, 20);
      const std::string right = zoo::edge_table(task);
      task.mistake = mistake;
      task.nth = static_cast<int>(seed % 7);
      const std::string wrong = zoo::edge_table(task);
      const std::int64_t first = test::first_difference(right, wrong);
      if (first == 0) continue;
      ++made;
      const std::string head = test::head(task, "float64", "increments");
      const Trace without = test::trace_of(head + right);
      const Trace with = test::trace_of(head + wrong);
      const diff::DiffReport report = diff::compare(without, with);
      const bool here = !report.causes.empty() && test::is_at(report.causes.front(), without, report.alignment, without,
                                                              first, test::shown_at(with, first));
      named += here;
      // From the wrong run alone: at the mistake, or where it shows first.
      const CheckReport alone = check(with);
      const std::int64_t cause = alone.causes.empty() ? 0 : alone.causes.front().first.step;
      const bool by_check = first <= cause && cause <= test::shown_at(with, first);
      checked += by_check;
      if (!by_check) unchecked += fmt::format(" [seed {} step {}: {}]", seed, first, cause);
      if (!here && !report.causes.empty())
        missed += fmt::format(" [seed {} step {}: a {} b {}]", seed, first, report.causes[0].first.a,
                              report.causes[0].first.b);
    }
    CAPTURE(mistake);
    CAPTURE(missed);
    CHECK(made == 100);
    CHECK(named == made);
    CAPTURE(unchecked);
    const bool rounding = std::string_view(mistake) == "slope_ulp";  // no more than that
    CHECK(checked == (rounding ? 0 : made));
    MESSAGE(std::string(mistake), ": ", named, " of ", made, " by comparing, ", checked, " by check alone");
  }
}

TEST_CASE("diff: a mistake that is made once is one cause, and a line that an edge leaves too early is missed") {
  for (const char* mistake :
       {"swapped_vertex", "dropped_increment", "wrong_rounding", "missing_retirement", "early_retirement"}) {
    int made = 0, single = 0, checked = 0;
    std::string several;
    for (std::uint64_t seed = 1; made < 60 && seed < 400; ++seed) {
      zoo::Task task = test::triangles(seed, 4, 20);
      const std::string right = zoo::edge_table(task);
      task.mistake = mistake;
      task.nth = static_cast<int>(seed % 7);
      const std::string wrong = zoo::edge_table(task);
      if (test::first_difference(right, wrong) == 0) continue;
      ++made;
      const std::string head = test::head(task, "float64", "increments");
      const Trace with = test::trace_of(head + wrong);
      const diff::DiffReport report = diff::compare(test::trace_of(head + right), with);
      const auto count = std::count_if(report.causes.begin(), report.causes.end(),
                                       [](const diff::Cause& cause) { return cause.part == diff::Part::different; });
      single += count == 1;
      if (count != 1) several += fmt::format(" [seed {}: {}]", seed, count);
      checked += !check(with).causes.empty();
    }
    CAPTURE(std::string(mistake));
    CAPTURE(several);
    CHECK(made == 60);
    CHECK(single == made);
    // Where the last line of an edge has no pixel between it and the next one, nothing is missed.
    CHECK(checked >= (std::string_view(mistake) == "early_retirement" ? made / 2 : made));
  }
}

}  // namespace
