#include "sim/viewer/panes/vertex_stages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/panes/exact_line.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {

std::int32_t vertex_at_work(const RecordedEvent* event) {
  if (event) {
    const Event& e = event->event;
    if (const auto* v = get_if<ViewTransform>(&e)) return v->vertex;
    if (const auto* v = get_if<Projection>(&e)) return v->vertex;
    if (const auto* v = get_if<ViewportTransform>(&e)) return v->vertex;
    if (const auto* v = get_if<ClipVertex>(&e)) return v->vertex;
    if (const auto* v = get_if<ClipCross>(&e)) return v->vertex;
    if (const auto* v = get_if<OutlineVertex>(&e)) return v->vertex;
    if (const auto* v = get_if<VertexSide>(&e)) return v->vertex;
    if (const auto* v = get_if<SplitVertex>(&e)) return v->vertex;
  }
  return -1;
}

std::vector<std::int32_t> vertices_shown(const Session& s) {
  const MethodState& m = s.state().machine;
  const std::int32_t now = vertex_at_work(s.event());
  std::vector<std::int32_t> shown;
  if (m.facet >= 0 && static_cast<std::size_t>(m.facet) < s.scene().facets.size()) {
    const Facet& facet = s.scene().facets[static_cast<std::size_t>(m.facet)];
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      shown.push_back(s.scene().corners[static_cast<std::size_t>(facet.first_corner + k)]);
    for (const std::int32_t v : m.outline)
      if (std::find(shown.begin(), shown.end(), v) == shown.end()) shown.push_back(v);
  }
  for (const std::int32_t other : {s.picked_part.vertex.value_or(-1), now})
    if (other >= 0 && std::find(shown.begin(), shown.end(), other) == shown.end()) shown.insert(shown.begin(), other);
  return shown;
}

StageLayout lay_out_stages(const Ui& ui, const std::vector<StageRow>& rows, float room) {
  std::vector<double> values;
  for (const StageRow& row : rows)
    for (int k = 0; k < (row.flat ? 2 : 3); ++k) values.push_back((*row.at)[k]);
  StageLayout how{ui.fonts.mono, 3, decimals_needed(values, 3), 0, 0};
  for (const auto& [font, across] :
       {std::pair{ui.fonts.mono, 3}, {ui.fonts.small, 3}, {ui.fonts.mono, 1}, {ui.fonts.small, 1}}) {
    how.font = font, how.across = across, how.column = 0;
    how.name = text_size(ui, font, "screen ").x;
    for (const double v : values) how.column = std::max(how.column, text_size(ui, font, number(v, how.decimals)).x);
    how.column += ui.em * (across == 1 ? 0.2f : 0.6f);
    if (how.name + static_cast<float>(across) * how.column + ui.em * 0.4f <= room) break;
  }
  return how;
}

namespace {

/// The stages of one vertex as aligned lines.
void draw_stages(Ui& ui, std::int32_t vertex, bool now) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const auto at = static_cast<std::size_t>(vertex);
  const VertexStages* way = at < s.state().vertices.size() ? &s.state().vertices[at] : nullptr;
  std::vector<StageRow> rows;
  const bool screen = s.scene().camera.kind == Camera::Kind::screen;
  if (at < s.scene().points.size()) rows.push_back({screen ? "screen" : "world", s.scene().points[at], false, "_w"});
  if (screen && way && at >= s.scene().points.size())
    rows.push_back({"screen", glm::dvec3(way->raster, way->plane.z), false, "_s"});
  else if (!s.state().machine.tree.empty() && way && way->world != glm::dvec3(0))
    rows.push_back({"world", way->world, false, "_w"});
  if (!screen && way) {
    if (way->stage >= VertexStages::viewed) rows.push_back({"view", way->view, false, "_v"});
    if (way->stage >= VertexStages::projected) rows.push_back({"plane", way->plane, false, "_p"});
    if (way->stage >= VertexStages::on_raster) rows.push_back({"screen", glm::dvec3(way->raster, 0), true, "_s"});
  }
  const StageLayout how = lay_out_stages(ui, rows, ImGui::GetContentRegionAvail().x);
  const ImFont* font = how.font;
  const float height = std::round(font->FontSize * 1.3f), title = std::round(ui.fonts.mono->FontSize * 1.3f);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto lines_of = [&](const StageRow& row) { return how.across == 1 && !row.flat ? 3 : how.across == 1 ? 2 : 1; };
  int lines = 0;
  for (const StageRow& row : rows) lines += lines_of(row);
  const float block = title + height * static_cast<float>(lines);
  if (now) {
    list->AddRectFilled(top, {top.x + ImGui::GetContentRegionAvail().x, top.y + block}, c.now_soft);
    list->AddRectFilled(top, {top.x + std::round(3 * ui.thin), top.y + block}, c.now);
  }
  if (const ScenePart lit = s.lit_part();
      lit.vertex == vertex || (lit.edge && (lit.edge->first == vertex || lit.edge->second == vertex)))
    frame_box(ui, top, {top.x + ImGui::GetContentRegionAvail().x, top.y + block}, c.selected, 2);
  const float x = top.x + ui.em * 0.4f;
  draw_text(ui, {x, top.y + 1}, ui.fonts.bold, now ? c.now : c.text, fmt::format("vertex {}", vertex));
  std::vector<std::string> tips;
  std::string under_mouse;  // the number there without rounding
  float y = top.y + title;
  for (const StageRow& row : rows) {
    draw_text(ui, {x, y}, font, c.muted, row.stage);
    for (int k = 0; k < (row.flat ? 2 : 3); ++k) {
      const std::string text = number((*row.at)[k], how.decimals);
      const ImVec2 right{x + how.name + how.column * static_cast<float>(how.across == 1 ? 1 : k + 1),
                         y + (how.across == 1 ? height * static_cast<float>(k) : 0.0f)};
      const float width = text_size(ui, font, text).x;
      draw_text(ui, {right.x - width, right.y}, font, c.text, text);
      if (!row.field.empty()) {
        const answers::Question question =
            answers::of_vertex(s.position(), vertex, k == 2 && row.field == "_p" ? "z" : "xyz"[k] + row.field);
        if (number_at(ui, {right.x - width - 2, right.y}, {right.x + 2, right.y + height}, question))
          under_mouse = exact_line(s.trace(), question);
      }
      tips.push_back(fmt::format("{} {} = {}", row.stage, "xyz"[k], exact((*row.at)[k])));
    }
    y += height * static_cast<float>(lines_of(row));
  }
  ImGui::Dummy({std::max(1.0f, how.name + static_cast<float>(how.across) * how.column + ui.em * 0.4f), block});
  if (!under_mouse.empty()) tips.push_back(under_mouse);
  if (ImGui::IsItemHovered()) tooltip(ui, tips);
  if (now) follow(ui, top.y, block);
}

}  // namespace

void draw_vertex_stages(Ui& ui) {
  const std::int32_t now = vertex_at_work(ui.session.event());
  for (const std::int32_t vertex : vertices_shown(ui.session)) draw_stages(ui, vertex, vertex == now);
}

}  // namespace zstep::viewer
