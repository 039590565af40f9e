// Files read whole, and numbers read from their bytes, in either order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <type_traits>

#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::scene {

/// No file larger than this is read: 256 MiB, more than any mesh within the limits of polygon_soup.hpp needs.
inline constexpr std::size_t largest_file = std::size_t{256} << 20;

/// The file's bytes. Throws InputError if it does not exist, is no regular file (a folder, a device, a pipe), is larger
/// than `limit` bytes, or cannot be read.
std::string read_bytes(const std::filesystem::path& path, std::size_t limit = largest_file);

// Numbers of a binary file, of either byte order, each held against the bytes that are left.

class BinaryReader {
 public:
  /// `bytes` and `name` must outlive this. Reading begins at byte `at`.
  BinaryReader(std::string_view bytes, const std::string& name, std::size_t at, bool big_endian)
      : bytes_(bytes), name_(name), at_(at), big_endian_(big_endian) {}

  /// The next number; throws InputError where the file ends before.
  template <class T>
  T take() {
    using Bits =
        std::conditional_t<sizeof(T) == 1, std::uint8_t,
                           std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                              std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
    last_ = at_;
    if (bytes_left() < sizeof(T))
      throw InputError(where(), "the file ends before the last element", "get the file again: it was cut short");
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      const char byte = bytes_[at_ + (big_endian_ ? sizeof(T) - 1 - i : i)];
      bits |= std::uint64_t{byte_of(byte)} << (8 * i);
    }
    at_ += sizeof(T);
    return std::bit_cast<T>(static_cast<Bits>(bits));
  }

  std::size_t bytes_left() const { return bytes_.size() - at_; }
  /// Of the last number.
  std::string where() const { return fmt::format("{}:byte {}", name_, last_); }

 private:
  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_, last_ = 0;
  bool big_endian_;
};

}  // namespace zstep::scene
