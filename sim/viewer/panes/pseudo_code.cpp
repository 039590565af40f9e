// The page of the lecture, the line at work lit, with how often each line ran. A click runs on to the next time.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/model/lines_near.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

/// How far in a level stands: the deepest line of the page keeps most of the pane for its words.
float indent_of(const Ui& ui, const Page& page) {
  int deepest = 1;
  for (const StepInfo& step : page) deepest = std::max(deepest, static_cast<int>(step.indent));
  return std::max(
      3.0f, std::round(std::min(ui.em * 0.8f, ImGui::GetContentRegionAvail().x * 0.22f / static_cast<float>(deepest))));
}

void draw_line(Ui& ui, const StepInfo& step, bool now, float level) {
  const Theme& c = ui.colors();
  const float width = ImGui::GetContentRegionAvail().x;
  const float gutter = std::round(ui.em * 1.15f), indent = gutter + static_cast<float>(step.indent) * level;
  const auto count = ui.hits.of(step.id);
  const std::string hits = count && *count > 0 && !ui.presenter ? grouped(*count) : "";
  const float hits_width = hits.empty() ? 0 : text_size(ui, ui.fonts.small, hits).x + ui.em * 0.4f;

  Flow how;
  how.font = ui.fonts.mono;
  how.indent = std::round(std::min(ui.em * 0.9f, width * 0.05f));
  how.width = std::max(ui.em * 4, width - indent - hits_width - 2);
  how.color = now ? c.text : count && *count == 0 ? c.muted : c.text;
  const float height = flow_height(ui, step.text, how) + 2;

  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(step.id);
  const bool clicked = ImGui::InvisibleButton("line", {width, height});
  const bool hovered = ImGui::IsItemHovered();
  ImGui::PopID();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + width, at.y + height};
  if (now) {
    list->AddRectFilled(at, end, c.now_soft);
    list->AddRectFilled(at, {at.x + 3, end.y}, c.now);
    draw_text(ui, {at.x + 5, at.y + 1}, ui.fonts.text, c.now, "\u25b6");
  } else if (hovered) {
    list->AddRectFilled(at, end, c.head);
  }
  const ImVec2 after = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({at.x + indent, at.y + 1});
  flow(ui, step.text, how);
  ImGui::SetCursorScreenPos(after);
  if (!hits.empty()) draw_text(ui, {end.x - hits_width + ui.em * 0.2f, at.y + 3}, ui.fonts.small, c.muted, hits);

  if (now) follow(ui, at.y, height);
  if (hovered) ui.mouse_help = "Click: on to the next time this line runs. Shift+click: back to the last time.";
  if (clicked) ui.session.to_step(step.id, ImGui::GetIO().KeyShift ? -1 : 1);
}

void draw_pseudo_code(Ui& ui) {
  const Page& page = ui.session.header().page;
  if (page.empty()) return say_empty(ui, "This trace has no step table, so there is no pseudo-code to show.");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  const RecordedEvent* event = ui.session.event();
  const float level = indent_of(ui, page);
  std::vector<bool> shown(page.size(), true);
  for (std::size_t i = 0; i < page.size(); ++i)
    if (ui.presenter && event && event->step == page[i].id) shown = lines_near(page, i);
  for (std::size_t i = 0; i < page.size(); ++i)
    if (shown[i]) draw_line(ui, page[i], event && event->step == page[i].id, level);
  ImGui::PopStyleVar();
}

std::string note_of_pseudo_code(Ui& ui) {
  const RecordedEvent* event = ui.session.event();
  const StepInfo* step = event ? find_step(ui.session.header().page, event->step) : nullptr;
  return step ? step->module + "." + step->name : "";
}

}  // namespace

const Pane pseudo_code_pane{"pseudo_code", "PSEUDO-CODE", draw_pseudo_code, note_of_pseudo_code, nullptr, 0, true};

}  // namespace zstep::viewer
