// All that happened to one pixel: a line for each polygon that reached it, and of the one picked the reason with its
// numbers.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/overlays.hpp"
#include "sim/viewer/panes/typeset.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

/// Where the columns of the list begin, in pixels from its left.
struct VisitColumns {
  float polygon = 0, depth = 0, against = 0, of = 0, outcome = 0;
};

VisitColumns columns_of(App& app) {
  const Ui& ui = app.ui();
  std::int64_t last_step = 0;
  float polygon = ui.em * 3, depth = ui.em * 4, against = ui.em * 4, of = ui.em * 2;
  for (const answers::Visit& visit : app.history()) {
    last_step = std::max(last_step, visit.step);
    const auto name_width = [&](std::int32_t who) {
      return who == no_polygon ? 0 : text_size(ui, ui.fonts.bold, polygon_label(app.session().scene(), who)).x + ui.em;
    };
    polygon = std::max(polygon, name_width(visit.polygon));
    if (visit.stored) of = std::max(of, name_width(visit.stored_polygon));
    if (visit.z) depth = std::max(depth, text_size(ui, ui.fonts.mono, depth_in_list(*visit.z)).x);
    if (visit.stored && visit.stored_polygon == no_polygon)
      of = std::max(of, text_size(ui, ui.fonts.text, "background").x);
    if (visit.stored) against = std::max(against, text_size(ui, ui.fonts.mono, depth_in_list(*visit.stored)).x);
  }
  VisitColumns columns;
  columns.polygon = step_column(ui, last_step);
  columns.depth = columns.polygon + polygon + ui.em;
  columns.against = columns.depth + depth + ui.em;
  columns.of = columns.against + against + ui.em;
  columns.outcome = columns.of + of + ui.em;
  return columns;
}

void draw_polygon(App& app, ImVec2 at, float y, float height, std::int32_t polygon) {
  if (polygon == no_polygon) return;
  Ui& ui = app.ui();
  const Scene& scene = app.session().scene();
  draw_swatch(ui, at, height, scene, polygon);
  draw_text(ui, {at.x + ui.em, y}, ui.fonts.bold, ui.colors().text, polygon_label(scene, polygon));
}

void draw_headings(App& app, const VisitColumns& columns) {
  const Ui& ui = app.ui();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool rays = app.session().trace().has(kind_of<RayBegin>);
  for (const auto& [x, text] : {std::pair{ui.em * 0.5f, "step"},
                                {columns.polygon, "polygon"},
                                {columns.depth, rays ? "t" : "depth"},
                                {columns.against, "against"},
                                {columns.of, "of"},
                                {columns.outcome, "outcome"}})
    draw_text(ui, {at.x + x, at.y}, ui.fonts.small, ui.colors().muted, text);
  ImGui::Dummy({1, std::round(ui.fonts.small->FontSize * 1.4f)});
}

/// One line of the list; true when clicked.
bool draw_visit(App& app, std::size_t place, const VisitColumns& columns) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const answers::Visit& visit = app.history()[place];
  const float height = std::round(ui.em * 1.4f);
  const auto [at, end, clicked, visible] = list_row(app, place, height);
  if (!visible) return clicked;
  const float y = at.y + ui.em * 0.15f;
  draw_text(ui, {at.x + ui.em * 0.5f, y}, ui.fonts.mono, c.muted, grouped(visit.step));
  draw_polygon(app, {at.x + columns.polygon, at.y}, y, height, visit.polygon);
  if (visit.z) draw_text(ui, {at.x + columns.depth, y}, ui.fonts.mono, c.text, depth_in_list(*visit.z));
  if (visit.stored) draw_text(ui, {at.x + columns.against, y}, ui.fonts.mono, c.text, depth_in_list(*visit.stored));
  if (visit.stored && visit.stored_polygon == no_polygon)
    draw_text(ui, {at.x + columns.of, y}, ui.fonts.text, c.muted, "background");
  if (visit.stored) draw_polygon(app, {at.x + columns.of, at.y}, y, height, visit.stored_polygon);
  const std::string outcome = answers::outcome_text(app.session().trace(), app.history(), visit);
  draw_text(ui, {at.x + columns.outcome, y}, ui.fonts.text, c.text,
            fitted(ui, ui.fonts.text, outcome, end.x - at.x - columns.outcome));
  return clicked;
}

}  // namespace

void draw_history(App& app) {
  Ui& ui = app.ui();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  begin_overlay(app, "history", {screen.x * 0.98f, std::max(screen.y * 0.44f, ui.em * 9)}, 0.98f);
  const Flow heading{.font = ui.fonts.bold};
  flow(
      ui,
      fmt::format("Pixel ({}, {}): {}. Enter or a click goes there; Y asks why the one picked is not seen; Esc closes.",
                  app.history_of().x, app.history_of().y,
                  app.history().size() == 1 ? "one thing happened to it"
                                            : fmt::format("{} things happened to it", app.history().size())),
      heading);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  std::optional<std::size_t> clicked;
  const VisitColumns columns = columns_of(app);
  draw_headings(app, columns);
  ImGui::BeginChild("visits", {room.x, room.y * 0.6f}, false, ImGuiWindowFlags_NoNav);
  for (std::size_t place = 0; place < app.history().size(); ++place)
    if (draw_visit(app, place, columns)) clicked = place;
  app.scroll_to_picked = false;
  ImGui::EndChild();
  ImGui::BeginChild("why", ImGui::GetContentRegionAvail(), false, ImGuiWindowFlags_NoNav);
  const auto picked = static_cast<std::size_t>(std::max(0, app.picked));
  if (picked < app.history().size()) {
    const answers::Visit& visit = app.told_visit(picked);
    flow(ui, visit.sentence, {});
    for (const std::string& line : visit.formulas) set_formula(ui, line, {});
  }
  ImGui::EndChild();
  ImGui::End();
  if (clicked) app.go_to_visit(*clicked);
}

}  // namespace zstep::viewer
