// Transparent polygons: a Z-buffer keeps one depth a pixel and meets polygons in any order, but colours mix only in the
// order from back to front.
//
// 002: "If the frontmost polygon is transparent then we want to be able to 'see through' it". What is laid over what
// decides the colour: T. Porter and T. Duff, "Compositing Digital Images", SIGGRAPH 1984 (their operator `over`). The
// order comes from a BSP tree: H. Fuchs, Z. M. Kedem and B. F. Naylor, "On Visible Surface Generation by A Priori Tree
// Structures", SIGGRAPH 1980.
//
// Departure: colours are mixed as they are stored, in sRGB and eight bits, as the early frame buffers did.
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/bsp/steps.hpp"
#include "algorithms/catalog/catalog.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of drawing what is transparent. Those of building a BSP tree and of going through it have the numbers from
// 64.

#define ZSTEP_MODULE transparency
#define ZSTEP_FIRST_STEP 96
#define ZSTEP_STEPS "algorithms/transparency/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::transparency {

/// What is drawn when, and what enters the depth buffer.
enum class Order : std::uint8_t {
  file,           ///< the Z-buffer alone: every polygon when its turn comes, and each one hides what lies behind it
  opaque_first,   ///< then the transparent ones in the order of the file; they hide nothing, but mix in the wrong order
  back_to_front,  ///< then the transparent ones by a BSP tree: right
};

inline constexpr std::array options{
    Option{"order", "file|opaque-first|back-to-front", "back-to-front",
           "when transparent polygons are drawn; the first two get pixels wrong", false},
};

/// The colour of a polygon laid over what is there: opacity · over + (1 − opacity) · under, rounded to eight bits.
Color blended(Color over, double opacity, Color under);

/// Draws the scene with the opacities of its materials. The polygon and the depth at a pixel are those of the nearest
/// opaque one (Order::file: of the last one that was not behind).
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::transparency
