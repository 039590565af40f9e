// The rays through the centres of a picture's pixels, X = X_0 + t dX in the world (002): from the eye, with t = 1 on
// the projection plane; parallel ones have t = z_v, those of a screen scene its z.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "traces/scene.hpp"

namespace zstep::formulas {

/// A pixel's centre on the projection plane.
template <class T>
T ray_x(const T& x, const T& w_x, const T& width) {
  return (x + T(0.5)) * T(2) * w_x / width - w_x;
}
template <class T>
T ray_y(const T& y, const T& w_y, const T& height) {
  return w_y - (y + T(0.5)) * T(2) * w_y / height;
}

class EyeRays {
 public:
  EyeRays(const Camera& camera, const Raster& raster)
      : kind_(camera.kind),
        d_(camera.d),
        window_x_(camera.window * raster.width / raster.height),
        window_y_(camera.window),
        width_(raster.width),
        height_(raster.height) {
    const glm::dmat4& view = camera.view;
    right_ = {view[0][0], view[1][0], view[2][0]};
    up_ = {view[0][1], view[1][1], view[2][1]};
    away_ = {view[0][2], view[1][2], view[2][2]};
    const glm::dvec3 origin(view[3]);  // of the world, in view coordinates
    const bool parallel = kind_ == Camera::Kind::orthographic;
    eye_ = parallel ? -(origin.x * right_ + origin.y * up_ + origin.z * away_) : camera.eye;
  }

  struct Ray {
    glm::dvec3 from, along;
  };
  /// Of a place of the raster; pixels' centres are at integers.
  Ray through(double x, double y) const {
    if (kind_ == Camera::Kind::screen) return {{x, y, 0}, {0, 0, 1}};
    const double x_p = ray_x(x, window_x_, width_), y_p = ray_y(y, window_y_, height_);
    const glm::dvec3 across = x_p * right_ + y_p * up_;
    if (kind_ == Camera::Kind::orthographic) return {eye_ + across, away_};
    return {eye_, across + d_ * away_};
  }

 private:
  Camera::Kind kind_;
  double d_, window_x_, window_y_, width_, height_;
  glm::dvec3 eye_, right_, up_, away_;  // the axes of view coordinates in the world
};

}  // namespace zstep::formulas
