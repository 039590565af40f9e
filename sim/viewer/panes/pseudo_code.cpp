// The page of the lecture, the line at work lit, with how often each line ran. A click runs on to the next time.
#include <algorithm>
#include <cmath>
#include <numeric>

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

float gutter(const Ui& ui) { return std::round(ui.em * 1.15f); }

/// How a line of the page is written, and how often it ran.
struct Line {
  Flow how;
  float indent, height;
  std::string hits;
  float hits_width;
};
Line line_of(Ui& ui, const StepInfo& step, bool now, float level) {
  const Theme& c = ui.colors();
  const float width = ImGui::GetContentRegionAvail().x;
  const auto count = ui.hits.of(step.id);
  Line line;
  line.indent = gutter(ui) + static_cast<float>(step.indent) * level;
  line.hits = count && *count > 0 && !ui.presenter ? grouped(*count) : "";
  line.hits_width = line.hits.empty() ? 0 : text_size(ui, ui.fonts.small, line.hits).x + ui.em * 0.4f;
  line.how.font = ui.fonts.mono;
  line.how.indent = std::round(std::min(ui.em * 0.9f, width * 0.05f));
  line.how.width = std::max(ui.em * 4, width - line.indent - line.hits_width - 2);
  line.how.color = now ? c.text : count && *count == 0 ? c.muted : c.text;
  line.height = flow_height(ui, step.text, line.how) + 2;
  return line;
}

void draw_line(Ui& ui, const StepInfo& step, bool now, float level) {
  const Theme& c = ui.colors();
  const float width = ImGui::GetContentRegionAvail().x;
  const auto [how, indent, height, hits, hits_width] = line_of(ui, step, now, level);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(step.id);
  const bool clicked = ImGui::InvisibleButton("line", {width, height});
  const bool hovered = ImGui::IsItemHovered();
  ImGui::PopID();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + width, at.y + height};
  can_be_hit(ui, at, end);
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
  if (hovered)
    ui.mouse_help = "Click: on to the next time this line runs. Shift+click: back to the last time. Right click: more.";
  if (hovered && ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    const std::uint8_t id = step.id;
    const auto run = [id](int direction) { return [id, direction](Session& s) { s.to_step(id, direction); }; };
    ui.here = {{.text = "On to the next time this line runs", .first = run(1)},
               {.text = "Back to the last time it ran", .first = run(-1)},
               {.text = "Run until a condition is true", .command = "run-until"},
               {.text = "The whole page, or folded", .command = "whole-code"},
               {.text = "Copy its name: " + step.name, .copies = step.name}};
  }
  if (clicked) ui.session.to_step(step.id, ImGui::GetIO().KeyShift ? -1 : 1);
}

float fold_height(const Ui& ui) { return std::round(ui.fonts.small->FontSize * 1.35f); }

/// Stands for lines that are folded; a click shows them all.
void draw_fold(Ui& ui, const StepInfo& first, std::size_t lines, float level) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = fold_height(ui);
  ImGui::PushID(first.id);
  if (ImGui::InvisibleButton("fold", {width, height})) ui.whole_code = true;
  ImGui::PopID();
  if (ImGui::IsItemHovered()) {
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, ui.colors().head);
    ui.mouse_help = "Click: the whole page. 7: folded again, around the line at work.";
  }
  draw_text(ui, {at.x + gutter(ui) + static_cast<float>(first.indent) * level, at.y}, ui.fonts.small, ui.colors().muted,
            lines == 1 ? "\u2026 1 line" : fmt::format("\u2026 {} lines", lines));
}

float height_of(const std::vector<bool>& shown, const std::vector<float>& heights, float fold) {
  float height = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) height += shown[i] ? heights[i] : i == 0 || shown[i - 1] ? fold : 0;
  return height;
}

/// What is near the line at work, and as many lines more as there is room for, the nearest first.
std::vector<bool> lines_that_fit(const Page& page, std::size_t now, const std::vector<float>& heights, float fold,
                                 float room) {
  std::vector<bool> shown = lines_near(page, now);
  for (std::size_t away = 1; away < page.size(); ++away)
    for (const std::size_t i : {now + away, now - away}) {  // before the first is beyond the last
      if (i >= page.size() || shown[i]) continue;
      shown[i] = true;
      if (height_of(shown, heights, fold) <= room) continue;
      shown[i] = false;
      return shown;
    }
  return shown;
}

/// All of the page where it fits or is asked for, else what is near the line at work.
std::vector<bool> lines_shown(Ui& ui, const Page& page, float level) {
  std::vector<bool> all(page.size(), true);
  const RecordedEvent* event = ui.session.event();
  const auto at_work =
      std::find_if(page.begin(), page.end(), [&](const StepInfo& step) { return event && event->step == step.id; });
  if (at_work == page.end() || (ui.whole_code && !ui.presenter)) return all;
  const auto now = static_cast<std::size_t>(at_work - page.begin());
  if (ui.presenter) return lines_near(page, now);
  std::vector<float> heights;
  for (const StepInfo& step : page) heights.push_back(line_of(ui, step, false, level).height);
  // With room to spare: counts beside the lines grow, and the page must not fold for that.
  const float room = ImGui::GetContentRegionAvail().y - ui.line();
  if (std::accumulate(heights.begin(), heights.end(), 0.0f) <= room) return all;
  return lines_that_fit(page, now, heights, fold_height(ui), room);
}

void draw_pseudo_code(Ui& ui) {
  const Page& page = ui.session.header().page;
  if (page.empty()) return say_empty(ui, "This trace has no step table, so there is no pseudo-code to show.");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  const RecordedEvent* event = ui.session.event();
  const float level = indent_of(ui, page);
  const std::vector<bool> shown = lines_shown(ui, page, level);
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (shown[i]) {
      draw_line(ui, page[i], event && event->step == page[i].id, level);
      continue;
    }
    const std::size_t first = i;
    while (i + 1 < page.size() && !shown[i + 1]) ++i;
    if (!ui.presenter) draw_fold(ui, page[first], i + 1 - first, level);
  }
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
