// Matrices and columns of numbers in square brackets.
#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/viewer/panes/typeset.hpp"

namespace zstep::viewer {
namespace {

const ImFont* face_of(const Ui& ui, bool small) { return small ? ui.fonts.small : ui.fonts.text; }
float row_height(const Ui& ui, bool small) { return std::round(face_of(ui, small)->FontSize * 1.3f); }
float foot(const Ui& ui) { return std::round(ui.em * 0.3f); }  ///< of a bracket, and the room beside it

/// An entry, with what stands behind its "_" below the line; its width. Draws nothing without a place.
float set_entry(const Ui& ui, const std::string& entry, bool small, std::optional<ImVec2> at) {
  const std::size_t bar = std::min(entry.find('_'), entry.size());
  const ImFont* face = face_of(ui, small);
  const std::string letter = entry.substr(0, bar), lower = entry.substr(std::min(bar + 1, entry.size()));
  const float own = text_size(ui, face, letter).x;
  if (at) draw_text(ui, *at, face, ui.colors().text, letter);
  if (lower.empty()) return own;
  if (at)
    draw_text(ui, {at->x + own + 1, at->y + std::round(face->FontSize * 0.22f)}, ui.fonts.small, ui.colors().text,
              lower);
  return own + 1 + text_size(ui, ui.fonts.small, lower).x;
}

std::vector<float> widths_of(const Ui& ui, const Entries& rows, bool small) {
  std::vector<float> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], set_entry(ui, row[k], small, {}));
  }
  return widths;
}

}  // namespace

ImVec2 matrix_size(const Ui& ui, const Entries& rows, bool small) {
  float width = 2 * foot(ui);
  const std::vector<float> widths = widths_of(ui, rows, small);
  for (const float column : widths) width += column;
  width += std::round(ui.em * 0.8f) * static_cast<float>(std::max<std::size_t>(widths.size(), 1) - 1);
  return {width, row_height(ui, small) * static_cast<float>(rows.size())};
}

void set_matrix(Ui& ui, ImVec2 at, const Entries& rows, bool small) {
  const std::vector<float> widths = widths_of(ui, rows, small);
  const ImVec2 size = matrix_size(ui, rows, small);
  const ImU32 color = ui.colors().text;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float thick = std::round(1.2f * ui.thin), arm = foot(ui) - 1;
  for (const bool left : {true, false}) {
    const float outer = left ? at.x : at.x + size.x - thick, inner = left ? at.x : at.x + size.x - arm;
    list->AddRectFilled({outer, at.y}, {outer + thick, at.y + size.y}, color);
    for (const float y : {at.y, at.y + size.y - thick})
      list->AddRectFilled({inner, y}, {inner + arm, y + thick}, color);
  }
  const float top = std::round((row_height(ui, small) - face_of(ui, small)->FontSize) / 2) - 1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    float right = at.x + foot(ui);
    for (std::size_t k = 0; k < rows[r].size(); ++k) {
      right += widths[k];
      const float y = at.y + row_height(ui, small) * static_cast<float>(r) + top;
      set_entry(ui, rows[r][k], small, ImVec2{right - set_entry(ui, rows[r][k], small, {}), y});
      right += std::round(ui.em * 0.8f);
    }
  }
}

}  // namespace zstep::viewer
