// Building a BSP tree.
//
// H. Fuchs, Z. M. Kedem and B. F. Naylor, "On Visible Surface Generation by A Priori Tree Structures", SIGGRAPH 1980,
// after R. A. Schumacker, B. Brand, M. Gilliland and W. Sharp, "Study for Applying Computer-Generated Images to Visual
// Simulation", 1969, who had the planes put in by hand; as taught in 001 ("BSP Trees"), 002 and 003; the choice among a
// few candidates as in Foley, van Dam, Feiner and Hughes, "Computer Graphics", 2nd edition, section 15.5.2.
//
// Departures from the page: pieces need not be triangles, so a cut makes two pieces and not three; pieces that lie in
// the plane of the root stay at its node, where one test of the eye does for all.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/bsp/steps.hpp"
#include "algorithms/bsp/tree.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::bsp {

enum class Root : std::uint8_t { first, fewest_splits, random };

struct BuildOptions {
  Root root = Root::fewest_splits;
  std::int64_t candidates = 5;  ///< of fewest_splits: so many are tried, spread evenly over the pieces
  std::uint64_t seed = 1;       ///< of random
};

/// Builds the tree of the scene's facets as they stand in the world. It does not depend on the eye. Facets without area
/// are left out, for they have no plane.
///
/// A value of a plane counts as zero within 1e-9 of the diagonal of the box around them (and 1e-14 of the largest
/// coordinate, where that is rounding), and within what the piece's own corners are off its plane. Of a piece that
/// crosses, both parts have a vertex further off than that, so each node uses up a piece and building ends; it keeps a
/// stack of its own, so the tree may be as deep as there are pieces.
template <Recorder R>
Tree build(const Scene& scene, const BuildOptions& options, R& record);

/// The same for some of the facets, by number.
template <Recorder R>
Tree build(const Scene& scene, std::span<const std::int32_t> facets, const BuildOptions& options, R& record);

}  // namespace zstep::bsp
