// What if: all that can be changed of the run, what was, and what the last change did.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// A small button in a row; true under the mouse.
bool row_button(Ui& ui, const char* sign, ImVec2 at, float side) {
  const ImVec2 end{at.x + side, at.y + side};
  const bool hot = ImGui::IsMouseHoveringRect(at, end);
  const Theme& c = ui.colors();
  ImGui::GetWindowDrawList()->AddRectFilled(at, end, hot ? c.button_hovered : c.button);
  frame_box(ui, at, end, c.rule);
  const float width = text_size(ui, ui.fonts.text, sign).x;
  draw_text(ui, {at.x + std::round((side - width) / 2), at.y + std::round((side - ui.em) / 2) - 2}, ui.fonts.text,
            c.text, sign);
  return hot;
}

const std::string* was(const Changed& changed, const std::string& name) {
  for (const Changed::Made& made : changed.made)
    if (made.change.name == name) return &made.was;
  return nullptr;
}

/// Its numbers with six digits at most.
std::string shortened(const std::string& value) {
  std::string text;
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t end = std::min(value.find(' ', at), value.size());
    const std::string word = value.substr(at, end - at);
    char* rest = nullptr;
    const double number = std::strtod(word.c_str(), &rest);
    text += (text.empty() ? "" : " ") + (word.size() > 7 && *rest == 0 ? fmt::format("{:.6g}", number) : word);
    at = end + 1;
  }
  return text;
}

/// What a click in the row asks for: 1 and -1 a nudge, 2 to be typed; 0 none.
int draw_changeable(App& app, const Changeable& what, std::size_t place) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const float line = std::round(ui.em * 1.4f), pad = std::round(ui.em * 0.4f);
  const bool buttons = what.nudge != 0 || !what.choices.empty();
  const ListRow row = list_row(app, place, line + std::round(ui.em * 1.2f));
  if (ImGui::IsItemHovered()) ui.mouse_help = what.name + ": " + what.meaning;
  int asked = row.clicked ? 2 : 0;
  if (!row.visible) return asked;
  const std::string* before = was(app.changed(), what.name);
  const ImFont* font = before ? ui.fonts.bold : ui.fonts.text;
  const float width = row.end.x - row.at.x - 2 * pad;
  draw_text(ui, {row.at.x + pad, row.at.y + 2}, font, before ? c.now : c.text,
            fitted(ui, font, (before ? "\u2260 " : "") + what.name + " = " + shortened(what.value),
                   width - (buttons ? 2 * line + pad : 0)));
  draw_text(ui, {row.at.x + pad, row.at.y + line}, ui.fonts.small, c.muted,
            fitted(ui, ui.fonts.small, before ? "was " + shortened(*before) : what.meaning, width));
  if (buttons) {
    const float y = row.at.y + 1, side = line - 2, right = row.end.x - pad;
    const bool less = row_button(ui, "\u2212", {right - 2 * side - 2, y}, side),
               more = row_button(ui, "+", {right - side, y}, side);
    if (row.clicked && (less || more)) asked = more ? 1 : -1;
  }
  return asked;
}

/// What is to be tried, whether it is done, and the hints that were asked for.
void draw_task(App& app, const Task& task) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  flow(ui, "Try it", {.font = ui.fonts.bold});
  flow_markdown(ui, task.text);
  const std::optional<TaskState>& state = app.changed().task;
  for (std::size_t k = 0; k < std::min(app.hints_given(), task.hints.size()); ++k)
    flow_markdown(ui, "*Hint:* " + task.hints[k]);
  if (state && state->done) {
    flow(ui, "\u2713 Done.", {.color = c.good, .font = ui.fonts.bold});
    if (app.lesson_waits && button(ui, "On with the lesson (Esc, N)")) app.next_stop(1);
  } else {
    if (state) flow_markdown(ui, "**\u2717 Not yet.** " + state->now);
    const bool all = app.hints_given() >= task.hints.size();
    if (button(ui, all ? "Show how (Ctrl+H)" : "A hint (Ctrl+H)")) app.give_hint();
  }
  ImGui::Dummy({1, std::round(ui.em * 0.3f)});
}

}  // namespace

void draw_what_if(App& app) {
  Ui& ui = app.ui();
  const std::string how =
      "Enter: do it. Ctrl+\u2191 \u2193: a little. Ctrl+Z, Ctrl+Y: undo, redo. What is changed stays.";
  const std::string& told = !app.wrong.empty()           ? app.wrong
                            : !app.saved_scene().empty() ? app.saved_scene()
                                                         : app.changed().told;
  const auto lines = [&](const std::string& text) { return text.empty() ? 0 : flow_height(ui, text, {}) * 1.1f; };
  const float high = lines(how) + lines(told) + ui.em * 5.4f + (app.task() ? lines(app.task()->text) + ui.em * 9 : 0);
  const bool beside = begin_first(ui, "change", 0.5f, high);
  if (app.task()) draw_task(app, *app.task());
  app.draw_drawer_field("theta = 60, vertex 3 = 1 0 2");
  if (!app.wrong.empty()) say_wrong(ui, app.wrong);
  else if (!told.empty()) flow(ui, told, {});
  if (button(ui, "Undo", false, !app.changed().made.empty())) app.requests.undo_change = 1;
  ImGui::SameLine(0, ui.em * 0.4f);
  if (button(ui, "Redo")) app.requests.undo_change = -1;
  ImGui::SameLine(0, ui.em * 0.4f);
  if (button(ui, "Save")) app.save_scene();
  if (ImGui::IsItemHovered()) ui.mouse_help = "Save the changed scene as a scene file (Ctrl+Shift+S).";
  ImGui::Dummy({1, std::round(ui.em * 0.3f)});
  flow(ui, how, {.color = ui.colors().muted});
  ImGui::EndChild();
  const std::vector<Changeable> found = app.found_changeables();
  int asked = 0;
  std::size_t of = 0;
  begin_second(ui, "changeables", beside);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (const int now = draw_changeable(app, found[k], k); now != 0) asked = now, of = k;
  if (found.empty()) say_empty(ui, "Nothing that can be changed has this in its name.");
  app.scroll_to_picked = false;
  ImGui::EndChild();
  if (asked == 0) return;
  app.picked = index32(of);
  if (asked == 2) app.put(fmt::format("{} = {}", found[of].name, found[of].value));
  else app.nudge(found[of], asked);
}

}  // namespace zstep::viewer
