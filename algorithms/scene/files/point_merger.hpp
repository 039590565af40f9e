// Equal points become one, so that polygons given by their coordinates share their vertices.
#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "algorithms/scene/files/polygon_soup.hpp"

namespace zstep::scene {

/// A hash table of the points of one soup.
class PointMerger {
 public:
  /// The index of `point` in the soup, which gets it if it is new; always the same soup. Equal means equal in every
  /// bit, but -0 is 0.
  template <class Where>
  std::int64_t add(PolygonSoup& soup, glm::dvec3 point, std::int32_t line, Where&& where) {
    point += 0.0;
    if (2 * (count_ + 1) > slots_.size()) grow(soup);
    std::int32_t& slot = slots_[place_of(soup, point)];
    if (slot < 0) {
      soup.add_point(point, line, where);
      slot = static_cast<std::int32_t>(soup.points.size()) - 1;
      ++count_;
    }
    return slot;
  }

 private:
  // The slot that holds the point, or the empty one where it belongs.
  std::size_t place_of(const PolygonSoup& soup, const glm::dvec3& point) const {
    std::uint64_t hash = seed_;
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &point[axis], sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 32;
    }
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = static_cast<std::size_t>(hash) & mask;
    while (slots_[place] >= 0 && soup.points[static_cast<std::size_t>(slots_[place])] != point)
      place = (place + 1) & mask;
    return place;
  }

  void grow(const PolygonSoup& soup) {
    const std::vector<std::int32_t> old = std::move(slots_);
    slots_.assign(old.empty() ? 64 : 2 * old.size(), -1);
    for (const std::int32_t index : old)
      if (index >= 0) slots_[place_of(soup, soup.points[static_cast<std::size_t>(index)])] = index;
  }

  std::vector<std::int32_t> slots_;  // indices into the soup's points, -1 where empty; at least half of them are
  std::size_t count_ = 0;
  // Anew each time, so that no file can be made whose points all meet in one slot. The indices do not depend on it.
  std::uint64_t seed_ = std::random_device{}();
};

}  // namespace zstep::scene
