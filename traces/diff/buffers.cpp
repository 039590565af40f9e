#include "traces/diff/buffers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "traces/formulas/rounding.hpp"

namespace zstep::diff {

namespace {

/// Colours that differ at all are seen on a map of differences; at most so far apart three channels are.
constexpr float least_seen = 0.25f, most_apart = 3 * 255.0f;

bool empty(double z) { return z == no_depth || !std::isfinite(z); }

void differ(BufferDifference& found, std::size_t pixel, float apart) {
  if (!found.first) found.first = static_cast<std::int64_t>(pixel);
  found.apart[pixel] = std::max(found.apart[pixel], apart);
}

/// Depths are shown by how far they are apart, as a share of the farthest.
void compare_depths_into(BufferDifference& found, std::span<const double> a, std::span<const double> b,
                         const Precision& precision) {
  std::vector<double> apart(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i] || (empty(a[i]) && empty(b[i]))) continue;
    if (empty(a[i]) || empty(b[i])) {
      apart[i] = std::numeric_limits<double>::infinity();
    } else {
      const double off = std::abs(a[i] - b[i]);
      if (formulas::gives(formulas::Rounded(a[i]), b[i], precision.relative) || off <= precision.absolute) {
        ++found.depths_rounded;
        continue;
      }
      apart[i] = off;
      found.farthest = std::max(found.farthest, off);
    }
    ++found.depths;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (apart[i] == 0) continue;
    const double share = std::isinf(apart[i]) || found.farthest == 0 ? 1 : apart[i] / found.farthest;
    differ(found, i, std::max(least_seen, static_cast<float>(share)));
  }
}

BufferDifference of_size(std::size_t pixels) {
  BufferDifference found;
  found.pixels = static_cast<std::int64_t>(pixels);
  found.apart.assign(pixels, 0);
  return found;
}

}  // namespace

BufferDifference compare_depths(std::span<const double> a, std::span<const double> b, const Precision& precision) {
  BufferDifference found = of_size(a.size());
  compare_depths_into(found, a, b, precision);
  return found;
}

BufferDifference compare_colors(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  constexpr std::size_t channels = 3;
  BufferDifference found = of_size(a.size() / channels);
  for (std::size_t pixel = 0; pixel < found.apart.size(); ++pixel) {
    int apart = 0;
    for (std::size_t i = pixel * channels; i < (pixel + 1) * channels; ++i) apart += std::abs(a[i] - b[i]);
    if (apart == 0) continue;
    ++found.colors;
    differ(found, pixel, std::max(least_seen, static_cast<float>(apart) / most_apart));
  }
  return found;
}

BufferDifference compare_pictures(const Picture& a, const Scene& scene_a, const Picture& b, const Scene& scene_b,
                                  const Precision& precision) {
  const auto colors_of = [](const Picture& picture, const Scene& scene) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(picture.polygon.size() * 3);
    for (std::size_t i = 0; i < picture.polygon.size(); ++i) {
      const Color color = color_at(picture, scene, i);
      rgb.insert(rgb.end(), {color.red, color.green, color.blue});
    }
    return rgb;
  };
  BufferDifference found = compare_colors(colors_of(a, scene_a), colors_of(b, scene_b));
  // A method that paints may keep no depths: then there is nothing to hold the other's against.
  const auto drawn = [](const Picture& picture) {
    return std::any_of(picture.depth.begin(), picture.depth.end(), [](double z) { return !empty(z); });
  };
  if (drawn(a) && drawn(b)) {
    compare_depths_into(found, a.depth, b.depth, precision);
    found.first.reset();
    for (std::size_t i = 0; i < found.apart.size() && !found.first; ++i)
      if (found.apart[i] > 0) found.first = static_cast<std::int64_t>(i);
  }
  return found;
}

}  // namespace zstep::diff
