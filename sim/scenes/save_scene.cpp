#include "sim/scenes/save_scene.hpp"

#include <cstdint>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/save.hpp"
#include "traces/image/file.hpp"
#include "sim/words/escaped.hpp"

namespace zstep {

namespace fs = std::filesystem;

std::string file_stem(const Scene& scene) {
  std::string stem = scene.name.empty() || names_formula(scene.name) ? scene.surface ? "surface" : "scene" : scene.name;
  for (char& c : stem) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    if (!plain) c = '-';
  }
  return stem.front() == '.' || stem.front() == '-' ? "scene" + stem : stem;
}

fs::path name_for_changed(const Scene& scene, const fs::path& folder) {
  std::string stem = file_stem(scene);
  // What was saved once and is changed again gets the next number, not another "-changed".
  if (const std::size_t at = stem.rfind("-changed"); at != std::string::npos && at > 0) stem.resize(at);
  stem += "-changed";
  std::error_code error;
  fs::path path = folder / (stem + ".toml");
  for (int number = 2; fs::exists(fs::symlink_status(path, error)); ++number)
    path = folder / fmt::format("{}-{}.toml", stem, number);
  return path;
}

std::string save_scene(const fs::path& path, const Scene& scene, const Conventions& conventions,
                       std::string_view method) {
  check_writable(path);
  const SceneText made = text_of_scene(scene, conventions, path);
  write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(made.text.data()), made.text.size()));
  std::string told;
  if (!made.in_place) told = "Its points and polygons are written out, as they could not be changed where they stood.";
  std::string command;
  if (method != "z-buffer") command += fmt::format(" --algorithm {}", method);
  for (const auto& [name, value] : conventions.options) command += " --option " + shell_word(name + "=" + value);
  if (!command.empty())
    told += fmt::format("{}The same run: zstep view {}{}", told.empty() ? "" : " ", shell_word(path.string()), command);
  return told;
}

}  // namespace zstep
