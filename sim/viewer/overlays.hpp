// What lies over the window for a moment and is about no place in the picture: key sheet, palette, menu, start page. A
// click outside closes it. What is asked about the run has a place of its own: drawer/drawer.hpp.
#pragma once

#include "sim/viewer/app.hpp"

namespace zstep::viewer {

/// Begins a framed window over the others: `down` 0 at the top of the screen, 1 at its bottom.
void begin_overlay(App& app, const char* id, ImVec2 size, float down = 1 / 2.4f);
/// The same with a corner at this place, as far as the screen has room.
void begin_overlay(App& app, const char* id, ImVec2 size, ImVec2 corner);

/// How far something long is, over all else, and how it is ended.
void draw_progress(App& app, const std::string& text, double share, const std::string& help);

// overlays.cpp
void draw_key_sheet(App& app);
void draw_palette(App& app);
void draw_go_to(App& app);
void draw_menu(App& app);
// In files of their own.
void draw_start(App& app);
void draw_settings(App& app);
void draw_racers_list(App& app);
void draw_here(App& app, ImVec2 mouse);  ///< what a right click offers
void draw_search(App& app);              ///< how far a search has come, while it goes on
void draw_film(App& app);                ///< what is to be filmed
void draw_filming(App& app);             ///< how far a film is

}  // namespace zstep::viewer
