// The BSP tree: sorted once for every eye, then drawn from back to front without a compare.
//
// H. Fuchs, Z. M. Kedem and B. F. Naylor, "On Visible Surface Generation by A Priori Tree Structures", SIGGRAPH 1980;
// as taught in 001, 002 and 003. Building stands in build.hpp, the order of drawing in traverse.hpp.
#pragma once

#include <array>

#include "algorithms/bsp/build.hpp"
#include "algorithms/bsp/traverse.hpp"
#include "algorithms/catalog/catalog.hpp"

namespace zstep::bsp {

inline constexpr std::array options{
    Option{"root", "first|fewest-splits|random", "fewest-splits", "whose plane divides the pieces of a subtree"},
    Option{"candidates", "", "5", "how many pieces fewest-splits tries", true, 1, 1'000'000},
    Option{"seed", "", "1", "of random", true, 0, 1'000'000'000},
    Option{"order", "back-to-front|front-to-back", "back-to-front", "the second one paints each pixel once"},
    Option{"discard", "off|on", "on", "pass over subtrees that the view volume does not reach"},
};

BuildOptions build_options(const Conventions& conventions);

/// Draws a tree of this scene's facets. The camera may have moved since the tree was built.
template <Recorder R>
Picture draw(const Tree& tree, const Scene& scene, const Conventions& conventions, R& record);

/// Builds the tree and draws it.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::bsp
