#include "sim/truth/truth.hpp"

#include <algorithm>
#include <cmath>

#include "sim/truth/sight.hpp"
#include "traces/scene.hpp"

namespace zstep::compare {

namespace {

// The pixels from `low` to `high`, widened by the tolerance, of `count`.
void rows_between(Real low, Real high, std::int32_t count, std::int32_t& first, std::int32_t& last) {
  const Real most = static_cast<Real>(count - 1), reach = edge_tolerance;
  first = static_cast<std::int32_t>(std::clamp(std::ceil(low - reach), Real{0}, most + 1));
  last = static_cast<std::int32_t>(std::clamp(std::floor(high + reach), Real{-1}, most));
}

}  // namespace

Truth::Truth(const Scene& scene, bool cull, std::span<const std::uint8_t> wanted, bool non_zero)
    : width_(scene.raster.width), height_(scene.raster.height), place_(pixel_count(width_, height_), -1) {
  std::int32_t places = 0;
  for (std::size_t pixel = 0; pixel < place_.size(); ++pixel) {
    if (wanted.empty() || wanted[pixel] != 0) place_[pixel] = places++;
  }
  candidates_.resize(places);
  const Sight sight(scene);
  Seen seen;
  for (std::size_t k = 0; k < scene.facets.size(); ++k) {
    if (!see(scene, scene.facets[k], sight, cull, seen)) continue;
    Vec2 low = seen.outline[0], high = low;
    for (const Vec2& corner : seen.outline) low = glm::min(low, corner), high = glm::max(high, corner);
    std::int32_t left = 0, right = 0, top = 0, bottom = 0;
    rows_between(low.x, high.x, width_, left, right);
    rows_between(low.y, high.y, height_, top, bottom);

    Candidate candidate;
    candidate.facet = index32(k), candidate.polygon = scene.facets[k].polygon;
    for (std::int32_t y = top; y <= bottom; ++y) {
      for (std::int32_t x = left; x <= right; ++x) {
        const std::int32_t slot = place_[pixel_at(x, y, width_)];
        if (slot < 0) continue;
        const Vec2 centre(x, y);
        locate(seen, centre, non_zero, candidate);
        if (!candidate.covers && candidate.edge > edge_tolerance) continue;
        measure_depth(seen, sight, centre, candidate);
        candidates_[slot].push_back(candidate);
      }
    }
  }
  for (std::vector<Candidate>& here : candidates_) {
    std::stable_sort(here.begin(), here.end(), [](const Candidate& a, const Candidate& b) { return a.z < b.z; });
  }
}

std::span<const Candidate> Truth::at(std::int32_t x, std::int32_t y) const {
  const std::int32_t slot = place_.at(pixel_at(x, y, width_));
  return candidates_.at(slot);
}

std::int32_t Truth::nearest(std::int32_t x, std::int32_t y) const {
  for (const Candidate& candidate : at(x, y)) {
    if (candidate.covers) return candidate.polygon;
  }
  return no_polygon;
}
}  // namespace zstep::compare
