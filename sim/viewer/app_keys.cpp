// Whose a key is: the overlay's, the drawer's, a field's, or a command's; what fingers do, and what moves meanwhile.

#include <algorithm>
#include <imgui_internal.h>
#include <utility>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/words/explain.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

bool App::pick_among(std::size_t rows, SDL_Keycode code) {
  if (code != SDLK_UP && code != SDLK_DOWN) return false;
  picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, std::max(0, index32(rows) - 1));
  scroll_to_picked = true;
  return true;
}

void App::take_found(std::size_t row) {
  const Found taken = finder_.find(*this)[row];  // what is typed goes with the box
  open(Overlay::none);
  taken.go(*this);
}

bool App::pick_found(SDL_Keycode code) {
  const std::vector<Found>& found = finder_.find(*this);
  if (code != SDLK_RETURN) return pick_among(found.size(), code);
  if (picked < size32(found)) take_found(static_cast<std::size_t>(picked));
  return true;
}

bool App::key_of_box(SDL_Keycode code, unsigned modifiers) {
  switch (overlay_) {
    case Overlay::palette:
      return pick_found(code);
    case Overlay::go_to:
      return code == SDLK_RETURN ? go_to_typed(), true : false;
    case Overlay::start:
      return pick_offer(code);
    case Overlay::racers:
      return pick_racer(code);
    case Overlay::film:
      return pick_film(code);
    case Overlay::here:
      return pick_here(code);
    case Overlay::settings:
      return pick_setting(code);
    case Overlay::keys:
    case Overlay::menu:
      return false;
    case Overlay::none:
      break;
  }
  // With Alt the arrows move the selection.
  return drawer_has_keys() && (modifiers & Chord::alt) == 0 && (this->*page_of(drawer_)->key)(code, modifiers);
}

bool App::typing() const {
  if (overlay_ == Overlay::none) return drawer_has_keys() && page_of(drawer_)->typed;
  return overlay_ == Overlay::palette || overlay_ == Overlay::go_to || overlay_ == Overlay::start ||
         overlay_ == Overlay::racers || overlay_ == Overlay::film;
}

/// A key while something is typed that the box does not know has one owner: its field, or a command that keeps out of
/// what is typed. False if the key is left to commands.
bool App::type(SDL_Keycode code, unsigned modifiers) {
  const bool arrow = code == SDLK_LEFT || code == SDLK_RIGHT || code == SDLK_UP || code == SDLK_DOWN;
  const bool leaves = code == SDLK_PAGEUP || code == SDLK_PAGEDOWN || (arrow && (modifiers & Chord::alt) != 0);
  if (leaves && overlay_ == Overlay::none) return false;  // the drawer leaves the run to be seen
  if (Field::takes(code, modifiers)) {
    field_.press(code, modifiers);
    text_taken_ = false;
    return true;
  }
  return !(modifiers & Chord::ctrl) && code != SDLK_ESCAPE && code != SDLK_F1 && code != SDLK_F10 && code != SDLK_F11;
}

bool App::key(const SDL_KeyboardEvent& event) {
  const unsigned modifiers = (event.keysym.mod & KMOD_SHIFT ? Chord::shift : 0u) |
                             (event.keysym.mod & (KMOD_CTRL | KMOD_GUI) ? Chord::ctrl : 0u) |
                             (event.keysym.mod & KMOD_ALT ? Chord::alt : 0u);
  SDL_Keycode code = event.keysym.sym;
  if (code == SDLK_KP_ENTER) code = SDLK_RETURN;
  if (event.type == SDL_KEYUP) {
    for (const Command& command : commands())
      if (command.release && !command.keys.empty() && command.keys[0].key == code) command.release(*this);
    return false;
  }
  if (std::exchange(black_, false)) {
    return true;
  }
  if (key_of_box(code, modifiers) || (typing() && type(code, modifiers)) ||
      (overlay_ == Overlay::none && race_shown_ && race_key(code, modifiers))) {
    return true;
  }
  if (const Command* command = command_for(code, modifiers)) {
    if (event.repeat && command->release) return true;
    if (overlay_ == Overlay::keys || overlay_ == Overlay::menu) {
      const std::string id = command->id;
      if (id != "keys" && id != "menu" && id != "escape") open(Overlay::none);
    }
    session_.message.clear();
    run(*command);
    return true;
  }
  return false;
}

// Fingers before the window: SDL's events in, and what the mouse does for them, a frame at a time.

namespace {

constexpr float finger_width = 44;  ///< in pixels of a common screen

/// The window that lies there over all others.
ImGuiWindow* window_at(ImVec2 at) {
  const auto& windows = ImGui::GetCurrentContext()->Windows;
  for (int k = windows.Size; k-- > 0;) {
    ImGuiWindow* window = windows[k];
    if (window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
        window->OuterRectClipped.Contains(at))
      return window;
  }
  return nullptr;
}

/// The one that scrolls when a finger swipes there, or nothing.
ImGuiWindow* scrolled_at(ImVec2 at) {
  ImGuiWindow* window = window_at(at);
  const auto fits = [&] { return window->ScrollMax.x <= 0 && window->ScrollMax.y <= 0; };
  while (window && fits())
    window = (window->Flags & ImGuiWindowFlags_ChildWindow) != 0 ? window->ParentWindow : nullptr;
  return window;
}

/// As far as zooms by this factor where a wheel's notch zooms by 1.25.
void turn_wheel(float factor) {
  const auto notches = static_cast<float>(portable::log(factor) / portable::log(1.25));
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMouseWheelEvent(0, notches);
#else
  ImGui::GetIO().MouseWheel += notches;
#endif
}

}  // namespace

/// Where a text is, also one that is seen whole: a swipe there neither presses nor drags anything.
bool App::scrolls_at(Touch::Point at) {
  ImGui::SetCurrentContext(context_.context);
  const ImGuiWindow* window = window_at({at.x, at.y});
  return window && (window->Flags & ImGuiWindowFlags_NoScrollbar) == 0;
}

bool App::handle_finger(const SDL_TouchFingerEvent& finger) {
  const Touch::Point at{finger.x * to_float(renderer_.width()), finger.y * to_float(renderer_.height())};
  touch_.slop = 10 * dpi_scale_;
  by_touch_ = true;
  ui_.reads = false;
  if (finger.type == SDL_FINGERDOWN) take_acts(touch_.down(finger.fingerId, at, finger.timestamp));
  else if (finger.type == SDL_FINGERUP) take_acts(touch_.up(finger.fingerId));
  else take_acts(touch_.move(finger.fingerId, at));
  return !acts_.empty();
}

void App::take_acts(const std::vector<Touch::Act>& acts) { acts_.insert(acts_.end(), acts.begin(), acts.end()); }

double App::wait_for_finger(std::int64_t now) {
  take_acts(touch_.wait(now));
  if (!touch_.due()) return 1e9;
  return ratio(std::max<std::int64_t>(1, *touch_.due() - now), 1000);
}

/// Where a finger hits that goes down there; what is written by hand is written where the finger is.
ImVec2 App::aim(Touch::Point at) const {
  return board_.writes() ? ImVec2{at.x, at.y} : targets_.aim({at.x, at.y}, finger_width * dpi_scale_);
}

/// As much of what fingers did as one frame can tell: a button that goes down and up needs two.
void App::act_by_fingers() {
  using Kind = Touch::Act::Kind;
  const auto point = [&](ImVec2 at) {
    SDL_Event event{};
    event.type = SDL_MOUSEMOTION;
    event.motion.x = floor_int(at.x), event.motion.y = floor_int(at.y);
    handle(event);
    finger_at_ = at;
  };
  const auto button = [&](std::uint8_t which, bool down) {
    SDL_Event event{};
    event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
    event.button.button = which;
    event.button.x = floor_int(finger_at_.x), event.button.y = floor_int(finger_at_.y);
    handle(event);
  };
  const auto next_is = [&](Kind kind) { return !acts_.empty() && acts_.front().kind == kind; };
  for (bool framed = false; !framed && !acts_.empty();) {
    const Touch::Act act = acts_.front();
    acts_.pop_front();
    switch (act.kind) {
      case Kind::point:
      case Kind::zoom: {
        // Of a movement only where it has come to: fingers may tell more of it than is drawn.
        ImVec2 at{act.at.x, act.at.y};
        float factor = act.factor;
        for (; next_is(Kind::point) || next_is(Kind::zoom); acts_.pop_front())
          at = {acts_.front().at.x, acts_.front().at.y}, factor *= acts_.front().factor;
        // A wheel and a mouse that moves are not told in the same frame.
        zooms_ = factor != 1 && !zooms_;
        if (zooms_) turn_wheel(factor), acts_.push_front({.kind = Kind::point, .at = {at.x, at.y}});
        else if (point(at); factor != 1) acts_.push_front({.kind = Kind::zoom, .at = {at.x, at.y}, .factor = factor});
        framed = true;
        break;
      }
      case Kind::tap:
      case Kind::right_click: {
        const std::uint8_t which = act.kind == Kind::tap ? SDL_BUTTON_LEFT : SDL_BUTTON_RIGHT;
        point(aim(act.at));
        button(which, true);
        acts_.push_front({.kind = act.kind == Kind::tap ? Kind::release : Kind::release_right});
        framed = true;
        break;
      }
      case Kind::press:
        point(aim(act.at));
        [[fallthrough]];
      case Kind::hold:
        button(act.kind == Kind::press ? SDL_BUTTON_LEFT : SDL_BUTTON_MIDDLE, true);
        framed = true;
        break;
      case Kind::release:
      case Kind::release_right:
      case Kind::let_go:
        button(act.kind == Kind::release         ? SDL_BUTTON_LEFT
               : act.kind == Kind::release_right ? SDL_BUTTON_RIGHT
                                                 : SDL_BUTTON_MIDDLE,
               false);
        framed = true;
        break;
      case Kind::scroll: {
        ImVec2 by{act.by.x, act.by.y};
        for (; next_is(Kind::scroll); acts_.pop_front()) by.x += acts_.front().by.x, by.y += acts_.front().by.y;
        ImGuiWindow* window = scrolled_at(finger_at_);  // where the swipe began
        if (!window) break;
        ImGui::SetScrollX(window, std::clamp(window->Scroll.x - by.x, 0.0f, window->ScrollMax.x));
        ImGui::SetScrollY(window, std::clamp(window->Scroll.y - by.y, 0.0f, window->ScrollMax.y));
        framed = true;
        break;
      }
      case Kind::leave:
        point({-1e6f, -1e6f});
        framed = true;
        break;
    }
  }
  by_touch_ = true;
}

// Motion in the window: panes that go where they lead, and an edge that goes from the edge table to the active edges.

void App::set_reduced_motion(bool reduced) {
  settings_.reduced_motion = reduced;
  say(reduced ? "Nothing moves by itself: panes and rows are where they go at once."
              : "Panes and rows move to where they go.");
}

void App::begin_motion() {
  Fingerprint leads, window;
  take(leads, lead());
  take(leads, viewing_step(ui_) > 0);
  take(window, to_float(renderer_.width()));
  take(window, to_float(renderer_.height()));
  take(window, built_for_);
  take(window, ui_.presenter);
  take(window, ui_.laboratory);
  take(window, drawer_);
  take(window, drawer_is_beside());
  const Layout& l = settings_.layout;
  for (const float part :
       {l.left, l.right, l.code, l.frame, l.table, l.stage, l.both, l.lesson, l.drawer_width, l.drawer_height})
    take(window, part);
  for (const auto& [pane, share] : l.structures) take(window, share);
  motion_.begin(clock_time, moves && !settings_.reduced_motion, leads.value(), window.value(), session_.position());
  begin_arriving();
  if (session_.position() != rows_of_step_) ui_.rows_before = ui_.row_places, rows_of_step_ = session_.position();
  ui_.row_places.clear();
}

/// What a step does is shown on its way where the reader takes that one step, or goes to the lesson's next stop; not
/// while the run is played.
void App::begin_arriving() {
  const int stop_was = std::exchange(stop_before_, session_.stop()),
            viewing_was = std::exchange(viewing_before_, viewing_step(ui_));
  const bool step = session_.position() > rows_of_step_ && rows_of_step_ >= session_.before();
  const bool turns = viewing_before_ > 0 && viewing_before_ == viewing_was + 1;
  if (session_.position() < rows_of_step_ || session_.stop() < stop_was || session_.playing) motion_.skip();
  else if (step || turns || (session_.stop() == stop_was + 1 && stop_was >= 0)) {
    motion_.step_forwards();
    ui_.axes_turn = turns;
    if (motion_.arrived() < 1) ui_.canvases_before = ui_.canvases;
  } else if (session_.position() != rows_of_step_) {
    motion_.skip();
  }
  ui_.arrived = motion_.arrived();
  ui_.on_its_way = false;
  ui_.still = session_.at_rest();
  if (ui_.arrived == 1) ui_.canvases_before.clear();
}

bool App::moving() const {
  return motion_.panes_move() || (motion_.row_moves() && entering_edge()) || ui_.on_its_way || !acts_.empty();
}

bool App::works() const {
  return moving() || film_ || places_.searching() || pixel_overlay_.counts() || (race_ && race_->growth.at_work);
}

std::uint64_t App::moment() {
  Fingerprint print;
  take(print, session_.position());
  take(print, session_.stop());
  take(print, session_.playing);
  take(print, session_.message);
  take(print, overlay_);
  take(print, drawer_);
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
  const std::size_t at = enter->edge;
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
