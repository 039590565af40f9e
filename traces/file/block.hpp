// A block: up to 65 536 events, packed by column, readable without any other block.
//
// Every event costs one token byte, its step id. When a field was not what the registers foretold, the token's top bit
// is set and the column `misses` holds which fields; each such value goes to the column of its register. A span's
// pixels are foretold whole, so they become a repeating pattern of tokens that compresses to a few bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "traces/events/registers.hpp"
#include "traces/file/bytes.hpp"
#include "traces/file/header.hpp"
#include "traces/record/step.hpp"

namespace zstep {

inline constexpr std::uint32_t block_events = 1u << 16;
inline constexpr std::uint8_t missed_bit = 0x80;
inline constexpr std::size_t column_count = slot_count + 1;
inline constexpr std::size_t misses_column = slot_count;

/// What is known of a block without unpacking it.
struct BlockInfo {
  std::int64_t first_position = 0;  ///< the position before its first event
  std::uint32_t count = 0;          ///< its events
  std::int32_t x_min = std::numeric_limits<std::int32_t>::max(), x_max = std::numeric_limits<std::int32_t>::min();
  std::int32_t y_min = std::numeric_limits<std::int32_t>::max(), y_max = std::numeric_limits<std::int32_t>::min();
  struct Mark {
    std::uint32_t offset;
    std::int32_t polygon;
  };                        ///< event number in the block, polygon
  std::vector<Mark> marks;  ///< where work on polygons begins

  bool may_touch(std::int32_t x, std::int32_t y) const { return x_min <= x && x <= x_max && y_min <= y && y <= y_max; }
};

class BlockEncoder {
 public:
  explicit BlockEncoder(bool increments) : increments_(increments), registers_(increments), tokens_(block_events) {}

  std::uint32_t size() const { return info_.count; }
  bool full() const { return info_.count == block_events; }
  const BlockInfo& info() const { return info_; }

  template <class E>
  void put(std::uint8_t step, const E& event) {
    std::uint32_t missed = 0;
    std::array<std::uint64_t, field_count<E>> residual;  // written before it is read, where `missed` says so
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) {
        const double value = event.*field_at<E, I>.member;
        residual[I] = bits_of(value) ^ bits_of(registers_.guess<E, I>());
        registers_.set<E, I>(value);
      } else {
        const auto value = static_cast<std::int32_t>(event.*field_at<E, I>.member);
        residual[I] = static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(registers_.guess<E, I>());
        registers_.set<E, I>(value);
      }
      missed |= static_cast<std::uint32_t>(residual[I] != 0) << I;
    });
    tokens_[info_.count] = step;
    if (missed != 0) put_missed<E>(missed, residual);
    note(event);
    ++info_.count;
  }

  /// The packed block, before compression; the encoder is empty afterwards and goes on where the block ended.
  Bytes take();

 private:
  template <class E>
  void put_missed(std::uint32_t missed, const std::array<std::uint64_t, field_count<E>>& residual) {
    tokens_[info_.count] |= missed_bit;
    put_varint(columns_[misses_column], missed);
    for_each_index<E>([&]<std::size_t I>() {
      if ((missed >> I & 1u) == 0) return;
      Bytes& column = columns_[slot_at<E, I>];
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) put_u64(column, residual[I]);
      else put_varint(column, zigzag(static_cast<std::int32_t>(static_cast<std::uint32_t>(residual[I]))));
    });
  }

  /// What the index keeps.
  template <class E>
  void note(const E& event) {
    if constexpr (requires {
                    event.x;
                    event.y;
                  }) {
      info_.x_min = std::min(info_.x_min, event.x);
      info_.x_max = std::max(info_.x_max, event.x);
      info_.y_min = std::min(info_.y_min, event.y);
      info_.y_max = std::max(info_.y_max, event.y);
    } else if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) {
      info_.marks.push_back({info_.count, event.polygon});
    }
  }

  bool increments_;
  Registers registers_;
  BlockInfo info_;
  std::vector<std::uint8_t> tokens_;
  std::array<Bytes, column_count> columns_;
};

/// Which kind of event each step id records; `unknown_kind` for ids the trace does not use.
inline constexpr std::uint8_t unknown_kind = 0xff;
using StepKinds = std::array<std::uint8_t, step_limit>;
StepKinds kinds_of(const Page& page);

/// Unpacks a block. Throws MalformedBytes for anything an encoder could not have written.
class BlockDecoder {
 public:
  BlockDecoder(std::span<const std::uint8_t> packed, std::uint32_t count, const StepKinds& kinds, bool increments);

  /// Calls visit(step, event) for each event in turn; stops early when it returns false. True when all were visited.
  template <class Visit>
  bool visit_all(Visit&& visit) {
    using Take = bool (*)(BlockDecoder&, std::uint8_t, bool, Visit&);
    static constexpr auto take = []<std::size_t... K>(std::index_sequence<K...>) {
      return std::array<Take, kind_count>{
          [](BlockDecoder& self, std::uint8_t step, bool missed, Visit& function) -> bool {
            return function(step, self.take<std::variant_alternative_t<K, Event>>(missed));
          }...};
    }
    (std::make_index_sequence<kind_count>{});
    for (const std::uint8_t token : tokens_) {
      const std::uint8_t step = token & static_cast<std::uint8_t>(~missed_bit);
      const std::uint8_t kind = kinds_[step];
      if (kind == unknown_kind) throw MalformedBytes("a step that is not in the step table");
      if (!take[kind](*this, step, (token & missed_bit) != 0, visit)) return false;
    }
    return true;
  }

 private:
  template <class E>
  E take(bool missed) {
    const auto mask = missed ? static_cast<std::uint32_t>(columns_[misses_column].varint()) : 0u;
    if (mask >> field_count<E> != 0) throw MalformedBytes("a miss of a field that the event does not have");
    E event;
    for_each_index<E>([&]<std::size_t I>() {
      using Value = FieldValue<E, I>;
      constexpr std::size_t slot = slot_at<E, I>;
      auto value = registers_.guess<E, I>();
      if ((mask >> I & 1u) != 0) {
        if constexpr (std::is_same_v<Value, double>) {
          value = double_of(bits_of(value) ^ columns_[slot].u64());
        } else {
          const auto residual =
              static_cast<std::uint32_t>(unzigzag(static_cast<std::uint32_t>(columns_[slot].varint())));
          value = static_cast<std::int32_t>(static_cast<std::uint32_t>(value) + residual);
        }
      }
      registers_.set<E, I>(value);
      event.*field_at<E, I>.member = checked<Value>(value);
    });
    return event;
  }

  template <class Value, class Raw>
  static Value checked(Raw value) {
    if constexpr (std::is_same_v<Value, bool>) {
      if (value != 0 && value != 1) throw MalformedBytes("a truth value that is neither 0 nor 1");
      return value != 0;
    } else if constexpr (std::is_enum_v<Value>) {
      if (value < 0 || static_cast<std::size_t>(value) >= words_of<Value>.size())
        throw MalformedBytes("an unknown word");
      return static_cast<Value>(value);
    } else {
      return value;
    }
  }

  Registers registers_;
  const StepKinds& kinds_;
  std::span<const std::uint8_t> tokens_;
  std::array<ByteReader, column_count> columns_;
};

/// A block's info as bytes, and back.
void put_block_info(Bytes& out, const BlockInfo& info);
BlockInfo take_block_info(ByteReader& in);

}  // namespace zstep
