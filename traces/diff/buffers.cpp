#include "traces/diff/buffers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "traces/file/visit.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep::diff {

namespace {

/// Colours that differ at all are seen on a map of differences; at most so far apart three channels are.
constexpr float least_seen = 0.25f, most_apart = 3 * 255.0f;

/// Equal, or both no number.
bool alike(double one, double other) { return one == other || (std::isnan(one) && std::isnan(other)); }

void differ(BufferDifference& found, std::size_t pixel, float apart) {
  if (!found.first) found.first = static_cast<std::int64_t>(pixel);
  found.apart[pixel] = std::max(found.apart[pixel], apart);
}

/// Depths, and at which pixels something was drawn.
struct Depths {
  std::span<const double> z;
  std::vector<bool> drawn;
};

/// Holds them against each other. They are shown by how far they are apart, as a share of the farthest.
void compare_depths_into(BufferDifference& found, const Depths& a, const Depths& b, const Precision& precision) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> apart(a.z.size());
  const std::int64_t width = precision.depths ? std::max(precision.depths->width, 1) : 1;
  for (std::size_t i = 0; i < a.z.size(); ++i) {
    const double one = a.z[i], other = b.z[i];
    if ((!a.drawn[i] && !b.drawn[i]) || alike(one, other)) continue;
    if (a.drawn[i] != b.drawn[i]) {
      ++(a.drawn[i] ? found.only_a : found.only_b);
      apart[i] = infinite;
    } else if (!std::isfinite(one) || !std::isfinite(other)) {
      ++found.not_finite;
      apart[i] = infinite;
    } else {
      const double off = std::abs(one - other);
      const std::int64_t pixel = i;
      if (formulas::gives(formulas::Rounded(one), other, precision.relative) || off <= precision.absolute ||
          off <= precision.allowed_depth(pixel % width, pixel / width)) {
        ++found.depths_rounded;
        continue;
      }
      apart[i] = off;
      found.farthest = std::max(found.farthest, off);
    }
    ++found.depths;
  }
  for (std::size_t i = 0; i < a.z.size(); ++i) {
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

bool is_drawn(const Picture& picture, std::size_t pixel, double empty) {
  return picture.polygon[pixel] != no_polygon || !alike(picture.depth[pixel], empty) ||
         (!picture.ink.empty() && picture.ink[pixel] != no_ink);
}

Depths depths_of(const Buffers& of) {
  Depths depths{of.picture.depth, std::vector<bool>(of.picture.depth.size())};
  for (std::size_t i = 0; i < depths.drawn.size(); ++i) depths.drawn[i] = is_drawn(of.picture, i, of.empty);
  return depths;
}

/// The number that stands at more than half of the pixels where A has nothing; that of A where none does.
double background_in(std::span<const double> b, const std::vector<bool>& drawn_a, double empty_a) {
  std::map<double, std::size_t> often;
  std::size_t empty = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (!drawn_a[i] && ++empty && std::isfinite(b[i])) ++often[b[i]];
  for (const auto& [z, times] : often)
    if (2 * times > empty) return z;
  return empty_a;
}

}  // namespace

Buffers buffers_of(const Trace& trace, const Picture& picture) {
  Buffers of{picture, trace.scene(), trace.header().empty_depth(), true};
  if (trace.has(kind_of<BuffersClear>))
    trace.visit(0, trace.size(), [&]<class E>(std::int64_t, std::uint8_t, const E& e) {
      if constexpr (std::is_same_v<E, BuffersClear>) of.empty = e.z;
      return !std::is_same_v<E, BuffersClear>;
    });
  of.has_depths = trace.has(kind_of<DepthWrite>) || std::any_of(picture.depth.begin(), picture.depth.end(),
                                                                [&](double z) { return !alike(z, of.empty); });
  return of;
}

BufferDifference compare_depths(std::span<const double> a, std::span<const double> b, const Precision& precision,
                                double empty_a) {
  BufferDifference found = of_size(a.size());
  Depths of_a{a, std::vector<bool>(a.size())}, of_b{b, std::vector<bool>(b.size())};
  for (std::size_t i = 0; i < a.size(); ++i) of_a.drawn[i] = !std::isinf(a[i]) && !alike(a[i], empty_a);
  found.empty_a = empty_a, found.empty_b = background_in(b, of_a.drawn, empty_a);
  for (std::size_t i = 0; i < b.size(); ++i)
    of_b.drawn[i] = std::isnan(b[i]) ? of_a.drawn[i] : std::isfinite(b[i]) && b[i] != found.empty_b;
  compare_depths_into(found, of_a, of_b, precision);
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

BufferDifference compare_pictures(const Buffers& a, const Buffers& b, const Precision& precision) {
  const auto colors_of = [](const Buffers& of) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(of.picture.polygon.size() * 3);
    for (std::size_t i = 0; i < of.picture.polygon.size(); ++i) {
      const Color color = color_at(of.picture, of.scene, i);
      rgb.insert(rgb.end(), {color.red, color.green, color.blue});
    }
    return rgb;
  };
  BufferDifference found = compare_colors(colors_of(a), colors_of(b));
  found.empty_a = a.empty, found.empty_b = b.empty;
  // A method that paints may keep no depths: then there is nothing to hold the other's against.
  found.depths_compared = a.has_depths && b.has_depths;
  if (!found.depths_compared) return found;
  compare_depths_into(found, depths_of(a), depths_of(b), precision);
  found.first.reset();
  for (std::size_t i = 0; i < found.apart.size() && !found.first; ++i)
    if (found.apart[i] > 0) found.first = static_cast<std::int64_t>(i);
  return found;
}

}  // namespace zstep::diff
