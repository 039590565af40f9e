// Cutting an outline by a plane: the geometry alone, for pieces on the raster and for pieces in the world.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/pieces/plane.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/formulas/lines.hpp"
#include "traces/formulas/outlines.hpp"

namespace zstep::pieces {

struct Halves {
  clipping::Outline positive, negative;
};

/// Does an outline with corners at these distances go through the plane once each way, and touch it nowhere else? Any
/// convex one does that crosses it.
inline bool crosses_once(const std::vector<double>& distance) {
  int changes = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double before = distance[i > 0 ? i - 1 : distance.size() - 1], here = distance[i];
    const double after = distance[i + 1 < distance.size() ? i + 1 : 0];
    if (here == 0 && !(before * after < 0)) return false;
    if (here == 0 || here * after < 0) ++changes;
  }
  return changes == 2;
}

/// The parts of an outline on the two sides of a plane. `own` is the outline's plane and `bend` how far from it its
/// corners lie. `corner(vertex)` is where a vertex lies; `make(from, to, t, point)` makes the vertex at which the edge
/// from -> to crosses, t of the way along, and returns its index. Values of the plane within `tolerance` count as on
/// it; such a vertex belongs to both parts.
///
/// Where an outline crosses the plane more than twice, what is on one side hangs together by edges along the cut. What
/// they enclose beside the outline cancels by the even-odd rule, but only if the ends of all of them lie on one line.
/// Where two planes are almost parallel, a corner within the tolerance, or one that is off its own plane, can be far
/// from that line. So there each corner is taken as it lies in its own plane, and no value but 0 is on the other one.
template <class Corner, class Make>
Halves split(const clipping::Outline& outline, const Plane& own, double bend, const Plane& plane, double tolerance,
             Corner&& corner, Make&& make) {
  const double cosine = glm::dot(own.normal(), plane.normal());
  std::vector<double> distance, exact;
  for (const std::int32_t vertex : outline) {
    const glm::dvec3 point = corner(vertex);
    const double value = plane.value(point);
    distance.push_back(std::abs(value) <= tolerance ? 0 : value);
    exact.push_back(value - cosine * own.value(point));
  }
  if (bend > tolerance || !crosses_once(distance)) distance = std::move(exact);
  Halves halves;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = i + 1 < outline.size() ? i + 1 : 0;
    if (distance[i] >= 0) halves.positive.push_back(outline[i]);
    if (distance[i] <= 0) halves.negative.push_back(outline[i]);
    if (!((distance[i] > 0 && distance[next] < 0) || (distance[i] < 0 && distance[next] > 0))) continue;

    const bool down = distance[i] > 0;  // from the positive end, so that neighbours cut at the same point
    const std::size_t from = down ? i : next, to = down ? next : i;
    const double t = formulas::where_zero(distance[from], distance[to]);
    const glm::dvec3 start = corner(outline[from]), end = corner(outline[to]);
    const std::int32_t made = make(outline[from], outline[to], t, formulas::part_of_way(start, end, t));
    halves.positive.push_back(made);
    halves.negative.push_back(made);
  }
  return halves;
}

}  // namespace zstep::pieces
