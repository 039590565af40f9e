// The columns of a block and how numbers stand in them.
#pragma once

#include <cstdint>
#include <string_view>

#include "traces/events/slots.hpp"
#include "traces/file/bytes.hpp"

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
