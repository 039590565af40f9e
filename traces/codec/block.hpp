// Blocks, packed and unpacked: the columns that numbers stand in, what is known of a block without unpacking it, the
// encoder and the decoder.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "traces/codec/foreteller.hpp"
#include "traces/codec/runs.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/container.hpp"
#include "traces/file/header.hpp"
#include "traces/record/event_log.hpp"
#include "traces/scene.hpp"

namespace zstep::codec {

// One for each field name, and three more.
inline constexpr std::size_t misses_column = slot_count;      ///< which fields of an event were not foretold
inline constexpr std::size_t counts_column = slot_count + 1;  ///< pixels of a run
inline constexpr std::size_t nearer_column = slot_count + 2;  ///< the outcomes of a run's compares
inline constexpr std::size_t column_count = slot_count + 3;

constexpr std::string_view column_name(std::size_t column) {
  if (column == misses_column) return "*";
  if (column == counts_column) return "#";
  if (column == nearer_column) return "#nearer";
  return slot_name(column);
}

inline void put_low_bytes(Bytes& out, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}
/// The number of bytes that are not 0 from the lowest on, then these, the lowest first.
inline void put_counted(Bytes& out, std::uint64_t value) {
  std::size_t count = 0;
  while (count < 8 && value >> (8 * count) != 0) ++count;
  out.push_back(static_cast<std::uint8_t>(count));
  put_low_bytes(out, value, count);
}

inline std::uint64_t take_counted(ByteReader& in) {
  const std::size_t count = in.u8();
  if (count > 8) throw MalformedBytes("a number of more than eight bytes");
  return in.low_bytes(count);
}

}  // namespace zstep::codec

namespace zstep {

// What is known of a block without unpacking it: its place in the trace, and what it cannot hold.

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
    rows_[y >> shift_] |= (~std::uint32_t{0} >> (31 - (to - from))) << from;
    return true;
  }
  bool touched(std::int32_t x, std::int32_t y) const {
    if (x < 0 || x >= width_ || y < 0 || y >= height_) return false;
    return (rows_[y >> shift_] >> (x >> shift_) & 1u) != 0;
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

// A block: up to 16 384 events, packed by column, readable without any other block.
//
// An event costs one token byte, its step id. When a field was not as foretold, the token's top bit is set, the column
// `*` holds which fields, and each such value goes to the column of its name. A scan line whose beginning, two edges
// and span are as foretold is one token. The pixels of a span, foretold whole, are runs: one token for up to 64 of
// them, their number, and a bit for the outcome of each compare.

inline constexpr std::uint8_t missed_bit = 0x80;

class BlockEncoder {
 public:
  /// The scene must live as long as the encoder does. `first_position`: how many events come before the first block.
  BlockEncoder(const Scene& scene, const Header& header, std::int64_t first_position = 0);
  ~BlockEncoder();

  struct Packed {
    BlockInfo info;
    Bytes bytes;  ///< before compression
  };
  /// Packs what stands in a log that was closed, as the block that follows the one before. It lives until the next.
  const Packed& pack(const EventLog& log);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Unpacks a block. Throws MalformedBytes for anything an encoder could not have written.

/// What the ids of steps mean in a trace.
inline constexpr std::uint8_t unknown_kind = 0xff;
struct StepMeanings {
  explicit StepMeanings(const Page& page);
  std::array<std::uint8_t, 128> kind{};  ///< which each records; `unknown_kind` for ids that the trace does not use
  codec::RowSteps row;
};

class BlockDecoder {
 public:
  BlockDecoder(std::span<const std::uint8_t> packed, std::uint32_t count, const StepMeanings& meanings,
               const codec::SceneGeometry& facts);

  /// Calls visit(step, event) for each event in turn; stops early when it returns false. True when all were visited.
  /// A visit that can also be called as visit(run), with a Row, a FragmentRun or a PaintRun, gets runs whole.
  template <class Visit>
  bool visit_all(Visit&& visit) {
    using Take = bool (*)(BlockDecoder&, std::uint8_t, bool, Visit&);
    static constexpr auto take = []<std::size_t... K>(std::index_sequence<K...>) {
      return std::array<Take, kind_count>{
          [](BlockDecoder& self, std::uint8_t step, bool missed, Visit& function) -> bool {
            return function(step, self.take_one<KindAt<K>>(step, missed));
          }...};
    }
    (std::make_index_sequence<kind_count>{});
    for (const std::uint8_t token : tokens_) {
      const std::uint8_t step = token & static_cast<std::uint8_t>(~missed_bit);
      if (step >= codec::row_token) {
        const bool go_on = step == codec::fragments_token ? give(take_fragments(token), visit)
                           : step == codec::row_token     ? give(take_row(token), visit)
                                                          : give(take_paints(token), visit);
        if (!go_on) return false;
        continue;
      }
      const std::uint8_t kind = meanings_.kind[step];
      if (kind == unknown_kind) throw MalformedBytes("a step that is not in the step table");
      count_down(1);
      if (!take[kind](*this, step, (token & missed_bit) != 0, visit)) return false;
    }
    if (left_ != 0) throw MalformedBytes("a block with fewer events than it says");
    return true;
  }

 private:
  template <class Run, class Visit>
  static bool give(const Run& run, Visit& visit) {
    if constexpr (requires { visit(run); }) return visit(run);
    else return run.expand(visit);
  }

  void count_down(std::uint32_t events) {
    if (events > left_) throw MalformedBytes("a block with more events than it says");
    left_ -= events;
  }
  const codec::Row& take_row(std::uint8_t token);
  codec::FragmentRun take_fragments(std::uint8_t token);
  codec::PaintRun take_paints(std::uint8_t token);
  /// How many pixels a run has; moves the register x to the last of them.
  std::uint32_t take_count(std::uint8_t token);

  /// The next event; for every kind compiled once, in the .cpp.
  template <class E>
  E take_one(std::uint8_t step, bool missed);

  codec::Foreteller foreteller_;
  codec::RunSteps steps_;
  const StepMeanings& meanings_;
  codec::Row row_;
  std::uint32_t left_;  ///< events still to come
  std::span<const std::uint8_t> tokens_;
  std::array<ByteReader, codec::column_count> columns_;
};

}  // namespace zstep
