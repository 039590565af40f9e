// What can be opened from the viewer's window, and how.
#pragma once

#include <memory>
#include <vector>

#include "sim/viewer/viewer.hpp"
#include "traces/file/trace.hpp"

namespace zstep::cli {

/// Lessons, methods and built-in scenes, the scenes with pictures.
std::vector<Offer> all_offers();

/// Opens what is offered, or a file. `now` is what is shown: a method draws its scene, and a scene is drawn by its
/// method where that can draw it, else by the Z-buffer. Throws InputError.
std::unique_ptr<Opened> open_offer(const Trace& now, const Offer& offer);

}  // namespace zstep::cli
