// Scenes in which the signs that methods decide by are all but 0: single last digits of a coordinate turn them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::test {

/// A scene and the methods whose decisions it is made for.
struct NearDegenerate {
  Scene scene;
  std::vector<std::string> methods;
};

/// The `number`-th of the family, always the same. Triangles whose vertices are single last digits away from: pixel
/// centres on edges, each other's edges and planes, one line, one plane with the eye, the planes of the view volume;
/// and surfaces whose curves run along each other.
NearDegenerate near_degenerate(std::uint64_t number);

/// The scene file of a scene of polygons, each number with all its digits.
std::string scene_file_of(const Scene& scene);

}  // namespace zstep::test
