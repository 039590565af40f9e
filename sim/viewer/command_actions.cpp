#include "sim/viewer/command_actions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/viewer/system.hpp"
#include "sim/words/numbers.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer::actions {
namespace {

/// Lets a pane lead, and the second time what led before.
void toggle_lead(App& app, const Pane& pane, const char* lacking) {
  if (!pane.serves(app.session().header())) return app.say(lacking);
  app.set_lead(app.lead() == pane.id ? "" : pane.id);
}

}  // namespace

void center_on_pixel(App& app) {
  const Session& s = app.session();
  const auto cell = s.current_cell() ? s.current_cell() : s.selected;
  if (!cell) return app.say("No pixel is at work or selected.");
  const Raster& raster = s.scene().raster;
  RasterView& view = app.ui().view;
  if (view.zoom < 1.01) view.zoom = std::max(2.0, std::max(raster.width, raster.height) / 16.0);
  view.center_x = cell->x + 0.5 - raster.width / 2.0;
  view.center_y = (raster.y_up ? raster.height - 1 - cell->y : cell->y) + 0.5 - raster.height / 2.0;
}

namespace {

/// Picks the scene's next vertex or edge, and after the last one nothing.
void next_part(App& app, bool vertices) {
  Session& s = app.session();
  std::vector<ScenePart> parts;
  const std::vector<EdgeEnds> edges = edges_of(s.scene());
  if (edges.empty()) return app.say("There are too many vertices to go through one by one.");
  if (vertices) {
    std::set<std::int32_t> numbers;
    for (const EdgeEnds& ends : edges) numbers.insert({ends.first, ends.second});
    for (const std::int32_t number : numbers) parts.push_back({number, {}});
  } else {
    for (const EdgeEnds& ends : edges) parts.push_back({{}, ends});
  }
  const auto now = std::find(parts.begin(), parts.end(), s.picked_part);
  s.pick(now == parts.end() ? parts.front() : std::next(now) == parts.end() ? ScenePart{} : *std::next(now));
}

}  // namespace

void next_vertex(App& app) { next_part(app, true); }

void next_edge(App& app) {
  Session& s = app.session();
  const int count = size32(s.state().machine.edge_table);
  if (count == 0) return next_part(app, false);
  s.picked_part = {};
  const int next = s.selected_edge ? *s.selected_edge + 1 : 0;
  s.selected_edge = next < count ? std::optional(next) : std::nullopt;
}

void select_current(App& app) {
  Session& s = app.session();
  if (s.marks_cells() && s.selected) return s.mark(*s.selected);
  if (const auto cell = app.session().current_cell()) app.session().select(cell);
  else app.say("No pixel is at work; click one, or type its column and row after G.");
}

void escape(App& app) {
  if (app.waits_for_run) return void(app.requests.end_run = true);
  if (app.places().searching()) return app.places().stop();
  if (app.overlay() == Overlay::keys) return app.turn_key_sheet();
  if (app.overlay() != Overlay::none) return app.open(Overlay::none);
  if (app.drawer() != Drawer::none) return app.open(Drawer::none);
  Session& s = app.session();
  if (app.board().put_away()) return;
  if (app.racing()) return app.close_race();
  if (app.ui().heat) return app.end_painting();
  s.selected.reset();
  s.selected_edge.reset();
  s.picked_part = {};
  s.message.clear();
  s.playing = false;
}

void name_bookmark(App& app) {
  const std::string fault = app.places().why_no_bookmark();
  if (fault.empty()) app.open(Drawer::name_bookmark);
  else app.say(fault);
}

void fit_range(App& app) {
  Ui& ui = app.ui();
  const Session& s = app.session();
  if (!depth_pane_of(s.header()))
    return app.say("There are no depths in this trace, so there are no colours to fit to them.");
  const std::vector<double>& depths = s.picture().depth;
  const bool any = std::any_of(depths.begin(), depths.end(), [](double z) { return std::isfinite(z); });
  ui.range_mode = ui.range_mode == Ui::RangeMode::whole ? Ui::RangeMode::fitted : Ui::RangeMode::whole;
  app.say(ui.range_mode == Ui::RangeMode::fitted
              ? any ? "The colours span the depths that are shown."
                    : "No depths are shown yet; the colours will span those that are."
              : "The colours span all depths of the trace.");
}

void next_cause(App& app) {
  if (app.ui().presenter && !app.has_causes()) app.make_black();
  else app.to_cause(1);
}

void show_slice(App& app) {
  toggle_lead(app, slice_pane, "This method compares no depths along scan lines, so there is no slice.");
}

void show_error_charts(App& app) {
  toggle_lead(app, depth_error_pane, "This method interpolates no depths along spans, so no errors add up there.");
}

void turn_scene(App& app) {
  Ui& ui = app.ui();
  ui.from_outside = !seen_from_outside(ui);
  ui.look = {};
}

void turn_viewing(App& app) {
  Ui& ui = app.ui();
  if (!has_viewing_steps(app.session().scene()))
    return app.say("This camera is tilted or has no eye: T\u2081 to T\u2084 do not make up its viewing.");
  choose_viewing_step(ui, (viewing_step(ui) + 1) % 5);
  if (viewing_step(ui) > 0) ui.from_outside = true, app.set_lead("scene");
}

void turn_spotlight(App& app) { app.board().turn_spotlight(); }

void turn_laser(App& app) { app.board().turn_laser(); }

void turn_clock(App& app) { app.board().turn_clock(app.clock_time); }

void copy_place(App& app) {
  const std::string command = app.command_line(), address = system::address();
  const std::optional<std::string> link = app.link();
  const bool again = app.copied == command;
  if (link && (again || !address.empty())) app.copied = address + *link;
  else if (address.empty()) app.copied = command;
  else return app.say("A link opens what zstep has; this is a file, or changed too much for one: save it instead.");
  app.requests.clipboard = app.copied;
  app.say("Copied: " + app.copied + (link && app.copied == command ? "  Once more: as a link." : ""));
}

void end_loop(App& app) {
  app.session().loop_first = app.session().loop_last = 0;
  app.say("Playing repeats nothing.");
}

}  // namespace zstep::viewer::actions
