// Commands by their keys and by their names: what a chord is called, and which command it is.

#include "sim/viewer/commands.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

#include "sim/viewer/command_actions.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

using namespace actions;

namespace {

constexpr unsigned S = Chord::shift, C = Chord::ctrl, A = Chord::alt;

const std::vector<Command>& table() {
  static const std::vector<Command> all{
      {"next", "Move", "One step on", {{SDLK_RIGHT}}, move<Unit::event, 1>},
      {"previous", "Move", "One step back", {{SDLK_LEFT}}, move<Unit::event, -1>},
      {"next-pixel", "Move", "Next pixel", {{SDLK_RIGHT, S}}, move<Unit::pixel, 1>},
      {"previous-pixel", "Move", "Previous pixel", {{SDLK_LEFT, S}}, move<Unit::pixel, -1>},
      {"next-span", "Move", "Next span", {{SDLK_RIGHT, C | S}}, move<Unit::span, 1>},
      {"previous-span", "Move", "Previous span", {{SDLK_LEFT, C | S}}, move<Unit::span, -1>},
      {"next-line", "Move", "Next scan line", {{SDLK_RIGHT, C}, {SDLK_DOWN}}, move<Unit::scan_line, 1>},
      {"previous-line", "Move", "Previous scan line", {{SDLK_LEFT, C}, {SDLK_UP}}, move<Unit::scan_line, -1>},
      {"next-polygon", "Move", "Next polygon (class: next stop)", {{SDLK_PAGEDOWN}}, page<1>},
      {"previous-polygon", "Move", "Previous polygon (class: stop)", {{SDLK_PAGEUP}}, page<-1>},
      {"next-same", "Move", "Next time this line runs", {{SDLK_k}}, same_line<1>},
      {"previous-same", "Move", "Last time this line ran", {{SDLK_k, S}}, same_line<-1>},
      {"first", "Move", "To the beginning", {{SDLK_HOME}}, [](App& a) { a.go_to(0); }},
      {"last", "Move", "To the end", {{SDLK_END}}, [](App& a) { a.go_to(INT64_MAX); }},
      {"go-to", "Move", "Go to a step, polygon or pixel", {{SDLK_g}}, [](App& a) { a.open(Overlay::go_to); }},
      {"run-until",
       "Move",
       "Run until a condition is true",
       {{SDLK_u}},
       [](App& a) {
         a.open(Drawer::until);
         a.picked = -1;
       }},
      {"next-match",
       "Move",
       "Next step where it is true",
       {{SDLK_j}},
       [](App& a) { a.places().again(Places::Way::forwards); }},
      {"previous-match",
       "Move",
       "Last step where it was true",
       {{SDLK_j, S}},
       [](App& a) { a.places().again(Places::Way::backwards); }},
      {"next-cause", "Move", "Next cause of an error", {{0, 0, '.'}}, next_cause},
      {"previous-cause", "Move", "Previous cause", {{0, 0, ','}}, [](App& a) { a.to_cause(-1); }},
      {"next-marked", "Move", "Next step that is marked", {{0, 0, '>'}}, [](App& a) { a.to_marked(1); }},
      {"previous-marked", "Move", "Previous step that is marked", {{0, 0, '<'}}, [](App& a) { a.to_marked(-1); }},
      {"next-alike", "Move", "Next like difference", {{0, 0, ';'}}, [](App& a) { a.to_alike(1); }},
      {"previous-alike", "Move", "Previous like difference", {{0, 0, ':'}}, [](App& a) { a.to_alike(-1); }},
      {"pixel-apart", "Move", "First pixel that differs", {{0, 0, '#'}}, [](App& a) { a.to_pixel_apart(); }},
      {"bookmark", "Move", "Set a bookmark here", {{SDLK_b, C}}, name_bookmark},
      {"bookmarks", "Move", "Bookmarks", {{SDLK_l}}, [](App& a) { a.open(Drawer::bookmarks); }},
      {"query", "Move", "Ask the trace in SQL", {{SDLK_q}}, [](App& a) { a.open(Drawer::query); }},
      {"play", "Play", "Play or pause", {{SDLK_SPACE}}, [](App& a) { a.toggle_play(); }},
      {"faster", "Play", "Faster", {{0, 0, '+'}}, change_speed<1>},
      {"slower", "Play", "Slower", {{0, 0, '-'}}, change_speed<-1>},
      {"loop-first", "Play", "Repeat from here", {{0, 0, '['}}, set_loop<true>},
      {"loop-last", "Play", "Repeat up to here", {{0, 0, ']'}}, set_loop<false>},
      {"loop-end", "Play", "Repeat no longer", {{SDLK_l, S}}, end_loop},
      {"film", "Play", "Save a film", {{SDLK_f, C | S}}, [](App& a) { a.open_film(); }},
      {"next-touch", "Pixel", "Next step at this pixel", {{SDLK_f}}, [](App& a) { a.session().to_selected_pixel(1); }},
      {"previous-touch",
       "Pixel",
       "Last step at this pixel",
       {{SDLK_f, S}},
       [](App& a) { a.session().to_selected_pixel(-1); }},
      {"history", "Pixel", "History of this pixel", {{SDLK_h}}, [](App& a) { a.open_history(); }},
      {"why-not", "Pixel", "Why a polygon is not seen", {{SDLK_y}}, [](App& a) { a.open_why(); }},
      {"explain", "Pixel", "Where a number comes from", {{SDLK_e, S}}, [](App& a) { a.explain_step(); }},
      {"select-pixel", "Pixel", "Select the pixel at work (or mark it)", {{SDLK_RETURN}}, select_current},
      {"pixel-left", "Pixel", "Selection one pixel left", {{SDLK_LEFT, A}}, move_selected<-1, 0>},
      {"pixel-right", "Pixel", "Selection one pixel right", {{SDLK_RIGHT, A}}, move_selected<1, 0>},
      {"pixel-above", "Pixel", "Selection one pixel up", {{SDLK_UP, A}}, move_selected<0, -1>},
      {"pixel-below", "Pixel", "Selection one pixel down", {{SDLK_DOWN, A}}, move_selected<0, 1>},
      {"next-method", "Pixel", "The same by the next method", {{SDLK_x}}, [](App& a) { a.requests.switch_method = 1; }},
      {"previous-method",
       "Pixel",
       "The same by the one before",
       {{SDLK_x, S}},
       [](App& a) { a.requests.switch_method = -1; }},
      {"next-edge", "Pixel", "Light the next edge", {{SDLK_e}}, next_edge},
      {"next-vertex", "Pixel", "Light the next vertex", {{SDLK_u, S}}, next_vertex},
      {"race",
       "Change",
       "Race: methods side by side",
       {{SDLK_r, C}},
       [](App& a) { a.racing() ? a.close_race() : a.open_race(); }},
      {"check", "Change", "Check this run", {{SDLK_k, C}}, [](App& a) { a.requests.check = true; }},
      {"compare", "Change", "Compare with another run", {{SDLK_d, C}}, [](App& a) { a.open_compare(); }},
      {"what-if", "Change", "What if: change the run", {{SDLK_e, C}}, [](App& a) { a.open_what_if(); }},
      {"undo", "Change", "Undo a change", {{SDLK_z, C}}, [](App& a) { a.requests.undo_change = 1; }},
      {"redo", "Change", "Make it again", {{SDLK_y, C}}, [](App& a) { a.requests.undo_change = -1; }},
      {"save-scene", "Change", "Save the changed scene", {{SDLK_s, C | S}}, [](App& a) { a.save_scene(); }},
      {"before",
       "Look",
       "Hold: buffers before (class: black)",
       {{SDLK_b}},
       [](App& a) {
         if (a.ui().presenter) return a.make_black();
         a.session().looking_back = true;
       },
       [](App& a) { a.session().looking_back = false; }},
      {"zoom-in", "Look", "Zoom into the buffers (or wheel)", {{SDLK_z}}, zoom<1>},
      {"zoom-out", "Look", "Zoom out", {{SDLK_z, S}}, zoom<-1>},
      {"whole", "Look", "The whole raster", {{SDLK_0}}, [](App& a) { a.ui().view = {}; }},
      {"center", "Look", "Zoom to the pixel at work", {{SDLK_c}}, center_on_pixel},
      {"pan-left", "Look", "Pan left (or drag)", {{SDLK_a}}, pan<-1, 0>},
      {"pan-right", "Look", "Pan right", {{SDLK_d}}, pan<1, 0>},
      {"pan-up", "Look", "Pan up", {{SDLK_w}}, pan<0, -1>},
      {"pan-down", "Look", "Pan down", {{SDLK_s}}, pan<0, 1>},
      {"overlay", "Look", "Over the frame: overdraw, \u2026", {{SDLK_o}}, [](App& a) { a.turn_overlay(1); }},
      {"previous-overlay", "Look", "Over the frame: the one before", {{SDLK_o, S}}, [](App& a) { a.turn_overlay(-1); }},
      {"fit-range", "Look", "Depth colours: fitted, or not", {{SDLK_r}}, fit_range},
      {"range", "Look", "Depth colours: a range by hand", {{SDLK_r, S}}, [](App& a) { a.open(Drawer::range); }},
      {"histogram",
       "Look",
       "How many pixels have which depth",
       {{SDLK_i}},
       [](App& a) { a.ui().histogram = !a.ui().histogram; }},
      {"relief",
       "Look",
       "Depths as a relief",
       {{SDLK_d, S}},
       [](App& a) {
         if (!depth_pane_of(a.session().header())) return a.say("There are no depths in this trace.");
         a.ui().relief = !a.ui().relief;
       }},
      {"next-lead", "Look", "Large: the next pane (or its title)", {{SDLK_TAB}}, [](App& a) { a.turn_lead(1); }},
      {"previous-lead", "Look", "Large: the pane before", {{SDLK_TAB, S}}, [](App& a) { a.turn_lead(-1); }},
      {"slice", "Look", "Slice: depth over x", {{SDLK_s, S}}, show_slice},
      {"error-charts", "Look", "Errors of depth, as charts", {{SDLK_i, S}}, show_error_charts},
      {"vertices",
       "Look",
       "Coordinates of the vertex, always",
       {{SDLK_v}},
       [](App& a) { a.ui().vertices_always = !a.ui().vertices_always; }},
      {"whole-code",
       "Look",
       "Pseudo-code whole, or folded",
       {{SDLK_7}},
       [](App& a) { a.ui().whole_code = !a.ui().whole_code; }},
      {"outside", "Look", "The scene from outside, or not", {{SDLK_v, S}}, turn_scene},
      {"viewing-step", "Look", "T\u2081 to T\u2084 of viewing, in turn", {{SDLK_t, S}}, turn_viewing},
      {"walk", "Look", "Walk round the scene (or drag)", {{SDLK_5}}, walk<15, 0>},
      {"rise", "Look", "Look at the scene from higher up", {{SDLK_6}}, walk<0, 15>},
      {"next-stop", "Lesson", "Next stop of the lesson", {{SDLK_n}}, [](App& a) { a.next_stop(1); }},
      {"previous-stop", "Lesson", "Previous stop", {{SDLK_n, S}}, [](App& a) { a.next_stop(-1); }},
      {"answer-1", "Lesson", "First answer", {{SDLK_1}}, answer<0>},
      {"answer-2", "Lesson", "Second answer", {{SDLK_2}}, answer<1>},
      {"answer-3", "Lesson", "Third answer", {{SDLK_3}}, answer<2>},
      {"answer-4", "Lesson", "Fourth answer", {{SDLK_4}}, answer<3>},
      {"check-marks", "Lesson", "Check what you marked", {{SDLK_RETURN, C}}, [](App& a) { a.session().check_marks(); }},
      {"marks-hint", "Lesson", "A hint for what to mark", {{SDLK_h, C}}, [](App& a) { a.session().help_with_marks(); }},
      {"laboratory",
       "Lesson",
       "Every pane, or the lesson's layout",
       {{SDLK_p, S}},
       [](App& a) { a.turn_laboratory(); }},
      {"pen", "Class", "Pen: write until the next step", {{SDLK_8}}, turn_pen<false>},
      {"pen-stays", "Class", "Pen: what is written stays", {{SDLK_8, S}}, turn_pen<true>},
      {"spotlight", "Class", "Spotlight at the mouse", {{SDLK_9}}, turn_spotlight},
      {"laser", "Class", "Laser spot at the mouse", {{SDLK_7, S}}, turn_laser},
      {"clock", "Class", "Clock: start, or end", {{SDLK_9, S}}, turn_clock},
      {"notes", "Class", "Speaker's notes", {{SDLK_n, C}}, [](App& a) { a.requests.toggle_notes = true; }},
      {"open", "Window", "Open a lesson, scene or file", {{SDLK_o, C}}, [](App& a) { a.open_start(); }},
      {"choose-file",
       "Window",
       "Choose a file to open",
       {{SDLK_o, C | S}},
       [](App& a) { a.requests.choose_file = true; }},
      {"larger",
       "Window",
       "Larger text",
       {{SDLK_PLUS, C}, {SDLK_EQUALS, C}, {SDLK_EQUALS, C | S}, {SDLK_KP_PLUS, C}},
       [](App& a) { a.scale_text(1.125f); }},
      {"smaller",
       "Window",
       "Smaller text",
       {{SDLK_MINUS, C}, {SDLK_KP_MINUS, C}},
       [](App& a) { a.scale_text(1 / 1.125f); }},
      {"usual-text", "Window", "Usual text size", {{SDLK_0, C}}, [](App& a) { a.scale_text(0); }},
      {"presenter",
       "Window",
       "Presenter mode, for a class",
       {{SDLK_p}},
       [](App& a) { a.set_presenter(!a.settings().presenter); }},
      {"theme", "Window", "Light or dark", {{SDLK_t}}, [](App& a) { a.set_dark(!a.settings().dark); }},
      {"reduced-motion",
       "Window",
       "Reduced motion, or not",
       {{SDLK_m, S}},
       [](App& a) { a.set_reduced_motion(!a.settings().reduced_motion); }},
      {"settings",
       "Window",
       "Settings",
       {{SDLK_COMMA, C}},
       [](App& a) { a.open(a.overlay() == Overlay::settings ? Overlay::none : Overlay::settings); }},
      {"save-progress",
       "Window",
       "Save settings and progress",
       {{SDLK_e, C | S}},
       [](App& a) { a.requests.save_progress = true; }},
      {"full-screen", "Window", "Full screen", {{SDLK_F11}}, [](App& a) { a.requests.toggle_full_screen = true; }},
      {"layout", "Window", "Borders back where they were", {{SDLK_l, C}}, [](App& a) { a.settings().layout = {}; }},
      {"copy-place", "Window", "Copy what opens this place", {{SDLK_c, C}}, copy_place},
      {"picture",
       "Window",
       "Save a picture of the window",
       {{SDLK_s, C}},
       [](App& a) { a.requests.save_picture = fmt::format("zstep-{}", a.session().position()); }},
      {"slide",
       "Window",
       "Save a slide of what leads",
       {{SDLK_i, C | S}},
       [](App& a) { a.requests.save_slide = fmt::format("zstep-{}-slide", a.session().position()); }},
      {"palette", "Window", "Find commands, places, lessons", {{SDLK_p, C}}, [](App& a) { a.open(Overlay::palette); }},
      {"menu",
       "Window",
       "Menu",
       {{SDLK_F10}, {SDLK_m}},
       [](App& a) { a.open(a.overlay() == Overlay::menu ? Overlay::none : Overlay::menu); }},
      {"keys", "Window", "Every key", {{0, 0, '?'}, {SDLK_F1}}, [](App& a) { a.turn_key_sheet(); }},
      {"escape", "Window", "Close, stop, or select nothing", {{SDLK_ESCAPE}}, escape},
      {"quit", "Window", "Quit", {{SDLK_q, C}}, [](App& a) { a.requests.quit = true; }},
  };
  return all;
}

}  // namespace

std::span<const Command> commands() { return table(); }

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
  std::istringstream words(lower_case(typed));
  for (std::string word; words >> word;) words_.push_back(word);
}

bool TypedWords::all_in(const std::string& text) const {
  const std::string among = lower_case(text);
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
