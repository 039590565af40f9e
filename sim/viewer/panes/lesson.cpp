// The lesson's narration beside the trace; its questions ask for a prediction before the step that answers them.
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/panes/marking.hpp"
#include "sim/viewer/panes/pane.hpp"

namespace zstep::viewer {
namespace {

void draw_answer(Ui& ui, int index, const Answer& answer, bool given) {
  const Theme& c = ui.colors();
  const float width = ImGui::GetContentRegionAvail().x, pad = ui.em * 0.4f, key = ui.em * 1.5f;
  const Flow how{.width = width - 2 * pad - key};
  const float text = flow_height(ui, answer.text, how), height = std::max(text + 2 * pad * 0.6f, ui.least_target);
  const ImVec2 at = ImGui::GetCursorScreenPos(), end{at.x + width, at.y + height};
  const float top = at.y + (height - text) / 2;
  can_be_hit(ui, at, end);
  ImGui::PushID(index);
  const bool clicked = ImGui::InvisibleButton("answer", {width, height});
  const bool hovered = ImGui::IsItemHovered();
  ImGui::PopID();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImU32 edge = given ? (answer.right ? c.good : c.bad) : c.rule;
  list->AddRectFilled(at, end, hovered ? c.button_hovered : c.button);
  frame_box(ui, at, end, edge, given ? 2.0f : 1.0f);
  draw_text(ui, {at.x + pad, top}, ui.fonts.bold, given ? edge : c.muted,
            given ? (answer.right ? "\u2713" : "\u2717") : fmt::format("{}", index + 1));
  const ImVec2 after = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({at.x + pad + key, top});
  flow(ui, answer.text, how);
  ImGui::SetCursorScreenPos(after);
  if (clicked) ui.session.answer(index);
}

void draw_question(Ui& ui, const Question& question) {
  Session& s = ui.session;
  const Theme& c = ui.colors();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(
      at, {at.x + ImGui::GetContentRegionAvail().x, at.y + std::round(2 * ui.thin)}, s.nudged() ? c.now : c.rule);
  ImGui::Dummy({1, ui.em * 0.4f});
  if (s.nudged()) {
    const Flow nudge{.color = c.now, .font = ui.fonts.bold};
    flow(ui, "\u25b6 What did you expect? Answer first, then see whether the steps agree.", nudge);
  }
  flow_markdown(ui, question.text);
  const auto given = s.chosen(s.stop());
  for (std::size_t i = 0; i < question.answers.size(); ++i) {
    draw_answer(ui, static_cast<int>(i), question.answers[i], given == static_cast<int>(i));
    ImGui::Dummy({1, ui.em * 0.15f});
  }
  if (given) {
    ImGui::Dummy({1, ui.em * 0.2f});
    flow_markdown(ui, question.answers[static_cast<std::size_t>(*given)].reply);
  }
}

/// What is to be tried; it is tried in the drawer in which the run is changed.
void draw_task(Ui& ui, const Task& task) {
  flow_markdown(ui, task.text);
  if (tall_button(ui, "Try it (Ctrl+E)")) ui.clicked = command_called("what-if");
}

void draw_lesson(Ui& ui) {
  Session& s = ui.session;
  const Theme& c = ui.colors();
  if (!s.lesson() || s.lesson()->stops.empty()) return say_empty(ui, "This lesson has no narration.");
  if (s.stop() < 0) {
    flow_markdown(ui, "**" + s.lesson()->title + "**");
    flow_markdown(ui, s.lesson()->summary);
    return say_empty(ui, "The narration begins a few steps on: N goes to its first stop.");
  }
  const Stop& stop = s.lesson()->stops[static_cast<std::size_t>(s.stop())];
  ImGui::PushID(s.stop());
  Flow heading;
  heading.font = ui.fonts.bold;
  heading.color = stop.position == s.position() ? c.now : c.text;
  if (!stop.heading.empty()) flow(ui, stop.heading, heading);
  ImGui::Dummy({1, ui.em * 0.25f});
  flow_markdown(ui, stop.text);
  if (stop.question) draw_question(ui, *stop.question);
  if (stop.task) draw_task(ui, *stop.task);
  if (stop.marking) draw_marking(ui, *stop.marking);
  ImGui::Dummy({1, ui.em * 0.4f});
  if (tall_button(ui, "\u25c0 Back", false, s.stop() > 0)) s.next_stop(-1);
  const bool last = s.stop() + 1 == static_cast<int>(s.lesson()->stops.size());
  const std::string on = last ? "The last stop" : "Next (N) \u25b6";
  const float needed =
      text_size(ui, ui.fonts.text, "\u25c0 Back").x + text_size(ui, ui.fonts.text, on).x + ui.em * 2.8f;
  if (needed <= ImGui::GetContentRegionAvail().x) ImGui::SameLine(0, ui.em * 0.4f);
  else ImGui::Dummy({1, ui.em * 0.25f});
  if (tall_button(ui, on, !last && !s.question_open(), !last)) s.next_stop(1);
  ImGui::PopID();
  // A class sees all answers, also where the text before them is long, and then why the right one is right.
  if (ui.presenter && ui.speaks_now && stop.question) ImGui::SetScrollY(ImGui::GetScrollMaxY());
}

std::string note_of_lesson(Ui& ui) {
  const Session& s = ui.session;
  if (!s.lesson() || s.stop() < 0) return "";
  const std::string wait = s.seconds_to_read() > 0 ? fmt::format("plays on in {} s   ", s.seconds_to_read()) : "";
  return wait + fmt::format("{} of {}", s.stop() + 1, s.lesson()->stops.size());
}

}  // namespace

const Pane lesson_pane{"lesson", "LESSON", draw_lesson, note_of_lesson, nullptr, 0, true};

}  // namespace zstep::viewer
