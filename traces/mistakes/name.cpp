#include "traces/mistakes/name.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "traces/formulas/walk.hpp"
#include "traces/mistakes/in_pixels.hpp"
#include "traces/mistakes/of_methods.hpp"
#include "traces/mistakes/of_polygons.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace {

/// What is done at a pixel: which it is, and what comes out.
struct PixelStep {
  std::uint8_t kind = 0;
  std::int32_t polygon = no_polygon, x = 0, y = 0;
  double z = 0;
  std::int32_t says = 0;  ///< the verdict, or the polygon that is written

  auto where() const { return std::tie(kind, polygon, x, y); }
};
using Pixels = std::vector<PixelStep>;

/// By pixel, and of one pixel in the order of work. A polygon at work is told of where both runs say which one that is.
Pixels pixels_of(const Trace& run, const std::array<bool, kind_count>& both) {
  Pixels pixels;
  std::int32_t polygon = no_polygon;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    visit_event(
        [&]<class E>(const E& e) {
          if (!both[kind_of<E>]) return;
          if constexpr (std::is_same_v<E, PolygonBegin>) polygon = e.polygon;
          if constexpr (has(at_pixel<E>, AtPixel::verdict))
            pixels.push_back({kind_of<E>, polygon, e.x, e.y, e.z, e.nearer});
          else if constexpr (is_of_fragment(at_pixel<E>) || std::is_same_v<E, DepthWrite>)
            pixels.push_back({kind_of<E>, polygon, e.x, e.y, e.z, 0});
          if constexpr (std::is_same_v<E, PixelWrite>) pixels.push_back({kind_of<E>, polygon, e.x, e.y, 0, e.polygon});
        },
        recorded.event);
    return true;
  });
  return pixels;
}

/// Of the kinds that are compared here.
bool is_of_pixel(std::uint8_t kind) { return at_pixel_of(kind) != AtPixel::nothing && kind != kind_of<PixelPaint>; }

void sort(Pixels& pixels) {
  std::stable_sort(pixels.begin(), pixels.end(),
                   [](const PixelStep& one, const PixelStep& other) { return one.where() < other.where(); });
}

/// Is each of a few of the run somewhere in the reference? Of a run that is not turned hardly any is, and that is found
/// without sorting what may be millions.
bool few_are_there(const Pixels& reference, const Pixels& run, const Supposed& numbers) {
  constexpr std::size_t few = 8;
  for (std::size_t k = 0; k < few; ++k) {
    const PixelStep& one = run[k * run.size() / few];
    const auto is_one = [&](const PixelStep& other) {
      return other.where() == one.where() && other.says == one.says && numbers.equal(one.z, Rounded(other.z));
    };
    if (std::none_of(reference.begin(), reference.end(), is_one)) return false;
  }
  return true;
}

/// Is `run`, once both are sorted, part of `reference`, and all of it where `whole`?
bool same(Pixels reference, Pixels run, bool whole, const Supposed& numbers) {
  if (run.empty() || run.size() > reference.size() || (whole && run.size() < reference.size())) return false;
  if (!few_are_there(reference, run, numbers)) return false;
  sort(reference);
  sort(run);
  auto at = reference.begin();
  for (const PixelStep& one : run) {
    while (at != reference.end() && at->where() < one.where()) ++at;
    if (at == reference.end() || at->where() != one.where() || at->says != one.says ||
        !numbers.equal(one.z, Rounded(at->z)))
      return false;
    ++at;
  }
  return true;
}

}  // namespace

std::optional<Mistake> turned_of(const Trace& reference, const Trace& run, const Precision& precision) {
  // What is wrong before the pixels, or with their numbers, is not explained by where they are.
  const auto is_of_scene = [](const Fault& fault) {
    using formulas::Rule;
    return fault.rule >= Rule::pixel_on_facet && fault.rule <= Rule::nearer_is_painted;
  };
  for (const Fault& fault : faults_of(run, precision))
    if (!is_of_pixel(fault.kind) && !is_of_scene(fault)) return std::nullopt;
  std::array<bool, kind_count> both{};
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    both[kind] = reference.has(static_cast<std::uint8_t>(kind)) && run.has(static_cast<std::uint8_t>(kind));
  const Pixels right = pixels_of(reference, both);
  Pixels upside_down = pixels_of(run, both), exchanged = upside_down;
  const Supposed numbers(precision);
  const auto [width, height] = std::pair(reference.scene().raster.width, reference.scene().raster.height);
  for (PixelStep& one : upside_down) one.y = height - 1 - one.y;
  for (PixelStep& one : exchanged) std::swap(one.x, one.y);
  // A run ends at the first pixel outside the raster; on a square one there is none.
  const bool down = same(right, std::move(upside_down), true, numbers),
             over = same(right, std::move(exchanged), width == height, numbers);
  if (down == over) return std::nullopt;
  return down ? y_upside_down : x_y_exchanged;
}

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

ByEnum<Mistake, Fit> fits_of(const Trace& run, const Precision& precision, std::span<const Fault> faults) {
  Supposed supposed(precision, faults);
  suppose_all(run, supposed);
  ByEnum<Mistake, Fit> fits;
  for (const Mistake mistake : values_of<Mistake>) fits[mistake] = supposed.fit(mistake);
  return fits;
}

std::vector<Mistake> mistakes_of(const Trace& run, std::int64_t first, std::int64_t next, bool depth_is_wrong,
                                 const Precision& precision) {
  const std::vector<Fault> faults = faults_of(run, precision);
  const ByEnum<Mistake, Fit> fits = fits_of(run, precision, faults);
  const bool wrong_at_first = !faults.empty() && faults.front().step == first;
  // The one that shows first; of several, the one that explains the most, and then the one that shows at once.
  const auto explains = [](const Fit& one) { return std::tuple(-one.first, one.as_made, -one.against_before); };
  std::vector<Mistake> best;
  for (const Mistake mistake : values_of<Mistake>) {
    const Fit& fit = fits[mistake];
    if (!fit.holds() || (next > first && fit.first > next)) continue;
    if (wrong_at_first && fit.first >= first && !fit.explains_first) continue;
    if (depth_is_wrong && fit.first >= first && is_of_buffer(mistake)) continue;
    const Fit* found = best.empty() ? nullptr : &fits[best.front()];
    if (found && explains(fit) < explains(*found)) continue;
    // With other numbers both are made; with the same ones it is one of them.
    const bool alike = found && explains(fit) == explains(*found);
    if (alike && fit.numbers != found->numbers) continue;
    if (!alike) best.clear();
    best.push_back(mistake);
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

Diagnosis diagnosis_of_pixels(const Trace& run, const Precision& precision) {
  Diagnosis found;
  for (const Together& ways : that_draw(run, precision)) {
    const Mistake first = ways.front().mistake;
    if (std::find(found.either.begin(), found.either.end(), first) == found.either.end()) found.either.push_back(first);
    if (ways.size() < 2) continue;
    // Of two together each must be the only one that explains its part.
    const Mistake second = ways.back().mistake;
    if (found.either.size() > 1 || (found.also && *found.also != second)) return {};
    found.also = second;
  }
  return found;
}

Diagnosis diagnosis_of(const Trace& run, const CheckReport& report) {
  constexpr std::int64_t most_steps = 5'000'000;
  if (report.causes.empty() || run.size() > most_steps) return {};
  const Fault& fault = report.causes.front().first;
  const std::int64_t next = report.causes.size() > 1 ? report.causes[1].first.step : 0;
  const bool depth_is_wrong = fault.field == "z" && is_of_pixel(fault.kind) && fault.kind != kind_of<DepthWrite>;
  if (auto some = mistakes_of(run, fault.step, next, depth_is_wrong, report.precision); !some.empty())
    return {std::move(some)};
  if (Diagnosis found = diagnosis_of_pixels(run, report.precision); !found.either.empty()) return found;
  if (const auto two = pair_of(run, fault.step, report.precision)) return {{two->first}, two->second};
  return {};
}

}  // namespace zstep::mistakes
