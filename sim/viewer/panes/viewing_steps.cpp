
#include "sim/viewer/panes/viewing_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "algorithms/viewing/camera.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/panes/typeset.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {

std::int32_t vertex_at_work(const RecordedEvent* event) {
  if (event) {
    const Event& e = event->event;
    if (const auto* v = get_if<ViewTransform>(&e)) return v->vertex;
    if (const auto* v = get_if<Projection>(&e)) return v->vertex;
    if (const auto* v = get_if<ViewportTransform>(&e)) return v->vertex;
    if (const auto* v = get_if<ClipVertex>(&e)) return v->vertex;
    if (const auto* v = get_if<ClipCross>(&e)) return v->vertex;
    if (const auto* v = get_if<OutlineVertex>(&e)) return v->vertex;
    if (const auto* v = get_if<VertexSide>(&e)) return v->vertex;
    if (const auto* v = get_if<SplitVertex>(&e)) return v->vertex;
  }
  return -1;
}

std::vector<std::int32_t> vertices_shown(const Session& s) {
  const MethodState& m = s.state().machine;
  const std::int32_t now = vertex_at_work(s.event());
  std::vector<std::int32_t> shown;
  if (m.facet >= 0 && m.facet < std::ssize(s.scene().facets)) {
    const Facet& facet = s.scene().facets[m.facet];
    for (std::int32_t k = 0; k < facet.corner_count; ++k) shown.push_back(s.scene().corners[facet.first_corner + k]);
    for (const std::int32_t v : m.outline)
      if (std::find(shown.begin(), shown.end(), v) == shown.end()) shown.push_back(v);
  }
  for (const std::int32_t other : {s.picked_part.vertex.value_or(-1), now})
    if (other >= 0 && std::find(shown.begin(), shown.end(), other) == shown.end()) shown.insert(shown.begin(), other);
  return shown;
}

StageLayout lay_out_stages(const Ui& ui, const std::vector<StageRow>& rows, float room) {
  std::vector<double> values;
  for (const StageRow& row : rows)
    for (int k = 0; k < (row.flat ? 2 : 3); ++k) values.push_back((*row.at)[k]);
  StageLayout how{ui.fonts.mono, 3, 0, 0, 0};
  for (const double v : values)  // as formulas and texts write them, in one column
    while (how.decimals < usual_decimals && number(v, how.decimals, true) != number(v)) ++how.decimals;
  for (const auto& [font, across] :
       {std::pair{ui.fonts.mono, 3}, {ui.fonts.small, 3}, {ui.fonts.mono, 1}, {ui.fonts.small, 1}}) {
    how.font = font, how.across = across, how.column = 0;
    how.name = text_size(ui, font, "screen ").x;
    for (const double v : values) how.column = std::max(how.column, text_size(ui, font, number(v, how.decimals)).x);
    how.column += ui.em * (across == 1 ? 0.2f : 0.6f);
    if (how.name + to_float(across) * how.column + ui.em * 0.4f <= room) break;
  }
  return how;
}

namespace {

/// The stages of one vertex as aligned lines.
void draw_stages(Ui& ui, std::int32_t vertex, bool now) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const std::size_t at = vertex;
  const VertexStages* way = at < s.state().vertices.size() ? &s.state().vertices[at] : nullptr;
  std::vector<StageRow> rows;
  const bool screen = s.scene().camera.kind == Camera::Kind::screen;
  if (at < s.scene().points.size()) rows.push_back({screen ? "screen" : "world", s.scene().points[at], false, "_w"});
  if (screen && way && at >= s.scene().points.size())
    rows.push_back({"screen", glm::dvec3(way->raster, way->plane.z), false, "_s"});
  else if (!s.state().machine.tree.empty() && way && way->world != glm::dvec3(0))
    rows.push_back({"world", way->world, false, "_w"});
  if (!screen && way) {
    if (way->stage >= VertexStages::viewed) rows.push_back({"view", way->view, false, "_v"});
    if (way->stage >= VertexStages::projected) rows.push_back({"plane", way->plane, false, "_p"});
    if (way->stage >= VertexStages::on_raster) rows.push_back({"screen", glm::dvec3(way->raster, 0), true, "_s"});
  }
  const StageLayout how = lay_out_stages(ui, rows, ImGui::GetContentRegionAvail().x);
  const ImFont* font = how.font;
  const float height = std::round(font->FontSize * 1.3f), title = std::round(ui.fonts.mono->FontSize * 1.3f);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto lines_of = [&](const StageRow& row) { return how.across == 1 && !row.flat ? 3 : how.across == 1 ? 2 : 1; };
  int lines = 0;
  for (const StageRow& row : rows) lines += lines_of(row);
  const float block = title + height * to_float(lines);
  if (now) {
    list->AddRectFilled(top, {top.x + ImGui::GetContentRegionAvail().x, top.y + block}, c.now_soft);
    list->AddRectFilled(top, {top.x + std::round(3 * ui.thin), top.y + block}, c.now);
  }
  if (const ScenePart lit = s.lit_part();
      lit.vertex == vertex || (lit.edge && (lit.edge->first == vertex || lit.edge->second == vertex)))
    frame_box(ui, top, {top.x + ImGui::GetContentRegionAvail().x, top.y + block}, c.selected, 2);
  const float x = top.x + ui.em * 0.4f;
  draw_text(ui, {x, top.y + 1}, ui.fonts.bold, now ? c.now : c.text, fmt::format("vertex {}", vertex));
  std::vector<std::string> tips;
  std::string under_mouse;  // the number there without rounding
  float y = top.y + title;
  for (const StageRow& row : rows) {
    draw_text(ui, {x, y}, font, c.muted, row.stage);
    for (int k = 0; k < (row.flat ? 2 : 3); ++k) {
      const std::string text = number((*row.at)[k], how.decimals);
      const ImVec2 right{x + how.name + how.column * to_float(how.across == 1 ? 1 : k + 1),
                         y + (how.across == 1 ? height * to_float(k) : 0.0f)};
      const float width = text_size(ui, font, text).x;
      draw_text(ui, {right.x - width, right.y}, font, c.text, text);
      if (!row.field.empty()) {
        const answers::Question question =
            answers::of_vertex(s.position(), vertex, k == 2 && row.field == "_p" ? "z" : "xyz"[k] + row.field);
        if (number_at(ui, {right.x - width - 2, right.y}, {right.x + 2, right.y + height}, question))
          under_mouse = exact_line(s.trace(), question);
      }
      tips.push_back(fmt::format("{} {} = {}", row.stage, "xyz"[k], exact((*row.at)[k])));
    }
    y += height * to_float(lines_of(row));
  }
  ImGui::Dummy({std::max(1.0f, how.name + to_float(how.across) * how.column + ui.em * 0.4f), block});
  if (!under_mouse.empty()) tips.push_back(under_mouse);
  if (ImGui::IsItemHovered()) tooltip(ui, tips);
  if (now) follow(ui, top.y, block);
}

}  // namespace

void draw_vertex_stages(Ui& ui) {
  const std::int32_t now = vertex_at_work(ui.session.event());
  for (const std::int32_t vertex : vertices_shown(ui.session)) draw_stages(ui, vertex, vertex == now);
}

namespace {

using Factors = std::array<glm::dmat4, 4>;

struct Told {
  const char* does;
  Entries symbols;
};
/// What each does to the axes, {} the angle that it turns them by, and how it is written.
const Told& told(int step) {
  static const std::array<Told, 4> all{
      Told{"T\u2081 moves the origin to the eye e. The axes stay parallel to the world's.",
           {{"1", "0", "0", "\u2212e_x"},
            {"0", "1", "0", "\u2212e_y"},
            {"0", "0", "1", "\u2212e_z"},
            {"0", "0", "0", "1"}}},
      Told{"T\u2082 turns the axes about z by \u03b8 \u2212 90\u00b0 = {}\u00b0. Then x lies level, across the line of "
           "sight.",
           {{"sin \u03b8", "\u2212cos \u03b8", "0", "0"},
            {"cos \u03b8", "sin \u03b8", "0", "0"},
            {"0", "0", "1", "0"},
            {"0", "0", "0", "1"}}},
      Told{"T\u2083 turns the axes about x by 180\u00b0 \u2212 \u03c6 = {}\u00b0. Then z lies along the line of sight, "
           "away "
           "from the eye.",
           {{"1", "0", "0", "0"},
            {"0", "\u2212cos \u03c6", "sin \u03c6", "0"},
            {"0", "\u2212sin \u03c6", "\u2212cos \u03c6", "0"},
            {"0", "0", "0", "1"}}},
      Told{"T\u2084 reverses the x axis. Then x_v points to the right of the picture, and the axes are left-handed.",
           {{"\u22121", "0", "0", "0"}, {"0", "1", "0", "0"}, {"0", "0", "1", "0"}, {"0", "0", "0", "1"}}}};
  return all[step - 1];
}

/// By how many degrees it turns the axes: as far as the matrix turns points, the other way round.
double turned(const glm::dmat4& t, int step) {
  const glm::dvec2 to = step == 2 ? glm::dvec2(t[0][0], t[0][1]) : glm::dvec2(t[1][1], t[1][2]);
  return 0.0 - glm::degrees(portable::atan2(to.y, to.x));
}

/// How coordinates are called after so many of the four: x_w, x_1, …, x_v.
std::string name_of(char axis, int step) { return fmt::format("{}_{}", axis, "w123v"[step]); }

/// World to the coordinates after so many.
glm::dmat4 product(const Factors& factors, int count) {
  glm::dmat4 all(1);
  for (int k = 0; k < count; ++k) all = factors[k] * all;
  return all;
}

/// What is but rounding beside the others is 0.
std::string entry(double value, double greatest) {
  return number(std::abs(value) < 1e-13 * greatest ? 0.0 : value + 0.0);
}

Entries numbers_of(const glm::dmat4& matrix) {
  double greatest = 0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) greatest = std::max(greatest, std::abs(matrix[column][row]));
  Entries rows(4, std::vector<std::string>(4));
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) rows[row][column] = entry(matrix[column][row], greatest);
  return rows;
}

Entries column_of(const glm::dvec4& point) {
  Entries rows;
  for (int k = 0; k < 4; ++k) rows.push_back({entry(point[k], glm::length(point))});
  return rows;
}

glm::dvec3 end_of_axis(const glm::dmat4& axes, int axis, const Room& room) {
  return glm::dvec3(axes[3] + 0.4 * room.size() * axes[axis]);
}

Entries names_of(int step) { return {{name_of('x', step)}, {name_of('y', step)}, {name_of('z', step)}, {"1"}}; }

/// A word, or a matrix where there are rows.
struct Piece {
  std::string word;
  Entries rows{};
};
/// "T_1 = [..] = [..]", which is not broken.
using Pieces = std::vector<Piece>;

float width_of(const Ui& ui, const Pieces& pieces, bool small) {
  float width = 0;
  for (const Piece& piece : pieces)
    width += std::round(ui.em * 0.4f) +
             (piece.rows.empty() ? label_size(ui, ui.fonts.text, piece.word).x : matrix_size(ui, piece.rows, small).x);
  return width;
}

/// Formulas side by side where there is room, else below each other.
void set_formulas(Ui& ui, const std::vector<Pieces>& formulas, float room) {
  bool small = false;
  for (const Pieces& pieces : formulas) small = small || width_of(ui, pieces, false) > room;
  const float tall = matrix_size(ui, names_of(0), small).y, below = std::round(ui.em * 0.4f);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImVec2 at = from;
  for (const Pieces& pieces : formulas) {
    if (at.x > from.x && at.x + ui.em * 1.2f + width_of(ui, pieces, small) > from.x + room)
      at = {from.x, at.y + tall + below};
    else if (at.x > from.x) at.x += std::round(ui.em * 1.2f);
    for (const Piece& piece : pieces) {
      if (piece.rows.empty())
        draw_label(ui, {at.x, at.y + std::round((tall - ui.em) / 2)}, ui.fonts.text, ui.colors().text, piece.word);
      else set_matrix(ui, at, piece.rows, small);
      at.x += width_of(ui, {piece}, small);
    }
  }
  ImGui::Dummy({std::max(1.0f, room), at.y + tall + below - from.y});
}

}  // namespace

bool has_viewing_steps(const Scene& scene) { return viewing::view_factors(scene.camera).has_value(); }

int viewing_step(const Ui& ui) {
  const Session& s = ui.session;
  const int at = s.stop();
  const int told = s.lesson() && at >= 0 ? s.lesson()->stops[at].viewing_step : 0;
  if (ui.chosen_viewing && (ui.chosen_viewing->stop == at || !s.lesson())) return ui.chosen_viewing->step;
  return has_viewing_steps(s.scene()) ? told : 0;
}

void choose_viewing_step(Ui& ui, int step) { ui.chosen_viewing = {step, ui.session.stop()}; }

std::vector<glm::dvec3> ends_of_viewing_axes(const Room& room, const Camera& camera) {
  std::vector<glm::dvec3> ends;
  const auto factors = viewing::view_factors(camera);
  for (int count = 0; factors && count <= 4; ++count) {
    const glm::dmat4 axes = glm::inverse(product(*factors, count));
    for (int axis = 0; axis < 3; ++axis) ends.push_back(end_of_axis(axes, axis, room));
  }
  return ends;
}

namespace {

/// What a step of viewing does when it has come so far: T_2 and T_3 turn, about z and about x, by a part of their
/// angle.
glm::dmat4 partly_turned(const glm::dmat4& whole, int step, double share) {
  const int a = step - 2, b = step - 1;
  const double angle = share * portable::atan2(whole[a][b], whole[a][a]);
  glm::dmat4 part(1);
  part[a][a] = part[b][b] = portable::cos(angle);
  part[a][b] = portable::sin(angle), part[b][a] = -part[a][b];
  return part;
}

}  // namespace

void draw_viewing_axes(RoomPen& pen, const Camera& camera, int step, double arrived) {
  const auto factors = viewing::view_factors(camera);
  if (!factors || pen.room.by_lamp()) return;
  const Theme& c = pen.colors;
  const int first = step > 4 ? 0 : step - 1, last = std::min(step, 4);  // 5: all of them
  const glm::dmat4 before = glm::inverse(product(*factors, first)), after = glm::inverse(product(*factors, last));
  for (int axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    const glm::dvec3 was = end_of_axis(before, axis, pen.room), is = end_of_axis(after, axis, pen.room);
    const bool stays = glm::length(was - is) < 1e-9 * pen.room.size();
    glm::dvec3 now = is;
    if (arrived < 1) {
      const glm::dmat4& turn = (*factors)[first];
      const bool turns = step == 2 || step == 3;
      now = turns ? end_of_axis(glm::inverse(partly_turned(turn, step, arrived) * product(*factors, first)), axis,
                                pen.room)
                  : glm::mix(was, is, arrived);
    }
    const glm::dvec3 origin = glm::mix(glm::dvec3(before[3]), glm::dvec3(after[3]), arrived);
    const auto beyond = [](glm::dvec3 from, glm::dvec3 tip) { return tip + 0.06 * (tip - from); };
    pen.line(origin, now, c.now, 2.4);
    pen.word(beyond(origin, now), (stays ? name_of(name, first) + " = " : "") + name_of(name, last), c.now);
    if (stays) continue;
    pen.line(glm::dvec3(before[3]), was, c.text, 1.4, true);
    pen.word(beyond(glm::dvec3(before[3]), was), name_of(name, first), c.text);
  }
}

std::vector<std::vector<glm::dvec3>> ways_of_eye(const Camera& camera, const std::vector<std::vector<int>>& orders) {
  std::vector<std::vector<glm::dvec3>> ways;
  const auto factors = viewing::view_factors(camera);
  for (std::size_t k = 0; factors && k < orders.size(); ++k) {
    ways.push_back({camera.eye});
    for (std::size_t at = orders[k].size(); at-- > 0;)
      ways.back().push_back(glm::dvec3((*factors)[orders[k][at] - 1] * glm::dvec4(ways.back().back(), 1)));
  }
  return ways;
}

void draw_orders(RoomPen& pen, const Camera& camera, const std::vector<std::vector<int>>& orders) {
  if (pen.room.by_lamp()) return;
  const auto ways = ways_of_eye(camera, orders);
  for (std::size_t k = 0; k < ways.size(); ++k)
    for (std::size_t at = 1; at < ways[k].size(); ++at) {
      const glm::dvec3 to = ways[k][at];
      const ImU32 color = k == 0 ? pen.colors.selected : pen.colors.now;
      if (glm::length(to - ways[k][at - 1]) < 1e-9 * pen.room.size()) continue;
      pen.arrow(ways[k][at - 1], to, color);
      const auto text = [&](int axis) { return entry(to[axis], glm::length(camera.eye)); };
      pen.word(to, fmt::format("T_{}: ({}, {}, {})", orders[k][orders[k].size() - at], text(0), text(1), text(2)),
               color, true);
    }
}

bool draw_viewing_steps(Ui& ui) {
  const Session& s = ui.session;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (room.x < ui.em * 20 || room.y < ui.em * 16 || !seen_from_outside(ui)) return false;
  const auto factors = viewing::view_factors(s.scene().camera);
  if (!factors || s.state().machine.pass == Pass::light) return false;
  const int step = viewing_step(ui);
  const bool of_one = step >= 1 && step <= 4;
  if (!ui.laboratory && !of_one) return false;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const char* names[] = {"T\u2081", "T\u2082", "T\u2083", "T\u2084"};
  for (int k = 1; k <= 4; ++k) {
    ImGui::SetCursorScreenPos({at.x + std::round(ui.em * 2.6f) * to_float(k - 1), at.y});
    if (button(ui, names[k - 1], k == step)) choose_viewing_step(ui, k == step ? 0 : k);
    if (ImGui::IsItemHovered())
      ui.mouse_help =
          k == step ? "Click: without the steps of viewing." : "Click: this step of viewing (Shift+T: the next).";
  }
  const float line = std::round(ui.em * 1.9f);
  if (!of_one) {
    const std::string what = "Viewing, step by step";
    const float x = at.x + std::round(ui.em * 2.6f) * 4;
    if (x + text_size(ui, ui.fonts.text, what).x < at.x + room.x)
      draw_text(ui, {x, at.y + std::round(ui.em * 0.25f)}, ui.fonts.text, ui.colors().muted, what);
    ImGui::SetCursorScreenPos({at.x, at.y + line});
    return false;
  }
  ImGui::SetCursorScreenPos({at.x, at.y + line});
  const glm::dmat4& t = (*factors)[step - 1];
  flow(ui,
       step == 2 || step == 3 ? fmt::format(fmt::runtime(told(step).does), number(turned(t, step), 2, true))
                              : told(step).does,
       {.width = room.x});
  const std::string name = names[step - 1];
  std::vector<Pieces> formulas{{{name + " ="}, {"", told(step).symbols}}};
  if (step < 4) formulas[0].insert(formulas[0].end(), {{"="}, {"", numbers_of(t)}});
  const std::int32_t vertex = std::max(0, vertex_at_work(s.event()));
  if (static_cast<std::size_t>(vertex) < s.scene().points.size()) {
    const glm::dvec4 point(s.scene().points[vertex], 1);
    formulas.push_back({{fmt::format("vertex {}:", vertex)},
                        {"", names_of(step)},
                        {"= " + name},
                        {"", column_of(product(*factors, step - 1) * point)},
                        {"="},
                        {"", column_of(product(*factors, step) * point)}});
  }
  if (step == 4 && room.y > ui.em * 30)
    formulas.push_back({{"T\u2084 T\u2083 T\u2082 T\u2081 = T_v ="}, {"", numbers_of(s.scene().camera.view)}});
  set_formulas(ui, formulas, room.x);
  return true;
}

}  // namespace zstep::viewer
