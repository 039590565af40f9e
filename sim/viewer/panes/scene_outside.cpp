#include "sim/viewer/panes/scene_outside.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/panes/here_lines.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/scene_in_space.hpp"
#include "sim/viewer/panes/scene_picking.hpp"
#include "sim/viewer/panes/taken_places.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/words/explain.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
namespace {

void see_room(OutsideSeen& seen, const Kept<Room>& room, const Look& look, const glm::dvec2& size) {
  const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
  see_polygons(Outside(room.made, look, width, height), room.made.polygons(), seen.polygons);
  find_label_spots(seen.letters, RasterMap({width, height, false}, {}, width, height), seen.polygons);
}

void paint_outside(ChartPicture& picture, const Kept<OutsideSeen>& kept, const Kept<Room>& kept_room, const Look& look,
                   const Moment& now, const std::optional<Cell>& cell, const int& viewing, const Theme& c,
                   const float& thin) {
  const Room& room = kept_room.made;
  const Picture& seen = kept.made.polygons;
  const Outside outside(room, look, seen.width, seen.height);
  picture.words.clear();
  const std::int32_t at_work = now.state().machine.polygon;
  const Pixel32 paper = to_pixel(c.pane);
  std::vector<Pixel32> colors;
  for (const Polygon& polygon : room.polygons().polygons) {
    const Pixel32 own = opaque(polygon.color);
    const bool pale = at_work != no_polygon && at_work != static_cast<std::int32_t>(colors.size());
    colors.push_back(pale ? mixed(paper, own, 190) : own);
  }
  paint_polygons(picture.canvas, seen, colors, paper);
  RoomPen pen(picture, seen, room, outside, c, static_cast<double>(thin));
  draw_in_space(pen, now, cell, viewing);
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
    const ImVec2 middle{at.x + static_cast<float>(spot->x), at.y + static_cast<float>(spot->y)};
    const float x = io.MousePos.x - middle.x, y = io.MousePos.y - middle.y, away = x * x + y * y;
    if (away < least) least = away, nearest = static_cast<std::int32_t>(k);
    const bool held = ui.taken && ui.taken->vertex == static_cast<std::int32_t>(k);
    const ImVec2 low{middle.x - half, middle.y - half}, high{middle.x + half, middle.y + half};
    ImGui::GetWindowDrawList()->AddRectFilled(low, high, held ? c.selected : c.pane);
    frame_box(ui, low, high, held ? c.text : c.selected, 2);
  }
  const bool over = ImGui::IsItemHovered() && nearest;
  if (over && !ui.taken) {
    ui.mouse_help = fmt::format("Drag: moves vertex {}.", *nearest);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left))
      ui.taken = Taken{*nearest, room.place(scene.points[static_cast<std::size_t>(*nearest)])};
  }
  if (!ui.taken) return over;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    ui.taken.reset();
    return true;
  }
  Taken& taken = *ui.taken;
  if (io.MouseDelta.x == 0 && io.MouseDelta.y == 0) return true;
  taken.place = outside.pulled(taken.place, static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y));
  const glm::dvec3 point = room.point_at(taken.place);
  for (int axis = 0; axis < 3; ++axis) taken.point[axis] = rounded(point[axis], room.size());
  ui.moved_vertex = taken.point != scene.points[static_cast<std::size_t>(taken.vertex)];
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
  const Polygon& told = scene.polygons[static_cast<std::size_t>(polygon)];
  std::vector<std::string> lines{"polygon " + polygon_label(scene, polygon)};
  if (told.source_line > 0) lines.push_back(fmt::format("line {} of {}", told.source_line, scene.source));
  tooltip(ui, lines);
  if (ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) ui.here = lines_of_polygon(ui.session, polygon);
}

}  // namespace

void write_words(Ui& ui, const OutsideSeen& seen, const ChartPicture& picture, ImVec2 at) {
  TakenPlaces taken;
  const auto write = [&](ImVec2 middle, const ImFont* font, ImU32 color, const std::string& text, bool on_polygon) {
    const ImVec2 size = text_size(ui, font, text);
    const float width = static_cast<float>(picture.canvas.width()),
                height = static_cast<float>(picture.canvas.height());
    if (size.x + 4 > width || size.y + 2 > height) return;
    const float left = std::clamp(middle.x + (on_polygon ? -size.x / 2 : 6), 2.0f, width - size.x - 2);
    const float top = std::clamp(middle.y - size.y / 2, 0.0f, height - size.y);
    const ImVec2 low{at.x + left - 2, at.y + top}, extent{size.x + 4, size.y + std::round(2 * ui.thin)};  // for x_v
    if (!taken.free(low, extent)) return;
    taken.take(low, extent);
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + extent.x, low.y + extent.y}, ui.colors().pane);
    draw_text(ui, {at.x + left, at.y + top}, font, color, text);
  };
  const Scene& scene = ui.session.scene();
  const auto write_letters = [&] {
    int letters = 0;
    for (const LabelSpot& spot : seen.letters)
      if (static_cast<float>(spot.pixels) > 1.5f * ui.em * ui.em && ++letters <= 26)
        write({static_cast<float>(spot.cell.x), static_cast<float>(spot.cell.y)}, ui.fonts.bold, ui.colors().text,
              polygon_label(scene, spot.polygon), true);
  };
  const bool axes_matter = viewing_step(ui) > 0;
  if (!axes_matter) write_letters();
  if (static_cast<float>(picture.canvas.width()) >= 15 * ui.em)  // else letters alone
    for (const ChartPicture::Word& word : picture.words) write(word.at, ui.fonts.small, word.color, word.text, false);
  if (axes_matter) write_letters();
}

void walk_round(Ui& ui, Look& look, ImVec2 size, const char* help) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered()) {
    ui.mouse_help = help;
    if (io.MouseWheel != 0)
      look.zoom = std::clamp(look.zoom * portable::pow(1.25, static_cast<double>(io.MouseWheel)), 0.3, 40.0);
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
  return ui.from_outside.value_or(!has_step_of<ListInsert>(s.header()) && s.scene().corners.size() <= many_corners);
}

bool can_pull_vertices(const Scene& scene) {
  constexpr std::size_t most_handles = 200;
  return !scene.surface && scene.points.size() <= most_handles;
}

void draw_outside(Ui& ui, ImVec2 size) {
  const auto make_room = [](Room& room, const Scene& scene, const bool& by_lamp, const bool& viewing) {
    room = Room(scene, by_lamp);
    if (viewing) room.show(ends_of_viewing_axes(room, scene.camera));
  };
  const bool by_lamp = ui.session.state().machine.pass == Pass::light;
  const Kept<Room>& room = *keep<Room>(ui.rooms, "room", +make_room, ui.session.scene(), by_lamp, viewing_step(ui) > 0);
  const glm::dvec2 whole{std::floor(size.x), std::floor(size.y)};
  const Kept<OutsideSeen>& seen = *keep<OutsideSeen>(ui.seen_from_outside, "seen", see_room, room, ui.look, whole);
  const ChartPicture& picture =
      keep<ChartPicture>(ui.charts, "outside", paint_outside, seen, room, ui.look, ui.moment(),
                         ui.session.current_cell(), viewing_step(ui), ui.colors(), ui.thin)
          ->made;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("outside", size);
  can_be_hit(ui, at, {at.x + size.x, at.y + size.y});
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(picture.canvas), at,
                                       {at.x + static_cast<float>(whole.x), at.y + static_cast<float>(whole.y)});
  write_words(ui, seen.made, picture, at);
  if (pull_vertices(ui, room.made, size, at)) return;
  walk_round(ui, ui.look, size,
             "Drag: walk round. Shift+drag: move. Wheel: nearer. Double click: back. Shift+V: through the eye.");
  if (!pick_parts(ui, room.made, seen.made.polygons, size, at)) tell_what_is_pointed_at(ui, seen.made.polygons, at);
}

}  // namespace zstep::viewer
