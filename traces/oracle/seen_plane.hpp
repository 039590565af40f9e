// The plane of a facet as it is seen: where a run does not record its vertices, its depths are held against that.
#pragma once

#include <cstdint>
#include <optional>

#include "traces/conventions.hpp"
#include "traces/scene.hpp"

namespace zstep::oracle {

/// Found without rounding, then rounded once.
struct SeenPlane {
  double dz_dx = 0, dz_dy = 0;  ///< of the depth along the raster
  double bend = 0;              ///< by how much the depth of a corner is off the plane at most: of three corners, 0
};
/// Nothing where the plane is seen edge-on, has a corner in the plane of the eye, or where its depth is not linear on
/// the raster.
std::optional<SeenPlane> seen_plane(const Scene& scene, Conventions::Depth depth, std::int32_t facet);

}  // namespace zstep::oracle
