// The canonical view volume: the scene after the division by w, clipped, in the cube that the view volume has become.
// 003 (Sigal), "View Volume": x*, y* and z* go from -1 to 1 in it, z* from the near plane to the far one.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "algorithms/viewing/clip.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::viewer {
namespace {

viewing::Lens lens_of(const Scene& scene) { return {scene.camera, scene.raster, Conventions::Depth::pseudodepth}; }

/// A point in view coordinates after the division, at (x*, z*, y*); none of one that lies outside the view volume by
/// more than rounding.
std::optional<glm::dvec3> divided(const viewing::Lens& lens, glm::dvec3 view) {
  constexpr double rounding = 1e-9;
  const glm::dvec4 clip = lens.clip_coordinates(view);
  const auto inside = [&](double value) { return std::abs(value) <= clip.w * (1 + rounding); };
  if (!(clip.w > 0) || !inside(clip.x) || !inside(clip.y) || !inside(clip.z)) return std::nullopt;
  return glm::dvec3(clip.x, clip.z, clip.y) / clip.w;
}

}  // namespace

Scene in_canonical_volume(const Scene& scene) {
  Scene cube;
  cube.raster = scene.raster, cube.polygons = scene.polygons;
  cube.camera.kind = Camera::Kind::orthographic, cube.camera.polar = false;
  cube.camera.eye = {0, -1, 0};  // the reader looks along z*
  cube.camera.far = 1;
  if (scene.camera.kind == Camera::Kind::screen) return cube;
  const viewing::Lens lens = lens_of(scene);
  NullRecorder nothing;
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, nothing);
  clipping::Outline outline;
  for (const Facet& facet : scene.facets) {
    vertices.resize(scene.points.size());  // without those that clipping made for the facet before
    const auto corners = scene.corners.begin() + facet.first_corner;
    outline.assign(corners, corners + facet.corner_count);
    if (!clipping::clip_outline(facet.polygon, scene.camera.kind, lens, vertices, outline, nothing)) continue;
    const std::int32_t first = size32(cube.corners);
    for (const std::int32_t vertex : outline)
      if (const auto at = divided(lens, vertices[vertex].view)) {
        cube.corners.push_back(size32(cube.points));
        cube.points.push_back(*at);
      }
    if (size32(cube.corners) - first >= 3) cube.facets.push_back({facet.polygon, first, size32(cube.corners) - first});
  }
  return cube;
}

void draw_canonical(RoomPen& pen, const Moment& now) {
  const Theme& c = pen.colors;
  const Scene &cube = pen.room.polygons(), &scene = now.scene();
  const viewing::Lens lens = lens_of(scene);
  const auto around = [&](const Facet& facet, ImU32 color, double thickness) {
    std::vector<glm::dvec3> corners;
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      corners.push_back(cube.points[cube.corners[facet.first_corner + k]]);
    pen.around(corners, color, thickness);
  };
  const bool few = cube.corners.size() <= most_corners_picked;
  for (const Facet& facet : cube.facets)
    if (few) around(facet, c.text, 0.8);

  const auto square = [](double z) {
    return std::array<glm::dvec3, 4>{{{-1, z, -1}, {1, z, -1}, {1, z, 1}, {-1, z, 1}}};
  };
  const auto near = square(-1), far = square(1);
  for (std::size_t k = 0; k < 4; ++k) pen.line(near[k], far[k], c.muted, 1);
  pen.around(near, c.text, 2);
  pen.around(far, c.muted, 1, true);
  pen.word(near[3], "near", c.text), pen.word(far[1], "far", c.muted);
  pen.word(near[0], "(\u22121, \u22121, \u22121)", c.text), pen.word(far[2], "(1, 1, 1)", c.text);
  for (const auto& [end, name] :
       {std::pair{glm::dvec3(1.25, 0, 0), "x*"}, {glm::dvec3(0, 0, 1.25), "y*"}, {glm::dvec3(0, 1.25, 0), "z*"}}) {
    pen.line(glm::dvec3(0), end, c.muted, 1.2);
    pen.word(end, name, c.muted);
  }

  const auto& vertices = now.state().vertices;
  const auto place = [&](std::int32_t vertex) -> std::optional<glm::dvec3> {
    const glm::dmat4& view = scene.camera.view;
    if (vertex >= 0 && vertex < std::ssize(scene.points))
      return divided(lens, glm::dvec3(view * glm::dvec4(scene.points[vertex], 1)));
    return vertex >= 0 && vertex < std::ssize(vertices) ? divided(lens, vertices[vertex].view) : std::nullopt;
  };
  bool names = false;
  for (const StopLabel& label : now.told() ? now.told()->labels : std::vector<StopLabel>()) {
    const auto from = place(label.vertex), to = place(label.to);
    names = names || label.vertex >= 0;
    if (label.to >= 0 && from && to) pen.line(*from, *to, c.now, 2.4);
    if (label.to < 0 && from) pen.dot(*from, 4, 0, c.now), pen.word(*from, label.name, c.now, true);
  }
  if (now.at_rest()) return;
  const MethodState& m = now.state().machine;
  for (const Facet& facet : cube.facets)
    if (facet.polygon == m.polygon && m.facet >= 0) around(facet, c.now, 2.6);
  for (const std::int32_t vertex : m.facet >= 0 && !names ? m.outline : std::vector<std::int32_t>())
    if (const auto at = place(vertex)) pen.dot(*at, 3, 0, c.now), pen.word(*at, vertex_label(scene, vertex), c.now);

  const std::int32_t vertex = vertex_at_work(now.event());
  const auto at = place(vertex);
  if (!at || vertex >= std::ssize(vertices) || vertices[vertex].stage < VertexStages::projected) return;
  const glm::dvec3 foot(0, at->y, 0), above(0, at->y, at->z);  // as the view coordinates are drawn: z*, up, to the side
  pen.line(glm::dvec3(0), foot, c.changed, 2.4, false, true);
  pen.line(foot, above, c.changed, 2.4, false, true);
  pen.line(above, *at, c.changed, 2.4, false, true);
  pen.dot(*at, 5, 0, c.now);
  pen.word(*at, fmt::format("({}, {}, {})", number(at->x), number(at->z), number(at->y)), c.now, true);
}

namespace {

bool on_screen(Ui& ui) { return ui.session.scene().camera.kind == Camera::Kind::screen; }

void draw_canonical_pane(Ui& ui) {
  if (on_screen(ui)) return say_empty(ui, "Points on the screen have no view volume.");
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (room.x < 8 || room.y < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  draw_outside(ui, room, true);
}

std::string note_of_canonical(Ui&) { return "after the division by w"; }

}  // namespace

const Pane canonical_pane{
    "canonical", "CANONICAL VIEW VOLUME", draw_canonical_pane, note_of_canonical, nullptr, 0.5f, false, nullptr, true,
    on_screen};

}  // namespace zstep::viewer
