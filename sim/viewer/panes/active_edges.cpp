// The active edge list, left to right, with the edge that enters, steps or leaves. Where all polygons are at work at
// once, the next edges of the global table wait below.
#include <algorithm>

#include <fmt/format.h>

#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/explain.hpp"

namespace zstep::viewer {
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
  const auto at = static_cast<std::size_t>(edge);
  const auto& table = s.state().machine.edge_table;
  return edge >= 0 && at < table.size() ? edge_label(s.scene(), table[at]) : fmt::format("e{}", edge);
}

/// The name of an edge; with its polygon's colour where the list holds edges of several.
TableCell name_of(const Session& s, std::int32_t edge) {
  const MethodState& machine = s.state().machine;
  TableCell cell(label_of(s, edge));
  const auto at = static_cast<std::size_t>(edge);
  if (!machine.keeps_all || edge < 0 || at >= machine.edge_table.size()) return cell;
  const auto polygon = static_cast<std::size_t>(machine.edge_table[at].polygon);
  if (polygon < s.scene().polygons.size()) cell.chip = to_im(opaque(s.scene().polygons[polygon].color));
  return cell;
}

/// The edges of the global table that enter next.
std::vector<TableRow> waiting_rows(const Session& s) {
  constexpr std::size_t enough = 24;
  const MethodState& machine = s.state().machine;
  std::vector<const EdgeTableInsert*> waiting;
  for (const EdgeTableInsert& entry : machine.edge_table)
    if (machine.edge_stages[static_cast<std::size_t>(entry.edge)] == EdgeStage::waiting) waiting.push_back(&entry);
  const auto sooner = [](const EdgeTableInsert* a, const EdgeTableInsert* b) {
    return std::make_pair(a->first_row, a->edge) < std::make_pair(b->first_row, b->edge);
  };
  const std::size_t count = std::min(enough, waiting.size());
  std::partial_sort(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count), waiting.end(), sooner);
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
  const auto at = static_cast<std::size_t>(active.edge);
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

std::vector<TableRow> rows_of(Ui& ui) {
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

void draw_active_edges(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  const std::vector<TableRow> rows = rows_of_both(ui, rows_of);
  if (rows.empty())
    return say_empty(ui, machine.scan_line
                             ? fmt::format("Empty: no edge crosses scan line {} at this moment.", *machine.scan_line)
                         : machine.edge_table.empty()
                             ? std::string("Empty: it fills when scan conversion reaches an edge's first scan line.")
                             : std::string("Empty: edges enter when the scan line reaches their bucket."));
  const std::string z = symbol_along(s.scene(), s.header().conventions);
  const TableResult result = number_table(ui, "active", {"edge", "x", z, "leaves", ""}, rows);
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
  return has_step_of<EdgeEnter>(header) && !has_step_of<ShadowCompare>(header) && !has_step_of<ListInsert>(header) &&
         !has_step_of<NodeMake>(header);
}

}  // namespace

const Pane active_edges_pane{
    "active_edges", "ACTIVE EDGES", draw_active_edges,   note_of_active_edges, serves_active_edges, 0.27f, true,
    nullptr,        false,          none_yet<EdgeEnter>, &edge_table_pane};

}  // namespace zstep::viewer
