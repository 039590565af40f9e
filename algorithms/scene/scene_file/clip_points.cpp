#include "algorithms/scene/scene_file/clip_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "algorithms/scene/scene_file/toml_text.hpp"

namespace zstep::scene {

glm::dvec3 ClipPoints::read(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 4)
    fail_at(node, file_, "a point in clip coordinates does not have four numbers", "write [x, y, z, w]");
  std::array<double, 4> p{};
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = number_in((*list)[i], file_, fmt::format("{} of a point", "xyzw"[i]));
  depths_.push_back({p[3], p[2], &node});
  return {p[0], p[1], -p[3] + 0.0};
}

void ClipPoints::give_camera(Camera& camera) const {
  if (depths_.empty()) return;
  const auto [least, most] = std::minmax_element(depths_.begin(), depths_.end(),
                                                 [](const Depth& one, const Depth& other) { return one.w < other.w; });
  const double z_near = near_ == ClipNear::zero ? 0 : -1;  // z_c/w_c there
  double a = 0, b = 0;
  if (least->w < most->w) {
    a = (most->z - least->z) / (most->w - least->w), b = least->z - a * least->w;
    double near = b / (z_near - a), far = a == 1 ? HUGE_VAL : b / (1 - a);
    if (far < near) std::swap(near, far);     // depths that go from 1 to 0
    if (far < 0 && near > 0) far = HUGE_VAL;  // rounding put it behind the eye
    if (!(near > 0 && near < far))
      fail_at(
          *most->node, file_,
          fmt::format("z = {:.6g} w {:+.6g} follows from it and from line {}, which no projection with a near plane "
                      "before the eye gives",
                      a, b, line_of(*least->node)),
          "write (x_c, y_c, z_c, w_c) before the division by w_c, and \"clip_zero_to_one\" where z_c is 0 at near");
    if (camera.near == 0) camera.near = near;
    if (camera.far == 0) camera.far = far;
  } else {
    if (camera.near == 0 || camera.far == 0)
      fail_at(*most->node, file_, "all points have this w, which leaves the near and the far plane open",
              "give near and far in [camera]; of a parallel projection give the scene in world or screen coordinates");
    const bool infinite = std::isinf(camera.far);
    a = infinite ? 1 : (camera.far - z_near * camera.near) / (camera.far - camera.near);
    b = (z_near - a) * camera.near;
  }
  constexpr double rounding = 1e-5;  // of numbers in float32
  for (const auto& [w, z, node] : depths_)
    if (std::abs(a * w + b - z) > rounding * (std::abs(a * w) + std::abs(b)))
      fail_at(
          *node, file_,
          fmt::format("z is {:.6g}, and other points say z = {:.6g} w {:+.6g}, which is {:.6g}", z, a, b, a * w + b),
          "give the clip coordinates of one projection");
  glm::dmat4 projection(0);
  projection[0][0] = projection[1][1] = 1;
  projection[2][2] = -a, projection[3][2] = b;
  projection[2][3] = -1;
  camera.polar = false;
  camera.matrices = {glm::dmat4(1), projection};
}

}  // namespace zstep::scene
