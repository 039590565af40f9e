// Which run the one that is shown is compared with: a file's, or what zstep itself makes of the scene.
#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"

namespace zstep::viewer {

void App::open_compare() {
  if (!compares()) return open(Drawer::compare);
  end_against();
  say("The second run is put away.");
}

void App::compare_typed() {
  wrong.clear();
  requests.compare_with = typed;
}

bool App::edit_compare(SDL_Keycode code, unsigned) { return code == SDLK_RETURN ? compare_typed(), true : false; }

void draw_compare(App& app) {
  Ui& ui = app.ui();
  flow(ui, "With which run is this one compared?", {.font = ui.fonts.bold});
  app.draw_drawer_field("run.jsonl");
  const bool chooses = button(ui, "Choose a file\u2026");
  ImGui::SameLine(0, ui.em * 0.6f);
  const bool own = button(ui, "zstep's own run");
  if (app.wrong.empty())
    flow(ui,
         "A trace or a program's JSON Lines on the same scene; it can be dropped on the window. With nothing typed: "
         "the run that zstep makes of this scene by this method.",
         {.color = ui.colors().muted});
  else say_wrong(ui, app.wrong);
  if (chooses) app.requests.choose_file = true;
  if (own) app.put(""), app.compare_typed();
}

}  // namespace zstep::viewer
