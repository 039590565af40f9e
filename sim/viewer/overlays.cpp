// What lies over the window for a moment: key sheet and menu from the table of commands; what is found; go-to; a
// search.

#include "sim/viewer/overlays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <numeric>
#include <utility>
#include <vector>

#include "sim/film/video.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/numbers.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

void begin_overlay(App& app, const char* id, ImVec2 size, float down) {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  begin_overlay(app, id, size, ImVec2{(whole.x - size.x) / 2, (whole.y - size.y) * down});
}

void begin_overlay(App& app, const char* id, ImVec2 size, ImVec2 corner) {
  Ui& ui = app.ui();
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  // Where it is narrower than it should be it is higher, and beside it a finger has room to close it.
  size.y *= std::clamp(size.x / std::max(1.0f, whole.x - 8), 1.0f, 1.6f);
  size = {std::min(size.x, whole.x - 8), std::min(size.y, whole.y - std::max(8.0f, 2 * ui.least_target))};
  const ImVec2 at{std::floor(std::clamp(corner.x, 0.0f, whole.x - size.x)),
                  std::floor(std::clamp(corner.y, 0.0f, whole.y - size.y))};
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 2);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colors().pane);
  ImGui::PushStyleColor(ImGuiCol_Border, ui.colors().now);
  ImGui::Begin(id, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool inside = mouse.x >= at.x && mouse.y >= at.y && mouse.x < at.x + size.x && mouse.y < at.y + size.y;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !inside) app.open(Overlay::none);
}

namespace {

/// A row with a title on the left and its keys, or what it is, on the right; true when clicked.
bool row(Ui& ui, const char* id, const std::string& title, const std::string& beside, float width, float height,
         bool lit) {
  const Theme& c = ui.colors();
  const float top = std::round((height - ui.em) * 0.375f);
  const ImVec2 at = ImGui::GetCursorScreenPos(), end{at.x + width, at.y + height};
  const bool clicked = ImGui::InvisibleButton(id, {width, height});
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (lit) list->AddRectFilled(at, end, c.now_soft);
  else if (ImGui::IsItemHovered()) list->AddRectFilled(at, end, c.button_hovered);
  const float beside_width = text_size(ui, ui.fonts.mono, beside).x;
  const std::string shown = fitted(ui, ui.fonts.text, title, width - ui.em * 0.8f);
  draw_text(ui, {at.x + ui.em * 0.4f, at.y + top}, ui.fonts.text, c.text, shown);
  can_be_hit(ui, at, end);
  if (text_size(ui, ui.fonts.text, shown).x + beside_width + ui.em * 1.5f <= width)
    draw_text(ui, {end.x - beside_width - ui.em * 0.4f, at.y + top + 1}, ui.fonts.mono, c.muted, beside);
  return clicked;
}

float row_width(Ui& ui, const Command& command) {
  return text_size(ui, ui.fonts.text, command.title).x + text_size(ui, ui.fonts.mono, key_names(command)).x +
         ui.em * 2.5f;
}

float widest_row(Ui& ui) {
  float width = 0;
  for (const Command& command : commands()) width = std::max(width, row_width(ui, command));
  return width;
}

/// All commands in columns, group by group under their headings; a heading stands with its first command.
struct KeySheet {
  struct Place {
    std::size_t column = 0;
    int row = 0;
    bool heads = false;  ///< its group's heading stands in the row above it
  };
  std::vector<Place> places;  ///< of each command
  std::vector<float> widths;  ///< of each column
  int rows = 0;
  float width() const { return std::accumulate(widths.begin(), widths.end(), 0.0f); }
};

KeySheet sheet_with(Ui& ui, int rows) {
  KeySheet sheet;
  sheet.rows = rows;
  sheet.widths.push_back(0);
  int row_now = 0;
  const char* group = "";
  for (const Command& command : commands()) {
    const bool heads = std::strcmp(group, command.group) != 0;
    group = command.group;
    if (row_now + (heads ? 2 : 1) > rows) sheet.widths.push_back(0), row_now = 0;
    row_now += heads;
    sheet.places.push_back({sheet.widths.size() - 1, row_now++, heads});
    sheet.widths.back() = std::max(sheet.widths.back(), row_width(ui, command));
  }
  return sheet;
}

/// The same in at most so many columns, with as few rows as that takes.
KeySheet sheet_in(Ui& ui, std::size_t columns) {
  for (int rows = 2;; ++rows)
    if (KeySheet sheet = sheet_with(ui, rows); sheet.widths.size() <= columns) return sheet;
}

void run(App& app, const Command& command) {
  app.open(Overlay::none);
  if (command.release) app.hold(command);
  else app.run(command);
}

void draw_columns(App& app, const char* id, const char* title) {
  Ui& ui = app.ui();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float around = 2 * ui.em, above = 3 * ui.em;
  // As many columns as give the rows most room; where the window is low, the rows move together.
  const auto height_of = [&](const KeySheet& sheet) {
    return std::floor(std::min((screen.y - 8 - above) / to_float(sheet.rows), ui.em * 1.4f));
  };
  KeySheet sheet = sheet_in(ui, 1);
  for (const std::size_t columns : {2u, 3u})
    if (KeySheet wider = sheet_in(ui, columns);
        wider.width() + around <= screen.x && height_of(wider) > height_of(sheet))
      sheet = std::move(wider);
  const float fits = height_of(sheet);
  const float row_height =
      std::max(ui.least_target, fits < ui.em * 0.87f ? std::round(ui.em * 1.4f) : fits);  // or it scrolls
  if (sheet.widths.size() == 1) sheet.widths[0] = std::min(sheet.widths[0], screen.x - 8 - around);
  begin_overlay(app, id, {sheet.width() + around, to_float(sheet.rows) * row_height + above});
  flow(ui, title, {.font = ui.fonts.bold});
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const Command* clicked = nullptr;
  for (std::size_t k = 0; k < commands().size(); ++k) {
    const Command& command = commands()[k];
    const KeySheet::Place& place = sheet.places[k];
    const float x = std::accumulate(sheet.widths.begin(), sheet.widths.begin() + place.column, top.x);
    const float y = top.y + to_float(place.row) * row_height;
    if (place.heads)
      draw_text(ui, {x + ui.em * 0.4f, y - row_height + std::round((row_height - ui.em) * 0.6f)}, ui.fonts.bold,
                ui.colors().now, command.group);
    ImGui::SetCursorScreenPos({x, y});
    if (row(ui, command.id, command.title, key_names(command), sheet.widths[place.column] - ui.em * 0.5f, row_height,
            false))
      clicked = &command;
  }
  ImGui::End();
  if (clicked) run(app, *clicked);
}

}  // namespace

void draw_key_sheet(App& app) { draw_columns(app, "keys", "Every key. A click does what its row says; Esc closes."); }
void draw_menu(App& app) { draw_columns(app, "menu", "Menu"); }

void draw_palette(App& app) {
  Ui& ui = app.ui();
  const float row_height = std::max(std::round(ui.em * 1.4f), ui.least_target);
  begin_overlay(app, "palette", {std::max(ui.em * 32, widest_row(ui)), row_height * 12 + ui.em * 3}, 0.1f);
  app.draw_field("A command, step, polygon, stop, lesson, or z < 4.2");
  const std::vector<Found>& found = app.found();
  std::optional<std::size_t> clicked;
  ImGui::BeginChild("found", ImGui::GetContentRegionAvail(), false, ImGuiWindowFlags_NoNav);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ImGui::PushID(index32(i));
    if (row(ui, "found", found[i].title, found[i].beside, ImGui::GetContentRegionAvail().x, row_height,
            app.picked == index32(i)))
      clicked = i;
    ImGui::PopID();
    if (app.picked == index32(i)) ImGui::SetScrollHereY(0.5f);
  }
  if (found.empty()) say_empty(ui, "Nothing here is called so, and it is no place and no condition.");
  ImGui::EndChild();
  ImGui::End();
  if (clicked) app.take_found(*clicked);
}

void draw_go_to(App& app) {
  Ui& ui = app.ui();
  begin_overlay(app, "go to", {ui.em * 30, ui.em * (app.wrong.empty() ? 9.5f : 11.5f)}, 0.1f);
  flow(ui, "Go to", {.font = ui.fonts.bold});
  app.draw_field("12041");
  if (!app.wrong.empty()) {  // which says what may be typed as well
    say_wrong(ui, app.wrong);
    return ImGui::End();
  }
  const Flow how{.color = ui.colors().muted};
  const std::string stop = app.session().lesson() ? "stop 3 of the lesson, " : "";
  flow(ui,
       fmt::format("A step (0 to {}; +5 and \u22125 from here), 25 %, polygon B or p 3, line 17 for the next place "
                   "where that scan line begins, {}"
                   "9, 17 to select a pixel, or a bookmark's name. Enter goes there.",
                   grouped(app.session().size()), stop),
       how);
  ImGui::End();
}

void draw_search(App& app) { draw_progress(app, app.places().progress(), app.places().share(), "Esc stops"); }

void draw_progress(App& app, const std::string& text, double share, const std::string& help) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float pad = std::round(ui.em * 0.7f), bar = std::round(ui.em * 0.4f);
  const float width = std::min(
      screen.x - 8,
      std::max(text_size(ui, ui.fonts.text, text).x + text_size(ui, ui.fonts.bold, help).x + 2 * ui.em, ui.em * 20) +
          2 * pad);
  // Over the names in the title: no picture and no button is under it.
  const ImVec2 size{width, std::round(ui.em * 2.1f)}, at{2, 2};
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowFocus();
  ImGui::Begin("progress", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + size.x, at.y + size.y};
  list->AddRectFilled(at, end, c.pane);
  frame_box(ui, at, end, c.now, 2);
  draw_text(ui, {at.x + pad, at.y + ui.em * 0.25f}, ui.fonts.text, c.text, text);
  draw_text(ui, {end.x - pad - text_size(ui, ui.fonts.bold, help).x, at.y + ui.em * 0.25f}, ui.fonts.bold, c.now, help);
  const float y = end.y - bar - ui.em * 0.2f, whole = size.x - 2 * pad;
  list->AddRectFilled({at.x + pad, y}, {at.x + pad + whole, y + bar}, c.head);
  list->AddRectFilled({at.x + pad, y}, {at.x + pad + whole * static_cast<float>(share), y + bar}, c.now);
  ImGui::End();
}

// What a right click offers, beside the mouse: for the pixel, number, line of code or place in time that it points at.

namespace {

/// Tabs as they can be drawn in one line.
std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '\t', ' ');
  return text;
}

}  // namespace

bool App::pick_here(SDL_Keycode code) {
  const std::size_t line = picked;
  if (code != SDLK_RETURN || line >= here_.size()) return pick_among(here_.size(), code);
  take_here(line);
  return true;
}

void App::take_here(std::size_t line) {
  const HereLine taken = here_[line];
  open(Overlay::none);
  session_.message.clear();
  if (taken.first) taken.first(session_);
  if (taken.asks) open_explain(*taken.asks, taken.asks_as);
  if (!taken.copies.empty()) {
    requests.clipboard = taken.copies;
    const auto ends = std::count(taken.copies.begin(), taken.copies.end(), '\n');
    say(ends > 0 ? fmt::format("Copied {} lines; a spreadsheet takes them as a table.", ends)
                 : "Copied: " + spaced(taken.copies));
  }
  if (const Command* command = command_called(taken.command)) run(*command);
}

void draw_here(App& app, ImVec2 mouse) {
  Ui& ui = app.ui();
  const float height = std::max(std::round(ui.em * 1.5f), ui.least_target), gap = ui.em * 1.5f;
  const auto key_of = [](const HereLine& line) {
    const Command* command = command_called(line.command);
    return command ? key_names(*command) : std::string();
  };
  float widest = 0, keys = 0;
  for (const HereLine& line : app.here()) {
    widest = std::max(widest, text_size(ui, ui.fonts.text, line.text).x);
    keys = std::max(keys, text_size(ui, ui.fonts.mono, key_of(line)).x);
  }
  const ImVec2 size{widest + keys + gap + ui.em * 1.5f, height * to_float(app.here().size()) + ui.em};
  begin_overlay(app, "here", size, mouse);
  const float room = ImGui::GetContentRegionAvail().x - keys - gap;
  for (std::size_t k = 0; k < app.here().size(); ++k) {
    const HereLine& line = app.here()[k];
    const ListRow row = list_row(app, k, height);
    const float y = row.at.y + std::round((height - ui.em) / 2) - 1;
    draw_text(ui, {row.at.x + ui.em * 0.4f, y}, ui.fonts.text, ui.colors().text,
              fitted(ui, ui.fonts.text, line.text, room));
    draw_text(ui, {row.end.x - ui.em * 0.3f - text_size(ui, ui.fonts.mono, key_of(line)).x, y}, ui.fonts.mono,
              ui.colors().muted, key_of(line));
    if (row.clicked) {
      ImGui::End();
      return app.take_here(k);
    }
  }
  ImGui::End();
}

// Which steps a film shows, and how far it is.

void draw_film(App& app) {
  Ui& ui = app.ui();
  const std::vector<FilmRange> ranges = app.film_ranges();
  const float line = std::round(ui.em * 1.4f);
  const std::string heading = "Save a film: Enter or a click makes it of",
                    how = fmt::format("A frame a step, but at most {}, as the window looks now.", most_unasked);
  const float width = ui.em * 42;
  begin_overlay(app, "film", {width, to_float(ranges.size()) * line + ui.em * (app.wrong.empty() ? 6.6f : 8.0f)});
  flow(ui, heading, {.font = ui.fonts.bold});
  std::optional<std::size_t> clicked;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const ListRow row = list_row(app, k, line);
    if (row.clicked) clicked = k;
    const std::int64_t frames = film_steps(ranges[k].first, ranges[k].last).size();
    const std::string steps =
        fmt::format("steps {} to {}: {}", grouped(ranges[k].first), grouped(ranges[k].last), film_length(frames));
    const float y = row.at.y + std::round((line - ui.em) / 2) - 1, pad = ui.em * 0.4f,
                wide = text_size(ui, ui.fonts.text, steps).x;
    draw_text(ui, {row.end.x - pad - wide, y}, ui.fonts.text, ui.colors().muted, steps);
    draw_text(ui, {row.at.x + pad, y}, ui.fonts.text, ui.colors().text,
              fitted(ui, ui.fonts.text, ranges[k].what, row.end.x - row.at.x - wide - 4 * pad));
  }
  app.scroll_to_picked = false;
  ImGui::Dummy({1, ui.em * 0.4f});
  app.draw_field("or the first step and the last: 300 420");
  if (app.wrong.empty()) flow(ui, how, {.color = ui.colors().muted});
  else say_wrong(ui, app.wrong);
  ImGui::End();
  if (clicked) app.film(ranges[*clicked].first, ranges[*clicked].last);
}

void draw_filming(App& app) {
  const Film& film = *app.filming();
  const double share = ratio(film.made, film.steps.size());
  draw_progress(app, fmt::format("filming: frame {} of {}", film.made, film.steps.size()), share, "Esc ends it");
}

// One page for all that stays from run to run: each row says what it is now, and has the keys of the commands that
// change it.

namespace {

struct SettingRow {
  const char* title;
  const char *less, *more;  ///< commands; the same where there are but two states, or one thing to be done
  std::string (*now)(App&);
};

const std::array<SettingRow, 7>& setting_rows() {
  static const std::array<SettingRow, 7> all{
      {{"Text size", "smaller", "larger",
        [](App& a) { return fmt::format("{:.0f} %", a.settings().text_scale * 100); }},
       {"Speed of playing", "slower", "faster",
        [](App& a) { return std::string(Session::speeds()[a.session().speed].name); }},
       {"Colours", "theme", "theme", [](App& a) { return std::string(a.settings().dark ? "dark" : "light"); }},
       {"Presenter mode, for a class", "presenter", "presenter",
        [](App& a) { return std::string(a.settings().presenter ? "on" : "off"); }},
       {"Reduced motion", "reduced-motion", "reduced-motion",
        [](App& a) {
          return std::string(a.settings().reduced_motion ? "on: nothing moves by itself" : "off: panes move");
        }},
       {"Borders between panes", "layout", "layout",
        [](App& a) {
          return std::string(a.settings().layout == Layout{} ? "as usual" : "moved; a click puts them back");
        }},
       {"Full screen", "full-screen", "full-screen", [](App&) { return std::string("on, or off"); }}}};
  return all;
}

void carry_out(App& app, const char* id) { app.run(*command_called(id)); }

std::string keys_of(const SettingRow& row) {
  const std::string less = key_names(*command_called(row.less));
  return row.less == row.more ? less : less + ", " + key_names(*command_called(row.more));
}

}  // namespace

bool App::pick_setting(SDL_Keycode code) {
  const int rows = size32(setting_rows());
  const SettingRow& row = setting_rows()[std::clamp(picked, 0, rows - 1)];
  if (code == SDLK_UP || code == SDLK_DOWN) picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, rows - 1);
  else if (code == SDLK_LEFT) carry_out(*this, row.less);
  else if (code == SDLK_RIGHT || code == SDLK_RETURN) carry_out(*this, row.more);
  else return false;
  return true;
}

void draw_settings(App& app) {
  Ui& ui = app.ui();
  const float room = ImGui::GetIO().DisplaySize.x - 3 * ui.em;
  float names = 0, values = 0, keys = 0;
  for (const SettingRow& row : setting_rows()) {
    names = std::max(names, text_size(ui, ui.fonts.text, row.title).x);
    values = std::max(values, text_size(ui, ui.fonts.text, row.now(app)).x);
    keys = std::max(keys, text_size(ui, ui.fonts.mono, keys_of(row)).x);
  }
  const float buttons = 4.2f * ui.em, all = names + values + buttons + keys + 4 * ui.em;
  const bool with_keys = all <= room;
  const std::string path = settings_path().string();
  const std::string kept = path.empty() ? "They hold until the window is closed: there is no folder to keep them in."
                                        : "Kept as they change, in " + path + ".";
  const float width = std::min(room, with_keys ? all : all - keys);
  const bool narrow = all - keys > room;  // what it is now stands below what it is
  const float height = std::max(std::round(ui.em * (narrow ? 2.9f : 2.1f)), ui.least_target);
  const Flow small{.color = ui.colors().muted, .width = width};
  begin_overlay(app, "settings",
                {width + ui.em * 1.2f, height * to_float(setting_rows().size()) + (narrow ? 4.8f : 3.4f) * ui.em +
                                           flow_height(ui, kept, small)});
  flow(ui, "Settings. \u2191 \u2193 choose a row, \u2190 \u2192 change it; Esc closes.", {.font = ui.fonts.bold});
  ImGui::Dummy({1, ui.em * 0.4f});
  const char* clicked = nullptr;
  for (std::size_t k = 0; k < setting_rows().size(); ++k) {
    const SettingRow& row = setting_rows()[k];
    const ImVec2 at = ImGui::GetCursorScreenPos(), end{at.x + width, at.y + height};
    if (index32(k) == app.picked) {
      ImGui::GetWindowDrawList()->AddRectFilled(at, end, ui.colors().now_soft);
      ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + 3, end.y}, ui.colors().now);
    }
    const float y = at.y + std::round((height - ui.em * (narrow ? 2.3f : 1)) / 2) - 1;
    draw_text(ui, {at.x + ui.em * 0.5f, y}, ui.fonts.text, ui.colors().text, row.title);
    const float x = narrow ? end.x - buttons : at.x + names + ui.em * 1.2f,
                middle = std::round((height - ui.em * 1.6f) / 2);
    const auto press = [&](float left, const std::string& label, const char* id) {
      ImGui::SetCursorScreenPos({left, at.y + middle});
      if (button(ui, fmt::format("{}##{}{}", label, id, k))) clicked = id, app.picked = index32(k);
    };
    if (row.less == row.more) {
      press(x, "\u21c4", row.more);
    } else {
      press(x, "\u2212", row.less);
      press(x + ui.em * 2.0f, "+", row.more);
    }
    if (narrow) draw_text(ui, {at.x + ui.em * 0.5f, y + ui.em * 1.25f}, ui.fonts.text, ui.colors().muted, row.now(app));
    else draw_text(ui, {x + buttons, y}, ui.fonts.text, ui.colors().text, row.now(app));
    if (with_keys) {
      const std::string its = keys_of(row);
      draw_text(ui, {end.x - text_size(ui, ui.fonts.mono, its).x - ui.em * 0.4f, y + 1}, ui.fonts.mono,
                ui.colors().muted, its);
    }
    ImGui::SetCursorScreenPos({at.x, end.y});
  }
  ImGui::Dummy({1, ui.em * 0.5f});
  flow(ui, kept, small);
  ImGui::End();
  if (clicked) carry_out(app, clicked);
}

}  // namespace zstep::viewer
