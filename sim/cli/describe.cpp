#include "sim/cli/describe.hpp"

#include <fmt/format.h>

namespace zstep::cli {

std::string camera_text(const Camera& camera) {
  if (camera.kind == Camera::Kind::screen) return "none: the points are (x_s, y_s, z) of the screen";
  const std::string where = camera.polar ? fmt::format("rho {}, theta {}, phi {}", camera.rho, camera.theta, camera.phi)
                                         : fmt::format("eye ({}, {}, {})", camera.eye.x, camera.eye.y, camera.eye.z);
  const std::string range = fmt::format("window {}, near {}, far {}", camera.window, camera.near, camera.far);
  if (camera.kind == Camera::Kind::orthographic) return fmt::format("orthographic, {}, {}", where, range);
  return fmt::format("perspective, {}, d {}, {}", where, camera.d, range);
}

std::string raster_text(const Raster& raster) {
  return fmt::format("{}x{}, row 0 {}", raster.width, raster.height, raster.y_up ? "at the bottom" : "on top");
}

std::string depth_text(const Camera& camera, Conventions::Depth depth) {
  if (camera.kind == Camera::Kind::screen) return "the points' own z";
  return depth == Conventions::Depth::pseudodepth ? "pseudodepth (linear on the picture)" : "view (z_v)";
}

std::string interpolation_text(Conventions::Interpolation interpolation) {
  return interpolation == Conventions::Interpolation::direct ? "direct formula" : "increments";
}

std::string coverage_text(Conventions::Coverage coverage, const Raster& raster) {
  if (coverage == Conventions::Coverage::inclusive) return "inclusive (every x from x_L to x_R)";
  return fmt::format("top-left (centres inside, ties to the left edge and to that of the smaller y, the {} one)",
                     raster.y_up ? "bottom" : "top");
}

std::string nearer_text(Comparison::Nearer nearer) {
  return nearer == Comparison::Nearer::smaller ? "the smaller depth wins" : "the greater depth wins";
}

std::string ties_text(Comparison::Ties ties) {
  return ties == Comparison::Ties::first ? "of equal depths the first stays" : "of equal depths the last wins";
}

std::string number_format_text(NumberFormat format) { return format == NumberFormat::float64 ? "float64" : "float32"; }

std::string value_text(double value) { return fmt::format("{}", value); }

}  // namespace zstep::cli
