#include "algorithms/viewing/camera.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/math/kernels.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep::viewing {

std::optional<std::array<glm::dmat4, 4>> view_factors(const Camera& camera) {
  constexpr double level = 1e-12;
  const glm::dmat4& view = camera.view;
  if (camera.kind != Camera::Kind::perspective || !(std::abs(view[2][0]) <= level)) return std::nullopt;
  // As they stand in T_v: what angles and vectors give is then the same to the last bit.
  const double sin_theta = -view[0][0], cos_theta = view[1][0], sin_phi = view[2][1], cos_phi = -view[2][2];
  const glm::dvec3& eye = camera.eye;
  return std::array{view_from_rows({1, 0, 0, -eye.x}, {0, 1, 0, -eye.y}, {0, 0, 1, -eye.z}),
                    view_from_rows({sin_theta, -cos_theta, 0, 0}, {cos_theta, sin_theta, 0, 0}, {0, 0, 1, 0}),
                    view_from_rows({1, 0, 0, 0}, {0, -cos_phi, sin_phi, 0}, {0, -sin_phi, -cos_phi, 0}),
                    view_from_rows({-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0})};
}

namespace {

constexpr double pi = 3.14159265358979323846;

struct Turn {
  double sine, cosine;
};

// Sine and cosine of an angle in degrees. The reduction is made in degrees, where it is exact: the sine of 180 degrees
// is 0, not 1e-16, and that of 30 is one half, as a student who checks the matrix by hand expects.
Turn turned_by(double degrees) {
  int quadrant = 0;
  const double rest = std::remquo(degrees, 90.0, &quadrant);  // -45 … 45
  const double sine = std::abs(rest) == 30 ? std::copysign(0.5, rest) : portable::sin(rest * pi / 180);
  const double cosine = portable::cos(rest * pi / 180);
  return portable::after_quarter_turns(quadrant, Turn{sine, cosine});
}

}  // namespace

glm::dmat4 eckert_view(double rho, double theta_degrees, double phi_degrees) {
  const auto [sin_theta, cos_theta] = turned_by(theta_degrees);
  const auto [sin_phi, cos_phi] = turned_by(phi_degrees);
  // 000, "Composite Viewing Transformation Matrix"
  return view_from_rows({-sin_theta, cos_theta, 0, 0},                             //
                        {-cos_phi * cos_theta, -cos_phi * sin_theta, sin_phi, 0},  //
                        {-sin_phi * cos_theta, -sin_phi * sin_theta, -cos_phi, rho});
}

glm::dvec3 eckert_eye(double rho, double theta_degrees, double phi_degrees) {
  const auto [sin_theta, cos_theta] = turned_by(theta_degrees);
  const auto [sin_phi, cos_phi] = turned_by(phi_degrees);
  return glm::dvec3(rho * sin_phi * cos_theta, rho * sin_phi * sin_theta, rho * cos_phi) + 0.0;  // -0 becomes 0
}

glm::dmat4 look_at_view(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up) {
  return zstep::look_at_view(eye, target, up);
}
Camera camera_of(const Light& light) { return zstep::camera_of(light); }

double window_for_field_of_view(double degrees_vertical, double d) {
  // 003, "Field of View", prints ½·tan(α) = ½(T − B)/f; the half belongs to the angle: tan(α/2) = ½(T − B)/f.
  const Turn half = turned_by(degrees_vertical / 2);
  return d * half.sine / half.cosine;
}

DepthCoefficients depth_coefficients(double near, double far) {
  // 003, "View Volume": the third row of M_p. As printed its two entries stand in each other's columns and would not
  // take near to -1 and far to +1; a belongs to z, b to the constant.
  return {formulas::pseudodepth_a(near, far), formulas::pseudodepth_b(near, far)};
}

Lens::Lens(const Camera& camera, const Raster& raster_, Conventions::Depth depth)
    : orthographic(camera.kind == Camera::Kind::orthographic),
      scale(formulas::depth_scale(camera, depth, [](double number) { return number; })),
      d(camera.d),
      window_x(camera.window * raster_.width / raster_.height),
      window_y(camera.window),
      near(camera.near),
      far(camera.far),
      a(depth_coefficients(near, far).a),
      b(depth_coefficients(near, far).b),
      width(raster_.width),
      height(raster_.height),
      raster(raster_) {}

glm::dvec4 Lens::clip_coordinates(glm::dvec3 view) const {
  if (orthographic) return {view.x / window_x, view.y / window_y, formulas::parallel_pseudodepth(near, far, view.z), 1};
  return {d * view.x / window_x, d * view.y / window_y, near * (a * view.z + b), view.z};
}

glm::dvec3 Lens::project(glm::dvec3 view) const {
  // z as in 000 where it is asked for; else z* as in 003, which is linear on the raster, so that interpolating it is
  // exact.
  const bool other = scale.depth != Conventions::Depth::pseudodepth;
  const double z = other          ? formulas::other_depth(scale, view.z)
                   : orthographic ? formulas::parallel_pseudodepth(near, far, view.z)
                                  : formulas::pseudodepth(near, a, b, view.z);
  if (orthographic) return {view.x, view.y, z};
  return {formulas::projected(d, view.x, view.z), formulas::projected(d, view.y, view.z), z};
}

glm::dvec2 Lens::to_viewport(double x_p, double y_p) const {
  const glm::dvec2 at{formulas::screen_x<double>(x_p, window_x, width, raster),
                      formulas::screen_y<double>(y_p, window_y, height, raster)};
  // What is cut off at the border of the window lies on the first pixels' corners, and not beside them by rounding.
  const auto on_border = [&](double x) { return raster.corners && std::abs(x) < border_width ? 0 : x; };
  return {formulas::snapped(on_border(at.x), positions), formulas::snapped(on_border(at.y), positions)};
}

}  // namespace zstep::viewing
