#include "sim/image/pfm.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "traces/error.hpp"
#include "traces/math/read_number.hpp"

namespace zstep {
namespace {

constexpr std::size_t most_values = std::size_t{1} << 28;

/// The words of the head, one after another.
class Head {
 public:
  Head(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path) : bytes_(bytes), path_(path) {}

  std::string_view word() {
    while (at_ < bytes_.size() && blank(bytes_[at_])) ++at_;
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
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(path_.string(), what, "give a grey .pfm: Pf, width and height, scale, then the rows");
  }

 private:
  static bool blank(std::uint8_t c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  const std::vector<std::uint8_t>& bytes_;
  const std::filesystem::path& path_;
  std::size_t at_ = 0;
};

}  // namespace

Pfm read_pfm(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  Head head(bytes, path);
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

}  // namespace zstep
