// The mathematics of the camera: world to view, view to the projection plane, window to viewport.
//
// The notes: 000 (Eckert, lecture 21, Binghamton University, 2001) for T_v, projection and window; 003 (Sigal, CSC D18,
// University of Toronto, 2008) for pseudodepth and the canonical view volume.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "traces/formulas/viewing.hpp"
#include "traces/scene.hpp"

namespace zstep::viewing {

// The viewing transformation taken apart: T_v = T_4 T_3 T_2 T_1, as 000 composes it.

/// T_1 … T_4 of a camera, with (theta, phi) the direction from which its eye looks:
///     T_1  moves the origin to the eye,
///     T_2  turns about z by 90° - theta, so that x lies level across the line of sight,
///     T_3  turns about x by phi - 180°, so that z lies along the line of sight,
///     T_4  changes the sign of x: view coordinates are left-handed.
/// None where the eye is no point (orthographic, screen scenes), or where the camera is tilted about its line of sight,
/// which takes a fifth.
std::optional<std::array<glm::dmat4, 4>> view_factors(const Camera& camera);

/// T_v of 000: world to view for an eye at distance rho that looks at the origin. Angles in degrees, theta in the x–y
/// plane from the x axis, phi from the z axis. Left-handed: x_v right, y_v up, z_v away from the eye. Column vectors: v
/// = T_v * w.
glm::dmat4 eckert_view(double rho, double theta_degrees, double phi_degrees);

/// Where that eye stands in the world.
glm::dvec3 eckert_eye(double rho, double theta_degrees, double phi_degrees);

/// World to view for an eye that looks at `target`, with `up` upwards in the picture; left-handed as T_v is. `eye` and
/// `target` must differ. An `up` along the line of sight says nothing: the world axis furthest from that line stands
/// in.
glm::dmat4 look_at_view(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up);

/// The light as a camera that sees what it shines on, with the world's z axis upwards.
Camera camera_of(const Light& light);

/// Half the height of the window on a projection plane at distance d that is seen under this angle: d * tan(angle/2).
double window_for_field_of_view(double degrees_vertical, double d);

/// The coefficients of pseudodepth, z* = f (a z + b) / z with f the near and F the far distance: near goes to -1, far
/// to +1.
struct DepthCoefficients {
  double a, b;
};
DepthCoefficients depth_coefficients(double near, double far);

/// So near the raster's first border a vertex lies on it, in pixels, where pixels are seen at their corners.
inline constexpr double border_width = 1e-9;

/// A camera made ready for one raster: all that lies between view coordinates and the raster.
struct Lens {
  Lens(const Camera& camera, const Raster& raster, Conventions::Depth depth);

  /// View to clip coordinates (x_c, y_c, z_c, w_c): what is in view has -w_c <= x_c, y_c, z_c <= w_c. The perspective
  /// division is still to come, so this is good for points beside and behind the eye too.
  glm::dvec4 clip_coordinates(glm::dvec3 view) const;

  /// View to the projection plane: (x_p, y_p) and the depth that will be interpolated. Perspective needs z_v > 0.
  glm::dvec3 project(glm::dvec3 view) const;

  /// Window to viewport: (x_s, y_s), on which pixels are seen at integers.
  glm::dvec2 to_viewport(double x_p, double y_p) const;

  bool orthographic;
  formulas::DepthScale<double> scale;  ///< which depth project() gives
  double d;                            ///< distance of the projection plane
  double window_x, window_y;           ///< half the width and half the height of the window on it
  double near, far;                    ///< z_v of the clipping planes
  double a, b;                         ///< of pseudodepth
  double width, height;                ///< of the raster, in pixels
  Raster raster;
  /// Where to_viewport() may put a vertex: whole pixels are the int x_s, y_s of 000.
  Conventions::Positions positions = Conventions::Positions::exact;
};

}  // namespace zstep::viewing
