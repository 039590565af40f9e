#include "sim/viewer/panes/raster_pane.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/half_planes.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/lesson.hpp"
#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/outline_names.hpp"
#include "sim/viewer/panes/sweep.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/pieces.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {
namespace {

constexpr std::int64_t most_outlines = 12;

std::int64_t uncut(const MethodState& m) {
  return std::count_if(m.pieces.begin(), m.pieces.end(), [](const Piece& piece) { return !piece.cut; });
}

/// The outline of the polygon at work and the edge that is lit, over the cells.
void draw_geometry(Canvas& canvas, const RasterMap& map, const Moment& now, const std::optional<std::int32_t>& lit,
                   const Theme& c, double thin) {
  const MethodState& m = now.state().machine;
  // `inside`: of what lies on the raster alone, beside which its numbers stand.
  const auto line = [&](std::int32_t a, std::int32_t b, double thickness, ImU32 color, unsigned share,
                        bool inside = false) {
    const auto from = on_raster(now.scene(), now.state(), a), to = on_raster(now.scene(), now.state(), b);
    if (!from || !to) return;
    const glm::dvec2 first(from->x, from->y), way = glm::dvec2(to->x, to->y) - first;
    const auto part =
        inside ? part_within(glm::dvec2(-0.5), glm::dvec2(map.width - 0.5, map.height - 0.5), first, way, 0, 1)
               : std::optional(std::pair(0.0, 1.0));
    if (!part) return;
    const glm::dvec2 p = first + part->first * way, q = first + part->second * way;
    canvas.line(map.px(p.x), map.py(p.y), map.px(q.x), map.py(q.y), thickness * thin, to_pixel(color), share);
  };
  // Dark on a light border: visible on every colour a cell can have, and stronger where the grid is dark, too.
  const bool dark = (c.pane & 255u) < 128;
  const double wide = dark ? 2.2 : 1.2;
  const bool mixes = m.triangle.setup && !m.sweep.covered.empty();  // no polygon is at work any more
  if (map.cell >= 3 && m.outline.size() > 1 && !mixes) {
    for (std::size_t i = 0; i < m.outline.size(); ++i)
      line(m.outline[i], m.outline[(i + 1) % m.outline.size()], 3, IM_COL32(255, 255, 255, 255), 130);
    for (std::size_t i = 0; i < m.outline.size(); ++i)
      line(m.outline[i], m.outline[(i + 1) % m.outline.size()], wide, IM_COL32(40, 40, 40, 255), dark ? 255 : 200);
  }
  // Of methods that have all polygons at work at once, each faintly, until there are too many.
  if (map.cell >= 3 && m.outline.empty() && uncut(m) <= most_outlines)
    for (const Piece& piece : m.pieces)
      for (std::size_t i = 0; i < piece.outline.size() && !piece.cut; ++i) {
        const std::int32_t from = piece.outline[i], to = piece.outline[(i + 1) % piece.outline.size()];
        line(from, to, 3, IM_COL32(255, 255, 255, 255), 110, true);
        line(from, to, wide, IM_COL32(40, 40, 40, 255), dark ? 255 : 170, true);
      }
  if (lit && static_cast<std::size_t>(*lit) < m.edge_table.size()) {
    const EdgeTableInsert& e = m.edge_table[*lit];
    line(e.vertex_0, e.vertex_1, 4, c.selected, 220);
  }
  const auto* enters = now.event() && !now.at_rest() ? get_if<EdgeTableInsert>(&now.event()->event) : nullptr;
  if (enters && map.cell >= 3) line(enters->vertex_0, enters->vertex_1, 2.8, c.now, 255);
}

void paint(Canvas& canvas, const RasterMap& map, const Kept<Cells>& cells, const Moment& now,
           const std::optional<std::int32_t>& lit, const bool& still, const Theme& ink, const Theme& c,
           const float& thin) {
  paint_raster(canvas, map, cells.made.colors,
               {to_pixel(c.pane), to_pixel(c.grid), to_pixel(c.empty), to_pixel(c.empty_hatch)},
               cells.made.counts.empty() ? nullptr : &cells.made.counts);
  if (!still) {
    draw_geometry(canvas, map, now, lit, c, thin);
    paint_half_planes(canvas, map, now, ink, thin);
  }
  const int line = nearest_int(thin);
  const int x0 = map.column_begin(0) - line, x1 = map.column_begin(map.width) + line - 1;
  const int y0 = nearest_int(map.top) - line, y1 = nearest_int(map.top + map.height * map.cell) + line - 1;
  canvas.rectangle(x0, y0, x1, y0 + line, to_pixel(c.grid));
  canvas.rectangle(x0, y1 - line, x1, y1, to_pixel(c.grid));
  canvas.rectangle(x0, y0, x0 + line, y1, to_pixel(c.grid));
  canvas.rectangle(x1 - line, y0, x1, y1, to_pixel(c.grid));
}

void zoom_and_pan(Ui& ui, const RasterMap& map, ImVec2 origin) {
  const ImGuiIO& io = ImGui::GetIO();
  RasterView& view = ui.view;
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    const double before = map.cell;
    const double zoom =
        std::clamp(view.zoom * portable::pow(1.25, io.MouseWheel), 1.0, most_zoom(ui.session.scene().raster));
    // The cell under the mouse stays there.
    const double from_x = (io.MousePos.x - origin.x - map.left) / before - map.width / 2.0;
    const double from_y = (io.MousePos.y - origin.y - map.top) / before - map.height / 2.0;
    const double ratio = view.zoom / zoom;
    view.center_x = from_x + (view.center_x - from_x) * ratio;
    view.center_y = from_y + (view.center_y - from_y) * ratio;
    view.zoom = zoom;
    if (zoom == 1) view.center_x = view.center_y = 0;
  }
  const bool dragging = ImGui::IsItemActive() && (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 4) ||
                                                  ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 4));
  if (dragging && view.zoom > 1) {
    view.center_x -= io.MouseDelta.x / map.cell;
    view.center_y -= io.MouseDelta.y / map.cell;
  }
  view.center_x = std::clamp(view.center_x, -map.width / 2.0, map.width / 2.0);
  view.center_y = std::clamp(view.center_y, -map.height / 2.0, map.height / 2.0);
}

void frame_cell(const Ui& ui, const RasterMap& map, ImVec2 origin, Cell cell, float out, float thickness, ImU32 color) {
  out = std::round(out * ui.thin);
  const ImVec2 a{origin.x + to_float(map.column_begin(cell.x)) - out, origin.y + to_float(map.row_begin(cell.y)) - out};
  const ImVec2 b{origin.x + to_float(map.column_begin(cell.x + 1)) + out - 1,
                 origin.y + to_float(map.row_end(cell.y)) + out - 1};
  frame_box(ui, a, b, color, thickness);
}

/// Pixels that are wrong, or part from the other run's: in the lower left corner a triangle, filled or hollow. On
/// pixels too small for that a box around the one and a dot on the other, with lines that a class sees and an edge of
/// the pane's colour, so that they stand out from whatever is drawn below.
/// Of marks on so many small pixels that they cover what they mark, those along the border of what is marked.
std::vector<PixelMark> border_of(const std::vector<PixelMark>& marks, int width, int height) {
  std::vector<bool> marked(pixel_count(width, height));
  for (const PixelMark& mark : marks) marked.at(mark.pixel) = true;
  std::vector<PixelMark> border;
  for (const PixelMark& mark : marks) {
    const std::int64_t x = mark.pixel % width, y = mark.pixel / width;
    const auto inside = [&](std::int64_t at) { return marked[at]; };
    const bool surrounded = x > 0 && y > 0 && x + 1 < width && y + 1 < height && inside(mark.pixel - 1) &&
                            inside(mark.pixel + 1) && inside(mark.pixel - width) && inside(mark.pixel + width);
    if (!surrounded) border.push_back(mark);
  }
  return border;
}

void draw_pixel_marks(Ui& ui, const RasterMap& map, ImVec2 origin) {
  if (!ui.pixel_marks) return;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Picture& picture = ui.session.picture();
  if (picture.width < 1) return;
  constexpr double small = 12;
  constexpr std::size_t many = 500;
  const bool covered = map.cell < small && ui.pixel_marks->size() > many;
  const std::vector<PixelMark> border =
      covered ? border_of(*ui.pixel_marks, picture.width, picture.height) : std::vector<PixelMark>();
  const float thick = std::max(3.0f, std::round(3 * ui.thin)), edge = std::max(1.0f, ui.thin);
  const auto each = [&](auto&& use) {
    for (const PixelMark& mark : covered ? border : *ui.pixel_marks) {
      const Cell cell{static_cast<std::int32_t>(mark.pixel % picture.width),
                      static_cast<std::int32_t>(mark.pixel / picture.width)};
      const ImVec2 a{origin.x + to_float(map.column_begin(cell.x)), origin.y + to_float(map.row_begin(cell.y))};
      const ImVec2 b{origin.x + to_float(map.column_begin(cell.x + 1)), origin.y + to_float(map.row_end(cell.y))};
      const bool seen = b.x > origin.x - 20 && a.x < origin.x + to_float(map.box_width) + 20 && b.y > origin.y - 20 &&
                        a.y < origin.y + to_float(map.box_height) + 20;
      if (seen) use(mark, a, b);
    }
  };
  if (map.cell < small) {
    const auto box = [&](ImVec2 a, ImVec2 b, float out, float line, ImU32 color) {
      a = {a.x - out, a.y - out}, b = {b.x + out, b.y + out};
      list->AddRectFilled(a, {b.x, a.y + line}, color);
      list->AddRectFilled({a.x, b.y - line}, b, color);
      list->AddRectFilled({a.x, a.y + line}, {a.x + line, b.y - line}, color);
      list->AddRectFilled({b.x - line, a.y + line}, {b.x, b.y - line}, color);
    };
    const auto dot = [&](ImVec2 a, ImVec2 b, float half, ImU32 color) {
      const ImVec2 m{std::floor((a.x + b.x) / 2), std::floor((a.y + b.y) / 2)};
      list->AddRectFilled({m.x - half, m.y - half}, {m.x + half, m.y + half}, color);
    };
    if (covered) {
      const float half = std::max(1.0f, std::round(ui.thin));
      for (const bool edges : {true, false})
        each([&](const PixelMark&, ImVec2 a, ImVec2 b) {
          dot(a, b, edges ? half + edge : half, edges ? c.pane : c.bad);
        });
      return;
    }
    // All edges below all marks: neighbours are one patch then, and what is a cause lies on top.
    const float half = std::max(std::ceil(thick / 2), std::floor(static_cast<float>(map.cell) * 0.25f));
    for (const bool edges : {true, false})
      each([&](const PixelMark& mark, ImVec2 a, ImVec2 b) {
        if (!mark.filled) dot(a, b, edges ? half + edge : half, edges ? c.pane : c.bad);
      });
    for (const bool edges : {true, false})
      each([&](const PixelMark& mark, ImVec2 a, ImVec2 b) {
        if (!mark.filled) return;
        if (edges) box(a, b, thick + 2 * edge, thick + 2 * edge, c.pane);
        else box(a, b, thick + edge, thick, c.bad);
      });
    return;
  }
  each([&](const PixelMark& mark, ImVec2 a, ImVec2 b) {
    const float left = a.x, foot = b.y - 1;
    const float size = std::max(3 * thick, std::round(static_cast<float>(map.cell) * 0.4f));
    list->AddTriangleFilled({left, foot - size - 2 * edge}, {left, foot}, {left + size + 2 * edge, foot}, c.pane);
    list->AddTriangleFilled({left, foot - size}, {left, foot}, {left + size, foot}, c.bad);
    const float inner = size * 0.42f, in = std::max(1.0f, size * 0.17f);
    if (!mark.filled)
      list->AddTriangleFilled({left + in, foot - in - inner}, {left + in, foot - in}, {left + in + inner, foot - in},
                              c.pane);
  });
}

/// The scene's vertex or edge that is picked, where the run has brought it to the raster by now.
void draw_picked(Ui& ui, const RasterMap& map, ImVec2 origin) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const ScenePart part = s.lit_part();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto place = [&](std::int32_t vertex) -> std::optional<ImVec2> {
    const auto spot = on_raster(s.scene(), s.state(), vertex);
    if (!spot) return std::nullopt;
    return moved_by(origin, map.px(spot->x), map.py(spot->y));
  };
  if (part.edge && !s.lit_edge()) {
    const auto from = place(part.edge->first), to = place(part.edge->second);
    if (from && to) stroke_line(list, *from, *to, c.selected, 4 * ui.thin);
  }
  if (!part.vertex) return;
  const auto middle = place(*part.vertex);
  if (!middle) return;
  const float radius = std::round(ui.em * 0.4f);
  stroke_circle(list, *middle, radius, c.pane, 4 * ui.thin);
  stroke_circle(list, *middle, radius, c.selected, 2 * ui.thin);
}

/// Cells of a unit that the reader stepped over come one after the other, as they were written: over those to come lies
/// what was painted before.
void cover_cells_to_come(Ui& ui, const char* id, const RasterMap& map, ImVec2 origin) {
  const auto before = ui.canvases_before.find(id);
  if (ui.arrived == 1 || ui.session.unit() == Unit::event || before == ui.canvases_before.end()) return;
  const Canvas& was = before->second.made;
  const std::vector<Cell>& cells = ui.session.changed();
  if (cells.size() < 2 || was.width() != map.box_width || was.height() != map.box_height) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (std::size_t k = static_cast<std::size_t>(ui.on_way() * static_cast<double>(cells.size())); k < cells.size();) {
    const Cell first = cells[k];
    std::int32_t end = first.x + 1;
    for (++k; k < cells.size() && cells[k].y == first.y && cells[k].x == end; ++k) ++end;
    list->PushClipRect({origin.x + to_float(map.column_begin(first.x)), origin.y + to_float(map.row_begin(first.y))},
                       {origin.x + to_float(map.column_begin(end)), origin.y + to_float(map.row_end(first.y))}, true);
    list->AddImage(Renderer::image(was), origin, moved_by(origin, map.box_width, map.box_height));
    list->PopClipRect();
  }
}

/// An edge that goes on to the next scan line does so along its slope.
void draw_edge_on_its_way(Ui& ui, const RasterMap& map, ImVec2 origin) {
  const MethodState& m = ui.session.state().machine;
  const auto* step = ui.session.event() ? get_if<EdgeStep>(&ui.session.event()->event) : nullptr;
  if (ui.arrived == 1 || !step || !m.scan_line || static_cast<std::size_t>(step->edge) >= m.edge_table.size()) return;
  const EdgeTableInsert& edge = m.edge_table[static_cast<std::size_t>(step->edge)];
  const auto at = [&](double rows) {
    return moved_by(origin, map.px(step->x_edge + (rows - 1) * edge.dx_dy), map.py(*m.scan_line + rows));
  };
  const ImVec2 from = at(0), now = at(ui.on_way());
  ImDrawList* list = ImGui::GetWindowDrawList();
  stroke_line(list, from, now, ui.colors().pane, 5 * ui.thin);
  stroke_line(list, from, now, ui.colors().now, 3 * ui.thin);
  fill_circle(list, now, std::round(ui.em * 0.35f), ui.colors().pane);
  fill_circle(list, now, std::round(ui.em * 0.27f), ui.colors().now);
}

/// Does an edge come into the table, with this step or with that which is asked about?
bool fills_edge_table(const Session& s) {
  const auto& asked = s.event_in_question();
  return holds<EdgeTableInsert>((asked ? &*asked : s.event())->event);
}

/// The edges of the polygon at work: those in its table, and those that come into it next.
std::vector<EdgeTableInsert> edges_at_work(const Session& s, std::size_t most) {
  std::vector<EdgeTableInsert> edges;
  for (const EdgeTableInsert& entry : s.state().machine.edge_table)
    if (edges.size() < most) edges.push_back(entry);
  if (!fills_edge_table(s)) return edges;
  for (std::int64_t position = s.position() + 1; position <= s.size() && edges.size() < most; ++position) {
    const EdgeTableInsert* next = get_if<EdgeTableInsert>(&s.trace().event(position).event);
    if (!next) break;
    edges.push_back(*next);
  }
  return edges;
}

/// Where a step is about edges, their names and those of the vertices that they begin or end at; of a span, its ends';
/// of a pixel of glass, the polygon's.
void name_outline(Ui& ui, const RasterMap& map, ImVec2 origin, const std::optional<SpanEnds>& ends, WordPlaces& words) {
  constexpr std::size_t most_named = 12;
  constexpr double least_cell = 8;
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const std::size_t count = m.outline.size();
  const Theme& c = ui.colors();
  if (!s.event() || count < 3 || count > most_named || map.cell < least_cell) return;
  const auto& asked = s.event_in_question();
  const std::optional<std::int32_t> now = edge_now(asked && fills_edge_table(s) ? &*asked : s.event());
  const SpanBegin* span = get_if<SpanBegin>(&s.event()->event);
  const bool steps = holds<EdgeStep>(s.event()->event);
  const bool of_edges = !m.keeps_all && (now || span || holds<EdgeSwap>(s.event()->event));
  if (!of_edges && !(records<ColorBlend>(s.header()) && m.polygon >= 0)) return;
  std::vector<glm::dvec2> corners;
  for (const std::int32_t vertex : m.outline)
    if (const auto at = on_raster(s.scene(), s.state(), vertex)) corners.emplace_back(map.px(at->x), map.py(at->y));
  if (corners.size() != count) return;
  const auto corner = [&](std::size_t k) { return corners[k % count]; };
  const auto place = [&](std::size_t k) { return moved_by(origin, corner(k).x, corner(k).y); };
  double area = 0;
  for (std::size_t k = 0; k < count; ++k) {
    area += corner(k).x * corner(k + 1).y - corner(k + 1).x * corner(k).y;
    words.keep_line_free(place(k), place(k + 1));
  }
  const auto out = [&](std::size_t k) {  // of the side from corner k, of length 1
    const glm::dvec2 way = corner(k + 1) - corner(k);
    const double length = portable::length(way.x, way.y);
    return length > 0 ? glm::dvec2(way.y, -way.x) * (area > 0 ? 1 / length : -1 / length) : glm::dvec2(0);
  };
  for (std::size_t k = 0; k < count && !of_edges; ++k)  // where pixels show mixtures, no letter says whose they are
    if (words.around(polygon_label(s.scene(), m.polygon), c.text, ui.fonts.bold, place(k), out(k) + out(k + count - 1)))
      break;
  if (!of_edges) return;
  if (span && ends)
    for (const auto& [name, x, side] : {std::tuple{"x_L", ends->left, -1.0f}, {"x_R", ends->right, 1.0f}}) {
      const ImVec2 size = text_size(ui, ui.fonts.bold, name);
      const float beside = x + side * (size.x / 2 + 5 * ui.thin), middle = (ends->top + ends->end) / 2;
      words.put(name, c.now, ui.fonts.bold,
                {{beside, middle}, {beside, middle + size.y}, {beside, middle - size.y}, {x, ends->end + size.y}});
    }
  // A span has two edges, and none of the others matters.
  std::vector<EdgeTableInsert> edges = edges_at_work(s, most_named);
  if (span)
    std::erase_if(edges,
                  [&](const EdgeTableInsert& e) { return e.edge != span->left_edge && e.edge != span->right_edge; });
  for (std::size_t k = 0; k < count && !steps; ++k) {
    const std::int32_t vertex = m.outline[k];
    if (!span || std::any_of(edges.begin(), edges.end(),
                             [&](const EdgeTableInsert& e) { return e.vertex_0 == vertex || e.vertex_1 == vertex; }))
      words.around(vertex_label(s.scene(), vertex), c.text, ui.fonts.small, place(k), out(k) + out(k + count - 1));
  }
  for (const EdgeTableInsert& edge : edges)
    for (std::size_t k = 0; k < count; ++k)
      if (std::minmax(m.outline[k], m.outline[(k + 1) % count]) == std::minmax(edge.vertex_0, edge.vertex_1))
        words.beside(edge_label(s.scene(), edge), now == edge.edge ? c.now : c.text, ui.fonts.bold, place(k),
                     place(k + 1), out(k));
}

/// What the step changed, and where its span ends.
void mark_changed(Ui& ui, const RasterMap& map, ImVec2 origin, const std::optional<SpanEnds>& ends) {
  const Theme& c = ui.colors();
  const Session& s = ui.session;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto& changed = s.looking_back ? s.changed() : s.changed_here();
  if (map.cell >= 6 && (s.event_told() || s.looking_back)) {
    // A filled corner in each changed cell.
    const float size = std::max(4.0f, std::round(static_cast<float>(map.cell) * 0.3f));
    for (const Cell cell : changed) {
      const ImVec2 corner{origin.x + to_float(map.column_begin(cell.x + 1)) - 1,
                          origin.y + to_float(map.row_begin(cell.y))};
      list->AddTriangleFilled({corner.x - size - 1, corner.y}, corner, {corner.x, corner.y + size + 1},
                              ui.colors().pane);
      list->AddTriangleFilled({corner.x - size, corner.y}, corner, {corner.x, corner.y + size}, c.changed);
    }
  } else if (!changed.empty()) {
    // Too small for corners: brackets around all of them.
    Cell low = changed.front(), high = changed.front();
    for (const Cell cell : changed) {
      low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
    }
    const float x0 = origin.x + to_float(map.column_begin(low.x)) - 2,
                x1 = origin.x + to_float(map.column_begin(high.x + 1)) + 2;
    const float y0 = origin.y + to_float(std::min(map.row_begin(low.y), map.row_begin(high.y))) - 2;
    const float y1 = origin.y + to_float(std::max(map.row_end(low.y), map.row_end(high.y))) + 2;
    const float arm = std::min(8.0f, std::max(3.0f, (x1 - x0) / 3));
    const float line = std::round(2 * ui.thin);
    for (const float x : {x0, x1 - line}) list->AddRectFilled({x, y0}, {x + line, y1}, c.changed);
    for (const float y : {y0, y1 - line}) {
      list->AddRectFilled({x0, y}, {x0 + arm, y + line}, c.changed);
      list->AddRectFilled({x1 - arm, y}, {x1, y + line}, c.changed);
    }
  }
  if (ends) draw_span_ends(ui, *ends);
}

/// Polygons of which no pixel is drawn yet, inside their outlines, and the letters of vertices where there are few.
void name_outlines_to_come(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words) {
  constexpr std::size_t most_letters = 12;
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  if (map.cell < 3 || !m.outline.empty() || uncut(m) > most_outlines) return;
  std::vector<NamedOutline> all;
  std::map<std::int32_t, glm::dvec2> corners;
  const std::vector<std::int32_t>& drawn = s.picture().polygon;
  for (std::size_t k = 0; k < m.pieces.size(); ++k) {
    const Piece& piece = m.pieces[k];
    if (piece.cut) continue;
    NamedOutline& one = all.emplace_back();
    for (const std::int32_t vertex : piece.outline)
      if (const auto at = on_raster(s.scene(), s.state(), vertex)) {
        one.outline.emplace_back(map.px(at->x), map.py(at->y));
        corners.emplace(vertex, one.outline.back());
      }
    for (std::size_t c = 0; c < one.outline.size(); ++c) {
      const auto place = [&](std::size_t corner) {
        return moved_by(origin, one.outline[corner].x, one.outline[corner].y);
      };
      words.keep_line_free(place(c), place((c + 1) % one.outline.size()));
    }
    if (std::find(drawn.begin(), drawn.end(), piece.polygon) == drawn.end())
      one.name = piece_label(s.scene(), m, index32(k));
  }
  name_outlines(ui, words, origin, all);
  if (corners.size() > most_letters) return;
  glm::dvec2 middle(0);
  for (const auto& [vertex, at] : corners) middle += at / static_cast<double>(corners.size());
  for (const auto& [vertex, at] : corners)
    words.around(vertex_label(s.scene(), vertex), ui.colors().muted, ui.fonts.small, moved_by(origin, at.x, at.y),
                 at - middle);
}

/// The edge that the step is about, or that is asked for, by its name; and the line in which two planes meet, as far as
/// scan lines have come.
void draw_edge_in_question(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words) {
  const Theme& c = ui.colors();
  const Moment now = ui.moment();
  const MethodState& m = now.state().machine;
  const Event* step = now.asked() ? now.asked() : now.event() ? &now.event()->event : nullptr;
  if (!step || !now.told()) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto place = [&](double x, double y) { return moved_by(origin, map.px(x), map.py(y)); };
  const auto* moved = get_if<EdgeStep>(step);
  const auto* flip = get_if<FlagFlip>(step);
  const std::int32_t edge = moved ? moved->edge : flip ? flip->edge : -1;
  if (edge >= 0 && edge < std::ssize(m.edge_table) && m.outline.empty()) {
    const EdgeTableInsert& its = m.edge_table[static_cast<std::size_t>(edge)];
    const auto from = on_raster(now.scene(), now.state(), its.vertex_0),
               to = on_raster(now.scene(), now.state(), its.vertex_1);
    if (from && to) {
      stroke_line(list, place(from->x, from->y), place(to->x, to->y), c.now, 3 * ui.thin);
      const std::string name = edge_label(now.scene(), its);
      const ImVec2 size = text_size(ui, ui.fonts.bold, name), one = place(from->x, from->y),
                   other = place(to->x, to->y);
      std::vector<ImVec2> places;
      for (const float side : {0.7f, -0.7f})
        for (const float part : {0.5f, 0.7f, 0.85f, 0.3f})
          places.push_back(
              {one.x + part * (other.x - one.x) + side * (size.x + ui.em), one.y + part * (other.y - one.y)});
      words.put(name, c.now, ui.fonts.bold, places);
    }
  }
  const auto* implied = get_if<ImpliedEdge>(step);
  const auto known = [&](std::int32_t piece) {
    return piece >= 0 && piece < std::ssize(m.pieces) && m.pieces[static_cast<std::size_t>(piece)].plane;
  };
  if (!implied || !m.scan_line || !known(implied->piece) || !known(implied->other)) return;
  const Piece &one = m.pieces[static_cast<std::size_t>(implied->piece)],
              &other = m.pieces[static_cast<std::size_t>(implied->other)];
  // Where z of one plane is z of the other: a x + b y + d = 0.
  const auto differ = [&](double PlaneEquation::*number) {
    return (*one.plane).*number / one.plane->plane_c - (*other.plane).*number / other.plane->plane_c;
  };
  const double a = differ(&PlaneEquation::plane_a), b = differ(&PlaneEquation::plane_b),
               d = differ(&PlaneEquation::plane_d);
  if (!(std::abs(a) > 1e-12)) return;
  const double last = *m.scan_line - (now.asked() ? 1 : 0);
  const auto at = [&](double y) { return place(-(b * y + d) / a, y); };
  const auto is_inside = [&](const Piece& piece, double y) {
    double left = HUGE_VAL, right = -HUGE_VAL;
    for (std::size_t k = 0; k < piece.outline.size(); ++k) {
      const auto from = on_raster(now.scene(), now.state(), piece.outline[k]),
                 to = on_raster(now.scene(), now.state(), piece.outline[(k + 1) % piece.outline.size()]);
      if (!from || !to || from->y == to->y || y < std::min(from->y, to->y) || y > std::max(from->y, to->y)) continue;
      const double x = from->x + (y - from->y) / (to->y - from->y) * (to->x - from->x);
      left = std::min(left, x), right = std::max(right, x);
    }
    const double x = -(b * y + d) / a;
    return left <= x && x <= right;
  };
  double first = last;  // scan line down to which the two planes meet inside both
  while (first > 0 && is_inside(one, first - 1) && is_inside(other, first - 1)) --first;
  if (!is_inside(one, first) || !is_inside(other, first)) return;
  stroke_line(list, at(first), at(last), c.pane, 5 * ui.thin);
  stroke_line(list, at(first), at(last), c.now, 3 * ui.thin);
  for (double y = first; y <= last; ++y) stroke_circle(list, at(y), std::round(0.5f * ui.em), c.now, 2 * ui.thin);
}

/// The vertex that comes to the raster; where that is asked, from which y_p to which the window reaches.
void mark_vertex(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words) {
  const Theme& c = ui.colors();
  const Moment now = ui.moment();
  const Camera& camera = now.scene().camera;
  if (now.asked() && holds<ViewportTransform>(*now.asked()) && camera.kind == Camera::Kind::perspective) {
    const double x = map.left + map.width * map.cell / 2, top = map.top, end = map.top + map.height * map.cell;
    const float half = ui.fonts.small->FontSize;
    words.put("y_p = " + number(camera.window), c.text, ui.fonts.small, {moved_by(origin, x, top + half)});
    words.put("y_p = " + number(-camera.window), c.text, ui.fonts.small, {moved_by(origin, x, end - half)});
  }
  const std::vector<std::int32_t>& outline = now.state().machine.outline;
  const bool edges_named = now.asked() && holds<EdgeTableInsert>(*now.asked());  // and their ends
  if (now.event() && holds<OutlineVertex>(now.event()->event) && outline.size() <= 8 && !edges_named) {
    std::vector<glm::dvec2> places;
    for (const std::int32_t vertex : outline)
      if (const auto p = on_raster(now.scene(), now.state(), vertex)) places.emplace_back(map.px(p->x), map.py(p->y));
    glm::dvec2 middle(0);
    for (const glm::dvec2 place : places) middle += place / static_cast<double>(places.size());
    for (std::size_t k = 0; k < places.size() && places.size() == outline.size(); ++k)
      words.around(vertex_label(now.scene(), outline[k]), c.text, ui.fonts.bold,
                   moved_by(origin, places[k].x, places[k].y), places[k] - middle);
  }
  const auto* made = now.event() ? get_if<ViewportTransform>(&now.event()->event) : nullptr;
  if (!made) return;
  const ImVec2 at = moved_by(origin, map.px(made->x_s), map.py(made->y_s));
  ImDrawList* list = ImGui::GetWindowDrawList();
  fill_circle(list, at, std::round(0.3f * ui.em), c.now);
  words.around(
      fmt::format("{} ({}, {})", vertex_label(now.scene(), made->vertex), number(made->x_s), number(made->y_s)), c.now,
      ui.fonts.bold, at, {1, -1});
}

/// Marks over the raster: changed, selected, pointed at, now.
void draw_marks(Ui& ui, const RasterMap& map, ImVec2 origin, const std::optional<SpanEnds>& ends) {
  const Theme& c = ui.colors();
  const Session& s = ui.session;
  draw_pixel_marks(ui, map, origin);
  if (!ui.still) mark_changed(ui, map, origin, ends);
  draw_picked(ui, map, origin);
  const float small = map.cell < 8 ? 3.0f : 0.0f;
  if (ui.pointed) frame_cell(ui, map, origin, *ui.pointed, small, 1, c.text);
  if (s.selected) {
    frame_cell(ui, map, origin, *s.selected, small + 1, 2, c.selected);
    frame_cell(ui, map, origin, *s.selected, small + 4, 1, c.selected);
  }
  const std::int32_t width = s.scene().raster.width;
  for (const std::int32_t pixel : s.pixels_spoken_of())
    frame_cell(ui, map, origin, {pixel % width, pixel / width}, small, map.cell < 1.5f * ui.em ? 1.0f : 3.0f, c.now);
  if (const auto now = s.cell_looked_at(ui.still)) {
    frame_cell(ui, map, origin, *now, small + 2, 3, c.now);
    frame_cell(ui, map, origin, *now, small - 1, 1, ui.colors().pane);
  }
}

}  // namespace

void draw_raster(Ui& ui, const char* id, float reserve_below, const Kept<Cells>& cells,
                 const std::function<std::string(std::size_t, int)>& cell_text,
                 const std::function<std::vector<std::string>(Cell)>& cell_tip, const RasterTalk& talk) {
  Session& s = ui.session;
  const Rulers rulers = room_for_rulers(ui, s.scene().raster);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), avail = ImGui::GetContentRegionAvail();
  const ImVec2 origin{corner.x + rulers.left, corner.y};
  const int width = static_cast<int>(avail.x - rulers.left),
            height = static_cast<int>(avail.y - rulers.below - reserve_below);
  if (width < 8 || height < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const RasterMap map(s.scene().raster, ui.view, width, height);
  // The frame keeps the scene's background in every theme.
  const Theme& ink = theme_on(talk.polygons ? opaque(s.scene().background) : to_pixel(ui.colors().empty));
  const Kept<Canvas>& canvas = *keep_canvas(ui.canvases, id, width, height, paint, map, cells, ui.moment(),
                                            s.lit_edge(), ui.still, ink, ui.colors(), ui.thin);
  const ImVec2 end{origin.x + to_float(width), origin.y + to_float(height)};
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), origin, end);

  ImGui::SetCursorScreenPos(origin);
  can_be_hit(ui, origin, end);
  ImGui::InvisibleButton(id, {to_float(width), to_float(height)},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  zoom_and_pan(ui, map, origin);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto under = ImGui::IsItemHovered() ? map.cell_at(mouse.x - origin.x, mouse.y - origin.y) : std::nullopt;
  if (under) {
    ui.pointed_next = under;
    const char* moves = ui.view.zoom > 1 ? "Wheel: zoom. Drag: pan." : "Wheel: zoom.";
    const float moved = std::abs(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 4).x) +
                        std::abs(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 4).y);
    const bool marks = ui.asks && s.marks_cells();
    const auto asks = ui.asks && !marks && talk.question && s.selected == under ? talk.question(*under) : std::nullopt;
    ui.mouse_help =
        !ui.asks           ? fmt::format("Click: select this pixel in every run. {}", moves)
        : marks            ? fmt::format("Click: mark {}, or take the mark away. {}",
                              s.marking()->kind == Marking::Kind::pixels ? "this pixel" : "this scan line", moves)
        : s.proposes_why() ? "Click: why this pixel has its colour."
        : asks             ? fmt::format("Click: where this depth comes from. Esc: select nothing. {}", moves)
               : fmt::format("Click: select this pixel; F goes to the next step that touches it. Right click: more. {}",
                             moves);
    if (ImGui::IsItemDeactivated() && moved == 0 && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) {
      if (marks) s.mark(*under), s.select(under);
      else if (ui.asks && s.proposes_why()) s.select(under), ui.clicked = command_called("history");
      else if (asks) ui.asked = asks;
      else s.select(s.selected == under ? std::nullopt : under);
    }
    if (ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) ui.here = lines_of_pixel(s, *under, asks);
  }
  ImGui::PushClipRect(origin, end, true);
  // Beside a number or a letter it would be read as a minus.
  const WidthInCell width_in_cell = [&](std::int32_t x, std::int32_t y) {
    const bool is_row = y >= 0 && y < s.picture().height;  // a run from elsewhere may name any
    const bool stands = is_row && cell_text && map.cell >= numbers_from && !cell_text(s.picture().at(x, y), 0).empty();
    return stands ? static_cast<float>(map.cell) : 0.0f;
  };
  const auto ends = ui.still ? std::nullopt : span_ends(ui, map, origin, width_in_cell);
  const auto on_raster_only = [&](double x, double y) {  // beside it stand the rulers
    return moved_by(origin, std::clamp(x, 0.0, 1.0 * width), std::clamp(y, 0.0, 1.0 * height));
  };
  WordPlaces words(ui, on_raster_only(map.left, map.top),
                   on_raster_only(map.left + map.width * map.cell, map.top + map.height * map.cell),
                   ends ? ends->taken() : TakenPlaces());
  const bool has_numbers = cell_text && draw_numbers(ui, map, origin, cells.made, cell_text);
  if (has_numbers)
    words.allowed = [&](ImVec2 low, ImVec2 high) {  // not on what stands in pixels
      const auto is_drawn = [&](float x, float y) {
        const auto cell = map.cell_at(x - origin.x, y - origin.y);
        return cell && width_in_cell(cell->x, cell->y) > 0;
      };
      return !is_drawn(low.x, low.y) && !is_drawn(high.x, low.y) && !is_drawn(low.x, high.y) &&
             !is_drawn(high.x, high.y);
    };
  if (const auto now = s.cell_looked_at(ui.still)) {  // its frame is drawn over all
    const float side = static_cast<float>(map.cell) + 8 * ui.thin;
    const ImVec2 middle = moved_by(origin, map.px(now->x), map.py(now->y));
    words.taken.take({middle.x - side / 2, middle.y - side / 2}, {side, side});
  }
  if (!ui.still) mark_half_planes(ui, map, origin, words, has_numbers, ink);
  if (!ui.still && talk.polygons) {
    name_outline(ui, map, origin, ends, words);
    name_outlines_to_come(ui, map, origin, words);
    mark_vertex(ui, map, origin, words);
    draw_edge_in_question(ui, map, origin, words);
  }
  if (const Stop* const told = ui.moment().told(); told && talk.polygons)
    draw_stop_labels(ui, words, *told, origin, map);
  if (!has_numbers && talk.polygons) draw_labels(ui, map, origin, std::move(words.taken));
  cover_cells_to_come(ui, id, map, origin);
  draw_marks(ui, map, origin, ends);
  draw_edge_on_its_way(ui, map, origin);
  if (ui.asks && s.marks_cells()) draw_hand_marks(ui, map, origin);
  ImGui::PopClipRect();
  draw_rulers(ui, map, origin, rulers);
  if (under) tooltip(ui, cell_tip(*under));
  ImGui::SetCursorScreenPos({corner.x, end.y + rulers.below});
}

}  // namespace zstep::viewer
