// What every kind of event follows from: all themes together.
#pragma once

#include "traces/formulas/of_areas.hpp"
#include "traces/formulas/of_colors.hpp"
#include "traces/formulas/of_curves.hpp"
#include "traces/formulas/of_edges.hpp"
#include "traces/formulas/of_half_space.hpp"
#include "traces/formulas/of_light.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/of_rays.hpp"
#include "traces/formulas/of_shadows.hpp"

namespace zstep::formulas {

/// Is there something to be said of this kind?
template <class E, class Out>
concept Derived = requires(const E& e, const Situation& at, Out& out) {
  derive(e, at, out);
};

}  // namespace zstep::formulas
