// Scenes made from a seed, one for each student, and how hard they are.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "traces/file/trace.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

struct Range {
  std::int64_t least = 0, most = 0;
  bool holds(std::int64_t number) const { return number >= least && number <= most; }
};

/// How a scene is made, and how hard it may be: [[scene]] generate = … of homework.toml.
struct Generator {
  enum class What : std::uint8_t { triangles, polygons };
  What what = What::triangles;
  Range count{2, 2}, width{14, 14}, height{12, 12};
  Range corners{4, 6};  ///< of each polygon, where they are no triangles
  Range steps, losing, crossing;
  std::int32_t tries = 0;  ///< seeds
};

/// How hard a run is to get right, in what happens in it.
struct Difficulty {
  std::int64_t steps = 0;
  std::int64_t losing = 0;       ///< compares that lose
  std::int64_t crossing = 0;     ///< spans in which some pixels win over another polygon's, and some lose
  std::set<std::uint8_t> kinds;  ///< of events that appear
};
Difficulty difficulty_of(const Trace& run);

/// A scene file. The same seed gives the same on every machine: whole numbers, and coordinates in quarters.
std::string generated_scene(const Generator& generator, const std::string& name, std::uint64_t seed);

}  // namespace zstep::homework
