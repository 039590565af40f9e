// What the commands of the table do, where that takes more than a line.
#pragma once

#include <algorithm>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer::actions {

/// The command that opens this place, and asked again the link; in a browser the link.
void copy_place(App& app);

template <Unit unit, int direction>
void move(App& app) {
  app.move(unit, direction);
}

/// By polygons; before a class by the lesson's stops, for a clicker has these two keys. It cannot answer a question: on
/// from one is first to its answer. Beyond the last stop, once that was said, is the start page.
template <int direction>
void page(App& app) {
  const bool lesson = app.session().lesson() || app.lesson_waits;
  if (!app.ui().presenter || !lesson || app.racing()) return app.move(Unit::polygon, direction);
  if (direction > 0 && app.session().question_open()) app.session().show_answer();
  else if (!app.next_stop(direction)) app.open_start();
}

template <int direction>
void same_line(App& app) {
  if (const RecordedEvent* event = app.session().event()) app.session().to_step(event->step, direction);
}

template <int direction>
void change_speed(App& app) {
  app.change_speed(direction);
}

template <int direction>
void zoom(App& app) {
  RasterView& view = app.ui().view;
  view.zoom =
      std::clamp(direction > 0 ? view.zoom * 1.25 : view.zoom / 1.25, 1.0, most_zoom(app.session().scene().raster));
  if (view.zoom < 1.01) view = {};
}

/// Moves what is seen by an eighth of it.
template <int x, int y>
void pan(App& app) {
  RasterView& view = app.ui().view;
  const Raster& raster = app.session().scene().raster;
  const double step = std::max(raster.width, raster.height) / view.zoom / 8;
  view.center_x = std::clamp(view.center_x + x * step, -raster.width / 2.0, raster.width / 2.0);
  view.center_y = std::clamp(view.center_y + y * step, -raster.height / 2.0, raster.height / 2.0);
}

/// The selection to the next pixel; the first one is that at work.
template <int x, int y>
void move_selected(App& app) {
  Session& s = app.session();
  const Raster& raster = s.scene().raster;
  const Cell from = s.selected.value_or(s.current_cell().value_or(Cell{0, 0}));
  if (!s.selected) return s.select(from);
  s.select(Cell{std::clamp(from.x + x, 0, raster.width - 1),
                std::clamp(from.y + (raster.y_up ? -y : y), 0, raster.height - 1)});
}

template <int n>
void answer(App& app) {
  app.session().answer(n);
}

/// Around the scene, by degrees; above the highest place comes the lowest.
template <int turn, int tilt>
void walk(App& app) {
  Look& look = app.ui().look;
  look.turn += turn;
  if (tilt > 0) look.tilt = look.tilt < most_tilt ? std::min(look.tilt + tilt, most_tilt) : least_tilt;
}

template <bool stays>
void turn_pen(App& app) {
  app.board().turn_pen(stays);
}

/// Sets one end of what playing repeats; the other is the trace's, or where it was set.
template <bool first>
void set_loop(App& app) {
  Session& s = app.session();
  const std::int64_t here = s.position();
  if (first) s.loop_last = s.loop_last > here ? s.loop_last : s.size(), s.loop_first = here;
  else s.loop_first = s.loop_first < here ? s.loop_first : 0, s.loop_last = here;
  if (!s.loops()) {
    s.loop_first = s.loop_last = 0;
    return app.say("There is no step to repeat here.");
  }
  app.say(fmt::format("Space repeats steps {} to {}; Shift+L ends that.", grouped(s.loop_first), grouped(s.loop_last)));
}

void center_on_pixel(App& app);
void next_vertex(App& app);
void next_edge(App& app);
/// What a stop asks to be marked is marked where the selection is.
void select_current(App& app);
void escape(App& app);
/// Asks for a name only where a bookmark can be kept.
void name_bookmark(App& app);
void fit_range(App& app);
/// A clicker sends a full stop or a B for a black screen.
void next_cause(App& app);
void show_slice(App& app);
void show_error_charts(App& app);
void turn_scene(App& app);
/// T_1 to T_4 one by one, then none of them.
void turn_viewing(App& app);
void turn_spotlight(App& app);
void turn_laser(App& app);
void turn_clock(App& app);
void end_loop(App& app);

}  // namespace zstep::viewer::actions
