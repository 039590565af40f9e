// Little-endian numbers in byte streams; readers that never read past the end.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace zstep {

/// The bytes end too early or hold an impossible number. Readers of files turn it into an InputError that says where.
struct MalformedBytes : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Bytes = std::vector<std::uint8_t>;

inline void put_u8(Bytes& out, std::uint8_t value) { out.push_back(value); }

template <class Unsigned>
void put_fixed(Bytes& out, Unsigned value) {
  std::array<std::uint8_t, sizeof(Unsigned)> bytes;
  for (std::size_t i = 0; i < sizeof value; ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  out.insert(out.end(), bytes.begin(), bytes.end());
}
inline void put_u32(Bytes& out, std::uint32_t value) { put_fixed(out, value); }
inline void put_u64(Bytes& out, std::uint64_t value) { put_fixed(out, value); }

/// Seven bits a byte, the lowest first.
inline void put_varint(Bytes& out, std::uint64_t value) {
  while (value >= 0x80) {
    out.push_back(static_cast<std::uint8_t>(value | 0x80));
    value >>= 7;
  }
  out.push_back(static_cast<std::uint8_t>(value));
}

/// Small numbers of either sign become small numbers: 0, -1, 1, -2 … → 0, 1, 2, 3 …
inline std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}
inline std::int32_t unzigzag(std::uint32_t value) {
  return static_cast<std::int32_t>((value >> 1) ^ (0u - (value & 1u)));
}

/// How far a float64's bits are from the guess's, small for numbers that are close: their difference as whole numbers,
/// zigzag.
inline std::uint64_t difference(std::uint64_t bits, std::uint64_t guess) {
  const std::uint64_t apart = bits - guess;
  return (apart << 1) ^ (0 - (apart >> 63));
}
inline std::uint64_t undo_difference(std::uint64_t difference, std::uint64_t guess) {
  return guess + ((difference >> 1) ^ (0 - (difference & 1u)));
}

inline void put_text(Bytes& out, const std::string& text) {
  put_varint(out, text.size());
  out.insert(out.end(), text.begin(), text.end());
}

/// Reads what the functions above wrote. Throws MalformedBytes instead of reading past the end.
class ByteReader {
 public:
  ByteReader() = default;
  explicit ByteReader(std::span<const std::uint8_t> bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  bool empty() const { return at_ == end_; }

  std::uint8_t u8() {
    need(1);
    return *at_++;
  }
  std::uint32_t u32() { return static_cast<std::uint32_t>(low_bytes(sizeof(std::uint32_t))); }
  std::uint64_t u64() { return low_bytes(sizeof(std::uint64_t)); }

  std::uint64_t varint() {
    if (at_ != end_ && *at_ < 0x80) return *at_++;  // most numbers are small
    return long_varint();
  }
  /// A count of things that take at least `bytes_each` bytes: never more than the bytes left could hold.
  std::size_t count(std::size_t bytes_each = 1) {
    const std::uint64_t value = varint();
    if (value > left() / bytes_each) throw MalformedBytes("a count larger than the data");
    return static_cast<std::size_t>(value);
  }
  std::span<const std::uint8_t> take(std::size_t size) {
    need(size);
    const std::span<const std::uint8_t> taken(at_, size);
    at_ += size;
    return taken;
  }
  /// The number that the next `size` bytes are, at most eight, the lowest first.
  std::uint64_t low_bytes(std::size_t size) {
    need(size);
    std::uint64_t value = 0;
    if (std::endian::native == std::endian::little && left() >= sizeof value) {
      std::memcpy(&value, at_, sizeof value);
      value = size == 0 ? 0 : value & (~std::uint64_t{0} >> (8 * (sizeof value - size)));
    } else {
      for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{at_[i]} << (8 * i);
    }
    at_ += size;
    return value;
  }
  std::string text() {
    const auto taken = take(count());
    return {taken.begin(), taken.end()};
  }

 private:
  void need(std::size_t size) const {
    if (left() < size) throw MalformedBytes("the data ends too early");
  }
  std::uint64_t long_varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint8_t byte = u8();
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    throw MalformedBytes("a number of more than 64 bits");
  }

  const std::uint8_t* at_ = nullptr;
  const std::uint8_t* end_ = nullptr;
};

}  // namespace zstep
