#include "sim/viewer/panes/scene_outside.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/scene_in_space.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/words/explain.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

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

ImVec2 on_screen(const Outside::Spot& spot, ImVec2 at) { return moved_by(at, spot.x, spot.y); }

void draw_part(const Ui& ui, const Outside& outside, const Room& room, const ScenePart& part, bool picked, ImVec2 at) {
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto place = [&](std::int32_t vertex) { return room.polygons().points[vertex]; };
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
  const double x = mouse.x - at.x, y = mouse.y - at.y;
  const double reach_of_vertex = ui.em * 0.9, reach_of_edge = ui.em * 0.45;
  ScenePart vertex, edge;
  Nearest nearest_vertex, nearest_edge;
  for (const EdgeEnds& ends : edges_of(scene)) {
    const glm::dvec3 from = room.polygons().points[ends.first], to = room.polygons().points[ends.second];
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

std::int32_t piece_shown(const Moment& now) {
  if (now.event()) {
    const Event& e = now.event()->event;
    if (const auto* side = get_if<SideTest>(&e)) return side->piece;
    if (const auto* made = get_if<PieceMake>(&e)) return made->piece;
    if (const auto* node = get_if<NodeMake>(&e)) return node->piece;
    if (const auto* add = get_if<NodeAdd>(&e)) return add->piece;
    if (const auto* candidate = get_if<RootCandidate>(&e)) return candidate->piece;
  }
  return now.state().machine.piece;
}

void draw_pieces(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin) {
  const MethodState& m = now.state().machine;
  const auto outline = [&](const Piece& piece, double thickness, ImU32 color) {
    for (std::size_t k = 0; k < piece.outline.size(); ++k) {
      const auto a = on_raster(now.scene(), now.state(), piece.outline[k]);
      const auto b = on_raster(now.scene(), now.state(), piece.outline[(k + 1) % piece.outline.size()]);
      if (a && b)
        canvas.line(map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y), thickness * thin, to_pixel(color));
    }
  };
  if (m.list.empty()) return;
  for (const Piece& piece : m.pieces)
    if (piece.parent >= 0 && !piece.cut) outline(piece, 1.2, c.text);
  if (!m.pair) return;
  for (const auto& [number, color] : {std::pair{m.pair->other, c.selected}, {m.pair->piece, c.now}})
    if (number >= 0 && number < std::ssize(m.pieces)) outline(m.pieces[number], 2.8, color);
}

TakenPlaces label_pair(Ui& ui, const RasterMap& map, ImVec2 origin) {
  TakenPlaces taken;
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const Theme& c = ui.colors();
  if (!m.pair || m.list.empty()) return taken;
  WordPlaces words(ui, origin, moved_by(origin, map.box_width, map.box_height));
  const auto outline_of = [&](const Piece& piece) {
    std::vector<ImVec2> outline;
    for (const std::int32_t vertex : piece.outline)
      if (const auto corner = on_raster(s.scene(), s.state(), vertex))
        outline.push_back(moved_by(origin, map.px(corner->x), map.py(corner->y)));
    return outline;
  };
  for (const std::int32_t number : {m.pair->other, m.pair->piece}) {
    const auto outline =
        number >= 0 && number < std::ssize(m.pieces) ? outline_of(m.pieces[number]) : std::vector<ImVec2>();
    for (std::size_t k = 0; k < outline.size(); ++k)
      words.keep_line_free(outline[k], outline[(k + 1) % outline.size()]);
  }
  for (const auto& [number, letter] : {std::pair{m.pair->other, "Q"}, {m.pair->piece, "P"}}) {
    if (number < 0 || number >= std::ssize(m.pieces)) continue;
    const std::vector<ImVec2> outline = outline_of(m.pieces[number]);
    glm::dvec2 middle(0);
    for (const ImVec2 corner : outline) middle += glm::dvec2(corner.x, corner.y) / static_cast<double>(outline.size());
    for (const ImVec2 corner : outline)
      if (words.around(letter, c.text, ui.fonts.bold, corner, {corner.x - middle.x, corner.y - middle.y})) break;
  }
  taken = std::move(words.taken);
  const auto* overlap = s.event() ? get_if<OverlapTest>(&s.event()->event) : nullptr;
  if (!overlap || !overlap->overlap) return taken;
  const ImVec2 at = moved_by(origin, map.px(overlap->x_at), map.py(overlap->y_at));
  const float arm = std::max(6.0f, ui.em * 0.4f);
  for (const float side : {-arm, arm})
    stroke_line(ImGui::GetWindowDrawList(), {at.x - arm, at.y - side}, {at.x + arm, at.y + side}, c.text, 3 * ui.thin);
  taken.take({at.x - arm, at.y - arm}, {2 * arm, 2 * arm});
  return taken;
}

namespace {

/// What the lesson's stop is about, and the eye that looks at it.
void come_close(Room& room, const Stop& stop) {
  std::vector<glm::dvec3> marks;
  if (room.has_eye()) marks.push_back(room.camera().eye);
  if (const auto& w = stop.window; w && room.has_eye()) {
    const double more = w->far > 0 ? w->far / w->distance : 1;
    for (const glm::dvec3& corner :
         room.rectangle_in_view(w->left * more, w->right * more, w->bottom * more, w->top * more, w->distance * more))
      marks.push_back(corner);
    return room.show_only(std::move(marks));
  }
  for (const auto& way : ways_of_eye(room.camera(), stop.orders)) room.show(way);
  if (stop.close.empty()) return;
  for (const Facet& facet : room.polygons().facets)
    for (std::int32_t k = 0; k < facet.corner_count && *room.polygons().polygons[facet.polygon].name == stop.close; ++k)
      marks.push_back(room.polygons().points[room.polygons().corners[facet.first_corner + k]]);
  room.show_only(std::move(marks));
}

void see_room(OutsideSeen& seen, const Kept<Room>& room, const Look& look, const glm::dvec2& size) {
  const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
  see_polygons(Outside(room.made, look, width, height), room.made.polygons(), seen.polygons);
  find_label_spots(seen.letters, RasterMap({width, height, false}, {}, width, height), seen.polygons);
}

void paint_outside(ChartPicture& picture, const Kept<OutsideSeen>& kept, const Kept<Room>& kept_room, const Look& look,
                   const Moment& now, const std::optional<Cell>& cell, const int& viewing, const double& arrived,
                   const bool& canonical, const Theme& c, const float& thin) {
  const Room& room = kept_room.made;
  const Picture& seen = kept.made.polygons;
  const Outside outside(room, look, seen.width, seen.height);
  picture.words.clear();
  const std::int32_t at_work = now.at_rest() ? no_polygon : now.state().machine.polygon;
  const bool of_window = now.told() && now.told()->window;
  const bool wires = records<LineBegin>(now.header());  // of methods that draw lines: every edge, and no polygon
  const Pixel32 paper = to_pixel(c.pane);
  std::vector<Pixel32> colors;
  for (const Polygon& polygon : room.polygons().polygons) {
    const Pixel32 own = opaque(polygon.color);
    const bool pale = at_work != no_polygon && at_work != size32(colors);
    colors.push_back(wires ? paper : of_window ? mixed(paper, own, 60) : pale ? mixed(paper, own, 190) : own);
  }
  const bool blends = records<ColorBlend>(now.header()) || records<ColorWrite>(now.header());  // so that glass matters
  if (wires || !blends || !paint_with_glass(picture.canvas, outside, room.polygons(), colors, paper))
    paint_polygons(picture.canvas, seen, colors, paper);
  Picture nothing_hides;
  if (wires || of_window)
    nothing_hides = seen, std::fill(nothing_hides.depth.begin(), nothing_hides.depth.end(), HUGE_VAL);
  RoomPen pen(picture, wires || of_window ? nothing_hides : seen, room, outside, c, thin);
  if (canonical) return draw_canonical(pen, now);
  draw_in_space(pen, now, cell, viewing, arrived);
}

/// As many decimals as a hundredth of the scene has.
double rounded(double value, double size) {
  const double unit = portable::pow(10, std::floor(portable::log10(std::max(size, 1e-300) / 100)));
  return std::round(value / unit) * unit;
}

/// Vertices with a handle each, by which they are pulled across what the reader sees. True while one is held, or the
/// mouse lies on one.
bool pull_vertices(Ui& ui, const Room& room, ImVec2 size, ImVec2 at) {
  const Scene& scene = ui.session.scene();
  if (!ui.changes || !can_pull_vertices(scene)) return false;
  const Outside outside(room, ui.look, static_cast<int>(size.x), static_cast<int>(size.y));
  const ImGuiIO& io = ImGui::GetIO();
  const Theme& c = ui.colors();
  const float half = std::round(ui.em * 0.28f), reach = ui.em * 0.7f;
  std::optional<std::int32_t> nearest;
  float least = reach * reach;
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    const auto spot = outside.spot(room.place(scene.points[k]));
    if (!spot || spot->x < 0 || spot->y < 0 || spot->x > size.x || spot->y > size.y) continue;
    const ImVec2 middle = on_screen(*spot, at);
    const float x = io.MousePos.x - middle.x, y = io.MousePos.y - middle.y, away = x * x + y * y;
    if (away < least) least = away, nearest = index32(k);
    const bool held = ui.taken && ui.taken->vertex == index32(k);
    const ImVec2 low{middle.x - half, middle.y - half}, high{middle.x + half, middle.y + half};
    ImGui::GetWindowDrawList()->AddRectFilled(low, high, held ? c.selected : c.pane);
    frame_box(ui, low, high, held ? c.text : c.selected, 2);
  }
  const bool over = ImGui::IsItemHovered() && nearest;
  if (over && !ui.taken) {
    ui.mouse_help = fmt::format("Drag: moves vertex {}.", *nearest);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) ui.taken = Taken{*nearest, room.place(scene.points[*nearest])};
  }
  if (!ui.taken) return over;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    ui.taken.reset();
    return true;
  }
  Taken& taken = *ui.taken;
  if (io.MouseDelta.x == 0 && io.MouseDelta.y == 0) return true;
  taken.place = outside.pulled(taken.place, io.MouseDelta.x, io.MouseDelta.y);
  const glm::dvec3 point = room.point_at(taken.place);
  for (int axis = 0; axis < 3; ++axis) taken.point[axis] = rounded(point[axis], room.size());
  ui.moved_vertex = taken.point != scene.points[taken.vertex];
  return true;
}

void tell_what_is_pointed_at(Ui& ui, const Picture& seen, ImVec2 at) {
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const int x = static_cast<int>(mouse.x - at.x), y = static_cast<int>(mouse.y - at.y);
  if (x < 0 || y < 0 || x >= seen.width || y >= seen.height) return;
  const std::int32_t polygon = seen.polygon[seen.at(x, y)];
  if (polygon == no_polygon) return;
  const Scene& scene = ui.session.scene();
  const Polygon& told = scene.polygons[polygon];
  std::vector<std::string> lines{"polygon " + polygon_label(scene, polygon)};
  if (told.source_line > 0) lines.push_back(fmt::format("line {} of {}", told.source_line, scene.source));
  tooltip(ui, lines);
  if (ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) ui.here = lines_of_polygon(ui.session, polygon);
}

}  // namespace

void write_words(Ui& ui, const OutsideSeen& seen, const ChartPicture& picture, ImVec2 at) {
  TakenPlaces taken;
  const auto write = [&](ImVec2 middle, const ImFont* font, ImU32 color, const std::string& text, bool on_polygon) {
    const ImVec2 size = label_size(ui, font, text);
    const float width = to_float(picture.canvas.width()), height = to_float(picture.canvas.height());
    if (size.x + 4 > width || size.y + 2 > height) return;
    // On the right of a point, or else on its left, above or below it.
    std::vector<ImVec2> places{{-size.x / 2, -size.y / 2}};
    if (!on_polygon)
      places = {{6, -size.y / 2}, {-size.x - 6, -size.y / 2}, {-size.x / 2, -size.y - 6}, {-size.x / 2, 6}};
    for (const ImVec2 place : places) {
      const float left = std::clamp(middle.x + place.x, 2.0f, width - size.x - 2);
      const float top = std::clamp(middle.y + place.y, 0.0f, height - size.y);
      const ImVec2 low{at.x + left - 2, at.y + top}, extent{size.x + 4, size.y + std::round(2 * ui.thin)};  // for x_v
      if (!taken.free(low, extent)) continue;
      taken.take(low, extent);
      ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + extent.x, low.y + extent.y}, ui.colors().pane);
      return draw_label(ui, {at.x + left, at.y + top}, font, color, text);
    }
  };
  for (const ChartPicture::Word& word : picture.words)
    if (word.first) write(word.at, ui.fonts.bold, word.color, word.text, false);
  const Scene& scene = ui.session.scene();
  const bool curves = scene.surface && records<HorizonTest>(ui.session.header());  // no polygons
  const auto write_letters = [&] {
    int letters = curves ? 26 : 0;
    for (const LabelSpot& spot : seen.letters)
      if (to_float(spot.pixels) > 1.5f * ui.em * ui.em && ++letters <= 26)
        write({to_float(spot.cell.x), to_float(spot.cell.y)}, ui.fonts.bold, ui.colors().text,
              polygon_label(scene, spot.polygon), true);
  };
  const bool axes_matter = viewing_step(ui) > 0;
  const Stop* const told = ui.moment().told();
  if (!axes_matter && !(told && told->window)) write_letters();
  if (to_float(picture.canvas.width()) >= 15 * ui.em)  // else letters alone
    for (const ChartPicture::Word& word : picture.words)
      if (!word.first) write(word.at, ui.fonts.small, word.color, word.text, false);
  if (axes_matter) write_letters();
}

void walk_round(Ui& ui, Look& look, ImVec2 size, const char* help) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered()) {
    ui.mouse_help = help;
    if (io.MouseWheel != 0) look.zoom = std::clamp(look.zoom * portable::pow(1.25, io.MouseWheel), 0.3, 40.0);
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
}

bool seen_from_outside(const Ui& ui) {
  const Session& s = ui.session;
  constexpr std::size_t many_corners = 400'000;
  return ui.from_outside.value_or(!records<ListInsert>(s.header()) && s.scene().corners.size() <= many_corners);
}

bool can_pull_vertices(const Scene& scene) {
  constexpr std::size_t most_handles = 200;
  return !scene.surface && scene.points.size() <= most_handles;
}

void draw_outside(Ui& ui, ImVec2 size, bool canonical) {
  const auto make_room = [](Room& room, const Scene& scene, const bool& by_lamp, const bool& viewing,
                            const Stop* const& about, const bool& in_cube) {
    room = in_cube ? Room(in_canonical_volume(scene)) : Room(scene, by_lamp);
    if (in_cube)
      return room.show_only({{-1, -1, -1},
                             {1, -1, -1},
                             {1, 1, -1},
                             {-1, 1, -1},
                             {-1, -1, 1},
                             {1, -1, 1},
                             {1, 1, 1},
                             {-1, 1, 1},
                             {1.25, 0, 0},
                             {0, 1.25, 0},
                             {0, 0, 1.25}});
    if (viewing) room.show(ends_of_viewing_axes(room, scene.camera));
    if (about) come_close(room, *about);
  };
  const bool by_lamp = ui.session.state().machine.pass == Pass::light;
  const Stop* const told = ui.moment().told();
  const Stop* const about = told && (told->window || !told->close.empty() || !told->orders.empty()) ? told : nullptr;
  const char* const name = canonical ? "canonical" : "outside";
  const Kept<Room>& room =
      *keep<Room>(ui.rooms, name, +make_room, ui.session.scene(), by_lamp, viewing_step(ui) > 0, about, canonical);
  const glm::dvec2 whole{std::floor(size.x), std::floor(size.y)};
  const Kept<OutsideSeen>& seen = *keep<OutsideSeen>(ui.seen_from_outside, name, see_room, room, ui.look, whole);
  const ChartPicture& picture = keep<ChartPicture>(ui.charts, name, paint_outside, seen, room, ui.look, ui.moment(),
                                                   ui.session.cell_looked_at(ui.still), viewing_step(ui),
                                                   ui.axes_turn ? ui.on_way() : 1.0, canonical, ui.colors(), ui.thin)
                                    ->made;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("outside", size);
  can_be_hit(ui, at, {at.x + size.x, at.y + size.y});
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(picture.canvas), at, moved_by(at, whole.x, whole.y));
  write_words(ui, seen.made, picture, at);
  if (!canonical && pull_vertices(ui, room.made, size, at)) return;
  walk_round(ui, ui.look, size,
             "Drag: walk round. Shift+drag: move. Wheel: nearer. Double click: back. Shift+V: through the eye.");
  if (canonical || !pick_parts(ui, room.made, seen.made.polygons, size, at))
    tell_what_is_pointed_at(ui, seen.made.polygons, at);
}

}  // namespace zstep::viewer
