// A threshold is looked for between samples, and is called the one only where all that was measured agrees.
#include "sim/cost/growth.hpp"

#include <doctest/doctest.h>

using namespace zstep::compare;

namespace {

Threshold found(const std::vector<double>& at, const std::function<std::int64_t(double)>& wrong_at) {
  std::vector<Sample> samples;
  for (const double place : at) samples.push_back({place, wrong_at(place)});
  return threshold_of(samples, wrong_at);
}

TEST_CASE("threshold: between two samples, to a thousandth, whichever way they go") {
  const auto below = [](double at) { return std::int64_t{at < 0.75}; };
  for (const auto& samples : {std::vector<double>{10, 1, 0.4, 0.1}, {3, 2, 0.01}}) {
    const Threshold begins = found(samples, below);
    CHECK(begins.kind == Threshold::Kind::found);
    CHECK(begins.at < 0.75);
    CHECK(begins.at > 0.749);
    CHECK_FALSE(begins.fall);
  }
  const Threshold above = found({1, 10, 100}, [](double at) { return std::int64_t{at > 42}; });
  CHECK(above.at > 42);
  CHECK(above.at < 42.05);
}

TEST_CASE("threshold: nowhere, and already at the first sample") {
  CHECK(found({3, 2, 1}, [](double) { return 0; }).kind == Threshold::Kind::none);
  const Threshold all = found({3, 2, 1}, [](double) { return 7; });
  CHECK(all.kind == Threshold::Kind::everywhere);
  CHECK(all.at == 3);
}

TEST_CASE("threshold: where less is wrong farther on, among the samples or between them, it is said") {
  const auto bands = [](double at) { return std::int64_t{at > 4 && at < 5 ? 9 : at < 1}; };
  const Threshold seen = found({8, 4.5, 3, 0.5}, bands);
  REQUIRE(seen.fall);
  CHECK(seen.fall->from.at > seen.fall->to.at);
  CHECK(seen.at > 4.99);
  const Threshold between = found({8, 0.5}, bands);  // 4.25 is looked at on the way
  CHECK(between.fall);
  CHECK_FALSE(found({8, 2, 0.5}, bands).fall);
}

}  // namespace
