// The race in the window: each run's picture and what it has done, the clock below them, and what keys do meanwhile.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/overlays.hpp"
#include "sim/viewer/panes/chart_picture.hpp"
#include "sim/viewer/panes/strip_marks.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

using compare::Measure;
using compare::Work;

/// Commands that mean something while methods race.
bool is_for_race(const Command& command) {
  constexpr std::array<const char*, 18> ids{
      "next",          "previous",     "next-pixel",       "previous-pixel", "next-span", "previous-span", "next-line",
      "previous-line", "next-polygon", "previous-polygon", "first",          "last",      "play",          "faster",
      "slower",        "race",         "zoom-in",          "zoom-out"};
  const auto is_it = [&](const char* id) { return std::strcmp(id, command.id) == 0; };
  return std::strcmp(command.group, "Window") == 0 || std::strcmp(command.group, "Class") == 0 ||
         std::any_of(ids.begin(), ids.end(), is_it);
}

/// So many parts of the clock.
std::int64_t parts_of(Unit unit, std::int64_t end) {
  switch (unit) {
    case Unit::event:
      return 1;
    case Unit::pixel:
      return 10;
    case Unit::span:
    case Unit::scan_line:
      return 100;
    case Unit::polygon:
      break;
  }
  return std::max<std::int64_t>(1, end / 20);
}

struct CounterRow {
  std::string name, now, all;
  bool bold = false;
};

/// What a run has done so far, of how much: by each measure, and each kind of work that some run of the race has.
std::vector<CounterRow> counters_of(const Race& race, const Race::Racer& racer, std::size_t room) {
  const std::int64_t at = racer.session.position();
  const compare::WorkCounts now = racer.work.at(at), all = racer.work.all();
  std::vector<CounterRow> rows;
  const auto add = [&](std::string_view name, std::int64_t done, std::int64_t of, bool bold) {
    rows.push_back({std::string(name), grouped(done), grouped(of), bold});
  };
  add(word_of(Measure::steps), at, racer.session.size(), race.clock() == Measure::steps);
  add(word_of(Measure::operations), compare::operations(now), compare::operations(all),
      race.clock() == Measure::operations);
  if (racer.seconds) {
    const double share = racer.session.size() == 0 ? 1 : ratio(at, racer.session.size());
    rows.push_back({"time, measured", seconds_text(*racer.seconds * share), seconds_text(*racer.seconds),
                    race.clock() == Measure::time});
  }
  // Where there is no room for all, those that most is done of; in the same order for every run.
  std::vector<std::pair<std::int64_t, Work>> kinds;
  for (std::size_t k = 0; k < index_of(Work::bookkeeping); ++k) {
    const auto kind = static_cast<Work>(k);
    std::int64_t most = 0;
    for (const auto& other : race.racers()) most = std::max(most, other->work.all()[kind]);
    if (most > 0) kinds.emplace_back(most, kind);
  }
  std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  kinds.resize(std::min(kinds.size(), room > rows.size() ? room - rows.size() : 0));
  std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const auto& [most, kind] : kinds) add(compare::word_of(kind), now[kind], all[kind], false);
  return rows;
}

void draw_counters(Ui& ui, const Race& race, const Race::Racer& racer, ImVec2 at, ImVec2 size) {
  const Theme& c = ui.colors();
  const float line = std::round(ui.fonts.small->FontSize * 1.25f), pad = std::round(ui.em * 0.4f);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, c.pane);
  const bool done = racer.session.position() == racer.session.size();
  float y = at.y + std::round(pad / 2);
  const std::string said = !racer.run.whole ? "Cut off: the run is longer." : done ? "\u2713 Done." : "At work";
  draw_text(ui, {at.x + pad, y}, ui.fonts.bold, done ? c.good : c.text,
            fitted(ui, ui.fonts.bold, said, size.x - 2 * pad));
  y += std::round(ui.em * 1.4f);
  const float rows = std::floor((at.y + size.y - y) / line), right = at.x + std::min(size.x, 26 * ui.em) - pad;
  for (const CounterRow& row : counters_of(race, racer, static_cast<std::size_t>(std::max(0.0f, rows)))) {
    if (y + line > at.y + size.y) break;
    const bool none = row.all == "0";
    const ImU32 color = row.bold ? c.now : none ? c.muted : c.text;
    const std::string both = none ? "none" : row.now + " of " + row.all;
    const float wide = text_size(ui, ui.fonts.small, both).x;
    const std::string numbers = wide + ui.em < size.x * 0.75f ? both : row.now;
    draw_text(ui, {right - text_size(ui, ui.fonts.small, numbers).x, y}, ui.fonts.small, color, numbers);
    draw_text(ui, {at.x + pad, y}, ui.fonts.small, color,
              fitted(ui, ui.fonts.small, row.name, size.x - 3 * pad - text_size(ui, ui.fonts.small, numbers).x));
    y += line;
  }
  frame_box(ui, at, {at.x + size.x, at.y + size.y}, done ? c.good : c.rule, done ? 2 : 1);
}

}  // namespace

void App::run(const Command& command) {
  if (race_shown_ && !is_for_race(command))
    return say("That is for one run; this is a race of several. Esc goes back to one.");
  command.run(*this);
}

void App::move(Unit unit, int direction) {
  if (!race_shown_) return session_.move(unit, direction);
  const std::int64_t from = race().at();
  race().go_to(from + direction * parts_of(unit, race().end()));
  if (race().at() == from) say(direction > 0 ? "All are done." : "This is the start.");
}

void App::go_to(std::int64_t position) {
  if (!race_shown_) return session_.go_to(position);
  race().go_to(position);
}

void App::toggle_play() {
  if (!race_shown_) return session_.toggle_play();
  if (!race().playing && race().at() == race().end()) return say("All are done; Home goes back to the start.");
  race().playing = !race().playing;
}

void App::change_speed(int direction) {
  if (race_shown_) {
    race().change_speed(direction);
    return say(fmt::format("Plays {}.", race().speed_text()));
  }
  session_.speed = std::clamp(session_.speed + direction, 0, size32(Session::speeds()) - 1);
  say(fmt::format("Plays at {}.", Session::speeds()[session_.speed].name));
}

double App::play(double now) {
  if (!race_shown_) return session_.play(now);
  return race().play(now);
}

void App::open_race(const std::optional<RaceAsked>& asked) {
  if (!run_by_ || against_) return say("Methods cannot be run from here, so there is no race.");
  if (!race_) race_ = std::make_unique<RaceView>(session_.trace(), run_by_);
  std::vector<std::string> entrants = asked && !asked->entrants.empty() ? asked->entrants : race().chosen();
  try {
    if (entrants.empty()) entrants = race().usual();
    if (entrants.size() < Race::least && !asked)
      return say("No other method can draw this scene, so there is no race.");
    race().choose(entrants);
    race_->looks.clear();
  } catch (const InputError& error) {
    if (asked) throw;
    return say(error.what());
  }
  session_.playing = false;
  race_shown_ = true;
  if (overlay_ != Overlay::none || drawer_ != Drawer::none) open(Drawer::none);
  if (asked) {
    race_by(asked->clock);
    const double at = asked->of_all ? asked->at * static_cast<double>(race().end()) : asked->at;
    race().go_to(std::llround(std::min(at, static_cast<double>(race().end()))));
  }
}

void App::close_race() {
  if (growth().at_work) {
    growth().at_work = false;
    return say("Measuring was ended here.");
  }
  race().playing = race_shown_ = false;
}

void App::race_by(Measure clock) {
  std::string why;
  if (!race().set_clock(clock, ends_waiting, why)) return say(why);
  if (clock == Measure::time)
    say("Measured here without a recording: the median time, spread evenly over a run's steps.");
}

std::vector<std::string> App::race_place() const {
  const Race& race = race_->race;
  const bool time = race.clock() == Measure::time;
  const std::string at = time ? fmt::format("{:.4g}%", ratio(100 * race.at(), std::max<std::int64_t>(1, race.end())))
                              : std::to_string(race.at());
  return {"--race",    fmt::format("{}", fmt::join(race.chosen(), ",")),
          "--race-by", std::string(word_of(race.clock())),
          "--at",      at};
}

/// Keys that only a race has.
bool App::race_key(SDL_Keycode code, unsigned modifiers) {
  if (modifiers != 0) return false;
  if (code >= SDLK_1 && code <= SDLK_3) return race_by(static_cast<Measure>(code - SDLK_1)), true;
  if (code == SDLK_c) return open(Overlay::racers), true;
  if (code == SDLK_TAB || code == SDLK_4) return race_->shows_growth = !race_->shows_growth, true;
  if (code == SDLK_RETURN && race_->shows_growth) return growth().begin(race()), true;
  return false;
}

/// Buttons from left to right, in as many lines as that takes; how high they are together.
float App::draw_race_head(ImVec2 at, float width) {
  const float gap = std::round(ui_.em * 0.3f), line = std::max(std::round(ui_.em * 1.9f), ui_.least_target + gap);
  ImVec2 to = at;
  const auto next = [&](const char* label, bool lit, const char* help, float before = 0) {
    const float wide = std::max(ui_.least_target, text_size(ui_, ui_.fonts.text, label).x + std::round(ui_.em * 1.1f));
    to.x += to.x > at.x ? before : 0;
    if (to.x > at.x && to.x + wide > at.x + width) to = {at.x, to.y + line};
    ImGui::SetCursorScreenPos(to);
    to.x += wide + gap;
    const bool clicked = tall_button(ui_, label, lit);
    if (ImGui::IsItemHovered()) ui_.mouse_help = help;
    return clicked;
  };
  if (next("Who runs\u2026", overlay_ == Overlay::racers, "Two to four methods, or options of one (C)."))
    open(Overlay::racers);
  const ByEnum<Measure, const char*, 3> helps{
      "All have made as many steps (1): what the trace records, bookkeeping included.",
      "All have done as many operations: steps that compute, decide or write something (2).",
      "All have run as long, by times measured here without a recording (3)."};
  const ByEnum<Measure, const char*, 3> labels{"By steps", "By operations", "By time"};
  for (const Measure clock : {Measure::steps, Measure::operations, Measure::time})
    if (next(labels[clock], race().clock() == clock, helps[clock], clock == Measure::steps ? gap : 0)) race_by(clock);
  if (next(race_->shows_growth ? "The pictures" : "Costs as N grows", false,
           "How costs grow with the number of polygons, measured here (Tab, 4).", gap))
    race_->shows_growth = !race_->shows_growth;
  const float close = text_size(ui_, ui_.fonts.text, "Close").x + ui_.em * 1.2f;
  to.x = std::max(to.x, at.x + width - close);
  if (next("Close", false, "Back to one run (Esc).")) close_race();
  const ByEnum<Measure, const char*, 3> counts{
      "A step is one thing that the trace records, bookkeeping included. Some take far longer than others: only the "
      "time (3) says which method is faster.",
      "An operation is a step that computes, decides or writes something. Some take longer than others: only the time "
      "(3) says which method is faster.",
      "Times are of the processor, measured here without a recording: the median of several runs."};
  float below = to.y + line - at.y;
  if (ui_.least_target > 0) return below;
  ImGui::SetCursorScreenPos({at.x, at.y + below});
  const Flow small{.color = ui_.colors().muted, .font = ui_.fonts.small, .width = width};
  const char* text = counts[race().clock()];
  flow(ui_, text, small);
  return below + flow_height(ui_, text, small) + gap;
}

void App::draw_racers(ImVec2 at, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f);
  const auto& racers = race().racers();
  const auto count = size32(racers);
  if (race_->looks.empty()) {
    for (const auto& racer : racers) {
      race_->looks.push_back(std::make_unique<Ui>(racer->session, renderer_));
      race_->looks.back()->asks = false;
    }
  }
  const float line = ui_.fonts.small->FontSize * 1.25f, head = ui_.em * 1.9f;
  const bool two_rows = count == 4 && size.x < size.y * 1.6f;
  const int columns = two_rows ? 2 : count, rows = two_rows ? 2 : 1;
  const float wide = std::floor((size.x - gap * to_float(columns - 1)) / to_float(columns)),
              high = std::floor((size.y - gap * to_float(rows - 1)) / to_float(rows));
  const float part = high < 15 * ui_.em ? 0.3f : ui_.presenter ? 0.36f : 0.42f;  // the pictures first
  const float counters = std::round(std::min(head + 11 * line, high * part));
  for (int k = 0; k < count; ++k) {
    const Race::Racer& racer = *racers[k];
    Ui& look = *race_->looks[k];
    share_look(look);
    look.pixel_marks = nullptr;
    const ImVec2 corner{at.x + to_float(k % columns) * (wide + gap), at.y + to_float(k / columns) * (high + gap)};
    if (draw_beside(look, frame_pane, racer.entrant.title, corner, {wide, high - counters}))
      for (const auto& other : racers) other->session.select(look.session.selected);
    draw_counters(ui_, race(), racer, {corner.x, corner.y + high - counters}, {wide, counters});
  }
}

/// A bar for each run, as long as the run, filled as far as it is; then the buttons that move the clock.
void App::draw_race_clock(ImVec2 at, float width) {
  const Theme& c = ui_.colors();
  const float row = std::round(ui_.em * 1.15f), thick = std::round(ui_.em * 0.7f), gap = std::round(ui_.em * 0.5f);
  const auto& racers = race().racers();
  const ImFont* font = ui_.fonts.small;
  float named = 0, told = 0;
  for (const auto& racer : racers) {
    named = std::max(named, text_size(ui_, font, racer->entrant.title).x);
    told = std::max(told, text_size(ui_, font, race().finish_text(*racer)).x);
  }
  named = std::min(named, width * 0.25f);
  const Strip strip{{at.x + named + gap, at.y},
                    std::max(1.0f, width - named - told - 2 * gap),
                    row * to_float(racers.size()),
                    0,
                    race().end()};
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k < racers.size(); ++k) {
    const float y = at.y + row * to_float(k), top = y + std::round((row - thick) / 2);
    const float middle = y + std::round((row - font->FontSize) / 2) - 1;
    const std::int64_t finish = race().finish(*racers[k]);
    const float end = std::floor(strip.x(finish)), now = std::floor(strip.x(std::min(finish, race().at())));
    const bool done = race().at() >= finish;
    draw_text(ui_, {at.x, middle}, font, c.text, fitted(ui_, font, racers[k]->entrant.title, named));
    list->AddRectFilled({strip.at.x, top}, {end, top + thick}, c.head);
    list->AddRectFilled({strip.at.x, top}, {now, top + thick}, done ? c.good : c.muted);
    frame_box(ui_, {strip.at.x, top}, {std::max(end, strip.at.x + 2), top + thick}, c.rule);
    draw_text(ui_, {at.x + width - text_size(ui_, font, race().finish_text(*racers[k])).x, middle}, font,
              done ? c.good : c.text, race().finish_text(*racers[k]));
  }
  const float x = std::floor(strip.x(race().at())), half = std::round(1.5f * ui_.thin);
  list->AddRectFilled({x - half, at.y}, {x + half, at.y + strip.height}, c.now);
  ImGui::SetCursorScreenPos(strip.at);
  ImGui::InvisibleButton("clock of the race", {strip.width, strip.height});
  if (ImGui::IsItemHovered()) ui_.mouse_help = "Click or drag: the clock goes there.";
  if (ImGui::IsItemActive()) {
    race().playing = false;
    const std::int64_t to = strip.position(ImGui::GetIO().MousePos.x);
    if (to != race().at()) go_to(to);
  }
  ImGui::SetCursorScreenPos({at.x, at.y + strip.height + std::round(ui_.em * 0.3f)});
  if (ui_.least_target > 0) return draw_small_transport(ui_, race().playing, {width, small_row()});
  draw_transport(ui_, race().playing, race().speed_text(), text_size(ui_, ui_.fonts.text, "100 operations/s").x, width);
  ImGui::SameLine(0, ui_.em);
  const ImVec2 here = ImGui::GetCursorScreenPos();
  const std::string
      every = "\u2192 one    Shift+\u2192 ten    Page down a twentieth    C who runs    Tab costs    Esc back",
      few = "C who runs    Tab costs    Esc back";
  for (const std::string& hint : {session_.message, ui_.mouse_help, every, few})
    if (!hint.empty() && text_size(ui_, ui_.fonts.text, hint).x < at.x + width - here.x) {
      draw_text(ui_, {here.x, here.y + std::round(ui_.em * 0.3f)}, ui_.fonts.text,
                hint == session_.message ? c.text : c.muted, hint);
      break;
    }
}

void App::draw_race(ImVec2 at, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f);
  const float row = ui_.least_target > 0 ? small_row() + std::round(0.5f * ui_.em) : 2.1f * ui_.em;
  const float foot = std::round(ui_.em * 1.15f * to_float(race().racers().size()) + row);
  if (size.y < foot + 8 * ui_.em || size.x < 20 * ui_.em) {
    ImGui::SetCursorScreenPos(at);
    return flow(ui_, "Too small for a race; enlarge the window, or Ctrl+\u2212 for smaller text.", {.width = size.x});
  }
  const float head = draw_race_head(at, size.x);
  const ImVec2 middle{at.x, at.y + head}, room{size.x, size.y - head - foot - gap};
  if (race_->shows_growth) draw_growth(middle, room);
  else draw_racers(middle, room);
  draw_race_clock({at.x, at.y + size.y - foot}, size.x);
}

// Who runs in a race: methods and their options, found by name, in or out by Enter or a click.

std::vector<const compare::Entrant*> App::found_entrants() const {
  const std::string part = lower_case(typed);
  std::vector<const compare::Entrant*> found;
  for (const compare::Entrant& one : race_->race.all())
    if (lower_case(one.title + "\n" + one.text).find(part) != std::string::npos) found.push_back(&one);
  return found;
}

void App::turn_racer(const std::string& entrant) {
  wrong.clear();
  std::vector<std::string> chosen = race().chosen();
  const auto place = std::find(chosen.begin(), chosen.end(), entrant);
  if (place != chosen.end()) chosen.erase(place);
  else chosen.push_back(entrant);
  try {
    if (chosen.size() < Race::least) wrong = "Two at least: choose another one first.";
    else if (chosen.size() > Race::most) wrong = "Four at most: take one out first.";
    else race().choose(chosen), race_->looks.clear();
  } catch (const std::exception& error) {
    wrong = error.what();
  }
}

bool App::pick_racer(SDL_Keycode code) {
  const std::vector<const compare::Entrant*> found = found_entrants();
  if (code != SDLK_RETURN) return pick_among(found.size(), code);
  if (static_cast<std::size_t>(picked) < found.size()) turn_racer(found[picked]->text);
  return true;
}

void draw_racers_list(App& app) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  begin_overlay(app, "who runs", {ui.em * 30, ui.em * 30});
  flow(ui, "Who runs? Two to four: methods, and their options.", {.font = ui.fonts.bold});
  app.draw_field("Type a part of a name");
  if (!app.wrong.empty()) say_wrong(ui, app.wrong);
  const std::string how = "Enter or a click: in, or out. Esc: to the race.";
  const float foot = flow_height(ui, how, {}) + ui.em * 0.5f, line = std::round(ui.em * 1.4f);
  const std::vector<std::string> chosen = app.race().chosen();
  const auto found = app.found_entrants();
  const compare::Entrant* clicked = nullptr;
  ImGui::BeginChild("entrants", {ImGui::GetContentRegionAvail().x, ImGui::GetContentRegionAvail().y - foot}, false,
                    ImGuiWindowFlags_NoNav);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const ListRow row = list_row(app, k, line);
    if (row.clicked) clicked = found[k];
    if (!row.visible) continue;
    const bool in = std::find(chosen.begin(), chosen.end(), found[k]->text) != chosen.end();
    const float indent = ui.em * (found[k]->changes.empty() ? 1.6f : 3.0f),
                y = row.at.y + std::round((line - ui.em) / 2) - 1;
    if (in) draw_text(ui, {row.at.x + ui.em * 0.4f, y}, ui.fonts.bold, c.good, "\u2713");
    draw_text(ui, {row.at.x + indent, y}, in ? ui.fonts.bold : ui.fonts.text, c.text,
              fitted(ui, in ? ui.fonts.bold : ui.fonts.text, found[k]->title, row.end.x - row.at.x - indent));
  }
  app.scroll_to_picked = false;
  if (found.empty()) say_empty(ui, "No method that can draw this scene has this in its name.");
  ImGui::EndChild();
  flow(ui, how, {.color = c.muted});
  ImGui::End();
  if (clicked) app.turn_racer(clicked->text);
}

// Where the costs of the methods of a race cross as the number of polygons grows, as a chart.

namespace {

using compare::Measure;

LineChart growth_chart(const GrowthChart& growth, Measure measure) {
  LineChart chart;
  chart.x_title = "polygons";
  chart.y_title = measure == Measure::time ? "milliseconds" : std::string(word_of(measure));
  chart.x_ticks.assign(compare::growth_sizes.begin(), compare::growth_sizes.end());
  const double unit = measure == Measure::time ? 1e3 : 1;
  // Shapes and colours of their own: a disc, a square, a triangle, a diamond.
  constexpr std::array<int, Race::most> looks{LineChart::plain_look, 1, 2, 6 + LineChart::muted_look};
  for (const compare::GrowthLine& line : growth.lines) {
    LineChart::Line drawn{line.title, {}, false, looks[&line - growth.lines.data()]};
    for (const compare::GrowthPoint& point : line.points)
      drawn.points.emplace_back(point.polygons, unit * point.by(measure));
    if (!drawn.points.empty()) chart.lines.push_back(std::move(drawn));
  }
  for (const compare::Crossing& crossing : compare::crossings(growth.lines, measure))
    chart.now.push_back({{crossing.polygons, unit * crossing.cost}, "about " + grouped(crossing.rounded())});
  return chart;
}

}  // namespace

void App::draw_growth(ImVec2 at, ImVec2 size) {
  const Theme& c = ui_.colors();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, c.pane);
  ImGui::SetCursorScreenPos(at);
  ImGui::BeginChild("costs", size, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysUseWindowPadding);
  const Measure measure = race().clock();
  const GrowthChart& growth = race_->growth;
  const auto measured = [](const compare::GrowthLine& line) { return line.points.size() > 1; };
  flow(
      ui_,
      fmt::format(
          "{} against the number of polygons: random triangles on {} \u00d7 {} pixels, whose areas add up to "
          "{:g} times that whatever their number.{}",
          measure == Measure::time    ? "Time"
          : measure == Measure::steps ? "Steps"
                                      : "Operations",
          compare::growth_side, compare::growth_side, compare::growth_layers,
          measure == Measure::time ? " Measured on this machine without a recording; the median of several runs." : ""),
      {.color = c.muted});
  if (growth.at_work) {
    flow(ui_, fmt::format("Measuring {}; Esc ends it.", growth.next_text()), {.color = c.now, .font = ui_.fonts.bold});
  } else {
    if (button(ui_, growth.lines.empty() ? "Measure (Enter)" : "Measure again (Enter)")) race_->growth.begin(race());
    if (!growth.lines.empty()) flow(ui_, compare::tell_growth(growth.lines, measure), {});
  }
  if (std::any_of(growth.lines.begin(), growth.lines.end(), measured))
    draw_line_chart(ui_, "costs of the race", growth_chart(growth, measure));
  ImGui::EndChild();
  frame_box(ui_, at, {at.x + size.x, at.y + size.y}, c.rule);
}

}  // namespace zstep::viewer
