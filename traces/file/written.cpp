#include "traces/file/written.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "traces/events/fields.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep {

bool depths_change_sign(const Header& header) {
  using enum Conventions::Depth;
  const Conventions::Depth depth = header.conventions.depth;
  return header.written.axes == WrittenAs::Axes::right_handed &&
         (depth == view || depth == corrected || depth == reciprocal);
}

namespace {

bool is_of_attribute(const FieldOfKind& field) { return field.name == "over_z" || field.name == "one_over_z"; }

/// A number as it was printed, so much larger: what has few decimals still has no more, and shows how it was printed.
double moved_by(double number, double by) {
  constexpr std::ptrdiff_t few = 9;
  const double moved = number + by;
  std::array<char, 400> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr;
  const auto point = std::find(text.data(), end, '.');
  const std::ptrdiff_t decimals = point == end ? 0 : end - point - 1;
  if (!std::isfinite(number) || decimals == 0 || decimals > few) return moved;
  const auto last =
      std::to_chars(text.data(), text.data() + text.size(), moved, std::chars_format::fixed, static_cast<int>(decimals))
          .ptr;
  double printed = moved;
  read_number(std::string_view(text.data(), static_cast<std::size_t>(last - text.data())), printed);
  return printed;
}

/// Of a field in pixels: a place on the raster, not how far two are apart.
bool is_position(const FieldOfKind& field) {
  return field.unit == "px" && field.name != "dx_dy" && field.name != "edge_a" && field.name != "edge_b";
}

bool changes_sign(const FieldOfKind& field, bool depths) {
  return field.name == "z_v" || field.unit == "view^3" || is_of_attribute(field) || (depths && field.unit == "depth");
}

/// Once it clips, a program may go on with the distance, w = -z_v, and have the determinant of that: what lies in view
/// is before the eye, and which way a polygon faces is said besides.
void take_either_sign(Event& event) {
  if (event.index() == kind_of<ClipCross>) {
    auto& e = event.as<ClipCross>();
    e.z_v = std::abs(e.z_v);
  }
  if (event.index() == kind_of<FacingTest>) {
    auto& e = event.as<FacingTest>();
    if (e.facing != Facing::edge_on)
      e.determinant = std::copysign(e.determinant, e.facing == Facing::back ? -1.0 : 1.0);
  }
}

/// The fields of a vector in view coordinates.
bool has_view_coordinates(std::size_t kind) { return kind == kind_of<ViewTransform> || kind == kind_of<ClipCross>; }

/// View coordinates, places on the projection plane and determinants of a program with matrices of its own.
void take_matrices_over(Event& event, const Camera& camera, const Raster& raster, Turned to) {
  const std::size_t kind = event.index();
  if (!has_view_coordinates(kind) && kind != kind_of<Projection> && kind != kind_of<FacingTest>) return;
  const double aspect = static_cast<double>(raster.width) / raster.height;
  glm::dmat4 turned = view_of_matrices(camera.matrices->projection, raster);
  if (to == Turned::as_written) turned = glm::inverse(turned);
  if (has_view_coordinates(kind)) {
    std::array<const FieldOfKind*, 3> fields{};
    glm::dvec4 v(0, 0, 0, 1);
    for (int i = 0; i < 3; ++i) {
      constexpr std::array<std::string_view, 3> names{"x_v", "y_v", "z_v"};
      fields[i] = field_of_kind(kind, names[i]), v[i] = fields[i]->read(event);
    }
    v = turned * v;
    for (int i = 0; i < 3; ++i) fields[i]->write(event, v[i]);
  } else if (kind == kind_of<Projection>) {
    auto& e = event.as<Projection>();
    e.x_p = to == Turned::as_own ? e.x_p * aspect : e.x_p / aspect;
  } else if (kind == kind_of<FacingTest>) {
    event.as<FacingTest>().determinant *= glm::determinant(glm::dmat3(turned));
  }
}

}  // namespace

void turn(Event& event, const Header& header, const Camera& camera, const Raster& raster, Turned to) {
  if (header.written == WrittenAs{} && !camera.matrices) return;
  const bool right_handed = header.written.axes == WrittenAs::Axes::right_handed, depths = depths_change_sign(header);
  const double half = header.written.centre == WrittenAs::Centre::integer ? 0 : to == Turned::as_own ? -0.5 : 0.5;
  if (camera.matrices) take_matrices_over(event, camera, raster, to);
  for (const FieldOfKind& field : fields_of_kind(event.index())) {
    if (field.type != FieldOfKind::Type::real) continue;
    const bool taken_over = camera.matrices && (field.name == "z_v" || field.unit == "view^3");
    if (right_handed && !taken_over && changes_sign(field, depths)) field.write(event, -field.read(event));
    if (half != 0 && is_position(field)) field.write(event, moved_by(field.read(event), half));
  }
  if (right_handed && to == Turned::as_own) take_either_sign(event);
  // A x + B y + C is the same number at a centre, however that is called.
  if (half != 0 && event.index() == kind_of<EdgeFunction>) {
    auto& e = event.as<EdgeFunction>();
    e.edge_c -= half * (e.edge_a + e.edge_b);
  }
}

void turn(Header& header, Turned) {
  if (!depths_change_sign(header)) return;
  using Nearer = Comparison::Nearer;
  header.comparison.nearer = header.comparison.nearer == Nearer::smaller ? Nearer::greater : Nearer::smaller;
  if (header.initial_depth) header.initial_depth = -*header.initial_depth;
}

void turn(Scene& scene, const Header& header, Turned to) {
  // Of a right-handed world, which zstep's is, a left-handed view is mirrored, and a right-handed one is not.
  glm::dmat4& view = scene.camera.view;
  if (!scene.camera.matrices && header.written.axes == WrittenAs::Axes::right_handed && to == Turned::as_own &&
      glm::determinant(glm::dmat3(view)) > 0)
    for (int column = 0; column < 4; ++column) view[column][2] = -view[column][2];
  if (header.written.centre == WrittenAs::Centre::integer || scene.camera.kind != Camera::Kind::screen) return;
  const double half = to == Turned::as_own ? -0.5 : 0.5;
  for (glm::dvec3& point : scene.points) point.x = moved_by(point.x, half), point.y = moved_by(point.y, half);
}

std::string_view kind_that_cannot_turn(const Header& header) {
  if (header.written == WrittenAs{}) return "";
  constexpr std::array on_raster{kind_of<PlaneEquation>, kind_of<ExtentTest>, kind_of<SplitVertex>};
  const auto found =
      std::find_if(on_raster.begin(), on_raster.end(), [&](std::size_t kind) { return records(header, kind); });
  return found == on_raster.end() ? "" : description_of_kind(*found).name;
}

}  // namespace zstep
