// A .exr as renderers write it: one channel of single floats, not packed.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace zstep::test {

template <class T>
std::string bytes_in(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

/// `rows`: width * height floats of the machine's own (little-endian) bytes, the top row first.
inline std::string exr_of(std::int32_t width, std::int32_t height, const std::string& channel,
                          const std::string& rows) {
  const auto text = [](const char* name) { return std::string(name) + '\0'; };
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    return text(name) + text(type) + bytes_in(static_cast<std::int32_t>(value.size())) + value;
  };
  constexpr std::int32_t single = 2, every = 1;
  const std::string box =
      bytes_in(std::int32_t{0}) + bytes_in(std::int32_t{0}) + bytes_in(width - 1) + bytes_in(height - 1);
  std::string all = std::string("\x76\x2f\x31\x01\x02\0\0\0", 8);
  all += attribute("channels", "chlist",
                   channel + '\0' + bytes_in(single) + std::string(4, '\0') + bytes_in(every) + bytes_in(every) + '\0');
  all += attribute("compression", "compression", std::string(1, '\0'));
  all += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box);
  all += attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  all += attribute("pixelAspectRatio", "float", bytes_in(1.0f));
  all += attribute("screenWindowCenter", "v2f", bytes_in(0.0f) + bytes_in(0.0f));
  all += attribute("screenWindowWidth", "float", bytes_in(1.0f)) + '\0';
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(width), entry = 8 + row;
  const std::size_t first = all.size() + 8 * static_cast<std::size_t>(height);
  for (std::int32_t y = 0; y < height; ++y)
    all += bytes_in(static_cast<std::uint64_t>(first + static_cast<std::size_t>(y) * entry));
  for (std::int32_t y = 0; y < height; ++y)
    all += bytes_in(y) + bytes_in(static_cast<std::int32_t>(row)) + rows.substr(static_cast<std::size_t>(y) * row, row);
  return all;
}

}  // namespace zstep::test
