// Where the drawer stands: beside the stage or below it, whichever leaves what leads the larger picture.

#include "sim/viewer/drawer/drawer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/lists.hpp"

namespace zstep::viewer {

std::span<const DrawerPage> drawer_pages() {
  static const DrawerPage all[] = {
      {Drawer::history, "History", "history", {24, 10}, false, false, draw_history, &App::pick_visit},
      {Drawer::why_ask, "Why not", "why-not", {20, 10}, true, false, draw_why_ask, &App::pick_candidate},
      {Drawer::why, "Why not", "why-not", {24, 10}, false, false, draw_why, &App::pick_link},
      {Drawer::explain, "Where from", "explain", {26, 10}, false, false, draw_explain, &App::pick_origin},
      {Drawer::until, "Run until", "run-until", {24, 10}, true, false, draw_until, &App::edit_until},
      {Drawer::query, "SQL", "query", {26, 10}, true, false, draw_query, &App::edit_query},
      {Drawer::name_bookmark, "Bookmarks", "bookmarks", {20, 8}, true, false, draw_name_bookmark, &App::name_typed},
      {Drawer::bookmarks, "Bookmarks", "bookmarks", {20, 8}, false, false, draw_bookmarks, &App::pick_bookmark},
      {Drawer::range, "Depth colours", "range", {20, 8}, true, false, draw_range, &App::edit_range},
      {Drawer::compare, "Compare", "compare", {20, 9}, true, false, draw_compare, &App::edit_compare},
      {Drawer::what_if, "What if", "what-if", {20, 15}, true, true, draw_what_if, &App::pick_changeable}};
  return all;
}

const DrawerPage* page_of(Drawer drawer) {
  for (const DrawerPage& page : drawer_pages())
    if (page.is == drawer) return &page;
  return nullptr;
}

bool begin_first(Ui& ui, const char* id, float wide, float high) {
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const bool beside = room.x > 2.2f * room.y;
  const ImVec2 size =
      beside ? ImVec2{std::round(room.x * wide), room.y} : ImVec2{room.x, std::round(std::min(high, room.y * 0.6f))};
  begin_wrapped(ui, id, {std::max(1.0f, size.x), std::max(1.0f, size.y)}, ImGuiWindowFlags_NoNav);
  return beside;
}

void begin_second(Ui& ui, const char* id, bool beside) {
  if (beside) ImGui::SameLine(0, std::round(ui.em * 0.6f));
  const ImVec2 room = ImGui::GetContentRegionAvail();
  begin_wrapped(ui, id, {std::max(1.0f, room.x), std::max(1.0f, room.y)}, ImGuiWindowFlags_NoNav);
}

void App::open(Drawer drawer) {
  if (embedded() && drawer != Drawer::none) return;
  // The pixel that why-not picked for itself is not the reader's.
  const bool own = drawer_ == Drawer::why && drawer != Drawer::why && why_anywhere_;
  if (own && why_.pixel && session_.selected == Cell{why_.pixel->x, why_.pixel->y}) {
    if (why_selected_) session_.select(*why_selected_);
    else session_.selected.reset();
  }
  overlay_ = Overlay::none;
  drawer_ = drawer;
  keys_in_drawer_ = drawer != Drawer::none;
  if (keys_in_drawer_) ui_.reads = true;  // also after a click: what lies under the mouse now is chance
  put(drawer == Drawer::query ? inquiry_.sql() : "");
  wrong.clear();
  picked = 0;
}

/// A click says whose the keys are.
void App::take_keys_by_click() {
  if (drawer_ == Drawer::none || overlay_ != Overlay::none || !ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos, at = drawer_at_.at, size = drawer_at_.size;
  const float border = std::round(ui_.em * 0.35f);
  const bool inside =
      mouse.x >= at.x - border && mouse.y >= at.y - border && mouse.x < at.x + size.x && mouse.y < at.y + size.y;
  if (inside == std::exchange(keys_in_drawer_, inside)) return;
  put(typed);  // as it stands, with nothing of it selected
}

/// Answers about the selected pixel are about the one that is selected now.
void App::follow_selected() {
  const auto cell = session_.selected;
  if (!cell || overlay_ != Overlay::none) return;
  if (drawer_ == Drawer::history && *cell != history_of_) look_at_history(*cell), pick_visit_before();
  if (why_anywhere_ || cell == why_of_) return;
  if (drawer_ == Drawer::why_ask || drawer_ == Drawer::why) why_of_ = cell;
  if (drawer_ == Drawer::why) find_why();
}

namespace {

/// What else can be asked here, and a button that closes; the command that was clicked.
const char* draw_tabs(App& app) {
  Ui& ui = app.ui();
  const char* const close = "Close (Esc)";
  const auto width = [&](const char* word) { return text_size(ui, ui.fonts.text, word).x + std::round(ui.em * 1.1f); };
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float gap = std::round(ui.em * 0.25f), line = std::round(ui.em * 1.9f),
              end = from.x + ImGui::GetContentRegionAvail().x;
  const char* const now = page_of(app.drawer())->tab;
  // Where there is no room for all of them, this one stands alone.
  std::vector<const DrawerPage*> tabs;
  for (const DrawerPage& page : drawer_pages())
    if (tabs.empty() || std::strcmp(tabs.back()->tab, page.tab) != 0) tabs.push_back(&page);
  const auto hidden = [&](const DrawerPage* page) {
    if (std::strcmp(page->tab, now) == 0) return false;
    return (page->is == Drawer::what_if && !app.may_change()) || (page->is == Drawer::compare && app.compares()) ||
           (page->is == Drawer::range && !depth_pane_of(app.session().header()));
  };
  std::erase_if(tabs, hidden);
  std::vector<ImVec2> places;
  ImVec2 at = from;
  for (const DrawerPage* page : tabs) {
    const float room = (at.y == from.y ? end - width(close) - gap : end) - at.x;
    if (at.x > from.x && width(page->tab) > room) at = {from.x, at.y + line};
    places.push_back(at);
    at.x += width(page->tab) + gap;
  }
  const char* clicked = nullptr;
  const bool all = at.y + line - from.y < ImGui::GetContentRegionAvail().y * 0.3f;
  for (std::size_t k = 0; k < tabs.size(); ++k) {
    const bool lit = std::strcmp(tabs[k]->tab, now) == 0;
    if (!all && !lit) continue;
    ImGui::SetCursorScreenPos(all ? places[k] : from);
    if (button(ui, tabs[k]->tab, lit) && !lit) clicked = tabs[k]->command;
    const Command* command = command_called(tabs[k]->command);
    if (ImGui::IsItemHovered()) ui.mouse_help = std::string(command->title) + " (" + key_names(*command) + ").";
  }
  ImGui::SetCursorScreenPos({end - width(close), from.y});
  if (button(ui, close)) clicked = "escape";
  if (ImGui::IsItemHovered()) ui.mouse_help = "Closes the drawer; its room is the panes' again.";
  ImGui::SetCursorScreenPos({from.x, (all ? at.y : from.y) + line});
  return clicked;
}

}  // namespace

void App::draw_drawer() {
  const DrawerPage* const page = page_of(drawer_);
  if (!page || drawer_at_.size.x < 1 || drawer_at_.size.y < 1) return;
  const bool covered = overlay_ != Overlay::none;
  const auto exchange = [&] {
    std::swap(typed, under_overlay_.typed), std::swap(wrong, under_overlay_.wrong);
    std::swap(picked, under_overlay_.picked);
  };
  if (covered) exchange();
  ImGui::SetNextWindowPos(drawer_at_.at);
  ImGui::SetNextWindowSize(drawer_at_.size);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui_.colors().pane);
  ImGui::Begin("drawer", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleColor();
  const ImVec2 end{drawer_at_.at.x + drawer_at_.size.x, drawer_at_.at.y + drawer_at_.size.y};
  ImGui::PushClipRect(drawer_at_.at, end, false);
  frame_box(ui_, drawer_at_.at, end, drawer_has_keys() ? ui_.colors().now : ui_.colors().rule, 2);
  ImGui::PopClipRect();
  ImGui::BeginDisabled(covered);
  const char* const clicked = draw_tabs(*this);
  page->draw(*this);
  ImGui::EndDisabled();
  ImGui::End();
  if (covered) exchange();
  if (clicked) run(*command_called(clicked));
}

/// How large a pixel of the raster is on a stage of this size, where so many panes lead.
float App::pixel_on(ImVec2 stage, std::size_t leading) const {
  const Raster& raster = session_.scene().raster;
  const float panes = leading > 1 ? 2 : 1;
  return std::min(stage.x / panes / to_float(raster.width), (stage.y - 1.5f * ui_.em) / to_float(raster.height));
}

App::Docked App::docked(ImVec2 size, ImVec2 beside, ImVec2 below, std::size_t leading) const {
  const DrawerPage* const page = page_of(drawer_);
  if (!page) return {};
  const Layout &now = settings_.layout, usual;
  const float gap = std::round(ui_.em * 0.35f);
  const auto room = [&](float share, float whole, float least) {
    const float most = std::max(1.0f, std::round(whole * 0.6f));
    return std::clamp(std::round(whole * share), std::min(least * ui_.em, most), most);
  };
  // As wide and high as it usually is, so that it stays where it is while its border is pulled.
  beside.x -= room(usual.drawer_width, size.x, page->least.x) + gap;
  below.y -= room(usual.drawer_height, size.y, page->least.y) + gap;
  beside.y *= now.stage;
  if (page->keeps_small || pixel_on(beside, leading) >= pixel_on(below, leading))
    return {Docked::Side::beside, room(now.drawer_width, size.x, page->least.x)};
  return {Docked::Side::below, room(now.drawer_height, size.y, page->least.y)};
}

void App::pull_drawer(const Docked& docked, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f);
  const bool beside = docked.side == Docked::Side::beside;
  const ImVec2 at = drawer_at_.at, its = drawer_at_.size;
  const float whole = beside ? size.x : size.y;
  float others = 1 - docked.room / whole;
  const bool pulled = beside ? splitter("drawer", {at.x - gap, at.y}, {gap, its.y}, true, others, whole)
                             : splitter("drawer", {at.x, at.y - gap}, {its.x, gap}, false, others, whole);
  if (pulled) (beside ? settings_.layout.drawer_width : settings_.layout.drawer_height) = 1 - others;
}

// Which run the one that is shown is compared with: a file's, or what zstep itself makes of the scene.

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
