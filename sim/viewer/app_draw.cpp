// One frame: title, panes, timeline, and what lies over them.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <utility>

#include "sim/film/video.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/overlays.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/viewer/system.hpp"
#include "sim/viewer/window.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

constexpr ImGuiWindowFlags bare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                  ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse;

}  // namespace

void App::draw_title(ImVec2 at, ImVec2 size) {
  const Theme& c = ui_.colors();
  const State& state = session_.state();
  const ImFont* font = ui_.fonts.text;
  const float y = at.y + std::round((size.y - font->FontSize) / 2) - 1;
  float right = at.x + size.x;
  const auto button_before = [&](const char* word, bool lit, const char* help) {
    right -= text_size(ui_, font, word).x + std::round(ui_.em * 1.1f);
    ImGui::SetCursorScreenPos({right, at.y + std::round(ui_.em * 0.12f)});
    right -= std::round(ui_.em * 0.3f);
    const bool clicked = button(ui_, word, lit);
    if (ImGui::IsItemHovered()) ui_.mouse_help = help;
    return clicked;
  };
  if (button_before("Menu", overlay_ == Overlay::menu, "Every command, with its key."))
    open(overlay_ == Overlay::menu ? Overlay::none : Overlay::menu);
  if (button_before("\u2699", overlay_ == Overlay::settings, "Settings: text size, speed, colours, motion (Ctrl+,)."))
    open(overlay_ == Overlay::settings ? Overlay::none : Overlay::settings);
  if (button_before("Open", overlay_ == Overlay::start, "Another lesson, method or scene, or a file (Ctrl+O)."))
    open_start();
  if (may_change() && button_before("Race", race_shown_, "Methods side by side on this scene (Ctrl+R)."))
    race_shown_ ? close_race() : open_race();
  if (may_change() && !race_shown_ &&
      button_before("Change", drawer_ == Drawer::what_if, "Camera, vertices, order, options of this run (Ctrl+E)."))
    open_what_if();
  if (session_.lesson() && !against_ && !race_shown_ &&
      button_before(ui_.laboratory ? "Lesson" : "Laboratory", false,
                    "Every pane, or the lesson's own layout (Shift+P)."))
    turn_laboratory();
  right -= std::round(ui_.em * 0.7f);
  if (board_.clock_runs()) {
    const std::string clock = board_.clock(clock_time);
    right -= text_size(ui_, ui_.fonts.bold, clock).x;
    draw_text(ui_, {right, y}, ui_.fonts.bold, c.now, clock);
    right -= ui_.em;
  }

  // From the right: what there is room for, the most important first.
  std::vector<std::string> parts{fmt::format("step {} of {}", grouped(session_.position()), grouped(session_.size()))};
  const bool works = !session_.at_rest();
  if (works && state.machine.polygon != no_polygon)
    parts.push_back("polygon " + polygon_label(session_.scene(), state.machine.polygon));
  if (works && state.machine.horizon.curve)
    parts.push_back(fmt::format("curve {}", state.machine.horizon.curve->curve));
  if (works && state.machine.horizon.test && session_.event_told())
    parts.push_back(fmt::format("column {}", state.machine.horizon.test->x));
  if (works && state.machine.scan_line) parts.push_back(fmt::format("scan line {}", *state.machine.scan_line));
  if (const auto cell = works ? session_.cell_looked_at() : std::nullopt)
    parts.push_back(fmt::format("pixel ({}, {})", cell->x, cell->y));
  const Scene& scene = session_.scene();
  if (race_shown_) parts = {race().place_text()};
  // A click on a lesson, a method or a scene offers the others.
  std::vector<TitleName> names{{"zstep"}};
  enum Tells : int { of_scene = 1, of_method, of_lesson, of_run };
  const auto offered = [&](Offer::What what) { return ask_for_offers_ ? std::optional(what) : std::nullopt; };
  if (session_.lesson()) names.push_back({session_.lesson()->title, of_lesson, offered(Offer::What::lesson)});
  if (against_) {
    const Session& b = against_->session();
    parts.insert(parts.begin() + 1, fmt::format("run B: step {} of {}", grouped(b.position()), grouped(b.size())));
    for (const Session* run : {static_cast<const Session*>(&session_), &b})
      names.push_back(
          {(run == &b ? "B: " : "A: ") + std::filesystem::path(run->trace().name()).filename().string(), of_run});
  } else {
    const Header& header = session_.header();
    if (race_shown_) names.push_back({"Race", of_method});
    else
      names.push_back(
          {header.title.empty() ? header.algorithm : header.title, of_method, offered(Offer::What::method)});
    names.push_back({scene.name.empty() ? session_.trace().name() : scene.name, of_scene, offered(Offer::What::scene)});
  }
  const auto joined = [](const std::vector<std::string>& all) {
    std::string text;
    for (const std::string& part : all) text += (text.empty() ? "" : " \u00b7 ") + part;
    return text;
  };
  const auto width_of = [&](const std::string& text) { return text_size(ui_, ui_.fonts.bold, text).x; };
  const auto cut = [&](const std::string& text, float room) { return fitted(ui_, ui_.fonts.bold, text, room); };
  const auto beside = [&] { return right - at.x - ui_.em - text_size(ui_, font, joined(parts)).x; };
  while (parts.size() > 1 && beside() < -ui_.em) parts.pop_back();
  // The step's polygon, line and pixel are written below as well, so they make room for the most important name.
  const float telling = width_of(joined_names(most_telling(names)));
  while (parts.size() > (against_ ? 2 : 1) && beside() < telling) parts.pop_back();
  const std::string where = joined(parts);
  const float where_width = text_size(ui_, font, where).x;
  if (where_width <= right - at.x) draw_text(ui_, {right - where_width, y}, font, c.text, where);
  names = names_that_fit(std::move(names), beside(), {width_of, cut, 4 * ui_.em});
  float x = at.x;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const TitleName& name = names[k];
    const std::string text = (k == 0 ? "" : " \u00b7 ") + name.text + name.sign();
    const ImVec2 from{x, at.y}, to{x + width_of(text), at.y + size.y};
    draw_text(ui_, {x, y}, ui_.fonts.bold, c.text, text);
    x = to.x;
    if (!name.offers) continue;
    ImGui::SetCursorScreenPos(from);
    const std::string id = "title" + std::to_string(static_cast<int>(*name.offers));
    const bool clicked = ImGui::InvisibleButton(id.c_str(), {to.x - from.x, to.y - from.y});
    if (clicked) open_start(*name.offers);
    if (!ImGui::IsItemHovered()) continue;
    const float left = from.x + (k == 0 ? 0 : width_of(" \u00b7 "));
    ImGui::GetWindowDrawList()->AddRectFilled({left, y + font->FontSize}, {to.x, y + font->FontSize + 2}, c.selected);
    ui_.mouse_help = *name.offers == Offer::What::lesson   ? "Click: another lesson."
                     : *name.offers == Offer::What::method ? "Click: another method, for this scene."
                                                           : "Click: another scene, by this method.";
  }
}

void App::draw_overlay() {
  switch (overlay_) {
    case Overlay::none:
      return;
    case Overlay::keys:
      return draw_key_sheet(*this);
    case Overlay::palette:
      return draw_palette(*this);
    case Overlay::go_to:
      return draw_go_to(*this);
    case Overlay::menu:
      return draw_menu(*this);
    case Overlay::start:
      return draw_start(*this);
    case Overlay::here:
      return draw_here(*this, here_at_);
    case Overlay::settings:
      return draw_settings(*this);
    case Overlay::racers:
      return draw_racers_list(*this);
    case Overlay::film:
      return draw_film(*this);
  }
}

/// What was clicked in this frame, where no question lies over it.
void App::take_clicks() {
  if (ui_.clicked) {
    session_.message.clear();
    run(*ui_.clicked);
  } else if (!ui_.here.empty()) {
    here_ = ui_.here;
    here_at_ = ImGui::GetIO().MousePos;
    open(Overlay::here);
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    open(Overlay::menu);
  }
}

/// Panes scroll to what is at work when the step or the layout changes, for some frames: the first may bring a scroll
/// bar, which wraps lines anew.
void App::begin_scrolling() {
  const auto scrolls = [](std::uint64_t now, std::uint64_t& follows, int& frames) {
    if (follows != now) follows = now, frames = frames_to_settle - 1;
    return frames > 0 && frames-- > 0;
  };
  const Layout& l = settings_.layout;
  Fingerprint layout;
  for (const float part : {to_float(renderer_.width()), to_float(renderer_.height()), built_for_, l.left, l.right,
                           l.code, l.frame, l.table, l.stage, l.both, l.lesson})
    take(layout, part);
  for (const auto& [pane, share] : l.structures) take(layout, share);
  take(layout, l.drawer_width);
  take(layout, l.drawer_height);
  take(layout, drawer_);
  take(layout, ui_.presenter);
  take(layout, ui_.laboratory);
  take(layout, ui_.vertices_always);
  take(layout, lead());
  take(layout, words_shown());
  take(layout, viewing_step(ui_));
  take(layout, motion_.panes_move());
  Fingerprint moment = layout, stop = layout;
  take(moment, session_.position());
  take(stop, session_.stop());
  take(stop, ui_.presenter && session_.question_open());
  ui_.scroll_now = scrolls(moment.value(), ui_.scroll_follows, ui_.scroll_frames);
  ui_.speaks_now = scrolls(stop.value(), ui_.speaks_follows, ui_.speaks_frames);
}

void App::draw() {
  ImGui::SetCurrentContext(context_.context);
  places_.look_on();
  if (session_.lesson() && overlay_ != Overlay::start && !film_ && !embedded())
    settings_.see_stop(session_.lesson()->id, session_.stop() + 1);
  if (asking_ > 0 && --asking_ == 0) ask_now();
  if (race_ && growth().at_work && growth().shown++ > 0) growth().measure_next(ends_waiting);
  follow_overlay();
  follow_selected();
  ui_.laboratory = laboratory_ || against_ || only_ || !(session_.lesson() || lesson_waits || ui_.presenter);
  update_fonts();
  apply_style(ui_);
  const ImVec2 size{to_float(renderer_.width()), to_float(renderer_.height())};
  ImGui::GetIO().DisplaySize = size;
  begin_motion();
  begin_scrolling();
  ui_.hits.follow(session_.trace(), session_.position());
  ui_.mouse_help = ui_.fonts.lacking;
  ui_.asked.reset();
  ui_.asked_as.clear();
  ui_.here.clear();
  ui_.clicked = nullptr;
  ui_.targets = &targets_;
  targets_.clear();
  ui_.pointed_next.reset();
  ui_.hovered_edge_next.reset();
  ui_.hovered_part_next = {};
  follow_marks();
  ImGui::NewFrame();
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("zstep", nullptr, bare);
  ImGui::PopStyleVar();
  const float pad = std::round(ui_.em * (ui_.presenter ? 0.3f : 0.4f));
  float title = embedded() ? pad : std::round(ui_.em * 1.9f), timeline = timeline_height(ui_);
  const ImVec2 at{pad, 0};
  const float width = size.x - 2 * pad, height = size.y - title - timeline - 2 * pad;
  const bool small = !only_ && !against_ && !embedded() && too_small({width, height});
  ui_.least_target = small || by_touch_ ? 44 * dpi_scale_ : 0;
  if (small) title = timeline = small_row();
  take_keys_by_click();
  drawer_at_ = stage_at_ = timeline_at_ = {};
  ui_.changes = drawer_ == Drawer::what_if;
  if (!ui_.changes) ui_.taken.reset();
  if (slide_) draw_slide();
  else if (only_) draw_pane(*only_, {0, 0}, size);
  else if (!small && !embedded()) draw_title(at, {width, title});
  else if (race_shown_ && small) draw_small_title(at, {width, title});
  if (slide_) {
  } else if (race_shown_) draw_race({pad, title}, {width, size.y - title - pad});
  else if (small) draw_small_window(size);
  else if (!only_ && width > 8 && height > 8) draw_panes({pad, title}, {width, height});
  if (!only_ && !slide_ && !race_shown_ && !small && size.y > title + timeline) {
    timeline_at_ = {{pad, size.y - timeline - pad}, {width, timeline}};
    ImGui::SetCursorScreenPos(timeline_at_.at);
    const std::int64_t b_was = against_ ? against_->session().position() : 0;
    if (embedded()) ui_.mouse_help = " ";  // what the keys do is for a window
    draw_timeline(ui_, {width, timeline});
    if (embedded()) draw_way_out(timeline_at_.at, {width, timeline});
    if (against_ && against_->session().position() != b_was) against_->follow_second();
  }
  ImGui::End();
  take_vertex();
  if (!slide_) {
    draw_entering_edge();
    board_.draw(ui_, {0, title}, {size.x, std::max(1.0f, size.y - title - timeline)});
    draw_drawer();
  }
  if (overlay_ != Overlay::none) targets_.clear();  // what lies under it cannot be hit
  draw_overlay();
  if (ui_.asked && overlay_ == Overlay::none) open_explain(*ui_.asked, ui_.asked_as);
  if (places_.searching()) draw_search(*this);
  if (film_ && !film_->draws) draw_filming(*this);
  if (overlay_ == Overlay::none) take_clicks();
  if (black_) ImGui::GetForegroundDrawList()->AddRectFilled({0, 0}, size, IM_COL32_BLACK);
  ImGui::Render();
  renderer_.draw(*ImGui::GetDrawData(), to_pixel(ui_.colors().window));
  ui_.pointed = ui_.pointed_next;
  session_.hovered_edge = ui_.hovered_edge_next;
  session_.hovered_part = ui_.hovered_part_next;
}

// Inside a page of others: what leads, the transport, and a way to a window with everything.

void App::draw_embedded(ImVec2 at, ImVec2 size) {
  std::vector<Pane> leading = workspace(session_.header(), lead()).leading;
  // A frame in a text is small: beside each other only where each has room.
  if (size.x < ui_.em * 14 * to_float(leading.size())) leading.resize(1);
  draw_leading(leading, at, size);
}

/// At the right of the transport, where there is room for it.
void App::draw_way_out(ImVec2 at, ImVec2 size) {
  const std::string word = "Open in zstep";
  const float transport = ImGui::GetItemRectMax().x, percent = text_size(ui_, ui_.fonts.mono, "100.0 %").x;
  const float wide = text_size(ui_, ui_.fonts.text, word).x + std::round(ui_.em * 1.1f);
  const float top = ImGui::GetItemRectMin().y;
  float x = at.x + size.x - percent - ui_.em * 0.7f - wide;
  if (x < transport + ui_.em * 0.5f) x = at.x + size.x - wide;
  if (x < transport + ui_.em * 0.5f) return;
  ImGui::SetCursorScreenPos({std::floor(x), top});
  if (button(ui_, word)) requests.leave_page = true;
}

void App::end_embedding() {
  settings_.embedded = false;
  std::erase(opened_by, "--embed");
}

std::string App::link_of_whole() const {
  std::string link = this->link().value_or("");
  const std::string embed = "&embed=1";
  if (const std::size_t at = link.find(embed); at != link.npos) link.erase(at, embed.size());
  return link;
}

// Making a film: a few of its frames in each frame of the window, and then back to where the reader was.

std::string film_length(std::int64_t frames) {
  return fmt::format("{} {}, {:.1f} s", grouped(frames), frames == 1 ? "frame" : "frames",
                     static_cast<double>(frames) / usual_frames_a_second);
}

void App::open_film() {
  if (against_) return say("A film shows one run, and these are two; open one of them alone.");
  open(overlay_ == Overlay::film ? Overlay::none : Overlay::film);
}

std::vector<FilmRange> App::film_ranges() const {
  std::vector<FilmRange> ranges;
  const std::int64_t here = session_.position(), size = session_.size();
  const auto add = [&](std::string what, std::int64_t first, std::int64_t last) {
    if (first < last) ranges.push_back({std::move(what), first, last});
  };
  if (session_.lesson() && session_.stop() >= 0) {
    const std::vector<Stop>& stops = session_.lesson()->stops;
    const std::int64_t from = stops[session_.stop()].position;
    const auto next = std::find_if(stops.begin(), stops.end(), [&](const Stop& stop) { return stop.position > from; });
    if (next == stops.end()) add("From this stop to the end", from, size);
    else add("From this stop of the lesson to the next", from, next->position);
  }
  if (session_.loops()) add("What playing repeats", session_.loop_first, session_.loop_last);
  const std::span<const PolygonMark> marks = session_.trace().polygons();
  const auto later = std::upper_bound(marks.begin(), marks.end(), here,
                                      [](std::int64_t at, const PolygonMark& mark) { return at < mark.position; });
  if (later != marks.begin()) {
    const PolygonMark& at_work = *std::prev(later);
    add(fmt::format("Work on polygon {}", polygon_label(session_.scene(), at_work.polygon)), at_work.position,
        later == marks.end() ? size : later->position - 1);
  }
  add("From here to the end", here, size);
  add("The whole run", 0, size);
  return ranges;
}

void App::film(std::int64_t first, std::int64_t last) {
  try {
    const std::filesystem::path path = system::film_path(fmt::format("zstep-{}-{}", first, last));
    film_ = std::unique_ptr<Film>(
        new Film{path, film_steps(first, last),
                 system::make_film(path, renderer_.width(), renderer_.height(), usual_frames_a_second), 0, false,
                 session_.position(), session_.unit(), session_.stop(), session_.selected_edge, board_});
  } catch (const InputError& error) {
    open(Overlay::none);
    return say(error.what());
  }
  open(Overlay::none);
  session_.playing = false;
  session_.message.clear();
  session_.selected_edge.reset();  // as at each later step
  point_nowhere();
}

/// Draws frames of the film for a part of a second, and puts the file in its place after the last.
void App::film_on() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + std::chrono::milliseconds(100);
  try {
    for (; film_->made < film_->steps.size(); ++film_->made) {
      if (Clock::now() >= until || !film_->maker->takes_more()) return;
      const std::int64_t step = film_->steps[film_->made];
      session_.go_to(step);
      if (session_.position() != step) return end_film(session_.message);
      session_.message.clear();
      film_->draws = true;
      const bool moved = std::exchange(moves, false);
      for (int k = 0; k < frames_to_settle; ++k) draw();
      moves = moved, film_->draws = false;
      film_->maker->frame({renderer_.width(), renderer_.height(), renderer_.rgb()});
    }
    film_->maker->finish();
  } catch (const InputError& error) {
    return end_film(error.what());
  }
  const std::string what = fmt::format("Saved {}: {}.", film_->path.string(), film_length(std::ssize(film_->steps)));
  back_from_film();
  say(what);
}

void App::back_from_film() {
  const std::unique_ptr<Film> film = std::exchange(film_, nullptr);
  session_.go_to(film->position, film->unit);
  if (film->stop != session_.stop() && film->stop >= 0) session_.to_stop(film->stop);
  session_.selected_edge = film->edge;
  board_ = film->board;
}

void App::end_film(std::string why) {
  back_from_film();
  say(std::move(why));
}

/// Nothing but the end: what keys and mouse do otherwise would be in the film.
bool App::handle_filming(const SDL_Event& event) {
  if (event.type == SDL_QUIT) requests.quit = true;
  if (event.type == SDL_DROPFILE) SDL_free(event.drop.file);
  if (event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE)
    end_film("The film was ended; no file was left.");
  return false;
}

void App::film_typed() {
  const std::vector<FilmRange> ranges = film_ranges();
  const std::size_t row = std::max(0, picked);
  if (typed.find_first_not_of(' ') == std::string::npos) {
    if (row < ranges.size()) film(ranges[row].first, ranges[row].last);
    return;
  }
  char *first_end = nullptr, *last_end = nullptr;
  const long long first = std::strtoll(typed.c_str(), &first_end, 10), last = std::strtoll(first_end, &last_end, 10);
  const bool two = first_end != typed.c_str() && last_end != first_end &&
                   std::string(last_end).find_first_not_of(' ') == std::string::npos;
  if (two && first >= 0 && first < last && last <= session_.size()) return film(first, last);
  wrong = two ? fmt::format("The first step comes before the last, and the last is at most {}.", session_.size())
              : "Type the first step and the last: 300 420";
}

bool App::pick_film(SDL_Keycode code) {
  if (code == SDLK_RETURN) return film_typed(), true;
  if (code != SDLK_UP && code != SDLK_DOWN) return false;
  const int last = size32(film_ranges()) - 1;
  picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, std::max(0, last));
  scroll_to_picked = true;
  return true;
}

}  // namespace zstep::viewer
