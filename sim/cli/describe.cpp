#include "sim/cli/describe.hpp"

#include "traces/events/fields.hpp"

#include <array>

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
  constexpr std::array texts{"pseudodepth (linear on the picture)",
                             "view (z_v)",
                             "corrected (z_v, by way of 1/z_v)",
                             "reciprocal (1/z_v)",
                             "reversed (1 at the near plane, 0 at the far one)",
                             "foley (0 at the near plane, -1 at the far one)"};
  return texts[static_cast<std::size_t>(depth)];
}

std::string interpolation_text(Conventions::Interpolation interpolation) {
  constexpr std::array texts{"direct formula", "increments", "the plane's slopes -A/C and -B/C",
                             "the plane's slopes -A/C and -B/C, added"};
  return texts[static_cast<std::size_t>(interpolation)];
}

std::string coverage_text(Conventions::Coverage coverage, const Raster& raster) {
  switch (coverage) {
    case Conventions::Coverage::inclusive:
      return "inclusive (every x from x_L to x_R)";
    case Conventions::Coverage::round:
      return "round(x_L) to round(x_R)";
    case Conventions::Coverage::ceil_floor:
      return "ceil(x_L) to floor(x_R)";
    case Conventions::Coverage::top_left:
      break;
  }
  return fmt::format("top-left (centres inside, ties to the left edge and to that of the smaller y, the {} one)",
                     raster.y_up ? "bottom" : "top");
}

std::string nearer_text(Comparison::Nearer nearer) {
  return nearer == Comparison::Nearer::smaller ? "the smaller depth wins" : "the greater depth wins";
}

std::string ties_text(Comparison::Ties ties) {
  return ties == Comparison::Ties::first ? "of equal depths the first stays" : "of equal depths the last wins";
}

std::string numbers_text(const Conventions& conventions) {
  std::string text(word_of(conventions.number_format));
  if (bits_of(conventions.number_format) > 0)
    text += conventions.rounding == Conventions::Rounding::nearest ? ", rounded" : ", cut off";
  if (conventions.positions == Conventions::Positions::integer) text += ", vertices at whole pixels";
  if (conventions.attribute == Conventions::Attribute::linear) text += ", attribute linear on the picture";
  if (conventions.attribute == Conventions::Attribute::perspective) text += ", attribute perspective-correct";
  return text;
}

std::string value_text(double value) { return fmt::format("{}", value); }

std::string fields_text(const Event& event) {
  std::string text;
  for (const FieldOfKind& field : fields_of_kind(event.index())) {
    text += fmt::format("{}{}=", text.empty() ? "" : " ", field.name);
    switch (field.type) {
      case FieldOfKind::Type::whole:
        text += std::to_string(field.whole_in(event));
        break;
      case FieldOfKind::Type::real:
        text += value_text(field.read(event));
        break;
      case FieldOfKind::Type::truth:
        text += field.true_in(event) ? "true" : "false";
        break;
      case FieldOfKind::Type::word:
        text += field.word_in(event);
        break;
    }
  }
  return text;
}

}  // namespace zstep::cli
