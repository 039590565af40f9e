// What is known of a block without unpacking it: its place in the trace, and what it cannot hold.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "traces/file/bytes.hpp"
#include "traces/limits.hpp"
#include "traces/record/event_log.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// Which parts of a raster were touched, on a grid of at most 32 by 32 squares whose side is a power of two.
class Tiles {
 public:
  static constexpr int across = 32;

  Tiles() = default;
  explicit Tiles(const Raster& raster);

  /// The pixels first … end - 1 of a row; false, and nothing is touched, when they are not all on the raster.
  bool touch(std::int32_t first, std::int32_t end, std::int32_t y) {
    if (first < 0 || end <= first || end > width_ || y < 0 || y >= height_) return false;
    const int from = first >> shift_, to = (end - 1) >> shift_;
    rows_[static_cast<std::size_t>(y >> shift_)] |= (~std::uint32_t{0} >> (31 - (to - from))) << from;
    return true;
  }
  bool touched(std::int32_t x, std::int32_t y) const {
    if (x < 0 || x >= width_ || y < 0 || y >= height_) return false;
    return (rows_[static_cast<std::size_t>(y >> shift_)] >> (x >> shift_) & 1u) != 0;
  }
  void clear() { rows_.fill(0); }
  /// Whether all that is touched here is touched there, too.
  bool within(const Tiles& other) const {
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if ((rows_[row] & ~other.rows_[row]) != 0) return false;
    return true;
  }

  void put(Bytes& out) const;
  void take(ByteReader& in);

 private:
  std::int32_t width_ = 0, height_ = 0;
  int shift_ = 0;
  std::array<std::uint32_t, across> rows_{};  ///< bit k of a row: its k-th square
};

/// The pixels that were touched lie in here, both ends included; none do when right < left.
struct Box {
  std::uint16_t left = 0xffff, right = 0, top = 0xffff, bottom = 0;

  bool empty() const { return right < left; }
  /// The pixels first … end - 1 of a row, which lie on the raster.
  void touch(std::int32_t first, std::int32_t end, std::int32_t y) {
    left = std::min(left, static_cast<std::uint16_t>(first)),
    right = std::max(right, static_cast<std::uint16_t>(end - 1));
    top = std::min(top, static_cast<std::uint16_t>(y)), bottom = std::max(bottom, static_cast<std::uint16_t>(y));
  }
  bool within(const Box& other) const { return empty() || (other.holds(left, top) && other.holds(right, bottom)); }
  bool holds(std::int32_t x, std::int32_t y) const { return x >= left && x <= right && y >= top && y <= bottom; }
};
static_assert(largest_side <= 0xffff);

/// Which steps occur.
class StepSet {
 public:
  void add(std::uint8_t step) { words_[step >> 6] |= std::uint64_t{1} << (step & 63); }
  void add(const StepSet& other) { words_[0] |= other.words_[0], words_[1] |= other.words_[1]; }
  bool has(std::uint8_t step) const { return step < 128 && (words_[step >> 6] >> (step & 63) & 1u) != 0; }
  bool within(const StepSet& other) const {
    return ((words_[0] & ~other.words_[0]) | (words_[1] & ~other.words_[1])) == 0;
  }
  bool meets(const StepSet& other) const {
    return ((words_[0] & other.words_[0]) | (words_[1] & other.words_[1])) != 0;
  }
  bool empty() const { return (words_[0] | words_[1]) == 0; }
  std::array<std::uint64_t, 2>& words() { return words_; }
  const std::array<std::uint64_t, 2>& words() const { return words_; }

 private:
  std::array<std::uint64_t, 2> words_{};
};

struct BlockInfo {
  std::int64_t first_position = 0;  ///< the position before its first event
  std::uint32_t count = 0;          ///< its events
  StepSet steps;                    ///< that occur in it
  Tiles tiles;                      ///< that events with x and y name
  Box lead;                         ///< what they name before the first mark
  struct Mark {
    std::uint32_t offset = 0;  ///< event number in the block
    std::int32_t polygon = 0;
    Box box;  ///< what they name from here to the next mark
  };
  std::vector<Mark> marks;     ///< where work on polygons begins
  bool keeps_to_marks = true;  ///< after the first mark, what is done at a pixel names no polygon but the last mark's

  /// The pixels first … end - 1 of a row are touched by what comes last; those outside the raster are nobody's.
  void touch(std::int32_t first, std::int32_t end, std::int32_t y) {
    if (tiles.touch(first, end, y)) (marks.empty() ? lead : marks.back().box).touch(first, end, y);
  }
  /// What comes last is done at a pixel, and names a polygon.
  void name(std::int32_t polygon) {
    if (!marks.empty() && marks.back().polygon != polygon) keeps_to_marks = false;
  }
};

/// A block's info as bytes, and back; `raster` as the scene has it.
void put_block_info(Bytes& out, const BlockInfo& info);
BlockInfo take_block_info(ByteReader& in, const Raster& raster);

}  // namespace zstep
