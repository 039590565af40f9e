#include "sim/viewer/panes/legend.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

constexpr float narrowest_bar = 12;

struct Bar {
  float left = 0, right = 0;
};

/// Where the scale stands between its words; empty where there is no room.
Bar bar_between(const Ui& ui, const std::string& before, const std::string& after, const std::string& hatched) {
  const ImFont* font = ui.fonts.small;
  const float x = ImGui::GetCursorScreenPos().x, width = ImGui::GetContentRegionAvail().x;
  const float box = std::round(font->FontSize * 0.9f), gap = std::round(ui.em * 0.35f);
  return {x + text_size(ui, font, before).x + gap,
          x + width - text_size(ui, font, after).x - text_size(ui, font, hatched).x - box - 3 * gap};
}

void draw_hatched_box(Ui& ui, ImVec2 at, float box, const std::string& meaning) {
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 from{at.x, at.y + 1}, end{at.x + box, at.y + 1 + box};
  list->AddRectFilled(from, end, c.empty);
  for (float d = 3; d < box; d += 4) list->AddRectFilled({from.x + d, from.y}, {from.x + d + 1, end.y}, c.empty_hatch);
  frame_box(ui, from, end, c.rule);
  draw_text(ui, {end.x + 3, at.y}, ui.fonts.small, c.muted, meaning);
}

/// The two ends of a range with as many decimals as tell them apart.
std::pair<std::string, std::string> ends_of(const DepthRange& range, bool by_hand) {
  const double ends[] = {range.near, range.far};
  const int decimals = std::min(4, decimals_needed(ends, std::abs(range.far - range.near) < 0.1 ? 4 : 2));
  // Set by hand, the ends stand for what lies beyond them, too.
  const bool rises = range.near < range.far;
  return {fmt::format("{}{}{}", range.named ? "near " : "",
                      !by_hand ? ""
                      : rises  ? "\u2264 "
                               : "\u2265 ",
                      number(range.near, decimals)),
          fmt::format("{}{}{}",
                      !by_hand ? ""
                      : rises  ? "\u2265 "
                               : "\u2264 ",
                      number(range.far, decimals), range.named ? " far" : "")};
}

void paint_scale(Canvas& canvas, const DepthScale& scale) {
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) canvas.row(y)[x] = scale.at((x + 0.5) / canvas.width());
}

bool by_hand(const Ui& ui) { return ui.range_mode == Ui::RangeMode::by_hand; }
/// What hatched pixels hold.
const char* nothing_there(const DepthRange& range) { return range.far < range.near ? "\u2212\u221e" : "\u221e"; }

}  // namespace

float legend_height(const Ui& ui) { return std::round(ui.fonts.small->FontSize * 1.3f); }
float histogram_height(const Ui& ui) { return std::round(ui.em * 4.5f); }

void draw_scale(Ui& ui, float bottom, const std::string& before, const std::string& after, const std::string& hatched) {
  const Theme& c = ui.colors();
  const ImFont* font = ui.fonts.small;
  const Bar bar = bar_between(ui, before, after, hatched);
  if (bar.right - bar.left < narrowest_bar) return;
  const ImVec2 at{ImGui::GetCursorScreenPos().x, bottom - legend_height(ui) + 2};
  const float box = std::round(font->FontSize * 0.9f), gap = std::round(ui.em * 0.35f);
  draw_text(ui, at, font, c.muted, before);
  const int width = static_cast<int>(bar.right - bar.left), height = static_cast<int>(box);
  const Kept<Canvas>& canvas =
      *keep_canvas(ui.canvases, fmt::format("scale {}", width), width, height, paint_scale, ui.depth_scale);
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), {bar.left, at.y + 1},
                                       {bar.left + to_float(width), at.y + 1 + box});
  draw_text(ui, {bar.right + gap, at.y}, font, c.muted, after);
  draw_hatched_box(ui, {bar.right + text_size(ui, font, after).x + 2 * gap, at.y}, box, hatched);
}

void draw_heat_legend(Ui& ui, float bottom) {
  const HeatMap& heat = *ui.heat;
  const float width = ImGui::GetContentRegionAvail().x;
  if (!heat.polygons && !(heat.least < heat.most)) {
    // One value, or none: there are no colours to tell apart.
    const std::string what = heat.meaning.empty() ? heat.name : heat.meaning;
    const bool none = !heat.meaning.empty() && heat.most == 0;
    const std::string all =
        none ? fmt::format("{}: none yet", what) : fmt::format("{}: {} at each", what, number(heat.most));
    const ImVec2 at{ImGui::GetCursorScreenPos().x, bottom - legend_height(ui) + 2};
    const float box = std::round(ui.fonts.small->FontSize * 0.9f), words = text_size(ui, ui.fonts.small, all).x;
    if (words <= width) draw_text(ui, at, ui.fonts.small, ui.colors().muted, all);
    if (words + box + text_size(ui, ui.fonts.small, "none").x + 2 * ui.em <= width)
      draw_hatched_box(ui, {at.x + words + ui.em, at.y}, box, "none");
    return;
  }
  if (!heat.polygons) {
    std::string before = number(heat.least);
    const std::string longer = (heat.meaning.empty() ? heat.name : heat.meaning) + ": " + before;
    const Bar bar = bar_between(ui, longer, number(heat.most), "none");
    if (bar.right - bar.left > 4 * ui.em) before = longer;
    return draw_scale(ui, bottom, before, number(heat.most), "none");
  }
  const ImVec2 at{ImGui::GetCursorScreenPos().x, bottom - legend_height(ui) + 2};
  const float box = std::round(ui.fonts.small->FontSize * 0.9f), words = text_size(ui, ui.fonts.small, heat.meaning).x;
  if (words + box + text_size(ui, ui.fonts.small, "nobody's").x + 2 * ui.em > width) return;
  draw_text(ui, at, ui.fonts.small, ui.colors().muted, heat.meaning);
  draw_hatched_box(ui, {at.x + words + ui.em, at.y}, box, "nobody's");
}

void draw_depth_legend(Ui& ui, float bottom, const DepthRange& range) {
  if (!range.flat() && (range.known || by_hand(ui))) {
    const auto [near, far] = ends_of(range, by_hand(ui));
    return draw_scale(ui, bottom, near, far, nothing_there(range));
  }
  const std::string all = range.known ? fmt::format("every depth is {} or {}", number(range.near), nothing_there(range))
                                      : "no depth is known yet";
  const ImVec2 at{ImGui::GetCursorScreenPos().x, bottom - legend_height(ui) + 2};
  if (text_size(ui, ui.fonts.small, all).x <= ImGui::GetContentRegionAvail().x)
    draw_text(ui, at, ui.fonts.small, ui.colors().muted, all);
}

Histogram histogram_of(const Picture& picture, const DepthRange& range, std::size_t bins) {
  Histogram made;
  made.bins.assign(bins, 0);
  for (const double z : picture.depth) {
    if (!std::isfinite(z)) continue;
    const double share = range.share(z);
    if (share < 0) ++made.nearer;
    else if (share > 1) ++made.farther;
    else ++made.bins[std::min(bins - 1, static_cast<std::size_t>(share * static_cast<double>(bins)))];
  }
  made.most = *std::max_element(made.bins.begin(), made.bins.end());
  return made;
}

void draw_histogram(Ui& ui, float bottom, const DepthRange& range, const Picture& picture) {
  if (range.flat()) return;
  const Theme& c = ui.colors();
  const ImFont* font = ui.fonts.small;
  const auto [near, far] = ends_of(range, by_hand(ui));
  const Bar bar = bar_between(ui, near, far, nothing_there(range));
  if (bar.right - bar.left < 40) return;
  const float foot = bottom - legend_height(ui), top = foot - histogram_height(ui) + font->FontSize + 4,
              step = std::max(3.0f, std::round(ui.em * 0.3f));
  const auto bins = static_cast<std::size_t>((bar.right - bar.left) / step);
  const Histogram spread = histogram_of(picture, range, bins);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({bar.left, foot - 1}, {bar.right, foot}, c.rule);
  for (std::size_t i = 0; i < bins; ++i) {
    if (spread.bins[i] == 0) continue;
    const float x0 = std::floor(bar.left + (bar.right - bar.left) * to_float(i) / to_float(bins));
    const float x1 = std::floor(bar.left + (bar.right - bar.left) * to_float(i + 1) / to_float(bins));
    const float y =
        std::min(foot - 3, foot - 1 - std::round((foot - top - 1) * to_float(spread.bins[i]) / to_float(spread.most)));
    list->AddRectFilled({x0, y}, {x1, foot - 1}, c.text);
    list->AddRectFilled({x0 + 1, y + 1}, {std::max(x0 + 2, x1 - 1), foot - 1},
                        to_im(ui.depth_scale.at((static_cast<double>(i) + 0.5) / static_cast<double>(bins))));
  }
  std::string said = fmt::format("pixels by depth; the highest bar is {}", grouped(spread.most));
  if (spread.nearer > 0) said += fmt::format("; {} {}", grouped(spread.nearer), range.named ? "nearer" : "smaller");
  if (spread.farther > 0) said += fmt::format("; {} {}", grouped(spread.farther), range.named ? "farther" : "larger");
  if (text_size(ui, font, said).x > ImGui::GetContentRegionAvail().x)
    said = fmt::format("highest: {}", grouped(spread.most));
  draw_text(ui, {ImGui::GetCursorScreenPos().x, top - font->FontSize - 3}, font, c.muted, said);
}

DepthRange fitted_range(const Picture& picture, const Header& header) {
  double smallest = no_depth, largest = -no_depth;
  for (const double z : picture.depth)
    if (std::isfinite(z)) smallest = std::min(smallest, z), largest = std::max(largest, z);
  return smallest <= largest ? range_between(smallest, largest, header) : DepthRange{0, 0};
}

}  // namespace zstep::viewer
