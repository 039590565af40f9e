// Where a number comes from: a line for each step that it passed through, and of the one picked its formulas with all
// digits.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/typeset.hpp"
#include "sim/words/explain.hpp"
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
    what = std::max(what, text_size(ui, ui.fonts.text, link.what).x + ui.em * to_float(link.depth));
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
  const float y = at.y + ui.em * 0.15f, x = at.x + columns.what + ui.em * to_float(link.depth);
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
  const bool beside = begin_first(ui, "links", 0.6f, ui.em * (0.8f + 1.4f * to_float(chain.links.size())));
  const ChainColumns columns = columns_of(ui, chain, ImGui::GetContentRegionAvail().x);
  for (std::size_t place = 0; place < chain.links.size(); ++place)
    if (draw_link(app, place, columns)) clicked = place;
  if (chain.cut) say_empty(ui, "There is more behind that: click one of its numbers at its step.");
  app.scroll_to_picked = false;
  ImGui::EndChild();
  begin_second(ui, "formulas", beside);
  if (const std::size_t picked = std::max(0, app.picked); picked < chain.links.size()) {
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

// All that happened to one pixel: a line for each polygon that reached it, and of the one picked the reason with its
// numbers.

namespace {

/// Where the columns of the list begin, in pixels from its left. Where it is narrow, what is compared is told of the
/// one that is picked alone.
struct VisitColumns {
  float polygon = 0, depth = 0, against = 0, of = 0, outcome = 0;
  bool compared = true;
};

VisitColumns columns_of(App& app, float room) {
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
  columns.compared = columns.outcome + 8 * ui.em <= room;
  if (!columns.compared) columns.outcome = columns.depth;
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
  for (const auto& [x, text, compared] : {std::tuple{ui.em * 0.5f, "step", false},
                                          {columns.polygon, "polygon", false},
                                          {columns.depth, rays ? "t" : "depth", true},
                                          {columns.against, "against", true},
                                          {columns.of, "of", true},
                                          {columns.outcome, "outcome", false}})
    if (columns.compared || !compared) draw_text(ui, {at.x + x, at.y}, ui.fonts.small, ui.colors().muted, text);
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
  const bool stored = columns.compared && visit.stored;
  if (columns.compared && visit.z)
    draw_text(ui, {at.x + columns.depth, y}, ui.fonts.mono, c.text, depth_in_list(*visit.z));
  if (stored) draw_text(ui, {at.x + columns.against, y}, ui.fonts.mono, c.text, depth_in_list(*visit.stored));
  if (stored && visit.stored_polygon == no_polygon)
    draw_text(ui, {at.x + columns.of, y}, ui.fonts.text, c.muted, "background");
  if (stored) draw_polygon(app, {at.x + columns.of, at.y}, y, height, visit.stored_polygon);
  const bool to_come = app.is_to_come(visit.step);
  const std::string outcome =
      (to_come ? "to come: " : "") + answers::outcome_text(app.session().trace(), app.history(), visit);
  draw_text(ui, {at.x + columns.outcome, y}, ui.fonts.text, to_come ? c.muted : c.text,
            fitted(ui, ui.fonts.text, outcome, end.x - at.x - columns.outcome));
  return clicked;
}

}  // namespace

void draw_history(App& app) {
  Ui& ui = app.ui();
  const std::size_t count = app.history().size();
  const std::size_t to_come = std::count_if(app.history().begin(), app.history().end(),
                                            [&](const answers::Visit& one) { return app.is_to_come(one.step); });
  const std::size_t so_far = count - to_come;
  const std::string happened = so_far == 0   ? "nothing happened to it yet"
                               : so_far == 1 ? "one thing happened to it"
                                             : fmt::format("{} things happened to it", so_far);
  flow(ui,
       fmt::format("Pixel ({}, {}): {}{}.", app.history_of().x, app.history_of().y,
                   count == 0 ? "nothing reaches it" : happened,
                   to_come == 0 ? "" : fmt::format(", {} still to come", to_come)),
       {.font = ui.fonts.bold});
  if (count == 0) return say_empty(ui, "Another pixel that is selected is told of here.");
  std::optional<std::size_t> clicked;
  const bool beside = begin_first(ui, "visits", 0.66f, ui.em * (2.2f + 1.4f * to_float(count)));
  const VisitColumns columns = columns_of(app, ImGui::GetContentRegionAvail().x);
  draw_headings(app, columns);
  for (std::size_t place = 0; place < count; ++place)
    if (draw_visit(app, place, columns)) clicked = place;
  app.scroll_to_picked = false;
  ImGui::EndChild();
  begin_second(ui, "why", beside);
  if (const std::size_t picked = std::max(0, app.picked); picked < count) {
    const answers::Visit& visit = app.told_visit(picked);
    if (app.is_to_come(visit.step))
      flow(ui, fmt::format("Still to come, at step {}:", grouped(visit.step)), {.color = ui.colors().muted});
    flow(ui, visit.sentence, {});
    for (const std::string& line : visit.formulas) set_formula(ui, line, {}, visit.owned);
    key_to_owners(ui, visit.owned);
  }
  flow(ui, "Enter or a click goes there; Y asks why the one picked is not seen.", {.color = ui.colors().muted});
  ImGui::EndChild();
  if (clicked) app.go_to_visit(*clicked);
}

}  // namespace zstep::viewer
