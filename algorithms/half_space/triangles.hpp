// An outline on the raster as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/scene/builder.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/formulas/edge_functions.hpp"

namespace zstep::half_space {

using Corners = std::array<std::int32_t, 3>;

/// Are all turns of an outline of n vertices, and all triangles of the fan, the same way round? An outline that goes
/// round more than once has others in its fan. `at(i)`: where the i-th vertex is on the raster.
template <class At>
bool is_convex(std::size_t n, At&& at) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < n; ++i) {
    const auto p = at(0), q = at(i), r = at((i + 1) % n), s = at((i + 2) % n);
    const double turned = formulas::twice_area(q.x, q.y, r.x, r.y, s.x, s.y);
    const double of_fan = i > 0 && i + 1 < n ? formulas::twice_area(p.x, p.y, q.x, q.y, r.x, r.y) : 0;
    left = left || turned > 0 || of_fan > 0, right = right || turned < 0 || of_fan < 0;
    if (left && right) return false;
  }
  return true;
}

class Triangulation {
 public:
  /// Indices of vertices, three by three: a fan where the outline is convex, else its ears. No vertex is added.
  const std::vector<Corners>& cut(const clipping::Outline& outline, const viewing::Vertices& vertices);
  /// May a pixel lie in several of them, or in none though it is covered by some? Only where the outline is not convex.
  bool may_overlap() const { return !convex_; }

 private:
  bool convex_ = true;
  scene::EarClipper clipper_;
  std::vector<Corners> triangles_;
};

}  // namespace zstep::half_space
