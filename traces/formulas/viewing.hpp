// From view coordinates to the raster (000, "Viewing"; 003 for pseudodepth; 001, "Scaling Z"), back from there, and the
// rays through pixels. Templates for the reason in outlines.hpp.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "traces/conventions.hpp"
#include "traces/events/polygons.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

/// A row of T_v, (t_1, t_2, t_3, t_4), times a point.
template <class T>
T matrix_row(const T& t_1, const T& t_2, const T& t_3, const T& t_4, const T& x, const T& y, const T& z) {
  return (t_1 * x + t_2 * y) + (t_3 * z + t_4);
}

/// x or y on the projection plane, at distance d from the eye.
template <class T>
T projected(const T& d, const T& xy_v, const T& z_v) {
  return d * xy_v / z_v;
}

/// z* in perspective: near goes to -1, far to +1. a and b are the next two.
template <class T>
T pseudodepth(const T& near, const T& a, const T& b, const T& z_v) {
  return near * (a * z_v + b) / z_v;
}
template <class T>
T pseudodepth_a(const T& near, const T& far) {
  return -(near + far) / (near * (near - far));
}
template <class T>
T pseudodepth_b(const T& near, const T& far) {
  return T(2) * far / (near - far);
}
/// z* in parallel projection.
template <class T>
T parallel_pseudodepth(const T& near, const T& far, const T& z_v) {
  return T(2) * (z_v - near) / (far - near) - T(1);
}

/// All that the depth of a vertex follows from, besides its z_v.
template <class T>
struct DepthScale {
  Conventions::Depth depth;
  bool parallel;
  T near, far;
  bool ranged;  ///< has `low` and `high` in place of 0 and 1
  T low, high;
};
/// A camera's; number(x) is x as a T.
template <class Number>
auto depth_scale(const Camera& camera, Conventions::Depth depth, const Number& number) {
  using T = decltype(number(camera.near));
  const Camera::DepthRange& range = camera.depth_range;
  return DepthScale<T>{depth,
                       camera.kind == Camera::Kind::orthographic,
                       number(camera.near),
                       number(camera.far),
                       !range.is_standard(),
                       number(range.low),
                       number(range.high)};
}

/// The depth that a vertex takes along, where it is not the pseudodepth: z_v; 1/z_v; what is 1 at the near plane and 0
/// at the far one; the (z - z_min)/((1 + z_min)(-z)) of 001 with z = -z_v/F and z_min = -f/F; or its negative.
template <class T>
T other_depth(const DepthScale<T>& as, const T& z_v) {
  const T &near = as.near, &far = as.far;
  const auto in_range = [&](const T& depth) { return as.ranged ? as.low + (as.high - as.low) * depth : depth; };
  switch (as.depth) {
    case Conventions::Depth::corrected:
    case Conventions::Depth::reciprocal:
      return T(1) / z_v;
    case Conventions::Depth::reversed:
      return in_range(as.parallel ? (far - z_v) / (far - near) : near * (far - z_v) / (z_v * (far - near)));
    case Conventions::Depth::foley:
      return as.parallel ? (near - z_v) / (far - near) : far * (near - z_v) / (z_v * (far - near));
    case Conventions::Depth::zero_to_one:
      return in_range(as.parallel ? (z_v - near) / (far - near) : far * (z_v - near) / (z_v * (far - near)));
    default:
      return z_v;
  }
}

/// Whichever of the two it is that a vertex at z_v takes along.
template <class T>
T vertex_depth(const DepthScale<T>& as, const T& z_v) {
  if (as.depth != Conventions::Depth::pseudodepth) return other_depth(as, z_v);
  return as.parallel ? parallel_pseudodepth(as.near, as.far, z_v)
                     : pseudodepth(as.near, pseudodepth_a(as.near, as.far), pseudodepth_b(as.near, as.far), z_v);
}

/// What is in view: from the near to the far plane, and within a window of half width w_x and half height w_y at
/// distance d.
template <class T>
struct ViewVolume {
  bool parallel;
  T near, far, d, w_x, w_y;
};
/// How far inside a plane of the view volume a point in view coordinates is, up to a positive factor: the clip
/// coordinates' -w_c <= x_c <= w_c as a difference. For z they are near <= z_v <= far times a factor; so written it is
/// exact for a face on the plane itself.
template <class T>
T distance_inside(const ViewVolume<T>& volume, ClipPlane plane, const T& x, const T& y, const T& z) {
  if (plane == ClipPlane::near) return z - volume.near;
  if (plane == ClipPlane::far) return volume.far - z;
  const bool sideways = plane == ClipPlane::left || plane == ClipPlane::right;
  const T &window = sideways ? volume.w_x : volume.w_y, &along = sideways ? x : y;
  const T scaled = volume.parallel ? along / window : volume.d * along / window;
  const T w = volume.parallel ? T(1) : z;
  return plane == ClipPlane::left || plane == ClipPlane::bottom ? w + scaled : w - scaled;
}

/// Half the width of the window, from half its height: pixels are square.
template <class T>
T window_width(const T& w_y, const T& width, const T& height) {
  return w_y * width / height;
}

/// The window of half width w_x and half height w_y becomes the raster, on which pixels are seen at whole numbers: at
/// their centres or at their corners. Rows go down from the top of the window or up from its bottom.
template <class T>
T screen_x(const T& x_p, const T& w_x, const T& width, const Raster& raster) {
  const T x = (x_p + w_x) / (T(2) * w_x) * width;
  return raster.corners ? x : x - T(0.5);
}
template <class T>
T screen_y(const T& y_p, const T& w_y, const T& height, const Raster& raster) {
  if (raster.y_up) return screen_x(y_p, w_y, height, raster);
  const T y = (w_y - y_p) / (T(2) * w_y) * height;
  return raster.corners ? y : y - T(0.5);
}

// From a pixel and its depth back to view coordinates: undoes the steps above, the last one first. Templates
// for the reason in outlines.hpp.

/// From the border of the raster to where a pixel is seen.
template <class T>
T within(const T& pixel, const Raster& raster) {
  return raster.corners ? pixel : pixel + T(0.5);
}
/// Where on the projection plane a pixel is seen, in a window of half width w_x and half height w_y.
template <class T>
T window_x(const T& x, const T& w_x, const T& width, const Raster& raster) {
  return (T(2) * within(x, raster) / width - T(1)) * w_x;
}
template <class T>
T window_y(const T& y, const T& w_y, const T& height, const Raster& raster) {
  return raster.y_up ? window_x(y, w_y, height, raster) : (T(1) - T(2) * within(y, raster) / height) * w_y;
}

/// z_v from z* = f (a z + b) / z with a = -(f + F) / (f (f - F)) and b = 2 F / (f - F) (003), solved for z.
template <class T>
T depth_of_pseudodepth(const T& near, const T& far, const T& z) {
  return T(2) * near * far / (far + near - z * (far - near));
}
/// The same in parallel projection.
template <class T>
T depth_of_parallel_pseudodepth(const T& near, const T& far, const T& z) {
  return near + (z + T(1)) * (far - near) / T(2);
}

// The rays through the centres of a picture's pixels, X = X_0 + t dX in the world (002): from the eye, with t = 1 on
// the projection plane; parallel ones have t = z_v, those of a screen scene its z.

/// Where a pixel's ray meets the projection plane.
template <class T>
T ray_x(const T& x, const T& w_x, const T& width, const Raster& raster) {
  return within(x, raster) * T(2) * w_x / width - w_x;
}
template <class T>
T ray_y(const T& y, const T& w_y, const T& height, const Raster& raster) {
  return raster.y_up ? ray_x(y, w_y, height, raster) : w_y - within(y, raster) * T(2) * w_y / height;
}

/// The axes of view coordinates in the world, x_v's first: what lies at (x_v, y_v, z_v) from the eye is so much of
/// each. They are the rows of T_v, which are of length 1 and square to each other, but of a projection matrix of one's
/// own the columns of its inverse.
inline glm::dmat3 axes_of_view(const Camera& camera) {
  const glm::dmat3 view(camera.view);
  return camera.matrices ? glm::inverse(view) : glm::transpose(view);
}

class EyeRays {
 public:
  EyeRays(const Camera& camera, const Raster& raster)
      : kind_(camera.kind),
        d_(camera.d),
        window_x_(camera.window * raster.width / raster.height),
        window_y_(camera.window),
        width_(raster.width),
        height_(raster.height),
        raster_(raster) {
    const glm::dmat3 axes = axes_of_view(camera);
    right_ = axes[0], up_ = axes[1], away_ = axes[2];
    const glm::dvec3 origin(camera.view[3]);  // of the world, in view coordinates
    const bool parallel = kind_ == Camera::Kind::orthographic;
    eye_ = parallel ? -(origin.x * right_ + origin.y * up_ + origin.z * away_) : camera.eye;
  }

  struct Ray {
    glm::dvec3 from, along;
  };
  /// Of a place of the raster; pixels' centres are at integers.
  Ray through(double x, double y) const {
    if (kind_ == Camera::Kind::screen) return {{x, y, 0}, {0, 0, 1}};
    const double x_p = ray_x(x, window_x_, width_, raster_), y_p = ray_y(y, window_y_, height_, raster_);
    const glm::dvec3 across = x_p * right_ + y_p * up_;
    if (kind_ == Camera::Kind::orthographic) return {eye_ + across, away_};
    return {eye_, across + d_ * away_};
  }

 private:
  Camera::Kind kind_;
  double d_, window_x_, window_y_, width_, height_;
  Raster raster_;
  glm::dvec3 eye_, right_, up_, away_;  // the axes of view coordinates in the world
};

}  // namespace zstep::formulas
