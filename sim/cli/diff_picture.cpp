// zstep diff of a run and a picture, or a table of depths, of another program.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>

#include <fmt/format.h>

#include "sim/cli/diff.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cost/depth_bounds.hpp"
#include "sim/image/file.hpp"
#include "sim/image/npy.hpp"
#include "sim/image/pfm.hpp"
#include "sim/pages/pictures.hpp"
#include "sim/pages/rows.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/error.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/replay/replay.hpp"
#include "traces/text.hpp"

namespace zstep::cli {

void check_sizes(std::int32_t width_a, std::int32_t height_a, std::int32_t width_b, std::int32_t height_b,
                 const std::string& b) {
  if (width_a == width_b && height_a == height_b) return;
  throw InputError(b, fmt::format("is {}x{} pixels, but A is {}x{}", width_b, height_b, width_a, height_a),
                   "compare runs and pictures of the same size");
}

void write_diff_page(const DiffOptions& options, const DiffText& text, const diff::DiffReport& report,
                     const PicturePair& pictures) {
  if (options.page.empty()) return;
  const std::string page = diff_page(text, report, pictures);
  write_file(options.page, std::span(reinterpret_cast<const std::uint8_t*>(page.data()), page.size()));
  if (!options.json) say_written(options.page, "one page");
}

int diff_with_picture(const DiffOptions& options) {
  const Trace a = open_trace(options.a);
  Replay end(a);
  end.go_to(a.size());
  const Picture& picture = end.state().picture;
  const Raster& raster = a.scene().raster;
  const std::string extension = std::filesystem::path(options.b).extension().string();
  PicturePair pictures;
  pictures.a = image_of(picture, a.scene(), 1);
  Precision precision = precision_of(a);
  bool float32 = extension == ".pfm";
  if (extension == ".png") {
    pictures.b = read_png(options.b);
    check_sizes(raster.width, raster.height, pictures.b.width, pictures.b.height, options.b);
    pictures.difference = diff::compare_colors(pictures.a.rgb, pictures.b.rgb);
  } else {
    std::vector<double> depths;
    std::int32_t width = 0, height = 0;
    if (extension == ".pfm") {
      const Pfm table = read_pfm(options.b);
      depths.assign(table.values.begin(), table.values.end());
      width = table.width, height = table.height;
    } else {
      const Npy table = read_npy(options.b);
      std::visit([&](const auto& values) { depths.assign(values.begin(), values.end()); }, table.values);
      width = table.width, height = table.height;
      float32 = std::holds_alternative<std::vector<float>>(table.values);
      if (std::holds_alternative<std::vector<std::int32_t>>(table.values))
        throw InputError(options.b, "has whole numbers", "give depths as float32 or float64");
    }
    if (float32) precision.relative = std::max(precision.relative, formulas::rounding_of_float32);
    precision.depths =
        compare::held_to_bounds(a, float32 ? NumberFormat::float32 : a.header().conventions.number_format).depths;
    check_sizes(raster.width, raster.height, width, height, options.b);
    const auto same = [](double z) { return z; };
    if (raster.y_up && precision.depths) {  // tables of depths have the top row first
      auto turned = std::make_shared<DepthBounds>(*precision.depths);
      turned->of_pixel = top_row_first<double>(turned->of_pixel, raster.width, raster.height, true, same);
      precision.depths = std::move(turned);
    }
    pictures.difference =
        diff::compare_depths(top_row_first<double>(picture.depth, raster.width, raster.height, raster.y_up, same),
                             depths, precision, diff::buffers_of(a, picture).empty);
  }
  pictures.map = map_of(pictures.difference.apart, raster.width, raster.height, false);
  diff::DiffReport report;
  report.precision = precision;
  const DiffText text{printable(a.name()), printable(options.b), {}, {}, pictures_text(pictures.difference)};
  write_diff_page(options, text, report, pictures);
  const diff::BufferDifference& found = pictures.difference;
  if (options.json) {
    print_diff_json(text, report, found);
  } else {
    fmt::print("A: {}\nB: {}\n{}\n", text.name_a, text.name_b, text.pictures);
    if (found.first) {
      const auto x = *found.first % raster.width, row = *found.first / raster.width;
      const auto y = raster.y_up ? raster.height - 1 - row : row;
      fmt::print("The first from the top is ({}, {}):\n  zstep explain {} {} {}\n", x, y,
                 printable(shell_word(options.a)), x, y);
    }
  }
  return found.colors + found.depths == 0 ? exit_code::done : exit_code::finding;
}

}  // namespace zstep::cli
