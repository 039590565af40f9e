// The BSP tree with each node's side of the eye: drawn whole while it is small, else as the path to the node at work.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/plan_frame.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/pieces.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

constexpr std::size_t largest_drawn = 24;  // nodes
constexpr std::size_t longest_path = 400;  // rows; of a longer one those next to the node at work

std::size_t at(std::int32_t number) { return number; }

/// Nodes of each subtree. A child is made after its parent, so it has the larger number.
std::vector<std::int32_t> subtree_sizes(const SharedChunks<TreeNode>& tree) {
  std::vector<std::int32_t> sizes(tree.size(), 1);
  for (std::size_t node = tree.size(); node-- > 1;)
    if (tree[node].parent >= 0) sizes[at(tree[node].parent)] += sizes[node];
  return sizes;
}

/// A node's pieces by name, "A" or "A, D".
std::string name_of(const Session& s, const TreeNode& node) {
  std::string text;
  for (const std::int32_t piece : node.pieces)
    text += (text.empty() ? "" : ", ") + piece_label(s.scene(), s.state().machine, piece);
  return text;
}

ImU32 color_of_node(const Session& s, const TreeNode& node) {
  const MethodState& m = s.state().machine;
  if (node.pieces.empty() || at(node.pieces[0]) >= m.pieces.size()) return 0;
  const auto polygon = at(m.pieces[at(node.pieces[0])].polygon);
  return polygon < s.scene().polygons.size() ? to_im(opaque(s.scene().polygons[polygon].color)) : 0;
}

struct Place {
  float column = 0;  ///< in nodes from the left, the order in which front comes before back
  int row = 0;
};

/// In-order columns: front subtree, node, back subtree.
std::vector<Place> places_of(const SharedChunks<TreeNode>& tree) {
  std::vector<Place> places(tree.size());
  std::vector<std::pair<std::int32_t, bool>> stack;
  float column = 0;
  if (!tree.empty()) stack.emplace_back(0, false);
  while (!stack.empty()) {
    const auto [node, entered] = stack.back();
    stack.pop_back();
    const TreeNode& one = tree[at(node)];
    if (one.parent >= 0) places[at(node)].row = places[at(one.parent)].row + 1;
    if (entered) {
      places[at(node)].column = column++;
      continue;
    }
    if (one.back_child >= 0) stack.emplace_back(one.back_child, false);
    stack.emplace_back(node, true);
    if (one.front_child >= 0) stack.emplace_back(one.front_child, false);
  }
  return places;
}

/// The side that the eye is on, as a sign beside the node: an arrowhead towards the front (left) or the back child.
void draw_eye(ImDrawList* list, ImVec2 low, ImVec2 high, bool front, ImU32 color) {
  const float half = (high.y - low.y) / 2, reach = half * 0.9f, y = low.y + half;
  const float x = front ? low.x - 3 : high.x + 3, tip = front ? x - reach : x + reach;
  for (float k = 0; k <= half; k += 0.5f) {
    const float part = 1 - k / half;
    stroke_line(list, {x, y - k}, {x + (tip - x) * part, y - k}, color, 1);
    stroke_line(list, {x, y + k}, {x + (tip - x) * part, y + k}, color, 1);
  }
}

/// By piece, whether it turned its back to the eye when its node was gone through, and was not drawn.
std::vector<bool> turned_away(const Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  std::vector<bool> away(m.pieces.size(), false);
  if (!s.header().conventions.cull || s.scene().camera.kind != Camera::Kind::perspective) return away;
  // Not yet gone through: nodes whose far side, or they themselves, the eye was held against last.
  std::vector<std::int32_t> waiting;
  for (std::int32_t node = m.node, from = -1; node >= 0 && s.position() < s.size();
       from = node, node = m.tree[at(node)].parent) {
    const TreeNode& one = m.tree[at(node)];
    if (!one.eye || (from >= 0 && from == (one.eye->front ? one.front_child : one.back_child))) continue;
    waiting.push_back(node);
    for (const std::int32_t piece : one.pieces)
      if (std::find(m.drawn.begin(), m.drawn.end(), piece) != m.drawn.end()) waiting.clear();
  }
  const auto* reject = s.event() ? get_if<PolygonReject>(&s.event()->event) : nullptr;
  const std::int32_t now = reject ? node_at_work(m, &s.event()->event) : -1;
  for (std::size_t node = 0; node < m.tree.size(); ++node) {
    const TreeNode& one = m.tree[node];
    const bool waits = std::find(waiting.begin(), waiting.end(), index32(node)) != waiting.end();
    if (!one.eye || one.front_skipped || one.back_skipped || (waits && index32(node) != now)) continue;
    for (const std::int32_t number : one.pieces) {
      if (at(number) >= m.pieces.size()) continue;
      const Piece& piece = m.pieces[at(number)];
      const auto corner = cutting_point(s.scene(), s.state(), piece.outline.empty() ? -1 : piece.outline[0]);
      away[at(number)] = (!waits || reject->polygon == piece.polygon) && corner &&
                         glm::dot(front_of(s, piece), s.scene().camera.eye - *corner) < 0;
    }
  }
  return away;
}

std::string about_node(const Session& s, const TreeNode& node) { return name_of(s, node); }

/// What the tree shows of each node: where it hangs, and where the eye is.
std::vector<TableRow> node_rows(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  std::vector<TableRow> rows;
  for (std::size_t node = 0; node < m.tree.size(); ++node) {
    const TreeNode& one = m.tree[node];
    TableRow row;
    row.cells.emplace_back(name_of(s, one));
    row.cells.push_back(TableCell::result_of(
        one.parent < 0 ? "root"
                       : fmt::format("on the {} side of {}",
                                     m.tree[at(one.parent)].front_child == index32(node) ? "front" : "back",
                                     name_of(s, m.tree[at(one.parent)]))));
    row.cells.push_back(TableCell::result_of(!one.eye ? "" : one.eye->front ? "the eye in front" : "the eye behind"));
    row.about = about_node(s, one);
    rows.push_back(std::move(row));
  }
  return rows;
}

void draw_whole(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const Theme& c = ui.colors();
  const std::vector<Place> places = places_of(m.tree);
  const std::int32_t now = node_now(ui);
  int rows = 1;
  for (const Place& place : places) rows = std::max(rows, place.row + 1);

  const ImVec2 top = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const float legend = std::round(ui.fonts.small->FontSize * 1.3f);
  const float side = std::round(0.8f * ui.em);  // for an arrow at the border
  const float wide = (room.x - 2 * side) / to_float(places.size()), high = (room.y - legend) / to_float(rows);
  const ImFont* font = wide > ui.em * 2.4f ? ui.fonts.bold : ui.fonts.small;
  const float half_height = std::round(std::min(high * 0.36f, font->FontSize * 0.72f));
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto centre = [&](std::size_t node) {
    return ImVec2{std::round(top.x + side + wide * (places[node].column + 0.5f)),
                  std::round(top.y + high * (to_float(places[node].row) + 0.5f))};
  };

  for (std::size_t node = 0; node < places.size(); ++node) {
    const TreeNode& one = m.tree[node];
    for (const bool front : {true, false}) {
      const std::int32_t child = front ? one.front_child : one.back_child;
      if (child < 0) continue;
      const ImVec2 from = centre(node), to = centre(at(child));
      const bool near_side = one.eye && one.eye->front == front, skipped = front ? one.front_skipped : one.back_skipped;
      stroke_line(list, from, to, skipped ? c.rule : near_side ? c.text : c.muted, (near_side ? 2.5f : 1.2f) * ui.thin);
      const ImVec2 middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
      const std::string sign = skipped ? "discarded" : front ? "+" : "\u2212";
      const ImVec2 size = text_size(ui, ui.fonts.small, sign);
      const ImVec2 place{std::round(middle.x + (front ? -size.x - 5.0f : 5.0f)), std::round(middle.y - size.y * 0.75f)};
      draw_text(ui, place, ui.fonts.small, c.muted, sign);
    }
  }
  const std::vector<std::int32_t> draw_places = zstep::draw_places(m);
  const std::vector<bool> away = turned_away(ui);
  const ChangedParts changed = changed_parts(ui, node_rows);
  float lowest = top.y;  // that anything is written
  for (std::size_t node = 0; node < places.size(); ++node) {
    const TreeNode& one = m.tree[node];
    const std::string name = name_of(s, one);
    const float half = std::max(half_height * 1.2f, text_size(ui, font, name).x / 2 + 5);
    const ImVec2 middle = centre(node), low{middle.x - half, middle.y - half_height},
                 end{middle.x + half, middle.y + half_height};
    const bool lit = index32(node) == now;
    list->AddRectFilled(low, end, lit ? c.now_soft : c.pane);
    list->AddRectFilled({low.x, end.y - 4}, end, color_of_node(s, one));
    frame_box(ui, low, end, lit ? c.now : c.text, lit ? 3 : 1);
    draw_text(ui,
              {std::round(middle.x - text_size(ui, font, name).x / 2), std::round(middle.y - font->FontSize * 0.62f)},
              font, c.text, name);
    if (one.eye) number_at(ui, low, end, answers::made_by<EyeSide>(s.position(), "value", {{"node", index32(node)}}));
    mark_part(ui, changed, about_node(s, one), low, end);
    if (one.eye) draw_eye(list, low, end, one.eye->front, lit ? c.now : c.text);
    std::string turn, before;
    for (const std::int32_t piece : one.pieces) {
      if (at(piece) >= m.pieces.size()) continue;
      const std::string its = piece_label(s.scene(), m, piece);
      const float from = low.x + half - text_size(ui, font, name).x / 2 + text_size(ui, font, before).x;
      if (away[at(piece)])
        stroke_line(list, {from, middle.y}, {from + text_size(ui, font, its).x, middle.y}, c.text, 1.5f * ui.thin);
      before += its + ", ";
      if (draw_places[at(piece)] >= 0)
        turn += fmt::format("{}#{}", turn.empty() ? "" : ", ", draw_places[at(piece)] + 1);
    }
    lowest = std::max(lowest, end.y + (turn.empty() ? 0 : ui.fonts.small->FontSize));
    if (turn.empty()) continue;
    const ImVec2 size = text_size(ui, ui.fonts.small, turn), place{std::round(middle.x - size.x / 2), end.y + 1};
    list->AddRectFilled(place, {place.x + size.x, place.y + size.y}, c.pane);  // on lines to children
    draw_text(ui, place, ui.fonts.small, c.changed, turn);
  }
  // Of what the picture has, as much as there is room for.
  const bool has_eye = std::ranges::any_of(m.tree, [](const TreeNode&one) { return one.eye.has_value(); }),
             is_drawn = std::ranges::any_of(draw_places, [](std::int32_t place) { return place >= 0; }),
             any_away = std::find(away.begin(), away.end(), true) != away.end();
  std::string text, longer;
  for (const auto& [shown, words] : {std::pair(m.tree.size() > 1, "+ in front, \u2212 behind"),
                                     {has_eye, "arrow: the eye's side"},
                                     {is_drawn, "#1: drawn first"},
                                     {any_away, "struck out: back face"}}) {
    if (!shown) continue;
    longer = text + (text.empty() ? "" : "   ") + words;
    if (text_size(ui, ui.fonts.small, longer).x <= room.x) text = longer;
  }
  if (lowest <= top.y + room.y - legend) draw_text(ui, {top.x, top.y + room.y - legend}, ui.fonts.small, c.muted, text);
}

}  // namespace

std::vector<TableRow> path_rows(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const std::vector<std::int32_t> sizes = subtree_sizes(m.tree);
  const std::int32_t now = node_now(ui);
  std::vector<std::int32_t> path;
  for (std::int32_t node = now; node >= 0 && at(node) < m.tree.size(); node = m.tree[at(node)].parent) {
    path.push_back(node);
    if (path.size() == longest_path) break;
  }
  std::reverse(path.begin(), path.end());
  const auto count = [&](std::int32_t child) { return child >= 0 && at(child) < sizes.size() ? sizes[at(child)] : 0; };
  std::vector<TableRow> rows;
  for (const std::int32_t node : path) {
    const TreeNode& one = m.tree[at(node)];
    TableRow row;
    const char* hangs = one.parent < 0 ? "root" : m.tree[at(one.parent)].front_child == node ? "+" : "\u2212";
    row.cells = {TableCell(std::string(hangs)), TableCell(name_of(s, one), color_of_node(s, one))};
    row.cells.push_back(TableCell::result_of(one.eye ? one.eye->front ? "front" : "behind" : ""));
    row.about = row.cells[1].text;
    row.name = 1;
    if (one.eye)
      row.cells.emplace_back(one.eye->value, answers::made_by<EyeSide>(s.position(), "value", {{"node", node}}));
    else row.cells.emplace_back();
    row.cells.emplace_back(static_cast<double>(count(one.front_child)));
    row.cells.emplace_back(static_cast<double>(count(one.back_child)));
    row.look = node == now ? TableRow::Look::now : TableRow::Look::plain;
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

void draw_tree(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  if (m.tree.empty()) return say_empty(ui, "Empty: the tree grows once all polygons are gathered.");
  const std::vector<TableRow> rows = rows_of_both(ui, path_rows);
  // Where the two runs differ, the table says how.
  const bool differ =
      std::any_of(rows.begin(), rows.end(), [](const TableRow& row) { return row.look == TableRow::Look::other; });
  if (m.tree.size() <= largest_drawn && !differ &&
      ImGui::GetContentRegionAvail().x > ui.em * 1.1f * to_float(m.tree.size()))
    draw_whole(ui);
  else number_table(ui, "path", {"side", "node", "the eye", "value", "nodes +", "nodes \u2212"}, rows);
}

std::string note_of_tree(Ui& ui) {
  const MethodState& m = ui.session.state().machine;
  return m.tree.empty() ? "" : fmt::format("{} node{}", m.tree.size(), m.tree.size() == 1 ? "" : "s");
}

bool serves_tree(const Header& header) { return records<NodeMake>(header); }

}  // namespace

const Pane tree_pane{"tree", "BSP TREE", draw_tree,      note_of_tree, serves_tree,
                     0.4f,   true,       leads_of_trees, false,        none_yet<NodeMake>};

}  // namespace zstep::viewer
