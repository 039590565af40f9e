// Motion in the window: panes that go where they lead, and an edge that goes from the edge table to the active edges.
#include <algorithm>
#include <utility>

#include "sim/viewer/app.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/words/explain.hpp"

namespace zstep::viewer {

void App::set_reduced_motion(bool reduced) {
  settings_.reduced_motion = reduced;
  say(reduced ? "Nothing moves by itself: panes and rows are where they go at once."
              : "Panes and rows move to where they go.");
}

void App::begin_motion() {
  Fingerprint leads, window;
  take(leads, lead());
  take(leads, viewing_step(ui_) > 0);
  take(window, static_cast<float>(renderer_.width()));
  take(window, static_cast<float>(renderer_.height()));
  take(window, built_for_);
  take(window, ui_.presenter);
  take(window, static_cast<int>(drawer_));
  take(window, drawer_is_beside());
  const Layout& l = settings_.layout;
  for (const float part :
       {l.left, l.right, l.code, l.frame, l.table, l.stage, l.both, l.words, l.drawer_width, l.drawer_height})
    take(window, part);
  for (const auto& [pane, share] : l.structures) take(window, share);
  motion_.begin(clock_time, moves && !settings_.reduced_motion, leads.value(), window.value(), session_.position());
  if (session_.position() != rows_of_step_) ui_.rows_before = ui_.row_places, rows_of_step_ = session_.position();
  ui_.row_places.clear();
}

bool App::moving() const { return motion_.panes_move() || (motion_.row_moves() && entering_edge()) || !acts_.empty(); }

bool App::works() const {
  return moving() || film_ || places_.searching() || pixel_overlay_.counts() || (race_ && race_->growth.at_work);
}

std::uint64_t App::moment() {
  Fingerprint print;
  take(print, session_.position());
  take(print, session_.stop());
  take(print, session_.playing);
  take(print, session_.message);
  take(print, static_cast<int>(overlay_));
  take(print, static_cast<int>(drawer_));
  take(print, wrong);
  if (against_) take(print, against_->session().position());
  if (race_) take(print, race_->race.at()), take(print, race_->race.playing);
  return print.value();
}

const EdgeEnter* App::entering_edge() const {
  return session_.event() ? get_if<EdgeEnter>(&session_.event()->event) : nullptr;
}

/// From its row of the edge table, or from where it waited among the active edges, to its row there.
void App::draw_entering_edge() {
  const EdgeEnter* const enter = entering_edge();
  if (!enter || !motion_.row_moves()) return;
  const auto place = [&](const RowPlaces& rows, const char* table) -> const Motion::Place* {
    const auto found = rows.find({table, enter->edge});
    return found == rows.end() ? nullptr : &found->second;
  };
  const Motion::Place* from = place(ui_.row_places, "edges");
  if (!from) from = place(ui_.rows_before, "active");
  const Motion::Place* to = place(ui_.row_places, "active");
  if (!from || !to) return;
  const Motion::Place now = motion_.of_row(*from, *to);
  const ImVec2 end{now.at.x + now.size.x, now.at.y + now.size.y};
  const auto& table = session_.state().machine.edge_table;
  const auto at = static_cast<std::size_t>(enter->edge);
  ImDrawList* list = ImGui::GetForegroundDrawList();
  list->AddRectFilled(now.at, end, ui_.colors().now_soft);
  const float thick = std::max(1.0f, 2 * ui_.thin);
  for (const float y : {now.at.y, end.y - thick})
    list->AddRectFilled({now.at.x, y}, {end.x, y + thick}, ui_.colors().now);
  for (const float x : {now.at.x, end.x - thick})
    list->AddRectFilled({x, now.at.y}, {x + thick, end.y}, ui_.colors().now);
  if (at < table.size())
    list->AddText(ui_.fonts.mono, ui_.fonts.mono->FontSize, {now.at.x + ui_.em * 0.4f, now.at.y + 2}, ui_.colors().text,
                  ui_.fonts.drawable(edge_label(session_.scene(), table[at])).c_str());
}

}  // namespace zstep::viewer
