// Inside a page of others: what leads, the transport, and a way to a window with everything.
#include <algorithm>
#include <cmath>

#include "sim/viewer/app.hpp"
#include "sim/viewer/panes/workspace.hpp"

namespace zstep::viewer {

void App::draw_embedded(ImVec2 at, ImVec2 size) {
  std::vector<Pane> leading = workspace(session_.header(), lead()).leading;
  // A frame in a text is small: beside each other only where each has room.
  if (size.x < ui_.em * 14 * static_cast<float>(leading.size())) leading.resize(1);
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

}  // namespace zstep::viewer
