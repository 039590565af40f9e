// Casts a ray through each pixel's centre with Intel's Embree.
#pragma once

#include <string>

#include "traces/scene.hpp"

namespace zstep::test {

/// The polygon that Embree finds first on each pixel's ray between near and far plane, and its z_v. Facets facing away
/// are drawn. Embree computes in float32. Not for screen scenes. Throws std::runtime_error if Embree fails.
Picture cast_with_embree(const Scene& scene);

/// Which Embree.
std::string embree_version();

}  // namespace zstep::test
