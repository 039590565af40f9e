// The edge table of the polygon at work, in buckets by first scan line.
#include <algorithm>

#include <fmt/format.h>

#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/explain.hpp"

namespace zstep::viewer {
namespace {

/// The edge that the current event is about, if it is about one.
std::optional<std::int32_t> edge_now(const RecordedEvent* event) {
  if (!event) return std::nullopt;
  if (const auto* e = get_if<EdgeTableInsert>(&event->event)) return e->edge;
  if (const auto* e = get_if<EdgeEnter>(&event->event)) return e->edge;
  if (const auto* e = get_if<EdgeStep>(&event->event)) return e->edge;
  if (const auto* e = get_if<EdgeRetire>(&event->event)) return e->edge;
  return std::nullopt;
}

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
    const EdgeStage stage = machine.edge_stages[static_cast<std::size_t>(e.edge)];
    TableRow out;
    const bool is_now = now == e.edge;
    const auto asks = [&](const char* field) {
      return answers::made_by<EdgeTableInsert>(s.position(), field, {{"edge", e.edge}});
    };
    out.cells = {bucket == e.first_row ? std::string() : fmt::format("{}", e.first_row),
                 with_sign(trust_of(ui, formulas::Place::In::edge_table, e.edge), edge_label(s.scene(), e)),
                 TableCell(static_cast<double>(e.end_row), asks("end_row")),
                 TableCell(e.x_edge, asks("x_edge")),
                 TableCell(e.dx_dy, asks("dx_dy")),
                 TableCell(e.z_edge, asks("z_edge")),
                 TableCell(e.dz_dy, asks("dz_dy")),
                 TableCell(polygon_label(s.scene(), e.polygon),
                           e.polygon >= 0 && static_cast<std::size_t>(e.polygon) < s.scene().polygons.size()
                               ? to_im(opaque(s.scene().polygons[static_cast<std::size_t>(e.polygon)].color))
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
  return has_step_of<EdgeTableInsert>(header) && !has_step_of<ShadowCompare>(header) &&
         !has_step_of<ListInsert>(header) && !has_step_of<FlagFlip>(header) && !has_step_of<NodeMake>(header);
}

}  // namespace

const Pane edge_table_pane{
    "edge_table", "EDGE TABLE", draw_edge_table, note_of_edge_table,        serves_edge_table, 0.42f,
    true,         nullptr,      false,           none_yet<EdgeTableInsert>, &active_edges_pane};

}  // namespace zstep::viewer
