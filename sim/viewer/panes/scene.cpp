// The scene as a wireframe through its camera, the polygon at work in it, and the way of its vertices to the raster.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <glm/vec4.hpp>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/outline_names.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/pieces.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {
namespace {

/// World to raster for drawing; nullopt behind the eye.
struct Lens {
  const Scene& scene;
  explicit Lens(const Scene& s) : scene(s) {}

  glm::dvec3 view(const glm::dvec3& p) const { return glm::dvec3(scene.camera.view * glm::dvec4(p, 1)); }
  std::optional<glm::dvec2> raster(const glm::dvec3& v) const {
    const Camera& c = scene.camera;
    const double scale = c.kind == Camera::Kind::perspective ? c.d / v.z : 1;
    if (c.kind == Camera::Kind::perspective && v.z <= c.near * 0.5) return std::nullopt;
    const double w = scene.raster.width, h = scene.raster.height;
    return glm::dvec2(formulas::screen_x(v.x * scale, c.window * w / h, w, scene.raster),
                      formulas::screen_y(v.y * scale, c.window, h, scene.raster));
  }
  /// A segment of the world on the raster, cut at the near plane.
  std::optional<std::pair<glm::dvec2, glm::dvec2>> segment(const glm::dvec3& a, const glm::dvec3& b) const {
    if (scene.camera.kind == Camera::Kind::screen) return std::make_pair(glm::dvec2(a), glm::dvec2(b));
    glm::dvec3 from = view(a), to = view(b);
    if (scene.camera.kind == Camera::Kind::perspective) {
      const double near = std::max(scene.camera.near, 1e-9);
      if (from.z < near && to.z < near) return std::nullopt;
      if (from.z < near) from += (to - from) * ((near - from.z) / (to.z - from.z));
      if (to.z < near) to += (from - to) * ((near - to.z) / (from.z - to.z));
    }
    const auto p = raster(from), q = raster(to);
    if (!p || !q) return std::nullopt;
    return std::make_pair(*p, *q);
  }
};

void paint_wireframe(Canvas& canvas, const RasterMap& map, const Scene& scene, const Theme& c, const float& thin) {
  const Lens lens(scene);
  canvas.fill(to_pixel(c.pane));
  canvas.rectangle(static_cast<int>(map.left), static_cast<int>(map.top),
                   static_cast<int>(map.left + map.width * map.cell), static_cast<int>(map.top + map.height * map.cell),
                   to_pixel(c.head));
  std::set<std::pair<std::int32_t, std::int32_t>> drawn;
  const bool many = scene.corners.size() > 2000;
  const Pixel32 ink = many ? mixed(to_pixel(c.head), to_pixel(c.muted), 110) : to_pixel(c.muted);
  for (const Facet& facet : scene.facets)
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const std::int32_t a = scene.corners[facet.first_corner + k];
      const std::int32_t b = scene.corners[facet.first_corner + (k + 1) % facet.corner_count];
      if (!drawn.insert(std::minmax(a, b)).second) continue;
      if (const auto s = lens.segment(scene.points[a], scene.points[b]))
        canvas.line(map.px(s->first.x), map.py(s->first.y), map.px(s->second.x), map.py(s->second.y), thin, ink);
    }
}

/// The facet at work, over the wireframe; its corners dotted and, where there are few, numbered.
void draw_polygon(Canvas& canvas, const RasterMap& map, const Moment& s, const std::optional<std::int32_t>& lit,
                  const Theme& c, double thin) {
  const Scene& scene = s.scene();
  const MethodState& m = s.state().machine;
  const Lens lens(scene);
  if (m.facet >= 0 && m.facet < std::ssize(scene.facets)) {
    const Facet& facet = scene.facets[m.facet];
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const std::int32_t a = scene.corners[facet.first_corner + k];
      const std::int32_t b = scene.corners[facet.first_corner + (k + 1) % facet.corner_count];
      if (const auto e = lens.segment(scene.points[a], scene.points[b]))
        canvas.line(map.px(e->first.x), map.py(e->first.y), map.px(e->second.x), map.py(e->second.y), 2.4 * thin,
                    to_pixel(c.now));
    }
  }
  if (const std::int32_t piece = piece_shown(s); piece >= 0 && piece < std::ssize(m.pieces)) {
    // In the world where pieces are cut there, else on the raster.
    const bool world = !m.tree.empty();
    const std::vector<std::int32_t>& outline = m.pieces[piece].outline;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const auto a = cutting_point(scene, s.state(), outline[k]),
                 b = cutting_point(scene, s.state(), outline[(k + 1) % outline.size()]);
      if (!a || !b) continue;
      const auto e = world ? lens.segment(*a, *b) : std::make_pair(glm::dvec2(*a), glm::dvec2(*b));
      if (e)
        canvas.line(map.px(e->first.x), map.py(e->first.y), map.px(e->second.x), map.py(e->second.y), 2.4 * thin,
                    to_pixel(c.now));
    }
  }
  if (lit && static_cast<std::size_t>(*lit) < m.edge_table.size()) {
    const EdgeTableInsert& e = m.edge_table[*lit];
    const auto a = on_raster(scene, s.state(), e.vertex_0), b = on_raster(scene, s.state(), e.vertex_1);
    if (a && b) canvas.line(map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y), 5 * thin, to_pixel(c.selected));
  }
  if (m.scan_line) {
    const int y = nearest_int(map.py(*m.scan_line));
    const int left = std::max(0, static_cast<int>(map.left)),
              right = std::min(canvas.width(), static_cast<int>(map.left + map.width * map.cell));
    for (int x = left; x < right; x += 8)
      canvas.rectangle(x, y, std::min(x + 5, right), y + nearest_int(thin), to_pixel(c.now));
  }
}

void paint_scene(Canvas& canvas, const RasterMap& map, const Kept<Canvas>& wires, const Moment& now,
                 const std::optional<std::int32_t>& lit, const Theme& c, const float& thin) {
  canvas = wires.made;
  draw_pieces(canvas, map, now, c, thin);
  draw_polygon(canvas, map, now, lit, c, thin);
}

/// The names of polygons that are on the screen already, as in a textbook's figure.
void name_polygons(Ui& ui, const RasterMap& map, ImVec2 origin, TakenPlaces taken) {
  const Scene& scene = ui.session.scene();
  if (scene.camera.kind != Camera::Kind::screen) return;
  std::vector<NamedOutline> outlines(scene.polygons.size());
  for (const Facet& facet : scene.facets)
    if (NamedOutline& one = outlines[static_cast<std::size_t>(facet.polygon)]; one.outline.empty()) {
      one.name = polygon_label(scene, facet.polygon);
      for (std::int32_t k = 0; k < facet.corner_count; ++k) {
        const glm::dvec3& p = scene.points[static_cast<std::size_t>(scene.corners[facet.first_corner + k])];
        one.outline.emplace_back(map.px(p.x), map.py(p.y));
      }
    }
  WordPlaces words(ui, origin, moved_by(origin, map.box_width, map.box_height), std::move(taken));
  words.on_paper = false;
  name_outlines(ui, words, origin, outlines);
}

/// As the run's own eye sees it.
void draw_through_the_eye(Ui& ui, int width, int height) {
  const Session& s = ui.session;
  const RasterMap map = [&] {
    // Not in whole pixels: a wireframe may use all the room.
    RasterMap m(s.scene().raster, {}, width, height);
    m.cell = std::min((width - 8.0) / m.width, (height - 8.0) / m.height);
    m.left = std::floor((width - m.width * m.cell) / 2);
    m.top = std::floor((height - m.height * m.cell) / 2);
    return m;
  }();
  const Kept<Canvas>& wires =
      *keep_canvas(ui.canvases, "wires", width, height, paint_wireframe, map, s.scene(), ui.colors(), ui.thin);
  const Kept<Canvas>& shown = *keep_canvas(ui.canvases, "scene", width, height, paint_scene, map, wires, ui.moment(),
                                           s.lit_edge(), ui.colors(), ui.thin);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(shown.made), at,
                                       {at.x + to_float(width), at.y + to_float(height)});
  TakenPlaces taken = label_pair(ui, map, at);
  if (const auto* test = s.event() ? get_if<ExtentTest>(&s.event()->event) : nullptr; test && test->axis != Axis::z) {
    const Theme& c = ui.colors();
    WordPlaces words(ui, at, moved_by(at, width, height), std::move(taken));
    for (const auto& [number, color] : {std::pair{test->piece, c.now}, {test->other, c.selected}}) {
      const auto& pieces = s.state().machine.pieces;
      if (number < 0 || number >= std::ssize(pieces) || !pieces[static_cast<std::size_t>(number)].extent) continue;
      const Extent& box = *pieces[static_cast<std::size_t>(number)].extent;
      const ImVec2 a = moved_by(at, map.px(box.x_min), map.py(box.y_min)),
                   b = moved_by(at, map.px(box.x_max), map.py(box.y_max));
      frame_box(ui, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}, color, 1);
    }
    draw_extents(ui, words, map, at, test->axis == Axis::y,
                 {{"P", test->low, test->high, c.now}, {"Q", test->other_low, test->other_high, c.selected}});
    taken = std::move(words.taken);
  }
  name_polygons(ui, map, at, std::move(taken));
}

void draw_scene(Ui& ui) {
  if (draw_viewing_steps(ui)) return draw_outside(ui, ImGui::GetContentRegionAvail());
  const ImVec2 avail = ImGui::GetContentRegionAvail();
  // The picture has all the room while no vertex is at work, and where room is scarce, but for the steps that move one.
  // Where a lesson speaks its words have the numbers.
  const bool told = ui.moment().told() && !ui.laboratory;
  const bool scarce = (avail.y < ui.em * 15 || !ui.laboratory) && !ui.vertices_always &&
                      (told || vertex_at_work(ui.session.event()) < 0);
  const bool alone = scarce || vertices_shown(ui.session).empty();
  const float way_height = alone ? 0 : std::min(avail.y * 0.6f, std::round(ui.fonts.mono->FontSize * 1.3f) * 5 + 4);
  // Side by side when there is more width than height, else the way below the picture.
  const bool beside =
      avail.x > avail.y * 1.9f && avail.x > ui.em * 30 && !(ui.laboratory ? vertices_shown(ui.session).empty() : alone);
  const int width = static_cast<int>(beside ? avail.x - ui.em * 18 : avail.x),
            height = static_cast<int>(beside ? avail.y : avail.y - way_height);
  if (width < 8 || height < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (seen_from_outside(ui)) draw_outside(ui, {to_float(width), to_float(height)});
  else draw_through_the_eye(ui, width, height);
  if (alone && !beside) return;
  if (beside) ImGui::SetCursorScreenPos({at.x + to_float(width) + ui.em * 0.5f, at.y});
  else ImGui::SetCursorScreenPos({at.x, at.y + to_float(height)});
  begin_part(ui, "way");
  draw_vertex_stages(ui);
  ImGui::EndChild();
}

std::string note_of_scene(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  if (m.polygon == no_polygon || ui.session.at_rest()) return "";
  return "polygon " + polygon_label(ui.session.scene(), m.polygon);
}

}  // namespace

const Pane scene_pane{"scene", "SCENE", draw_scene, note_of_scene, nullptr,        0.31f,
                      false,   nullptr, false,      nullptr,       &canonical_pane};

}  // namespace zstep::viewer
