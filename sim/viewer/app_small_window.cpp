// A window too small for all panes at once, as a phone's: one picture and one text, and rows of names to choose others;
// the transport along the lower edge, where the thumb is.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/panes/lesson_chart.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

std::size_t pane_index(const std::vector<Pane>& panes, const std::string& id) {
  const auto found = std::find_if(panes.begin(), panes.end(), [&](const Pane& pane) { return pane.id == id; });
  return found == panes.end() ? 0 : static_cast<std::size_t>(found - panes.begin());
}

}  // namespace

/// Presenter mode has larger letters and fewer words. Upright three columns leave each picture too narrow.
bool App::too_small(ImVec2 panes) const {
  const bool upright = panes.y > 1.2f * panes.x;
  return panes.x < ui_.em * (ui_.presenter ? 40.0f : upright ? 52.0f : 44.0f) || panes.y < ui_.em * 21;
}

/// Of names and buttons: as high as a finger needs, where the window has room for that.
float App::small_row() const {
  const float height = to_float(renderer_.height());
  return std::round(std::max(ui_.em * 1.7f, std::min(ui_.least_target, height * 0.115f)));
}

/// Upright the picture with the words below it, on its side the two beside each other.
void App::draw_small_window(ImVec2 size) {
  const float pad = std::round(ui_.em * 0.4f), gap = std::round(ui_.em * 0.35f), row = small_row();
  const bool upright = size.y > size.x;
  const float foot = upright ? 2 * row + gap : row, width = size.x - 2 * pad, end = size.y - pad - foot - gap;
  if (width < 8) return;
  const float title = upright ? row + gap : gap, room = end - title;
  // Words that wait for an answer need more room, and so does what is asked.
  const bool answers = drawer_ != Drawer::none || session_.question_open();
  if (upright) {
    draw_small_title({pad, std::round(gap / 2)}, {width, row});
    const float stage = std::round((room - gap) * (answers ? 0.46f : 0.54f)), below = title + stage + gap;
    draw_small_stage({pad, title}, {width, row}, {width, stage - row});
    if (drawer_ != Drawer::none) drawer_at_ = {{pad, below}, {width, end - below}};
    else draw_small_words({pad, below}, {width, row}, {width, end - below - row});
  } else {
    const float half = std::round((width - gap) / 2), x = pad + half + gap, right = size.x - pad - x;
    const float menu = text_size(ui_, ui_.fonts.text, "Menu").x + std::round(ui_.em * 1.3f);
    draw_small_stage({pad, title}, {half, row}, {half, room - row});
    ImGui::SetCursorScreenPos({size.x - pad - menu, title});
    draw_menu_button({menu, row});
    if (drawer_ != Drawer::none) drawer_at_ = {{x, title + row}, {right, room - row}};
    else draw_small_words({x, title}, {right - menu - gap, row}, {right, room - row});
  }
  if (drawer_at_.size.x < 1 || drawer_at_.size.y < 1) drawer_at_ = {};
  timeline_at_ = {{pad, size.y - pad - foot}, {width, foot}};
  ImGui::SetCursorScreenPos(timeline_at_.at);
  draw_small_timeline(ui_, timeline_at_.size, row);
}

void App::draw_menu_button(ImVec2 size) {
  if (button_of(ui_, "Menu", size, overlay_ == Overlay::menu))
    open(overlay_ == Overlay::menu ? Overlay::none : Overlay::menu);
  if (ImGui::IsItemHovered()) ui_.mouse_help = "Every command, with its key.";
}

/// Where the reader is, in as many words as there is room for, and the ways out.
void App::draw_small_title(ImVec2 at, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.3f);
  const auto wide = [&](const char* word) {
    return std::max(ui_.least_target, text_size(ui_, ui_.fonts.text, word).x + std::round(ui_.em * 1.3f));
  };
  float right = at.x + size.x - wide("Menu");
  ImGui::SetCursorScreenPos({right, at.y});
  draw_menu_button({wide("Menu"), size.y});
  const float open_at = right - gap - wide("Open");
  if (open_at > at.x + 4 * ui_.em) {
    right = open_at;
    ImGui::SetCursorScreenPos({right, at.y});
    if (button_of(ui_, "Open", {wide("Open"), size.y}, overlay_ == Overlay::start)) open_start();
    if (ImGui::IsItemHovered()) ui_.mouse_help = "Another lesson, method or scene, or a file (Ctrl+O).";
  }
  std::vector<std::string> parts{fmt::format("step {} of {}", grouped(session_.position()), grouped(session_.size()))};
  if (race_shown_) parts = {race().place_text()};
  else if (session_.lesson() && session_.stop() >= 0)
    parts.push_back(fmt::format("stop {} of {}", session_.stop() + 1, session_.lesson()->stops.size()));
  if (const auto& polygon = session_.state().machine.polygon; !race_shown_ && polygon != no_polygon)
    parts.push_back("polygon " + polygon_label(session_.scene(), polygon));
  std::string text;
  for (const std::string& part : parts) {
    const std::string more = text.empty() ? part : text + " \u00b7 " + part;
    if (text_size(ui_, ui_.fonts.text, more).x > right - at.x - gap) break;
    text = more;
  }
  draw_text(ui_, {at.x, at.y + std::round((size.y - ui_.em) / 2) - 1}, ui_.fonts.text, ui_.colors().text, text);
}

/// Names of panes in a row, of which one is shown: as many as there is room for, and then two arrows besides. The one
/// that was chosen.
std::optional<std::size_t> App::draw_names(const std::vector<Pane>& panes, std::size_t shown, ImVec2 at, ImVec2 size) {
  const Theme& c = ui_.colors();
  const ImFont* font = ui_.fonts.small;
  const std::size_t count = panes.size();
  std::optional<std::size_t> chosen;
  if (size.x < 2 * ui_.em) return chosen;
  std::vector<float> widths;
  float all = 0;
  for (const Pane& pane : panes)
    widths.push_back(std::max(ui_.least_target, text_size(ui_, font, pane.title).x + std::round(ui_.em))),
        all += widths.back();
  const float arrow = all > size.x ? std::min(std::max(ui_.least_target, 2 * ui_.em), std::floor(size.x / 4)) : 0,
              room = size.x - 2 * arrow;
  std::size_t first = 0, end = 0;
  for (float used = 0; end < count; used += widths[end++])
    if (end > first && used + widths[end] > room) {
      if (shown < end) break;
      first = end, used = 0;
    }
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, c.head);
  float x = at.x;
  const auto cell = [&](const std::string& word, float width, std::size_t leads_to, bool lit) {
    const ImVec2 from{x, at.y}, to{x + width, at.y + size.y};
    ImGui::SetCursorScreenPos(from);
    ImGui::PushID(word.c_str());
    if (ImGui::InvisibleButton("name", {width, size.y})) chosen = leads_to;
    ImGui::PopID();
    can_be_hit(ui_, from, to);
    const bool hot = ImGui::IsItemHovered();
    if (hot) ui_.mouse_help = "Click: this pane. Tab: the next picture.";
    if (lit) list->AddRectFilled(from, to, c.pane), list->AddRectFilled(from, {to.x, from.y + 3 * ui_.thin}, c.text);
    const std::string text = fitted(ui_, font, word, width);
    draw_text(ui_,
              {x + (width - text_size(ui_, font, text).x) / 2, at.y + std::round((size.y - font->FontSize) / 2) - 1},
              font, lit || hot ? c.text : c.muted, text);
    x = to.x;
  };
  ImGui::PushID(panes[0].id);
  if (arrow > 0) cell("\u25c0", arrow, (shown + count - 1) % count, false);
  for (std::size_t k = first; k < end; ++k) cell(panes[k].title, std::min(widths[k], room), k, k == shown);
  const float names_end = x;
  x = at.x + size.x - arrow;
  if (arrow > 0) cell("\u25b6", arrow, (shown + 1) % count, false);
  ImGui::PopID();
  const std::string note = panes[shown].note ? panes[shown].note(ui_) : "";
  const float wide = text_size(ui_, font, note).x, note_at = at.x + size.x - arrow - wide - std::round(ui_.em * 0.5f);
  if (!note.empty() && note_at > names_end + ui_.em * 0.5f)
    draw_text(ui_, {note_at, at.y + std::round((size.y - font->FontSize) / 2) - 1}, font,
              session_.looking_back ? c.now : c.muted, note);
  frame_box(ui_, at, {at.x + size.x, at.y + size.y}, c.rule);
  return chosen;
}

/// What leads, under its name.
void App::draw_small_stage(ImVec2 at, ImVec2 names, ImVec2 size) {
  // Two pictures have the room of one and of the names, where each is still large enough to be read.
  const ImVec2 both{size.x, size.y + names.y}, half{std::floor(both.x / 2), std::floor(both.y / 2)};
  const bool wide = both.x >= both.y;
  const ImVec2 each{wide ? half.x : both.x, wide ? both.y : half.y};
  if (drawer_ == Drawer::none && !runs_beside().empty() && std::min(each.x, each.y) >= 9 * ui_.em) {
    stage_at_ = {at, both};
    return draw_runs_beside(at, each, {wide ? at.x + half.x : at.x, wide ? at.y : at.y + half.y}, each);
  }
  std::vector<Pane> panes = stage_panes(session_.header());
  if (lead() == chart_pane.id) panes.push_back(chart_pane);
  // What is asked is asked of pixels.
  const std::string leads = !lead().empty()           ? lead()
                            : drawer_ != Drawer::none ? frame_pane.id
                                                      : workspace(session_.header(), "").leading[0].id;
  const std::size_t shown = pane_index(panes, leads);
  if (const auto chosen = draw_names(panes, shown, at, names)) set_lead(panes[*chosen].id);
  at.y += names.y;
  stage_at_ = {at, size};
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, ui_.colors().pane);
  draw_pane_body(ui_, panes[shown], at, size);
  frame_box(ui_, at, {at.x + size.x, at.y + size.y}, ui_.colors().rule);
}

/// The lesson where it speaks, and between its stops what happens; until the next stop what a reader chose.
std::string App::words_shown() const {
  const Lesson* lesson = session_.lesson();
  const int stop = session_.stop();
  if (lesson && session_.question_open()) return lesson_pane.id;
  if (!session_.message.empty()) return happened_pane.id;  // it is said there
  if (chosen_words_ && chosen_words_->stop == stop) return chosen_words_->pane;
  if (!lesson) return happened_pane.id;
  const std::int64_t speaks = stop < 0 ? 0 : lesson->stops[stop].position;
  return session_.position() == speaks ? lesson_pane.id : happened_pane.id;
}

void App::draw_small_words(ImVec2 at, ImVec2 names, ImVec2 size) {
  std::vector<Pane> panes{happened_pane, pseudo_code_pane};
  if (session_.lesson()) panes.insert(panes.begin(), lesson_pane);
  const std::size_t shown = pane_index(panes, words_shown());
  if (const auto chosen = draw_names(panes, shown, at, names)) {
    chosen_words_ = {panes[*chosen].id, session_.stop()};
    session_.message.clear();
  }
  at.y += names.y;
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, ui_.colors().pane);
  draw_pane_body(ui_, panes[shown], at, size);
  frame_box(ui_, at, {at.x + size.x, at.y + size.y}, ui_.colors().rule);
}

}  // namespace zstep::viewer
