#include "sim/viewer/panes/outline_names.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/model/outside.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

using Outline = std::vector<glm::dvec2>;

bool encloses(const Outline& outline, glm::dvec2 p) {
  bool inside = false;
  for (std::size_t k = 0, last = outline.size() - 1; k < outline.size(); last = k++) {
    const glm::dvec2 &a = outline[last], &b = outline[k];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}
bool crosses(const Outline& outline, glm::dvec2 low, glm::dvec2 high) {
  for (std::size_t k = 0, last = outline.size() - 1; k < outline.size(); last = k++) {
    double from = 0, to = 1;  // the part of the side that lies within the box
    const glm::dvec2 a = outline[last], way = outline[k] - a;
    for (int axis = 0; axis < 2; ++axis) {
      if (way[axis] == 0) {
        if (a[axis] < low[axis] || a[axis] > high[axis]) to = -1;
        continue;
      }
      const double one = (low[axis] - a[axis]) / way[axis], other = (high[axis] - a[axis]) / way[axis];
      from = std::max(from, std::min(one, other)), to = std::min(to, std::max(one, other));
    }
    if (from <= to) return true;
  }
  return false;
}

}  // namespace

void name_outlines(const Ui& ui, WordPlaces& words, ImVec2 origin, const std::vector<NamedOutline>& all) {
  constexpr std::size_t most_named = 26;
  if (all.size() > most_named) return;
  for (const auto& [own, name] : all) {
    if (own.empty() || name.empty()) continue;
    const ImVec2 text = text_size(ui, ui.fonts.bold, name);
    const glm::dvec2 half(text.x / 2.0 + 2, text.y / 2.0);
    glm::dvec2 low = own[0], high = own[0];
    for (const glm::dvec2& p : own) low = glm::min(low, p), high = glm::max(high, p);
    struct Place {
      std::ptrdiff_t within;
      ImVec2 middle;
    };
    std::vector<Place> found;
    constexpr int places = 14;  // along each side of the polygon's box
    for (int row = 0; row <= places; ++row)
      for (int column = 0; column <= places; ++column) {
        const glm::dvec2 at = low + half + (high - low - 2.0 * half) * (glm::dvec2(column, row) / double(places));
        const auto of_others = [&](auto&& holds) {
          return std::count_if(all.begin(), all.end(),
                               [&](const NamedOutline& one) { return !one.outline.empty() && holds(one.outline); });
        };
        if (encloses(own, at) && of_others([&](const Outline& one) { return crosses(one, at - half, at + half); }) == 0)
          found.push_back(
              {of_others([&](const Outline& one) { return encloses(one, at); }), moved_by(origin, at.x, at.y)});
      }
    std::stable_sort(found.begin(), found.end(), [](const Place& a, const Place& b) { return a.within < b.within; });
    std::vector<ImVec2> middles;
    for (const Place& place : found) middles.push_back(place.middle);
    words.put(name, ui.colors().text, ui.fonts.bold, middles);
  }
}

namespace {

/// A scan line by its name, with the points where the edges of the scene cross it.
void mark_scan_line(const Ui& ui, WordPlaces& words, const StopLabel& label, ImVec2 origin, const RasterMap& map) {
  const Moment now = ui.moment();
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const double y = label.scan_line, left = map.px(-0.5), right = map.px(map.width - 0.5);
  const auto place = [&](double x) { return moved_by(origin, x, map.py(y)); };
  stroke_line(list, place(left), place(right), c.now, 2 * ui.thin);
  words.keep_line_free(place(left), place(right));
  for (const auto& [from, to] : edges_of(now.scene())) {
    const auto a = on_raster(now.scene(), now.state(), from), b = on_raster(now.scene(), now.state(), to);
    if (!a || !b || (a->y < y) == (b->y < y)) continue;
    fill_circle(list, place(map.px(a->x + (y - a->y) / (b->y - a->y) * (b->x - a->x))), std::round(0.27f * ui.em),
                c.now);
  }
  const ImVec2 size = text_size(ui, ui.fonts.bold, label.name);
  std::vector<ImVec2> middles;
  for (const float side : {-0.8f, 0.8f})
    for (const double x : {right - size.x / 2 - 4, left + size.x / 2 + 4})
      middles.push_back({place(x).x, place(x).y + side * size.y});
  words.put(label.name, c.now, ui.fonts.bold, middles);
}

}  // namespace

void draw_stop_labels(const Ui& ui, WordPlaces& words, const Stop& stop, ImVec2 origin, const RasterMap& map) {
  if (stop.labels.empty()) return;
  const Moment now = ui.moment();
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto place = [&](std::int32_t vertex) -> std::optional<ImVec2> {
    const auto at = on_raster(now.scene(), now.state(), vertex);
    if (!at) return std::nullopt;
    return moved_by(origin, map.px(at->x), map.py(at->y));
  };
  std::vector<NamedOutline> outlines(now.scene().polygons.size());
  for (const auto& [from, to] : edges_of(now.scene()))
    if (const auto a = place(from), b = place(to); a && b) words.keep_line_free(*a, *b);
  for (const Facet& facet : now.scene().facets) {
    NamedOutline& one = outlines[static_cast<std::size_t>(facet.polygon)];
    const std::string name = polygon_label(now.scene(), facet.polygon);
    const auto named = [&](const StopLabel& label) { return label.vertex < 0 && label.name == name; };
    if (std::any_of(stop.labels.begin(), stop.labels.end(), named)) one.name = name;
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      if (const auto at = on_raster(now.scene(), now.state(), now.scene().corners[facet.first_corner + k]))
        one.outline.emplace_back(map.px(at->x), map.py(at->y));
  }
  name_outlines(ui, words, origin, outlines);
  std::vector<StopLabel> labels = stop.labels;  // lines first: no name stands on one
  std::stable_partition(labels.begin(), labels.end(), [](const StopLabel& label) { return label.to >= 0; });
  for (const StopLabel& label : labels) {
    if (label.scan_line >= 0) mark_scan_line(ui, words, label, origin, map);
    if (label.vertex < 0) continue;
    const std::int32_t end = label.to < 0 ? label.vertex : label.to;
    const auto at = place(label.vertex), other = place(end);
    if (!at || !other) continue;
    const ImVec2 from = *at, to = *other;
    if (label.to >= 0) {
      stroke_line(list, from, to, c.now, 3.4f * ui.thin);
      words.keep_line_free(from, to);
      if (!label.name.empty()) words.beside(label.name, c.now, ui.fonts.bold, from, to, {to.y - from.y, from.x - to.x});
      continue;
    }
    fill_circle(list, from, std::round(0.2f * ui.em), c.now);
    for (const auto& [x, y] : {std::pair{1, -1}, {-1, -1}, {1, 1}, {-1, 1}})
      if (words.around(label.name, c.now, ui.fonts.bold, from, {x, y})) break;
  }
}

void draw_extents(const Ui& ui, WordPlaces& words, const RasterMap& map, ImVec2 origin, bool of_y,
                  const std::vector<ExtentBar>& bars) {
  ImDrawList* const list = ImGui::GetWindowDrawList();
  const double right = map.left + map.width * map.cell, bottom = map.top + map.height * map.cell;
  double away = 0.6 * ui.em;  // from the border
  for (const ExtentBar& bar : bars) {
    const auto place = [&](double at, bool across) {
      return of_y ? moved_by(origin, across ? right : map.left + away, map.py(at))
                  : moved_by(origin, map.px(at), across ? map.top : bottom - away);
    };
    const ImVec2 low = place(bar.low, false), high = place(bar.high, false);
    stroke_line(list, low, high, bar.color, 4 * ui.thin);
    words.keep_line_free(low, high);
    const glm::dvec2 way(high.x - low.x, high.y - low.y), tick = of_y ? glm::dvec2(5, 0) : glm::dvec2(0, 5);
    for (const auto& [value, at, out] : {std::tuple{bar.low, low, -way}, {bar.high, high, way}}) {
      stroke_line(list, at, place(value, true), (bar.color & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 110), ui.thin);
      stroke_line(list, moved_by(at, -tick.x, -tick.y), moved_by(at, tick.x, tick.y), bar.color, 2 * ui.thin);
      words.around(number(value), bar.color, ui.fonts.small, at, out);
    }
    words.beside(bar.name, bar.color, ui.fonts.bold, low, high, of_y ? glm::dvec2(1, 0) : glm::dvec2(0, -1));
    away += 1.6 * ui.em;
  }
}

}  // namespace zstep::viewer
