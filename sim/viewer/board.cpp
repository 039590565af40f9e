#include "sim/viewer/board.hpp"
#include "sim/viewer/draw/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace zstep::viewer {

void Board::turn_pen(bool stays) {
  writes_ = !writes_ || stays != stays_;
  stays_ = stays;
  if (!writes_) strokes_.clear();
}

std::string Board::clock(double now) const {
  const auto seconds = static_cast<std::int64_t>(std::max(0.0, now - begun_));
  return seconds < 3600 ? fmt::format("{}:{:02}", seconds / 60, seconds % 60)
                        : fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

bool Board::put_away() {
  const bool any = writes_ || lit_ || points_ || !strokes_.empty();
  writes_ = lit_ = points_ = false;
  strokes_.clear();
  return any;
}

/// A window over the panes takes the mouse, so that a stroke over a table selects nothing there.
void Board::write(Ui& ui, ImVec2 at, ImVec2 size) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::Begin("board", nullptr,
               ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::SetCursorScreenPos(at);
  ImGui::InvisibleButton("paper", size);
  const bool over = ImGui::IsItemActive();
  if (ImGui::IsItemHovered()) ui.mouse_help = "Drag: writes. 8: puts the pen down.";
  ImGui::End();
  if (!over) {
    down_ = false;
    return;
  }
  const ImVec2 whole = ImGui::GetIO().DisplaySize, mouse = ImGui::GetIO().MousePos;
  const ImVec2 place{mouse.x / std::max(1.0f, whole.x), mouse.y / std::max(1.0f, whole.y)};
  constexpr std::size_t most_strokes = 4096, most_places = 65536;
  if (!std::exchange(down_, true) && strokes_.size() < most_strokes) strokes_.emplace_back();
  if (strokes_.empty() || strokes_.back().size() >= most_places) return;
  std::vector<ImVec2>& stroke = strokes_.back();
  if (!stroke.empty() && stroke.back().x == place.x && stroke.back().y == place.y) return;
  stroke.push_back(place);
}

void Board::draw(Ui& ui, ImVec2 at, ImVec2 size) {
  if (step_ != ui.session.position() && !stays_) strokes_.clear();
  step_ = ui.session.position();
  if (writes_) write(ui, at, size);
  ImDrawList* list = ImGui::GetForegroundDrawList();
  const ImVec2 whole = ImGui::GetIO().DisplaySize, mouse = ImGui::GetIO().MousePos;
  const float thick = std::round(ui.em * 0.2f);
  for (const bool rim : {true, false})  // a rim in the pane's colour, so that it is seen on any picture
    for (const std::vector<ImVec2>& stroke : strokes_) {
      std::vector<ImVec2> places;
      for (const ImVec2& place : stroke) places.push_back({place.x * whole.x, place.y * whole.y});
      const ImU32 color = rim ? ui.colors().pane : ui.colors().now;
      const float width = rim ? thick + 2 * ui.thin : thick;
      if (places.size() == 1) fill_circle(list, places[0], width, color);
      else stroke_lines(list, places, color, width);
    }
  if (lit_) darken(ui, mouse);
  if (!points_) return;
  fill_circle(list, mouse, ui.em * 0.6f, ui.colors().pane);
  fill_circle(list, mouse, ui.em * 0.5f, ui.colors().now);
  stroke_circle(list, mouse, ui.em * 0.9f, ui.colors().now, 2 * ui.thin);
}

void Board::darken(const Ui& ui, ImVec2 mouse) const {
  ImDrawList* list = ImGui::GetForegroundDrawList();
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  // All but a circle round the mouse is dark: rows above and below it, and beside it in strips.
  const float radius = ui.em * 7;
  const ImU32 dark = IM_COL32(0, 0, 0, 150);
  const float top = std::clamp(mouse.y - radius, 0.0f, whole.y), bottom = std::clamp(mouse.y + radius, 0.0f, whole.y);
  list->AddRectFilled({0, 0}, {whole.x, top}, dark);
  list->AddRectFilled({0, bottom}, {whole.x, whole.y}, dark);
  for (float y = top; y < bottom; y += 2) {
    const float up = y + 1 - mouse.y, half = std::sqrt(std::max(0.0f, radius * radius - up * up));
    const float end = std::min(y + 2, bottom);
    list->AddRectFilled({0, y}, {std::max(0.0f, mouse.x - half), end}, dark);
    list->AddRectFilled({std::min(whole.x, mouse.x + half), y}, {whole.x, end}, dark);
  }
  stroke_circle(list, mouse, radius, ui.colors().now, 2 * ui.thin);
}

}  // namespace zstep::viewer
