// Makes the text of a scene file say another scene.
#pragma once

#include <filesystem>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

/// What the text is to say.
struct Wanted {
  const Scene& scene;
  const Conventions& conventions;
  const std::filesystem::path& path;  ///< of the file that is written
};

/// Points, colours and the order of polygons, each changed where it stands. False where that cannot be.
bool edit_polygons(TomlText& text, const Wanted& wanted);

/// What the text says, as the wanted scene was made of what its file says.
SceneFile read_as_wanted(const TomlText& text, const Wanted& wanted);

/// The path of a file as a scene file in this folder has to name it.
std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& file);

/// All points and polygons written out, in place of those of the text.
void write_polygons(TomlText& text, const Wanted& wanted);

/// Camera, raster, options and light, as far as the text reads otherwise. Each round takes what depends on nothing
/// else that is wrong; true: there was something to change.
bool edit_view(TomlText& text, const Wanted& wanted);

}  // namespace zstep::scene
