// From a pixel and its depth back to view coordinates: undoes the steps of viewing.hpp, the last one first. Templates
// for the reason in lines.hpp.
#pragma once

namespace zstep::formulas {

/// Where on the projection plane the centre of a pixel is, in a window of half width w_x and half height w_y.
template <class T>
T window_x(const T& x, const T& w_x, const T& width) {
  return (T(2) * (x + T(0.5)) / width - T(1)) * w_x;
}
template <class T>
T window_y(const T& y, const T& w_y, const T& height) {
  return (T(1) - T(2) * (y + T(0.5)) / height) * w_y;
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

}  // namespace zstep::formulas
