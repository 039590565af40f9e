// Names and materials of polygons: values like any others, which take memory only where they are not the usual ones.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "traces/scene.hpp"

using namespace zstep;

TEST_CASE("rare: a value like any other, the usual one takes no memory, however it came to be so") {
  Rare<std::string> name;
  CHECK(name.is_usual());
  CHECK(name->empty());
  name = std::string("A");
  CHECK(*name == "A");
  CHECK_FALSE(name.is_usual());
  Rare<std::string> copy = name;
  copy = std::string("B");
  CHECK(*name == "A");  // a copy is its own
  name = copy;
  CHECK(name == copy);
  const Rare<std::string> taken = std::move(copy);
  CHECK(*taken == "B");
  name = std::string();
  CHECK(name.is_usual());
  CHECK(name == Rare<std::string>());
  CHECK(Rare<std::string>("").is_usual());
  CHECK_FALSE(name == taken);
  Rare<std::string>& self = name;
  name = std::string("C");
  name = self;
  CHECK(*name == "C");
}

TEST_CASE("rare: polygons without a name and with the usual material are small, and equal where they look so") {
  CHECK(sizeof(Polygon) <= 24);
  Polygon one{"A", {1, 2, 3}, 4}, other = one;
  CHECK(one == other);
  other.material = Material{0.5};
  CHECK_FALSE(one == other);
  CHECK(other.material->opacity == 0.5);
  other.material = Material{};
  CHECK(one == other);
  CHECK(other.material.is_usual());
}
