// Commands by their keys and by their names: what a chord is called, and which command it is.
#include <algorithm>
#include <cctype>
#include <sstream>

#include "sim/viewer/commands.hpp"

namespace zstep::viewer {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string chord_name(const Chord& chord) {
  if (chord.character) return chord.character == '-' ? "\u2212" : std::string(1, chord.character);
  std::string name;
  if (chord.modifiers & Chord::ctrl) name += "Ctrl+";
  if (chord.modifiers & Chord::alt) name += "Alt+";
  if (chord.modifiers & Chord::shift) name += "Shift+";
  switch (chord.key) {
    case SDLK_RIGHT:
      return name + "\u2192";
    case SDLK_LEFT:
      return name + "\u2190";
    case SDLK_UP:
      return name + "\u2191";
    case SDLK_DOWN:
      return name + "\u2193";
    case SDLK_PAGEDOWN:
      return name + "Page down";
    case SDLK_PAGEUP:
      return name + "Page up";
    case SDLK_ESCAPE:
      return name + "Esc";
    case SDLK_RETURN:
      return name + "Enter";
    case SDLK_PLUS:
      return name + "+";
    case SDLK_MINUS:
      return name + "\u2212";
    default:
      return name + SDL_GetKeyName(chord.key);
  }
}

std::string key_names(const Command& command) {
  std::string names;
  for (const Chord& chord : command.keys) {
    // Ctrl+= and the keypad are the same wish as Ctrl++ and need no mention.
    if (chord.key == SDLK_EQUALS || chord.key == SDLK_KP_PLUS || chord.key == SDLK_KP_MINUS) continue;
    if (!names.empty()) names += " or ";
    names += chord_name(chord);
  }
  return names;
}

const Command* command_for(SDL_Keycode key, unsigned modifiers) {
  for (const Command& command : commands())
    for (const Chord& chord : command.keys)
      if (chord.key != 0 && chord.key == key && chord.modifiers == modifiers) return &command;
  return nullptr;
}

const Command* command_for(char character) {
  for (const Command& command : commands())
    for (const Chord& chord : command.keys)
      if (chord.character != 0 && chord.character == character) return &command;
  return nullptr;
}

const Command* command_called(std::string_view id) {
  for (const Command& command : commands())
    if (command.id == id) return &command;
  return nullptr;
}

TypedWords::TypedWords(const std::string& typed) {
  std::istringstream words(lower(typed));
  for (std::string word; words >> word;) words_.push_back(word);
}

bool TypedWords::all_in(const std::string& text) const {
  const std::string among = lower(text);
  return std::all_of(words_.begin(), words_.end(),
                     [&](const std::string& word) { return among.find(word) != std::string::npos; });
}

std::vector<const Command*> matching(const std::string& typed) {
  const TypedWords words(typed);
  std::vector<const Command*> found;
  for (const Command& command : commands())
    if (words.all_in(std::string(command.group) + " " + command.title)) found.push_back(&command);
  return found;
}

}  // namespace zstep::viewer
