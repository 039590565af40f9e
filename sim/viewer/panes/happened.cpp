// What the step did: a sentence, and the formula with its numbers.
#include "sim/viewer/panes/exact_line.hpp"
#include "sim/viewer/panes/owner_key.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/typeset.hpp"
#include "sim/words/explain.hpp"

namespace zstep::viewer {
namespace {

/// A number of the step's own in the sentence tells where it comes from.
void tell(Ui& ui, const std::string& sentence) {
  Flow how;
  how.on_number = [&](const std::string& number, ImVec2 a, ImVec2 b) {
    if (!ImGui::IsMouseHoveringRect(a, b)) return;
    const std::string field = answers::field_shown_as(ui.session.trace(), ui.session.position(), number);
    if (!field.empty()) number_at(ui, a, b, {ui.session.position(), field});
  };
  flow(ui, sentence, how);
}

/// A click on a formula asks about the number that it gives, or else about the step's main one; on one of its numbers,
/// about that.
void tell_formula(Ui& ui, const std::string& formula, const std::vector<words::Owned>& owned) {
  Flow how;
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const float right = top.x + ImGui::GetContentRegionAvail().x;
  const auto ask = [&](ImVec2 a, ImVec2 b, const std::string& number) {
    if (!ImGui::IsMouseHoveringRect(a, b)) return false;
    const std::int64_t step = ui.session.position();
    const std::string result = formula.substr(0, formula.find(" = "));
    return number_at(ui, a, b, {step, answers::field_called(ui.session.trace(), step, result)}, number);
  };
  bool on_number = false;
  how.on_number = [&](const std::string& number, ImVec2 a, ImVec2 b) { on_number = ask(a, b, number) || on_number; };
  set_formula(ui, formula, how, owned);
  if (!on_number) ask(top, {right, ImGui::GetCursorScreenPos().y}, "");
}

/// What check or diff says of the step, in its own words.
void draw_told(Ui& ui, const StepMarks::Told& told) {
  const Flow wrong{.color = ui.colors().bad, .font = ui.fonts.bold};
  for (const std::string& what : told.lines) flow(ui, "! " + told.head + what, wrong);
  Flow note;
  note.color = ui.colors().bad;
  if (!told.note.empty()) flow(ui, (told.lines.empty() ? "\u2190 " : "") + told.note, note);
  if (!told.lines.empty() || !told.note.empty()) ImGui::Dummy({1, ui.em * 0.25f});
}

void draw_happened(Ui& ui) {
  const Theme& c = ui.colors();
  const StepMarks::Told found = ui.marks ? ui.marks->told(ui.session) : StepMarks::Told{};  // moves the replay
  const RecordedEvent* event = ui.session.event();
  if (!ui.session.message.empty()) {
    flow(ui, ui.session.message, {.color = c.now, .font = ui.fonts.bold});
  }
  if (!event) {
    if (ui.session.size() == 0) return say_empty(ui, "This trace has no events: the run recorded nothing.");
    flow(ui, "Nothing has happened yet. \u2192 takes the first step, Space plays, ? shows every key.", {});
    std::vector<std::string> lacks = ui.session.trace().warnings();
    if (!ui.fonts.lacking.empty()) lacks.push_back(ui.fonts.lacking);
    for (const std::string& lack : lacks) {
      flow(ui, lack, {.color = c.bad});
    }
    return;
  }
  draw_told(ui, found);
  const Explanation told = explain(ui.session.trace(), ui.session.state(), *event);
  tell(ui, told.sentence);
  ImGui::Dummy({1, ui.em * 0.25f});
  const ImVec2 top = ImGui::GetCursorScreenPos();
  for (const std::string& formula : told.formulas) tell_formula(ui, formula, told.owned);
  const ImVec2 bottom{top.x + ImGui::GetContentRegionAvail().x, ImGui::GetCursorScreenPos().y};
  key_to_owners(ui, told.owned);
  if (told.doubt && found.lines.empty()) {
    const Flow doubt{.color = c.bad, .font = ui.fonts.bold};
    flow(ui, *told.doubt, doubt);
  }
  if (!told.values.empty() && ImGui::IsMouseHoveringRect(top, bottom) && ImGui::IsWindowHovered()) {
    std::vector<std::string> lines = exact_lines(told.values);
    if (const std::string line = exact_line(ui.session, {ui.session.position()}); !line.empty())  // moves the replay
      lines.push_back(line);
    tooltip(ui, lines, ImVec2{top.x, bottom.y + ui.em * 0.5f});
  }
}

}  // namespace

const Pane happened_pane{"happened", "WHAT JUST HAPPENED", draw_happened, nullptr, nullptr, 0, true};

}  // namespace zstep::viewer
