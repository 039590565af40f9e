// What a speaker reads on a screen of her own: where the lesson is, what to say there, what comes next, and the time.
#pragma once

#include <memory>
#include <string>

#include "sim/viewer/app.hpp"
#include "sim/viewer/window.hpp"

namespace zstep::viewer {

class Notes {
 public:
  Notes(int width, int height, float dpi_scale = 1);
  ~Notes();
  Notes(const Notes&) = delete;
  Notes& operator=(const Notes&) = delete;

  void resize(int width, int height, float dpi_scale);
  /// Draws what the App stands at, unless that was drawn last; true if it did. `time`: of day, as it is to be read.
  bool follow(App& app, const std::string& time);
  bool whole() const { return whole_; }  ///< nothing lies below the window's lower edge
  const Renderer& renderer() const { return renderer_; }
  ImGuiContext* context() const { return context_; }
  const Fonts& fonts() const { return ui_->fonts; }

 private:
  /// All that what is drawn depends on.
  struct Seen {
    const Session* session = nullptr;
    std::int64_t position = -1;
    int stop = -2, width = 0, height = 0;
    bool dark = false;
    float text_scale = 0, dpi_scale = 0;
    std::string clock, time;
    bool operator==(const Seen&) const = default;
  };
  /// With body text of so many pixels; how far down it comes.
  float draw(float em);
  void draw_head(ImVec2 at, float width);
  void draw_stop();
  void draw_beside();

  ImGuiContext* context_;
  Renderer renderer_;
  float dpi_scale_;
  std::unique_ptr<Ui> ui_;  ///< of the session that was seen last
  Seen seen_;
  bool whole_ = false;
};

/// When the speaker is meant to be at a stop, by the minutes of those before it: "9:00 to 10:30 of 20:00"; empty where
/// no stop says how long it takes.
std::string planned(const Lesson& lesson, int stop);

// The speaker's notes in a window of the system's, while they are open. Closing it changes nothing else.

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
