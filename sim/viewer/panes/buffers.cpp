// Framebuffer and depth buffer.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_pane.hpp"
#include "sim/viewer/words/explain.hpp"
#include "sim/viewer/words/numbers.hpp"

namespace zstep::viewer {
namespace {

std::vector<std::string> about_cell(Ui& ui, Cell cell) {
  const Session& s = ui.session;
  const Picture& picture = s.picture();
  const std::size_t at = picture.at(cell.x, cell.y);
  const std::string z = depth_symbol(s.scene(), s.header().conventions);
  std::vector<std::string> lines{fmt::format("pixel ({}, {})", cell.x, cell.y),
                                 fmt::format("frame: {}", polygon_label(s.scene(), picture.polygon[at])),
                                 fmt::format("{} = {}", z, exact(picture.depth[at]))};
  if (z == "z*") lines.push_back(fmt::format("z_v = {}", exact(view_depth(s.scene().camera, s.header().conventions, picture.depth[at]))));
  return lines;
}

/// An answer's numbers in the colours of depths, from the least to the most; hatched where it has none.
void paint_heat(const Ui& ui, std::vector<Pixel32>& cells) {
  const HeatMap& heat = *ui.heat;
  cells.resize(heat.values.size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = std::isnan(heat.values[i]) ? hatched_cell : ui.depth_scale.at(heat.share(heat.values[i]));
}

void draw_frame(Ui& ui) {
  const Session& s = ui.session;
  const Scene& scene = s.scene();
  draw_raster(
      ui, "frame", std::round(ui.fonts.small->FontSize * 1.3f),
      [&](std::vector<Pixel32>& cells) {
        if (ui.heat) return paint_heat(ui, cells);
        const Picture& picture = s.picture();
        std::vector<Pixel32> colors;
        for (const Polygon& polygon : scene.polygons) colors.push_back(opaque(polygon.color));
        const Pixel32 background = opaque(scene.background);
        cells.resize(picture.polygon.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
          if (!picture.ink.empty() && picture.ink[i] != no_ink) {
            cells[i] = opaque(color_of(picture.ink[i]));
            continue;
          }
          const std::int32_t p = picture.polygon[i];
          cells[i] = p >= 0 && static_cast<std::size_t>(p) < colors.size() ? colors[static_cast<std::size_t>(p)] : background;
        }
      },
      [&](std::size_t at, int) {
        if (ui.heat) return std::isnan(ui.heat->values[at]) ? std::string() : number(ui.heat->values[at], 2, true);
        const std::int32_t p = s.picture().polygon[at];
        return p < 0 ? std::string() : polygon_label(scene, p);
      },
      0, [&](Cell cell) { return about_cell(ui, cell); });
}

std::string frame_note(Ui& ui) {
  const Session& s = ui.session;
  if (ui.heat) return fmt::format("{}: {} (light) to {} (dark); Esc ends", ui.heat->name, number(ui.heat->least), number(ui.heat->most));
  if (s.looking_back) return fmt::format("BEFORE: step {}", grouped(s.before()));
  if (s.state().machine.pass == Pass::light) return "as the light sees it";
  return fmt::format("{} \u00d7 {}{}", s.scene().raster.width, s.scene().raster.height,
                     ui.view.zoom > 1 ? fmt::format(", zoom {:.3g}", ui.view.zoom) : "");
}

/// Decimals that the final numbers of this trace need; from what is in the buffer now.
int decimals_in(const Picture& picture) {
  std::vector<double> values;
  for (const double z : picture.depth)
    if (std::isfinite(z)) values.push_back(z);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return decimals_needed(values, 3);
}

void draw_legend(Ui& ui, float top) {
  const Theme& c = ui.colors();
  const ImFont* font = ui.fonts.small;
  ImGui::SetCursorScreenPos({ImGui::GetCursorScreenPos().x, top});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const DepthRange& range = ui.depth_range;
  if (range.flat()) {
    const std::string all = range.known ? fmt::format("every depth is {}", number(range.near)) : "no depth is known yet";
    if (text_size(ui, font, all).x <= width) draw_text(ui, at, font, c.muted, all);
    return;
  }
  const double ends[] = {range.near, range.far};
  const int decimals = std::min(2, decimals_needed(ends, 2));
  const std::string near = "near " + number(range.near, decimals), far = number(range.far, decimals) + " far", none = "\u221e";
  const float near_width = text_size(ui, font, near).x, far_width = text_size(ui, font, far).x, none_width = text_size(ui, font, none).x;
  const float box = std::round(font->FontSize * 0.9f), gap = std::round(ui.em * 0.35f);
  const float bar_left = at.x + near_width + gap, bar_right = at.x + width - far_width - none_width - box - 3 * gap;
  if (bar_right - bar_left < 12) return;
  draw_text(ui, {at.x, at.y}, font, c.muted, near);
  Canvas& bar = ui.canvases["legend"];
  const int bar_width = static_cast<int>(bar_right - bar_left), bar_height = static_cast<int>(box);
  bar.resize(bar_width, bar_height);
  for (int y = 0; y < bar_height; ++y)
    for (int x = 0; x < bar_width; ++x) bar.row(y)[x] = ui.depth_scale.at((x + 0.5) / bar_width);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddImage(Renderer::image(bar), {bar_left, at.y + 1},
                 {bar_left + static_cast<float>(bar_width), at.y + 1 + box});
  draw_text(ui, {bar_right + gap, at.y}, font, c.muted, far);
  const ImVec2 box_at{bar_right + far_width + 2 * gap, at.y + 1}, box_end{box_at.x + box, box_at.y + box};
  list->AddRectFilled(box_at, box_end, c.empty);
  for (float d = 3; d < box; d += 4) list->AddRectFilled({box_at.x + d, box_at.y}, {box_at.x + d + 1, box_end.y}, c.empty_hatch);
  frame_box(list, box_at, box_end, c.rule);
  draw_text(ui, {box_end.x + 3, at.y}, font, c.muted, none);
}

void draw_depth(Ui& ui) {
  const Session& s = ui.session;
  if (!ui.depth_range.known) {
    // A trace that does not say where its vertices are: the range is what the buffer has shown so far.
    for (const double z : s.picture().depth)
      if (std::isfinite(z)) ui.depth_range = ui.depth_range.known ? DepthRange{std::min(ui.depth_range.near, z), std::max(ui.depth_range.far, z), true}
                                                                  : DepthRange{z, z, true};
  }
  const float legend = std::round(ui.fonts.small->FontSize * 1.3f);
  const float bottom = ImGui::GetCursorScreenPos().y + ImGui::GetContentRegionAvail().y;
  draw_raster(
      ui, "depth", legend,
      [&](std::vector<Pixel32>& cells) {
        const Picture& picture = s.picture();
        ui.depth_decimals = picture.depth.size() <= 16384 ? decimals_in(picture) : 2;
        const DepthRange range = ui.depth_range;
        cells.resize(picture.depth.size());
        for (std::size_t i = 0; i < cells.size(); ++i)
          cells[i] = std::isfinite(picture.depth[i]) ? ui.depth_scale.at(range.share(picture.depth[i])) : hatched_cell;
      },
      [&](std::size_t at, int shown) { return number(s.picture().depth[at], shown); }, ui.depth_decimals,
      [&](Cell cell) { return about_cell(ui, cell); },
      [&](Cell cell) -> std::optional<answers::Question> {
        if (!std::isfinite(s.picture().depth[s.picture().at(cell.x, cell.y)])) return std::nullopt;
        return answers::of_pixel(s.looking_back ? s.before() : s.position(), {cell.x, cell.y});
      });
  draw_legend(ui, bottom - legend + 2);
}

std::string depth_note(Ui& ui) {
  const Session& s = ui.session;
  if (s.looking_back) return "BEFORE";
  if (s.state().machine.pass == Pass::light) return "the light's: the shadow buffer";
  const std::string z = depth_symbol(s.scene(), s.header().conventions);
  return z == "z*" ? "z* pseudodepth" : z == "z_v" ? "z_v" : "z";
}

bool has_depths(const Header& header) {
  const bool lines_only = has_step_of<HorizonTest>(header) || has_step_of<LineBegin>(header);
  return !lines_only || has_step_of<DepthWrite>(header) || has_step_of<PixelPaint>(header);
}

}  // namespace

const Pane frame_pane{"frame", "FRAMEBUFFER", draw_frame, frame_note, nullptr, 0, false};
const Pane depth_pane{"depth", "DEPTH BUFFER", draw_depth, depth_note, has_depths, 0, false};

}  // namespace zstep::viewer
