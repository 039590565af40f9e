// The lesson's narration beside the trace; its questions ask for a prediction before the step that answers them.

#include "sim/viewer/panes/lesson.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sim/classroom/marking.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/explain.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

bool has(const std::vector<std::int32_t>& all, std::int32_t one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// "pixel (3, 2)", "scan line 2", "B".
std::string name_of(const Scene& scene, const Marking& marking, std::int32_t what) {
  switch (marking.kind) {
    case Marking::Kind::pixels:
      return fmt::format("pixel ({}, {})", what % scene.raster.width, what / scene.raster.width);
    case Marking::Kind::scan_line:
      return fmt::format("scan line {}", what);
    case Marking::Kind::order:
      break;
  }
  return polygon_label(scene, what);
}

/// What is wrong with marks that were checked; at most one of them by name.
std::string what_is_wrong(const Scene& scene, const Marking& marking, const std::vector<std::int32_t>& made,
                          const MarksJudged& judged) {
  if (marking.kind == Marking::Kind::order) {
    if (judged.wrong.empty()) return fmt::format("So far it is right; {} more to come.", judged.missing.size());
    const auto place = std::find(made.begin(), made.end(), judged.wrong.front()) - made.begin() + 1;
    return fmt::format("{} is not number {}.", name_of(scene, marking, judged.wrong.front()), place);
  }
  if (marking.kind == Marking::Kind::scan_line)
    return fmt::format("It is not {}.", name_of(scene, marking, judged.wrong.front()));
  const std::size_t wrong = judged.wrong.size(), right = made.size() - wrong, all = marking.right.size();
  std::string told = right == 0 ? "None of these belongs to it." : fmt::format("{} of {} are marked.", right, all);
  if (wrong > 0 && right > 0)
    told += wrong == 1 ? fmt::format(" One does not belong to it: {}.", name_of(scene, marking, judged.wrong.front()))
                       : fmt::format(" {} do not belong to it and are crossed out.", wrong);
  return told;
}

/// The polygons of an order, each with the place that it was given.
void draw_choices(Ui& ui, const Marking& marking) {
  Session& s = ui.session;
  const std::vector<std::int32_t> choices = choices_of(marking), &made = s.marks().made;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const auto there = std::find(made.begin(), made.end(), choices[k]);
    const std::string place = there == made.end() ? "" : fmt::format("   {}.", there - made.begin() + 1);
    ImGui::PushID(index32(k));
    if (button(ui, fmt::format("({}) {}{}", k + 1, name_of(s.scene(), marking, choices[k]), place),
               there != made.end()))
      s.mark(choices[k]);
    ImGui::PopID();
  }
}

/// Four angles at the corners of a box, dark within light, so that they are seen on every colour.
void brackets(const Ui& ui, ImVec2 a, ImVec2 b, ImU32 color) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float thin = std::max(1.0f, ui.thin), line = std::round(2 * thin);
  const float arm = std::max(line, std::round(std::min(b.x - a.x, b.y - a.y) * 0.3f));
  const auto draw = [&](ImU32 color_now, float grow) {
    for (const bool right : {false, true})
      for (const bool below : {false, true}) {
        const float x = right ? b.x : a.x, y = below ? b.y : a.y, sx = right ? -1.0f : 1.0f, sy = below ? -1.0f : 1.0f;
        const auto fill = [&](float wide, float high) {
          const ImVec2 p{x - sx * grow, y - sy * grow}, q{x + sx * (wide + grow), y + sy * (high + grow)};
          list->AddRectFilled({std::min(p.x, q.x), std::min(p.y, q.y)}, {std::max(p.x, q.x), std::max(p.y, q.y)},
                              color_now);
        };
        fill(arm, line), fill(line, arm);
      }
  };
  draw(ui.colors().pane, thin), draw(color, 0.0f);
}

void cross_out(const Ui& ui, ImVec2 a, ImVec2 b) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float thin = std::max(1.0f, ui.thin);
  for (const auto& [color, wide] : {std::pair{ui.colors().pane, 4 * thin}, std::pair{ui.colors().bad, 2 * thin}}) {
    stroke_line(list, {a.x + 2, a.y + 2}, {b.x - 2, b.y - 2}, color, wide);
    stroke_line(list, {a.x + 2, b.y - 2}, {b.x - 2, a.y + 2}, color, wide);
  }
}

void dot(const Ui& ui, ImVec2 a, ImVec2 b) {
  const ImVec2 middle{std::round((a.x + b.x) / 2), std::round(a.y + (b.y - a.y) * 0.82f)};
  const float radius = std::max(2.0f, std::round(std::min(b.x - a.x, b.y - a.y) * 0.11f));
  fill_circle(ImGui::GetWindowDrawList(), middle, radius + std::max(1.0f, ui.thin), ui.colors().pane);
  fill_circle(ImGui::GetWindowDrawList(), middle, radius, ui.colors().good);
}

}  // namespace

void draw_marking(Ui& ui, const Marking& marking) {
  Session& s = ui.session;
  const Theme& c = ui.colors();
  const Session::Marks& marks = s.marks();
  flow_markdown(ui, marking.text);
  if (marking.kind == Marking::Kind::order) draw_choices(ui, marking);
  for (std::size_t k = 0; k < std::min(marks.hints, marking.hints.size()); ++k)
    flow_markdown(ui, "*Hint:* " + marking.hints[k]);
  const MarksJudged judged = judge_marks(marking, marks.made);
  const bool done = marks.checked && judged.done();
  if (done) {
    flow(ui, "\u2713 Right.", {.color = c.good, .font = ui.fonts.bold});
    flow_markdown(ui, marking.why);
  } else if (marks.checked) {
    flow_markdown(ui, "**\u2717 Not yet.** " + what_is_wrong(s.scene(), marking, marks.made, judged));
  }
  if (!done && marks.shown) {
    std::string right;
    for (const std::int32_t what : marking.right)
      right += (right.empty() ? "" : ", ") + name_of(s.scene(), marking, what);
    if (marking.kind == Marking::Kind::pixels) flow(ui, "Each pixel that belongs to it has a dot.", {});
    else flow(ui, fmt::format("It is {}.", right), {});
    flow_markdown(ui, marking.why);
  }
  if (done) return;
  ImGui::Dummy({1, ui.em * 0.2f});
  if (button(ui, "Check (Ctrl+Enter)", false, !marks.made.empty())) s.check_marks();
  if (marks.shown) return;
  const bool hints_left = marks.hints < marking.hints.size();
  if (button(ui, hints_left ? "A hint (Ctrl+H)" : "Show it (Ctrl+H)")) s.help_with_marks();
}

void draw_hand_marks(Ui& ui, const RasterMap& map, ImVec2 origin) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const Marking& marking = *s.marking();
  const Session::Marks& marks = s.marks();
  const MarksJudged judged = judge_marks(marking, marks.made);
  const Raster& raster = s.scene().raster;
  const bool line = marking.kind == Marking::Kind::scan_line;
  const auto box = [&](std::int32_t what) {
    const std::int32_t y = line ? what : what / raster.width, first = line ? 0 : what % raster.width,
                       end = line ? raster.width : first + 1;
    return std::pair{ImVec2{origin.x + to_float(map.column_begin(first)), origin.y + to_float(map.row_begin(y))},
                     ImVec2{origin.x + to_float(map.column_begin(end)) - 1, origin.y + to_float(map.row_end(y)) - 1}};
  };
  for (const std::int32_t what : marks.made) {
    const auto [a, b] = box(what);
    const bool wrong = marks.checked && has(judged.wrong, what);
    brackets(ui, a, b, wrong ? c.bad : marks.checked ? c.good : c.text);
    if (wrong) cross_out(ui, a, b);
  }
  if (!marks.shown) return;
  for (const std::int32_t what : marking.right) {
    const auto [a, b] = box(what);
    dot(ui, a, b);
  }
}

namespace {

void draw_answer(Ui& ui, int index, const Answer& answer, bool given) {
  const Theme& c = ui.colors();
  const float width = ImGui::GetContentRegionAvail().x, pad = ui.em * 0.4f, key = ui.em * 1.5f;
  const Flow how{.width = width - 2 * pad - key};
  std::string said = plain_text(parse_markdown(answer.text));
  while (said.ends_with('\n')) said.pop_back();
  const float text = flow_height(ui, said, how), height = std::max(text + 2 * pad * 0.6f, ui.least_target);
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
  flow(ui, said, how);
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
    draw_answer(ui, index32(i), question.answers[i], given == index32(i));
    ImGui::Dummy({1, ui.em * 0.15f});
  }
  if (given) {
    ImGui::Dummy({1, ui.em * 0.2f});
    flow_markdown(ui, question.answers[*given].reply);
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
  const Stop& stop = s.lesson()->stops[s.stop()];
  ImGui::PushID(s.stop());
  Flow heading;
  heading.font = ui.fonts.heading;
  heading.color = stop.position == s.position() ? c.now : c.text;
  if (!stop.heading.empty()) flow(ui, stop.heading, heading);
  ImGui::Dummy({1, ui.em * 0.25f});
  flow_markdown(ui, stop.text);
  if (stop.question) draw_question(ui, *stop.question);
  if (stop.task) draw_task(ui, *stop.task);
  if (stop.marking) draw_marking(ui, *stop.marking);
  ImGui::Dummy({1, ui.em * 0.4f});
  if (tall_button(ui, "\u25c0 Back", false, s.stop() > 0)) s.next_stop(-1);
  const bool last = s.stop() + 1 == size32(s.lesson()->stops);
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
