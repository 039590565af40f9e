// Where a number comes from: a line for each step that it passed through, and of the one picked its formulas with all
// digits.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/words/hex.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

/// The columns of the list, in pixels from its left.
struct ChainColumns {
  float what = 0, formula = 0, source = 0;
};

ChainColumns columns_of(const Ui& ui, const answers::Chain& chain, float room) {
  ChainColumns columns;
  float what = 0, source = 0;
  columns.what = ui.em * 0.5f;
  for (const answers::ChainLink& link : chain.links) {
    columns.what = std::max(columns.what, ui.em * 1.5f + text_size(ui, ui.fonts.mono, grouped(link.step)).x);
    what = std::max(what, text_size(ui, ui.fonts.text, link.what).x + ui.em * static_cast<float>(link.depth));
    source = std::max(source, text_size(ui, ui.fonts.small, link.source).x);
  }
  columns.formula = columns.what + std::min(what, room * 0.45f) + ui.em;
  columns.source = room - source - ui.em * 0.5f;
  if (columns.source - columns.formula < 12 * ui.em) columns.source = room;  // it is told of the one that is picked
  return columns;
}

bool draw_link(App& app, std::size_t place, const ChainColumns& columns) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const answers::ChainLink& link = app.chain().links[place];
  const auto [at, end, clicked, visible] = list_row(app, place, std::round(ui.em * 1.4f));
  if (!visible) return clicked;
  const float y = at.y + ui.em * 0.15f, x = at.x + columns.what + ui.em * static_cast<float>(link.depth);
  draw_text(ui, {at.x + ui.em * 0.5f, y}, ui.fonts.mono, c.muted, link.step == 0 ? "scene" : grouped(link.step));
  draw_text(ui, {x, y}, ui.fonts.text, c.text,
            fitted(ui, ui.fonts.text, link.what, at.x + columns.formula - x - ui.em * 0.5f));
  std::string numbers;
  for (const answers::ChainValue& value : link.values) {
    if (!numbers.empty()) numbers += ",  ";
    numbers += value.name + " = " +
               (value.condition || !value.word.empty() ? answers::result_text(value) : number(value.value, 6, true));
  }
  draw_text(ui, {at.x + columns.formula, y}, ui.fonts.mono, c.text,
            fitted(ui, ui.fonts.mono, numbers, columns.source - columns.formula - ui.em * 0.5f));
  if (!link.source.empty() && at.x + columns.source + ui.em < end.x)
    draw_text(ui, {at.x + columns.source, y}, ui.fonts.small, c.muted, link.source);
  return clicked;
}

}  // namespace

void draw_explain(App& app) {
  Ui& ui = app.ui();
  const answers::Chain& chain = app.chain();
  if (chain.links.empty()) return;
  const answers::ChainLink& last = chain.links.front();
  const answers::ChainValue& asked = last.values.front();
  const bool measured = !asked.condition && asked.word.empty();
  flow(ui,
       fmt::format("Where {} {} {}{}{} comes from. Ctrl+C copies it.", asked.name, measured ? "=" : "is",
                   answers::result_text(asked), measured ? " (" + hex_text(asked.value) + ")" : "",
                   last.step > 0 ? " of step " + grouped(last.step) : ""),
       {.font = ui.fonts.bold});
  std::optional<std::size_t> clicked;
  const bool beside = begin_first(ui, "links", 0.6f, ui.em * (0.8f + 1.4f * static_cast<float>(chain.links.size())));
  const ChainColumns columns = columns_of(ui, chain, ImGui::GetContentRegionAvail().x);
  for (std::size_t place = 0; place < chain.links.size(); ++place)
    if (draw_link(app, place, columns)) clicked = place;
  if (chain.cut) say_empty(ui, "There is more behind that: click one of its numbers at its step.");
  app.scroll_to_picked = false;
  ImGui::EndChild();
  begin_second(ui, "formulas", beside);
  if (const auto picked = static_cast<std::size_t>(std::max(0, app.picked)); picked < chain.links.size()) {
    const answers::ChainLink& link = chain.links[picked];
    flow(ui, link.what + (link.source.empty() ? "" : ", " + link.source), {});
    for (const answers::ChainValue& value : link.values) {
      flow(ui, answers::line_text(value), {.indent = ui.em, .font = ui.fonts.mono});
      const std::string doubted = answers::doubt_text(value);
      if (!doubted.empty()) flow(ui, doubted, {.color = ui.colors().bad, .font = ui.fonts.bold});
    }
  }
  flow(ui, "Enter or a click goes to its step.", {.color = ui.colors().muted});
  ImGui::EndChild();
  if (clicked) app.go_to_origin(*clicked);
}

}  // namespace zstep::viewer
