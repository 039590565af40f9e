// libFuzzer target: scene files, with formulas, without files beside them.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "tests/fuzz/text_mutator.hpp"
#include "traces/error.hpp"

using namespace zstep;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const fuzz::TextMutator mutate({"docs/scene-format.md"});
  return mutate(data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const SceneFile file =
        scene::read_scene(text, "fuzz.toml", "fuzz", [](const std::string& path) -> scene::PolygonSoup {
          throw InputError(path, "there are no files", "use a built-in mesh");
        });
    const Scene scene = look_at_scene(file.scene, {});
    if (scene.polygons.empty() && !scene.surface) std::abort();
    if (scene.camera.kind != Camera::Kind::screen && !(scene.camera.near < scene.camera.far)) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
