// The two floating horizons on the raster: the curves so far, the band between the horizons where nothing more is seen,
// the curve at work and the column at which it is held against them.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/draw/strokes.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
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
    const auto row = [&](double y) { return static_cast<int>(std::lround(std::clamp(map.py(y), 0.0, bottom))); };
    const int column = static_cast<int>(x);
    canvas.rectangle(map.column_begin(column), row(work.upper[x]), map.column_begin(column + 1),
                     one ? static_cast<int>(bottom) : row(work.lower[x]), shade);
  }
}

/// One horizon, from column to column; a level piece where a neighbour has none. The lower one is dashed.
void draw_horizon(const std::vector<double>& horizon, Canvas& canvas, const RasterMap& map, bool dashed,
                  double thickness, Pixel32 color) {
  for (std::size_t x = 0; x < horizon.size(); ++x) {
    if (!std::isfinite(horizon[x])) continue;
    const double at = map.px(static_cast<double>(x)), y = map.py(horizon[x]), half = map.cell / 2;
    const bool joined = x + 1 < horizon.size() && std::isfinite(horizon[x + 1]);
    const bool alone = !joined && (x == 0 || !std::isfinite(horizon[x - 1]));
    if (joined && !(dashed && x % 2 == 1)) canvas.line(at, y, at + map.cell, map.py(horizon[x + 1]), thickness, color);
    if (alone) canvas.line(at - half, y, at + half, y, thickness, color);
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
  const auto line = static_cast<double>(thin);
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
  const auto place = [&](double x, double y) {
    return ImVec2{at.x + static_cast<float>(map.px(x)), at.y + static_cast<float>(map.py(y))};
  };
  if (work.test) {
    const HorizonTest& now = *work.test;
    const ImVec2 top = place(now.x, -0.5), bottom = place(now.x, map.height - 0.5);
    stroke_line(list, top, bottom, c.now, ui.thin);
    if (now.y_curve >= -0.5 && now.y_curve <= map.height - 0.5) {
      const ImVec2 dot = place(now.x, now.y_curve);
      const float radius = std::max(4.0f, ui.em * 0.3f);
      fill_circle(list, dot, radius, now.verdict == Horizon::hidden ? c.pane : c.now);
      stroke_circle(list, dot, radius, c.now, 2 * ui.thin);
      const std::string word = now.verdict == Horizon::hidden  ? "hidden"
                               : now.verdict == Horizon::above ? "above"
                                                               : "below";
      const ImVec2 size = text_size(ui, ui.fonts.small, word);
      float x = dot.x + radius + 4, y = dot.y - size.y - radius;
      if (x + size.x > at.x + static_cast<float>(map.box_width)) x = dot.x - radius - 4 - size.x;
      y = std::clamp(y, at.y + 1, at.y + static_cast<float>(map.box_height) - size.y - 1);
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
  const float top = origin.y + static_cast<float>(map.row_begin(0)),
              bottom = origin.y + static_cast<float>(map.row_end(map.height - 1));
  for (int x = 0; x < map.width; ++x)
    mark_part(ui, changed, fmt::format("{}", x), {origin.x + static_cast<float>(map.column_begin(x)), top},
              {origin.x + static_cast<float>(map.column_begin(x + 1)), bottom});
}

void draw_horizons(Ui& ui) {
  const Session& s = ui.session;
  const ImVec2 avail = ImGui::GetContentRegionAvail();
  const ImFont* font = ui.fonts.small;
  const float legend = std::round(font->FontSize * 1.3f);
  const int width = static_cast<int>(avail.x), height = static_cast<int>(avail.y - legend);
  if (width < 8 || height < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const RasterMap map(s.scene().raster, {}, width, height);
  const Kept<Canvas>& canvas = *keep_canvas(ui.canvases, "horizons", width, height, paint_horizons, map, ui.moment(),
                                            ui.curves.of(s.trace()), ui.colors(), ui.thin);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), at,
                                       {at.x + static_cast<float>(width), at.y + static_cast<float>(height)});
  mark_column(ui, at, map);
  mark_columns(ui, at, map);
  const std::string whole = one_horizon(s.header()) ? "solid: the horizon    shaded: hidden, by this rule"
                                                    : "solid: upper   dashed: lower   shaded: hidden";
  for (const std::string& text : {whole, std::string("shaded: hidden")})
    if (text_size(ui, font, text).x <= avail.x) {
      draw_text(ui, {at.x, at.y + static_cast<float>(height) + 2}, font, ui.colors().muted, text);
      break;
    }
}

std::string note_of_horizons(Ui& ui) {
  const auto& curve = ui.session.state().machine.horizon.curve;
  if (!curve) return "";
  return fmt::format("{} = {}", curve->across ? "x" : "z", number(curve->constant, 2, true));
}

bool serves_horizons(const Header& header) { return has_step_of<HorizonTest>(header); }

}  // namespace

const Pane horizons_pane{"horizons", "HORIZONS", draw_horizons, note_of_horizons,     serves_horizons, 0.5f,
                         false,      always<15>, false,         none_yet<HorizonTest>};

}  // namespace zstep::viewer
