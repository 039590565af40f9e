// The scan-line method: the picture row by row, each row from all polygons at once.
//
// C. Wylie, G. Romney, D. Evans and A. Erdahl, "Half-Tone Perspective Drawings by Computer", Fall Joint Computer
// Conference 1967; W. J. Bouknight, "A Procedure for Generation of Three-Dimensional Half-Toned Computer Graphics
// Presentations", Communications of the ACM 13(9), 1970; as taught in 002, "Scan Line Algorithm" (Foley, van Dam,
// Feiner and Hughes, section 15.6). Departures from the page: the frontmost polygon is found at both ends of an
// interval and not only at its left one, so that polygons may penetrate each other (front.hpp); a scene's polygons may
// be concave, and clipping may have left only part of one.
#pragma once

#include <array>
#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scan_line/front.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::scan_line {

inline constexpr std::array options{
    Option{"resolve", "planes|line-buffer", "planes",
           "where several polygons overlap: compare their planes, or pixels in a depth buffer of one line"},
    Option{"coherence", "off|on", "off",
           "planes: use the depth order and the implied edge of the line before again where they must still hold"},
    Option{"antialias", "off|on", "off", "planes: mix colours by the share of the pixel that each polygon covers",
           false},
};

enum class Resolve : std::uint8_t { planes, line_buffer };

/// Throws InputError where conventions and options do not go together: planes are pseudodepth's, compared as they are;
/// only the line buffer interpolates. And a line buffer has one depth a pixel: no order to use again, and no areas.
void check(const Conventions& conventions, const std::string& who);

/// Draws the scene. Of equal depths the polygon drawn first is seen. Where resolve is "planes", the conventions on
/// depth, interpolation and coverage are the standard ones whatever is given.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

// The variant of 001, slide 12: "Requires a depth buffer equal to only one scan line". Every polygon that is active on
// the line is interpolated and compared pixel by pixel, as by the Z-buffer, but with all polygons on one line at a
// time.

/// Draws scan line y into the picture. `line` is the depth buffer, one number a column; polygons come in their order,
/// and strictly nearer wins, so that the picture is the Z-buffer's to the bit. The picture's depths are kept for
/// comparison; the method never reads them.
template <Recorder R>
void draw_line(const Tables& tables, const std::vector<std::int32_t>& active, std::int32_t y, const Raster& raster,
               const Conventions& conventions, std::vector<double>& line, Picture& picture, R& record);

}  // namespace zstep::scan_line
