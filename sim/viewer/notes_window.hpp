// The speaker's notes in a window of the system's, while they are open. Closing it changes nothing else.
#pragma once

#include <memory>

#include "sim/viewer/notes.hpp"
#include "sim/viewer/window.hpp"

namespace zstep::viewer {

class NotesWindow {
 public:
  /// Beside this one, which must live longer.
  explicit NotesWindow(const Window& first) : first_(first) {}

  void toggle(App& app);
  /// True for what is of the notes and not of the first window: its size and its end, and the mouse over it. Keys are
  /// the first window's wherever they are pressed.
  bool takes(const SDL_Event& event, App& app);
  /// Opens and closes as a class begins and ends, and draws what has changed.
  void follow(App& app);
  bool is_open() const { return window_ != nullptr; }
  double until_due() const;  ///< seconds until the time on it is another

 private:
  void open(App& app);
  void close();

  const Window& first_;
  std::unique_ptr<Window> window_;  ///< none: closed
  std::unique_ptr<Notes> notes_;
  bool before_class_ = false, by_itself_ = false, exposed_ = false;
};

/// Whether notes open by themselves: before a class, with a screen that the class does not see.
bool notes_open_by_themselves(bool presenter, bool lesson, int screens);

}  // namespace zstep::viewer
