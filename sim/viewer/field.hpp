// The one line that is typed in a box: Dear ImGui's own field, with the clipboard of the system.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <SDL.h>
#include <imgui.h>

namespace zstep::viewer {

class App;
struct Ui;

class Field {
 public:
  /// Keys and the clipboard go through the current Dear ImGui context, which it must outlive.
  void connect();

  /// It has the keyboard: what is typed now arrives.
  bool active() const { return active_; }
  /// Left, top, right and bottom of it, as drawn last.
  ImVec4 place() const { return place_; }
  /// What it was given arrives with the next frame, which comes before the next event.
  bool waits() const { return !active_ || put_ || down_; }
  /// Writes this in place of what is typed.
  void put(const std::string& text) { put_ = text; }

  /// Whether a key is the field's, and no command's: letters, what moves in the line, and Ctrl with A, C, V, X, Y, Z.
  static bool takes(SDL_Keycode code, unsigned modifiers);
  /// Such a key goes down; it is up again after the next frame, so that each repetition by the system is one press.
  void press(SDL_Keycode code, unsigned modifiers);
  void after_frame();

  /// Draws it, with a hint where nothing is typed. True when the reader changed what is typed.
  bool draw(App& app, const std::string& hint);
  /// What is typed, as it looks while the keys are elsewhere.
  static void draw_idle(Ui& ui, const std::string& typed, const std::string& hint);

 private:
  static int on_event(ImGuiInputTextCallbackData* data);
  static const char* paste(Field& field);
  static void copy(Field& field, const char* text);

  bool active_ = false;
  ImVec4 place_{0, 0, 0, 0};
  std::string* typed_ = nullptr;
  std::optional<std::string> put_;
  std::optional<ImGuiKey> down_;
  std::string clipboard_;  ///< what is pasted; where there is no window, also what was copied
};

/// A text in pieces that a text event of SDL's takes, none of which ends within a character.
std::vector<std::string> in_text_events(std::string_view text);

}  // namespace zstep::viewer
