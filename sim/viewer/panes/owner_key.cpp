#include "sim/viewer/panes/owner_key.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/words/explain.hpp"
#include "sim/words/owners.hpp"

namespace zstep::viewer {
namespace {

/// Lengths of what is drawn and what is left out, in turn, in thin lines.
struct Dashes {
  std::array<float, 4> lengths;
};
constexpr std::array<Dashes, 4> dashes_by_place{{{{1e6f, 0, 1e6f, 0}}, {{6, 3, 6, 3}}, {{2, 2, 2, 2}}, {{7, 2, 2, 2}}}};

}  // namespace

float underline_height(const Ui& ui) { return std::round(3 * ui.thin); }

void underline_of_polygon(const Ui& ui, std::int32_t polygon, std::ptrdiff_t place, ImVec2 from, float width) {
  const auto at = static_cast<std::size_t>(polygon);
  if (polygon < 0 || at >= ui.session.scene().polygons.size()) return;
  const ImU32 color = to_im(opaque(ui.session.scene().polygons[at].color));
  const auto style = std::min(static_cast<std::size_t>(place), dashes_by_place.size() - 1);
  const float top = std::round(from.y), edge = std::round(ui.thin), right = from.x + width;
  ImDrawList* list = ImGui::GetWindowDrawList();
  float x = std::round(from.x);
  for (std::size_t k = 0; x < right; ++k) {
    const float length = std::round(dashes_by_place[style].lengths[k % 4] * ui.thin), end = std::min(right, x + length);
    if (k % 2 == 0) {
      list->AddRectFilled({x, top}, {end, top + underline_height(ui)}, color);
      // A colour near the background's is seen by its edge.
      list->AddRectFilled({x, top + underline_height(ui) - edge}, {end, top + underline_height(ui)}, ui.colors().text);
    }
    x += length;
  }
}

void key_to_owners(Ui& ui, const std::vector<words::Owned>& owned) {
  const std::vector<std::int32_t> owners = words::owners_in(owned);
  if (owners.empty()) return;
  const ImFont* font = ui.fonts.small;
  const float side = std::round(ui.em * 0.55f), height = std::round(font->FontSize * 1.3f) + underline_height(ui);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float right = origin.x + ImGui::GetContentRegionAvail().x;
  ImVec2 at{origin.x + ui.em, origin.y};
  draw_text(ui, at, font, ui.colors().muted, "numbers of");
  at.x += text_size(ui, font, "numbers of").x + ui.em * 0.5f;
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const std::string label = polygon_label(ui.session.scene(), owners[k]);
    const float width = side + 4 + text_size(ui, font, label).x;
    if (at.x + width > right) at = {origin.x + ui.em, at.y + height};
    const auto polygon = static_cast<std::size_t>(owners[k]);
    const float y = at.y + std::round((font->FontSize - side) / 2);
    if (polygon < ui.session.scene().polygons.size())
      ImGui::GetWindowDrawList()->AddRectFilled({at.x, y}, {at.x + side, y + side},
                                                to_im(opaque(ui.session.scene().polygons[polygon].color)));
    frame_box(ui, {at.x, y}, {at.x + side, y + side}, ui.colors().text);
    draw_text(ui, {at.x + side + 4, at.y}, font, ui.colors().text, label);
    underline_of_polygon(ui, owners[k], static_cast<std::ptrdiff_t>(k), {at.x, at.y + font->FontSize}, width);
    at.x += width + ui.em * 0.75f;
  }
  ImGui::Dummy({1, at.y + height - origin.y});
}

}  // namespace zstep::viewer
