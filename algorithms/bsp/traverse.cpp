#include "algorithms/bsp/traverse.hpp"

#include <cmath>

#include <glm/matrix.hpp>

#include "algorithms/viewing/camera.hpp"
#include "traces/formulas/outlines.hpp"

namespace zstep::bsp {

Eye eye_of(const Camera& camera, const Raster& raster, bool discard) {
  if (camera.kind == Camera::Kind::screen) return {{0, 0, -1, 0}, {}};
  const viewing::Lens lens(camera, raster, Conventions::Depth::pseudodepth);
  Eye eye{{camera.eye, lens.orthographic ? 0.0 : 1.0}, {}};
  if (!discard) return eye;

  const glm::dmat4 to_world = glm::inverse(camera.view);
  for (int corner = 0; corner < 8; ++corner) {
    const double z = (corner & 4) != 0 ? lens.far : lens.near, scale = lens.orthographic ? 1 : z / lens.d;
    const double x = (corner & 1) != 0 ? lens.window_x : -lens.window_x;
    const double y = (corner & 2) != 0 ? lens.window_y : -lens.window_y;
    eye.volume.emplace_back(to_world * glm::dvec4(x * scale, y * scale, z, 1));
  }
  return eye;
}

Reach reach_of(const Eye& eye, const pieces::Plane& plane) {
  if (eye.volume.empty()) return {};
  Reach reach{plane.value(eye.volume[0]), plane.value(eye.volume[0])};
  for (const glm::dvec3& corner : eye.volume) {
    reach.least = std::fmin(reach.least, plane.value(corner));
    reach.greatest = std::fmax(reach.greatest, plane.value(corner));
  }
  return reach;
}

std::optional<Reject> turned_away(const Tree& tree, const Node& node, const Piece& piece, double value, glm::dvec4 eye,
                                  bool cull) {
  const double distance = eye.w == 0 ? 1 : glm::length(glm::dvec3(eye) - tree.point(piece.outline[0]));
  if (std::abs(value) <= formulas::edge_on_sine * distance) return Reject::edge_on;
  const bool same_way = glm::dot(piece.plane.normal(), node.plane.normal()) > 0;
  if (cull && same_way != (value > 0)) return Reject::back_facing;
  return std::nullopt;
}

}  // namespace zstep::bsp
