// The shadow buffer: depths as the light sees them, with the place of the point under test.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/panes/raster_canvas.hpp"
#include "sim/viewer/panes/legend.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

/// The range of the light's depths at this step: near is bright, as in the depth buffer.
void paint_shadow_buffer(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c,
                         const DepthScale& scale) {
  const Picture& light = now.state().light;
  const DepthRange range = fitted_range(light, now.header());
  std::vector<Pixel32> cells(light.depth.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = std::isfinite(light.depth[i]) ? scale.at(range.share(light.depth[i])) : hatched_cell;
  paint_raster(canvas, map, cells, {to_pixel(c.pane), to_pixel(c.grid), to_pixel(c.empty), to_pixel(c.empty_hatch)});
}

/// A ring of two colours round the cell: it shows on every depth.
void mark_point(Ui& ui, const RasterMap& map, ImVec2 origin, const ShadowCompare& at) {
  const double column = std::round(at.x_light), row = std::round(at.y_light);
  if (!(column >= 0 && column < map.width && row >= 0 && row < map.height)) return;
  const float half = static_cast<float>(std::max(map.cell / 2, 4.0));
  const ImVec2 centre{origin.x + static_cast<float>(map.px(column)), origin.y + static_cast<float>(map.py(row))};
  frame_box(ui, {centre.x - half - 2, centre.y - half - 2}, {centre.x + half + 2, centre.y + half + 2},
            IM_COL32(255, 255, 255, 255), 2);
  frame_box(ui, {centre.x - half, centre.y - half}, {centre.x + half, centre.y + half}, ui.colors().now, 2);
}

std::string verdict(const ShadowCompare& at, const State& state) {
  const double column = std::round(at.x_light), row = std::round(at.y_light);
  if (!(column >= 0 && column < state.light.width && row >= 0 && row < state.light.height))
    return "beside the light's window: dark";
  const double stored =
      state.light.depth[state.light.at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row))];
  const auto [z, shadow] = tell_apart(at.z_light, stored);
  return fmt::format("cell ({}, {}): point {}, stored {}: {}", column, row, z, shadow, at.lit ? "lit" : "dark");
}

void draw_shadow_buffer(Ui& ui) {
  const State& state = ui.session.state();
  if (state.machine.pass == Pass::light)
    return say_empty(ui, "The light's picture is being made; it stands where the eye's will.");
  if (state.light.depth.empty()) return say_empty(ui, "Empty: the light has not looked yet.");
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float caption = 2.4f * ui.line();
  const int width = static_cast<int>(room.x), height = static_cast<int>(room.y - caption);
  if (width < 16 || height < 16) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const RasterMap map(Raster{state.light.width, state.light.height, false}, {}, width, height);
  const Kept<Canvas>& canvas = *keep_canvas(ui.canvases, "shadow", width, height, paint_shadow_buffer, map, ui.moment(),
                                            ui.colors(), ui.depth_scale);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), at,
                                       {at.x + static_cast<float>(width), at.y + static_cast<float>(height)});
  ImGui::Dummy({room.x, static_cast<float>(height)});
  if (!state.machine.shadow) return;
  mark_point(ui, map, at, *state.machine.shadow);
  const ImVec2 below = ImGui::GetCursorScreenPos();
  flow(ui, verdict(*state.machine.shadow, state), {ui.colors().text, 0, ui.fonts.small, 0});
  number_at(ui, below, {below.x + room.x, ImGui::GetCursorScreenPos().y},
            answers::made_by<ShadowCompare>(ui.session.position(), "lit"));
}

std::string note_of_shadow_buffer(Ui& ui) { return ui.session.state().machine.shadow ? "what the light sees" : ""; }

bool serves_shadow_buffer(const Header& header) { return has_step_of<ShadowCompare>(header); }

}  // namespace

const Pane shadow_buffer_pane{
    "shadow_buffer", "SHADOW BUFFER", draw_shadow_buffer,     note_of_shadow_buffer, serves_shadow_buffer, 0.5f, false,
    always<15>,      false,           none_yet<ShadowCompare>};

}  // namespace zstep::viewer
