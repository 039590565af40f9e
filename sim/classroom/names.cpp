// What names mean at a moment of a run: the fields of events, and what means something at every step: what is at work,
// the fragment, the span, the camera, the sizes.

#include "sim/classroom/names.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "algorithms/catalog/catalog.hpp"
#include "traces/error.hpp"
#include "traces/formulas/of_light.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::classroom {

Quantity::Type type_of(const FieldOfKind& field) {
  switch (field.type) {
    case FieldOfKind::Type::truth:
      return Quantity::Type::truth;
    case FieldOfKind::Type::word:
      return Quantity::Type::word;
    default:
      return field.name == "polygon" ? Quantity::Type::polygon : Quantity::Type::number;
  }
}

std::optional<Quantity> field_value(const Event& event, std::string_view name) {
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  if (!field) return std::nullopt;
  if (field->type == FieldOfKind::Type::word) return Quantity::of_word(field->word_in(event));
  return Quantity{type_of(*field), field->read(event), {}};
}

// The names that mean something at every step: what is at work, the fragment, the span, the camera, the sizes.

namespace {

[[noreturn]] void lacking(const Moment& moment, std::string_view what, std::string_view from) {
  throw InputError(moment.where, fmt::format("there is no {} at this step", what),
                   fmt::format("attach the stop to a step after {}", from));
}

const SpanBegin& span_at(const Moment& moment) {
  const auto& span = moment.state().machine.span;
  if (!span) lacking(moment, "span", "scan_conversion.span");
  return *span;
}
const Fragment& fragment_at(const Moment& moment) {
  const auto& fragment = moment.state().machine.fragment;
  if (!fragment) lacking(moment, "pixel at work", "interpolate_z");
  return *fragment;
}
/// That of the ray at work, if there is one, else that of the fragment.
glm::ivec2 pixel_at(const Moment& moment) {
  const RayWork& rays = moment.state().machine.rays;
  for (const RayRow& row : rays.tree)
    if (rays.ray == row.entry.ray) return {row.entry.x, row.entry.y};
  return {fragment_at(moment).x, fragment_at(moment).y};
}
const FacingTest& facing_at(const Moment& moment) {
  const auto& facing = moment.state().machine.facing;
  if (!facing) lacking(moment, "facing test", "facing");
  return *facing;
}
const auto& curve_at(const Moment& moment) {
  const auto& curve = moment.state().machine.horizon.curve;
  if (!curve) lacking(moment, "curve at work", "floating_horizon.curve");
  return *curve;
}
const Camera& camera_at(const Moment& moment) { return moment.trace().scene().camera; }

/// Just before interpolate_z, or a paint without one, the state still has the last fragment; the buffers have the
/// stored values of the coming one. This is its pixel.
std::optional<std::size_t> coming_pixel(const Moment& moment) {
  if (!moment.event) return std::nullopt;
  const auto pixel_of = [&](const auto& coming) -> std::optional<std::size_t> {
    const auto& fragment = moment.state().machine.fragment;
    const bool arrived =
        fragment && fragment->x == coming.x && fragment->y == coming.y && fragment->z == coming.z && !fragment->nearer;
    if (arrived) return std::nullopt;
    return moment.state().picture.at(coming.x, coming.y);
  };
  if (const auto* coming = get_if<DepthInterpolate>(&moment.event->event)) return pixel_of(*coming);
  if (const auto* coming = get_if<PixelPaint>(&moment.event->event)) return pixel_of(*coming);
  return std::nullopt;
}
Quantity stored(const Moment& moment) {
  if (const auto pixel = coming_pixel(moment)) return Quantity::of(moment.state().picture.depth[*pixel]);
  return Quantity::of(fragment_at(moment).stored);
}
Quantity stored_polygon(const Moment& moment) {
  if (const auto pixel = coming_pixel(moment)) return Quantity::of_polygon(moment.state().picture.polygon[*pixel]);
  return Quantity::of_polygon(fragment_at(moment).stored_polygon);
}

/// Does a pixel show less than half of the light that its polygon can have?
bool is_dark(const Scene& scene, const Picture& picture, std::size_t pixel) {
  const Color full = scene.polygons[picture.polygon[pixel]].color, shown = color_at(picture, scene, pixel);
  const double half = formulas::kept_of_color(formulas::in_shadow, 0.5);
  return shown.red + shown.green + shown.blue < half * (full.red + full.green + full.blue);
}
/// The pixels that are dark, or lit, where a ray from their point to the lamp says otherwise.
Quantity wrongly(const Moment& moment, bool dark) {
  const Scene& scene = moment.trace().scene();
  if (!scene.light) throw InputError(moment.where, "the scene has no light", "name a scene with a [light]");
  Conventions conventions;
  conventions.cull = moment.trace().header().conventions.cull;
  conventions.options["depth"] = "0";
  NullRecorder nothing;
  const Picture rays = method("ray-tracing").render(scene, conventions, nothing);
  const Picture& picture = moment.state().picture;
  double wrong = 0;
  for (std::size_t pixel = 0; pixel < picture.polygon.size(); ++pixel) {
    if (picture.polygon[pixel] == no_polygon || picture.polygon[pixel] != rays.polygon[pixel]) continue;
    if (is_dark(scene, picture, pixel) == dark && is_dark(scene, rays, pixel) != dark) ++wrong;
  }
  return Quantity::of(wrong);
}

double count(std::size_t size) { return static_cast<double>(size); }

using Type = Quantity::Type;
#define OF_SPAN(member, meaning)                                                                    \
  KnownName {                                                                                       \
#member, Type::number, [](const Moment& m) { return Quantity::of(span_at(m).member); }, meaning \
  }
#define OF_FACING(member, meaning)                                                                    \
  KnownName {                                                                                         \
#member, Type::number, [](const Moment& m) { return Quantity::of(facing_at(m).member); }, meaning \
  }
#define OF_CAMERA(member, meaning)                                                                    \
  KnownName {                                                                                         \
#member, Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).member); }, meaning \
  }

const KnownName names[] = {
    {"polygon", Type::polygon, [](const Moment& m) { return Quantity::of_polygon(m.state().machine.polygon); },
     "the polygon at work"},
    {"facet", Type::number, [](const Moment& m) { return Quantity::of(m.state().machine.facet); }, "the facet at work"},
    {"scan_line", Type::number,
     [](const Moment& m) {
       const auto& line = m.state().machine.scan_line;
       if (!line) lacking(m, "scan line", "scan_line");
       return Quantity::of(*line);
     },
     "the scan line at work"},
    {"active", Type::number, [](const Moment& m) { return Quantity::of(count(m.state().machine.active.size())); },
     "how many edges are active"},
    {"outline", Type::number, [](const Moment& m) { return Quantity::of(count(m.state().machine.outline.size())); },
     "how many vertices the polygon has as it is drawn"},
    {"stored", Type::number, stored, "the depth buffer's number at the pixel, before this fragment"},
    {"stored_polygon", Type::polygon, stored_polygon, "the polygon seen at the pixel, before this fragment"},
    {"x", Type::number, [](const Moment& m) { return Quantity::of(pixel_at(m).x); }, "column of the pixel at work"},
    {"y", Type::number, [](const Moment& m) { return Quantity::of(pixel_at(m).y); }, "row of the pixel at work"},
    {"z", Type::number, [](const Moment& m) { return Quantity::of(fragment_at(m).z); },
     "the polygon's depth at that pixel"},
    {"nearer", Type::truth,
     [](const Moment& m) {
       const Fragment& fragment = fragment_at(m);
       if (!fragment.nearer) lacking(m, "outcome of a compare", "compare");
       return Quantity::of_truth(*fragment.nearer);
     },
     "whether the pixel at work won its compare"},
    {"curve", Type::number, [](const Moment& m) { return Quantity::of(curve_at(m).curve); }, "the curve at work"},
    {"constant", Type::number, [](const Moment& m) { return Quantity::of(curve_at(m).constant); },
     "the z that is constant on the curve at work"},
    OF_SPAN(left_edge, "the span's edge on the left"),
    OF_SPAN(right_edge, "the span's edge on the right"),
    OF_SPAN(first, "the span's first pixel"),
    OF_SPAN(last, "the span's last pixel"),
    OF_SPAN(x_left, "x where the span begins"),
    OF_SPAN(z_left, "depth where the span begins"),
    OF_SPAN(x_right, "x where the span ends"),
    OF_SPAN(z_right, "depth where the span ends"),
    OF_SPAN(dz_dx, "what depth gains from pixel to pixel of the span"),
    {"facing", Type::word, [](const Moment& m) { return Quantity::of_word(word_of(facing_at(m).facing)); },
     "the verdict of the facing test"},
    OF_FACING(determinant, "the facing test's determinant"),
    OF_FACING(plane_at_eye, "the facet's plane equation at the eye"),
    OF_FACING(view_dot_normal, "(p - e) . n of the facet"),
    OF_FACING(projected_normal_z, "z of the facet's normal after projection"),
    OF_CAMERA(rho, "distance of the eye from the origin"),
    OF_CAMERA(theta, "the eye's angle around the z axis, degrees"),
    OF_CAMERA(phi, "the eye's angle from the z axis, degrees"),
    OF_CAMERA(d, "distance of the projection plane"),
    OF_CAMERA(window, "half the height of the window"),
    OF_CAMERA(near, "z_v of the near plane"),
    OF_CAMERA(far, "z_v of the far plane"),
    {"eye_x", Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).eye.x); }, "the eye in the world"},
    {"eye_y", Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).eye.y); }, "the eye in the world"},
    {"eye_z", Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).eye.z); }, "the eye in the world"},
    {"width", Type::number, [](const Moment& m) { return Quantity::of(m.trace().scene().raster.width); }, "columns"},
    {"height", Type::number, [](const Moment& m) { return Quantity::of(m.trace().scene().raster.height); }, "rows"},
    {"polygons", Type::number, [](const Moment& m) { return Quantity::of(count(m.trace().scene().polygons.size())); },
     "how many polygons the scene has"},
    {"vertices", Type::number, [](const Moment& m) { return Quantity::of(count(m.trace().scene().points.size())); },
     "how many vertices the scene has"},
    {"wrongly_dark", Type::number, [](const Moment& m) { return wrongly(m, true); },
     "pixels with less than half of the light though a ray from their point reaches the lamp"},
    {"wrongly_lit", Type::number, [](const Moment& m) { return wrongly(m, false); },
     "pixels with half of the light or more though something is between their point and the lamp"},
    {"steps", Type::number, [](const Moment& m) { return Quantity::of(static_cast<double>(m.trace().size())); },
     "how many steps the run took"},
};
#undef OF_SPAN
#undef OF_FACING
#undef OF_CAMERA

}  // namespace

std::span<const KnownName> known_names() { return names; }

const KnownName* find_known_name(std::string_view name) {
  for (const KnownName& known : names) {
    if (known.name == name) return &known;
  }
  return nullptr;
}

// What can be asked of the state by number: a pixel, a vertex, an edge, an entry of T_v; and a little arithmetic.

namespace {

using Args = std::span<const double>;
using Type = Quantity::Type;

std::size_t index(const Moment& moment, double value, std::size_t size, std::string_view what) {
  if (!(value >= 0 && value < static_cast<double>(size)) || value != std::floor(value)) {
    throw InputError(
        moment.where, fmt::format("there is no {} {}", what, value),
        size == 0 ? fmt::format("there are none at this step") : fmt::format("they run from 0 to {}", size - 1));
  }
  return static_cast<std::size_t>(value);
}

std::size_t pixel(const Moment& moment, Args args) {
  const Picture& picture = moment.state().picture;
  const std::size_t x = index(moment, args[0], static_cast<std::size_t>(picture.width), "column");
  const std::size_t y = index(moment, args[1], static_cast<std::size_t>(picture.height), "row");
  return y * static_cast<std::size_t>(picture.width) + x;
}

const glm::dvec3& point(const Moment& moment, double vertex) {
  const auto& points = moment.trace().scene().points;
  return points[index(moment, vertex, points.size(), "vertex of the scene")];
}

/// The vertex, once it has come as far as `stage`.
const VertexStages& way(const Moment& moment, double vertex, VertexStages::Stage stage) {
  const auto& vertices = moment.state().vertices;
  const VertexStages& found = vertices[index(moment, vertex, vertices.size(), "vertex")];
  if (found.stage < stage) {
    throw InputError(moment.where, fmt::format("vertex {} has not come so far at this step", vertex),
                     "attach the stop to a later step");
  }
  return found;
}

const EdgeTableInsert& edge_row(const Moment& moment, double edge) {
  const auto& table = moment.state().machine.edge_table;
  return table[index(moment, edge, table.size(), "edge in the edge table")];
}

/// x and depth of an edge where it is now: on the current scan line if it is active, else where the table has it.
glm::dvec2 edge_now(const Moment& moment, double edge) {
  const EdgeTableInsert& entry = edge_row(moment, edge);
  for (const ActiveEdge& active : moment.state().machine.active) {
    if (active.edge == entry.edge) return {active.x, active.z};
  }
  return {entry.x_edge, entry.z_edge};
}

const Piece& piece(const Moment& moment, double number) {
  const auto& pieces = moment.state().machine.pieces;
  return pieces[index(moment, number, pieces.size(), "piece")];
}

const PlaneEquation& plane(const Moment& moment, double number) {
  const Piece& found = piece(moment, number);
  if (!found.plane)
    throw InputError(moment.where, fmt::format("the plane of piece {} is not known at this step", number),
                     "attach the stop to a later step");
  return *found.plane;
}

std::size_t matrix_place(const Moment& moment, double value) {
  if (!(value >= 1 && value <= 4) || value != std::floor(value)) {
    throw InputError(moment.where, fmt::format("T_v has no row or column {}", value), "they run from 1 to 4");
  }
  return static_cast<std::size_t>(value) - 1;
}

std::size_t corner(const Moment& moment, double which) {
  const Scene& scene = moment.trace().scene();
  const std::int32_t facet = moment.state().machine.facet;
  if (facet < 0)
    throw InputError(moment.where, "there is no polygon at work at this step", "attach the stop to a later step");
  const Facet& at_work = scene.facets[facet];
  const std::size_t place = index(moment, which, static_cast<std::size_t>(at_work.corner_count), "corner");
  return scene.corners[at_work.first_corner + place];
}

const Extent& extent(const Moment& moment, double number) {
  const Piece& found = piece(moment, number);
  if (!found.extent)
    throw InputError(moment.where, fmt::format("the extents of piece {} are not known at this step", number),
                     "attach the stop to a later step");
  return *found.extent;
}

glm::dvec3 on_raster(const Moment& moment, double vertex) {
  const Scene& scene = moment.trace().scene();
  if (scene.camera.kind == Camera::Kind::screen && vertex < static_cast<double>(scene.points.size()))
    return point(moment, vertex);
  const VertexStages& found = way(moment, vertex, VertexStages::on_raster);
  return {found.raster, found.plane.z};
}

double plane_value(const Moment& moment, double number, double vertex) {
  return formulas::plane_value(plane(moment, number), on_raster(moment, vertex));
}

double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

#define OF_VERTEX(name, stage, part, meaning)                                                                 \
  KnownFunction {                                                                                             \
    name, 1, Type::number,                                                                                    \
        [](const Moment& m, Args a) { return Quantity::of(way(m, a[0], VertexStages::stage).part); }, meaning \
  }
#define OF_POINT(name, part, meaning)                                                                         \
  KnownFunction {                                                                                             \
    name, 1, Type::number, [](const Moment& m, Args a) { return Quantity::of(point(m, a[0]).part); }, meaning \
  }
#define OF_EDGE(member, meaning)                                                                                      \
  KnownFunction {                                                                                                     \
#member, 1, Type::number, [](const Moment& m, Args a) { return Quantity::of(edge_row(m, a[0]).member); }, meaning \
  }
#define OF_PLANE(name, member, meaning)                                                                         \
  KnownFunction {                                                                                               \
    name, 1, Type::number, [](const Moment& m, Args a) { return Quantity::of(plane(m, a[0]).member); }, meaning \
  }
#define ARITHMETIC(name, count, value, meaning)                                                   \
  KnownFunction {                                                                                 \
    name, count, Type::number, [](const Moment&, Args a) { return Quantity::of(value); }, meaning \
  }

const KnownFunction functions[] = {
    {"depth", 2, Type::number,
     [](const Moment& m, Args a) { return Quantity::of(m.state().picture.depth[pixel(m, a)]); },
     "depth(x, y): the depth buffer there"},
    {"frame", 2, Type::polygon,
     [](const Moment& m, Args a) { return Quantity::of_polygon(m.state().picture.polygon[pixel(m, a)]); },
     "frame(x, y): the polygon seen there"},
    OF_POINT("x_w", x, "x_w(vertex): world"),
    OF_POINT("y_w", y, "y_w(vertex)"),
    OF_POINT("z_w", z, "z_w(vertex)"),
    OF_VERTEX("x_v", viewed, view.x, "x_v(vertex): view coordinates"),
    OF_VERTEX("y_v", viewed, view.y, "y_v(vertex)"),
    OF_VERTEX("z_v", viewed, view.z, "z_v(vertex)"),
    OF_VERTEX("x_p", projected, plane.x, "x_p(vertex): on the projection plane"),
    OF_VERTEX("y_p", projected, plane.y, "y_p(vertex)"),
    OF_VERTEX("z_p", projected, plane.z, "z_p(vertex): the depth that is interpolated"),
    OF_VERTEX("x_s", on_raster, raster.x, "x_s(vertex): on the raster"),
    OF_VERTEX("y_s", on_raster, raster.y, "y_s(vertex)"),
    {"triple_product", 3, Type::number,
     [](const Moment& m, Args a) {
       const auto view = [&](std::size_t i) { return way(m, a[i], VertexStages::viewed).view; };
       return Quantity::of(glm::dot(view(0), glm::cross(view(1), view(2))));
     },
     "triple_product(u, v, w): V_u · (V_v × V_w) of three vertices in view coordinates"},
    OF_EDGE(vertex_0, "vertex_0(edge): its vertex on the first row's side"),
    OF_EDGE(vertex_1, "vertex_1(edge): its other vertex"),
    OF_EDGE(first_row, "first_row(edge): the first scan line it meets"),
    OF_EDGE(end_row, "end_row(edge): the scan line at which it retires"),
    OF_EDGE(dx_dy, "dx_dy(edge): what x gains from row to row"),
    OF_EDGE(dz_dy, "dz_dy(edge): what depth gains from row to row"),
    OF_PLANE("plane_a", plane_a, "plane_a(piece): A of A x + B y + C z + D = 0"),
    OF_PLANE("plane_b", plane_b, "plane_b(piece): B"),
    OF_PLANE("plane_c", plane_c, "plane_c(piece): C"),
    OF_PLANE("plane_d", plane_d, "plane_d(piece): D"),
    {"node_piece", 1, Type::number,
     [](const Moment& m, Args a) {
       const auto& tree = m.state().machine.tree;
       return Quantity::of(tree[index(m, a[0], tree.size(), "node")].pieces.at(0));
     },
     "node_piece(node): the piece whose plane divides space there"},
    OF_PLANE("A", plane_a, "A(piece): of its plane"),
    OF_PLANE("B", plane_b, "B(piece)"),
    OF_PLANE("C", plane_c, "C(piece)"),
    OF_PLANE("D", plane_d, "D(piece)"),
    {"x_edge", 1, Type::number, [](const Moment& m, Args a) { return Quantity::of(edge_now(m, a[0]).x); },
     "x_edge(edge): its x now; before it is active, on its first row"},
    {"z_edge", 1, Type::number, [](const Moment& m, Args a) { return Quantity::of(edge_now(m, a[0]).y); },
     "z_edge(edge): its depth there"},
    {"active_edge", 1, Type::number,
     [](const Moment& m, Args a) {
       const auto& active = m.state().machine.active;
       return Quantity::of(active[index(m, a[0], active.size(), "place in the active edge list")].edge);
     },
     "active_edge(place): the edge at this place of the active edge list, from 0"},
    {"corner", 1, Type::number,
     [](const Moment& m, Args a) { return Quantity::of(static_cast<double>(corner(m, a[0]))); },
     "corner(i): the i-th vertex of the polygon at work, from 0"},
    {"polygon_of", 1, Type::polygon,
     [](const Moment& m, Args a) { return Quantity::of_polygon(piece(m, a[0]).polygon); },
     "polygon_of(piece): the polygon it is a piece of"},
    {"near_z", 1, Type::number, [](const Moment& m, Args a) { return Quantity::of(extent(m, a[0]).z_min); },
     "near_z(piece): its least depth"},
    {"far_z", 1, Type::number, [](const Moment& m, Args a) { return Quantity::of(extent(m, a[0]).z_max); },
     "far_z(piece): its greatest depth"},
    {"plane_value", 2, Type::number, [](const Moment& m, Args a) { return Quantity::of(plane_value(m, a[0], a[1])); },
     "plane_value(piece, vertex): A x + B y + C z + D of its plane, at the vertex on the raster"},
    {"listed", 1, Type::number,
     [](const Moment& m, Args a) {
       const auto& list = m.state().machine.list;
       return Quantity::of(list[index(m, a[0], list.size(), "place in the list")].piece);
     },
     "listed(place): the piece at this place of the drawing list, from 0"},
    {"upper", 1, Type::number,
     [](const Moment& m, Args a) {
       const auto& rows = m.state().machine.horizon.upper;
       return Quantity::of(rows[index(m, a[0], rows.size(), "column with a horizon")]);
     },
     "upper(x): the upper horizon of column x, a row of the raster"},
    {"lower", 1, Type::number,
     [](const Moment& m, Args a) {
       const auto& rows = m.state().machine.horizon.lower;
       return Quantity::of(rows[index(m, a[0], rows.size(), "column with a horizon")]);
     },
     "lower(x): the lower horizon of column x"},
    {"T_v", 2, Type::number,
     [](const Moment& m, Args a) {
       const glm::dmat4& view = m.trace().scene().camera.view;
       return Quantity::of(view[static_cast<int>(matrix_place(m, a[1]))][static_cast<int>(matrix_place(m, a[0]))]);
     },
     "T_v(row, column): of the viewing matrix, from 1"},
    {"view_depth", 1, Type::number,
     [](const Moment& m, Args a) {
       return Quantity::of(view_depth(m.trace().scene().camera, m.trace().header().conventions, a[0]));
     },
     "view_depth(z): z_v of a number in the depth buffer"},
    {"pseudodepth", 1, Type::number,
     [](const Moment& m, Args a) {
       const Camera& camera = m.trace().scene().camera;
       const double range = camera.far - camera.near;
       return Quantity::of((camera.far + camera.near) / range - 2 * camera.far * camera.near / range / a[0]);
     },
     "pseudodepth(z_v): the number that perspective gives to this view depth"},
    ARITHMETIC("abs", 1, std::abs(a[0]), "abs(a)"),
    ARITHMETIC("ceil", 1, std::ceil(a[0]), "ceil(a): rounded up"),
    ARITHMETIC("floor", 1, std::floor(a[0]), "floor(a): rounded down"),
    ARITHMETIC("min", 2, std::min(a[0], a[1]), "min(a, b)"),
    ARITHMETIC("max", 2, std::max(a[0], a[1]), "max(a, b)"),
    ARITHMETIC("sqrt", 1, std::sqrt(a[0]), "sqrt(a), also √a"),
    ARITHMETIC("sin", 1, portable::sin(radians(a[0])), "sin(a), degrees"),
    ARITHMETIC("cos", 1, portable::cos(radians(a[0])), "cos(a), degrees"),
    ARITHMETIC("tan", 1, portable::tan(radians(a[0])), "tan(a), degrees"),
};

}  // namespace

std::span<const KnownFunction> known_functions() { return functions; }

const KnownFunction* find_known_function(std::string_view name) {
  for (const KnownFunction& known : functions) {
    if (known.name == name) return &known;
  }
  return nullptr;
}

}  // namespace zstep::classroom
