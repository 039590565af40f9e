#include "sim/viewer/panes/scene_outside.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "algorithms/fast/z_buffer.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/scene_pieces.hpp"
#include "sim/viewer/panes/vertex_stages.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/pieces.hpp"

namespace zstep::viewer {
namespace {

Picture polygons_seen(const Outside& outside, const Scene& polygons) {
  Conventions plain;
  plain.cull = false;
  return z_buffer::run_fast(outside.seen(polygons), plain);
}

/// Draws lines and planes into the room: what a polygon hides of them is faint.
class RoomPen {
 public:
  RoomPen(ChartPicture& picture, const Picture& seen, const Room& of, const Outside& outside, const Theme& theme,
          double thin)
      : room(of), colors(theme), picture_(picture), seen_(seen), outside_(outside), thin_(thin) {}

  void line(glm::dvec3 from, glm::dvec3 to, ImU32 color, double thickness = 1, bool dashed = false) {
    const auto ends = outside_.line(from, to);
    if (!ends) return;
    const auto& [a, b] = *ends;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!std::isfinite(length)) return;
    const int parts = static_cast<int>(std::clamp(length / 3, 1.0, 2000.0));
    const auto at = [&](int k) {
      const double t = static_cast<double>(k) / parts;
      return Outside::Spot{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.depth + (b.depth - a.depth) * t};
    };
    for (int first = 0; first < parts;) {
      const bool behind = hidden(at(first), at(first + 1));
      int last = first + 1;
      while (last < parts && hidden(at(last), at(last + 1)) == behind && !(dashed && (last - first) >= 2)) ++last;
      const Outside::Spot from_here = at(first), to_here = at(last);
      picture_.canvas.line(from_here.x, from_here.y, to_here.x, to_here.y, thickness * thin_, to_pixel(color),
                           behind ? 70 : 255);
      first = last + (dashed ? 2 : 0);
    }
  }
  void around(const std::vector<glm::dvec3>& corners, ImU32 color, double thickness = 1, bool dashed = false) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      line(corners[k], corners[(k + 1) % corners.size()], color, thickness, dashed);
  }
  void around(const std::array<glm::dvec3, 4>& corners, ImU32 color, double thickness = 1, bool dashed = false) {
    around(std::vector(corners.begin(), corners.end()), color, thickness, dashed);
  }
  void dot(glm::dvec3 at, double radius, int shape, ImU32 color) {
    if (const auto spot = outside_.spot(at))
      picture_.canvas.mark(spot->x, spot->y, radius * thin_, shape, to_pixel(color));
  }
  void word(glm::dvec3 at, const std::string& text, ImU32 color) {
    const auto spot = outside_.spot(at);
    if (spot && spot->x >= 0 && spot->y >= 0 && spot->x < seen_.width && spot->y < seen_.height)
      picture_.words.push_back({{static_cast<float>(spot->x), static_cast<float>(spot->y)}, color, text});
  }
  /// A plane that one sees through; a convex outline.
  void veil(const std::vector<glm::dvec3>& corners, ImU32 color, unsigned share) {
    if (corners.size() < 3) return;
    Scene plane;
    plane.points = corners;
    plane.polygons.resize(1);
    plane.facets.push_back({0, 0, static_cast<std::int32_t>(corners.size())});
    for (std::size_t k = 0; k < corners.size(); ++k) plane.corners.push_back(static_cast<std::int32_t>(k));
    const Picture veil = polygons_seen(outside_, plane);
    for (int y = 0; y < veil.height; ++y)
      for (int x = 0; x < veil.width; ++x) {
        const std::size_t at = veil.at(x, y);
        if (veil.polygon[at] == no_polygon) continue;
        Pixel32& pixel = picture_.canvas.row(y)[x];
        pixel = mixed(pixel, to_pixel(color), veil.depth[at] <= seen_.depth[at] + as_near ? share : share / 5);
      }
  }
  void veil(const std::array<glm::dvec3, 4>& corners, ImU32 color, unsigned share) {
    veil(std::vector(corners.begin(), corners.end()), color, share);
  }

  const Room& room;
  const Theme& colors;

 private:
  bool hidden(const Outside::Spot& a, const Outside::Spot& b) const {
    const double x = (a.x + b.x) / 2, y = (a.y + b.y) / 2, depth = (a.depth + b.depth) / 2;
    if (!(x >= 0 && y >= 0 && x < seen_.width && y < seen_.height)) return false;
    return depth > seen_.depth[seen_.at(static_cast<int>(x), static_cast<int>(y))] + as_near;
  }

  static constexpr double as_near = 1e-3;  ///< what lies in a polygon's plane is not hidden by it

  ChartPicture& picture_;
  const Picture& seen_;
  const Outside& outside_;
  double thin_;
};

constexpr std::size_t few_corners = 2000;  ///< up to so many, edges are drawn

void draw_edges(RoomPen& pen, const Scene& polygons) {
  if (polygons.corners.size() > few_corners) return;
  std::set<std::pair<std::int32_t, std::int32_t>> drawn;
  for (const Facet& facet : polygons.facets)
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const auto corner = [&](std::int32_t i) {
        return polygons.corners[static_cast<std::size_t>(facet.first_corner + i % facet.corner_count)];
      };
      if (!drawn.insert(std::minmax(corner(k), corner(k + 1))).second) continue;
      pen.line(polygons.points[static_cast<std::size_t>(corner(k))],
               polygons.points[static_cast<std::size_t>(corner(k + 1))], pen.colors.text, 0.8);
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
  if (!perspective) return;
  pen.dot(camera.eye, 5, 0, c.text);
  pen.word(camera.eye, room.by_lamp() ? "light" : "eye", c.text);
}

void draw_axes(RoomPen& pen, const Moment& now) {
  const Camera& camera = now.scene().camera;
  if (camera.kind == Camera::Kind::screen) return;
  const Theme& c = pen.colors;
  const double length = 0.45 * pen.room.size();
  constexpr const char* names[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 end(0);
    end[axis] = length;
    pen.line(glm::dvec3(0), end, c.muted, 1.2);
    pen.word(end, names[axis], c.muted);
  }
  // Where the eye is, as 000 says it, while points are moved into its coordinates.
  const auto& vertices = now.state().vertices;
  const bool views = now.event() && get_if<ViewTransform>(&now.event()->event),
             begins = (vertices.empty() || vertices[0].stage == VertexStages::untouched) &&
                      now.state().machine.pieces.empty() && now.state().machine.rays.tree.empty();
  if (!camera.polar || camera.kind != Camera::Kind::perspective || pen.room.by_lamp() || !(views || begins)) return;
  const double theta = glm::radians(camera.theta), phi = glm::radians(camera.phi), radius = 0.6 * length;
  const glm::dvec3 foot(camera.eye.x, camera.eye.y, 0);
  pen.line(glm::dvec3(0), camera.eye, c.now, 1.6);
  pen.line(glm::dvec3(0), foot, c.muted, 1, true);
  pen.line(foot, camera.eye, c.muted, 1, true);
  const auto arc = [&](double angle, auto place, const char* name) {
    constexpr int parts = 24;
    for (int k = 0; k < parts; ++k) pen.line(place(angle * k / parts), place(angle * (k + 1) / parts), c.now, 1.6);
    pen.word(place(angle / 2), name, c.now);
  };
  arc(
      theta, [&](double t) { return radius * glm::dvec3(std::cos(t), std::sin(t), 0); }, "\u03b8");
  arc(
      phi,
      [&](double t) {
        return radius * glm::dvec3(std::sin(t) * std::cos(theta), std::sin(t) * std::sin(theta), std::cos(t));
      },
      "\u03c6");
  pen.word(0.55 * camera.eye, "\u03c1", c.now);
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

/// The polygon or piece at work, and the pair under test.
void draw_at_work(RoomPen& pen, const Moment& now) {
  const MethodState& m = now.state().machine;
  const Scene& polygons = pen.room.polygons();
  const Theme& c = pen.colors;
  if (m.facet >= 0 && static_cast<std::size_t>(m.facet) < polygons.facets.size()) {
    const Facet& facet = polygons.facets[static_cast<std::size_t>(m.facet)];
    std::vector<glm::dvec3> corners;
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      corners.push_back(
          polygons
              .points[static_cast<std::size_t>(polygons.corners[static_cast<std::size_t>(facet.first_corner + k)])]);
    pen.around(corners, c.now, 2.6);
  }
  const auto piece = [&](std::int32_t number, ImU32 color) {
    if (number >= 0 && static_cast<std::size_t>(number) < m.pieces.size())
      draw_outline(pen, now, m.pieces[static_cast<std::size_t>(number)].outline, color);
  };
  piece(piece_shown(now), c.now);
  if (m.pair && !m.list.empty()) piece(m.pair->other, c.selected), piece(m.pair->piece, c.now);
}

/// The vertex at work, and where its line of sight meets the window.
void draw_vertex(RoomPen& pen, const Moment& now) {
  const std::int32_t vertex = vertex_at_work(now.event());
  const auto at = static_cast<std::size_t>(vertex);
  if (vertex < 0 || at >= pen.room.polygons().points.size()) return;
  const Theme& c = pen.colors;
  const glm::dvec3 point = pen.room.polygons().points[at];
  pen.dot(point, 5, 0, c.now);
  const auto seen = on_raster(now.scene(), now.state(), vertex);
  if (!pen.room.has_eye() || !seen) return;
  const glm::dvec3 on_window = pen.room.behind(seen->x, seen->y, pen.room.camera().d);
  pen.line(pen.room.camera().eye, point, c.now, 1.2, true);
  pen.dot(on_window, 4, 1, c.now);
}

/// The plane that divides space at the node at work.
void draw_dividing_plane(RoomPen& pen, const Moment& now) {
  const MethodState& m = now.state().machine;
  if (m.node < 0 || static_cast<std::size_t>(m.node) >= m.tree.size()) return;
  const TreeNode& node = m.tree[static_cast<std::size_t>(m.node)];
  if (node.pieces.empty() || static_cast<std::size_t>(node.pieces[0]) >= m.pieces.size()) return;
  const auto& plane = m.pieces[static_cast<std::size_t>(node.pieces[0])].plane;
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

/// Warnock's area as the part of space that is seen through it.
void draw_area(RoomPen& pen, const Moment& now) {
  const MethodState& m = now.state().machine;
  if (m.area < 0 || static_cast<std::size_t>(m.area) >= m.areas.size()) return;
  const AreaBegin& area = m.areas[static_cast<std::size_t>(m.area)].entry;
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

/// The lamp, and what it sees; while its own picture is made, the eye.
void draw_lamp(RoomPen& pen, const Moment& now) {
  const auto& light = now.scene().light;
  if (!light) return;
  const Theme& c = pen.colors;
  if (pen.room.by_lamp()) {
    if (now.scene().camera.kind != Camera::Kind::perspective) return;
    pen.dot(now.scene().camera.eye, 5, 0, c.muted);
    return pen.word(now.scene().camera.eye, "eye", c.muted);
  }
  pen.dot(light->position, 7, 3, c.text);
  pen.word(light->position, "light", c.text);
  if (!has_step_of<ShadowCompare>(now.header())) return;
  const Room seen(now.scene(), true);
  const auto end = seen.window(light->far);
  for (const glm::dvec3& corner : end) pen.line(light->position, corner, c.muted, 1);
  pen.around(end, c.muted, 1, true);
}

void see_polygons(OutsideSeen& seen, const Kept<Room>& room, const Look& look, const glm::dvec2& size) {
  const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
  seen.polygons = polygons_seen(Outside(room.made, look, width, height), room.made.polygons());
  find_label_spots(seen.letters, RasterMap({width, height, false}, {}, width, height), seen.polygons);
}

void paint_outside(ChartPicture& picture, const Kept<OutsideSeen>& kept, const Kept<Room>& kept_room, const Look& look,
                   const glm::dvec2& size, const Moment& now, const std::optional<Cell>& cell, const Theme& c,
                   const float& thin) {
  const Room& room = kept_room.made;
  const Picture& seen = kept.made.polygons;
  const Outside outside(room, look, seen.width, seen.height);
  picture.words.clear();
  picture.canvas.resize(static_cast<int>(size.x), static_cast<int>(size.y));
  picture.canvas.fill(to_pixel(c.pane));
  const std::int32_t at_work = now.state().machine.polygon;
  for (int y = 0; y < seen.height; ++y) {
    Pixel32* const row = picture.canvas.row(y);
    const std::int32_t* const polygons = seen.polygon.data() + seen.at(0, y);
    for (int x = 0; x < seen.width; ++x) {
      if (polygons[x] == no_polygon) continue;
      const Pixel32 own = opaque(room.polygons().polygons[static_cast<std::size_t>(polygons[x])].color);
      row[x] = at_work == no_polygon || at_work == polygons[x] ? own : mixed(row[x], own, 190);
    }
  }
  RoomPen pen(picture, seen, room, outside, c, static_cast<double>(thin));
  draw_edges(pen, room.polygons());
  draw_axes(pen, now);
  draw_eye(pen);
  draw_lamp(pen, now);
  draw_dividing_plane(pen, now);
  draw_scan_plane(pen, now);
  draw_area(pen, now);
  draw_at_work(pen, now);
  draw_vertex(pen, now);
  draw_line_of_sight(pen, now, cell);
  draw_rays(pen, now);
}

/// Letters of polygons, then the other words, each where no other stands.
void write_words(Ui& ui, const OutsideSeen& seen, const ChartPicture& picture, ImVec2 at) {
  std::vector<ImVec4> taken;
  const auto write = [&](ImVec2 middle, const ImFont* font, ImU32 color, const std::string& text, bool on_polygon) {
    const ImVec2 size = text_size(ui, font, text);
    const float width = static_cast<float>(picture.canvas.width()),
                height = static_cast<float>(picture.canvas.height());
    if (size.x + 4 > width || size.y + 2 > height) return;
    const float left = std::clamp(middle.x + (on_polygon ? -size.x / 2 : 6), 2.0f, width - size.x - 2);
    const float top = std::clamp(middle.y - size.y / 2, 0.0f, height - size.y);
    const ImVec4 box{left - 2, top, left + size.x + 2, top + size.y};
    for (const ImVec4& other : taken)
      if (box.x < other.z && other.x < box.z && box.y < other.w && other.y < box.w) return;
    taken.push_back(box);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x + box.x, at.y + box.y}, {at.x + box.z, at.y + box.w},
                                              ui.colors().pane);
    draw_text(ui, {at.x + left, at.y + top}, font, color, text);
  };
  const Scene& scene = ui.session.scene();
  int letters = 0;
  for (const LabelSpot& spot : seen.letters)
    if (static_cast<float>(spot.pixels) > 1.5f * ui.em * ui.em && ++letters <= 26)
      write({static_cast<float>(spot.cell.x), static_cast<float>(spot.cell.y)}, ui.fonts.bold, ui.colors().text,
            polygon_label(scene, spot.polygon), true);
  if (static_cast<float>(picture.canvas.width()) < 15 * ui.em) return;  // letters alone
  for (const ChartPicture::Word& word : picture.words) write(word.at, ui.fonts.small, word.color, word.text, false);
}

void walk_round(Ui& ui, ImVec2 size) {
  const ImGuiIO& io = ImGui::GetIO();
  Look& look = ui.look;
  const Look before = look;
  if (ImGui::IsItemHovered()) {
    ui.mouse_help = "Drag: walk round. Shift+drag: move. Wheel: nearer. Double click: back. Shift+V: through the eye.";
    if (io.MouseWheel != 0)
      look.zoom = std::clamp(look.zoom * std::pow(1.25, static_cast<double>(io.MouseWheel)), 0.3, 40.0);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) look = {};
  }
  const bool left = ImGui::IsMouseDragging(ImGuiMouseButton_Left, 3);
  if (ImGui::IsItemActive() && (left || ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 3))) {
    if (left && !io.KeyShift) {
      look.turn -= io.MouseDelta.x * 0.4;
      look.tilt = std::clamp(look.tilt + io.MouseDelta.y * 0.4, least_tilt, most_tilt);
    } else {
      look.across += io.MouseDelta.x / size.x;
      look.up -= io.MouseDelta.y / size.y;
    }
  }
  if (!(look == before)) ui.session.touch();
}

void tell_what_is_pointed_at(Ui& ui, const Picture& seen, ImVec2 at) {
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const int x = static_cast<int>(mouse.x - at.x), y = static_cast<int>(mouse.y - at.y);
  if (x < 0 || y < 0 || x >= seen.width || y >= seen.height) return;
  const std::int32_t polygon = seen.polygon[seen.at(x, y)];
  if (polygon == no_polygon) return;
  const Scene& scene = ui.session.scene();
  const Polygon& told = scene.polygons[static_cast<std::size_t>(polygon)];
  std::vector<std::string> lines{"polygon " + polygon_label(scene, polygon)};
  if (told.source_line > 0) lines.push_back(fmt::format("line {} of {}", told.source_line, scene.source));
  tooltip(ui, lines);
}

}  // namespace

bool seen_from_outside(const Ui& ui) {
  const Session& s = ui.session;
  constexpr std::size_t many_corners = 400'000;
  return ui.from_outside.value_or(!has_step_of<ListInsert>(s.header()) && s.scene().corners.size() <= many_corners);
}

void draw_outside(Ui& ui, ImVec2 size) {
  const auto make_room = [](Room& room, const Scene& scene, const bool& by_lamp) { room = Room(scene, by_lamp); };
  const bool by_lamp = ui.session.state().machine.pass == Pass::light;
  const Kept<Room>& room = *keep<Room>(ui.rooms, "room", +make_room, ui.session.scene(), by_lamp);
  const glm::dvec2 whole{std::floor(size.x), std::floor(size.y)};
  const Kept<OutsideSeen>& seen = *keep<OutsideSeen>(ui.seen_from_outside, "seen", see_polygons, room, ui.look, whole);
  const ChartPicture& picture = keep<ChartPicture>(ui.charts, "outside", paint_outside, seen, room, ui.look, whole,
                                                   ui.moment(), ui.session.current_cell(), ui.colors(), ui.thin)
                                    ->made;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("outside", size);
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(picture.canvas), at,
                                       {at.x + static_cast<float>(whole.x), at.y + static_cast<float>(whole.y)});
  write_words(ui, seen.made, picture, at);
  walk_round(ui, size);
  tell_what_is_pointed_at(ui, seen.made.polygons, at);
}

}  // namespace zstep::viewer
