// Why a polygon is not what is seen: which one is typed or picked, then the verdict with its numbers and its steps,
// each a jump.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/typeset.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

constexpr std::size_t listed = 200;  // polygons; of more, something must be typed

std::string place_text(const std::optional<Cell>& cell) {
  return cell ? fmt::format("at pixel ({}, {})", cell->x, cell->y) : "anywhere";
}

/// Does the step only begin work on something? Then it comes before a verdict and decides nothing.
bool only_begins(const Event& event) {
  const Begins& begins = description_of_kind(event.index()).begins;
  return begins.unit == Unit::polygon || begins.unit == Unit::scan_line;
}

/// From the pixel to the whole picture, or back. True when clicked.
bool turn_button(App& app) {
  return button(app.ui(), app.why_of() ? "Of the whole picture (Tab)" : "Of the pixel (Tab)");
}

bool draw_link(App& app, std::size_t place, float steps, float polygons) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const answers::Link& link = app.why().chain[place];
  const float height = std::round(ui.em * 1.4f);
  const ListRow row = list_row(app, place, height);
  const ImVec2 at = row.at;
  const float y = at.y + ui.em * 0.15f;
  const bool decides = app.why_decides() && link.step == app.why().step;
  draw_text(ui, {at.x + ui.em * 0.5f, y}, ui.fonts.mono, decides ? c.text : c.muted, grouped(link.step));
  if (link.polygon != no_polygon) {
    draw_swatch(ui, {at.x + steps, at.y}, height, app.session().scene(), link.polygon);
    draw_text(ui, {at.x + steps + ui.em, y}, ui.fonts.bold, c.text, polygon_label(app.session().scene(), link.polygon));
  }
  const ImFont* font = decides ? ui.fonts.bold : ui.fonts.text;
  const float x = at.x + steps + polygons;
  const bool to_come = app.is_to_come(link.step);
  draw_text(ui, {x, y}, font, to_come ? c.muted : c.text,
            fitted(ui, font, (to_come ? "to come: " : "") + link.text + (decides ? " \u2014 this decides" : ""),
                   row.end.x - x));
  return row.clicked;
}

}  // namespace

void App::open_why() {
  why_selected_ = session_.selected;
  why_of_ = session_.selected ? session_.selected : session_.current_cell();
  why_anywhere_ = !why_of_;
  const bool from_history =
      drawer_ == Drawer::history && static_cast<std::size_t>(std::max(0, picked)) < history_.size();
  if (from_history) {
    why_of_ = history_of_;
    const std::int32_t polygon = history_[std::max(0, picked)].polygon;
    if (polygon != no_polygon) return ask_why(polygon);
  }
  open(Drawer::why_ask);
  const std::vector<std::int32_t> all = why_candidates();
  const auto at_work = std::find(all.begin(), all.end(), session_.state().machine.polygon);
  if (at_work != all.end()) picked = static_cast<int>(at_work - all.begin());
  scroll_to_picked = true;
}

std::string App::at_this_step(std::optional<Cell> cell, std::int64_t decides) const {
  if (session_.position() >= session_.size()) return "";
  std::string text;
  if (cell) {
    const Picture& picture = session_.state().picture;
    const std::size_t at = picture.at(cell->x, cell->y);
    const bool ink = !picture.ink.empty() && picture.ink[at] != no_ink;
    text = fmt::format("At this step pixel ({}, {}) shows {}. ", cell->x, cell->y,
                       ink                                 ? "a colour of its own"
                       : picture.polygon[at] == no_polygon ? "the background"
                                                           : polygon_label(session_.scene(), picture.polygon[at]));
  }
  if (is_to_come(decides)) text += fmt::format("Step {}, which decides it, is still to come. ", grouped(decides));
  return text + "At the end of the run:";
}

std::vector<std::int32_t> App::why_candidates() const {
  const Scene& scene = session_.scene();
  const std::string wanted = lower_case(typed);
  std::vector<std::int32_t> found;
  // What is meant exactly comes first: "1" is number 1 before it is a part of 10.
  const auto exact = answers::polygon_called(scene, typed);
  if (exact) found.push_back(*exact);
  for (std::size_t k = 0; k < scene.polygons.size() && found.size() < listed; ++k) {
    const auto polygon = index32(k);
    if (exact != polygon && lower_case(polygon_label(scene, polygon)).find(wanted) != std::string::npos)
      found.push_back(polygon);
  }
  return found;
}

void App::find_why() {
  try {
    session_.look_elsewhere([&](Replay& replay) {
      why_ = why_anywhere_ ? answers::why_not(session_.trace(), why_polygon_, &replay)
                           : answers::why_not(session_.trace(), why_polygon_, {why_of_->x, why_of_->y}, &replay);
    });
  } catch (const InputError& error) {
    why_ = {};
    why_.sentence = error.what();
  }
  why_decides_ = why_.step > 0 && why_.step <= session_.size() && !only_begins(session_.trace().event(why_.step).event);
  picked = 0;
  for (std::size_t k = 0; k < why_.chain.size(); ++k)
    if (why_.chain[k].step == why_.step) picked = index32(k);
  scroll_to_picked = true;
}

void App::ask_why(std::int32_t polygon) {
  why_polygon_ = polygon;
  open(Drawer::why);
  find_why();
  if (!why_anywhere_) session_.select(*why_of_);
  else if (why_.pixel) session_.select(Cell{why_.pixel->x, why_.pixel->y});  // for as long as this is open
}

void App::turn_why() {
  if (why_anywhere_ && !why_of_) return say("No pixel is selected or at work; click one, then Y asks about it.");
  why_anywhere_ = !why_anywhere_;
  if (drawer_ == Drawer::why) ask_why(why_polygon_);
}

void App::go_to_link(std::size_t link) {
  picked = index32(link);
  if (link < why_.chain.size()) session_.go_to(why_.chain[link].step);
}

bool App::pick_candidate(SDL_Keycode code, unsigned) {
  const std::vector<std::int32_t> found = why_candidates();
  if (code == SDLK_TAB) return turn_why(), true;
  if (code != SDLK_RETURN) return pick_among(found.size(), code);
  if (static_cast<std::size_t>(picked) < found.size()) ask_why(found[picked]);
  return true;
}

bool App::pick_link(SDL_Keycode code, unsigned) {
  if (code == SDLK_TAB) return turn_why(), true;
  if (code == SDLK_BACKSPACE) return open(Drawer::why_ask), true;
  if (code == SDLK_RETURN) return go_to_link(static_cast<std::size_t>(picked)), true;
  return pick_among(why_.chain.size(), code);
}

void draw_why_ask(App& app) {
  Ui& ui = app.ui();
  const Scene& scene = app.session().scene();
  const float height = std::round(ui.em * 1.4f);
  const bool beside = begin_first(ui, "which", 0.5f, ui.em * 7.4f);
  flow(ui, fmt::format("Why not \u2026 {}?", place_text(app.why_of())), {.font = ui.fonts.bold});
  app.draw_drawer_field("A polygon's name or number");
  const bool turned = turn_button(app);
  ImGui::Dummy({1, std::round(ui.em * 0.3f)});
  flow(ui, "Enter or a click asks.", {.color = ui.colors().muted});
  ImGui::EndChild();
  const std::vector<std::int32_t> found = app.why_candidates();
  std::optional<std::int32_t> clicked;
  begin_second(ui, "polygons", beside);
  const float numbers = std::min(ui.em * 18, ImGui::GetContentRegionAvail().x * 0.6f);
  for (std::size_t place = 0; place < found.size(); ++place) {
    const ListRow row = list_row(app, place, height);
    const ImVec2 at = row.at;
    if (row.clicked) clicked = found[place];
    draw_swatch(ui, {at.x + ui.em * 0.6f, at.y}, height, scene, found[place]);
    draw_text(ui, {at.x + ui.em * 1.8f, at.y + ui.em * 0.15f}, ui.fonts.bold, ui.colors().text,
              fitted(ui, ui.fonts.bold, polygon_label(scene, found[place]), numbers - ui.em * 2.3f));
    draw_text(ui, {at.x + numbers, at.y + ui.em * 0.15f}, ui.fonts.mono, ui.colors().muted,
              fmt::format("number {}", found[place]));
  }
  app.scroll_to_picked = false;
  if (found.empty()) say_empty(ui, "No polygon is called so.");
  if (found.size() >= listed)
    say_empty(ui, fmt::format("{} polygons are listed of {}; type to find others.", listed,
                              grouped(std::ssize(scene.polygons))));
  ImGui::EndChild();
  if (turned) app.turn_why();
  else if (clicked) app.ask_why(*clicked);
}

void draw_why(App& app) {
  Ui& ui = app.ui();
  flow(ui,
       fmt::format("Why not {} {}?", polygon_label(app.session().scene(), app.why_polygon()), place_text(app.why_of())),
       {.font = ui.fonts.bold});
  const bool turned = turn_button(app);
  if (ImGui::GetContentRegionAvail().x > ui.em * 29) ImGui::SameLine(0, std::round(ui.em * 0.6f));
  const bool another = button(ui, "Another polygon (Backspace)");
  ImGui::Dummy({1, std::round(ui.em * 0.3f)});
  // The steps stand right below the verdict; where both are long, each has half of the room.
  const auto& picked_pixel = app.why().pixel;
  const std::string now = app.at_this_step(app.why_of()   ? app.why_of()
                                           : picked_pixel ? std::optional(Cell{picked_pixel->x, picked_pixel->y})
                                                          : std::nullopt,
                                           app.why_decides() ? app.why().step : 0);
  float text = flow_height(ui, app.why().sentence, {}) + ui.em * 0.8f;
  if (!now.empty()) text += flow_height(ui, now, {});
  for (const std::string& line : app.why().formulas) text += formula_height(ui, line, {}) + ui.em * 0.25f;
  if (!app.why().owned.empty()) text += ui.em * 1.5f;
  const bool beside = begin_first(ui, "verdict", 0.45f, text);
  if (!now.empty()) flow(ui, now, {.color = ui.colors().muted});
  flow(ui, app.why().sentence, {});
  for (const std::string& line : app.why().formulas) set_formula(ui, line, {}, app.why().owned);
  key_to_owners(ui, app.why().owned);
  ImGui::EndChild();
  std::optional<std::size_t> clicked;
  begin_second(ui, "links", beside);
  std::int64_t last_step = 0;
  float polygons = 0;
  for (const answers::Link& link : app.why().chain) {
    last_step = std::max(last_step, link.step);
    if (link.polygon == no_polygon) continue;
    const std::string name = polygon_label(app.session().scene(), link.polygon);
    polygons = std::max(polygons, text_size(ui, ui.fonts.bold, name).x + 2 * ui.em);
  }
  const float steps = step_column(ui, last_step);
  for (std::size_t place = 0; place < app.why().chain.size(); ++place)
    if (draw_link(app, place, steps, polygons)) clicked = place;
  if (const std::size_t picked = app.picked; !beside && picked < app.why().chain.size())
    flow(ui, app.why().chain[picked].text, {});
  if (!app.why().chain.empty()) flow(ui, "Enter or a click goes to a step.", {.color = ui.colors().muted});
  ImGui::EndChild();
  app.scroll_to_picked = false;
  if (turned) app.turn_why();
  else if (another) app.open(Drawer::why_ask);
  else if (clicked) app.go_to_link(*clicked);
}

}  // namespace zstep::viewer
