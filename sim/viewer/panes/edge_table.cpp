// The edge table of the polygon at work, in buckets by first scan line, and the active edges.

#include <algorithm>
#include <fmt/format.h>

#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/explain.hpp"

namespace zstep::viewer {
namespace {

std::string state_word(EdgeStage stage, bool now, const RecordedEvent* event) {
  if (now && holds<EdgeTableInsert>(event->event)) return "\u2190 new";
  if (now && holds<EdgeEnter>(event->event)) return "\u2192 enters";
  if (now && holds<EdgeRetire>(event->event)) return "\u2717 leaves";
  switch (stage) {
    case EdgeStage::waiting:
      return "waits";
    case EdgeStage::active:
      return "active";
    case EdgeStage::retired:
      return "done";
  }
  return "";
}

/// The same in one character.
std::string state_sign(EdgeStage stage, bool now, const RecordedEvent* event) {
  const std::string word = state_word(stage, now, event);
  if (word == "waits") return "\u00b7";
  if (word == "active") return "\u25b6";
  if (word == "done") return "\u2713";
  return word.substr(0, word.find(' '));
}

std::vector<TableRow> rows_of(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  std::vector<const EdgeTableInsert*> order;
  for (const EdgeTableInsert& entry : machine.edge_table) order.push_back(&entry);
  std::stable_sort(order.begin(), order.end(), [](const EdgeTableInsert* a, const EdgeTableInsert* b) {
    return std::make_pair(a->first_row, a->x_edge) < std::make_pair(b->first_row, b->x_edge);
  });
  const auto now = edge_now(s.event());
  std::vector<TableRow> rows;
  std::optional<std::int32_t> bucket;
  for (const EdgeTableInsert* entry : order) {
    const EdgeTableInsert& e = *entry;
    const EdgeStage stage = machine.edge_stages[e.edge];
    TableRow out;
    const bool is_now = now == e.edge;
    const auto asks = [&](const char* field) {
      return answers::made_by<EdgeTableInsert>(s.position(), field, {{"edge", e.edge}});
    };
    out.cells = {
        bucket == e.first_row ? std::string() : fmt::format("{}", e.first_row),
        with_sign(trust_of(ui, formulas::Place::In::edge_table, e.edge), edge_label(s.scene(), e)),
        TableCell(static_cast<double>(e.end_row), asks("end_row")),
        TableCell(e.x_edge, asks("x_edge")),
        TableCell(e.dx_dy, asks("dx_dy")),
        TableCell(e.z_edge, asks("z_edge")),
        TableCell(e.dz_dy, asks("dz_dy")),
        TableCell(polygon_label(s.scene(), e.polygon), e.polygon >= 0 && e.polygon < std::ssize(s.scene().polygons)
                                                           ? to_im(opaque(s.scene().polygons[e.polygon].color))
                                                           : 0),
        state_word(stage, is_now, s.event())};
    bucket = e.first_row;
    for (TableCell& cell : out.cells) cell.changed = is_now && cell.value && holds<EdgeTableInsert>(s.event()->event);
    out.cells.back().brief = state_sign(stage, is_now, s.event());
    out.look = is_now                        ? TableRow::Look::now
               : stage == EdgeStage::retired ? TableRow::Look::gone
                                             : TableRow::Look::plain;
    out.trust = trust_of(ui, formulas::Place::In::edge_table, e.edge);
    out.lit = s.lit_edge() == e.edge;
    out.key = e.edge;
    out.about = about_edge(e);
    out.name = 1;
    rows.push_back(std::move(out));
  }
  return rows;
}

void draw_edge_table(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  if (machine.polygon == no_polygon)
    return say_empty(ui, "Empty: no polygon is at work yet. Each polygon fills it with its own edges.");
  if (machine.edge_table.empty())
    return say_empty(ui, machine.rejected ? fmt::format("Empty: polygon {} was dropped before it got here.",
                                                        polygon_label(s.scene(), machine.polygon))
                                          : fmt::format("Empty: the edges of polygon {} are not in it yet.",
                                                        polygon_label(s.scene(), machine.polygon)));
  const std::vector<TableRow> rows = rows_of_both(ui, rows_of);
  const std::string z = symbol_along(s.scene(), s.header().conventions);
  const TableResult result = number_table(ui, "edges", {"y", "edge", "leaves", "x", "1/m", z, "dz/dy", "of", ""}, rows);
  if (result.hovered) {
    ui.hovered_edge_next = result.hovered;
    if (!result.on_number) ui.mouse_help = "Click: keep this edge lit in every pane.";
  }
  if (result.clicked) {
    ui.session.selected_edge = s.selected_edge == result.clicked ? std::nullopt : result.clicked;
  }
}

std::string note_of_edge_table(Ui& ui) {
  const std::size_t edges = ui.session.state().machine.edge_table.size();
  return edges == 0 ? "" : edges == 1 ? "1 edge" : fmt::format("{} edges", edges);
}

// A method with a shadow buffer, a list of pieces, a tree or a polygon table needs the room for that. An edge table of
// all polygons is shown below the active edges.
bool serves_edge_table(const Header& header) {
  return records<EdgeTableInsert>(header) && !records<ShadowCompare>(header) && !records<ListInsert>(header) &&
         !records<FlagFlip>(header) && !records<NodeMake>(header);
}

}  // namespace

const Pane edge_table_pane{
    "edge_table", "EDGE TABLE", draw_edge_table, note_of_edge_table,        serves_edge_table, 0.42f,
    true,         nullptr,      false,           none_yet<EdgeTableInsert>, &active_edges_pane};

// The active edge list, left to right, with the edge that enters, steps or leaves. Where all polygons are at work at
// once, the next edges of the global table wait below.

namespace {

struct Mark {
  std::string word;
  bool now = false;
};

Mark mark_of(const MethodState& machine, const RecordedEvent* event, std::size_t place) {
  const std::int32_t edge = machine.active[place].edge;
  if (event) {
    if (const auto* e = get_if<EdgeEnter>(&event->event); e && e->edge == edge) return {"\u2192 enters", true};
    if (const auto* e = get_if<EdgeStep>(&event->event); e && e->edge == edge) return {"\u2193 steps", true};
    if (const auto* e = get_if<EdgeSwap>(&event->event);
        e && (place == static_cast<std::size_t>(e->place) || place == static_cast<std::size_t>(e->place) + 1))
      return {"\u2195 swapped", true};
  }
  const bool on_event = event && holds<SpanBegin>(event->event);
  if (machine.span && machine.scan_line == machine.span->y) {
    if (machine.span->left_edge == edge) return {"left", on_event};
    if (machine.span->right_edge == edge) return {"right", on_event};
  }
  return {};
}

std::string label_of(const Session& s, std::int32_t edge) {
  const std::size_t at = edge;
  const auto& table = s.state().machine.edge_table;
  return edge >= 0 && at < table.size() ? edge_label(s.scene(), table[at]) : fmt::format("e{}", edge);
}

/// The name of an edge; with its polygon's colour where the list holds edges of several.
TableCell name_of(const Session& s, std::int32_t edge) {
  const MethodState& machine = s.state().machine;
  TableCell cell(label_of(s, edge));
  const std::size_t at = edge;
  if (!machine.keeps_all || edge < 0 || at >= machine.edge_table.size()) return cell;
  const std::size_t polygon = machine.edge_table[at].polygon;
  if (polygon < s.scene().polygons.size()) cell.chip = to_im(opaque(s.scene().polygons[polygon].color));
  return cell;
}

/// The edges of the global table that enter next.
std::vector<TableRow> waiting_rows(const Session& s) {
  constexpr std::size_t enough = 24;
  const MethodState& machine = s.state().machine;
  std::vector<const EdgeTableInsert*> waiting;
  for (const EdgeTableInsert& entry : machine.edge_table)
    if (machine.edge_stages[entry.edge] == EdgeStage::waiting) waiting.push_back(&entry);
  const auto sooner = [](const EdgeTableInsert* a, const EdgeTableInsert* b) {
    return std::make_pair(a->first_row, a->edge) < std::make_pair(b->first_row, b->edge);
  };
  const std::size_t count = std::min(enough, waiting.size());
  std::partial_sort(waiting.begin(), waiting.begin() + count, waiting.end(), sooner);
  std::vector<TableRow> rows;
  const auto insert = s.event() ? get_if<EdgeTableInsert>(&s.event()->event) : nullptr;
  for (std::size_t k = 0; k < count; ++k) {
    const EdgeTableInsert& e = *waiting[k];
    TableRow row;
    const auto asks = [&](const char* field) {
      return answers::made_by<EdgeTableInsert>(s.position(), field, {{"edge", e.edge}});
    };
    row.cells = {name_of(s, e.edge), TableCell(e.x_edge, asks("x_edge")), TableCell(e.z_edge, asks("z_edge")),
                 TableCell(static_cast<double>(e.end_row), asks("end_row")),
                 fmt::format("waits for y = {}", e.first_row)};
    row.cells.back().brief = fmt::format("y {}", e.first_row);
    row.look = insert && insert->edge == e.edge ? TableRow::Look::now : TableRow::Look::gone;
    row.lit = s.lit_edge() == e.edge;
    row.key = e.edge;
    row.about = about_edge(e);
    rows.push_back(std::move(row));
  }
  return rows;
}

TableRow row_of(const Session& s, const ActiveEdge& active, const Mark& mark) {
  const MethodState& machine = s.state().machine;
  TableRow row;
  const std::size_t at = active.edge;
  const EdgeTableInsert* entry = active.edge >= 0 && at < machine.edge_table.size() ? &machine.edge_table[at] : nullptr;
  const auto asks = [&](const char* field) {
    return answers::made_by<EdgeStep, EdgeTableInsert>(s.position(), field, {{"edge", active.edge}});
  };
  row.cells = {name_of(s, active.edge), TableCell(active.x, asks("x_edge")), TableCell(active.z, asks("z_edge"))};
  if (entry)
    row.cells.emplace_back(static_cast<double>(entry->end_row),
                           answers::made_by<EdgeTableInsert>(s.position(), "end_row", {{"edge", active.edge}}));
  else row.cells.emplace_back(std::string());
  row.cells.emplace_back(mark.word);
  row.cells.back().brief = mark.word == "left"    ? "L"
                           : mark.word == "right" ? "R"
                                                  : mark.word.substr(0, mark.word.find(' '));
  if (mark.now && holds<EdgeStep>(s.event()->event)) row.cells[1].changed = row.cells[2].changed = true;
  if (mark.now && holds<EdgeEnter>(s.event()->event))
    for (TableCell& cell : row.cells) cell.changed = cell.value.has_value();
  row.look = mark.now ? TableRow::Look::now : TableRow::Look::plain;
  row.lit = s.lit_edge() == active.edge;
  row.key = active.edge;
  if (entry) row.about = about_edge(*entry);
  return row;
}

std::vector<TableRow> active_rows(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  std::vector<TableRow> rows;
  for (std::size_t place = 0; place < machine.active.size(); ++place) {
    TableRow row = row_of(s, machine.active[place], mark_of(machine, s.event(), place));
    row.trust = trust_of(ui, formulas::Place::In::active_edge, machine.active[place].edge);
    row.cells.front().text = with_sign(row.trust, row.cells.front().text);
    rows.push_back(std::move(row));
  }
  if (s.event())
    if (const auto* left = get_if<EdgeRetire>(&s.event()->event)) {
      // Gone from the list already; shown once more so that one sees it go.
      TableRow row;
      row.cells = {name_of(s, left->edge), std::string(), std::string(), std::string(), std::string("\u2717 leaves")};
      row.cells.back().brief = "\u2717";
      row.look = TableRow::Look::now;
      row.lit = s.lit_edge() == left->edge;
      row.key = left->edge;
      rows.push_back(std::move(row));
    }
  if (machine.keeps_all && machine.piece == -1)
    for (TableRow& row : waiting_rows(s)) rows.push_back(std::move(row));
  return rows;
}

/// Behind x by how much it changes from one scan line to the next.
void add_slopes(const Session& s, std::vector<TableRow>& rows) {
  const auto& table = s.state().machine.edge_table;
  for (TableRow& row : rows) {
    const auto at = static_cast<std::size_t>(row.key);  // without one beyond all
    row.cells.insert(row.cells.begin() + 2,
                     at < table.size() ? TableCell(table[at].dx_dy, answers::made_by<EdgeTableInsert>(
                                                                        s.position(), "dx_dy", {{"edge", row.key}}))
                                       : TableCell(std::string()));
  }
}

void draw_active_edges(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  std::vector<TableRow> rows = rows_of_both(ui, active_rows);
  if (rows.empty())
    return say_empty(ui, machine.scan_line
                             ? fmt::format("Empty: no edge crosses scan line {} at this moment.", *machine.scan_line)
                         : machine.edge_table.empty()
                             ? std::string("Empty: it fills when scan conversion reaches an edge's first scan line.")
                             : std::string("Empty: edges enter when the scan line reaches their bucket."));
  const std::string z = symbol_along(s.scene(), s.header().conventions);
  std::vector<std::string> headings{"edge", "x", z, "leaves", ""};
  // Where there is little room a depth that is the same everywhere gives way to the slope.
  const bool wide = ImGui::GetContentRegionAvail().x > 22 * ui.em;
  const auto& table = machine.edge_table;
  const bool flat = std::all_of(table.begin(), table.end(), [&](const EdgeTableInsert& edge) {
    return edge.dz_dy == 0 && edge.z_edge == (*table.begin()).z_edge;
  });
  if (flat && !wide) {
    headings.erase(headings.begin() + 2);
    for (TableRow& row : rows) row.cells.erase(row.cells.begin() + 2);
  }
  if (flat || wide) {
    headings.insert(headings.begin() + 2, "1/m");
    add_slopes(s, rows);
  }
  const TableResult result = number_table(ui, "active", headings, rows);
  if (result.hovered) ui.hovered_edge_next = result.hovered;
  if (result.clicked) {
    ui.session.selected_edge = s.selected_edge == result.clicked ? std::nullopt : result.clicked;
  }
}

std::string note_of_active_edges(Ui& ui) {
  const auto y = ui.session.state().machine.scan_line;
  return y ? fmt::format("y = {}", *y) : "";
}

bool serves_active_edges(const Header& header) {
  return records<EdgeEnter>(header) && !records<ShadowCompare>(header) && !records<ListInsert>(header) &&
         !records<NodeMake>(header);
}

}  // namespace

const Pane active_edges_pane{
    "active_edges", "ACTIVE EDGES", draw_active_edges,   note_of_active_edges, serves_active_edges, 0.27f, true,
    nullptr,        false,          none_yet<EdgeEnter>, &edge_table_pane};

}  // namespace zstep::viewer
