#include "sim/viewer/panes/since_change.hpp"

#include <algorithm>
#include <cmath>

#include "sim/words/numbers.hpp"

namespace zstep::viewer {

std::string was_text(const std::string& was) {
  return was.empty() ? "not there before the change" : "before the change: " + was;
}

ChangedParts changed_parts(Ui& ui, std::vector<TableRow> (*rows_of)(Ui&)) {
  if (!ui.before) return {};
  std::vector<TableRow> rows = rows_of(ui);
  mark_changed(ui, rows, rows_of);
  ChangedParts parts;
  for (const TableRow& row : rows)
    for (const TableCell& cell : row.cells)
      if (cell.was) parts[row.about].push_back(was_text(*cell.was));
  return parts;
}

float draw_change_mark(Ui& ui, ImVec2 corner, float room) {
  const float side = std::clamp(std::round(ui.em * 0.36f), 3.0f, std::max(3.0f, room)), edge = std::max(1.0f, ui.thin);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddTriangleFilled({corner.x - edge, corner.y - side - 2 * edge}, {corner.x - edge, corner.y + edge},
                          {corner.x + side + 2 * edge, corner.y + edge}, ui.colors().pane);
  list->AddTriangleFilled({corner.x, corner.y - side}, corner, {corner.x + side, corner.y}, ui.colors().bad);
  return side;
}

void mark_part(Ui& ui, const ChangedParts& parts, const std::string& about, ImVec2 low, ImVec2 high) {
  const auto found = parts.find(about);
  if (found == parts.end()) return;
  const float reach = 1.5f * draw_change_mark(ui, {low.x, high.y}, high.x - low.x);
  if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect({low.x, high.y - reach}, {low.x + reach, high.y}))
    tooltip(ui, found->second);
}

}  // namespace zstep::viewer
