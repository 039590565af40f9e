#include "sim/pages/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "sim/pages/page.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/whole.hpp"

namespace zstep {

namespace {

bool has_depth(double z) { return std::isfinite(z) && z != no_depth; }

}  // namespace

Image image_of(const Picture& picture, const Scene& scene, int enlarge) {
  const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
  const std::size_t times = enlarge;
  Image image{picture.width * enlarge, picture.height * enlarge, {}};
  image.rgb.reserve(width * height * times * times * 3);
  for (std::size_t row = 0; row < height * times; ++row) {
    const std::size_t y = scene.raster.y_up ? height - 1 - row / times : row / times;
    for (std::size_t column = 0; column < width * times; ++column) {
      const Color c = color_at(picture, scene, y * width + column / times);
      image.rgb.insert(image.rgb.end(), {c.red, c.green, c.blue});
    }
  }
  return image;
}

Image map_of(const std::vector<float>& differences, std::int32_t width, std::int32_t height, bool y_up) {
  Image image{width, height, {}};
  image.rgb.reserve(differences.size() * 3);
  const auto same = [](float value) { return value; };
  for (const float apart : top_row_first<float>(differences, width, height, y_up, same)) {
    const auto light = nearest_byte(255 * (1 - std::clamp(apart, 0.0f, 1.0f)));
    image.rgb.insert(image.rgb.end(), {light, light, light});
  }
  return image;
}

void DepthRange::include(const Picture& picture) {
  for (const double z : picture.depth)
    if (has_depth(z)) least = std::min(least, z), most = std::max(most, z);
}

Image depths_of(const Picture& picture, bool y_up, const DepthRange& range) {
  constexpr int wide = 360, darkest = 40, lightest = 225, white = 255, stroke = 150;
  const int enlarge = std::max(1, wide / std::max(1, picture.width));
  const auto same = [](double z) { return z; };
  const std::vector<double> depths = top_row_first<double>(picture.depth, picture.width, picture.height, y_up, same);
  Image image{picture.width * enlarge, picture.height * enlarge, {}};
  image.rgb.reserve(depths.size() * static_cast<std::size_t>(enlarge * enlarge) * 3);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const double z = depths[picture.at(column / enlarge, row / enlarge)];
      int light = enlarge >= 4 && column % enlarge == row % enlarge ? stroke : white;
      if (has_depth(z)) {
        const double share = range.most > range.least ? (z - range.least) / (range.most - range.least) : 0;
        light = darkest + nearest_int(share * (lightest - darkest));
      }
      const auto grey = static_cast<std::uint8_t>(light);
      image.rgb.insert(image.rgb.end(), {grey, grey, grey});
    }
  return image;
}

std::string picture_in_words(const Picture& picture, const Scene& scene) {
  constexpr std::size_t named = 8;
  std::map<std::int32_t, std::int64_t> pixels;
  for (const std::int32_t polygon : picture.polygon) ++pixels[polygon];
  const auto inked = std::ssize(picture.ink) - std::count(picture.ink.begin(), picture.ink.end(), no_ink);
  std::string text = fmt::format("{} × {} pixels: ", picture.width, picture.height);
  if (pixels[no_polygon] == std::ssize(picture.polygon) && inked > 0)
    return text + fmt::format("{} drawn, {} of the background", inked, pixels[no_polygon] - inked);
  const std::int64_t background = pixels[no_polygon];
  pixels.erase(no_polygon);
  std::size_t count = 0;
  for (const auto& [polygon, on] : pixels) {
    if (count++ == named) break;
    text += fmt::format("{} on {}, ", polygon_label(scene, polygon), on);
  }
  if (count > named) text += fmt::format("{} more polygons, ", pixels.size() - named);
  return text + fmt::format("{} of the background", background);
}

std::string depths_in_words(const Picture& picture) {
  DepthRange range;
  range.include(picture);
  const auto drawn = std::count_if(picture.depth.begin(), picture.depth.end(), has_depth);
  std::string text = fmt::format("{} × {} pixels: ", picture.width, picture.height);
  if (drawn > 0) text += fmt::format("{} with depths from {} to {}, ", drawn, number(range.least), number(range.most));
  return text + fmt::format("{} empty", std::ssize(picture.depth) - drawn);
}

}  // namespace zstep
