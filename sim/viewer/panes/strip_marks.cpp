
#include "sim/viewer/panes/strip_marks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sim/words/numbers.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

float place_x(const Ui& ui, const Strip& strip) { return std::floor(strip.x(ui.session.position())); }
float head_of_place(const Ui& ui) { return std::round(ui.em * 0.35f); }

}  // namespace

std::optional<Sign> sign_under(const Ui& ui, const Strip& strip, bool with_stops) {
  std::optional<Sign> found;
  float nearest = arm_of_stop(ui) + 0.5f;
  const auto look = [&](std::int64_t step, int stop, auto&& help) {
    const float away = std::abs(strip.x(step) - ImGui::GetIO().MousePos.x);
    if (!strip.holds(step) || away >= nearest) return;
    nearest = away;
    found = {step, stop, help()};
  };
  if (ui.marks)
    for (std::size_t i = 0; i < ui.marks->causes().size(); ++i) {
      const std::int64_t step = ui.marks->causes()[i];
      look(step, -1, [&] { return fmt::format("Click: to step {}. {}.", grouped(step), ui.marks->name_of(i)); });
    }
  if (ui.places)
    for (const places::Bookmark& mark : ui.places->bookmarks())
      look(mark.step, -1,
           [&] { return fmt::format("Click: to the bookmark {} at step {}.", mark.name, grouped(mark.step)); });
  if (const Lesson* lesson = with_stops ? ui.session.lesson() : nullptr)
    for (int i = 0; i < size32(lesson->stops); ++i) {
      const Stop& stop = lesson->stops[i];
      look(stop.position, i, [&] {
        const char* what = stop.question ? "question" : "stop";
        return fmt::format("Click: to {} {}{} at step {}.", what, i + 1,
                           stop.heading.empty() ? "" : ", " + stop.heading + ",", grouped(stop.position));
      });
    }
  return found;
}

/// Bookmarks: a flag on a staff. What playing repeats: a bar between two arms.
void draw_places(Ui& ui, const Strip& strip) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float flag = std::round(ui.em * 0.38f), top = strip.at.y, foot = top + std::round(ui.em * 0.3f);
  const auto inside = [&](std::int64_t step) { return strip.holds(step); };
  if (s.loops() && s.loop_first < strip.last && s.loop_last > strip.first) {
    const float x0 = std::floor(strip.x(std::max(s.loop_first, strip.first))),
                x1 = std::floor(strip.x(std::min(s.loop_last, strip.last)));
    list->AddRectFilled({x0, top - 3}, {x1 + 1, top}, c.selected);
    for (const auto& [step, x] : {std::pair{s.loop_first, x0}, {s.loop_last, x1}})
      if (inside(step)) list->AddRectFilled({x - 1, top - 3}, {x + 2, foot}, c.selected);
  }
  if (!ui.places) return;
  for (const places::Bookmark& mark : ui.places->bookmarks()) {
    if (!inside(mark.step)) continue;
    const float x = std::floor(strip.x(mark.step));
    list->AddRectFilled({x, top - flag}, {x + 1, foot}, c.text);
    list->AddTriangleFilled({x + 1, top - flag}, {x + 1 + flag * 1.3f, top - flag / 2}, {x + 1, top}, c.text);
  }
}

/// A dotted line along the top for what follows; a triangle on a staff above it for each cause.
void draw_step_marks(Ui& ui, const Strip& strip) {
  if (!ui.marks) return;
  const ImU32 color = ui.colors().bad;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float dot = std::max(2.0f, std::round(2 * ui.thin)), right = strip.at.x + strip.width;
  for (float x = strip.at.x; x < right; x += 2 * dot)
    if (ui.marks->any_follows(strip.position(x), strip.position(std::min(right, x + 2 * dot))))
      list->AddRectFilled({x, strip.at.y + 1}, {x + dot, strip.at.y + 1 + dot}, color);
  const float half = std::round(ui.em * 0.3f), top = strip.at.y - std::round(ui.em * 0.42f);
  for (const std::int64_t step : ui.marks->causes()) {
    if (!strip.holds(step)) continue;
    const float x = std::floor(strip.x(step));
    list->AddRectFilled({x, top}, {x + ui.thin, strip.at.y + strip.height}, color);
    list->AddTriangleFilled({x - half, top}, {x + 0.5f, strip.at.y + 2}, {x + 1 + half, top}, color);
  }
}

void draw_place(Ui& ui, const Strip& strip) {
  const std::int64_t p = ui.session.position();
  if (!strip.holds(p)) return;
  const float x = place_x(ui, strip), head = head_of_place(ui), bottom = strip.at.y + strip.height;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float half = std::round(1.5f * ui.thin);
  list->AddRectFilled({x + 1 - half, strip.at.y}, {x + half, bottom}, ui.colors().now);
  list->AddTriangleFilled({x - head, bottom + 1}, {x + 0.5f, bottom - head - 1}, {x + 1 + head, bottom + 1},
                          ui.colors().now);
}

StripWords::StripWords(const Ui& ui, const Strip& strip) : ui_(ui), strip_(strip), list_(ImGui::GetWindowDrawList()) {
  list_->ChannelsSplit(2);
}
StripWords::~StripWords() { list_->ChannelsMerge(); }

void StripWords::write(float x, float low, float high, ImU32 color, const std::string& text) {
  const float width = text_size(ui_, ui_.fonts.small, text).x;
  if (strip_.holds(ui_.session.position())) {
    const float mark = place_x(ui_, strip_), clear = head_of_place(ui_) + 2;
    if (x < mark + clear && x + width > mark - clear)
      x = mark + clear + width <= high ? mark + clear : mark - clear - width;
  }
  if (x < low || x + width > high) return;
  list_->ChannelsSetCurrent(1);
  draw_text(ui_, {x, strip_.at.y + 1}, ui_.fonts.small, color, text);
  list_->ChannelsSetCurrent(0);
}

void StripWords::write_first(ImU32 color, const std::string& text) {
  write(strip_.at.x + 4, strip_.at.x, strip_.at.x + strip_.width, color, text);
}

void StripWords::write_between(float low, float high, ImU32 color, const std::string& text) {
  write((low + high - text_size(ui_, ui_.fonts.small, text).x) / 2, low + 3, high - 3, color, text);
}

}  // namespace zstep::viewer
