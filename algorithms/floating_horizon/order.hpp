// From front to back.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::floating_horizon {

/// Rows (or columns) of the surface's grid, nearest first. One list; two in perspective where the eye stands between
/// rows: those before it and those behind it cannot hide each other, as its own plane z = constant lies between them,
/// so each list starts with empty horizons.
using Order = std::vector<std::vector<std::int32_t>>;

/// The scene must have a surface.
Order rows_front_to_back(const Scene& scene);
Order columns_front_to_back(const Scene& scene);

}  // namespace zstep::floating_horizon
