#include "sim/viewer/notes_window.hpp"

#include <ctime>
#include <stdexcept>
#include <utility>

namespace zstep::viewer {
namespace {

constexpr int usual_width = 1100, usual_height = 700;

bool is_pointer(const SDL_Event& event) {
  return event.type == SDL_MOUSEMOTION || event.type == SDL_MOUSEBUTTONDOWN || event.type == SDL_MOUSEBUTTONUP ||
         event.type == SDL_MOUSEWHEEL || event.type == SDL_FINGERDOWN || event.type == SDL_FINGERMOTION ||
         event.type == SDL_FINGERUP;
}

std::uint32_t window_of(const SDL_Event& event) {
  switch (event.type) {
    case SDL_WINDOWEVENT:
      return event.window.windowID;
    case SDL_MOUSEMOTION:
      return event.motion.windowID;
    case SDL_MOUSEWHEEL:
      return event.wheel.windowID;
    case SDL_FINGERDOWN:
    case SDL_FINGERMOTION:
    case SDL_FINGERUP:
      return event.tfinger.windowID;
    default:
      return event.button.windowID;
  }
}

std::string time_of_day() {
  const std::time_t now = std::time(nullptr);
  char text[8] = "";
  if (const std::tm* local = std::localtime(&now)) std::strftime(text, sizeof text, "%H:%M", local);
  return text;
}

}  // namespace

bool notes_open_by_themselves(bool presenter, bool lesson, int screens) { return presenter && lesson && screens > 1; }

void NotesWindow::toggle(App& app) {
  by_itself_ = false;
  if (window_) close();
  else open(app);
}

void NotesWindow::open(App& app) try {
  window_ = std::make_unique<Window>(first_, "zstep \u00b7 speaker's notes", usual_width, usual_height);
  notes_ = std::make_unique<Notes>(window_->surface()->w, window_->surface()->h, window_->dpi_scale());
  exposed_ = true;
} catch (const std::runtime_error& error) {
  close();
  app.say(error.what());
}

void NotesWindow::close() {
  notes_.reset();
  window_.reset();
}

bool NotesWindow::takes(const SDL_Event& event, App& app) {
  if (!window_ || (event.type != SDL_WINDOWEVENT && !is_pointer(event))) return false;
  const bool own = window_of(event) == SDL_GetWindowID(window_->get());
  if (event.type != SDL_WINDOWEVENT) return own;
  const bool closed = event.window.event == SDL_WINDOWEVENT_CLOSE;
  // With two windows the system says that one is closed, and nothing more.
  if (!own && closed) app.requests.quit = true;
  if (!own) return false;
  if (closed) close();
  else exposed_ = true;
  return true;
}

void NotesWindow::follow(App& app) {
  const bool lesson = app.session().lesson() != nullptr;
  const bool before_class = notes_open_by_themselves(app.settings().presenter, lesson, SDL_GetNumVideoDisplays());
  if (std::exchange(before_class_, before_class) != before_class) {
    if (before_class && !window_) open(app), by_itself_ = true;
    else if (!before_class && window_ && by_itself_) close();
  }
  if (!window_) return;
  const SDL_Surface* surface = window_->surface();
  if (surface->w != notes_->renderer().width() || surface->h != notes_->renderer().height())
    notes_->resize(surface->w, surface->h, window_->dpi_scale());
  const bool drawn = notes_->follow(app, time_of_day());
  if (drawn || std::exchange(exposed_, false)) window_->show(notes_->renderer().picture());
}

double NotesWindow::until_due() const { return window_ ? 60 - static_cast<double>(std::time(nullptr) % 60) : 1e9; }

}  // namespace zstep::viewer
