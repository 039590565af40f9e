#include "traces/mistakes/name.hpp"

#include <map>
#include <tuple>

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

namespace {

/// Is there something to be said of this kind?
template <class E>
concept Supposable = requires(const E& e, const Situation& at, Supposed& out) {
  suppose(e, at, out);
};

void suppose_all(const Trace& run, Supposed& supposed) {
  const State end = formulas::walk(
      run,
      [&]<class E>(std::int64_t step, const E& e, const formulas::Situation& at) {
        supposed.begin(step, kind_of<E>);
        if constexpr (Supposable<E>) suppose(e, at, supposed);
        return true;
      },
      [](std::int64_t, const Impossible&) {});
  if (run.has(kind_of<ListInsert>) && end.machine.list.empty()) detail::suppose_put_back(supposed);
  detail::suppose_retired(false, supposed);
  supposed.settle();
}

/// With what is in the depth buffer, and how a depth is compared with it. None of these changes the depth itself.
bool is_of_buffer(Mistake mistake) { return compare_reversed <= mistake && mistake <= written_before_test; }

}  // namespace

std::array<Fit, mistake_count> fits_of(const Trace& run, const Precision& precision, std::span<const Fault> faults) {
  Supposed supposed(precision, faults);
  suppose_all(run, supposed);
  std::array<Fit, mistake_count> fits;
  for (std::size_t k = 0; k < mistake_count; ++k) fits[k] = supposed.fit(static_cast<Mistake>(k));
  return fits;
}

std::vector<Mistake> mistakes_of(const Trace& run, std::int64_t first, std::int64_t next, bool depth_is_wrong,
                                 const Precision& precision) {
  const std::vector<Fault> faults = faults_of(run, precision);
  const std::array<Fit, mistake_count> fits = fits_of(run, precision, faults);
  const bool wrong_at_first = !faults.empty() && faults.front().step == first;
  // The one that shows first; of several, the one that explains the most, and then the one that shows at once.
  const auto explains = [](const Fit& one) { return std::tuple(-one.first, one.as_made, -one.against_before); };
  std::vector<Mistake> best;
  for (std::size_t k = 0; k < mistake_count; ++k) {
    const Fit& fit = fits[k];
    if (!fit.holds() || (next > first && fit.first > next)) continue;
    if (wrong_at_first && fit.first >= first && !fit.explains_first) continue;
    if (depth_is_wrong && fit.first >= first && is_of_buffer(static_cast<Mistake>(k))) continue;
    const Fit* found = best.empty() ? nullptr : &fits[static_cast<std::size_t>(best.front())];
    if (found && explains(fit) < explains(*found)) continue;
    // With other numbers both are made; with the same ones it is one of them.
    const bool alike = found && explains(fit) == explains(*found);
    if (alike && fit.numbers != found->numbers) continue;
    if (!alike) best.clear();
    best.push_back(static_cast<Mistake>(k));
  }
  return best;
}

std::optional<Pair> pair_of(const Trace& run, std::int64_t first, const Precision& precision) {
  const std::vector<Fault> faults = faults_of(run, precision);
  Supposed supposed(precision, faults, true);
  suppose_all(run, supposed);
  constexpr std::int64_t enough = 2;  // one number may be as two mistakes make it by chance
  std::map<Pair, Fit> pairs = supposed.pairs_beside();
  pairs.insert(supposed.pairs().begin(), supposed.pairs().end());
  const std::pair<const Pair, Fit>* best = nullptr;
  for (const auto& one : pairs) {
    const Fit& fit = one.second;
    if (fit.first != first || fit.against_before + fit.against_after > 0 || fit.as_made < enough) continue;
    if (best && best->second.as_made == fit.as_made) return std::nullopt;  // either would do
    if (!best || fit.as_made > best->second.as_made) best = &one;
  }
  return best ? std::optional(best->first) : std::nullopt;
}

}  // namespace zstep::mistakes
