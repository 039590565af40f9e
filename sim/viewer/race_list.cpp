// Who runs in a race: methods and their options, found by name, in or out by Enter or a click.
#include <algorithm>
#include <cmath>
#include <exception>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/overlays.hpp"

namespace zstep::viewer {

std::vector<const compare::Entrant*> App::found_entrants() const {
  const std::string part = lower(typed);
  std::vector<const compare::Entrant*> found;
  for (const compare::Entrant& one : race_->race.all())
    if (lower(one.title + "\n" + one.text).find(part) != std::string::npos) found.push_back(&one);
  return found;
}

void App::turn_racer(const std::string& entrant) {
  wrong.clear();
  std::vector<std::string> chosen = race().chosen();
  const auto place = std::find(chosen.begin(), chosen.end(), entrant);
  if (place != chosen.end()) chosen.erase(place);
  else chosen.push_back(entrant);
  try {
    if (chosen.size() < Race::least) wrong = "Two at least: choose another one first.";
    else if (chosen.size() > Race::most) wrong = "Four at most: take one out first.";
    else race().choose(chosen), race_->looks.clear();
  } catch (const std::exception& error) {
    wrong = error.what();
  }
}

bool App::pick_racer(SDL_Keycode code) {
  const std::vector<const compare::Entrant*> found = found_entrants();
  if (code != SDLK_RETURN) return pick_among(found.size(), code);
  if (static_cast<std::size_t>(picked) < found.size()) turn_racer(found[static_cast<std::size_t>(picked)]->text);
  return true;
}

void draw_racers_list(App& app) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  begin_overlay(app, "who runs", {ui.em * 30, ui.em * 30});
  flow(ui, "Who runs? Two to four: methods, and their options.", {.font = ui.fonts.bold});
  app.draw_field("Type a part of a name");
  if (!app.wrong.empty()) say_wrong(ui, app.wrong);
  const std::string how = "Enter or a click: in, or out. Esc: to the race.";
  const float foot = flow_height(ui, how, {}) + ui.em * 0.5f, line = std::round(ui.em * 1.4f);
  const std::vector<std::string> chosen = app.race().chosen();
  const auto found = app.found_entrants();
  const compare::Entrant* clicked = nullptr;
  ImGui::BeginChild("entrants", {ImGui::GetContentRegionAvail().x, ImGui::GetContentRegionAvail().y - foot}, false,
                    ImGuiWindowFlags_NoNav);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const ListRow row = list_row(app, k, line);
    if (row.clicked) clicked = found[k];
    if (!row.visible) continue;
    const bool in = std::find(chosen.begin(), chosen.end(), found[k]->text) != chosen.end();
    const float indent = ui.em * (found[k]->changes.empty() ? 1.6f : 3.0f),
                y = row.at.y + std::round((line - ui.em) / 2) - 1;
    if (in) draw_text(ui, {row.at.x + ui.em * 0.4f, y}, ui.fonts.bold, c.good, "\u2713");
    draw_text(ui, {row.at.x + indent, y}, in ? ui.fonts.bold : ui.fonts.text, c.text,
              fitted(ui, in ? ui.fonts.bold : ui.fonts.text, found[k]->title, row.end.x - row.at.x - indent));
  }
  app.scroll_to_picked = false;
  if (found.empty()) say_empty(ui, "No method that can draw this scene has this in its name.");
  ImGui::EndChild();
  flow(ui, how, {.color = c.muted});
  ImGui::End();
  if (clicked) app.turn_racer(clicked->text);
}

}  // namespace zstep::viewer
