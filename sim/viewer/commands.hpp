// The one table of everything a reader can do: keys, the key sheet, the palette and the menu come from it.
#pragma once

#include <SDL.h>
#include <span>
#include <string>
#include <vector>

namespace zstep::viewer {

class App;

/// A key with modifiers, or a character however it is typed on this keyboard ("?" needs Shift on some, not on all).
struct Chord {
  enum : unsigned { none = 0, shift = 1, ctrl = 2, alt = 4 };
  SDL_Keycode key = 0;
  unsigned modifiers = none;
  char character = 0;
};

struct Command {
  const char* id;
  const char* group;  ///< heading in menu and key sheet
  const char* title;
  std::vector<Chord> keys;
  void (*run)(App&);
  void (*release)(App&) = nullptr;  ///< for keys that are held
};

std::span<const Command> commands();

/// "Shift+→"
std::string chord_name(const Chord& chord);
/// All of a command's keys: "→", "? or F1".
std::string key_names(const Command& command);

/// The command of a key press, or nullptr.
const Command* command_for(SDL_Keycode key, unsigned modifiers);
const Command* command_for(char character);

/// The command of this id, or nullptr.
const Command* command_called(std::string_view id);

/// What is typed, in words.
class TypedWords {
 public:
  explicit TypedWords(const std::string& typed);
  /// Whether a text holds all of them, in any order, in large or small letters.
  bool all_in(const std::string& text) const;

 private:
  std::vector<std::string> words_;
};

/// Commands whose title holds them, in table order.
std::vector<const Command*> matching(const std::string& typed);

}  // namespace zstep::viewer
