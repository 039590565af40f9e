#include "traces/replay/picture_change.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

namespace zstep {

namespace {

/// Foretells bits of depths, and inks: where two before lead. Doubles of like size are as far apart as their bits are.
class Line {
 public:
  std::uint64_t guess() const { return 2 * last_ - before_; }
  void learn(std::uint64_t bits) { before_ = last_, last_ = bits; }

 private:
  std::uint64_t last_ = 0, before_ = 0;
};

std::uint64_t bits_of_depth(double depth) { return std::bit_cast<std::uint64_t>(depth); }
std::uint64_t zigzag_of(std::uint64_t difference) { return (difference << 1) ^ (0 - (difference >> 63)); }
std::uint64_t undo_zigzag(std::uint64_t zigzag) { return (zigzag >> 1) ^ (0 - (zigzag & 1)); }

/// A varint from memory that this file itself has written: nobody else's, so its end is not asked for.
std::uint64_t next_varint(const std::uint8_t*& at) {
  std::uint64_t value = *at & 0x7fu;
  for (unsigned shift = 7; (*at++ & 0x80u) != 0; shift += 7) value |= std::uint64_t{*at & 0x7fu} << shift;
  return value;
}

}  // namespace

PictureChange::PictureChange(const Picture* before, const Picture& after, double empty_depth) {
  const std::size_t size = after.depth.size();
  const bool inked = !after.ink.empty();
  const auto changed = [&](std::size_t pixel) {
    const double depth = before != nullptr ? before->depth[pixel] : empty_depth;
    const std::int32_t polygon = before != nullptr ? before->polygon[pixel] : no_polygon;
    const std::uint32_t ink = !inked ? 0u : before != nullptr ? before->ink[pixel] : no_ink;
    return bits_of_depth(depth) != bits_of_depth(after.depth[pixel]) || polygon != after.polygon[pixel] ||
           (inked && ink != after.ink[pixel]);
  };
  constexpr std::size_t many = 64;
  const auto same = [&](const auto& one, const auto& other, std::size_t first) {
    return std::memcmp(&one[first], &other[first], many * sizeof one[first]) == 0;
  };
  const auto many_unchanged = [&](std::size_t first) {
    return before != nullptr && size - first >= many && same(before->depth, after.depth, first) &&
           same(before->polygon, after.polygon, first) && (!inked || same(before->ink, after.ink, first));
  };
  Line depths, inks;
  std::int32_t last_polygon = no_polygon;
  for (std::size_t pixel = 0, told = 0; pixel < size;) {
    if (pixel % many == 0 && many_unchanged(pixel)) {
      pixel += many;
      continue;
    }
    if (!changed(pixel)) {
      ++pixel;
      continue;
    }
    std::size_t end = pixel + 1;
    while (end < size && after.polygon[end] == after.polygon[pixel] && changed(end)) ++end;
    put_varint(bytes_, end - pixel);
    put_varint(bytes_, pixel - told);
    put_varint(bytes_, zigzag_of(static_cast<std::uint64_t>(std::int64_t{after.polygon[pixel]} - last_polygon)));
    last_polygon = after.polygon[pixel];
    for (; pixel < end; ++pixel) {
      const std::uint64_t bits = bits_of_depth(after.depth[pixel]);
      put_varint(bytes_, zigzag_of(bits - depths.guess()));
      depths.learn(bits);
      if (!inked) continue;
      put_varint(bytes_, zigzag_of(after.ink[pixel] - inks.guess()));
      inks.learn(after.ink[pixel]);
    }
    told = end;
  }
  put_varint(bytes_, 0);
  bytes_.shrink_to_fit();
}

void PictureChange::apply_to(Picture& picture) const {
  if (bytes_.empty()) return;
  const bool inked = !picture.ink.empty();
  Line depths, inks;
  std::int64_t polygon = no_polygon;
  std::size_t pixel = 0;
  const std::uint8_t* at = bytes_.data();
  while (const auto count = static_cast<std::size_t>(next_varint(at))) {
    pixel += static_cast<std::size_t>(next_varint(at));
    polygon += static_cast<std::int64_t>(undo_zigzag(next_varint(at)));
    for (const std::size_t end = pixel + count; pixel < end; ++pixel) {
      const std::uint64_t bits = depths.guess() + undo_zigzag(next_varint(at));
      depths.learn(bits);
      picture.depth[pixel] = std::bit_cast<double>(bits);
      picture.polygon[pixel] = static_cast<std::int32_t>(polygon);
      if (!inked) continue;
      const std::uint64_t ink = inks.guess() + undo_zigzag(next_varint(at));
      inks.learn(ink);
      picture.ink[pixel] = static_cast<std::uint32_t>(ink);
    }
  }
}

}  // namespace zstep
