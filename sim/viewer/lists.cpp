#include "sim/viewer/lists.hpp"

#include <algorithm>
#include <cmath>

#include "sim/words/numbers.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

void say_wrong(Ui& ui, const std::string& what) { flow(ui, what, {.color = ui.colors().bad, .font = ui.fonts.bold}); }

ListRow list_row(App& app, std::size_t place, float height) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  ListRow row;
  row.at = ImGui::GetCursorScreenPos();
  const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x);
  const float tall = std::max(height, ui.least_target), above = std::floor((tall - height) / 2);
  row.end = {row.at.x + width, row.at.y + tall};
  can_be_hit(ui, row.at, row.end);
  ImGui::PushID(index32(place));
  row.clicked = ImGui::InvisibleButton("row", {width, tall});
  ImGui::PopID();
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (index32(place) == app.picked) {
    list->AddRectFilled(row.at, row.end, c.now_soft);
    list->AddRectFilled(row.at, {row.at.x + 3, row.end.y}, c.now);
    if (app.scroll_to_picked) ImGui::SetScrollHereY(0.5f);
  } else if (ImGui::IsItemHovered()) {
    list->AddRectFilled(row.at, row.end, c.button_hovered);
  }
  row.visible = ImGui::IsRectVisible(row.at, row.end);
  row.at.y += above, row.end.y = row.at.y + height;
  return row;
}

float step_column(const Ui& ui, std::int64_t last_step) {
  return std::max(ui.em * 6, std::ceil(text_size(ui, ui.fonts.mono, grouped(last_step)).x) + ui.em * 1.5f);
}

void draw_swatch(Ui& ui, ImVec2 at, float height, const Scene& scene, std::int32_t polygon) {
  const float box = std::round(ui.em * 0.6f), top = at.y + std::round((height - box) / 2);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({at.x, top}, {at.x + box, top + box}, to_im(opaque(scene.polygons[polygon].color)));
  frame_box(ui, {at.x, top}, {at.x + box, top + box}, ui.colors().text);
}

std::string depth_in_list(double z) {
  if (!std::isfinite(z)) return number(z);
  std::string text = answers::depth_text(z);
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, "\u2212");
  return text;
}

std::string fitted(const Ui& ui, const ImFont* font, std::string text, float room) {
  if (text_size(ui, font, text).x <= room) return text;
  while (!text.empty() && text_size(ui, font, text + "\u2026").x > room) {
    do text.pop_back();
    while (!text.empty() && continues_character(text.back()));
  }
  return text + "\u2026";
}

}  // namespace zstep::viewer
