// What the step did: a sentence, and the formula with its numbers.
#include <fmt/format.h>

#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/words/explain.hpp"

namespace zstep::viewer {
namespace {

void draw(Ui& ui) {
  const Theme& c = ui.colors();
  const RecordedEvent* event = ui.session.event();
  if (!ui.session.message.empty()) {
    Flow how;
    how.color = c.now;
    how.font = ui.fonts.bold;
    flow(ui, ui.session.message, how);
  }
  if (!event) {
    if (ui.session.size() == 0) return say_empty(ui, "This trace has no events: the run recorded nothing.");
    flow(ui, "Nothing has happened yet. \u2192 takes the first step, Space plays, ? shows every key.", {});
    std::vector<std::string> lacks = ui.session.trace().warnings();
    if (!ui.fonts.lacking.empty()) lacks.push_back(ui.fonts.lacking);
    for (const std::string& lack : lacks) {
      Flow how;
      how.color = c.bad;
      flow(ui, lack, how);
    }
    return;
  }
  const Explanation told = explain(ui.session.trace(), ui.session.state(), *event);
  flow(ui, told.sentence, {});
  ImGui::Dummy({1, ui.em * 0.25f});
  Flow how;
  how.font = ui.fonts.mono;
  how.indent = ui.em;
  const ImVec2 top = ImGui::GetCursorScreenPos();
  for (const std::string& formula : told.formulas) flow(ui, formula, how);
  const ImVec2 bottom{top.x + ImGui::GetContentRegionAvail().x, ImGui::GetCursorScreenPos().y};
  if (told.doubt) {
    Flow doubt;
    doubt.color = c.bad;
    doubt.font = ui.fonts.bold;
    flow(ui, *told.doubt, doubt);
  }
  if (!told.values.empty() && ImGui::IsMouseHoveringRect(top, bottom) && ImGui::IsWindowHovered()) tooltip(ui, exact_lines(told.values));
}

}  // namespace

const Pane happened_pane{"happened", "WHAT JUST HAPPENED", draw, nullptr, nullptr, 0, true};

}  // namespace zstep::viewer
