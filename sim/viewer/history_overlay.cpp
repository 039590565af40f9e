// All that happened to one pixel: a line for each polygon that reached it, and of the one picked the reason with its numbers.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/overlays.hpp"
#include "sim/viewer/words/explain.hpp"
#include "sim/viewer/words/numbers.hpp"

namespace zstep::viewer {
namespace {

/// One line of the list; true when clicked.
bool draw_visit(App& app, std::size_t place, float steps) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const answers::Visit& visit = app.history()[place];
  const float height = std::round(ui.em * 1.4f);
  const auto [at, end, clicked, visible] = list_row(app, place, height);
  if (!visible) return clicked;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Scene& scene = app.session().scene();
  const float y = at.y + ui.em * 0.15f;
  draw_text(ui, {at.x + ui.em * 0.5f, y}, ui.fonts.mono, c.muted, grouped(visit.step));
  float x = at.x + steps;
  if (visit.polygon != no_polygon) {
    const float box = std::round(ui.em * 0.6f), top = at.y + std::round((height - box) / 2);
    list->AddRectFilled({x, top}, {x + box, top + box}, to_im(opaque(scene.polygons[static_cast<std::size_t>(visit.polygon)].color)));
    frame_box(list, {x, top}, {x + box, top + box}, c.text);
    draw_text(ui, {x + ui.em, y}, ui.fonts.bold, c.text, polygon_label(scene, visit.polygon));
  }
  x += ui.em * 6;
  if (visit.z) draw_text(ui, {x, y}, ui.fonts.mono, c.text, depth_in_list(*visit.z));
  draw_text(ui, {x + ui.em * 8, y}, ui.fonts.text, c.text, answers::outcome_text(app.session().trace(), app.history(), visit));
  return clicked;
}

}  // namespace

void draw_history(App& app) {
  Ui& ui = app.ui();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  begin_overlay(app, "history", {screen.x * 0.98f, std::max(screen.y * 0.44f, ui.em * 9)}, 0.98f);
  Flow heading;
  heading.font = ui.fonts.bold;
  flow(ui, fmt::format("Pixel ({}, {}): {}. Enter or a click goes there; Y asks why the one picked is not seen; Esc closes.", app.history_of().x, app.history_of().y,
                       app.history().size() == 1 ? "one thing happened to it" : fmt::format("{} things happened to it", app.history().size())),
       heading);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  std::optional<std::size_t> clicked;
  ImGui::BeginChild("visits", {room.x, room.y * 0.6f}, false, ImGuiWindowFlags_NoNav);
  std::int64_t last_step = 0;
  for (const answers::Visit& visit : app.history()) last_step = std::max(last_step, visit.step);
  const float steps = step_column(ui, last_step);
  for (std::size_t place = 0; place < app.history().size(); ++place)
    if (draw_visit(app, place, steps)) clicked = place;
  app.scroll_to_picked = false;
  ImGui::EndChild();
  ImGui::BeginChild("why", ImGui::GetContentRegionAvail(), false, ImGuiWindowFlags_NoNav);
  const auto picked = static_cast<std::size_t>(std::max(0, app.picked));
  if (picked < app.history().size()) {
    const answers::Visit& visit = app.told_visit(picked);
    flow(ui, visit.sentence, {});
    Flow formula;
    formula.font = ui.fonts.mono;
    for (const std::string& line : visit.formulas) flow(ui, line, formula);
  }
  ImGui::EndChild();
  ImGui::End();
  if (clicked) app.go_to_visit(*clicked);
}

}  // namespace zstep::viewer
