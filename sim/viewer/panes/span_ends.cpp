#include "sim/viewer/panes/span_ends.hpp"

#include <algorithm>
#include <cmath>

namespace zstep::viewer {

TakenPlaces SpanEnds::taken() const {
  TakenPlaces all;
  all.take(line.at, line.size);
  for (const Box& stroke : strokes) all.take(stroke.at, stroke.size);
  return all;
}

std::optional<SpanEnds> span_ends(const Ui& ui, const RasterMap& map, ImVec2 origin) {
  const auto& span = ui.session.state().machine.span;
  constexpr double least_cell = 3;
  if (!span || map.cell < least_cell || !std::isfinite(span->x_left) || !std::isfinite(span->x_right))
    return std::nullopt;
  const SpanOnRaster at = span_on_raster(map, span->x_left, span->x_right, span->y);
  SpanEnds ends{origin.x + static_cast<float>(at.left),
                origin.x + static_cast<float>(at.right),
                origin.y + static_cast<float>(at.top),
                origin.y + static_cast<float>(at.end),
                {},
                {}};
  const float thick = std::round(2 * ui.thin), cell = static_cast<float>(map.cell);
  // Above and below what stands in a pixel, on both sides of the row's borders.
  const float reach = std::clamp((cell - 1.2f * ui.fonts.bold->FontSize) / 2 - thick, thick, cell / 2);
  ends.line = {{std::min(ends.left, ends.right), ends.end - thick}, {std::abs(ends.right - ends.left), thick}};
  std::size_t made = 0;
  for (const float x : {ends.left, ends.right})
    for (const float y : {ends.top, ends.end})
      ends.strokes[made++] = {{std::round(x - thick / 2), y - reach}, {thick, 2 * reach}};
  return ends;
}

void draw_span_ends(const Ui& ui, const SpanEnds& ends) {
  const Theme& c = ui.colors();
  const auto fill = [&](const SpanEnds::Box& box, float around, ImU32 color) {
    ImGui::GetWindowDrawList()->AddRectFilled({box.at.x - around, box.at.y},
                                              {box.at.x + box.size.x + around, box.at.y + box.size.y}, color);
  };
  fill(ends.line, 0, c.now);
  for (const SpanEnds::Box& stroke : ends.strokes) fill(stroke, std::round(ui.thin), c.pane), fill(stroke, 0, c.now);
}

}  // namespace zstep::viewer
