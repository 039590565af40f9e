// What is asked of the trace by a key or a click, and where its answers lead: pixel history, the origin of a number,
// SQL.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/query/columns.hpp"
#include "sim/viewer/app.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

void App::open_history() {
  const auto cell = session_.selected ? session_.selected : session_.current_cell();
  if (!cell) return say("Click a pixel first; then H tells all that happened to it.");
  look_at_history(*cell);
  if (history_.empty()) return say(fmt::format("Nothing reached pixel ({}, {}).", cell->x, cell->y));
  session_.select(*cell);
  open(Drawer::history);
  pick_visit_before();
}

void App::look_at_history(Cell cell) {
  history_of_ = cell;
  try {
    if (!facets_near_) facets_near_.emplace(session_.trace());
    history_ = answers::pixel_history(session_.trace(), *facets_near_, {cell.x, cell.y});
  } catch (const InputError& error) {
    history_.clear();
    say(error.what());
  }
}

/// The last that is not after where the reader stands.
void App::pick_visit_before() {
  picked = 0;
  for (std::size_t i = 0; i < history_.size(); ++i)
    if (history_[i].step <= session_.position()) picked = static_cast<int>(i);
  scroll_to_picked = true;
}

const answers::Visit& App::told_visit(std::size_t visit) {
  session_.look_elsewhere([&](Replay& replay) { answers::tell(replay, history_[visit]); });
  return history_[visit];
}

void App::open_explain(const answers::Question& question, const std::string& written) {
  answers::Chain chain;
  try {
    session_.look_elsewhere(
        [&](Replay& replay) { chain = answers::explain_value(session_.trace(), replay, question); });
  } catch (const InputError& error) {
    return say(error.what());
  }
  if (chain.links.empty()) return say("The trace does not say where this number comes from.");
  chain_ = std::move(chain);
  open(Drawer::explain);
  if (!written.empty()) picked = static_cast<int>(answers::link_shown_as(chain_, written));
  scroll_to_picked = true;
}

void App::explain_step() {
  // Of the pixel that is selected, where the step is about another one.
  if (const auto& cell = session_.selected; cell && cell != session_.current_cell()) {
    if (!std::isfinite(session_.state().picture.depth[session_.state().picture.at(cell->x, cell->y)]))
      return say(fmt::format("Pixel ({}, {}) has no depth at this step.", cell->x, cell->y));
    return open_explain(answers::of_pixel(session_.position(), {cell->x, cell->y}));
  }
  if (session_.position() == 0)
    return say("Nothing has happened yet; Shift+E tells where the number of a step comes from.");
  open_explain({session_.position()});
}

void App::go_to_origin(std::size_t link) {
  picked = static_cast<int>(link);
  if (link >= chain_.links.size()) return;
  if (chain_.links[link].step > 0) session_.go_to(chain_.links[link].step);
  else
    say("This is in the scene itself" +
        (chain_.links[link].source.empty() ? "." : ": " + chain_.links[link].source + "."));
}

void App::copy_origin() {
  const auto place = static_cast<std::size_t>(std::max(0, picked));
  if (place >= chain_.links.size() || chain_.links[place].values.empty()) return;
  const answers::ChainValue& value = chain_.links[place].values.front();
  requests.clipboard = value.condition || !value.word.empty() ? answers::result_text(value) : exact(value.value);
  say("Copied: " + *requests.clipboard);
}

bool App::pick_visit(SDL_Keycode code, unsigned) {
  if (code == SDLK_RETURN) return go_to_visit(static_cast<std::size_t>(picked)), true;
  return pick_among(history_.size(), code);
}

bool App::pick_origin(SDL_Keycode code, unsigned modifiers) {
  if (code == SDLK_c && modifiers == Chord::ctrl) return copy_origin(), true;
  if (code == SDLK_RETURN) return go_to_origin(static_cast<std::size_t>(picked)), true;
  return pick_among(chain_.links.size(), code);
}

bool App::edit_query(SDL_Keycode code, unsigned) {
  if (code == SDLK_TAB) return paint_answer(), true;
  if (code == SDLK_RETURN) return ask_typed(), true;
  return pick_among(inquiry_.rows().size(), code);
}

void App::go_to_visit(std::size_t visit) {
  picked = static_cast<int>(visit);
  if (visit < history_.size()) session_.go_to(history_[visit].step);
}

void App::ask_typed() {
  if (typed == inquiry_.sql() && !inquiry_.rows().empty()) return go_to_row(static_cast<std::size_t>(picked));
  if (!ends_waiting) return ask_now();
  asking_ = 2;
}

void App::ask_now() {
  inquiry_.ask(typed, ends_waiting);
  picked = 0;
  if (ui_.heat && !pixel_overlay_.shown()) ui_.heat = inquiry_.heat();
}

std::string App::tables() const {
  std::string names;
  for (const std::uint8_t kind : query::kinds_in(session_.trace()))
    names += (names.empty() ? "" : ", ") + query::all_tables()[kind].name;
  return names;
}

void App::go_to_row(std::size_t row) {
  picked = static_cast<int>(row);
  const auto step = inquiry_.step_of(row);
  const auto pixel = inquiry_.pixel_of(row);
  if (step) session_.go_to(*step);
  if (pixel) session_.select(*pixel);
  if (!step && !pixel) say("This row has no step, x or y to go to.");
}

void App::paint_answer() {
  const bool of_answer = ui_.heat && !pixel_overlay_.shown();
  if (of_answer || inquiry_.heat()) end_painting();
  if (of_answer) return;
  if (inquiry_.heat()) ui_.heat = inquiry_.heat();
  else say("Only an answer with columns x and y can be painted.");
}

}  // namespace zstep::viewer
