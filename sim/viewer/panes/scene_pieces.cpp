#include "sim/viewer/panes/scene_pieces.hpp"

#include <algorithm>
#include <utility>

#include "sim/viewer/draw/strokes.hpp"
#include "sim/words/explain.hpp"

namespace zstep::viewer {

std::int32_t piece_shown(const Moment& now) {
  if (now.event()) {
    const Event& e = now.event()->event;
    if (const auto* side = get_if<SideTest>(&e)) return side->piece;
    if (const auto* made = get_if<PieceMake>(&e)) return made->piece;
    if (const auto* node = get_if<NodeMake>(&e)) return node->piece;
    if (const auto* add = get_if<NodeAdd>(&e)) return add->piece;
    if (const auto* candidate = get_if<RootCandidate>(&e)) return candidate->piece;
  }
  return now.state().machine.piece;
}

void draw_pieces(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin) {
  const MethodState& m = now.state().machine;
  const auto outline = [&](const Piece& piece, double thickness, ImU32 color) {
    for (std::size_t k = 0; k < piece.outline.size(); ++k) {
      const auto a = on_raster(now.scene(), now.state(), piece.outline[k]);
      const auto b = on_raster(now.scene(), now.state(), piece.outline[(k + 1) % piece.outline.size()]);
      if (a && b)
        canvas.line(map.px(a->x), map.py(a->y), map.px(b->x), map.py(b->y), thickness * thin, to_pixel(color));
    }
  };
  if (m.list.empty()) return;
  for (const Piece& piece : m.pieces)
    if (piece.parent >= 0 && !piece.cut) outline(piece, 1.2, c.text);
  if (!m.pair) return;
  for (const auto& [number, color] : {std::pair{m.pair->other, c.selected}, {m.pair->piece, c.now}})
    if (number >= 0 && static_cast<std::size_t>(number) < m.pieces.size())
      outline(m.pieces[static_cast<std::size_t>(number)], 2.8, color);
}

void label_pair(Ui& ui, const RasterMap& map, ImVec2 origin) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const Theme& c = ui.colors();
  if (!m.pair || m.list.empty()) return;
  for (const auto& [number, letter] : {std::pair{m.pair->other, "Q"}, {m.pair->piece, "P"}}) {
    if (number < 0 || static_cast<std::size_t>(number) >= m.pieces.size()) continue;
    double left = map.box_width, right = 0, top = map.box_height;
    for (const std::int32_t vertex : m.pieces[static_cast<std::size_t>(number)].outline) {
      const auto corner = on_raster(s.scene(), s.state(), vertex);
      if (!corner) continue;
      left = std::min(left, map.px(corner->x));
      right = std::max(right, map.px(corner->x));
      top = std::min(top, map.py(corner->y));
    }
    const ImVec2 size = text_size(ui, ui.fonts.bold, letter);
    const float beside = *letter == 'P' ? static_cast<float>(left) - size.x - 6 : static_cast<float>(right) + 6;
    const ImVec2 at{origin.x + std::clamp(beside, 2.0f, static_cast<float>(map.box_width) - size.x - 2),
                    origin.y + std::max(0.0f, static_cast<float>(top))};
    ImGui::GetWindowDrawList()->AddRectFilled({at.x - 2, at.y}, {at.x + size.x + 2, at.y + size.y}, c.pane);
    draw_text(ui, at, ui.fonts.bold, c.text, letter);
  }
  const auto* overlap = s.event() ? get_if<OverlapTest>(&s.event()->event) : nullptr;
  if (!overlap || !overlap->overlap) return;
  const ImVec2 at{origin.x + static_cast<float>(map.px(overlap->x_at)),
                  origin.y + static_cast<float>(map.py(overlap->y_at))};
  stroke_line(ImGui::GetWindowDrawList(), {at.x - 6, at.y - 6}, {at.x + 6, at.y + 6}, c.text, 3 * ui.thin);
  stroke_line(ImGui::GetWindowDrawList(), {at.x - 6, at.y + 6}, {at.x + 6, at.y - 6}, c.text, 3 * ui.thin);
}

}  // namespace zstep::viewer
