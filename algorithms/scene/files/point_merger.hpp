// Equal points become one, so that polygons given by their coordinates share their vertices.
#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <unordered_map>

#include "algorithms/scene/files/polygon_soup.hpp"

namespace zstep::scene {

/// Seeded anew each time: a file cannot be made so that its points collide. The indices do not depend on the seed.
struct PointHash {
  std::uint64_t seed = std::random_device{}();
  std::size_t operator()(const glm::dvec3& point) const {
    std::uint64_t hash = seed;
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &point[axis], sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

class PointMerger {
 public:
  /// The index of `point` in the soup, which gets it if it is new. Equal means equal in every bit, but -0 is 0.
  template <class Where>
  std::int64_t add(PolygonSoup& soup, glm::dvec3 point, std::int32_t line, Where&& where) {
    point += 0.0;
    const auto [entry, is_new] = index_.try_emplace(point, static_cast<std::int32_t>(soup.points.size()));
    if (is_new) soup.add_point(point, line, where);
    return entry->second;
  }

 private:
  std::unordered_map<glm::dvec3, std::int32_t, PointHash> index_;
};

}  // namespace zstep::scene
