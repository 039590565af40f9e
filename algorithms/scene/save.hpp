// A scene as the text of a scene file (docs/scene-format.md), by changing the text that it came from.
#pragma once

#include <filesystem>
#include <string>

#include "traces/scene.hpp"

namespace zstep {

struct SceneText {
  std::string text;
  bool in_place = true;  ///< false: the polygons could not be kept where they stood, and are written out
};

/// The text of a scene file that reads as this scene and these conventions, to the bit; a method and its options stand
/// in no scene file. `to`: the file that it is for; it finds its meshes from there. Where the scene was read from a
/// text, a file or a built-in one, that is changed where it differs, and every comment stays. Throws InputError where
/// no scene file can say it.
SceneText text_of_scene(const Scene& scene, const Conventions& conventions, const std::filesystem::path& to);

/// Whether two runs of them are the same: what a scene is called and where its parts stand in files makes no
/// difference.
bool runs_alike(const Scene& a, const Scene& b);

}  // namespace zstep
