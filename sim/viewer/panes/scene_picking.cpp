#include "sim/viewer/panes/scene_picking.hpp"

#include <algorithm>
#include <cmath>

#include "sim/viewer/draw/strokes.hpp"
#include "sim/viewer/panes/here_lines.hpp"
#include "sim/viewer/panes/room_pen.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
namespace {

bool is_seen(const Picture& seen, const Outside::Spot& spot) {
  const int x = static_cast<int>(spot.x), y = static_cast<int>(spot.y);
  // At an outline the pixel beside it may be another polygon's.
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= seen.width || y + dy >= seen.height) return true;
      if (spot.depth <= seen.depth[seen.at(x + dx, y + dy)] + as_near) return true;
    }
  return false;
}

/// The nearest so far, what is seen before what is hidden.
struct Nearest {
  double away = 0;
  bool seen = false, any = false;
  bool take(double distance, double reach, bool is_seen) {
    if (distance > reach || (any && (seen != is_seen ? seen : away <= distance))) return false;
    away = distance, seen = is_seen, any = true;
    return true;
  }
};

ImVec2 on_screen(const Outside::Spot& spot, ImVec2 at) {
  return {at.x + static_cast<float>(spot.x), at.y + static_cast<float>(spot.y)};
}

void draw_part(const Ui& ui, const Outside& outside, const Room& room, const ScenePart& part, bool picked, ImVec2 at) {
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto place = [&](std::int32_t vertex) { return room.polygons().points[static_cast<std::size_t>(vertex)]; };
  if (part.edge)
    if (const auto ends = outside.line(place(part.edge->first), place(part.edge->second))) {
      const ImVec2 from = on_screen((*ends)[0], at), to = on_screen((*ends)[1], at);
      stroke_line(list, from, to, c.pane, (picked ? 7.0f : 5.0f) * ui.thin);
      stroke_line(list, from, to, c.selected, (picked ? 4.0f : 2.0f) * ui.thin);
    }
  if (!part.vertex) return;
  const auto spot = outside.spot(place(*part.vertex));
  if (!spot) return;
  const ImVec2 middle = on_screen(*spot, at);
  const float half = std::round(ui.em * 0.3f);
  const ImVec2 low{std::round(middle.x - half), std::round(middle.y - half)}, high{low.x + 2 * half, low.y + 2 * half};
  list->AddRectFilled(low, high, picked ? c.selected : c.pane);
  frame_box(ui, low, high, picked ? c.text : c.selected, 2);
}

}  // namespace

ScenePart part_under(const Ui& ui, const Outside& outside, const Room& room, const Picture& seen, ImVec2 mouse,
                     ImVec2 at) {
  const Scene& scene = ui.session.scene();
  if (scene.corners.size() > most_corners_picked) return {};
  const double x = static_cast<double>(mouse.x - at.x), y = static_cast<double>(mouse.y - at.y);
  const double reach_of_vertex = static_cast<double>(ui.em) * 0.9, reach_of_edge = static_cast<double>(ui.em) * 0.45;
  ScenePart vertex, edge;
  Nearest nearest_vertex, nearest_edge;
  for (const EdgeEnds& ends : edges_of(scene)) {
    const glm::dvec3 from = room.polygons().points[static_cast<std::size_t>(ends.first)],
                     to = room.polygons().points[static_cast<std::size_t>(ends.second)];
    for (const auto& [number, place] : {std::pair{ends.first, from}, {ends.second, to}})
      if (const auto spot = outside.spot(place))
        if (nearest_vertex.take(portable::length(spot->x - x, spot->y - y), reach_of_vertex, is_seen(seen, *spot)))
          vertex.vertex = number;
    const auto line = outside.line(from, to);
    if (!line) continue;
    const Outside::Spot &a = (*line)[0], &b = (*line)[1];
    const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
    if (!(length > 0)) continue;
    const double t = std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length, 0.0, 1.0);
    const Outside::Spot spot{a.x + t * dx, a.y + t * dy, a.depth + t * (b.depth - a.depth)};
    if (nearest_edge.take(portable::length(spot.x - x, spot.y - y), reach_of_edge, is_seen(seen, spot)))
      edge.edge = ends;
  }
  // A hidden vertex does not lie before an edge that is seen.
  const bool edge_first = !nearest_vertex.any || (nearest_edge.seen && !nearest_vertex.seen);
  return edge_first && edge.any() ? edge : vertex;
}

bool pick_parts(Ui& ui, const Room& room, const Picture& seen, ImVec2 size, ImVec2 at) {
  Session& s = ui.session;
  const Outside outside(room, ui.look, static_cast<int>(size.x), static_cast<int>(size.y));
  const bool hovers = ImGui::IsItemHovered() && !ImGui::IsItemActive();
  const ImVec2 mouse = ImGui::GetIO().MousePos, drag = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 4);
  const bool clicked = ImGui::IsItemDeactivated() && ImGui::IsItemHovered() && drag.x == 0 && drag.y == 0 &&
                       ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  const ScenePart under = hovers || clicked ? part_under(ui, outside, room, seen, mouse, at) : ScenePart{};
  if (clicked && under.any()) s.pick(s.picked_part == under ? ScenePart{} : under);
  const ScenePart shown = s.lit_part();
  ImGui::PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  if (under.any() && !(under == s.picked_part)) draw_part(ui, outside, room, under, false, at);
  if (shown.any()) draw_part(ui, outside, room, shown, true, at);
  ImGui::PopClipRect();
  if (!under.any() || !hovers) return under.any();
  ui.hovered_part_next = under;
  ui.mouse_help = s.picked_part == under ? "Click: pick nothing. Right click: more."
                                         : "Click: picks the " + name_of(s.scene(), under) + ". Right click: more.";
  tooltip(ui, {told_of(s.scene(), under)});
  if (ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) ui.here = lines_of_part(s, under);
  return true;
}

}  // namespace zstep::viewer
