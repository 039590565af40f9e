#include "traces/mistakes/name.hpp"

#include "traces/formulas/walk.hpp"
#include "traces/mistakes/of_areas.hpp"
#include "traces/mistakes/of_curves.hpp"
#include "traces/mistakes/of_edges.hpp"
#include "traces/mistakes/of_orders.hpp"
#include "traces/mistakes/of_pixels.hpp"
#include "traces/mistakes/of_rays.hpp"
#include "traces/mistakes/of_sweep.hpp"
#include "traces/mistakes/of_vertices.hpp"

namespace zstep::mistakes {

std::array<Fit, mistake_count> fits_of(const Trace& run) {
  Supposed supposed(precision_of(run));
  formulas::walk(
      run,
      [&](std::int64_t step, const auto& e, const formulas::Situation& at) {
        supposed.begin(step);
        if constexpr (requires { suppose(e, at, supposed); }) suppose(e, at, supposed);
        return true;
      },
      [](std::int64_t, const Impossible&) {});
  std::array<Fit, mistake_count> fits;
  for (std::size_t k = 0; k < mistake_count; ++k) fits[k] = supposed.fit(static_cast<Mistake>(k));
  return fits;
}

std::optional<Mistake> mistake_of(const Trace& run, std::int64_t first, std::int64_t next) {
  const std::array<Fit, mistake_count> fits = fits_of(run);
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < mistake_count; ++k) {
    const Fit& fit = fits[k];
    if (!fit.holds() || (next > first && fit.first > next)) continue;
    // The one that shows first; of several, the one that explains the most.
    if (!best || fit.first < fits[*best].first || (fit.first == fits[*best].first && fit.as_made > fits[*best].as_made))
      best = k;
  }
  return best ? std::optional(static_cast<Mistake>(*best)) : std::nullopt;
}

}  // namespace zstep::mistakes
