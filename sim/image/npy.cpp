#include "sim/image/npy.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "traces/error.hpp"

namespace zstep {
namespace {

constexpr std::string_view magic{"\x93NUMPY\x01\x00", 8};
constexpr std::size_t head_size = magic.size() + 2;  // two bytes of header length follow
constexpr std::size_t alignment = 64;                // "the total length … is evenly divisible by 64"
constexpr char byte_order = std::endian::native == std::endian::little ? '<' : '>';

template <class Value> constexpr std::string_view type_code = "";
template <> constexpr std::string_view type_code<std::int32_t> = "i4";
template <> constexpr std::string_view type_code<float> = "f4";
template <> constexpr std::string_view type_code<double> = "f8";

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
      }
    }
    if (count != 2 || digits) fail("is not two-dimensional");
    return lengths;
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(path_.string(), what, "give a two-dimensional .npy of int32, float32 or float64");
  }

 private:
  std::string_view text_;
  const std::filesystem::path& path_;
};

template <class Value>
std::vector<Value> values_of(std::span<const std::uint8_t> data, std::size_t count, const Dictionary& head) {
  if (data.size() / sizeof(Value) < count) head.fail("is cut off");
  std::vector<Value> values(count);
  if (count != 0) std::memcpy(values.data(), data.data(), count * sizeof(Value));
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

Npy read_npy(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  const Dictionary nothing("", path);
  if (bytes.size() < head_size || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    nothing.fail("is no .npy of version 1.0");
  const std::size_t length = bytes[magic.size()] + (std::size_t{bytes[magic.size() + 1]} << 8);
  if (bytes.size() < head_size + length) nothing.fail("is cut off");

  const Dictionary head(std::string_view(reinterpret_cast<const char*>(bytes.data()) + head_size, length), path);
  if (!head.after("fortran_order").starts_with("False")) head.fail("stores columns first");
  const auto [height, width] = head.shape();
  const std::size_t count = static_cast<std::size_t>(height) * static_cast<std::size_t>(width);
  const std::span<const std::uint8_t> data = std::span(bytes).subspan(head_size + length);

  const std::string_view descr = head.after("descr");
  const auto is = [&](std::string_view code) { return descr.starts_with(fmt::format("'{}{}'", byte_order, code)); };
  if (is("i4")) return {height, width, values_of<std::int32_t>(data, count, head)};
  if (is("f4")) return {height, width, values_of<float>(data, count, head)};
  if (is("f8")) return {height, width, values_of<double>(data, count, head)};
  head.fail("has another type of numbers");
}

}  // namespace zstep
