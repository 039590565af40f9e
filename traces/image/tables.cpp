#include "traces/image/tables.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "traces/image/file.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"

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
  if (height < 0 || width < 0 || values.size() != static_cast<std::size_t>(height) * width)
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
        const std::size_t k = count;
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

namespace {

constexpr std::size_t most_values = std::size_t{1} << 28;

/// The words of the head, one after another.
class Head {
 public:
  Head(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path, std::string cure)
      : bytes_(bytes), path_(path), cure_(std::move(cure)) {}

  std::string_view word() {
    while (at_ < bytes_.size() && (blank(bytes_[at_]) || bytes_[at_] == '#')) {
      const bool comment = bytes_[at_] == '#';
      while (comment && at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      if (!comment) ++at_;
    }
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !blank(bytes_[at_])) ++at_;
    return {reinterpret_cast<const char*>(bytes_.data()) + begin, at_ - begin};
  }
  static bool read(std::string_view text, double& value) {
    return !text.empty() && read_number(text, value) == text.size();
  }
  static bool read(std::string_view text, int& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
  }
  template <class Number>
  Number number(std::string_view what) {
    const std::string_view text = word();
    Number value{};
    if (!read(text, value)) fail(fmt::format("has no {} in its head", what));
    return value;
  }
  /// Behind the one blank that ends the head.
  std::size_t end() const { return at_ + 1; }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_.string(), what, cure_); }

 private:
  static bool blank(std::uint8_t c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  const std::vector<std::uint8_t>& bytes_;
  const std::filesystem::path& path_;
  std::string cure_;
  std::size_t at_ = 0;
};

}  // namespace

Pfm read_pfm(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  Head head(bytes, path, "give a grey .pfm: Pf, width and height, scale, then the rows");
  if (const std::string_view kind = head.word(); kind != "Pf")
    head.fail(kind == "PF" ? "has colours, not depths" : "is no .pfm");
  Pfm table;
  table.width = head.number<int>("width");
  table.height = head.number<int>("height");
  const auto scale = static_cast<float>(head.number<double>("scale"));
  if (table.width < 1 || table.height < 1 || !(scale != 0)) head.fail("has no size, or no scale");
  const std::size_t width = static_cast<std::size_t>(table.width),
                    count = width * static_cast<std::size_t>(table.height);
  if (count > most_values) head.fail(fmt::format("has {}x{} numbers", table.width, table.height));
  if (head.end() > bytes.size() || bytes.size() - head.end() != count * sizeof(float))
    head.fail(fmt::format("has not the {} bytes of {}x{} numbers", count * sizeof(float), table.width, table.height));
  // A negative scale says that the lowest byte comes first.
  const bool turn = (scale < 0) != (std::endian::native == std::endian::little);
  table.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t four[sizeof(float)];
    std::memcpy(four, bytes.data() + head.end() + i * sizeof(float), sizeof four);
    if (turn) std::reverse(std::begin(four), std::end(four));
    const std::size_t row = static_cast<std::size_t>(table.height) - 1 - i / width;
    std::memcpy(&table.values[row * width + i % width], four, sizeof four);
  }
  return table;
}

Image read_pnm(const std::filesystem::path& path) {
  constexpr int most_value = 65535;
  const std::vector<std::uint8_t> bytes = read_file(path);
  Head head(bytes, path, "give a .ppm or .pgm: P2, P3, P5 or P6, width and height, the largest value, then the rows");
  const std::string_view kind = head.word();
  const bool color = kind == "P3" || kind == "P6", text = kind == "P2" || kind == "P3";
  if (!color && !text && kind != "P5") head.fail("is no .ppm or .pgm");
  Image image{head.number<int>("width"), head.number<int>("height"), {}};
  const int most = head.number<int>("largest value");
  if (image.width < 1 || image.height < 1 || most < 1 || most > most_value)
    head.fail("has no size, or no largest value");
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                    count = pixels * (color ? 3 : 1), width = most > 255 ? 2 : 1;
  // A number of a text is a digit and a blank at least.
  if (pixels > most_values || (text && count > bytes.size()))
    head.fail(fmt::format("has not {}x{} pixels", image.width, image.height));
  const std::size_t begin = head.end();
  if (!text && (begin > bytes.size() || bytes.size() - begin < count * width))
    head.fail(fmt::format("has not the {} bytes of {}x{} pixels", count * width, image.width, image.height));
  image.rgb.reserve(pixels * 3);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = begin + i * width;
    const int value = text ? head.number<int>("value") : width == 1 ? bytes[at] : bytes[at] << 8 | bytes[at + 1];
    if (value < 0 || value > most) head.fail(fmt::format("has a value that is not from 0 to {}", most));
    const auto byte = static_cast<std::uint8_t>((value * 255 + most / 2) / most);
    image.rgb.insert(image.rgb.end(), color ? 1 : 3, byte);
  }
  return image;
}

}  // namespace zstep
