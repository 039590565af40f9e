// What is known of a block without unpacking it: its place in the trace, and what it cannot hold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "traces/file/bytes.hpp"
#include "traces/record/event_log.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// Which parts of a raster were touched, on a grid of at most 32 by 32 squares whose side is a power of two.
class Tiles {
 public:
  static constexpr int across = 32;

  Tiles() = default;
  explicit Tiles(const Raster& raster);

  /// Pixels outside the raster touch nothing.
  void touch(std::int32_t x, std::int32_t y) { touch(x, x + 1, y); }
  /// The pixels first … end - 1 of a row.
  void touch(std::int32_t first, std::int32_t end, std::int32_t y) {
    if (first < 0 || end <= first || end > width_ || y < 0 || y >= height_) return;
    const int from = first >> shift_, to = (end - 1) >> shift_;
    rows_[static_cast<std::size_t>(y >> shift_)] |= (~std::uint32_t{0} >> (31 - (to - from))) << from;
  }
  bool touched(std::int32_t x, std::int32_t y) const {
    if (x < 0 || x >= width_ || y < 0 || y >= height_) return false;
    return (rows_[static_cast<std::size_t>(y >> shift_)] >> (x >> shift_) & 1u) != 0;
  }
  void clear() { rows_.fill(0); }

  void put(Bytes& out) const;
  void take(ByteReader& in);

 private:
  std::int32_t width_ = 0, height_ = 0;
  int shift_ = 0;
  std::array<std::uint32_t, across> rows_{};  ///< bit k of a row: its k-th square
};

/// Which steps occur.
class StepSet {
 public:
  void add(std::uint8_t step) { words_[step >> 6] |= std::uint64_t{1} << (step & 63); }
  void add(const StepSet& other) { words_[0] |= other.words_[0], words_[1] |= other.words_[1]; }
  bool has(std::uint8_t step) const { return step < 128 && (words_[step >> 6] >> (step & 63) & 1u) != 0; }
  bool meets(const StepSet& other) const { return ((words_[0] & other.words_[0]) | (words_[1] & other.words_[1])) != 0; }
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
  struct Mark {
    std::uint32_t offset;
    std::int32_t polygon;
  };                        ///< event number in the block, polygon
  std::vector<Mark> marks;  ///< where work on polygons begins
};

/// A block's info as bytes, and back; `raster` as the scene has it.
void put_block_info(Bytes& out, const BlockInfo& info);
BlockInfo take_block_info(ByteReader& in, const Raster& raster);

}  // namespace zstep
