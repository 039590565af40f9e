#include "sim/viewer/panes/span_ends.hpp"

#include <algorithm>
#include <cmath>

namespace zstep::viewer {
namespace {

constexpr const char* below_x[] = {"L", "R"};

/// An x with a letter below it.
ImVec2 name_size(const Ui& ui, const char* below) {
  const float rim = 2 * std::round(ui.thin);
  return {text_size(ui, ui.fonts.bold, "x").x + text_size(ui, ui.fonts.small, below).x + rim,
          std::round(1.35f * ui.fonts.bold->FontSize)};
}

}  // namespace

TakenPlaces SpanEnds::names_taken() const {
  TakenPlaces taken;
  if (names)
    for (const Name& name : *names) taken.take(name.at, name.size);
  return taken;
}

std::optional<SpanEnds> span_ends(const Ui& ui, const RasterMap& map, ImVec2 origin) {
  const auto& span = ui.session.state().machine.span;
  constexpr double least_cell = 3;
  if (!span || map.cell < least_cell || !std::isfinite(span->x_left) || !std::isfinite(span->x_right))
    return std::nullopt;
  const SpanOnRaster at = span_on_raster(map, span->x_left, span->x_right, span->y);
  SpanEnds ends{origin.x + static_cast<float>(at.left), origin.x + static_cast<float>(at.right),
                origin.y + static_cast<float>(at.top),  origin.y + static_cast<float>(at.end),
                static_cast<float>(map.cell),           std::nullopt};
  if (map.cell < static_cast<double>(ui.fonts.bold->FontSize)) return ends;
  // Below the scan line, or above it where there is no room; beside each other where the ends are near.
  const ImVec2 one = name_size(ui, below_x[0]), other = name_size(ui, below_x[1]);
  const float gap = 2 * ui.thin, bottom = origin.y + static_cast<float>(map.box_height);
  const float y = ends.end + gap + one.y < bottom ? ends.end + gap : ends.top - gap - one.y;
  const float near = std::max(0.0f, (one.x + other.x) / 2 + gap - std::abs(ends.right - ends.left)) / 2;
  const auto within = [&](float x, float wide) {
    return std::round(std::clamp(x, origin.x, std::max(origin.x, origin.x + static_cast<float>(map.box_width) - wide)));
  };
  const float x_right = within(std::max(ends.right - other.x / 2 + near, origin.x + one.x + gap), other.x),
              x_left = std::min(within(ends.left - one.x / 2 - near, one.x), std::floor(x_right - gap - one.x));
  ends.names =
      std::array{SpanEnds::Name{{x_left, std::round(y)}, one}, SpanEnds::Name{{x_right, std::round(y)}, other}};
  return ends;
}

void draw_span_ends(const Ui& ui, const SpanEnds& ends) {
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float line = std::round(2 * ui.thin), half = std::max(1.0f, std::round(ui.thin)), rim = std::round(ui.thin);
  list->AddRectFilled({std::min(ends.left, ends.right), ends.end - line}, {std::max(ends.left, ends.right), ends.end},
                      c.now);
  const float out = ends.cell < 8 ? 3 * ui.thin : 0;
  for (const float x : {ends.left, ends.right}) {
    list->AddRectFilled({x - half - rim, ends.top - out}, {x + half + rim, ends.end + out}, c.pane);
    list->AddRectFilled({x - half, ends.top - out}, {x + half, ends.end + out}, c.now);
  }
  if (!ends.names) return;
  for (std::size_t k = 0; k < ends.names->size(); ++k) {
    const SpanEnds::Name& name = (*ends.names)[k];
    list->AddRectFilled(name.at, {name.at.x + name.size.x, name.at.y + name.size.y}, c.pane);
    const ImVec2 x{name.at.x + rim, name.at.y};
    draw_text(ui, x, ui.fonts.bold, c.now, "x");
    draw_text(ui, {x.x + text_size(ui, ui.fonts.bold, "x").x, x.y + std::round(0.45f * ui.fonts.bold->FontSize)},
              ui.fonts.small, c.now, below_x[k]);
  }
}

}  // namespace zstep::viewer
