// What a lesson's stop names, in the scene: vertices, lines, arrows, polygons and planes by its labels, and a window.
#include "sim/viewer/panes/scene_in_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

/// What the lesson's stop names: vertices with dots, lines dashed where they are no edges, arrows, polygons.
void draw_labels(RoomPen& pen, const Moment& now) {
  const Scene& scene = pen.room.polygons();
  const Theme& c = pen.colors;
  const std::vector<EdgeEnds> edges = edges_of(scene);
  for (const StopLabel& label : now.told()->labels) {
    if (label.vertex < 0) {
      const std::string& polygon = label.plane_of.empty() ? label.name : label.plane_of;
      for (const Facet& facet : scene.facets) {
        if (polygon_label(now.scene(), facet.polygon) != polygon) continue;
        glm::dvec3 middle(0), normal(0);  // of the plane as the scene gives it
        const auto corner = [&](std::int32_t k) {
          return now.scene().points[scene.corners[facet.first_corner + k % facet.corner_count]];
        };
        for (std::int32_t k = 0; k < facet.corner_count; ++k) {
          middle += scene.points[scene.corners[facet.first_corner + k]] / static_cast<double>(facet.corner_count);
          normal += glm::cross(corner(k) - corner(0), corner(k + 1) - corner(0));
        }
        if (label.plane_of.empty()) {
          pen.word(middle, label.name, c.text, true);
          continue;
        }
        const auto section = pen.room.section(normal.x, normal.y, normal.z, -glm::dot(normal, corner(0)));
        if (section.empty()) continue;
        pen.veil(section, c.selected, 80);
        pen.around(section, c.selected, 1.6);
        pen.word(section[0], label.name, c.text, true);
      }
      continue;
    }
    const glm::dvec3 from = scene.points[label.vertex];
    if (label.to < 0) {
      pen.dot(from, 4, 0, c.now);
      pen.word(from, label.name, c.now, true);
      continue;
    }
    const glm::dvec3 to = scene.points[label.to];
    const bool edge =
        std::find(edges.begin(), edges.end(), EdgeEnds(std::minmax(label.vertex, label.to))) != edges.end();
    if (label.arrow) pen.arrow(from, to, c.selected);
    else pen.line(from, to, c.now, 2.4, !edge);
    if (!label.name.empty()) pen.word(0.5 * (from + to), label.name, label.arrow ? c.text : c.now, true);
  }
}

/// The window of which the stop speaks: its four sides by their numbers, its distance along the line of sight, and the
/// angle \u03b1 from its bottom to its top; or the view volume from there to the far plane.
void draw_told_window(RoomPen& pen, const StopWindow& w) {
  const Theme& c = pen.colors;
  const Room& room = pen.room;
  const auto corners = room.rectangle_in_view(w.left, w.right, w.bottom, w.top, w.distance);
  const auto at = [&](double x, double y, double z) { return room.rectangle_in_view(x, x, y, y, z)[0]; };
  const glm::dvec3 eye = room.camera().eye;
  const auto name = [&](const char* symbol, double value) { return fmt::format("{} = {}", symbol, number(value)); };
  pen.dot(eye, 5, 0, c.text);
  pen.word(eye, "eye", c.text, true);
  pen.around(corners, c.now, 2.6);
  if (w.far > 0) {
    const double more = w.far / w.distance;
    const auto end = room.rectangle_in_view(w.left * more, w.right * more, w.bottom * more, w.top * more, w.far);
    for (std::size_t k = 0; k < 4; ++k) pen.line(eye, end[k], c.muted, 1.2);
    pen.around(end, c.now, 2.6);
    pen.line(eye, at(0, 0, w.far), c.text, 1.6, true);
    pen.word(corners[3], name("near: f", w.distance), c.now, true);
    pen.word(end[3], name("far: F", w.far), c.now, true);
    return;
  }
  for (const glm::dvec3& corner : corners) pen.line(eye, corner, c.muted, 1.2);
  const double x = (w.left + w.right) / 2, y = (w.bottom + w.top) / 2;
  pen.word(at(w.left, y, w.distance), name("L", w.left), c.now, true);
  pen.word(at(w.right, y, w.distance), name("R", w.right), c.now, true);
  pen.word(at(x, w.bottom, w.distance), name("B", w.bottom), c.now, true);
  pen.word(at(x, w.top, w.distance), name("T", w.top), c.now, true);
  const glm::dvec3 middle = at(0, 0, w.distance), low = at(0, w.bottom, w.distance), high = at(0, w.top, w.distance);
  pen.line(eye, middle, c.text, 1.6, true);
  pen.dot(middle, 3, 0, c.text);
  pen.word(0.5 * (eye + middle), name(w.distance == room.camera().d ? "d" : "f", w.distance), c.text, true);
  if (!w.angle) return;
  pen.line(eye, low, c.selected, 2), pen.line(eye, high, c.selected, 2), pen.line(low, high, c.selected, 1.2, true);
  constexpr int parts = 24;
  const double radius = 0.3 * w.distance, first = portable::atan2(w.bottom, w.distance),
               whole = portable::atan2(w.top, w.distance) - first;
  const auto arc = [&](double t) {
    const double angle = first + t * whole;
    return at(0, radius * portable::sin(angle), radius * portable::cos(angle));
  };
  for (int k = 0; k < parts; ++k) pen.line(arc(ratio(k, parts)), arc(ratio(k + 1, parts)), c.selected, 2);
  pen.word(arc(0.75), "\u03b1", c.text, true);
}

}  // namespace zstep::viewer
