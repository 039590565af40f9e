// Cutting an outline by a plane: the geometry alone, for pieces on the raster and for pieces in the world.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/pieces/plane.hpp"
#include "algorithms/viewing/clip.hpp"

namespace zstep::pieces {

struct Halves {
  clipping::Outline positive, negative;
};

/// The parts of an outline on the two sides of a plane. `corner(vertex)` is where a vertex lies; `make(from, to, t,
/// point)` makes the vertex at which the edge from -> to crosses, t of the way along, and returns its index. Values of
/// the plane within `tolerance` count as on it; such a vertex belongs to both parts.
template <class Corner, class Make>
Halves split(const clipping::Outline& outline, const Plane& plane, double tolerance, Corner&& corner, Make&& make) {
  std::vector<double> distance;
  for (const std::int32_t vertex : outline) {
    const double value = plane.value(corner(vertex));
    distance.push_back(std::abs(value) <= tolerance ? 0 : value);
  }
  Halves halves;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = i + 1 < outline.size() ? i + 1 : 0;
    if (distance[i] >= 0) halves.positive.push_back(outline[i]);
    if (distance[i] <= 0) halves.negative.push_back(outline[i]);
    if (!((distance[i] > 0 && distance[next] < 0) || (distance[i] < 0 && distance[next] > 0))) continue;

    const bool down = distance[i] > 0;  // from the positive end, so that neighbours cut at the same point
    const std::size_t from = down ? i : next, to = down ? next : i;
    const double t = distance[from] / (distance[from] - distance[to]);
    const glm::dvec3 start = corner(outline[from]), point = start + t * (corner(outline[to]) - start);
    const std::int32_t made = make(outline[from], outline[to], t, point);
    halves.positive.push_back(made);
    halves.negative.push_back(made);
  }
  return halves;
}

}  // namespace zstep::pieces
