// The files that a run can leave: its picture, its polygon indices, its depths, its scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "traces/image/png.hpp"
#include "traces/scene.hpp"

namespace zstep::cli {

struct Outputs {
  std::string image, ids, depth, raw_depth, scene;  ///< paths; empty ones are not written
  std::int64_t enlarge = 1;                         ///< each pixel becomes enlarge x enlarge pixels of the PNG
  bool any() const { return !(image.empty() && ids.empty() && depth.empty() && raw_depth.empty() && scene.empty()); }
};

/// Adds --save, --save-ids, --save-depth, --save-depth-raw, --save-scene and --enlarge.
void add_outputs(CLI::App& command, Outputs& outputs);

/// Throws InputError when one of the files cannot be written, two of them are one, or one of them is an input:
/// before the work, not after it.
void check_outputs(const Outputs& outputs, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& others = {});
/// Throws InputError where polygons or depths are asked for of a method that draws lines.
void check_gives(const Outputs& outputs, const Method& method);

/// Writes what was asked for and prints a line for each file.
void write_outputs(const Outputs& outputs, const Picture& picture, const Scene& scene, const Conventions& conventions);

/// Writes the scene file that was asked for, if one was, before the run: as it was changed.
void write_scene_asked(const Outputs& outputs, const Scene& scene, const Conventions& conventions,
                       const Method& method);
/// Writes a scene file and says so.
void write_scene_file(const std::string& path, const Scene& scene, const Conventions& conventions,
                      std::string_view method);

}  // namespace zstep::cli
