// What if: what a reader changes of the run, and how the window stays where it was.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "sim/scenes/save_scene.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "traces/error.hpp"

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
  const std::string part = lower(name);
  std::vector<Changeable> found;
  for (Changeable& one : changeables(*method, session_.scene(), session_.header().conventions))
    if (lower(one.name).find(part) != std::string::npos) found.push_back(std::move(one));
  // What is named whole comes first: vertex 1 before vertex 10.
  std::stable_partition(found.begin(), found.end(), [&](const Changeable& one) { return lower(one.name) == part; });
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
  const std::optional<Task>& task = lesson->stops[static_cast<std::size_t>(session_.stop())].task;
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
    const auto count = static_cast<std::ptrdiff_t>(what.choices.size());
    const auto now = std::find(what.choices.begin(), what.choices.end(), what.value) - what.choices.begin();
    return ask_change({what.name, what.choices[static_cast<std::size_t>((now % count + direction + count) % count)]});
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
  const auto row = static_cast<std::size_t>(std::max(0, picked));
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

}  // namespace zstep::viewer
