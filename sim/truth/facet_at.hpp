// One facet at one pixel: what of the brute force of truth.hpp a question about a single polygon needs.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/truth/truth.hpp"

namespace zstep::compare {

/// One facet at one pixel's centre, whether it covers it or not.
struct FacetAt {
  Candidate candidate;
  bool in_square = false;  ///< a part of it that has an area lies in the pixel's square, |dx| <= 1/2 and |dy| <= 1/2
};
/// nullopt if nothing of the facet may be drawn: facing away where `cull`, without area, wholly before near or beyond
/// far. Looks at this facet only.
std::optional<FacetAt> facet_at(const Scene& scene, std::int32_t facet, bool cull, std::int32_t x, std::int32_t y);

/// z_v (a screen scene's own z) at which the line of sight through a pixel's centre meets a facet inside its outline,
/// near and far plane and facing left aside; negative behind the eye. nullopt if it misses it or runs along its plane.
std::optional<double> depth_on_sight(const Scene& scene, std::int32_t facet, std::int32_t x, std::int32_t y);

}  // namespace zstep::compare
