// The shadow buffer: a second Z-buffer, seen from the light, says what the light reaches.
//
// L. Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978; 004 ("you are replacing the viewer by the
// light source"). As in 004 both pictures are Z-buffers; the light's has the raster of the eye's. A point outside the
// light's window is not reached by it. The bias that grows with the slope and the mean of several compares are named in
// traces/formulas/of_shadows.hpp.
#pragma once

#include <array>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "traces/formulas/of_shadows.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of the shadow buffer. Those of the Z-buffer, which it runs twice, have the numbers from 64.

#define ZSTEP_MODULE shadow_buffer
#define ZSTEP_FIRST_STEP 80
#define ZSTEP_STEPS "algorithms/shadow_buffer/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::shadow_buffer {

inline constexpr std::array options{
    Option{"bias", "", formulas::standard_bias,
           "how far behind the shadow buffer a point may lie and still be lit, in 1/1000 of its distance", false, 0,
           1000},
    Option{
        "slope-bias", "", formulas::standard_slope_bias,
        "how many times what a polygon's depth gains from pixel to pixel of the light's picture is added to the bias",
        false, 0, 100},
    Option{"pcf", "1|3|5|7", formulas::standard_pcf,
           "compare with so many times so many pixels of the light's picture; the share that says lit is the light",
           false},
};

using formulas::in_shadow;

/// Both passes, then the compare at each pixel. For scenes with a light. The picture's ink is set where there is
/// shadow; polygons and depths are the eye's.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::shadow_buffer
