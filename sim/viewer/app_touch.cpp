// Fingers before the window: SDL's events in, and what the mouse does for them, a frame at a time.
#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

#include "sim/viewer/app.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
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
  const Touch::Point at{finger.x * static_cast<float>(renderer_.width()),
                        finger.y * static_cast<float>(renderer_.height())};
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
  return static_cast<double>(std::max<std::int64_t>(1, *touch_.due() - now)) / 1000;
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
    event.motion.x = static_cast<int>(std::floor(at.x)), event.motion.y = static_cast<int>(std::floor(at.y));
    handle(event);
    finger_at_ = at;
  };
  const auto button = [&](std::uint8_t which, bool down) {
    SDL_Event event{};
    event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
    event.button.button = which;
    event.button.x = static_cast<int>(std::floor(finger_at_.x)),
    event.button.y = static_cast<int>(std::floor(finger_at_.y));
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

}  // namespace zstep::viewer
