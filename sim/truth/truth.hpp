// What is visible at each pixel's centre, found by brute force and without any code of the methods: every facet is
// taken from the world to the raster in long double, and its plane is met by the line of sight.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::compare {

/// Within this distance of an edge, in pixels, a facet may count as covering a centre or not: 1.5/256, the rule's
/// measure.
inline constexpr double edge_tolerance = 1.5 / 256;

/// A facet at a pixel whose centre it covers, or has an edge within edge_tolerance of.
struct Candidate {
  std::int32_t facet = 0, polygon = 0;
  double z = 0;        ///< z_v of its plane on the line of sight through the centre (a screen scene's own z)
  double z_slack = 0;  ///< by how much z is unsure, since corners of planar polygons lie off their plane by up to 1e-5
  double slope = 0;    ///< by how much z changes over one pixel at most
  double edge = 0;  ///< pixels from the centre to the facet's nearest edge, edges made by near and far plane included
  bool covers = false;   ///< the centre is inside
  bool edge_on = false;  ///< seen from the side: its plane says nothing about depth, and z is its nearest corner's

  /// Covers the centre whatever the rounding.
  bool sure() const { return covers && edge > edge_tolerance; }
};

/// The candidates of the pixels of a scene. Facets facing away are left out if `cull` is set, as are those without
/// corners or, in space, without area.
class Truth {
 public:
  /// `wanted` [height*width] says at which pixels; at all of them if it is empty. `non_zero`: by that rule, and not by
  /// the even-odd one, a centre is inside.
  Truth(const Scene& scene, bool cull, std::span<const std::uint8_t> wanted = {}, bool non_zero = false);

  /// The candidates at a pixel that was wanted, nearest first; of equal depths the facet drawn first.
  std::span<const Candidate> at(std::int32_t x, std::int32_t y) const;

  /// The polygon of the nearest facet that covers the centre, no_polygon if there is none.
  std::int32_t nearest(std::int32_t x, std::int32_t y) const;

  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }

 private:
  std::int32_t width_ = 0, height_ = 0;
  std::vector<std::int32_t> place_;  ///< [height*width], where in candidates_; -1 where it is not wanted
  std::vector<std::vector<Candidate>> candidates_;
};

}  // namespace zstep::compare
