// The list of pieces still to be drawn, the farthest first, their z extents as bars; above it the pair under test.

#include "sim/viewer/panes/drawing_list.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/pieces.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

std::string range(double low, double high) {
  return fmt::format("{}\u2026{}", number(low, 2, true), number(high, 2, true));
}

TestLine line_of(std::int64_t at, const Event& event, bool wants_behind) {
  TestLine line;
  line.made = true;
  if (const auto* extents = get_if<ExtentTest>(&event)) {
    line.numbers = range(extents->low, extents->high) + " | " + range(extents->other_low, extents->other_high);
    line.passed = !extents->overlap;
    line.outcome = extents->overlap ? "overlap" : "apart";
    line.question = answers::made_by<ExtentTest>(
        at, "overlap",
        {{"piece", extents->piece}, {"other", extents->other}, {"axis", static_cast<std::int32_t>(extents->axis)}});
  } else if (const auto* sides = get_if<SideTest>(&event)) {
    line.numbers = range(sides->least, sides->greatest);
    line.outcome = sides->side == Side::front ? "in front" : std::string(word_of(sides->side));
    line.passed = sides->side == (wants_behind ? Side::behind : Side::front);
    if (sides->side == Side::crossing) line.outcome = "both sides";
    if (sides->side == Side::on) line.outcome = "in it";
    line.question = answers::made_by<SideTest>(at, "side", {{"piece", sides->piece}, {"plane_of", sides->plane_of}});
  } else if (const auto* projections = get_if<OverlapTest>(&event)) {
    line.passed = !projections->overlap;
    if (projections->overlap)
      line.numbers = fmt::format("at ({}, {})", number(projections->x_at, 2, true), number(projections->y_at, 2, true));
    line.outcome = projections->overlap ? "overlap" : "apart";
    line.question =
        answers::made_by<OverlapTest>(at, "x_at", {{"piece", projections->piece}, {"other", projections->other}});
  }
  return line;
}

struct KnownTest {
  const char* step;
  const char* what;
  bool wants_behind;
};
constexpr std::array<KnownTest, 7> known_tests{{
    {"test_1", "1 x extents", false},
    {"test_2", "2 y extents", false},
    {"test_3", "3 P behind Q", true},
    {"test_4", "4 Q in front", false},
    {"test_5", "5 projections", false},
    {"test_3_swapped", "3 Q behind P", true},
    {"test_4_swapped", "4 P in front", false},
}};

std::vector<TestLine> lines_of(const Session& s, const std::vector<RecordedEvent>& made) {
  std::vector<TestLine> lines;
  for (const KnownTest& known : known_tests) {
    const StepInfo* step = find_step(s.header().page, known.step);
    TestLine line;
    for (std::size_t i = 0; step && i < made.size(); ++i) {
      if (made[i].step != step->id) continue;
      line = line_of(s.position(), made[i].event, known.wants_behind);
      const bool last = i + 1 == made.size();
      line.now = last;
      // Coplanar pieces are ordered by their place in the file, so the pair is settled if no test follows.
      if (line.outcome == "in it") {
        const StepInfo* next = last ? nullptr : find_step(s.header().page, made[i + 1].step);
        line.passed = !next || !next->name.starts_with("test_");
      }
    }
    line.what = known.what;
    lines.push_back(std::move(line));
  }
  return lines;
}

float line_height(const ImFont& font) { return std::round(font.FontSize * 1.3f); }

}  // namespace

std::optional<std::vector<RecordedEvent>> since_pair(const Session& s) {
  std::vector<RecordedEvent> made;
  const std::int64_t first = std::max<std::int64_t>(1, s.position() - 200);  // a split makes events, too
  for (std::int64_t position = s.position(); position >= first; --position) {
    const RecordedEvent recorded = s.trace().event(position);
    if (holds<PairBegin>(recorded.event)) {
      std::reverse(made.begin(), made.end());
      return made;
    }
    if (holds<ListInsert>(recorded.event) || holds<PieceDraw>(recorded.event)) return std::nullopt;
    made.push_back(recorded);
  }
  return std::nullopt;
}

TestTable lay_out_tests(Ui& ui, const std::vector<RecordedEvent>& made, float room) {
  TestTable table;
  table.lines = lines_of(ui.session, made);
  if (!table.lines[5].made) table.lines.resize(5);
  table.gap = ui.em * 0.7f;
  for (const ImFont* font : {ui.fonts.mono, ui.fonts.small}) {
    table.font = font;
    // The numbers' column keeps a width, so that lines stay where they are while they fill.
    table.column = {text_size(ui, font, "5 projections").x,
                    text_size(ui, font, "15.25\u202615.25 | 15.25\u202615.25").x,
                    text_size(ui, font, "\u2713 both sides").x};
    for (const TestLine& line : table.lines)
      table.column[1] = std::max(table.column[1], text_size(ui, font, line.numbers).x);
    table.width = table.column[0] + table.column[1] + table.column[2] + 2 * table.gap + ui.em * 0.7f;
    if (table.width <= room) break;
  }
  if (table.width > room) {  // the mark alone says what came out
    table.words = false;
    table.width -= table.column[2];
    table.column[2] = text_size(ui, table.font, "\u2713").x;
    table.width += table.column[2];
  }
  table.height = line_height(*ui.fonts.bold) + line_height(*table.font) * to_float(table.lines.size());
  return table;
}

void draw_tests(Ui& ui, const PairBegin& pair, const TestTable& table) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  const Theme& c = ui.colors();
  const float height = line_height(*table.font);
  ImDrawList* list = ImGui::GetWindowDrawList();
  draw_text(ui, ImGui::GetCursorScreenPos(), ui.fonts.bold, c.text,
            fmt::format("May P = {} come before Q = {}?", piece_label(s.scene(), machine, pair.piece),
                        piece_label(s.scene(), machine, pair.other)));
  ImGui::Dummy({table.width, line_height(*ui.fonts.bold)});
  for (std::size_t i = 0; i < table.lines.size(); ++i) {
    const TestLine& line = table.lines[i];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (line.now) {
      list->AddRectFilled(at, {at.x + table.width, at.y + height}, c.now_soft);
      list->AddRectFilled(at, {at.x + 3, at.y + height}, c.now);
    }
    if (i == 5) list->AddRectFilled({at.x, at.y}, {at.x + table.width, at.y + 1}, c.rule);
    const ImU32 color = line.made ? c.text : c.muted;
    float x = at.x + ui.em * 0.4f;
    draw_text(ui, {x, at.y}, table.font, color, line.what);
    x += table.column[0] + table.gap;
    draw_text(ui, {x, at.y}, table.font, color, line.numbers);
    if (line.question && !line.numbers.empty())
      number_at(ui, {x - 2, at.y}, {x + text_size(ui, table.font, line.numbers).x + 2, at.y + height}, *line.question);
    x += table.column[1] + table.gap;
    if (line.made)
      draw_text(ui, {x, at.y}, table.font, line.passed ? c.good : c.text,
                (line.passed ? "\u2713" : "\u2717") + (table.words ? " " + line.outcome : ""));
    ImGui::Dummy({table.width, height});
    if (line.now) follow(ui, at.y, height);
  }
}

namespace {

ImU32 chip_of(const Session& s, std::int32_t polygon) {
  const std::size_t at = polygon;
  return polygon >= 0 && at < s.scene().polygons.size() ? to_im(opaque(s.scene().polygons[at].color)) : 0;
}

std::int32_t polygon_of(const MethodState& machine, std::int32_t piece) {
  const std::size_t at = piece;
  return piece >= 0 && at < machine.pieces.size() ? machine.pieces[at].polygon : no_polygon;
}

void draw_chip(Ui& ui, ImVec2 at, float height, ImU32 color) {
  const float side = std::round(ui.em * 0.55f), y = at.y + std::round((height - side) / 2);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({at.x, y}, {at.x + side, y + side}, color);
  frame_box(ui, {at.x, y}, {at.x + side, y + side}, ui.colors().text);
}

struct Axis3 {
  double near = 0, far = 1;
};

/// From the nearest to the farthest z of all pieces, so that bars stay where they are while the list grows shorter.
Axis3 axis_of(const MethodState& machine) {
  Axis3 axis{1, -1};
  for (const Piece& piece : machine.pieces) {
    if (!piece.extent) continue;
    if (axis.near > axis.far) axis = {piece.extent->z_min, piece.extent->z_max};
    axis.near = std::min(axis.near, piece.extent->z_min);
    axis.far = std::max(axis.far, piece.extent->z_max);
  }
  if (!(axis.near < axis.far)) axis = {axis.near - 1, axis.near + 1};
  return axis;
}

/// What the list shows of each piece: its place in the order of painting and how far away it is.
std::vector<TableRow> list_rows(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  const std::vector<std::string> labels = piece_labels(s.scene(), machine);
  std::vector<TableRow> rows;
  const auto row_of = [&](std::int32_t number, std::string place) {
    const std::size_t at = number;
    if (number < 0 || at >= labels.size()) return;
    TableRow row;
    row.about = labels[at];
    row.cells.push_back(TableCell::result_of(std::move(place)));
    const auto& extent = machine.pieces[at].extent;
    row.cells.push_back(extent ? TableCell(extent->z_max) : TableCell());
    row.cells.push_back(extent ? TableCell(extent->z_min) : TableCell());
    rows.push_back(std::move(row));
  };
  std::size_t place = machine.drawn.size();
  for (const ListEntry& entry : machine.list) row_of(entry.piece, fmt::format("place {}", ++place));
  return rows;
}

/// Where things stand in the rows of the list, from a row's left end.
struct Rows {
  Axis3 axis;
  std::int32_t p = -1, q = -1, touched = -1;  ///< pieces
  float height = 0, room = 0, tag = 0, name = 0, bars_left = 0, bars = 0;
  std::vector<std::string> labels;  ///< by piece
  ChangedParts changed;
  std::string label(std::int32_t piece) const {
    const std::size_t at = piece;
    return piece >= 0 && at < labels.size() ? labels[at] : fmt::format("piece {}", piece);
  }
  float x_of(double z) const { return bars_left + static_cast<float>((axis.far - z) / (axis.far - axis.near)) * bars; }
};

Rows lay_out_rows(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  Rows rows;
  rows.axis = axis_of(machine);
  if (machine.pair) rows.p = machine.pair->piece, rows.q = machine.pair->other;
  if (const RecordedEvent* event = s.event()) {
    if (const auto* e = get_if<ListInsert>(&event->event)) rows.touched = e->piece;
    if (const auto* e = get_if<ListMark>(&event->event)) rows.touched = e->piece;
    if (const auto* e = get_if<PieceDraw>(&event->event)) rows.touched = e->piece;
  }
  if (rows.touched < 0) rows.touched = machine.piece;  // while it is painted
  rows.height = std::round(ui.fonts.mono->FontSize * 1.35f);
  rows.room = ImGui::GetContentRegionAvail().x - ui.em;  // a scroll bar may come and go
  rows.tag = text_size(ui, ui.fonts.bold, "Q").x + ui.em * 0.5f;
  rows.labels = piece_labels(s.scene(), machine);
  rows.changed = changed_parts(ui, list_rows);
  rows.name = text_size(ui, ui.fonts.mono, "C").x;
  for (const ListEntry& entry : machine.list)
    rows.name = std::max(rows.name, text_size(ui, ui.fonts.mono, rows.label(entry.piece)).x);
  const float mark = text_size(ui, ui.fonts.mono, "\u25cf").x + ui.em * 0.4f;
  rows.bars_left = ui.em * 0.4f + rows.tag + ui.em * 0.75f + rows.name + ui.em * 0.4f + mark;
  rows.bars = std::max(20.0f, rows.room - rows.bars_left - ui.em * 0.3f);
  return rows;
}

void draw_axis(Ui& ui, const Rows& rows) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const ImVec2 head = ImGui::GetCursorScreenPos();
  const std::string far = fmt::format("far {}", number(rows.axis.far, 3, true)),
                    near = fmt::format("near {}", number(rows.axis.near, 3, true));
  draw_text(ui, {head.x + ui.em * 0.4f, head.y}, ui.fonts.small, c.muted,
            depth_symbol(s.scene(), s.header().conventions));
  draw_text(ui, {head.x + rows.bars_left, head.y}, ui.fonts.small, c.muted, far);
  if (text_size(ui, ui.fonts.small, far + near).x + ui.em < rows.bars)
    draw_text(ui, {head.x + rows.bars_left + rows.bars - text_size(ui, ui.fonts.small, near).x, head.y}, ui.fonts.small,
              c.muted, near);
  ImGui::Dummy({rows.room, std::round(ui.fonts.small->FontSize * 1.3f)});
  const float bottom = ImGui::GetCursorScreenPos().y;
  ImGui::GetWindowDrawList()->AddRectFilled({head.x, bottom - 1}, {head.x + rows.room, bottom}, c.rule);
}

/// From where it stood before the step, while that is on its way.
ImVec2 place_of_row(Ui& ui, std::int32_t piece, ImVec2 at, ImVec2 size) {
  ui.row_places[{"list", piece}] = {at, size};
  const auto before = ui.rows_before.find({"list", piece});
  if (ui.arrived == 1 || before == ui.rows_before.end() || before->second.at.y == at.y) return at;
  return moved_by(at, 0, (before->second.at.y - at.y) * (1 - ui.on_way()));
}

void draw_row(Ui& ui, const Rows& rows, const ListEntry& entry) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 at = place_of_row(ui, entry.piece, ImGui::GetCursorScreenPos(), {rows.room, rows.height});
  const std::size_t number_of = entry.piece;
  const Piece* piece = number_of < machine.pieces.size() ? &machine.pieces[number_of] : nullptr;
  const bool is_p = entry.piece == rows.p, is_q = entry.piece == rows.q;
  ImGui::Dummy({rows.room, rows.height});
  if (ImGui::IsItemHovered() && piece && piece->extent)
    tooltip(ui, {fmt::format("least z = {}", exact(piece->extent->z_min)),
                 fmt::format("farthest z = {}", exact(piece->extent->z_max)),
                 entry.marked ? "\u25cf marked: it was moved" : "not marked"});
  if (entry.piece == rows.touched) {
    list->AddRectFilled(at, {at.x + rows.room, at.y + rows.height}, c.now_soft);
    list->AddRectFilled(at, {at.x + 3, at.y + rows.height}, c.now);
  } else if (is_p || is_q) {
    list->AddRectFilled(at, {at.x + rows.room, at.y + rows.height}, c.selected_soft);
  }
  float x = at.x + ui.em * 0.4f;
  if (is_p || is_q) draw_text(ui, {x, at.y + 1}, ui.fonts.bold, c.text, is_p ? "P" : "Q");
  x += rows.tag;
  draw_chip(ui, {x, at.y}, rows.height, chip_of(s, polygon_of(machine, entry.piece)));
  mark_part(ui, rows.changed, rows.label(entry.piece), {x - ui.em * 0.3f, at.y},
            {at.x + rows.bars_left, at.y + rows.height - 1});
  x += ui.em * 0.75f;
  draw_text(ui, {x, at.y + 1}, ui.fonts.mono, c.text, rows.label(entry.piece));
  x += rows.name + ui.em * 0.4f;
  if (entry.marked) draw_text(ui, {x, at.y + 1}, ui.fonts.mono, c.now, "\u25cf");
  if (!piece || !piece->extent) return;
  const float from = at.x + rows.x_of(piece->extent->z_max),
              to = std::max(from + 2, at.x + rows.x_of(piece->extent->z_min));
  const float top = at.y + std::round(rows.height * 0.22f), bottom = at.y + std::round(rows.height * 0.8f);
  list->AddRectFilled({from, top}, {to, bottom}, chip_of(s, piece->polygon));
  frame_box(ui, {from, top}, {to, bottom}, c.text, is_p || is_q ? 2.0f : 1.0f);
  number_at(ui, {from, top}, {to, bottom}, answers::made_by<Extent>(s.position(), "z_max", {{"piece", entry.piece}}));
}

/// What reaches farther than P's nearest z must be held against P: a dashed line from `top` to the cursor.
void draw_reach(Ui& ui, const Rows& rows, ImVec2 top) {
  const auto& pieces = ui.session.state().machine.pieces;
  const std::size_t at = rows.p;
  if (rows.p < 0 || at >= pieces.size() || !pieces[at].extent) return;
  const float x = top.x + rows.x_of(pieces[at].extent->z_min);
  const float shown = ImGui::GetWindowPos().y, above = std::max(0.0f, std::floor((shown - top.y) / 8)) * 8;
  const float bottom = std::min(ImGui::GetCursorScreenPos().y, shown + ImGui::GetWindowHeight());
  for (float y = top.y + above; y < bottom; y += 8)
    ImGui::GetWindowDrawList()->AddRectFilled({x - 1, y}, {x + 1, std::min(y + 5, bottom)}, ui.colors().selected);
}

void draw_list(Ui& ui) {
  const auto& entries = ui.session.state().machine.list;
  const Rows rows = lay_out_rows(ui);
  draw_axis(ui, rows);
  // The first of the list is P: it stays in sight while the others scroll.
  const bool testing = entries.begin()->piece == rows.p;
  ImVec2 top = ImGui::GetCursorScreenPos();
  draw_row(ui, rows, *entries.begin());
  if (testing) draw_reach(ui, rows, top);
  ImGui::BeginChild("others", {0, 0}, false, ImGuiWindowFlags_None);
  top = ImGui::GetCursorScreenPos();
  const std::vector<ListEntry> others(std::next(entries.begin()), entries.end());
  for (std::size_t row = 0; row < others.size(); ++row)
    if (others[row].piece == rows.touched || others[row].piece == rows.q)
      follow(ui, top.y + to_float(row) * rows.height, rows.height);
  ImGuiListClipper clipper;
  clipper.Begin(size32(others), rows.height);
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) draw_row(ui, rows, others[row]);
  if (testing) draw_reach(ui, rows, top);
  ImGui::EndChild();
}

void draw_drawing_list(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  if (machine.list.empty())
    return say_empty(ui, !machine.drawn.empty()
                             ? "Empty: everything is drawn."
                             : "Empty: when all polygons have been viewed they enter it, the farthest first.");
  const ImVec2 avail = ImGui::GetContentRegionAvail();
  const auto made = machine.pair && find_step(s.header().page, "test_1") ? since_pair(s) : std::nullopt;
  const float least_list = ui.em * 14;
  // Side by side where there is room, else the tests above the list; both keep to their place.
  const TestTable table = lay_out_tests(ui, made.value_or(std::vector<RecordedEvent>{}), avail.x - least_list - ui.em);
  const bool beside =
      find_step(s.header().page, "test_1") && table.words && table.width + least_list + ui.em <= avail.x;
  const float row = std::round(ui.fonts.mono->FontSize * 1.35f);
  if (!beside && made) {
    const TestTable above = lay_out_tests(ui, *made, avail.x);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGui::BeginChild("tests", {avail.x, std::min(above.height + 2, std::max(2 * row, avail.y - 4 * row))}, false,
                      ImGuiWindowFlags_None);
    draw_tests(ui, *machine.pair, above);
    ImGui::EndChild();
    ImGui::PopStyleVar();
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::BeginChild("list", {beside ? avail.x - table.width - ui.em : 0, 0}, false, ImGuiWindowFlags_None);
  draw_list(ui);
  ImGui::EndChild();
  if (beside && made) {
    ImGui::SameLine(0, ui.em);
    ImGui::BeginChild("tests", {0, 0}, false, ImGuiWindowFlags_None);
    draw_tests(ui, *machine.pair, table);
    ImGui::EndChild();
  }
  ImGui::PopStyleVar();
}

std::string note_of_drawing_list(Ui& ui) {
  const MethodState& machine = ui.session.state().machine;
  if (machine.list.empty() && machine.drawn.empty()) return "";
  // The one that is being drawn has left its place in neither.
  const auto done = std::count_if(machine.drawn.begin(), machine.drawn.end(), [&](std::int32_t piece) {
    return std::none_of(machine.list.begin(), machine.list.end(),
                        [&](const ListEntry& entry) { return entry.piece == piece; });
  });
  return fmt::format("{} to go, {} drawn", machine.list.size(), done);
}

bool serves_drawing_list(const Header& header) { return records<ListInsert>(header); }

}  // namespace

const Pane drawing_list_pane{
    "drawing_list", "DRAWING LIST", draw_drawing_list,   note_of_drawing_list, serves_drawing_list, 0.7f, false,
    always<15>,     false,          none_yet<ListInsert>};

}  // namespace zstep::viewer
