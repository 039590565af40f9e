#include "sim/homework/pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algorithms/catalog/catalog.hpp"
#include "traces/image/png.hpp"
#include "traces/image/tables.hpp"
#include "sim/words/numbers.hpp"
#include "traces/check/precision.hpp"
#include "traces/diff/buffers.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/replay/replay.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> endings{".png", ".depth.npy", ".npy", ".pfm"};

std::vector<std::uint8_t> colors_of(const Picture& picture, const Scene& scene) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(picture.polygon.size() * 3);
  for (std::size_t pixel = 0; pixel < picture.polygon.size(); ++pixel) {
    const Color color = color_at(picture, scene, pixel);
    rgb.insert(rgb.end(), {color.red, color.green, color.blue});
  }
  return rgb;
}

/// What was handed in, in the order of the reference's picture.
class Printed {
 public:
  Printed(const Trace& reference, const std::vector<fs::path>& files)
      : scene_(reference.scene()),
        lines_(method(reference.header().algorithm).gives == Gives::lines),
        precision_(precision_of(reference)) {
    for (const fs::path& file : files) {
      note_input(file);
      std::error_code ignored;
      if (fs::file_size(file, ignored) > most_bytes())
        throw InputError(file.string(), fmt::format("is larger than any picture of {}", size_text()),
                         "save the picture of this scene, and nothing else");
      if (file.extension() == ".png") read_colors(file);
      else read_table(file);
    }
    // A program may work in any order: its rounding is that of the largest numbers it works with.
    precision_.absolute =
        std::max(precision_.absolute, precision_.relative * depth_range(scene_, reference.header().conventions.depth));
  }

  bool has_colors() const { return !rgb_.empty(); }
  bool has_depths() const { return !depths_.empty(); }
  std::span<const std::uint8_t> colors() const { return rgb_; }
  std::span<const double> depths() const { return depths_; }
  const Precision& precision() const { return precision_; }

  std::vector<bool> drawn() const {
    std::vector<bool> pixels(pixel_count());
    for (std::size_t i = 0; i < pixels.size(); ++i)
      pixels[i] = (has_colors() && color(i) != scene_.background) || (has_depths() && std::isfinite(depths_[i]));
    return pixels;
  }
  /// "sky blue, z = 0.25"
  std::string text(std::size_t pixel) const {
    std::string words;
    if (has_colors()) {
      const Color is = color(pixel);
      const auto found = std::find_if(scene_.polygons.begin(), scene_.polygons.end(),
                                      [&](const Polygon& polygon) { return polygon.color == is; });
      if (is == scene_.background) words = "background";
      else if (lines_) words = color_text(is);
      else if (found == scene_.polygons.end()) words = color_text(is) + ", which no polygon has";
      else words = "polygon " + name_of(scene_, static_cast<std::int32_t>(found - scene_.polygons.begin()));
    }
    if (has_depths()) words += fmt::format("{}z = {}", words.empty() ? "" : ", ", number(depths_[pixel], 9, true));
    return words;
  }

  static std::string color_text(Color is) { return fmt::format("the colour {}, {}, {}", is.red, is.green, is.blue); }
  static std::string name_of(const Scene& scene, std::int32_t polygon) {
    const std::string& name = *scene.polygons.at(polygon).name;
    return name.empty() ? fmt::format("{}", polygon) : name;
  }

 private:
  std::size_t pixel_count() const { return zstep::pixel_count(scene_.raster.width, scene_.raster.height); }
  /// Two numbers of eight bytes a pixel, and room for what else stands in a file.
  std::uintmax_t most_bytes() const { return 16 * pixel_count() + (std::uintmax_t{1} << 20); }
  std::string size_text() const { return fmt::format("{}x{} pixels", scene_.raster.width, scene_.raster.height); }
  Color color(std::size_t pixel) const { return {rgb_[3 * pixel], rgb_[3 * pixel + 1], rgb_[3 * pixel + 2]}; }
  /// Where in a file, whose first row is the top one, a pixel stands.
  std::size_t in_file(std::size_t pixel) const {
    if (!scene_.raster.y_up) return pixel;
    const std::size_t width = scene_.raster.width;
    return pixel_count() - width - pixel / width * width + pixel % width;
  }

  void check_size(const fs::path& file, std::int32_t width, std::int32_t height) const {
    const Raster& raster = scene_.raster;
    if (width == raster.width && height == raster.height) return;
    const bool turned = width == raster.height && height == raster.width;
    throw InputError(file.string(), fmt::format("is {}x{} pixels, but the scene is {}", width, height, size_text()),
                     turned ? "rows come first: array[y][x], of shape (height, width)" : "save the whole picture");
  }
  void take_colors(const fs::path& file) {
    if (has_colors()) throw InputError(file.string(), "is a second frame of this scene", "hand in one of them");
    rgb_.resize(3 * pixel_count());
  }
  void read_colors(const fs::path& file) {
    const Image image = read_png(file, most_bytes(), pixel_count());
    check_size(file, image.width, image.height);
    take_colors(file);
    for (std::size_t pixel = 0; pixel < pixel_count(); ++pixel)
      std::copy_n(image.rgb.begin() + (3 * in_file(pixel)), 3, rgb_.begin() + (3 * pixel));
  }
  void read_table(const fs::path& file) {
    if (file.extension() == ".pfm") {
      const Pfm table = read_pfm(file);
      check_size(file, table.width, table.height);
      return take_depths(file, table.values);
    }
    const Npy table = read_npy(file, most_bytes());
    check_size(file, table.width, table.height);
    if (const auto* whole = std::get_if<std::vector<std::int32_t>>(&table.values)) return take_numbers(file, *whole);
    if (const auto* single = std::get_if<std::vector<float>>(&table.values)) return take_depths(file, *single);
    take_depths(file, std::get<std::vector<double>>(table.values));
  }
  template <class Value>
  void take_depths(const fs::path& file, const std::vector<Value>& values) {
    if (has_depths()) throw InputError(file.string(), "are second depths of this scene", "hand in one of them");
    for (std::size_t pixel = 0; pixel < pixel_count(); ++pixel)
      depths_.push_back(static_cast<double>(values[in_file(pixel)]));
    const double rounding =
        std::is_same_v<Value, float> ? formulas::rounding_of_float32 : formulas::rounding_of_float64;
    precision_.relative = std::max(precision_.relative, rounding);
  }
  /// Numbers of polygons, -1 where there is none.
  void take_numbers(const fs::path& file, const std::vector<std::int32_t>& numbers) {
    if (lines_)
      throw InputError(file.string(), "has numbers of polygons, but this method draws lines",
                       "give the picture as .png");
    if (file.filename().string().ends_with(".depth.npy"))
      throw InputError(file.string(), "has whole numbers", "give depths as float32 or float64");
    take_colors(file);
    for (std::size_t pixel = 0; pixel < pixel_count(); ++pixel) {
      const std::int32_t polygon = numbers[in_file(pixel)];
      if (polygon < no_polygon || polygon >= size32(scene_.polygons))
        throw InputError(
            file.string(), fmt::format("has the polygon {}", polygon),
            fmt::format("polygons are counted from 0 to {}; -1 is the background", scene_.polygons.size() - 1));
      const Color is = polygon == no_polygon ? scene_.background : scene_.polygons[polygon].color;
      rgb_[3 * pixel] = is.red, rgb_[3 * pixel + 1] = is.green, rgb_[3 * pixel + 2] = is.blue;
    }
  }

  const Scene& scene_;
  bool lines_;  ///< they are drawn, and no polygons
  Precision precision_;
  std::vector<std::uint8_t> rgb_;  ///< [3 * pixels], empty where no frame was handed in
  std::vector<double> depths_;     ///< [pixels], empty where no depths were
};

/// How far apart the two are, by pixel. Depths are handed in with inf where nothing is: a finite one there is wrong,
/// also where all of these are the same, which else were taken for what the buffer was cleared to.
grade::PixelsApart differences(const Picture& ours, const Scene& scene, const Printed& theirs) {
  grade::PixelsApart apart;
  if (theirs.has_colors()) apart.color = diff::compare_colors(colors_of(ours, scene), theirs.colors()).apart;
  if (!theirs.has_depths()) return apart;
  apart.depth = diff::compare_depths(ours.depth, theirs.depths(), theirs.precision()).apart;
  for (std::size_t i = 0; i < apart.depth.size(); ++i)
    if (!std::isfinite(ours.depth[i]) && std::isfinite(theirs.depths()[i])) apart.depth[i] = 1;
  return apart;
}
/// The first pixel that differs, of those that were handed in; as many as there are where none does.
std::size_t first_apart(const grade::PixelsApart& apart) {
  const auto first_in = [](const std::vector<float>& off) {
    return static_cast<std::size_t>(std::find_if(off.begin(), off.end(), [](float one) { return one > 0; }) -
                                    off.begin());
  };
  if (apart.color.empty()) return first_in(apart.depth);
  return apart.depth.empty() ? first_in(apart.color) : std::min(first_in(apart.color), first_in(apart.depth));
}

Picture upside_down(const Picture& picture) {
  Picture turned = picture;
  const std::size_t width = picture.width;
  for (std::size_t i = 0; i < picture.polygon.size(); ++i) {
    const std::size_t from = picture.polygon.size() - width - i / width * width + i % width;
    turned.polygon[i] = picture.polygon[from], turned.depth[i] = picture.depth[from];
    if (!picture.ink.empty()) turned.ink[i] = picture.ink[from];
  }
  return turned;
}

}  // namespace

std::string scene_of(const fs::path& file) {
  const std::string name = file.filename().string();
  for (const std::string_view ending : endings)
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  return file.stem().string();
}

std::vector<fs::path> pictures_of(const fs::path& submission, const Task& task) {
  std::vector<fs::path> found;
  std::error_code ignored;
  if (fs::is_directory(submission, ignored)) {
    for (const std::string_view ending : endings)
      // What a link leads to is not the student's.
      if (const fs::path file = submission / (task.name + std::string(ending));
          fs::is_regular_file(fs::symlink_status(file, ignored)))
        found.push_back(file);
  } else if (const std::string name = submission.filename().string();
             std::any_of(endings.begin(), endings.end(), [&](auto ending) { return name.ends_with(ending); }) &&
             scene_of(submission) == task.name && fs::is_regular_file(submission, ignored)) {
    found.push_back(submission);
  }
  return found;
}

PictureGrade grade_pictures(const Trace& reference, const std::vector<fs::path>& files) {
  Replay end(reference);
  end.go_to(reference.size());
  const Picture& ours = end.state().picture;
  const Scene& scene = reference.scene();
  const Printed theirs(reference, files);
  PictureGrade graded{grade::drawn(ours), theirs.drawn(), differences(ours, scene, theirs), grade::has_depths(ours),
                      std::nullopt};
  const std::size_t pixel = first_apart(graded.apart);
  if (pixel == ours.polygon.size()) return graded;

  FirstWrong& first = graded.first.emplace();
  const std::size_t width = ours.width;
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  first.where = fmt::format("{}", fmt::join(names, ", "));
  first.step = fmt::format("pixel ({}, {})", pixel % width, pixel / width);
  first.what = first_apart(differences(upside_down(ours), scene, theirs)) == ours.polygon.size()
                   ? "The picture is upside down: its first row should be the top one."
                   : "This pixel is the first that differs.";
  std::string expected;
  if (theirs.has_colors()) {
    const std::int32_t polygon = ours.polygon[pixel];
    const Color color = color_at(ours, scene, pixel);
    expected = polygon != no_polygon       ? "polygon " + Printed::name_of(scene, polygon)
               : color == scene.background ? "background"
                                           : Printed::color_text(color);
  }
  if (theirs.has_depths()) {
    const double z = ours.depth[pixel];
    expected += fmt::format("{}z = {}", expected.empty() ? "" : ", ", number(z, 9, true));
  }
  first.expected = {{"", expected, ""}};
  first.found = {{"", theirs.text(pixel), ""}};
  return graded;
}

}  // namespace zstep::homework
