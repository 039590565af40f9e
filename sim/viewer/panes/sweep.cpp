// The scan-line method along its line: the strip of the line with its active edges, and the polygon table with flags.

#include "sim/viewer/panes/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/file/header.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

TakenPlaces SpanEnds::taken() const {
  TakenPlaces all;
  for (const Box& part : line) all.take(part.at, part.size);
  for (const Box& stroke : strokes) all.take(stroke.at, stroke.size);
  return all;
}

std::optional<SpanEnds> span_ends(const Ui& ui, const RasterMap& map, ImVec2 origin, const WidthInCell& width) {
  const auto& span = ui.session.state().machine.span;
  constexpr double least_cell = 3;
  if (!span || map.cell < least_cell || !std::isfinite(span->x_left) || !std::isfinite(span->x_right))
    return std::nullopt;
  const SpanOnRaster at = span_on_raster(map, span->x_left, span->x_right, span->y);
  SpanEnds ends{origin.x + static_cast<float>(at.left),
                origin.x + static_cast<float>(at.right),
                origin.y + static_cast<float>(at.top),
                origin.y + static_cast<float>(at.end),
                {},
                {}};
  const float thick = std::round(2 * ui.thin), cell = static_cast<float>(map.cell),
              row = std::round(origin.y + static_cast<float>(map.py(span->y)) - thick / 2);
  // Up to what stands in a pixel, and on behind it.
  float from = std::min(ends.left, ends.right);
  const float to = std::max(ends.left, ends.right);
  const auto draw_to = [&](float x) {
    if (x > from) ends.line.push_back({{from, row}, {x - from, thick}});
  };
  // Ends may lie anywhere beside the raster.
  const double begin = std::clamp((static_cast<double>(from - origin.x) - map.left) / map.cell, 0.0, 1.0 * map.width);
  for (std::int32_t x = floor_int(begin); width && x < map.width && origin.x + static_cast<float>(map.px(x - 0.5)) < to;
       ++x) {
    const float letters = width(x, span->y);
    if (letters == 0) continue;
    const float middle = origin.x + static_cast<float>(map.px(x)), half = letters / 2 + 2 * ui.thin;
    draw_to(std::min(to, middle - half));
    from = std::max(from, middle + half);
  }
  draw_to(to);
  const float reach = std::clamp((cell - 1.2f * ui.fonts.bold->FontSize) / 2, std::min(thick, cell / 2), cell / 2);
  std::size_t made = 0;
  for (const float x : {ends.left, ends.right})
    for (const float y : {ends.top, ends.end - reach})
      ends.strokes[made++] = {{std::round(x - thick / 2), y}, {thick, reach}};
  return ends;
}

void draw_span_ends(const Ui& ui, const SpanEnds& ends) {
  const Theme& c = ui.colors();
  const auto fill = [&](const SpanEnds::Box& box, float around, ImU32 color) {
    ImGui::GetWindowDrawList()->AddRectFilled({box.at.x - around, box.at.y},
                                              {box.at.x + box.size.x + around, box.at.y + box.size.y}, color);
  };
  for (const SpanEnds::Box& part : ends.line) fill(part, 0, c.now);
  for (const SpanEnds::Box& stroke : ends.strokes) fill(stroke, std::round(ui.thin), c.pane), fill(stroke, 0, c.now);
}

namespace {

constexpr std::size_t whole_table = 40;  // rows; of longer tables those are shown whose flag is in

ImU32 color_of(const Scene& scene, std::int32_t polygon, ImU32 otherwise) {
  const std::size_t at = polygon;
  return polygon >= 0 && at < scene.polygons.size() ? to_im(opaque(scene.polygons[at].color)) : otherwise;
}

/// The rows of the polygon table that the event is about.
std::vector<std::int32_t> pieces_now(const RecordedEvent* event) {
  if (!event) return {};
  if (const auto* e = get_if<PlaneEquation>(&event->event)) return {e->piece};
  if (const auto* e = get_if<FlagFlip>(&event->event)) return {e->piece};
  if (const auto* e = get_if<PlaneDepth>(&event->event)) return {e->piece};
  if (const auto* e = get_if<SpanWinner>(&event->event)) return {e->piece};
  if (const auto* e = get_if<ImpliedEdge>(&event->event)) return {e->piece, e->other};
  if (const auto* e = get_if<SideTest>(&event->event)) return {e->piece, e->plane_of};
  return {};
}

std::string names_inside(const Session& s) {
  const MethodState& m = s.state().machine;
  std::string names;
  for (const std::int32_t piece : m.sweep.inside)
    names += (names.empty() ? "" : ", ") + piece_label(s.scene(), m, piece);
  return names.empty() ? "none" : names;
}

/// What the strip says below itself.
std::string caption(const Session& s) {
  const MethodState& m = s.state().machine;
  if (s.event() && holds<FlagFlip>(s.event()->event)) return "in: " + names_inside(s);
  if (!m.sweep.interval) return "";
  const SpanFlags& interval = *m.sweep.interval;
  return fmt::format("x = {} to {}, in: {}", number(interval.x_left), number(interval.x_right), names_inside(s));
}

struct ScanLineStrip {
  ImVec2 at, end;
  double columns;
  float x(double column) const {
    const double share = (std::clamp(column, -0.5, columns - 0.5) + 0.5) / columns;
    return std::round(at.x + (end.x - at.x) * static_cast<float>(share));
  }
};

/// The pixels of the line as the frame has them by now.
void draw_cells(const Session& s, ImDrawList* list, const ScanLineStrip& strip, std::int32_t y, const Theme& c) {
  const Picture& picture = s.state().picture;
  list->AddRectFilled(strip.at, strip.end, c.head);
  if (y < 0 || y >= picture.height) return;
  for (std::int32_t x = 0; x < picture.width;) {
    const auto color = [&](std::int32_t column) {
      return color_of(s.scene(), picture.polygon[picture.at(column, y)], c.head);
    };
    std::int32_t end = x + 1;
    while (end < picture.width && color(end) == color(x)) ++end;
    list->AddRectFilled({strip.x(x - 0.5), strip.at.y}, {strip.x(end - 0.5), strip.end.y}, color(x));
    x = end;
  }
  const float cell = (strip.end.x - strip.at.x) / static_cast<float>(strip.columns);
  for (std::int32_t x = 1; x < picture.width && cell >= 6; ++x)
    list->AddRectFilled({strip.x(x - 0.5), strip.at.y}, {strip.x(x - 0.5) + 1, strip.end.y}, c.grid);
}

/// Active edges as ticks with their names above; implied ones by a cross.
void draw_crossings(Ui& ui, ImDrawList* list, const ScanLineStrip& strip) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const Theme& c = ui.colors();
  float free_from = strip.at.x - ui.em;
  const auto tick = [&](double column, const std::string& name, ImU32 color, float weight) {
    if (column < -0.5 || column > strip.columns - 0.5) return;
    const float x = strip.x(column), width = text_size(ui, ui.fonts.small, name).x;
    list->AddRectFilled({x - weight / 2, strip.at.y - 3}, {x + (weight + 1) / 2, strip.end.y + 3}, color);
    // A name may give way to the one before it, but not so far that it seems another edge's.
    const float wanted = std::clamp(x - width / 2, strip.at.x, std::max(strip.at.x, strip.end.x - width)),
                left = std::max(wanted, free_from);
    if (left - wanted > width * 0.75f || left + width > strip.end.x) return;
    draw_text(ui, {left, strip.at.y - ui.fonts.small->FontSize - 5}, ui.fonts.small, color, name);
    free_from = left + width + 4;
  };
  const auto flip = s.event() ? get_if<FlagFlip>(&s.event()->event) : nullptr;
  for (const ActiveEdge& edge : m.active) {
    const std::size_t at = edge.edge;
    if (at >= m.edge_table.size()) continue;
    const bool now = flip && flip->edge == edge.edge, lit = s.lit_edge() == edge.edge;
    tick(edge.x, edge_label(s.scene(), m.edge_table[at]),
         now   ? c.now
         : lit ? c.selected
               : c.text,
         (now || lit ? 3.0f : 1.0f) * ui.thin);
  }
  for (const ImpliedEdge& implied : m.sweep.implied) {
    const float x = strip.x(implied.x_at), y = (strip.at.y + strip.end.y) / 2, half = ui.em * 0.3f;
    stroke_line(list, {x - half, y - half}, {x + half, y + half}, c.text, 2 * ui.thin);
    stroke_line(list, {x - half, y + half}, {x + half, y - half}, c.text, 2 * ui.thin);
  }
}

void draw_strip(Ui& ui, std::int32_t y) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const MethodState& m = s.state().machine;
  const float names = ui.fonts.small->FontSize + 6, bar = std::round(ui.em * 1.1f),
              width = ImGui::GetContentRegionAvail().x;
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const ScanLineStrip strip{{top.x + 2, top.y + names},
                            {top.x + width - 2, top.y + names + bar},
                            std::max<double>(1, s.scene().raster.width)};
  ImDrawList* list = ImGui::GetWindowDrawList();
  draw_cells(s, list, strip, y, c);
  frame_box(ui, strip.at, strip.end, c.rule);
  draw_crossings(ui, list, strip);
  if (m.sweep.interval) {
    const float left = strip.x(m.sweep.interval->x_left), right = strip.x(m.sweep.interval->x_right);
    list->AddRectFilled({left, strip.end.y + 3}, {std::max(left + 2, right), strip.end.y + 6}, c.now);
  }
  ImGui::Dummy({width, names + bar + 8});
  flow(ui, caption(s), {c.text, 0, ui.fonts.small, 0});
}

/// With a line buffer there are no flags; a polygon is active while edges of it are (001).
bool with_line_buffer(const Session& s) { return depth_buffer(s.header()) == DepthBuffer::line; }

bool is_active(const MethodState& m, std::int32_t polygon) {
  return std::any_of(m.active.begin(), m.active.end(), [&](const ActiveEdge& edge) {
    const std::size_t at = edge.edge;
    return at < m.edge_table.size() && m.edge_table[at].polygon == polygon;
  });
}

}  // namespace

std::vector<TableRow> polygon_rows(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const bool line_buffer = with_line_buffer(s);
  const std::vector<std::int32_t> now = pieces_now(s.event());
  const auto among = [](const std::vector<std::int32_t>& list, std::int32_t piece) {
    return std::find(list.begin(), list.end(), piece) != list.end();
  };
  std::vector<TableRow> rows;
  for (std::size_t k = 0; k < m.pieces.size(); ++k) {
    const auto piece = index32(k);
    const bool in = line_buffer ? is_active(m, m.pieces[k].polygon) : among(m.sweep.inside, piece),
               is_now = among(now, piece);
    if (m.pieces.size() > whole_table && !in && !is_now) continue;
    TableRow row;
    row.cells = {TableCell(piece_label(s.scene(), m, piece), color_of(s.scene(), m.pieces[k].polygon, 0)),
                 TableCell::result_of(line_buffer ? (in ? "\u25cf active" : "")
                                      : in        ? "\u25cf in"
                                                  : "out",
                                      in ? "\u25cf" : "\u00b7")};
    row.about = row.cells[0].text;
    if (const auto& plane = m.pieces[k].plane)
      for (const auto& [field, value] : {std::pair{"plane_a", plane->plane_a},
                                         {"plane_b", plane->plane_b},
                                         {"plane_c", plane->plane_c},
                                         {"plane_d", plane->plane_d}})
        row.cells.emplace_back(value, answers::made_by<PlaneEquation>(s.position(), field, {{"piece", piece}}));
    row.cells[1].changed = is_now && holds<FlagFlip>(s.event()->event);
    for (std::size_t cell = 2; cell < row.cells.size(); ++cell)
      row.cells[cell].changed = is_now && holds<PlaneEquation>(s.event()->event);
    row.look = is_now ? TableRow::Look::now : in ? TableRow::Look::plain : TableRow::Look::gone;
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

void draw_table(Ui& ui) {
  const std::vector<TableRow> rows = rows_of_both(ui, polygon_rows);
  if (rows.empty())
    return say_empty(ui, fmt::format("Of {} polygons none is in here.", ui.session.state().machine.pieces.size()));
  number_table(ui, "polygons", {"P", with_line_buffer(ui.session) ? "" : "flag", "A", "B", "C", "D"}, rows);
}

void draw_sweep(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  if (m.pieces.empty())
    return say_empty(ui, "Empty: each polygon that is in view gets a row, with its plane and a flag.");
  if (m.scan_line) draw_strip(ui, *m.scan_line);
  if (ImGui::GetContentRegionAvail().y < 3 * ui.line()) return;  // no room for its head and two rows
  ImGui::BeginChild("table", ImGui::GetContentRegionAvail(), false,
                    ImGuiWindowFlags_HorizontalScrollbar);  // the strip stays in view
  draw_table(ui);
  ImGui::EndChild();
}

std::string note_of_sweep(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  return m.scan_line            ? fmt::format("y = {}", *m.scan_line)
         : m.pieces.empty()     ? ""
         : m.pieces.size() == 1 ? "1 polygon"
                                : fmt::format("{} polygons", m.pieces.size());
}

bool serves_sweep(const Header& header) { return records<FlagFlip>(header); }

}  // namespace

const Pane sweep_pane{"sweep", "POLYGON TABLE", draw_sweep, note_of_sweep, serves_sweep, 0.42f, false, always<15>};

}  // namespace zstep::viewer
