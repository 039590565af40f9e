// Several samples a pixel: where they are, and what share of a pixel each polygon has by them. The patterns of 2 to 16
// are those that Direct3D (D3D11_STANDARD_MULTISAMPLE_PATTERN) and Vulkan (standardSampleLocations) prescribe; the mask
// of 32 is that of L. Carpenter, "The A-buffer, an Antialiased Hidden Surface Method", SIGGRAPH 1984.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "traces/conventions.hpp"
#include "traces/events/half_space.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

/// From the pixel's centre to a sample, to the right and downwards, in 16ths of a pixel.
struct SampleOffset {
  std::int8_t right, down;
  double dx() const { return right / 16.0; }
  double dy() const { return down / 16.0; }
};

inline constexpr std::array<SampleOffset, 2> two_samples{{{4, 4}, {-4, -4}}};
inline constexpr std::array<SampleOffset, 4> four_samples{{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}};
inline constexpr std::array<SampleOffset, 8> eight_samples{
    {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}};
inline constexpr std::array<SampleOffset, 16> sixteen_samples{{{1, 1},
                                                               {-1, -3},
                                                               {-3, 2},
                                                               {4, -1},
                                                               {-5, -2},
                                                               {2, 5},
                                                               {5, 3},
                                                               {3, -5},
                                                               {-2, 6},
                                                               {0, -7},
                                                               {-4, -6},
                                                               {-6, 4},
                                                               {-8, 0},
                                                               {7, -4},
                                                               {6, 7},
                                                               {-7, -8}}};
/// Four rows of eight, each in the middle of its part of the pixel: bit 8 * row + column of a mask.
inline constexpr std::int32_t mask_rows = 4, mask_columns = 8;
constexpr SampleOffset mask_offset(std::int32_t bit) {
  return {static_cast<std::int8_t>(2 * (bit % mask_columns) - 7),
          static_cast<std::int8_t>(4 * (bit / mask_columns) - 6)};
}

/// The samples of each pixel; none where its centre alone is looked at, or a mask of 32 is kept.
inline std::span<const SampleOffset> samples_of(const Conventions& conventions) {
  const auto found = conventions.options.find("samples");
  const std::string_view word = found == conventions.options.end() ? "1" : std::string_view(found->second);
  if (word == "2") return two_samples;
  if (word == "4") return four_samples;
  if (word == "8") return eight_samples;
  if (word == "16") return sixteen_samples;
  return {};
}
inline bool keeps_masks(const Conventions& conventions) {
  const auto found = conventions.options.find("samples");
  return found != conventions.options.end() && found->second == "a-buffer";
}
/// How far from a pixel's centre it is looked at, to each side.
inline double reach_of(const Conventions& conventions) {
  return keeps_masks(conventions) || !samples_of(conventions).empty() ? 0.5 : 0;
}

/// E at a sample, from its value at the centre.
template <class T>
T edge_value_beside(const T& e, const T& a, const T& dx, const T& b, const T& dy) {
  return e + (a * dx + b * dy);
}

/// What a sample of a pixel shows.
struct SampleRow {
  std::int32_t polygon = no_polygon;  ///< none: its depth is the one that all began with
  double z = 0;
  auto members() const { return std::tie(polygon, z); }
};

/// What a facet has of a pixel: the samples that it covers, and how deep it is in their middle.
struct PixelMask {
  std::int32_t polygon = no_polygon, facet = -1;
  std::uint32_t samples = 0;
  double z = 0;
  auto members() const { return std::tie(polygon, facet, samples, z); }
};
constexpr std::uint32_t samples_of(const SampleMask& mask) {
  std::uint32_t all = 0;
  for (const std::int32_t row : {mask.row_3, mask.row_2, mask.row_1, mask.row_0})
    all = all << mask_columns | (static_cast<std::uint32_t>(row) & 0xffu);
  return all;
}
/// Of a row of a mask.
constexpr std::int32_t row_of(std::uint32_t samples, std::int32_t row) {
  return static_cast<std::int32_t>(samples >> (row * mask_columns) & 0xffu);
}
/// Where the middle of a mask's samples is, from the centre of the pixel.
struct MaskMiddle {
  double dx = 0, dy = 0;
};
inline MaskMiddle middle_of(std::uint32_t samples) {
  MaskMiddle middle;
  for (std::int32_t bit = 0; bit < mask_rows * mask_columns; ++bit)
    if (samples >> bit & 1) middle.dx += mask_offset(bit).dx(), middle.dy += mask_offset(bit).dy();
  const int count = std::popcount(samples);
  return count == 0 ? middle : MaskMiddle{middle.dx / count, middle.dy / count};
}
/// A facet's masks of a pixel from all its triangles: a sample that two of them cover lies in an overlap, which the
/// even-odd rule leaves out.
inline void add_mask(std::vector<PixelMask>& masks, const PixelMask& one) {
  for (PixelMask& known : masks)
    if (known.polygon == one.polygon && known.facet == one.facet) {
      known.samples ^= one.samples;
      return;
    }
  masks.push_back(one);
}

struct PixelShare {
  std::int32_t polygon = no_polygon;  ///< none: the background
  double share = 0;                   ///< 0 to 1
};

/// By how many of a pixel's samples show each polygon, `polygon_of(i)` the i-th; in the order in which they do.
template <class PolygonOf>
std::vector<PixelShare> shares_of_samples(std::size_t count, PolygonOf&& polygon_of) {
  std::vector<PixelShare> shares;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t polygon = polygon_of(i);
    auto known = std::find_if(shares.begin(), shares.end(), [&](const PixelShare& s) { return s.polygon == polygon; });
    if (known == shares.end()) known = shares.insert(known, {polygon, 0});
    known->share += 1.0 / static_cast<double>(count);  // a power of two: exact
  }
  return shares;
}
/// By masks, from the nearest to the farthest: each has what those before leave of it. `nearer(z, other)`.
template <class Nearer>
std::vector<PixelShare> shares_of_masks(std::vector<PixelMask> masks, Nearer&& nearer) {
  std::stable_sort(masks.begin(), masks.end(),
                   [&](const PixelMask& one, const PixelMask& other) { return nearer(one.z, other.z); });
  std::vector<PixelShare> shares;
  std::uint32_t covered = 0;
  for (const PixelMask& mask : masks) {
    const std::uint32_t seen = mask.samples & ~covered;
    covered |= seen;
    if (seen == 0) continue;
    auto known =
        std::find_if(shares.begin(), shares.end(), [&](const PixelShare& s) { return s.polygon == mask.polygon; });
    if (known == shares.end()) known = shares.insert(known, {mask.polygon, 0});
    known->share += std::popcount(seen) / 32.0;
  }
  if (~covered != 0) shares.push_back({no_polygon, std::popcount(~covered) / 32.0});
  return shares;
}

/// The colours of a pixel's polygons, and the background's, by their shares.
inline Color mixed(const Scene& scene, std::span<const PixelShare> shares) {
  glm::dvec3 sum(0);
  for (const PixelShare& share : shares) {
    const Color color = share.polygon == no_polygon ? scene.background : scene.polygons[share.polygon].color;
    sum += share.share * glm::dvec3(color.red, color.green, color.blue);
  }
  return {nearest_byte(sum.x), nearest_byte(sum.y), nearest_byte(sum.z)};
}

}  // namespace zstep::formulas
