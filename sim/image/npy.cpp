#include "sim/image/npy.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "traces/error.hpp"

namespace zstep {
namespace {

constexpr std::string_view magic{"\x93NUMPY\x01\x00", 8};
constexpr std::size_t magic_size = 6;                // the version follows: major, minor
constexpr std::size_t head_size = magic.size() + 2;  // two bytes of header length follow; from version 2 on, four
constexpr std::size_t alignment = 64;                // "the total length … is evenly divisible by 64"
constexpr char byte_order = std::endian::native == std::endian::little ? '<' : '>';

template <class Value>
constexpr std::string_view type_code = "";
template <>
constexpr std::string_view type_code<std::int32_t> = "i4";
template <>
constexpr std::string_view type_code<float> = "f4";
template <>
constexpr std::string_view type_code<double> = "f8";

template <class Value>
void write(const std::filesystem::path& path, std::span<const Value> values, int height, int width) {
  if (height < 0 || width < 0 || values.size() != static_cast<std::size_t>(height) * static_cast<std::size_t>(width))
    throw std::invalid_argument(
        fmt::format("write_npy: {} values do not make a {}x{} table", values.size(), height, width));
  std::string text = fmt::format("{{'descr': '{}{}', 'fortran_order': False, 'shape': ({}, {}), }}", byte_order,
                                 type_code<Value>, height, width);
  while ((head_size + text.size() + 1) % alignment != 0) text += ' ';
  text += '\n';

  std::vector<std::uint8_t> bytes(head_size + text.size() + values.size_bytes());
  std::uint8_t* out = bytes.data();
  std::memcpy(out, magic.data(), magic.size());
  out[magic.size()] = static_cast<std::uint8_t>(text.size() & 255);
  out[magic.size() + 1] = static_cast<std::uint8_t>(text.size() >> 8);
  std::memcpy(out + head_size, text.data(), text.size());
  if (!values.empty()) std::memcpy(out + head_size + text.size(), values.data(), values.size_bytes());
  write_file(path, bytes);
}

/// A reader of the one-line dictionary that heads the file.
class Dictionary {
 public:
  Dictionary(std::string_view text, const std::filesystem::path& path) : text_(text), path_(path) {}

  /// What stands after 'key': up to the end of the text.
  std::string_view after(std::string_view key) const {
    const std::size_t at = text_.find(fmt::format("'{}':", key));
    if (at == std::string_view::npos) fail(fmt::format("has no '{}' in its head", key));
    std::string_view rest = text_.substr(at + key.size() + 3);
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    return rest;
  }

  /// The two lengths of 'shape': (height, width).
  std::array<int, 2> shape() const {
    std::string_view rest = after("shape");
    std::array<int, 2> lengths{};
    int count = 0;
    bool digits = false;
    for (const char c : rest) {
      if (c >= '0' && c <= '9') {
        if (count >= 2) break;
        const auto k = static_cast<std::size_t>(count);
        lengths[k] = lengths[k] * 10 + (c - '0');
        digits = true;
        if (lengths[k] > (1 << 24)) fail("is too large");
      } else if (c == ',' || c == ')') {
        if (digits) ++count;
        digits = false;
        if (c == ')') break;
      } else if (c != ' ' && c != '(') {
        break;
      }
    }
    if (count != 2 || digits) fail("is not two-dimensional");
    return lengths;
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(path_.string(), what, "give a two-dimensional .npy of whole numbers, float32 or float64");
  }

 private:
  std::string_view text_;
  const std::filesystem::path& path_;
};

/// What is stored: numbers of type Stored, rows or columns first, in either byte order.
struct Stored {
  std::span<const std::uint8_t> data;
  std::size_t height, width;
  bool columns_first, swapped;
};

template <class Value, class From>
std::vector<Value> values_as(const Stored& stored, const Dictionary& head) {
  const std::size_t count = stored.height * stored.width;
  if (stored.data.size() / sizeof(From) < count) head.fail("is cut off");
  std::vector<Value> values(count);
  std::array<std::uint8_t, sizeof(From)> bytes{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = stored.columns_first ? i % stored.width * stored.height + i / stored.width : i;
    std::memcpy(bytes.data(), stored.data.data() + at * sizeof(From), sizeof(From));
    if (stored.swapped) std::reverse(bytes.begin(), bytes.end());
    const From from = std::bit_cast<From>(bytes);
    if constexpr (std::is_same_v<Value, std::int32_t>)
      if (!std::in_range<std::int32_t>(from)) head.fail(fmt::format("has {}, which int32 cannot hold", from));
    values[i] = static_cast<Value>(from);
  }
  return values;
}

}  // namespace

void write_npy(const std::filesystem::path& path, std::span<const std::int32_t> values, int height, int width) {
  write(path, values, height, width);
}
void write_npy(const std::filesystem::path& path, std::span<const float> values, int height, int width) {
  write(path, values, height, width);
}
void write_npy(const std::filesystem::path& path, std::span<const double> values, int height, int width) {
  write(path, values, height, width);
}

Npy read_npy(const std::filesystem::path& path, std::uintmax_t limit) {
  const std::vector<std::uint8_t> bytes = read_file(path, limit);
  const Dictionary nothing("", path);
  if (bytes.size() < head_size || std::memcmp(bytes.data(), magic.data(), magic_size) != 0) nothing.fail("is no .npy");
  const std::uint8_t version = bytes[magic_size];
  if (version < 1 || version > 3) nothing.fail(fmt::format("is an .npy of version {}, which is not known", version));
  const std::size_t length_bytes = version == 1 ? 2 : 4, begin = magic.size() + length_bytes;
  if (bytes.size() < begin) nothing.fail("is cut off");
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) length |= std::size_t{bytes[magic.size() + i]} << (8 * i);
  if (bytes.size() - begin < length) nothing.fail("is cut off");

  const Dictionary head(std::string_view(reinterpret_cast<const char*>(bytes.data()) + begin, length), path);
  const auto [height, width] = head.shape();
  const std::string_view descr = head.after("descr");
  if (descr.size() < 5 || descr[0] != '\'' || descr[4] != '\'') head.fail("has another type of numbers");
  const Stored stored{std::span(bytes).subspan(begin + length), static_cast<std::size_t>(height),
                      static_cast<std::size_t>(width), head.after("fortran_order").starts_with("True"),
                      descr[1] != '|' && descr[1] != '=' && descr[1] != byte_order};
  const std::string_view type = descr.substr(2, 2);
  if (type == "f4") return {height, width, values_as<float, float>(stored, head)};
  if (type == "f8") return {height, width, values_as<double, double>(stored, head)};
  if (type == "i1") return {height, width, values_as<std::int32_t, std::int8_t>(stored, head)};
  if (type == "i2") return {height, width, values_as<std::int32_t, std::int16_t>(stored, head)};
  if (type == "i4") return {height, width, values_as<std::int32_t, std::int32_t>(stored, head)};
  if (type == "i8") return {height, width, values_as<std::int32_t, std::int64_t>(stored, head)};
  if (type == "u1") return {height, width, values_as<std::int32_t, std::uint8_t>(stored, head)};
  if (type == "u2") return {height, width, values_as<std::int32_t, std::uint16_t>(stored, head)};
  if (type == "u4") return {height, width, values_as<std::int32_t, std::uint32_t>(stored, head)};
  if (type == "u8") return {height, width, values_as<std::int32_t, std::uint64_t>(stored, head)};
  head.fail("has another type of numbers");
}

}  // namespace zstep
