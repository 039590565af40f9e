// The drawer: one place, docked beside the stage or below it, for all that is asked about the run. It takes room from
// the panes instead of covering them. What it can show is a table of pages; a page fills what is left below its title
// row.
#pragma once

#include <span>

#include "sim/viewer/app.hpp"

namespace zstep::viewer {

struct DrawerPage {
  Drawer is;
  const char* tab;      ///< its name in the title row; neighbours that share one are the same question
  const char* command;  ///< that asks it, by id
  ImVec2 least;         ///< that it can be read in, in widths of an em
  bool typed;           ///< it has a field
  bool keeps_small;     ///< it is about more than what leads: it stands beside the stage, where the small panes stay
  void (*draw)(App&);
  bool (App::*key)(SDL_Keycode, unsigned);
};

std::span<const DrawerPage> drawer_pages();
/// nullptr where the drawer is closed.
const DrawerPage* page_of(Drawer drawer);

/// Parts of a page: beside each other where the drawer is wide, which is told, else the second below the first. `wide`:
/// the share of the first then; `high`: what it needs else, of which it gets no more than there is. Each ends with
/// ImGui::EndChild(); the second has what is left.
bool begin_first(Ui& ui, const char* id, float wide, float high);
void begin_second(Ui& ui, const char* id, bool beside);

// Files of their own.
void draw_history(App& app);
void draw_why_ask(App& app);
void draw_why(App& app);
void draw_explain(App& app);
void draw_query(App& app);
void draw_until(App& app);
void draw_name_bookmark(App& app);
void draw_bookmarks(App& app);
void draw_range(App& app);
void draw_compare(App& app);
void draw_what_if(App& app);

}  // namespace zstep::viewer
