// Framebuffer and depth buffer.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/panes/exact_line.hpp"
#include "sim/viewer/panes/legend.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_pane.hpp"
#include "sim/viewer/panes/relief.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/file/records.hpp"

namespace zstep::viewer {
namespace {

/// Numbers in the colours of depths, from the least to the most, polygons in their own; hatched where there is none.
void color_heat(Cells& cells, const HeatMap& heat, const Scene& scene, const DepthScale& scale) {
  cells.colors.resize(heat.values.size());
  cells.counts.clear();
  if (!heat.polygons) cells.counts = heat.values;
  const auto color = [&](double value) {
    if (std::isnan(value)) return hatched_cell;
    if (!heat.polygons) return scale.at(heat.share(value));
    const auto at = static_cast<std::size_t>(value);
    return at < scene.polygons.size() ? opaque(scene.polygons[at].color) : hatched_cell;
  };
  double last = std::nan("");
  Pixel32 its_color = hatched_cell;
  for (std::size_t i = 0; i < cells.colors.size(); ++i) {
    // Neighbours mostly have the same number.
    if (const double value = heat.values[i]; value != last) last = value, its_color = color(value);
    cells.colors[i] = its_color;
  }
}

void color_frame(Cells& cells, const Moment& now) {
  const Picture& picture = now.picture();
  std::vector<Pixel32> colors;
  for (const Polygon& polygon : now.scene().polygons) colors.push_back(opaque(polygon.color));
  const Pixel32 background = opaque(now.scene().background);
  cells.colors.resize(picture.polygon.size());
  for (std::size_t i = 0; i < cells.colors.size(); ++i) {
    if (!picture.ink.empty() && picture.ink[i] != no_ink) {
      cells.colors[i] = opaque(color_of(picture.ink[i]));
      continue;
    }
    const std::int32_t p = picture.polygon[i];
    cells.colors[i] =
        p >= 0 && static_cast<std::size_t>(p) < colors.size() ? colors[static_cast<std::size_t>(p)] : background;
  }
}

std::string heat_text(const Ui& ui, std::size_t at) {
  const double value = ui.heat->values[at];
  if (std::isnan(value)) return "";
  return ui.heat->polygons ? polygon_label(ui.session.scene(), static_cast<std::int32_t>(value))
                           : number(value, 2, true);
}

std::vector<std::string> about_cell(Ui& ui, Cell cell) {
  const Session& s = ui.session;
  const Picture& picture = s.picture();
  const std::size_t at = picture.at(cell.x, cell.y);
  const std::string z = depth_symbol(s.scene(), s.header().conventions);
  std::vector<std::string> lines{fmt::format("pixel ({}, {})", cell.x, cell.y),
                                 fmt::format("frame: {}", polygon_label(s.scene(), picture.polygon[at])),
                                 fmt::format("{} = {}", z, exact(picture.depth[at]))};
  if (z == "z*")
    lines.push_back(
        fmt::format("z_v = {}", exact(view_depth(s.scene().camera, s.header().conventions, picture.depth[at]))));
  if (ui.heat) {
    const std::string value = heat_text(ui, at);
    lines.push_back(fmt::format("{}: {}", ui.heat->name, value.empty() ? "none" : value));
  }
  if (!std::isfinite(picture.depth[at])) return lines;
  const auto question = answers::of_pixel(s.looking_back ? s.before() : s.position(), {cell.x, cell.y});
  if (const std::string line = exact_line(ui.session, question); !line.empty())  // moves the replay
    lines.insert(lines.begin() + 3, line);
  return lines;
}

void draw_frame(Ui& ui) {
  const Session& s = ui.session;
  const Scene& scene = s.scene();
  const float bottom = ImGui::GetCursorScreenPos().y + ImGui::GetContentRegionAvail().y;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Kept<Cells>& cells = ui.heat ? *keep(ui.cells, "heat", color_heat, *ui.heat, scene, ui.depth_scale)
                                     : *keep(ui.cells, "frame", color_frame, ui.moment());
  draw_raster(
      ui, "frame", ui.presenter && !ui.heat ? 0 : legend_height(ui), cells,
      [&](std::size_t at, int) {
        if (ui.heat) return heat_text(ui, at);
        const std::int32_t p = s.picture().polygon[at];
        return p < 0 ? std::string() : polygon_label(scene, p);
      },
      [&](Cell cell) { return about_cell(ui, cell); }, {{}, !ui.heat});
  if (!ui.heat) return;
  ImGui::SetCursorScreenPos(corner);
  draw_heat_legend(ui, bottom);
}

std::string frame_note(Ui& ui) {
  const Session& s = ui.session;
  if (!ui.heat_behind.empty()) return ui.heat_behind;
  if (ui.heat)
    return fmt::format("{}{}; Esc ends", ui.heat->name,
                       ui.heat->until >= 0 ? fmt::format(" up to step {}", grouped(ui.heat->until)) : "");
  if (s.looking_back) return fmt::format("BEFORE: step {}", grouped(s.before()));
  if (s.state().machine.pass == Pass::light) return "as the light sees it";
  return fmt::format("{} \u00d7 {}{}", s.scene().raster.width, s.scene().raster.height,
                     ui.view.zoom >= 100 ? fmt::format(", zoom {:.0f}", ui.view.zoom)
                     : ui.view.zoom > 1  ? fmt::format(", zoom {:.3g}", ui.view.zoom)
                                         : "");
}

/// Decimals that the numbers in the buffer need.
int decimals_in(const Picture& picture) {
  std::vector<double> values;
  for (const double z : picture.depth)
    if (std::isfinite(z)) values.push_back(z);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return decimals_needed(values, 3);
}

/// What the colours of the depth buffer span: one set by hand, that of what is shown, or the scene's. The light's
/// picture, and a trace that does not say where its vertices are, have that of what is shown.
DepthRange range_of(const Ui& ui, const Moment& now) {
  if (ui.range_mode == Ui::RangeMode::by_hand) return ui.hand_range;
  const bool fits =
      ui.range_mode == Ui::RangeMode::fitted || !ui.depth_range.known || now.state().machine.pass == Pass::light;
  return fits ? fitted_range(now.picture(), now.header()) : ui.depth_range;
}

void color_depths(Cells& cells, const Moment& now, const DepthRange& range, const DepthScale& scale) {
  const Picture& picture = now.picture();
  cells.decimals = picture.depth.size() <= 16384 ? decimals_in(picture) : 2;
  cells.colors.resize(picture.depth.size());
  for (std::size_t i = 0; i < cells.colors.size(); ++i)
    cells.colors[i] = std::isfinite(picture.depth[i]) ? scale.at(range.share(picture.depth[i])) : hatched_cell;
}

void draw_depth(Ui& ui) {
  const Session& s = ui.session;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float bottom = corner.y + ImGui::GetContentRegionAvail().y;
  const DepthRange range = range_of(ui, ui.moment());
  const bool spread = ui.histogram && ImGui::GetContentRegionAvail().y > 2.5f * histogram_height(ui);
  const float reserve = legend_height(ui) + (spread ? histogram_height(ui) : 0.0f);
  const auto tip = [&](Cell cell) { return about_cell(ui, cell); };
  RasterTalk talk;
  talk.question = [&](Cell cell) -> std::optional<answers::Question> {
    if (!std::isfinite(s.picture().depth[s.picture().at(cell.x, cell.y)])) return std::nullopt;
    return answers::of_pixel(s.looking_back ? s.before() : s.position(), {cell.x, cell.y});
  };
  if (ui.relief)
    draw_relief(ui, {ImGui::GetContentRegionAvail().x, ImGui::GetContentRegionAvail().y - reserve}, range, tip);
  else
    draw_raster(
        ui, "depth", reserve, *keep(ui.cells, "depth", color_depths, ui.moment(), range, ui.depth_scale),
        [&](std::size_t at, int shown) { return number(s.picture().depth[at], shown); }, tip, talk);
  ImGui::SetCursorScreenPos(corner);
  draw_depth_legend(ui, bottom, range);
  if (spread) draw_histogram(ui, bottom, range, s.picture());
}

std::string depth_note(Ui& ui) {
  const Session& s = ui.session;
  if (s.looking_back) return "BEFORE";
  if (s.state().machine.pass == Pass::light) return "the light's: the shadow buffer";
  const std::string z = depth_symbol(s.scene(), s.header().conventions);
  const std::string name = z == "z*" ? "z* pseudodepth" : z == "z_v" ? "z_v" : "z";
  const char* kept = "";
  if (depth_buffer(s.header()) == DepthBuffer::none) kept = "; the method keeps none";
  if (depth_buffer(s.header()) == DepthBuffer::line) kept = "; the method keeps one line of them";
  return name + kept +
         (ui.range_mode == Ui::RangeMode::fitted    ? ", range fitted"
          : ui.range_mode == Ui::RangeMode::by_hand ? ", range by hand"
                                                    : "");
}

bool keeps_depths(const Header& header) { return depth_buffer(header) == DepthBuffer::picture; }
/// What is painted has a depth in the trace, though the method has no buffer of them.
bool records_depths(const Header& header) { return !keeps_depths(header) && has_step_of<PixelPaint>(header); }

}  // namespace

const Pane frame_pane{"frame", "FRAMEBUFFER", draw_frame, frame_note, nullptr, 0, false, always<20>};
namespace {
// One of them serves, and both have the same place on the stage.
const Pane depth_buffer_pane{"depth", "DEPTH BUFFER", draw_depth, depth_note, keeps_depths, 0, false, always<10>};
const Pane depths_pane{"depth", "DEPTHS OF WHAT IS SHOWN", draw_depth, depth_note, records_depths, 0, false};
}  // namespace

const Pane* depth_pane_of(const Header& header) {
  for (const Pane* pane : {&depth_buffer_pane, &depths_pane})
    if (pane->serves(header)) return pane;
  return nullptr;
}

}  // namespace zstep::viewer
