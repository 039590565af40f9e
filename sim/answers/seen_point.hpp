// The word for where in a pixel what it shows is asked for.
#pragma once

#include "traces/scene.hpp"

namespace zstep {

/// "centre", or where pixels are seen at their first corners "corner".
inline const char* seen_point(const Raster& raster) { return raster.corners ? "corner" : "centre"; }

}  // namespace zstep
