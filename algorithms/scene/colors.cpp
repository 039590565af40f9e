#include "algorithms/scene/colors.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace zstep::scene {

namespace {

// The palette's own names first; then what people try, as CSS has them where the palette has no such colour.
constexpr std::array<NamedColor, 23> names{{{"orange", palette[0]},
                                            {"sky blue", palette[1]},
                                            {"green", palette[2]},
                                            {"yellow", palette[3]},
                                            {"blue", palette[4]},
                                            {"vermillion", palette[5]},
                                            {"purple", palette[6]},
                                            {"grey", palette[7]},
                                            {"gray", palette[7]},
                                            {"black", {0, 0, 0}},
                                            {"white", {255, 255, 255}},
                                            {"red", {204, 37, 41}},
                                            {"pink", {255, 192, 203}},
                                            {"brown", {140, 86, 75}},
                                            {"cyan", {0, 183, 196}},
                                            {"magenta", {199, 36, 177}},
                                            {"violet", {128, 90, 200}},
                                            {"navy", {0, 32, 96}},
                                            {"light grey", {211, 211, 211}},
                                            {"light gray", {211, 211, 211}},
                                            {"dark grey", {90, 90, 90}},
                                            {"dark gray", {90, 90, 90}},
                                            {"clay", clay}}};

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::span<const NamedColor> named_colors() { return names; }

std::optional<Color> color_from_text(std::string_view text) {
  for (const NamedColor& named : names)
    if (named.name == text) return named.color;
  if (text.empty() || text[0] != '#' || (text.size() != 4 && text.size() != 7)) return std::nullopt;
  const std::size_t digits = text.size() == 4 ? 1 : 2;
  std::array<std::uint8_t, 3> channels{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int high = hex_digit(text[1 + i * digits]), low = hex_digit(text[i * digits + digits]);
    if (high < 0 || low < 0) return std::nullopt;
    channels[i] = static_cast<std::uint8_t>(16 * high + low);
  }
  return Color{channels[0], channels[1], channels[2]};
}

Color shaded(Color base, glm::dvec3 normal) {
  // From the left, behind and above an eye at the default theta of 30 degrees.
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.9, -0.35, 0.8));
  const double length = glm::length(normal);
  const double facing = length > 0 ? glm::dot(normal, light) / length : 0;
  const double half = (1 + facing) / 2;
  const double brightness = 0.30 + 0.85 * half * half;
  const auto channel = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(std::fmin(255, value * brightness)));
  };
  return {channel(base.red), channel(base.green), channel(base.blue)};
}

}  // namespace zstep::scene
