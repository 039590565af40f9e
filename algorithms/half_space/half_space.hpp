// Triangles as three half-planes, with a Z-buffer.
//
// J. Pineda, "A Parallel Algorithm for Polygon Rasterization", SIGGRAPH 1988. Each edge of a triangle has a function
// E(x, y) = A x + B y + C, positive on the triangle's side: a pixel is covered where all three are, and their values
// over twice the area are the weights of the three vertices. A centre on an edge belongs to the triangle that has it as
// a left or a top edge (Foley et al., section 3.6), so of two that share it to exactly one. Tiles and their farthest
// depths: N. Greene, M. Kass and G. Miller, "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993, with one level.
//
// With several samples a pixel each has coverage and a depth of its own, and the polygon its one colour; in the end the
// colours of a pixel's samples are mixed. The A-buffer keeps instead which of 32 samples each facet covers, as bits,
// and one depth: L. Carpenter, "The A-buffer, an Antialiased Hidden Surface Method", SIGGRAPH 1984.
//
// Departures: beside the samples the pixel's centre is drawn as it is without them, so that frame and depth buffer can
// be held against other methods. Carpenter keeps two depths and estimates where facets cross; here it is the depth in
// the middle of the samples covered, by the first of the facet's triangles that covers some. E is evaluated as A (x -
// X) + B (y - Y), (X, Y) being the edge's end with the smaller y, so that it is exactly 0 at a vertex and two triangles
// have opposite values to the last bit; where it is stepped, it is computed afresh at each tile of the raster for the
// same reason. Depths are computed as z_0 + w_1 (z_1
// - z_0) + w_2 (z_2 - z_0), so that a plane of constant depth has one number. Polygons that are convex on the raster
// are cut into a fan from their first vertex, others into ears; of an outline that crosses itself triangles overlap,
// and a pixel is drawn where the number of those that cover it is odd, as the even-odd rule has it, or, by the non-zero
// rule, where those that go round one way are not as many as the others.
#pragma once

#include <array>
#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps, those of the Z-buffer that it shares among them.

#define ZSTEP_MODULE half_space
#define ZSTEP_FIRST_STEP 76
#define ZSTEP_STEPS "algorithms/half_space/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::half_space {

enum class Stepping { products, increments };

inline constexpr std::array<Option, 9> options{
    {{"stepping", "products|increments", "products",
      "edge functions evaluated at each pixel, or stepped by A from pixel to pixel and by B from line to line"},
     {"tiles", "off|8", "off", "8x8 tiles, accepted or rejected as a whole where an edge function's corners allow it"},
     {"hierarchical-z", "off|on", "off",
      "a tile is rejected where the nearest depth of the triangle in it is not nearer than its farthest stored one"},
     {"samples", "1|2|4|8|16|a-buffer", "1",
      "samples a pixel, each with its own coverage and depth, whose colours are mixed in the end; a-buffer: a mask of "
      "32 and one depth for each facet"},
     interpolation::nearer_option,
     interpolation::ties_option,
     interpolation::initial_depth_option,
     interpolation::fill_option,
     interpolation::shade_option}};

/// Draws the scene's facets in their order, each as triangles; which of two depths wins is as
/// interpolation::comparison_of() says.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

/// The page of steps that a run under these conventions has.
Page page_for(const Conventions& conventions);

/// Throws InputError for conventions that this method does not have.
void check(const Conventions& conventions, const std::string& who);
/// And for a picture that has more samples than a scene may have pixels.
void check(const Scene& scene, const Conventions& conventions);

}  // namespace zstep::half_space
