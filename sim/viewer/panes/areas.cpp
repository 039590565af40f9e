// Warnock's areas over the frame, each settled one with the number of its case, and the bins of the area at work.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/outline_names.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {
namespace {

constexpr std::size_t most_outlines = 200;

struct Box {
  int left, top, right, bottom;
};

Box box_of(const RasterMap& map, const AreaBegin& a) {
  const int top = std::min(map.row_begin(a.first_row), map.row_begin(a.end_row - 1));
  const int bottom = std::max(map.row_end(a.first_row), map.row_end(a.end_row - 1));
  return {map.column_begin(a.first_column), top, map.column_begin(a.end_column), bottom};
}

void frame(Canvas& canvas, const Box& b, int thickness, Pixel32 color) {
  canvas.rectangle(b.left, b.top, b.right, b.top + thickness, color);
  canvas.rectangle(b.left, b.bottom - thickness, b.right, b.bottom, color);
  canvas.rectangle(b.left, b.top, b.left + thickness, b.bottom, color);
  canvas.rectangle(b.right - thickness, b.top, b.right, b.bottom, color);
}

bool has_pixels(const AreaBegin& a) { return a.first_column < a.end_column && a.first_row < a.end_row; }

/// The area that this one is a quarter of; nullptr where it is no quarter.
const AreaRow* quartered(const MethodState& m, std::int32_t area) {
  const std::int32_t parent = m.areas[static_cast<std::size_t>(area)].entry.parent;
  return parent >= 0 && parent < std::ssize(m.areas) ? &m.areas[static_cast<std::size_t>(parent)] : nullptr;
}

/// `came`: how far the area at work has come from the whole that it is a quarter of.
void paint_areas(Canvas& canvas, const RasterMap& map, const Moment& now, const double& came, const Theme& c,
                 const float& thin) {
  const MethodState& m = now.state().machine;
  const Picture& picture = now.state().picture;
  const int line = nearest_int(thin);
  std::vector<Pixel32> cells(picture.polygon.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = mixed(opaque(zstep::color_at(picture, now.scene(), i)), to_pixel(c.pane), 110);
  paint_raster(canvas, map, cells, {to_pixel(c.pane), to_pixel(c.grid), to_pixel(c.empty), to_pixel(c.empty_hatch)});
  for (const AreaRow& row : m.areas)
    if (has_pixels(row.entry)) frame(canvas, box_of(map, row.entry), line, to_pixel(c.text));
  if (m.pieces.size() <= most_outlines)
    for (const Piece& piece : m.pieces)
      for (std::size_t i = 0; i < piece.outline.size(); ++i) {
        const auto a = on_raster(now.scene(), now.state(), piece.outline[i]);
        const auto b = on_raster(now.scene(), now.state(), piece.outline[(i + 1) % piece.outline.size()]);
        if (!a || !b) continue;
        const std::size_t polygon = piece.polygon;
        const Pixel32 color =
            polygon < now.scene().polygons.size() ? opaque(now.scene().polygons[polygon].color) : to_pixel(c.muted);
        canvas.line(map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y), 3.6 * line, to_pixel(c.text), 200);
        canvas.line(map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y), 2.0 * line, color);
      }
  const std::size_t at = m.area;
  if (m.area >= 0 && at < m.areas.size() && !now.at_rest() && has_pixels(m.areas[at].entry)) {
    Box b = box_of(map, m.areas[at].entry);
    if (const AreaRow* whole = quartered(m, m.area); whole && came < 1) {
      const Box from = box_of(map, whole->entry);
      const auto mix = [&](int one, int other) { return nearest_int(one + came * (other - one)); };
      b = {mix(from.left, b.left), mix(from.top, b.top), mix(from.right, b.right), mix(from.bottom, b.bottom)};
    }
    frame(canvas, {b.left - 2 * line, b.top - 2 * line, b.right + 2 * line, b.bottom + 2 * line}, 4 * line,
          to_pixel(c.now));
  }
}

/// "1" to "4" after the lecture's list; a pixel decided by itself is "px".
const char* sign_of(AreaCase what) {
  constexpr ByEnum<AreaCase, const char*> signs{"1", "2", "3", "4", "px", ""};
  return signs[what];
}

/// The polygons that it is about, inside their outlines.
void name_pieces(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  std::vector<NamedOutline> outlines;
  for (std::size_t k = 0; k < m.pieces.size() && k < most_outlines; ++k) {
    NamedOutline& one = outlines.emplace_back();
    one.name = piece_label(s.scene(), m, index32(k));
    for (const std::int32_t vertex : m.pieces[k].outline)
      if (const auto at = on_raster(s.scene(), s.state(), vertex))
        one.outline.emplace_back(map.px(at->x), map.py(at->y));
  }
  name_outlines(ui, words, origin, outlines);
}

/// In the middle of each settled area, or in one of its corners if a name is in the middle.
void draw_signs(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words) {
  for (const AreaRow& row : ui.session.state().machine.areas) {
    if (!row.decided || !has_pixels(row.entry)) continue;
    std::string sign = sign_of(row.decided->what);
    const Session& s = ui.session;
    const bool at_work = &row == &s.state().machine.areas[std::max(0, s.state().machine.area)] && !s.at_rest();
    if (row.decided->what == AreaCase::pixel && at_work && !ui.still) continue;  // its centre is drawn
    const Box b = box_of(map, row.entry);
    const auto width = to_float(b.right - b.left), height = to_float(b.bottom - b.top);
    const ImVec2 middle = moved_by(origin, (b.left + b.right) / 2.0, (b.top + b.bottom) / 2.0);
    // Areas have numbers, too.
    const bool numbered = row.decided->what != AreaCase::pixel && !sign.empty();
    if (numbered && text_size(ui, ui.fonts.bold, "case " + sign).x + 6 <= width) sign = "case " + sign;
    for (const ImFont* font : {ui.fonts.bold, ui.fonts.small}) {
      const ImVec2 size = text_size(ui, font, sign);
      if (sign.empty() || size.x + 6 > width || size.y + 2 > height) continue;
      std::vector<ImVec2> places{middle};
      for (const float right : {-0.5f, 0.5f})
        for (const float down : {-0.5f, 0.5f})
          places.push_back({middle.x + right * (width - size.x - 6), middle.y + down * (height - size.y - 4)});
      if (words.put(sign, ui.colors().text, font, places)) break;
    }
  }
}

/// A dot at the centre of the pixel at work, or at the corners of the area at work where planes are held against each
/// other there; beside it what depths they have.
void draw_depths(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  if (ui.still || s.at_rest() || m.area < 0 || m.area >= std::ssize(m.areas) || !s.event()) return;
  const Theme& c = ui.colors();
  const AreaRow& row = m.areas[static_cast<std::size_t>(m.area)];
  const AreaBegin& a = row.entry;
  const auto* depth = get_if<PlaneDepth>(&s.event()->event);
  const auto dot = [&](double x, double y) {
    const ImVec2 at = moved_by(origin, map.px(x), map.py(y));
    fill_circle(ImGui::GetWindowDrawList(), at, std::round(0.22f * ui.em), c.now);
    return at;
  };
  const auto told = [&](std::int32_t piece, double z) {
    return fmt::format("{} {}", piece_label(s.scene(), m, piece), number(z));
  };
  /// To the right of a place (1) or to its left (-1), below it (1) or above.
  const auto beside = [&](const std::string& text, ImVec2 at, float off, float right, float down) {
    const ImVec2 size = text_size(ui, ui.fonts.bold, text);
    words.put(text, c.now, ui.fonts.bold,
              {{at.x + right * (off + size.x / 2 + 0.4f * ui.em), at.y + down * (off + size.y / 2 + 0.2f * ui.em)}});
  };
  if (a.end_column - a.first_column == 1 && a.end_row - a.first_row == 1) {
    const ImVec2 at = dot(a.first_column, a.first_row);
    if (depth) beside(told(depth->piece, depth->z), at, static_cast<float>(map.cell / 2), 1, 1);
    return;
  }
  const bool in_front = row.decided && row.decided->what == AreaCase::front_surrounder;
  if (!has_pixels(a) || !(depth || (in_front && holds<AreaDecide>(s.event()->event)))) return;
  for (const double x : {a.first_column - 0.5, a.end_column - 0.5})
    for (const double y : {a.first_row - 0.5, a.end_row - 0.5}) {
      std::string text;
      for (const AreaBin& bin : m.bins) {
        if (bin.bin == Bin::disjoint || bin.piece < 0 || bin.piece >= std::ssize(m.pieces)) continue;
        const auto& p = m.pieces[static_cast<std::size_t>(bin.piece)].plane;
        if (p && p->plane_c != 0)
          text += (text.empty() ? "" : ", ") +
                  told(bin.piece, -(p->plane_a * x + p->plane_b * y + p->plane_d) / p->plane_c);
      }
      const float inwards = x < a.end_column - 1 ? 1 : -1, down = y < a.end_row - 1 ? 1 : -1;
      beside(text, dot(x, y), 0, inwards, down);
    }
}

std::string about_area(const AreaBegin& area) {
  return fmt::format("{},{} to {},{}", area.first_column, area.first_row, area.end_column, area.end_row);
}

/// What the picture shows of each area: by which case it was settled, and with which polygon.
std::vector<TableRow> area_rows(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  std::vector<TableRow> rows;
  for (const AreaRow& area : m.areas) {
    TableRow row;
    row.about = about_area(area.entry);
    const bool known = area.decided && area.decided->piece >= 0 && area.decided->piece < std::ssize(m.pieces);
    row.cells.push_back(TableCell::result_of(
        !area.decided ? ""
                      : fmt::format("case {}{}", sign_of(area.decided->what),
                                    known ? ", " + piece_label(s.scene(), m, area.decided->piece) : "")));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string names_in(const Session& s, Bin bin) {
  const MethodState& m = s.state().machine;
  std::string names;
  for (const AreaBin& row : m.bins)
    if (row.bin == bin) names += (names.empty() ? "" : ", ") + piece_label(s.scene(), m, row.piece);
  return names;
}

std::vector<TableRow> bin_rows(Ui& ui) {
  std::vector<TableRow> rows;
  for (const Bin bin : {Bin::disjoint, Bin::intersecting, Bin::surrounding, Bin::contained}) {
    TableRow row;
    row.about = word_of(bin);
    row.cells.push_back(TableCell::result_of(names_in(ui.session, bin)));
    rows.push_back(std::move(row));
  }
  return rows;
}

void mark_areas(Ui& ui, const RasterMap& map, ImVec2 origin) {
  const ChangedParts changed = changed_parts(ui, area_rows);
  if (changed.empty()) return;
  for (const AreaRow& row : ui.session.state().machine.areas) {
    if (!has_pixels(row.entry)) continue;
    const Box b = box_of(map, row.entry);
    mark_part(ui, changed, about_area(row.entry), {origin.x + to_float(b.left), origin.y + to_float(b.top)},
              {origin.x + to_float(b.right), origin.y + to_float(b.bottom)});
  }
}

/// One bin: its name, then its polygons with a swatch each, as many as there is room for.
void draw_bin(Ui& ui, Bin bin, const ChangedParts& changed) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const Theme& c = ui.colors();
  const RecordedEvent* event = s.event();
  const AreaBin* now = event ? get_if<AreaBin>(&event->event) : nullptr;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float right = at.x + ImGui::GetContentRegionAvail().x, height = std::round(ui.em * 1.35f);
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (now && now->bin == bin) {
    list->AddRectFilled(at, {right, at.y + height}, c.now_soft);
    list->AddRectFilled(at, {at.x + 3, at.y + height}, c.now);
  }
  mark_part(ui, changed, std::string(word_of(bin)), at, {right, at.y + height - 1});
  const float y = at.y + std::round((height - ui.em) / 2) - 1;
  const float side = std::round(ui.em * 0.55f);
  draw_text(ui, {at.x + ui.em * 0.4f, y}, ui.fonts.text, c.muted, std::string(word_of(bin)));
  float x = at.x + ui.em * 0.8f + text_size(ui, ui.fonts.text, "surrounding ").x;
  std::size_t all = 0, shown = 0;
  for (const AreaBin& row : m.bins) all += row.bin == bin;
  const float more = text_size(ui, ui.fonts.text, fmt::format("+{}", all)).x;
  for (const AreaBin& row : m.bins) {
    const std::size_t piece = row.piece;
    if (row.bin != bin || row.piece < 0 || piece >= m.pieces.size()) continue;
    const std::int32_t polygon = m.pieces[piece].polygon;
    const std::string label = polygon_label(s.scene(), polygon);
    const float width = ui.em * 0.75f + text_size(ui, ui.fonts.bold, label).x + ui.em * 0.5f;
    if (x + width + (shown + 1 < all ? more : 0) > right) {
      draw_text(ui, {x, y}, ui.fonts.text, c.muted, fmt::format("+{}", all - shown));
      break;
    }
    const float top = at.y + std::round((height - side) / 2);
    if (static_cast<std::size_t>(polygon) < s.scene().polygons.size())
      list->AddRectFilled({x, top}, {x + side, top + side}, to_im(opaque(s.scene().polygons[polygon].color)));
    frame_box(ui, {x, top}, {x + side, top + side}, c.text);
    draw_text(ui, {x + ui.em * 0.75f, y}, now == nullptr || now->piece != row.piece ? ui.fonts.text : ui.fonts.bold,
              c.text, label);
    x += width;
    ++shown;
  }
  if (all == 0) draw_text(ui, {x, y}, ui.fonts.text, c.muted, "\u2013");
  ImGui::Dummy({1, height});
}

void draw_bins(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  if (ui.still) return;
  if (m.area < 0 || m.areas.empty())
    return say_empty(ui, "The bins of an area fill once all polygons are on the raster.");
  flow(ui, fmt::format("Area {}", m.area), {.font = ui.fonts.bold});
  const ChangedParts changed = changed_parts(ui, bin_rows);
  for (const Bin bin : {Bin::disjoint, Bin::intersecting, Bin::surrounding, Bin::contained}) draw_bin(ui, bin, changed);
  const std::size_t known = m.pieces.size() - std::min(m.pieces.size(), m.bins.size());
  const Flow quiet{.color = ui.colors().muted};
  const bool settled = m.areas[m.area].decided.has_value();
  if (known > 0 && settled)
    flow(ui, fmt::format("{} more {} known to miss the area around it.", known, known == 1 ? "is" : "are"), quiet);
}

void draw_areas(Ui& ui) {
  const Session& s = ui.session;
  const ImVec2 avail = ImGui::GetContentRegionAvail();
  const bool beside = avail.x > avail.y * 1.3f;
  const float bins_width = std::round(ui.em * 14), bins_height = std::round(ui.em * 8.5f);
  const int width = static_cast<int>(beside ? std::max(avail.x - bins_width, avail.x * 0.4f) : avail.x);
  const int height = static_cast<int>(beside ? avail.y : avail.y - bins_height);
  if (width < 8 || height < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const Rulers rulers = room_for_rulers(ui, s.scene().raster);
  const int wide = width - 4 - static_cast<int>(rulers.left), high = height - 4 - static_cast<int>(rulers.below);
  if (wide < 8 || high < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  RasterMap map(s.scene().raster, {}, wide, high);
  // What continues outside the picture is seen to do so.
  const auto continues = [&](std::int32_t vertex) {
    const auto p = on_raster(s.scene(), s.state(), vertex);
    return p && (p->x < -0.5 || p->y < -0.5 || p->x > map.width - 0.5 || p->y > map.height - 0.5);
  };
  if (std::max(map.left, map.top) < ui.em && std::ranges::any_of(s.state().machine.pieces, [&](const Piece& piece) {
        return std::ranges::any_of(piece.outline, continues);
      }))
    map = RasterMap(s.scene().raster, {.zoom = std::max(0.5, 1 - 2.5 * ui.em / std::min(wide, high))}, wide, high);
  const bool begins =
      s.event() && holds<AreaBegin>(s.event()->event) && quartered(s.state().machine, s.state().machine.area);
  const double came = begins && ui.arrived < 1 ? ui.on_way() : 1;
  const Kept<Canvas>& canvas =
      *keep_canvas(ui.canvases, "areas", wide, high, paint_areas, map, ui.moment(), came, ui.colors(), ui.thin);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), at{corner.x + rulers.left, corner.y};
  const ImVec2 end{at.x + to_float(wide), at.y + to_float(high)};
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), at, end);
  // Rows by number on the left of what continues outside the picture.
  double left = map.left;
  for (const Piece& piece : s.state().machine.pieces)
    for (const std::int32_t vertex : piece.outline)
      if (const auto p = on_raster(s.scene(), s.state(), vertex)) left = std::min(left, map.px(p->x));
  RasterMap rows = map;
  rows.left = std::max(left, map.left - 2 * map.cell) - (left < map.left ? 4 : 0);
  if (rows.left < 0) rows.left = map.left;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->PushClipRect(corner, moved_by(at, rows.left, to_float(high)), true);
  draw_rulers(ui, rows, at, rulers);
  list->PopClipRect();
  list->PushClipRect(moved_by(at, 0, map.top + map.height * map.cell), moved_by(end, 0.6 * ui.em, rulers.below), true);
  draw_rulers(ui, map, at, rulers);
  list->PopClipRect();
  WordPlaces words(ui, at, end);
  name_pieces(ui, map, at, words);
  draw_depths(ui, map, at, words);
  draw_signs(ui, map, at, words);
  mark_areas(ui, map, at);
  if (beside) ImGui::SetCursorScreenPos({corner.x + to_float(width) + ui.em * 0.3f, at.y});
  else ImGui::SetCursorScreenPos({corner.x, at.y + to_float(height)});
  begin_part(ui, "bins");
  draw_bins(ui);
  ImGui::EndChild();
}

std::string note_of_areas(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  if (m.areas.empty()) return "";
  const auto settled = std::count_if(m.areas.begin(), m.areas.end(), [](const AreaRow& row) {
    return row.decided && row.decided->what != AreaCase::subdivide;
  });
  return fmt::format("{} settled", grouped(settled));
}

bool serves_areas(const Header& header) { return records<AreaBegin>(header); }

}  // namespace

const Pane areas_pane{"areas", "AREAS", draw_areas, note_of_areas, serves_areas,
                      0.6f,    false,   always<30>, false,         none_yet<AreaBegin>};

}  // namespace zstep::viewer
