// A triangle at work as its edge functions see it, over the framebuffer and the depth buffer: its box, the tile, each
// edge's line with strokes to the side where its function is positive, the pixels that are outside, and the three areas
// whose shares are the weights.
#pragma once

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/model/moment.hpp"
#include "sim/viewer/panes/raster_words.hpp"

namespace zstep::viewer {

/// Nothing where no triangle is at work, or cells are too small to tell.
void paint_half_planes(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin);

/// A cross on each pixel that is outside an edge, and E₀, E₁, E₂ beside the edges that are set up. Where something
/// `stands_in` the pixels that were drawn, crosses only on those that were not.
void mark_half_planes(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words, bool stands_in, const Theme& ink);

}  // namespace zstep::viewer
