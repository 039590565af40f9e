// Which decisions rounding turned, and what of a run its own mistakes are; what is stored is held against exact depths.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "tests/zoo/runs.hpp"
#include "traces/oracle/errors.hpp"

using namespace zstep;

namespace {

/// Triangles over each other, one of this depth for each.
zoo::Task over_each_other(std::initializer_list<double> depths) {
  zoo::Task task;
  task.width = 12, task.height = 10;
  for (const double z : depths) {
    const int first = static_cast<int>(task.points.size());
    for (const auto& [x, y] : {std::pair(1.0, 1.0), {10.5, 2.0}, {4.0, 8.5}}) task.points.push_back({x, y, z});
    task.polygons.push_back({static_cast<int>(task.polygons.size()), {first, first + 1, first + 2}});
  }
  return task;
}

std::string printed(const zoo::Task& task) { return test::head(task, "float64", "direct") + zoo::edge_table(task); }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()), ++found)
    text.replace(at, what.size(), by);
  REQUIRE(found > 0);
  return text;
}

TEST_CASE("error: a decision against the run's own numbers is a mistake, and no decision that rounding turned") {
  // B is in front of A everywhere and takes each pixel; now one compare says that it does not.
  const std::string right = printed(over_each_other({0.75, 0.25}));
  const std::string front = "\"z\":0.25,\"nearer\":true";
  std::string wrong = right;
  REQUIRE(wrong.find(front) != std::string::npos);
  const std::size_t at = wrong.find(front);
  wrong.replace(at, front.size(), "\"z\":0.25,\"nearer\":false");
  for (const char* writes : {"{\"step\":\"wz\"", "{\"step\":\"wp\""}) {  // and nothing is written there
    const std::size_t from = wrong.find(writes, at);
    wrong.erase(from, wrong.find('\n', from) + 1 - from);
  }
  const oracle::Errors errors = oracle::errors_of(test::trace_of(wrong));
  CHECK(errors.compares > 10);
  CHECK(errors.all.decided_wrong == 0);
  CHECK(errors.wrong_pixels == 0);
  CHECK(errors.left_open == 0);
}

TEST_CASE(
    "error: what is nearer and what wins a tie is asked of the header, and of what it leaves open nothing is said") {
  const std::string declared = "\"nearer\":\"smaller\",\"ties\":\"first\",";
  // The greater depth wins, by the program and not by the header: it says nothing.
  std::string greater = replaced(printed(over_each_other({0.75, 0.25})), declared, "");
  greater = replaced(greater, "\"z\":\"inf\"", "\"z\":0");
  greater = replaced(greater, "\"z\":0.25,\"nearer\":true", "\"z\":0.25,\"nearer\":false");
  CHECK(oracle::errors_of(test::trace_of(greater)).all.decided_wrong == 0);
  CHECK(oracle::errors_of(test::trace_of(greater)).wrong_pixels == 0);
  // The last of equal depths wins, and the header says nothing, or something else.
  const std::string last = replaced(printed(over_each_other({0.5, 0.5})), "\"nearer\":false", "\"nearer\":true");
  for (const std::string& ties : {std::string("\"nearer\":\"smaller\",\"ties\":\"last\","), declared,
                                  std::string("\"nearer\":\"smaller\","), std::string()}) {
    CAPTURE(ties);
    const oracle::Errors errors = oracle::errors_of(test::trace_of(replaced(last, declared, ties)));
    CHECK(errors.compares > 10);
    CHECK(errors.all.decided_wrong == 0);
    CHECK(errors.left_open == 0);
    CHECK(errors.wrong_pixels == 0);
  }
}

/// Two planes that differ by less than float64 holds once they are interpolated: the second is nearer everywhere.
std::string hardly_apart(std::size_t corners_apart = 3) {
  zoo::Task task;
  task.width = 24, task.height = 20;
  task.points = {{1.125, 1.375, 0.3}, {22.625, 2.25, 0.7}, {9.5, 18.875, 0.9}};
  for (const zoo::Point& p : std::vector<zoo::Point>(task.points))
    task.points.push_back({p.x, p.y, task.points.size() < 3 + corners_apart ? std::nextafter(p.z, 0.0) : p.z});
  task.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}};
  return test::head(task, "float64", "increments") + zoo::edge_table(task);
}

TEST_CASE("error: equal depths that are not equal exactly are left open where the header does not say what is nearer") {
  const std::string run = hardly_apart(), declared = "\"nearer\":\"smaller\",\"ties\":\"first\",";
  const oracle::Errors known = oracle::errors_of(test::trace_of(run));
  CHECK(known.left_open == 0);
  std::int64_t ties = 0, turned = 0;
  for (const oracle::WrongDecision& wrong : known.decisions) (wrong.z == wrong.stored ? ties : turned) += 1;
  REQUIRE(std::ssize(known.decisions) == known.all.decided_wrong);
  REQUIRE(ties > 0);
  const oracle::Errors open = oracle::errors_of(test::trace_of(replaced(run, declared, "")));
  CHECK(open.all.decided_wrong == turned);  // whatever is nearer: the two are exactly the other way round
  CHECK(open.left_open == ties);
  CHECK(open.wrong_pixels == 0);
  // That equal is not nearer follows from the decision itself.
  CHECK(oracle::errors_of(test::trace_of(replaced(run, declared, "\"nearer\":\"smaller\","))).all.decided_wrong ==
        known.all.decided_wrong);
}

TEST_CASE("error: exact depths that differ are told apart by their digits") {
  const oracle::Errors errors = oracle::errors_of(test::trace_of(hardly_apart()));
  REQUIRE(!errors.decisions.empty());
  int alike = 0;
  for (const oracle::WrongDecision& wrong : errors.decisions) {
    CHECK(wrong.z_digits != wrong.stored_digits);
    CHECK(std::stod(wrong.z_digits) == doctest::Approx(wrong.z_exact).epsilon(1e-15));
    CHECK(std::stod(wrong.stored_digits) == doctest::Approx(wrong.stored_exact).epsilon(1e-15));
    alike += wrong.z_exact == wrong.stored_exact;
  }
  CHECK(alike > 0);
  // Far from the one corner that is apart 17 digits do not do.
  std::size_t longest = 0;
  for (const oracle::WrongDecision& wrong : oracle::errors_of(test::trace_of(hardly_apart(1))).decisions) {
    CHECK(wrong.z_digits != wrong.stored_digits);
    longest = std::max(longest, wrong.z_digits.size());
  }
  CHECK(longest > 25);
}

TEST_CASE("error: what is stored is held against the exact depth, and not what was computed before") {
  const std::string right = printed(over_each_other({0.75, 0.25}));
  const oracle::Errors none = oracle::errors_of(test::trace_of(right));
  CHECK(none.stored_not_finite == 0);
  for (const std::string stored : {"\"nan\"", "\"-inf\"", "0.375"}) {
    CAPTURE(stored);
    std::string wrong = right;
    std::int64_t writes = 0;
    for (std::size_t at = wrong.find("{\"step\":\"wz\""); at != std::string::npos;
         at = wrong.find("{\"step\":\"wz\"", at + 1), ++writes) {
      const std::size_t z = wrong.find("\"z\":", at) + 4;
      wrong.replace(z, wrong.find('}', z) - z, stored);
    }
    REQUIRE(writes > 10);
    const oracle::Errors errors = oracle::errors_of(test::trace_of(wrong));
    CHECK(errors.all.largest == 0);
    CHECK(errors.stored_not_finite == (stored == "0.375" ? 0 : writes));
    CHECK((errors.stored_not_finite_step > 0) == (stored != "0.375"));
    double least = INFINITY;
    for (const double off : errors.depth_error_of_pixel)
      if (!std::isnan(off)) least = std::min(least, std::abs(off));
    CHECK(least == (stored == "0.375" ? 0.125 : INFINITY));
    CHECK(std::count_if(errors.depth_error_of_pixel.begin(), errors.depth_error_of_pixel.end(),
                        [](double off) { return !std::isnan(off); }) > 10);
  }
}

}  // namespace
