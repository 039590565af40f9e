// What the scene shows in space: edges, axes, the eye with its window and planes, and what the step at work is about.
#include "sim/viewer/panes/scene_in_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <span>

#include "algorithms/ray_casting/geometry.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/panes/ray_plan.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/pieces.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

void draw_edges(RoomPen& pen, const Moment& now) {
  const Scene& polygons = pen.room.polygons();
  const auto& surface = now.scene().surface;
  const bool curves = surface && surface->columns > 0 && records<HorizonTest>(now.header());  // of one z each
  for (const auto& [from, to] : edges_of(polygons)) {
    const bool along = curves && from / surface->columns == to / surface->columns;
    pen.line(polygons.points[from], polygons.points[to], pen.colors.text, along ? 3 : 0.8);
  }
}

/// The eye with its window and its planes; of parallel projection the box that is seen.
void draw_eye(RoomPen& pen) {
  const Room& room = pen.room;
  const Theme& c = pen.colors;
  const Camera& camera = room.camera();
  const bool perspective = room.has_eye();
  const auto near = room.window(room.near()), end = room.window(room.end());
  const bool window_apart = perspective && camera.d > 0 && camera.d < room.end();
  const auto window = room.window(window_apart ? camera.d : room.near());
  for (std::size_t k = 0; k < 4; ++k) pen.line(perspective ? camera.eye : near[k], end[k], c.muted, 1);
  if (perspective) pen.dot(camera.eye, 5, 0, c.text), pen.word(camera.eye, room.by_lamp() ? "light" : "eye", c.text);
  pen.around(window, c.text, 2);
  pen.word(window[0], camera.kind == Camera::Kind::screen ? "raster" : "window", c.text);
  if (window_apart && std::abs(room.near() - camera.d) > 0.02 * room.end()) {
    pen.around(near, c.muted, 1, true);
    pen.word(near[3], "near", c.muted);
  }
  if (room.far_is_there()) {
    pen.around(end, c.muted, 1, true);
    pen.word(end[3], "far", c.muted);
  }
}

void draw_axes(RoomPen& pen, const Moment& now, int viewing, double arrived, bool follows_pixel) {
  const Camera& camera = now.scene().camera;
  if (camera.kind == Camera::Kind::screen) return;
  const Theme& c = pen.colors;
  const double length = 0.45 * pen.room.size();
  if (viewing > 0) draw_viewing_axes(pen, camera, viewing, arrived);
  // Of y = f(x, z) the height is y.
  const std::array names = now.scene().surface ? std::array{"x", "z", "y"} : std::array{"x", "y", "z"};
  for (int axis = 0; axis < 3 && viewing == 0; ++axis) {
    glm::dvec3 end(0);
    end[axis] = length;
    pen.line(glm::dvec3(0), end, c.muted, 1.2);
    for (double t = 1.06; t > 0.1 && !pen.word(t * end, names[axis], c.muted); t -= 0.1) continue;
  }
  // Where the eye is, as 000 says it, while points are moved into its coordinates.
  const auto& vertices = now.state().vertices;
  const bool views = now.event() && get_if<ViewTransform>(&now.event()->event),
             begins = !follows_pixel && (vertices.empty() || vertices[0].stage == VertexStages::untouched) &&
                      now.state().machine.pieces.empty() && now.state().machine.rays.tree.empty();
  const auto shows = [&](const char* name, int step) {
    return viewing > 0 ? viewing == step : (views || begins || now.told()) && now.tells(name, views || begins);
  };
  const bool rho = shows("rho", 1), turned = shows("theta", 2), inclined = shows("phi", 3);
  if (!camera.polar || camera.kind != Camera::Kind::perspective || pen.room.by_lamp() ||
      !(rho || turned || inclined || viewing > 0))
    return;
  const double theta = glm::radians(camera.theta), phi = glm::radians(camera.phi), radius = 0.6 * length;
  const glm::dvec3 foot(camera.eye.x, camera.eye.y, 0);
  if (rho) {
    pen.line(glm::dvec3(0), camera.eye, c.now, 1.6);
    pen.word(0.55 * camera.eye, "\u03c1", c.now);
  }
  if (viewing > 0 || turned || inclined) {
    pen.line(glm::dvec3(0), foot, c.muted, 1, true);
    pen.line(foot, camera.eye, c.muted, 1, true);
  }
  const auto arc = [&](double angle, auto place, const char* name) {
    constexpr int parts = 24;
    for (int k = 0; k < parts; ++k) pen.line(place(angle * k / parts), place(angle * (k + 1) / parts), c.now, 1.6);
    pen.word(place(angle / 2), name, c.now);
  };
  if (turned)
    arc(
        theta, [&](double t) { return radius * glm::dvec3(portable::cos(t), portable::sin(t), 0); }, "\u03b8");
  if (inclined)
    arc(
        phi,
        [&](double t) {
          return radius * glm::dvec3(portable::sin(t) * portable::cos(theta), portable::sin(t) * portable::sin(theta),
                                     portable::cos(t));
        },
        "\u03c6");
}

/// A vertex that pieces are made of.
std::optional<glm::dvec3> vertex_in(const Room& room, const Moment& now, std::int32_t vertex) {
  const auto point = cutting_point(now.scene(), now.state(), vertex);
  if (!point) return std::nullopt;
  if (cuts_in_world(now.scene(), now.state().machine)) return room.place(*point);
  return room.behind(point->x, point->y, view_depth(room.camera(), now.header().conventions, point->z));
}

void draw_outline(RoomPen& pen, const Moment& now, const std::vector<std::int32_t>& outline, ImU32 color) {
  std::vector<glm::dvec3> corners;
  for (const std::int32_t vertex : outline)
    if (const auto corner = vertex_in(pen.room, now, vertex)) corners.push_back(*corner);
  if (corners.size() == outline.size()) pen.around(corners, color, 2.6);
}

/// Does a lesson's stop name vertices itself? Then no other has a number.
bool names_vertices(const Moment& now) {
  const Stop* const told = now.told();
  return told && std::any_of(told->labels.begin(), told->labels.end(),
                             [](const StopLabel& label) { return label.vertex >= 0 && label.to < 0; });
}

/// A dot on a vertex, and its letter or number beside it.
void name_vertex(RoomPen& pen, const Moment& now, std::int32_t vertex, glm::dvec3 at, ImU32 color) {
  pen.dot(at, 3, 0, color);
  if (!names_vertices(now)) pen.word(at, vertex_label(now.scene(), vertex), color);
}

/// The test of a polygon's outcodes that the step makes or that is asked for.
const ClipTest* outcodes_tested(const Moment& now) {
  if (now.asked())
    if (const auto* test = get_if<ClipTest>(now.asked())) return test;
  return now.event() ? get_if<ClipTest>(&now.event()->event) : nullptr;
}

/// The view volume as clipping measures it.
formulas::ViewVolume<double> volume_of(const Scene& scene) {
  const Camera& camera = scene.camera;
  return {camera.kind == Camera::Kind::orthographic,
          camera.near,
          camera.far,
          camera.d,
          formulas::window_width(camera.window, 1.0 * scene.raster.width, 1.0 * scene.raster.height),
          camera.window};
}

/// Bit k is set if a point in view coordinates is outside plane k of ClipPlane.
int outcode_of(const Scene& scene, glm::dvec3 view) {
  const formulas::ViewVolume<double> volume = volume_of(scene);
  int outside = 0;
  for (const ClipPlane plane : values_of<ClipPlane>)
    outside |= int{!(formulas::distance_inside(volume, plane, view.x, view.y, view.z) >= 0)} << index_of(plane);
  return outside;
}

/// By ClipPlane, of each what lies between the near and the far plane.
std::array<std::array<glm::dvec3, 4>, 6> planes_of(const Room& room) {
  // Of a rectangle of the raster: left top, right top, right bottom, left bottom.
  const auto front = room.window(room.near()), back = room.window(room.end());
  const auto side = [&](std::size_t a, std::size_t b) { return std::array{front[a], front[b], back[b], back[a]}; };
  return {front, back, side(0, 3), side(1, 2), side(2, 3), side(0, 1)};
}

/// Names of the six planes where the lesson gives the near and the far one; where outcodes are tested those planes that
/// some vertex is outside of.
void draw_planes_by_name(RoomPen& pen, const Moment& now) {
  const Room& room = pen.room;
  if (now.scene().camera.kind == Camera::Kind::screen || room.by_lamp()) return;
  const ClipTest* test = outcodes_tested(now);
  const bool all =
      now.event() && holds<BuffersClear>(now.event()->event) && now.tells("near", false) && now.tells("far", false);
  const auto planes = planes_of(room);
  for (const ClipPlane plane : values_of<ClipPlane>) {
    const bool outside = test && (test->outside_some >> index_of(plane) & 1) != 0;
    if (!outside && !all) continue;
    const auto& its = planes.at(index_of(plane));
    if (outside) pen.veil(its, pen.colors.now, 40), pen.around(its, pen.colors.now, 1.2);
    const bool across = plane == ClipPlane::near || plane == ClipPlane::far;
    const glm::dvec3 place =
        across ? 0.5 * (its[0] + its[1]) : 0.3 * (0.5 * (its[0] + its[1])) + 0.7 * (0.5 * (its[2] + its[3]));
    pen.word(place, std::string(word_of(plane)), outside ? pen.colors.now : pen.colors.text);
  }
}

/// One side of a plane of the view volume, of an outline in view coordinates.
std::vector<glm::dvec3> side_of(const formulas::ViewVolume<double>& volume, ClipPlane plane,
                                const std::vector<glm::dvec3>& outline, bool inside) {
  const auto distance = [&](glm::dvec3 p) {
    return (inside ? 1 : -1) * formulas::distance_inside(volume, plane, p.x, p.y, p.z);
  };
  std::vector<glm::dvec3> kept;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const glm::dvec3 &here = outline[k], &next = outline[(k + 1) % outline.size()];
    const double d = distance(here), d_next = distance(next);
    if (d >= 0) kept.push_back(here);
    if ((d > 0 && d_next < 0) || (d < 0 && d_next > 0)) kept.push_back(here + (next - here) * (d / (d - d_next)));
  }
  return kept;
}

/// The plane that a polygon is clipped by, what it and those before it cut off, and the vertices that clipping made so
/// far; of each vertex that comes to the plane whether it is in or out.
void draw_clipping(RoomPen& pen, const Moment& now) {
  const Room& room = pen.room;
  const Scene& scene = now.scene();
  const MethodState& m = now.state().machine;
  if (scene.camera.kind == Camera::Kind::screen || room.by_lamp() || m.facet < 0 || m.facet >= std::ssize(scene.facets))
    return;
  std::optional<ClipPlane> plane;
  const auto* cross = now.event() ? get_if<ClipCross>(&now.event()->event) : nullptr;
  if (cross) plane = cross->plane;
  else if (const auto* vertex = now.event() ? get_if<ClipVertex>(&now.event()->event) : nullptr) plane = vertex->plane;
  const auto* reject = now.event() ? get_if<PolygonReject>(&now.event()->event) : nullptr;
  const bool done =
      now.event() && (holds<OutlineVertex>(now.event()->event) || (reject && reject->reason == Reject::outside));
  const formulas::ViewVolume<double> volume = volume_of(scene);
  if (plane) {
    const auto planes = planes_of(room);
    const auto& its = planes.at(static_cast<std::size_t>(*plane));
    pen.veil(its, pen.colors.now, 55);
    pen.around(its, pen.colors.now, 1.6);
    pen.word(0.5 * (its[0] + its[1]), fmt::format("{} plane", word_of(*plane)), pen.colors.now);
  }
  const glm::dmat4 to_world = glm::inverse(scene.camera.view);
  const auto& vertices = now.state().vertices;
  std::vector<glm::dvec3> outline;
  const auto in_world = [&](glm::dvec3 view) { return room.place(glm::dvec3(to_world * glm::dvec4(view, 1))); };
  const auto place = [&](std::int32_t vertex) { return in_world(vertices[vertex].view); };
  const Facet& facet = scene.facets[m.facet];
  const std::span corners(scene.corners.data() + facet.first_corner, facet.corner_count);
  const auto viewed = [&](std::int32_t v) {
    return v < std::ssize(vertices) && vertices[v].stage >= VertexStages::viewed;
  };
  const auto code = [&](std::int32_t v) { return outcode_of(scene, vertices[v].view); };
  if ((plane || done) && std::all_of(corners.begin(), corners.end(), viewed) &&
      std::any_of(corners.begin(), corners.end(), code)) {
    const int before = plane ? (1 << index_of(*plane)) - 1 : 0, here = plane ? 1 << index_of(*plane) : ~0;
    std::vector<glm::dvec3> left;
    for (const std::int32_t vertex : corners) {
      left.push_back(vertices[vertex].view);
      if ((code(vertex) & before) != 0) continue;  // cut off by a plane before
      const char* const side = (code(vertex) & here) != 0 ? "out" : "in";
      pen.word(place(vertex), fmt::format("{} {}", vertex_label(scene, vertex), side), pen.colors.text);
    }
    for (const ClipPlane cut : values_of<ClipPlane>) {
      if (plane && index_of(cut) > index_of(*plane)) break;
      std::vector<glm::dvec3> off = side_of(volume, cut, left, false);
      for (glm::dvec3& corner : off) corner = in_world(corner);
      pen.veil(off, pen.colors.pane, 170);
      left = side_of(volume, cut, left, true);
    }
  }
  if (cross) {  // how far inside both ends are, and where between them it is zero
    const auto tell = [&](std::int32_t vertex, const char* name, double value) {
      pen.word(place(vertex), fmt::format("{}{} = {}", vertex_label(scene, vertex), name, number(value)),
               pen.colors.now);
    };
    for (const std::int32_t end : {cross->vertex_inside, cross->vertex_outside})
      if (end >= 0 && end < std::ssize(vertices)) {
        const glm::dvec3& view = vertices[static_cast<std::size_t>(end)].view;
        tell(end, end == cross->vertex_inside ? " in: d_in" : " out: d_out",
             formulas::distance_inside(volume, cross->plane, view.x, view.y, view.z));
      }
    if (cross->vertex >= 0 && cross->vertex < std::ssize(vertices)) tell(cross->vertex, ": t", cross->t);
  }
  for (std::size_t v = scene.points.size(); v < vertices.size(); ++v)
    if (vertices[v].stage != VertexStages::untouched)
      name_vertex(pen, now, index32(v), place(index32(v)), pen.colors.now);
  for (const std::int32_t vertex : m.outline)
    if (static_cast<std::size_t>(vertex) < vertices.size()) outline.push_back(place(vertex));
  const auto made = [&](std::int32_t vertex) { return vertex >= std::ssize(scene.points); };
  if (std::any_of(m.outline.begin(), m.outline.end(), made)) pen.around(outline, pen.colors.now, 3.4);
}

std::vector<glm::dvec3> corners_at_work(const Scene& scene, const MethodState& m) {
  std::vector<glm::dvec3> corners;
  if (m.facet < 0 || m.facet >= std::ssize(scene.facets)) return corners;
  const Facet& facet = scene.facets[m.facet];
  for (std::int32_t k = 0; k < facet.corner_count; ++k)
    corners.push_back(scene.points[scene.corners[facet.first_corner + k]]);
  return corners;
}

/// The polygon or piece at work, and the pair under test.
void draw_at_work(RoomPen& pen, const Moment& now) {
  const MethodState& m = now.state().machine;
  const Scene& polygons = pen.room.polygons();
  const Theme& c = pen.colors;
  const std::vector<glm::dvec3> corners = corners_at_work(polygons, m);
  if (!corners.empty()) pen.around(corners, c.now, 2.6);
  const bool outcodes = outcodes_tested(now) && !pen.room.by_lamp();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::int32_t vertex = polygons.corners[static_cast<std::size_t>(polygons.facets[m.facet].first_corner) + k];
    pen.dot(corners[k], 3, 0, c.text);
    const glm::dvec3 view(now.scene().camera.view * glm::dvec4(corners[k], 1));
    const std::string name = vertex_label(now.scene(), vertex);
    if (outcodes) pen.word(corners[k], fmt::format("{}: {:06b}", name, outcode_of(now.scene(), view)), c.text);
    else if (!names_vertices(now)) pen.word(corners[k], name, c.text);
  }
  const auto piece = [&](std::int32_t number, ImU32 color) {
    if (number >= 0 && number < std::ssize(m.pieces)) draw_outline(pen, now, m.pieces[number].outline, color);
  };
  piece(piece_shown(now), c.now);
  const auto* side = now.event() ? get_if<SideTest>(&now.event()->event) : nullptr;
  const auto plane = side && now.tells("least", false) && side->plane_of >= 0 && side->plane_of < std::ssize(m.pieces)
                         ? m.pieces[side->plane_of].plane
                         : std::nullopt;
  if (plane && side->piece >= 0 && side->piece < std::ssize(m.pieces))
    for (const std::int32_t vertex : m.pieces[side->piece].outline)
      if (const auto p = cutting_point(now.scene(), now.state(), vertex))
        if (const auto corner = vertex_in(pen.room, now, vertex)) {
          pen.dot(*corner, 4, 0, c.now);
          pen.word(*corner,
                   number(plane->plane_a * p->x + plane->plane_b * p->y + plane->plane_c * p->z + plane->plane_d),
                   c.now);
        }
  const auto* made = now.event() ? get_if<PieceMake>(&now.event()->event) : nullptr;
  if (made && made->piece >= 0 && made->piece < std::ssize(m.pieces) && m.pieces[made->piece].parent >= 0) {
    glm::dvec3 middle(0);
    const auto& outline = m.pieces[made->piece].outline;
    for (const std::int32_t vertex : outline)
      if (const auto corner = vertex_in(pen.room, now, vertex)) {
        middle += *corner / static_cast<double>(outline.size());
        pen.dot(*corner, 4, vertex >= std::ssize(now.scene().points) ? 1 : 0, c.now);
      }
    pen.word(middle, piece_label(now.scene(), m, made->piece), c.now);
  }
  if (m.pair && !m.list.empty()) piece(m.pair->other, c.selected), piece(m.pair->piece, c.now);
}

/// Vertices by number, where the lesson gives how many there are or one of them is moved.
void number_vertices(RoomPen& pen, const Moment& now) {
  constexpr std::size_t most = 12;
  const auto& points = pen.room.polygons().points;
  const Event* step = now.event() ? &now.event()->event : nullptr;
  const bool moved =
      step && (holds<ViewTransform>(*step) || holds<Projection>(*step) || holds<ViewportTransform>(*step));
  if (points.size() > most || !(now.tells("vertices", false) || (moved && now.told()))) return;
  for (std::size_t v = 0; v < points.size(); ++v)
    if (vertex_at_work(now.event()) != index32(v)) name_vertex(pen, now, index32(v), points[v], pen.colors.text);
}

/// How a vertex is projected, as two similar triangles: along the line of sight z_v and d, across it (x_v, y_v) and
/// (x_p, y_p). Numbers as far as they are there.
void draw_projection(RoomPen& pen, const Moment& now, std::int32_t vertex) {
  const auto& vertices = now.state().vertices;
  const Camera& camera = pen.room.camera();
  if (!pen.room.has_eye() || pen.room.by_lamp() || static_cast<std::size_t>(vertex) >= vertices.size()) return;
  const VertexStages& its = vertices[static_cast<std::size_t>(vertex)];
  if (its.stage < VertexStages::viewed) return;
  const Theme& c = pen.colors;
  const glm::dmat4 to_world = glm::inverse(camera.view);
  const auto place = [&](double x, double y, double z) { return pen.room.place(to_world * glm::dvec4(x, y, z, 1)); };
  if (!(its.view.z > 0)) {
    // Behind the eye: where the division would put it, once the lesson gives the plane that it is cut off at.
    if (its.view.z == 0 || !now.tells("near", false)) return;
    const glm::dvec3 wrong = place(its.view.x * camera.d / its.view.z, its.view.y * camera.d / its.view.z, camera.d);
    pen.line(place(its.view.x, its.view.y, its.view.z), wrong, c.now, 2, true, true);
    pen.dot(wrong, 4, 1, c.now);
    pen.word(
        wrong,
        fmt::format("({}, {})", number(its.view.x * camera.d / its.view.z), number(its.view.y * camera.d / its.view.z)),
        c.now);
    return;
  }
  const bool projected = its.stage >= VertexStages::projected, asked = now.asked() && holds<Projection>(*now.asked());
  const double x = its.view.x, y = its.view.y, z = its.view.z, t = camera.d / z;
  const auto named = [&](const char* name, double value) { return fmt::format("{} = {}", name, number(value)); };
  /// From the line of sight, at this depth, up and then to the side.
  const auto across = [&](double dx, double dy, double depth, const char* to_side, const char* up, bool told) {
    const glm::dvec3 foot = place(0, 0, depth), above = place(0, dy, depth), end = place(dx, dy, depth);
    pen.line(foot, above, c.changed, 2.4, false, true);
    pen.line(above, end, c.changed, 2.4, false, true);
    if (std::abs(dy) > 1e-9) pen.word(0.5 * (foot + above), told ? named(up, dy) : up, c.changed);
    if (std::abs(dx) > 1e-9) pen.word(0.5 * (above + end), told ? named(to_side, dx) : to_side, c.changed);
  };
  const glm::dvec3 foot = place(0, 0, z);
  pen.line(camera.eye, foot, c.changed, 2.4, false, true);
  pen.word(foot, named("z_v", z), c.changed);
  across(x, y, z, "x_v", "y_v", true);
  if (!projected && !asked) return;
  pen.line(camera.eye, place(x, y, z), c.now, 2, false, true);
  pen.word(place(0, 0, camera.d), named("d", camera.d), c.changed);
  across(x * t, y * t, camera.d, "x_p", "y_p", projected);
  pen.dot(place(x * t, y * t, camera.d), 4, 1, c.now);
  pen.word(place(x * t, y * t, camera.d), "(x_p, y_p)", c.now);
}

/// Half of the window and half of the angle of view.
void draw_half_window(RoomPen& pen) {
  const Camera& camera = pen.room.camera();
  if (!pen.room.has_eye() || pen.room.by_lamp()) return;
  const Theme& c = pen.colors;
  const glm::dmat4 to_world = glm::inverse(camera.view);
  const auto place = [&](double y, double z) { return pen.room.place(to_world * glm::dvec4(0, y, z, 1)); };
  const glm::dvec3 middle = place(0, camera.d), top = place(camera.window, camera.d);
  pen.line(camera.eye, middle, c.changed, 2.4, false, true);
  pen.line(middle, top, c.changed, 2.4, false, true);
  pen.line(camera.eye, top, c.now, 2, false, true);
  pen.word(0.5 * (middle + camera.eye), fmt::format("d = {}", number(camera.d)), c.changed);
  pen.word(0.5 * (middle + top), number(camera.window), c.changed);
  constexpr int parts = 12;
  const double half = portable::atan2(camera.window, camera.d), reach = 0.4 * camera.d;
  const auto on_arc = [&](int k) {
    return place(reach * portable::sin(half * k / parts), reach * portable::cos(half * k / parts));
  };
  for (int k = 0; k < parts; ++k) pen.line(on_arc(k), on_arc(k + 1), c.now, 1.6, false, true);
  pen.word(on_arc(parts / 2), "\u03b1/2", c.now);
}

/// The vertex at work, and how it is projected.
void draw_vertex(RoomPen& pen, const Moment& now) {
  const std::int32_t vertex = vertex_at_work(now.event());
  const std::size_t at = vertex;
  if (vertex < 0 || at >= pen.room.polygons().points.size()) return;
  const Theme& c = pen.colors;
  const glm::dvec3 point = pen.room.polygons().points[at];
  pen.dot(point, 5, 0, c.now);
  if (!names_vertices(now)) pen.word(point, vertex_label(now.scene(), vertex), c.now);
  const Event& step = now.event()->event;
  if (holds<Projection>(step) && now.tells("window", false)) draw_half_window(pen);
  else if (const auto& asked = now.event_in_question(); asked && vertex_at_work(&*asked) != vertex) return;
  else if (holds<ViewTransform>(step) || holds<Projection>(step) || holds<ViewportTransform>(step))
    draw_projection(pen, now, vertex);
}

/// Which way a polygon faces: its normal, and the line of sight to its first vertex that the normal is compared with.
void draw_facing(RoomPen& pen, const Moment& now) {
  const Room& room = pen.room;
  const auto corners = corners_at_work(room.polygons(), now.state().machine);
  if (!now.event() || corners.size() < 3 || room.by_lamp() || room.camera().kind == Camera::Kind::screen) return;
  const Event& e = now.event()->event;
  const auto* reject = get_if<PolygonReject>(&e);
  const bool by_facing = reject && (reject->reason == Reject::back_facing || reject->reason == Reject::edge_on);
  if (now.asked() && holds<ClipTest>(*now.asked())) return;
  if (!by_facing && !holds<FacingTest>(e) && !(holds<PolygonBegin>(e) && records<FacingTest>(now.header()))) return;
  glm::dvec3 normal(0), middle(0);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    normal += glm::cross(corners[k] - corners[0], corners[(k + 1) % corners.size()] - corners[0]);
    middle += corners[k] / static_cast<double>(corners.size());
  }
  if (!(glm::length(normal) > 0)) return;
  const bool named = now.told() && std::any_of(now.told()->labels.begin(), now.told()->labels.end(),
                                               [](const StopLabel& label) { return label.arrow; });
  for (std::size_t k = 0; k < corners.size() && !named; ++k)  // its winding
    pen.arrow(corners[k], 0.5 * (corners[k] + corners[(k + 1) % corners.size()]), pen.colors.now);
  double length = 0.25 * room.size();
  if (now.told() && !now.told()->close.empty()) {  // as far as the polygon that is shown large reaches
    length = 0;
    for (const glm::dvec3& corner : corners) length = std::max(length, glm::length(corner - middle));
  }
  pen.arrow(middle, middle + glm::normalize(normal) * length, pen.colors.text, "n");
  const glm::dvec3 from =
      room.has_eye() ? room.camera().eye : corners[0] + glm::normalize(room.towards()) * room.size();
  pen.arrow(from, corners[0], pen.colors.now);
  pen.word(0.5 * (from + corners[0]), room.has_eye() ? "p \u2212 e" : "line of sight", pen.colors.now, true);
}

/// Where light is computed at vertices: the normal at each vertex of the polygon at work, and at the vertex at work the
/// direction of the light; those of the mirrored light and to the eye where the lesson's stop labels r and v.
void draw_light_at_vertices(RoomPen& pen, const Moment& now) {
  const std::int32_t at_work = vertex_at_work(now.event());
  const formulas::Shading shading = formulas::shading_of(now.scene(), now.header().conventions);
  const MethodState& m = now.state().machine;
  const Scene& scene = pen.room.polygons();
  if (at_work < 0 || !formulas::is_of_light(shading.shade) || !shading.attribute || m.facet < 0 ||
      m.facet >= std::ssize(scene.facets))
    return;
  const auto labels = [&](const char* name) {
    return now.told() && std::any_of(now.told()->labels.begin(), now.told()->labels.end(),
                                     [&](const StopLabel& label) { return label.vertex < 0 && label.name == name; });
  };
  const double length = 0.2 * pen.room.size();
  const Facet& facet = scene.facets[m.facet];
  for (std::int32_t k = 0; k < facet.corner_count; ++k) {
    const std::int32_t vertex = scene.corners[facet.first_corner + k];
    const std::int32_t value = shading.attribute->value_of(facet.polygon, vertex);
    if (value == no_value) continue;
    const double* n =
        shading.attribute->values.data() + static_cast<std::ptrdiff_t>(value) * shading.attribute->components;
    const glm::dvec3 foot = scene.points[vertex], normal = formulas::unit({n[0], n[1], n[2]});
    const glm::dvec3 &to_light = shading.lighting.to_light, &to_eye = shading.lighting.to_eye;
    if (vertex == at_work && labels("v")) pen.arrow(foot, foot + 1.4 * length * to_eye, pen.colors.text, "v");
    if (vertex == at_work && labels("r"))
      pen.arrow(foot, foot + 1.8 * length * (2 * glm::dot(normal, to_light) * normal - to_light), pen.colors.changed,
                "r");
    if (vertex == at_work) pen.arrow(foot, foot + 1.4 * length * to_light, pen.colors.selected, "l");
    pen.arrow(foot, foot + length * normal, vertex == at_work ? pen.colors.now : pen.colors.text,
              vertex == at_work ? "n" : "");
  }
}

/// The plane that divides space at the node at work.
void draw_dividing_plane(RoomPen& pen, const Moment& now) {
  const MethodState& m = now.state().machine;
  if (m.node < 0 || m.node >= std::ssize(m.tree)) return;
  const TreeNode& node = m.tree[m.node];
  if (node.pieces.empty() || static_cast<std::size_t>(node.pieces[0]) >= m.pieces.size()) return;
  const auto& plane = m.pieces[node.pieces[0]].plane;
  if (!plane) return;
  if (pen.room.camera().kind != Camera::Kind::screen && !cuts_in_world(now.scene(), m)) return;
  const auto corners = pen.room.section(plane->plane_a, plane->plane_b, plane->plane_c, plane->plane_d);
  pen.veil(corners, pen.colors.selected, 80);
  pen.around(corners, pen.colors.selected, 1.6);
}

/// The plane of the scan line through the scene, and the span in it.
void draw_scan_plane(RoomPen& pen, const Moment& now) {
  const MethodState& m = now.state().machine;
  if (!m.scan_line) return;
  const Room& room = pen.room;
  const Theme& c = pen.colors;
  const double y = *m.scan_line, left = -0.5, right = now.scene().raster.width - 0.5;
  const std::array plane{room.behind(left, y, room.near()), room.behind(right, y, room.near()),
                         room.behind(right, y, room.end()), room.behind(left, y, room.end())};
  pen.veil(plane, c.now, 55);
  pen.around(plane, c.now, 1.4);
  if (!m.span || m.span->y != *m.scan_line) return;
  const auto place = [&](double x, double z) {
    return room.behind(x, y, view_depth(room.camera(), now.header().conventions, z));
  };
  if (std::isfinite(m.span->z_left) && std::isfinite(m.span->z_right))
    pen.line(place(m.span->x_left, m.span->z_left), place(m.span->x_right, m.span->z_right), c.now, 4);
}

/// The line of sight through the pixel at work, to what has been found there.
void draw_line_of_sight(RoomPen& pen, const Moment& now, const std::optional<Cell>& cell) {
  if (!cell || !now.state().machine.rays.tree.empty()) return;
  const Room& room = pen.room;
  const auto& fragment = now.state().machine.fragment;
  const bool here = fragment && fragment->x == cell->x && fragment->y == cell->y && std::isfinite(fragment->z);
  const double z = here ? view_depth(room.camera(), now.header().conventions, fragment->z) : room.end();
  const glm::dvec3 end = room.behind(cell->x, cell->y, z);
  pen.line(room.has_eye() ? room.camera().eye : room.behind(cell->x, cell->y, room.near()), end, pen.colors.now, 1.6);
  if (here) pen.dot(end, 5, 0, pen.colors.now);
  if (!room.has_eye() || !(room.camera().d < room.end())) return;
  pen.around(room.rectangle(cell->x - 0.5, cell->y - 0.5, cell->x + 0.5, cell->y + 0.5, room.camera().d),
             pen.colors.now, 2);
  pen.word(room.behind(cell->x, cell->y, room.camera().d), fmt::format("({}, {})", cell->x, cell->y), pen.colors.now);
}

void draw_rays(RoomPen& pen, const Moment& now) {
  const RayWork& work = now.state().machine.rays;
  const Theme& c = pen.colors;
  for (const RayRow& row : work.tree) {
    const RayBegin& ray = row.entry;
    const glm::dvec3 from(ray.x_0, ray.y_0, ray.z_0), along(ray.dir_x, ray.dir_y, ray.dir_z);
    const double length = glm::length(along);
    if (!(length > 0)) continue;
    std::optional<double> meets;
    if (row.end && row.end->nearest_facet >= 0) meets = row.end->t;
    const bool at_work = work.ray && *work.ray == ray.ray;
    if (at_work && !meets)
      for (const RayHit& hit : work.hits)
        if (hit.nearest) meets = hit.t;
    const double beyond = (glm::length(pen.room.camera().eye) + 1.5 * pen.room.size()) / length;
    const glm::dvec3 end = from + along * meets.value_or(beyond);
    const ImU32 color = at_work ? c.now : c.selected;
    pen.line(pen.room.place(from), pen.room.place(end), color, at_work ? 2 : 1.4, !meets);
    if (meets) pen.dot(pen.room.place(end), 5, 0, color);
  }
}

/// The test whether the point X of the last hit is inside: the half-line from it in the facet's plane, and how often
/// it crosses the outline.
void draw_half_line(RoomPen& pen, const Moment& now) {
  const RayHit* hit = now.event() ? get_if<RayHit>(&now.event()->event) : nullptr;
  const RayWork& work = now.state().machine.rays;
  const RayBegin* const ray = ray_in(work);
  if (!hit || records<ColorWrite>(now.header()) || !ray) return;
  if (hit->facet < 0 || hit->facet >= std::ssize(now.scene().facets)) return;
  const ray_casting::Target target = ray_casting::target_of(now.scene(), hit->facet);
  if (target.corners.size() < 3) return;
  const glm::dvec3 x(hit->x_hit, hit->y_hit, hit->z_hit), from = from_of(*ray);
  const ray_casting::AlongRay along({from, along_of(*ray), 0, 0});
  const glm::dvec3 one = target.corners[1] - target.corners[0], other = glm::cross(target.plane.normal(), one);
  glm::dvec3 way = along.project(from + other).y * one - along.project(from + one).y * other;
  if (along.project(from + way).x > 0) way = -way;  // crossings count where x is less
  if (!(glm::length(way) > 0)) return;
  way = glm::normalize(way);
  std::vector<double> crossings;
  for (std::size_t k = 0; k < target.corners.size(); ++k) {
    const glm::dvec3 corner = target.corners[k], next = target.corners[(k + 1) % target.corners.size()];
    const glm::dvec2 a = along.project(corner), b = along.project(next);
    if ((a.y <= 0) == (b.y <= 0)) continue;
    const double share = a.y / (a.y - b.y);
    if (glm::mix(a.x, b.x, share) <= 0) crossings.push_back(glm::dot(glm::mix(corner, next, share) - x, way));
  }
  std::sort(crossings.begin(), crossings.end());
  const double beyond = 0.3 * glm::length(one);
  pen.line(x, x + ((crossings.empty() ? 0 : crossings.back()) + beyond) * way, pen.colors.selected, 2.4, false, true);
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    pen.dot(x + crossings[k] * way, 5, 0, pen.colors.selected);
    pen.word(x + crossings[k] * way, std::to_string(k + 1), pen.colors.text, true);
  }
  pen.word(x, "X", pen.colors.now, true);
}

/// Warnock's area as the part of space that is seen through it.
void draw_area(RoomPen& pen, const Moment& now) {
  const MethodState& m = now.state().machine;
  if (m.area < 0 || m.area >= std::ssize(m.areas)) return;
  const AreaBegin& area = m.areas[m.area].entry;
  const Room& room = pen.room;
  const auto at = [&](double z) {
    return room.rectangle(area.first_column - 0.5, area.first_row - 0.5, area.end_column - 0.5, area.end_row - 0.5, z);
  };
  const bool window = room.has_eye() && room.camera().d < room.end();
  const auto front = at(window ? room.camera().d : room.near()), back = at(room.end());
  for (std::size_t k = 0; k < 4; ++k)
    pen.line(room.has_eye() ? room.camera().eye : front[k], back[k], pen.colors.now, 1.2);
  pen.veil(front, pen.colors.now, 60);
  pen.around(front, pen.colors.now, 2);
  pen.around(back, pen.colors.now, 1.2);
}

/// The other eyes that the lesson speaks of, before anything is done.
void draw_other_eyes(RoomPen& pen, const Moment& now) {
  int eye = 1;
  if (now.position() > 0) return;
  for (const Camera* other : now.other_eyes()) {
    pen.dot(other->eye, 5, 0, pen.colors.muted);
    pen.word(other->eye, fmt::format("eye {}", ++eye), pen.colors.text);
  }
}

/// The lamp, and what it sees; while its own picture is made, the eye.
void draw_lamp(RoomPen& pen, const Moment& now) {
  const auto& light = now.scene().light;
  if (!light) return;
  const Theme& c = pen.colors;
  if (pen.room.by_lamp()) {
    if (now.scene().camera.kind != Camera::Kind::perspective) return;
    pen.dot(now.scene().camera.eye, 5, 0, c.muted);
    pen.word(now.scene().camera.eye, "eye", c.muted);
    return;
  }
  pen.dot(light->position, 7, 3, c.text);
  pen.word(light->position, "light", c.text);
  if (!records<ShadowCompare>(now.header())) return;
  const Room seen(now.scene(), true);
  const auto end = seen.window(light->far);
  for (const glm::dvec3& corner : end) pen.line(light->position, corner, c.muted, 1);
  pen.around(end, c.muted, 1, true);
}

}  // namespace

void draw_in_space(RoomPen& pen, const Moment& now, const std::optional<Cell>& cell, int viewing, double arrived) {
  const Stop* const told = now.told();
  if (told && told->window && pen.room.has_eye()) return draw_told_window(pen, *told->window);
  draw_edges(pen, now);
  draw_axes(pen, now, viewing, arrived, cell.has_value());
  draw_eye(pen);
  draw_lamp(pen, now);
  draw_other_eyes(pen, now);
  number_vertices(pen, now);
  if (told) draw_labels(pen, now), draw_orders(pen, now.scene().camera, told->orders);
  if (now.at_rest()) return draw_line_of_sight(pen, now, cell), draw_light_at_vertices(pen, now);
  draw_dividing_plane(pen, now);
  draw_scan_plane(pen, now);
  draw_area(pen, now);
  draw_planes_by_name(pen, now);
  draw_clipping(pen, now);
  draw_at_work(pen, now);
  draw_vertex(pen, now);
  draw_facing(pen, now);
  draw_light_at_vertices(pen, now);
  draw_line_of_sight(pen, now, cell);
  draw_rays(pen, now);
  draw_half_line(pen, now);
}

}  // namespace zstep::viewer
