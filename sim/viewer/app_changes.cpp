// What if: what a reader changes of the run, and how the window stays where it was.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "algorithms/catalog/catalog.hpp"
#include "sim/query/database.hpp"
#include "sim/scenes/save_scene.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

const Method* method_of(const Header& header) {
  for (const Method& one : methods())
    if (one.id == header.algorithm) return &one;
  return nullptr;
}

}  // namespace

std::vector<Changeable> App::found_changeables() const {
  const Method* method = method_of(session_.header());
  if (!method) return {};
  std::string name = typed.substr(0, typed.find('='));
  while (!name.empty() && name.back() == ' ') name.pop_back();
  const std::string part = lower_case(name);
  std::vector<Changeable> found;
  for (Changeable& one : changeables(*method, session_.scene(), session_.header().conventions))
    if (lower_case(one.name).find(part) != std::string::npos) found.push_back(std::move(one));
  // What is named whole comes first: vertex 1 before vertex 10.
  std::stable_partition(found.begin(), found.end(),
                        [&](const Changeable& one) { return lower_case(one.name) == part; });
  return found;
}

void App::open_what_if() {
  if (drawer_ == Drawer::what_if) return open(Drawer::none);
  if (!may_change()) return say("This run cannot be changed from here.");
  if (!method_of(session_.header())) return say("The method of this run is none of zstep's, so it cannot be run anew.");
  open(Drawer::what_if);
  if (can_pull_vertices(session_.scene())) ui_.from_outside = true;
}

const Task* App::task() const {
  const Lesson* lesson = session_.lesson();
  if (!lesson || session_.stop() < 0) return task_before_;
  const std::optional<Task>& task = lesson->stops[session_.stop()].task;
  return task ? &*task : nullptr;
}

bool App::next_stop(int direction) {
  if (session_.lesson() || !lesson_waits) return session_.next_stop(direction);
  requests.back_to_lesson = direction;
  return true;
}

void App::give_hint() {
  const Task* asked = task();
  if (!asked) return;
  if (hints_given_ < asked->hints.size()) {
    ++hints_given_;
    return;
  }
  requests.change_goes_on = false;
  for (const std::string& change : asked->solution) requests.changes.push_back(read_change(change));
}

void App::ask_change(Change change, bool goes_on) {
  wrong.clear();
  requests.changes = {std::move(change)}, requests.change_goes_on = goes_on;
}

void App::change_typed() {
  try {
    ask_change(read_change(typed, ""));
  } catch (const InputError& error) {
    say_unchanged(error.what());
  }
}

void App::nudge(const Changeable& what, int direction) {
  if (!what.choices.empty()) {
    const std::ptrdiff_t count = what.choices.size();
    const auto now = std::find(what.choices.begin(), what.choices.end(), what.value) - what.choices.begin();
    return ask_change({what.name, what.choices[(now % count + direction + count) % count]});
  }
  if (what.nudge == 0) return put(fmt::format("{} = {}", what.name, what.value));
  // In whole steps, so that 0.1 and 0.2 give 0.3.
  const double steps = std::round(std::stod(what.value) / what.nudge) + direction;
  ask_change({what.name, fmt::format("{:.12g}", steps * what.nudge)});
}

void App::show_changes(Changed changed, std::shared_ptr<const Trace> before) {
  changed_ = std::move(changed);
  saved_scene_.clear();
  ui_.before = nullptr;
  before_ui_.reset(), before_.reset();
  if (before && before->size() + session_.size() <= most_steps_matched &&
      before->header().algorithm == session_.header().algorithm) {
    before_ = std::make_unique<BeforeChange>(session_, std::move(before));
    before_ui_ = std::make_unique<Ui>(before_->session(), renderer_);
  }
}

void App::say_unchanged(const std::string& why) {
  if (drawer_ == Drawer::what_if) wrong = why;
  else say(why);
}

bool App::pick_changeable(SDL_Keycode code, unsigned modifiers) {
  const bool ctrl = (modifiers & Chord::ctrl) != 0;
  if (ctrl && typed.empty() && (code == SDLK_z || code == SDLK_y)) {
    requests.undo_change = code == SDLK_z ? 1 : -1;
    return true;
  }
  if (ctrl && code == SDLK_h) return give_hint(), true;
  if (ctrl && (modifiers & Chord::shift) != 0 && code == SDLK_s) return save_scene(), true;
  const std::vector<Changeable> found = found_changeables();
  const std::size_t row = std::max(0, picked);
  if (code == SDLK_RETURN) {
    if (typed.find('=') != std::string::npos) change_typed();
    else if (row < found.size()) put(fmt::format("{} = {}", found[row].name, found[row].value));
    return true;
  }
  if (!ctrl || (code != SDLK_UP && code != SDLK_DOWN)) return pick_among(found.size(), code);
  if (row < found.size()) nudge(found[row], code == SDLK_UP ? 1 : -1);
  return true;
}

void App::save_scene() {
  try {
    const Scene& scene = session_.scene();
    const std::filesystem::path path = name_for_changed(scene, "");
    const Header& header = session_.header();
    const std::string told = zstep::save_scene(path, scene, header.conventions, header.algorithm);
    saved_scene_ =
        fmt::format("Saved {} in the folder zstep was started in.{}", path.string(), told.empty() ? "" : " " + told);
    wrong.clear();
    say(saved_scene_);
  } catch (const InputError& error) {
    saved_scene_.clear();
    say_unchanged(error.what());
  }
}

/// The vertex that a hand moved in this frame.
void App::take_vertex() {
  if (!std::exchange(ui_.moved_vertex, false) || !ui_.taken) return;
  const glm::dvec3& to = ui_.taken->point;
  ask_change({fmt::format("vertex {}", ui_.taken->vertex), fmt::format("{:.12g} {:.12g} {:.12g}", to.x, to.y, to.z)},
             std::exchange(ui_.taken->moved, true));
}

/// What was asked of that run is asked of this one, where that means something here.
void App::ask_again(const App& before) {
  const Raster& raster = session_.scene().raster;
  const auto here = [&](const std::optional<Cell>& cell) {
    return !cell || (cell->x < raster.width && cell->y < raster.height);
  };
  why_of_ = before.why_of_, why_anywhere_ = before.why_anywhere_, why_polygon_ = before.why_polygon_;
  const bool known = here(why_of_) && static_cast<std::size_t>(why_polygon_) < session_.scene().polygons.size();
  const bool asks_why = drawer_ == Drawer::why || drawer_ == Drawer::why_ask;
  if (drawer_ == Drawer::history && here(before.history_of_)) return look_at_history(before.history_of_);
  if (drawer_ == Drawer::why && known) return find_why();
  if (drawer_ == Drawer::history || drawer_ == Drawer::explain || (asks_why && !known)) open(Drawer::none);
}

void App::look_as(const App& before) {
  drawer_ = before.drawer_, keys_in_drawer_ = before.keys_in_drawer_;
  task_before_ = before.task();
  hints_given_ = before.hints_given_;
  put(before.typed);
  picked = before.picked;
  chosen_lead_ = before.chosen_lead_;
  if (chosen_lead_) chosen_lead_->stop = session_.stop();
  ui_.chosen_viewing = {viewing_step(before.ui_), session_.stop()};
  ui_.look = before.ui_.look, ui_.from_outside = before.ui_.from_outside;
  ui_.view = before.ui_.view;
  laboratory_ = before.laboratory_;
  ui_.whole_code = before.ui_.whole_code, ui_.vertices_always = before.ui_.vertices_always;
  ui_.range_mode = before.ui_.range_mode, ui_.hand_range = before.ui_.hand_range, ui_.histogram = before.ui_.histogram;
  ui_.relief = before.ui_.relief, ui_.relief_look = before.ui_.relief_look;
  ui_.taken = before.ui_.taken;
  session_.selected = before.session_.selected;
  session_.picked_part = before.session_.picked_part;
  ask_again(before);
  // The hand holds what it held.
  ImGui::SetCurrentContext(before.context_.context);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool down = ImGui::GetIO().MouseDown[0];
  ImGui::SetCurrentContext(context_.context);
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMousePosEvent(mouse.x, mouse.y);
  ImGui::GetIO().AddMouseButtonEvent(0, down);
#else
  ImGui::GetIO().MousePos = mouse, ImGui::GetIO().MouseDown[0] = down;
#endif
}

// Two runs in one window: where the panes of either are.

/// A pane of another run. What a reader does in it, zooming and selecting, this run takes; then it is true.
bool App::draw_beside(Ui& b, const Pane& pane, const std::string& title, ImVec2 at, ImVec2 size) {
  const std::optional<Cell> selected = b.session.selected;
  b.mouse_help.clear();
  b.pointed_next.reset();
  const RasterView view = b.view = ui_.view;
  ImGui::PushID(&b);
  draw_pane(b, pane, title, at, size);
  ImGui::PopID();
  if (!b.mouse_help.empty()) ui_.mouse_help = b.mouse_help;
  if (b.pointed_next) ui_.pointed_next = b.pointed_next;
  if (b.session.selected == selected && b.view == view) return false;
  ui_.view = b.view;
  if (b.session.selected != session_.selected) session_.select(b.session.selected);
  return true;
}

/// A pane of either run.
void App::draw_of(bool first, const Pane& pane, ImVec2 at, ImVec2 size) {
  const std::string title = fmt::format("{}: {}", first ? "A" : "B", pane.title);
  if (first) draw_pane(ui_, pane, title, at, size);
  else draw_beside(*other_ui_, pane, title, at, size);
}

/// The frames of both side by side, and their depth buffers, in one row or two, whichever shows larger pixels; below
/// them what the method lives by, with what both have of it.
void App::draw_panes_of_both(ImVec2 at, ImVec2 size) {
  Layout& l = settings_.layout;
  const float gap = std::round(ui_.em * 0.35f);
  const Header &header = session_.header(), &other = against_->session().header();
  const Pane *depths = depth_pane_of(header), *other_depths = depth_pane_of(other);
  const Docked dock = docked(size, {0, 0}, size, 2);  // always below: the frames want all of the width
  if (dock.side != Docked::Side::nowhere) {
    drawer_at_ = {{at.x, at.y + size.y - dock.room}, {size.x, dock.room}};
    pull_drawer(dock, size);
    size.y -= dock.room + gap;
  }
  const bool narrow = size.x < ui_.em * 44 || size.y < ui_.em * 21;
  const Workspace stage = workspace(header, lead());
  const float left = narrow ? 0 : std::round(size.x * l.left);
  if (!narrow) {
    // A class needs no code beside two runs.
    const float code = ui_.presenter ? 0 : std::round(size.y * 0.34f),
                said = std::round((size.y - code - (ui_.presenter ? gap : 2 * gap)) / 2);
    float y = at.y;
    if (!ui_.presenter) {
      draw_pane(pseudo_code_pane, {at.x, y}, {left, code});
      y += code + gap;
    }
    draw_of(true, happened_pane, {at.x, y}, {left, said});
    draw_of(false, happened_pane, {at.x, y + said + gap}, {left, at.y + size.y - y - said - gap});
    splitter("left", {at.x + left, at.y}, {gap, size.y}, true, l.left, size.x);
    l.left = std::clamp(l.left, 0.1f, 0.55f);
  }
  const float x = narrow ? at.x : at.x + left + gap, middle = at.x + size.x - x;
  const float upper = narrow ? size.y : std::round((size.y - gap) * l.both);
  std::vector<std::pair<bool, const Pane*>> panes{{true, &frame_pane}, {false, &frame_pane}};
  if (depths && other_depths && !narrow) panes.insert(panes.end(), {{true, depths}, {false, other_depths}});
  const Raster& raster = session_.scene().raster;
  const auto pixel = [&](int columns, int rows) {
    return std::min((middle / to_float(columns) - 3 * ui_.em) / to_float(raster.width),
                    (upper / to_float(rows) - 4 * ui_.em) / to_float(raster.height));
  };
  const int count = size32(panes);
  const int rows = count > 2 && pixel(2, 2) > pixel(4, 1) ? 2 : 1, columns = count / rows;
  for (int i = 0; i < count; ++i) {
    const auto part = [gap](float from, float room, int place, int parts) {
      const float each = (room - gap * to_float(parts - 1)) / to_float(parts);
      return std::make_pair(std::round(from + to_float(place) * (each + gap)), std::floor(each));
    };
    const auto [px, width] = part(x, middle, i % columns, columns);
    const auto [py, height] = part(at.y, upper, i / columns, rows);
    const auto& [first, pane] = panes[i];
    draw_of(first, *pane, {px, py}, {width, height});
  }
  if (narrow) return;
  // What leads is here the slice, or what the method lives by; the frames have the stage.
  std::vector<Pane> below;
  for (const std::vector<Pane>* some : {&stage.leading, &stage.small})
    for (const Pane& pane : *some)
      if (pane.id != frame_pane.id && !(depths && pane.id == depths->id)) below.push_back(pane);
  std::stable_partition(below.begin(), below.end(), [&](const Pane& pane) { return pane.id == lead(); });
  draw_small(below, {x, at.y + upper + gap}, {middle, size.y - upper - gap});
  splitter("both", {x, at.y + upper}, {middle, gap}, false, l.both, size.y - gap);
}

// What is asked of the trace by a key or a click, and where its answers lead: pixel history, the origin of a number,
// SQL.

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
    if (history_[i].step <= session_.position()) picked = index32(i);
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
  picked = index32(link);
  if (link >= chain_.links.size()) return;
  if (chain_.links[link].step > 0) session_.go_to(chain_.links[link].step);
  else
    say("This is in the scene itself" +
        (chain_.links[link].source.empty() ? "." : ": " + chain_.links[link].source + "."));
}

void App::copy_origin() {
  const std::size_t place = std::max(0, picked);
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
  picked = index32(visit);
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
  picked = index32(row);
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
