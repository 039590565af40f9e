#include "sim/cli/outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "sim/cli/messages.hpp"
#include "sim/cli/words.hpp"
#include "traces/image/file.hpp"
#include "traces/image/tables.hpp"
#include "sim/pages/page.hpp"
#include "sim/pages/pictures.hpp"
#include "sim/scenes/save_scene.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"

namespace zstep::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t longest_side = 32768;  // what a PNG viewer still opens

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return fs::is_regular_file(a, error);
  return !fs::exists(a, error) &&
         fs::absolute(a, error).lexically_normal() == fs::absolute(b, error).lexically_normal();
}

}  // namespace

void add_outputs(CLI::App& command, Outputs& outputs) {
  const auto add = [&](const char* name, std::string& path, const char* type, const char* help) {
    command.add_option(name, path, help)->type_name(type)->group("Output");
  };
  add("--save", outputs.image, "FILE.png", "Write the picture");
  add("--save-ids", outputs.ids, "FILE.npy",
      "Write the polygon seen at each pixel: int32 [H,W], top row first, -1 where none is");
  add("--save-depth", outputs.depth, "FILE.npy",
      "Write the view depth z_v seen at each pixel: float32 [H,W], +inf where nothing is");
  add("--save-depth-raw", outputs.raw_depth, "FILE.npy", "Write the depths in the run's own numbers: float64 [H,W]");
  add("--save-scene", outputs.scene, "FILE.toml",
      "Write the scene as it is run, with all that --change and other options say of it; comments of a scene file "
      "stay");
  const auto take = [&outputs](const std::string& text) { outputs.enlarge = parse_whole("--enlarge", text, 1); };
  command.add_option_function<std::string>("--enlarge", take, "Draw each pixel as N x N pixels of the PNG (default 1)")
      ->type_name("N")
      ->group("Output");
}

void check_outputs(const Outputs& outputs, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& others) {
  std::vector<std::string> files;
  for (const std::string& path : {outputs.image, outputs.ids, outputs.depth, outputs.raw_depth, outputs.scene})
    if (!path.empty()) files.push_back(path);
  files.insert(files.end(), others.begin(), others.end());
  if (!outputs.scene.empty() && fs::path(outputs.scene).extension() != ".toml")
    throw InputError(outputs.scene, "is no name of a scene file", "end it with .toml");
  for (const std::string& input : inputs) note_input(input);
  for (std::size_t k = 0; k < files.size(); ++k) {
    check_writable(files[k]);
    for (std::size_t other = 0; other < k; ++other)
      if (same_file(files[k], files[other]))
        throw InputError(files[k], "is asked for twice", "give each output a file of its own");
  }
}

void check_gives(const Outputs& outputs, const Method& method) {
  if (method.gives != Gives::lines) return;
  for (const auto& [option, path] : {std::pair{"--save-ids", &outputs.ids},
                                     {"--save-depth", &outputs.depth},
                                     {"--save-depth-raw", &outputs.raw_depth}})
    if (!path->empty())
      throw InputError(option, fmt::format("{} draws lines: no pixel has a polygon and a depth", method.id),
                       "leave it out; --save FILE.png writes the picture");
}

void write_outputs(const Outputs& outputs, const Picture& picture, const Scene& scene, const Conventions& conventions) {
  const bool y_up = scene.raster.y_up;
  const int height = picture.height, width = picture.width;
  if (!outputs.image.empty()) {
    if (std::max<std::int64_t>(width, height) * outputs.enlarge > longest_side)
      throw InputError(
          "--enlarge",
          fmt::format("{} makes the picture more than {} pixels wide or high", outputs.enlarge, longest_side),
          "give a smaller number");
    const Image image = image_of(picture, scene, static_cast<int>(outputs.enlarge));
    write_png(outputs.image, image.width, image.height, image.rgb);
    say_written(outputs.image, fmt::format("picture, {}x{} pixels", image.width, image.height));
  }
  if (!outputs.ids.empty()) {
    write_npy(outputs.ids,
              top_row_first<std::int32_t>(picture.polygon, picture.width, picture.height, y_up,
                                          [](std::int32_t id) { return id; }),
              height, width);
    say_written(outputs.ids, fmt::format("polygon indices, int32 [{},{}]", height, width));
  }
  if (!outputs.depth.empty()) {
    std::vector<double> distances(picture.depth.size(), no_depth);
    for (std::size_t pixel = 0; pixel < distances.size(); ++pixel)
      if (picture.polygon[pixel] != no_polygon)
        distances[pixel] = view_depth(scene.camera, conventions, picture.depth[pixel]);
    write_npy(outputs.depth,
              top_row_first<float>(distances, picture.width, picture.height, y_up,
                                   [](double distance) { return static_cast<float>(distance); }),
              height, width);
    say_written(outputs.depth, fmt::format("view depths z_v, float32 [{},{}]", height, width));
  }
  if (!outputs.raw_depth.empty()) {
    write_npy(
        outputs.raw_depth,
        top_row_first<double>(picture.depth, picture.width, picture.height, y_up, [](double depth) { return depth; }),
        height, width);
    say_written(outputs.raw_depth, fmt::format("depths in the run's own numbers, float64 [{},{}]", height, width));
  }
}

void write_scene_file(const std::string& path, const Scene& scene, const Conventions& conventions,
                      std::string_view method) {
  const std::string told = save_scene(path, scene, conventions, method);
  say_written(path, "scene");
  if (!told.empty()) complain("note: " + told);
}

void write_scene_asked(const Outputs& outputs, const Scene& scene, const Conventions& conventions,
                       const Method& method) {
  if (!outputs.scene.empty()) write_scene_file(outputs.scene, scene, conventions, method.id);
}

}  // namespace zstep::cli
