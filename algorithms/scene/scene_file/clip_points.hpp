// Points in clip coordinates, as a vertex shader hands them on and a debugger of graphics programs shows them:
// (x_c, y_c, z_c, w_c), in view where -w_c <= x_c, y_c <= w_c and z_c lies between -w_c or 0 and w_c.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <toml++/toml.h>

#include "traces/scene.hpp"

namespace zstep::scene {

/// What the near plane's z_c is: -w_c, as in OpenGL, or 0, as in Direct3D and Vulkan.
enum class ClipNear { minus_w, zero };

/// In the world that these make, the eye stands at the origin and looks along -z: a point is at (x_c, y_c, -w_c), and a
/// projection matrix takes it back to its clip coordinates.
class ClipPoints {
 public:
  ClipPoints(const std::string& file, ClipNear near) : file_(file), near_(near) {}

  /// A point [x, y, z, w]. Throws InputError where it is none.
  glm::dvec3 read(const toml::node& node);

  /// Once all are read: the camera by its matrices, and its planes where it has none yet. Clip coordinates of one
  /// projection have z_c = a w_c + b; the two points whose w_c are farthest apart say a and b, the planes where all
  /// have the same w_c. Throws InputError where a point has another z_c, by the line that it stands at.
  void give_camera(Camera& camera) const;

 private:
  struct Depth {
    double w, z;
    const toml::node* node;
  };
  const std::string& file_;
  ClipNear near_;
  std::vector<Depth> depths_;
};

}  // namespace zstep::scene
