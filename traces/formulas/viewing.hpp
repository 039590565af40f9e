// From view coordinates to the raster (000, "Viewing"; 003 for pseudodepth; 001, "Scaling Z"). Templates for the
// reason in lines.hpp.
#pragma once

#include "traces/conventions.hpp"
#include "traces/events/polygons.hpp"

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

/// The depth that a vertex takes along, where it is not the pseudodepth: z_v; 1/z_v; what is 1 at the near plane and 0
/// at the far one; or the (z - z_min)/((1 + z_min)(-z)) of 001 with z = -z_v/F and z_min = -f/F.
template <class T>
T other_depth(Conventions::Depth depth, bool parallel, const T& near, const T& far, const T& z_v) {
  switch (depth) {
    case Conventions::Depth::corrected:
    case Conventions::Depth::reciprocal:
      return T(1) / z_v;
    case Conventions::Depth::reversed:
      return parallel ? (far - z_v) / (far - near) : near * (far - z_v) / (z_v * (far - near));
    case Conventions::Depth::foley:
      return parallel ? (near - z_v) / (far - near) : far * (near - z_v) / (z_v * (far - near));
    default:
      return z_v;
  }
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

/// The window of half width w_x and half height w_y becomes the raster; pixel centres are at whole numbers.
template <class T>
T screen_x(const T& x_p, const T& w_x, const T& width) {
  return (x_p + w_x) / (T(2) * w_x) * width - T(0.5);
}
template <class T>
T screen_y(const T& y_p, const T& w_y, const T& height) {
  return (w_y - y_p) / (T(2) * w_y) * height - T(0.5);
}

}  // namespace zstep::formulas
