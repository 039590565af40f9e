// The edges with their visible and hidden pieces, the one at work and the face it is held against, a table of its
// intervals; and the floating horizon's two horizons.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <tuple>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/model/outside.hpp"
#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/outline_names.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

struct Ends {
  double x0, y0, x1, y1;
};

std::optional<Ends> ends_of(const Moment& s, const RasterMap& map, const LineBegin& line) {
  const auto a = on_raster(s.scene(), s.state(), line.vertex_0), b = on_raster(s.scene(), s.state(), line.vertex_1);
  if (!a || !b) return std::nullopt;
  return Ends{map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y)};
}

Ends part_of(const Ends& e, double t_0, double t_1) {
  const double dx = e.x1 - e.x0, dy = e.y1 - e.y0;
  return {e.x0 + t_0 * dx, e.y0 + t_0 * dy, e.x0 + t_1 * dx, e.y0 + t_1 * dy};
}

void dashes(Canvas& canvas, const Ends& e, double thickness, Pixel32 color) {
  const double length = portable::length(e.x1 - e.x0, e.y1 - e.y0);
  constexpr double on = 4, period = 8;
  if (!(length > 0) || length > 1e5) return;
  for (double at = 0; at < length; at += period) {
    const Ends dash = part_of(e, at / length, std::min(1.0, (at + on) / length));
    canvas.line(dash.x0, dash.y0, dash.x1, dash.y1, thickness, color);
  }
}

/// The face of the last test, if that was of the edge at work.
std::int32_t face_now(const MethodState& m) { return m.against && m.against->line == m.line ? m.against->facet : -1; }

void draw_face(const Moment& s, Canvas& canvas, const RasterMap& map, std::int32_t facet, double thickness,
               Pixel32 color) {
  if (facet < 0 || facet >= std::ssize(s.scene().facets)) return;
  const Facet& face = s.scene().facets[facet];
  for (std::int32_t k = 0; k < face.corner_count; ++k) {
    const std::int32_t a = s.scene().corners[face.first_corner + k];
    const std::int32_t b = s.scene().corners[face.first_corner + (k + 1) % face.corner_count];
    if (const auto e = ends_of(s, map, {0, a, b, -1, -1, LineKind::inner}))
      canvas.line(e->x0, e->y0, e->x1, e->y1, thickness, color);
  }
}

void draw_pieces(const Moment& s, Canvas& canvas, const RasterMap& map, const LineRow& row, double thickness,
                 Pixel32 visible, Pixel32 hidden) {
  const auto ends = ends_of(s, map, row.entry);
  if (!ends) return;
  for (const LinePiece& piece : row.pieces) {
    const Ends part = part_of(*ends, piece.t_0, piece.t_1);
    if (piece.visible) canvas.line(part.x0, part.y0, part.x1, part.y1, thickness, visible);
    else dashes(canvas, part, std::max(1.0, thickness * 0.7), hidden);
  }
}

/// Does the stop that speaks mark lines itself? Then the edge at work is not marked.
bool marks_lines(const Moment& now) {
  const auto is_line = [](const StopLabel& label) { return label.to >= 0; };
  return now.told() && std::any_of(now.told()->labels.begin(), now.told()->labels.end(), is_line);
}

void paint_lines(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, const float& weight) {
  const MethodState& m = now.state().machine;
  const double thin = weight;
  canvas.fill(to_pixel(c.pane));
  // The whole wireframe, faintly, so that it is seen what an edge belongs to.
  constexpr std::size_t most_corners = 20'000;
  if (now.scene().corners.size() <= most_corners)
    for (const auto& [from, to] : edges_of(now.scene()))
      if (const auto e = ends_of(now, map, {0, from, to, -1, -1, LineKind::inner}))
        canvas.line(e->x0, e->y0, e->x1, e->y1, (m.lines.empty() ? 1.5 : 1.0) * thin,
                    m.lines.empty() ? to_pixel(c.text) : mixed(to_pixel(c.pane), to_pixel(c.muted), 140));
  const bool works = !now.at_rest() && !marks_lines(now);
  if (works) draw_face(now, canvas, map, face_now(m), 4 * thin, to_pixel(c.selected));
  for (const LineRow& row : m.lines)
    draw_pieces(now, canvas, map, row, 1.6 * thin, to_pixel(c.text), to_pixel(c.muted));
  const std::size_t at = m.line;
  if (m.line < 0 || at >= m.lines.size() || !works) return;
  const LineRow& row = m.lines[at];
  const auto ends = ends_of(now, map, row.entry);
  if (!ends) return;
  if (!row.pieces.empty()) return draw_pieces(now, canvas, map, row, 3.4 * thin, to_pixel(c.now), to_pixel(c.now));
  canvas.line(ends->x0, ends->y0, ends->x1, ends->y1, 3.4 * thin, to_pixel(c.now));
  for (const LineHide& hidden : row.hidden) {  // found so far
    const Ends part = part_of(*ends, hidden.t_0, hidden.t_1);
    canvas.line(part.x0, part.y0, part.x1, part.y1, 4 * thin, to_pixel(c.pane));
    dashes(canvas, part, 3 * thin, to_pixel(c.now));
  }
}

/// Which polygon a facet belongs to, by its letter.
std::string face_label(const Scene& scene, std::int32_t facet) {
  if (facet < 0 || facet >= std::ssize(scene.facets)) return "\u2013";
  return polygon_label(scene, scene.facets[facet].polygon);
}

const LineRow* line_at_work(const MethodState& m) {
  const std::size_t at = m.line;
  return m.line < 0 || at >= m.lines.size() ? nullptr : &m.lines[at];
}

}  // namespace

std::vector<TableRow> interval_rows(Ui& ui) {
  const Session& s = ui.session;
  const LineRow* at_work = line_at_work(s.state().machine);
  if (!at_work) return {};
  const LineRow& row = *at_work;
  const auto [first, last] = std::minmax(row.entry.vertex_0, row.entry.vertex_1);
  const std::string edge = fmt::format("{}-{} ", first, last);
  const RecordedEvent* event = s.event();
  const bool hides_now = event && holds<LineHide>(event->event), cuts_now = event && holds<LinePiece>(event->event);
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < row.hidden.size(); ++i) {
    const LineHide& hidden = row.hidden[i];
    const auto asks = [&](const char* field, double t) {
      answers::Question question =
          answers::made_by<LineHide>(s.position(), field, {{"line", hidden.line}, {"facet", hidden.facet}});
      question.value = t;
      return question;
    };
    TableRow shown;
    shown.cells = {"hidden by " + face_label(s.scene(), hidden.facet), TableCell(hidden.t_0, asks("t_0", hidden.t_0)),
                   TableCell(hidden.t_1, asks("t_1", hidden.t_1))};
    shown.about = edge + shown.cells[0].text;
    if (hides_now && i + 1 == row.hidden.size()) shown.look = TableRow::Look::now;
    rows.push_back(std::move(shown));
  }
  for (std::size_t i = 0; i < row.pieces.size(); ++i) {
    const LinePiece& piece = row.pieces[i];
    const auto asks = [&](const char* field, double t) {
      answers::Question question = answers::made_by<LinePiece>(s.position(), field, {{"line", piece.line}});
      question.value = t;
      return question;
    };
    TableRow shown;
    shown.cells = {std::string(piece.visible ? "\u2500\u2500 visible" : "- - hidden"),
                   TableCell(piece.t_0, asks("t_0", piece.t_0)), TableCell(piece.t_1, asks("t_1", piece.t_1))};
    shown.about = edge + shown.cells[0].text;
    if (cuts_now && i + 1 == row.pieces.size()) shown.look = TableRow::Look::now;
    rows.push_back(std::move(shown));
  }
  return rows;
}

namespace {

void draw_table(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const LineRow* row = line_at_work(m);
  if (ui.still || ((!row || marks_lines(ui.moment())) && !ui.laboratory)) return;
  if (!row) return say_empty(ui, "An edge's intervals stand here once it is at work.");
  flow(ui,
       fmt::format("Edge {}: {}\u2013{}, {}", m.line, row->entry.vertex_0, row->entry.vertex_1,
                   word_of(row->entry.kind)),
       {.font = ui.fonts.bold});
  const std::vector<TableRow> rows = rows_of_both(ui, interval_rows);
  if (!rows.empty()) {
    number_table(ui, "intervals", {"", "t from", "to"}, rows);
    return;
  }
  const std::int32_t face = face_now(m);
  say_empty(ui, face >= 0
                    ? fmt::format("Tested against {}: no part of it is hidden so far.", face_label(s.scene(), face))
                    : std::string("It was tested against no polygon yet."));
}

std::string about_line(const LineBegin& line) {
  const auto [first, last] = std::minmax(line.vertex_0, line.vertex_1);
  return fmt::format("{}-{}", first, last);
}

/// What the picture shows of each edge: what is visible of it.
std::vector<TableRow> edge_rows(Ui& ui) {
  std::vector<TableRow> rows;
  for (const LineRow& line : ui.session.state().machine.lines) {
    std::string visible;
    for (const LinePiece& piece : line.pieces)
      if (piece.visible)
        visible += fmt::format("{}t = {} to {}", visible.empty() ? "" : ", ", number(piece.t_0), number(piece.t_1));
    TableRow row;
    row.cells.push_back(TableCell::result_of(line.pieces.empty() ? ""
                                             : visible.empty()   ? "hidden"
                                                                 : "visible " + visible));
    row.about = about_line(line.entry);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// In the middle of each edge of which something else is visible than before the change.
void mark_lines(Ui& ui, ImVec2 origin, const RasterMap& map) {
  const ChangedParts changed = changed_parts(ui, edge_rows);
  if (changed.empty()) return;
  const float half = std::round(ui.em * 0.3f);
  for (const LineRow& line : ui.session.state().machine.lines) {
    const auto ends = ends_of(ui.moment(), map, line.entry);
    if (!ends) continue;
    const ImVec2 between = moved_by(origin, (ends->x0 + ends->x1) / 2, (ends->y0 + ends->y1) / 2),
                 middle{std::round(between.x), std::round(between.y)};
    mark_part(ui, changed, about_line(line.entry), {middle.x - half, middle.y - half},
              {middle.x + half, middle.y + half});
  }
}

/// The face that the edge at work is tested against and those that were found to hide a part of it; of a step that is
/// about the edge itself, or about a face of its own, both that meet there.
std::set<std::int32_t> faces_spoken_of(const Session& s, const LineRow& row) {
  std::set<std::int32_t> faces{face_now(s.state().machine)};
  for (const LineHide& hidden : row.hidden) faces.insert(hidden.facet);
  const std::set<std::int32_t> own{row.entry.left_facet, row.entry.right_facet};
  const auto* piece = s.event() ? get_if<LinePiece>(&s.event()->event) : nullptr;
  const auto* against = s.event() ? get_if<LineAgainst>(&s.event()->event) : nullptr;
  if ((s.event() && holds<LineBegin>(s.event()->event)) || (piece && !piece->visible && row.hidden.empty()) ||
      (against && own.count(against->facet) > 0))
    faces.insert(own.begin(), own.end());
  return faces;
}

/// The edge at work with its vertices, the polygons that matter to it, and where it crosses the one that it is tested
/// against.
void name_line(Ui& ui, WordPlaces& words, ImVec2 origin, const RasterMap& map) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const LineRow* row = line_at_work(s.state().machine);
  const auto ends = row ? ends_of(ui.moment(), map, row->entry) : std::nullopt;
  if (!ends) return;
  const ImVec2 from = moved_by(origin, ends->x0, ends->y0), to = moved_by(origin, ends->x1, ends->y1);
  const glm::dvec2 way(ends->x1 - ends->x0, ends->y1 - ends->y0), side(way.y, -way.x);
  words.keep_line_free(from, to);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float radius = std::round(0.25f * ui.em);
  const auto* cross = s.event() ? get_if<LineCross>(&s.event()->event) : nullptr;
  std::map<std::int32_t, ImVec2> named;  // facets, by the middles of their outlines
  for (const std::int32_t facet : faces_spoken_of(s, *row)) {
    if (facet < 0 || facet >= std::ssize(s.scene().facets)) continue;
    const Facet& face = s.scene().facets[static_cast<std::size_t>(facet)];
    std::vector<ImVec2> corners;
    for (std::int32_t k = 0; k < face.corner_count; ++k)
      if (const auto at = on_raster(s.scene(), s.state(), s.scene().corners[face.first_corner + k]))
        corners.push_back(moved_by(origin, map.px(at->x), map.py(at->y)));
    ImVec2 middle(0, 0);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      words.keep_line_free(corners[k], corners[(k + 1) % corners.size()]);
      middle.x += corners[k].x / to_float(corners.size()), middle.y += corners[k].y / to_float(corners.size());
    }
    stroke_lines(list, corners, c.selected, ui.thin, true);
    if (!corners.empty()) named.emplace(facet, middle);
    // Where the edge goes through the plane, also where it crosses the outline on the picture.
    for (std::size_t k = 0; k < corners.size() && cross && cross->in_space && cross->facet == facet; ++k) {
      const ImVec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
      const glm::dvec2 side_way(b.x - a.x, b.y - a.y), gap(a.x - from.x, a.y - from.y);
      const double across = way.x * side_way.y - way.y * side_way.x;
      const double t = (gap.x * side_way.y - gap.y * side_way.x) / across, u = (gap.x * way.y - gap.y * way.x) / across;
      if (!(t >= 0 && t <= 1 && u >= 0 && u < 1)) continue;
      const ImVec2 at = moved_by(from, t * way.x, t * way.y);
      fill_circle(list, at, radius, c.pane);
      stroke_circle(list, at, radius, c.selected, 2 * ui.thin);
      words.taken.take({at.x - radius, at.y - radius}, {2 * radius, 2 * radius});
    }
  }
  const ImVec2 met = cross ? moved_by(origin, map.px(cross->x_at), map.py(cross->y_at)) : ImVec2();
  if (cross) {
    fill_circle(list, met, radius, c.pane);
    stroke_circle(list, met, radius, c.now, 2 * ui.thin);
    words.taken.take({met.x - radius, met.y - radius}, {2 * radius, 2 * radius});
  }
  for (const auto& [vertex, at, out] : {std::tuple{row->entry.vertex_0, from, -way}, {row->entry.vertex_1, to, way}}) {
    fill_circle(list, at, std::round(0.2f * ui.em), c.now);
    words.around(vertex_label(s.scene(), vertex), c.now, ui.fonts.bold, at, out);
  }
  words.beside(fmt::format("edge {}", row->entry.line), c.now, ui.fonts.bold, from, to, side);
  if (cross) words.around(fmt::format("t = {}", number(cross->t)), c.now, ui.fonts.text, met, side);
  const float step = 1.4f * ui.em;
  for (const auto& [facet, at] : named)
    words.put(face_label(s.scene(), facet), c.text, ui.fonts.bold,
              {at, {at.x, at.y - step}, {at.x, at.y + step}, {at.x - step, at.y}, {at.x + step, at.y}});
  if (!s.event() || !holds<Saved>(s.event()->event)) return;
  // The pieces that extents keep from being tested: those whose y lies apart from the edge's.
  const auto a = on_raster(s.scene(), s.state(), row->entry.vertex_0),
             b = on_raster(s.scene(), s.state(), row->entry.vertex_1);
  const auto [low, high] = std::minmax(a->y, b->y);
  std::vector<ExtentBar> bars{{fmt::format("edge {}", row->entry.line), low, high, c.now}};
  for (const Piece& piece : s.state().machine.pieces)
    if (piece.extent && (piece.extent->y_max < low || piece.extent->y_min > high))
      bars.push_back({polygon_label(s.scene(), piece.polygon), piece.extent->y_min, piece.extent->y_max, c.selected});
  constexpr std::size_t most_bars = 5;
  if (bars.size() > 1 && bars.size() <= most_bars) draw_extents(ui, words, map, origin, true, bars);
}

/// Where the edges of a polygon that the lesson's stop names go through another one that it names, joined: a line that
/// no polygon has as an edge.
void mark_meetings(Ui& ui, WordPlaces& words, const Stop& stop, ImVec2 origin, const RasterMap& map) {
  const Session& s = ui.session;
  std::vector<std::vector<glm::dvec3>> faces;
  for (const Facet& facet : s.scene().facets) {
    const std::string name = polygon_label(s.scene(), facet.polygon);
    if (std::none_of(stop.labels.begin(), stop.labels.end(), [&](const StopLabel& one) { return one.name == name; }))
      continue;
    faces.emplace_back();
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      if (const auto at = on_raster(s.scene(), s.state(), s.scene().corners[facet.first_corner + k]))
        faces.back().emplace_back(at->x, at->y, at->z);
  }
  for (const std::vector<glm::dvec3>& face : faces) {
    if (face.size() < 3) continue;
    const auto side_of = [](const std::vector<glm::dvec3>& outline, std::size_t k) {
      return std::pair(outline[k], outline[(k + 1) % outline.size()]);
    };
    const glm::dvec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    for (const std::vector<glm::dvec3>& other : faces) {
      std::vector<glm::dvec3> met;
      for (std::size_t e = 0; e < other.size() && &other != &face; ++e) {
        const auto [from, to] = side_of(other, e);
        const double d_0 = glm::dot(normal, from - face[0]), d_1 = glm::dot(normal, to - face[0]);
        if (!(d_0 * d_1 < -1e-9 * (d_0 * d_0 + d_1 * d_1))) continue;
        const glm::dvec3 place = from + d_0 / (d_0 - d_1) * (to - from);
        bool inside = true;
        for (std::size_t k = 0; k < face.size(); ++k) {
          const auto [a, b] = side_of(face, k);
          inside = inside && glm::dot(glm::cross(b - a, place - a), normal) >= 0;
        }
        if (inside) met.push_back(place);
      }
      if (met.size() != 2) continue;
      const ImVec2 from = moved_by(origin, map.px(met[0].x), map.py(met[0].y)),
                   to = moved_by(origin, map.px(met[1].x), map.py(met[1].y));
      const glm::dvec2 way(to.x - from.x, to.y - from.y);
      stroke_line(ImGui::GetWindowDrawList(), from, to, ui.colors().now, 3 * ui.thin);
      words.keep_line_free(from, to);
      for (const auto& [end, spot, out] : {std::tuple{met[0], from, -way}, {met[1], to, way}}) {
        fill_circle(ImGui::GetWindowDrawList(), spot, std::round(0.25f * ui.em), ui.colors().now);
        words.around(fmt::format("({}, {})", number(end.x), number(end.y)), ui.colors().now, ui.fonts.text, spot, out);
      }
    }
  }
}

void draw_lines(Ui& ui) {
  const Session& s = ui.session;
  const ImVec2 avail = ImGui::GetContentRegionAvail();
  const bool beside = avail.x > avail.y * 1.3f;
  const float table_width = std::round(ui.em * 14), table_height = std::round(ui.em * 8);
  const int width = static_cast<int>(beside ? std::max(avail.x - table_width, avail.x * 0.4f) : avail.x);
  const int height = static_cast<int>(beside ? avail.y : avail.y - table_height);
  if (width < 8 || height < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  RasterMap map(s.scene().raster, {}, width, height);
  map.cell = std::min((width - 8.0) / map.width,
                      (height - 8.0) / map.height);  // not in whole pixels: lines may use all the room
  map.left = std::floor((width - map.width * map.cell) / 2);
  map.top = std::floor((height - map.height * map.cell) / 2);
  const Kept<Canvas>& canvas =
      *keep_canvas(ui.canvases, "lines", width, height, paint_lines, map, ui.moment(), ui.colors(), ui.thin);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), at,
                                       {at.x + to_float(width), at.y + to_float(height)});
  mark_lines(ui, at, map);
  WordPlaces words(ui, at, moved_by(at, map.box_width, map.box_height));
  if (!ui.still && !marks_lines(ui.moment())) name_line(ui, words, at, map);
  if (const Stop* const stop = ui.moment().told(); stop) {
    mark_meetings(ui, words, *stop, at, map);
    draw_stop_labels(ui, words, *stop, at, map);
  }
  if (beside) ImGui::SetCursorScreenPos({at.x + to_float(width) + ui.em * 0.3f, at.y});
  else ImGui::SetCursorScreenPos({at.x, at.y + to_float(height)});
  begin_part(ui, "intervals");
  draw_table(ui);
  ImGui::EndChild();
}

std::string note_of_lines(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  if (m.lines.empty() || ui.still || marks_lines(ui.moment())) return "";
  const std::int32_t face = face_now(m);
  return face >= 0 ? fmt::format("edge {} against {}", m.line, face_label(ui.session.scene(), face))
                   : fmt::format("edge {}", m.line);
}

bool serves_lines(const Header& header) { return records<LineBegin>(header); }

}  // namespace

const Pane lines_pane{"lines", "EDGES", draw_lines, note_of_lines, serves_lines,
                      0.6f,    false,   always<15>, false,         none_yet<LineBegin>};

// The two floating horizons on the raster: the curves so far, the band between the horizons where nothing more is seen,
// the curve at work and the column at which it is held against them.

namespace {

/// A curve of the surface's grid, straight from sample to sample, as far as the trace has brought them to the raster.
void draw_curve(const Moment& s, Canvas& canvas, const RasterMap& map, const CurveBegin& curve, double thickness,
                Pixel32 color) {
  if (!s.scene().surface || curve.across) return;
  const std::int32_t columns = s.scene().surface->columns;
  for (std::int32_t column = 0; column + 1 < columns; ++column) {
    const auto a = on_raster(s.scene(), s.state(), curve.row * columns + column);
    const auto b = on_raster(s.scene(), s.state(), curve.row * columns + column + 1);
    if (a && b) canvas.line(map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y), thickness, color);
  }
}

/// Between the horizons whatever comes is hidden; with the upper one alone, everything below it.
void shade_hidden(const HorizonWork& work, Canvas& canvas, const RasterMap& map, bool one, Pixel32 shade) {
  const double bottom = map.py(map.height - 0.5);
  for (std::size_t x = 0; x < work.upper.size() && x < work.lower.size(); ++x) {
    if (!std::isfinite(work.upper[x])) continue;
    const auto row = [&](double y) { return nearest_int(std::clamp(map.py(y), 0.0, bottom)); };
    const int column = index32(x);
    canvas.rectangle(map.column_begin(column), row(work.upper[x]), map.column_begin(column + 1),
                     one ? static_cast<int>(bottom) : row(work.lower[x]), shade);
  }
}

/// One horizon: a level piece a column, and thin risers between. The lower one is dashed.
void draw_horizon(const std::vector<double>& horizon, Canvas& canvas, const RasterMap& map, bool dashed,
                  double thickness, Pixel32 color) {
  for (std::size_t x = 0; x < horizon.size(); ++x) {
    if (!std::isfinite(horizon[x])) continue;
    const double at = map.px(static_cast<double>(x)), y = map.py(horizon[x]), half = map.cell / 2;
    canvas.line(at - half, y, dashed ? at : at + half, y, thickness, color);
    if (x + 1 < horizon.size() && std::isfinite(horizon[x + 1]))
      canvas.line(at + half, y, at + half, map.py(horizon[x + 1]), 0.4 * thickness, color);
  }
}

bool one_horizon(const Header& header) {
  const auto& options = header.conventions.options;
  const auto found = options.find("horizons");
  return found != options.end() && found->second == "one";
}

void paint_horizons(Canvas& canvas, const RasterMap& map, const Moment& now,
                    const std::vector<CurveMarks::Mark>& curves, const Theme& c, const float& thin) {
  const HorizonWork& work = now.state().machine.horizon;
  const Pixel32 paper = to_pixel(c.head);
  const double line = thin;
  canvas.fill(to_pixel(c.pane));
  canvas.rectangle(map.column_begin(0), map.row_begin(0), map.column_begin(map.width), map.row_end(map.height - 1),
                   paper);
  shade_hidden(work, canvas, map, one_horizon(now.header()), mixed(paper, to_pixel(c.muted), 70));
  for (const CurveMarks::Mark& mark : curves)
    if (mark.position <= now.position()) draw_curve(now, canvas, map, mark.curve, line, to_pixel(c.muted));
  draw_horizon(work.lower, canvas, map, true, 2.5 * line, to_pixel(c.text));
  draw_horizon(work.upper, canvas, map, false, 2.5 * line, to_pixel(c.text));
  if (work.curve) draw_curve(now, canvas, map, *work.curve, 2 * line, to_pixel(c.now));
  if (work.segment) {
    const auto a = on_raster(now.scene(), now.state(), work.segment->vertex_0),
               b = on_raster(now.scene(), now.state(), work.segment->vertex_1);
    if (a && b) canvas.line(map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y), 4 * line, to_pixel(c.now));
  }
}

/// The column at work: a thin line down the raster, a dot on the curve (hollow where it is hidden) and the verdict in
/// words.
void mark_column(Ui& ui, ImVec2 at, const RasterMap& map) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const HorizonWork& work = s.state().machine.horizon;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto place = [&](double x, double y) { return moved_by(at, map.px(x), map.py(y)); };
  if (const auto& asked = s.event_in_question()) {
    if (const auto* test = get_if<HorizonTest>(&asked->event)) {
      const ImVec2 size = text_size(ui, ui.fonts.bold, "?"), spot = place(test->x, test->y_curve);
      stroke_line(list, place(test->x, -0.5), place(test->x, map.height - 0.5), c.now, ui.thin);
      const ImVec2 low{spot.x - size.x / 2, spot.y - size.y / 2};
      list->AddRectFilled({low.x - 2, low.y}, {low.x + size.x + 2, low.y + size.y}, c.pane);
      draw_text(ui, low, ui.fonts.bold, c.now, "?");
    }
  } else if (work.test) {
    const HorizonTest& now = *work.test;
    const ImVec2 top = place(now.x, -0.5), bottom = place(now.x, map.height - 0.5);
    stroke_line(list, top, bottom, c.now, ui.thin);
    if (now.y_curve >= -0.5 && now.y_curve <= map.height - 0.5) {
      const ImVec2 dot = place(now.x, now.y_curve);
      const float radius = std::max(4.0f, ui.em * 0.3f);
      fill_circle(list, dot, radius, now.verdict == Horizon::hidden ? c.pane : c.now);
      stroke_circle(list, dot, radius, c.now, 2 * ui.thin);
      const auto* moved = s.event() ? get_if<HorizonMove>(&s.event()->event) : nullptr;
      const std::size_t column = now.x, known = std::min(work.upper.size(), work.lower.size());
      const bool both = moved && column < known && work.upper[column] == work.lower[column] && !one_horizon(s.header());
      const std::string word = both                             ? "upper = lower"
                               : moved                          ? moved->upper ? "upper" : "lower"
                               : now.verdict == Horizon::hidden ? "hidden"
                               : now.verdict == Horizon::above  ? "above"
                                                                : "below";
      const ImVec2 size = text_size(ui, ui.fonts.small, word);
      float x = dot.x + radius + 4, y = dot.y - size.y - radius;
      if (x + size.x > at.x + to_float(map.box_width)) x = dot.x - radius - 4 - size.x;
      y = std::clamp(y, at.y + 1, at.y + to_float(map.box_height) - size.y - 1);
      list->AddRectFilled({x - 2, y - 1}, {x + size.x + 2, y + size.y + 1}, c.pane);
      draw_text(ui, {x, y}, ui.fonts.small, c.now, word);
    }
  }
  if (work.cross) {
    const ImVec2 cross = place(work.cross->x_at, work.cross->y_at);
    const float arm = std::max(5.0f, ui.em * 0.4f);
    for (const float side : {-1.0f, 1.0f})
      stroke_line(list, {cross.x - arm, cross.y - side * arm}, {cross.x + arm, cross.y + side * arm}, c.changed,
                  2.5f * ui.thin);
  }
}

/// What the picture shows of each column: where the horizons are.
std::vector<TableRow> column_rows(Ui& ui) {
  const HorizonWork& work = ui.session.state().machine.horizon;
  std::vector<TableRow> rows;
  for (std::size_t x = 0; x < work.upper.size() && x < work.lower.size(); ++x) {
    TableRow row;
    row.about = fmt::format("{}", x);
    for (const double y : {work.upper[x], work.lower[x]})
      row.cells.push_back(std::isfinite(y) ? TableCell(y) : TableCell());
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Below each column where a horizon is another one than before the change.
void mark_columns(Ui& ui, ImVec2 origin, const RasterMap& map) {
  const ChangedParts changed = changed_parts(ui, column_rows);
  if (changed.empty()) return;
  const float top = origin.y + to_float(map.row_begin(0)), bottom = origin.y + to_float(map.row_end(map.height - 1));
  for (int x = 0; x < map.width; ++x)
    mark_part(ui, changed, fmt::format("{}", x), {origin.x + to_float(map.column_begin(x)), top},
              {origin.x + to_float(map.column_begin(x + 1)), bottom});
}

void draw_horizons(Ui& ui) {
  const Session& s = ui.session;
  const ImVec2 avail = ImGui::GetContentRegionAvail();
  const ImFont* font = ui.fonts.small;
  const float legend = std::round(font->FontSize * 1.3f);
  const Rulers rulers = room_for_rulers(ui, s.scene().raster);
  const int width = static_cast<int>(avail.x - rulers.left), height = static_cast<int>(avail.y - rulers.below - legend);
  if (width < 8 || height < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const RasterMap map(s.scene().raster, {}, width, height);
  const Kept<Canvas>& canvas = *keep_canvas(ui.canvases, "horizons", width, height, paint_horizons, map, ui.moment(),
                                            ui.curves.of(s.trace()), ui.colors(), ui.thin);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), at{corner.x + rulers.left, corner.y};
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), at,
                                       {at.x + to_float(width), at.y + to_float(height)});
  if (!ui.still) mark_column(ui, at, map);
  mark_columns(ui, at, map);
  draw_rulers(ui, map, at, rulers);
  const std::string whole = one_horizon(s.header()) ? "solid: the horizon    shaded: hidden, by this rule"
                                                    : "solid: upper   dashed: lower   shaded: hidden";
  for (const std::string& text : {whole, std::string("shaded: hidden")})
    if (text_size(ui, font, text).x <= avail.x) {
      draw_text(ui, {corner.x, at.y + to_float(height) + rulers.below + 2}, font, ui.colors().muted, text);
      break;
    }
}

std::string note_of_horizons(Ui& ui) {
  const auto& curve = ui.session.state().machine.horizon.curve;
  if (!curve) return "";
  return fmt::format("{} = {}", curve->across ? "x" : "z", number(curve->constant, 2, true));
}

bool serves_horizons(const Header& header) { return records<HorizonTest>(header); }

}  // namespace

const Pane horizons_pane{"horizons", "HORIZONS", draw_horizons, note_of_horizons,     serves_horizons, 0.5f,
                         false,      always<15>, false,         none_yet<HorizonTest>};

}  // namespace zstep::viewer
