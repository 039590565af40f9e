// The shadow buffer: a second Z-buffer, seen from the light, says what the light reaches.
//
// L. Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978; 004 ("you are replacing the viewer by the
// light source"). As in 004 both pictures are Z-buffers; the light's has the raster of the eye's. A point outside the
// light's window is not reached by it.
#pragma once

#include <array>

#include "algorithms/catalog/option.hpp"
#include "algorithms/shadow_buffer/steps.hpp"
#include "traces/formulas/light.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::shadow_buffer {

inline constexpr std::array options{
    Option{"bias", "", "10",
           "how far behind the shadow buffer a point may lie and still be lit, in 1/1000 of its distance", false, 0,
           1000},
};

using formulas::in_shadow;

/// Both passes, then the compare at each pixel. For scenes with a light. The picture's ink is set where there is
/// shadow; polygons and depths are the eye's.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::shadow_buffer
