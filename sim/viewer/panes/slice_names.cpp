// The letters in the plot of the slice: on no other, and rather on no line.

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/slice.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {

namespace {

struct Box {
  ImVec2 a, b;
};

class Labels {
 public:
  Labels(Ui& ui, Box plot) : ui_(ui), plot_(plot) {}
  void keep_free(ImVec2 at, ImVec2 size) { taken_.take(at, size); }
  void avoid(ImVec2 from, ImVec2 to) { lines_.push_back({from, to}); }
  /// Draws the text at the first of these places where it lies in the plot and on no other, rather on no line, too.
  /// False if there is none, or none that is on no line where it `must_be_clear`.
  bool put(const std::string& text, ImU32 color, const std::vector<ImVec2>& places, const ImFont* font,
           bool must_be_clear = false) {
    const ImVec2 size = label_size(ui_, font, text);
    for (const bool clear : {true, must_be_clear})
      for (const ImVec2& at : places) {
        const Box box{{at.x - 2, at.y}, {at.x + size.x + 2, at.y + size.y}};
        if (box.a.x < plot_.a.x || box.b.x > plot_.b.x || box.a.y < plot_.a.y || box.b.y > plot_.b.y) continue;
        const ImVec2 extent{box.b.x - box.a.x, box.b.y - box.a.y};
        if (!taken_.free(box.a, extent)) continue;
        if (clear && std::any_of(lines_.begin(), lines_.end(), [&](const Box& line) { return crosses(line, box); }))
          continue;
        taken_.take(box.a, extent);
        ImGui::GetWindowDrawList()->AddRectFilled(box.a, box.b, ui_.colors().pane);
        draw_label(ui_, at, font, color, text);
        return true;
      }
    return false;
  }

 private:
  /// A line from a to b, left to right, as thick as it is drawn.
  bool crosses(const Box& line, const Box& box) const {
    const float half = 2 * ui_.thin;
    if (line.b.x < box.a.x || line.a.x > box.b.x) return false;
    const float length = std::max(1e-3f, line.b.x - line.a.x);
    const auto y = [&](float x) {
      const float share = std::clamp((x - line.a.x) / length, 0.0f, 1.0f);
      return line.a.y + share * (line.b.y - line.a.y);
    };
    const float one = y(box.a.x), other = y(box.b.x);
    return std::max(one, other) > box.a.y - half && std::min(one, other) < box.b.y + half;
  }
  std::vector<Box> lines_;
  Ui& ui_;
  Box plot_;
  TakenPlaces taken_;
};

/// Each polygon's name at its line; at the span at work first.
void name_spans(Ui& ui, Labels& labels, const SlicePlot& plot, ImVec2 origin, const Slice& slice) {
  const ImFont* font = ui.fonts.bold;
  std::vector<std::int32_t> named;
  const auto name = [&](const SliceSpan& span, bool at_work) {
    if (std::find(named.begin(), named.end(), span.polygon) != named.end() || span.polygon == no_polygon) return;
    const std::string text = polygon_label(ui.session.scene(), span.polygon);
    const ImVec2 size = text_size(ui, font, text);
    std::vector<ImVec2> places;
    for (const double share : {0.5, 0.25, 0.75, 0.1, 0.9, 0.0, 1.0})
      for (const float side : {-1.0f, 1.0f}) {
        const float x = origin.x + plot.x(span.x_left + share * (span.x_right - span.x_left)),
                    y = origin.y + plot.y(span.z_left + share * (span.z_right - span.z_left));
        const float slope = std::abs(plot.y(span.z_right) - plot.y(span.z_left)) /
                            std::max(1.0f, std::abs(plot.x(span.x_right) - plot.x(span.x_left)));
        const float away = std::min(4 * ui.em, 5 * ui.thin + slope * size.x / 2);
        places.push_back({x - size.x / 2, side < 0 ? y - size.y - away : y + away});
      }
    if (labels.put(text, at_work ? ui.colors().now : ui.colors().text, places, font)) named.push_back(span.polygon);
  };
  for (auto span = slice.spans.rbegin(); span != slice.spans.rend(); ++span)
    if (slice.work_from > 0 && span->step == slice.work_from) name(*span, true);
  for (auto span = slice.spans.rbegin(); span != slice.spans.rend(); ++span) name(*span, false);
}

/// Where the span at work begins and ends.
void name_ends(Ui& ui, Labels& labels, const SlicePlot& plot, ImVec2 origin, const Slice& slice) {
  const auto at_work = [&](const SliceSpan& span) { return slice.work_from > 0 && span.step == slice.work_from; };
  const auto span = std::find_if(slice.spans.begin(), slice.spans.end(), at_work);
  if (span == slice.spans.end()) return;
  const ImFont* font = ui.fonts.mono;
  const auto put = [&](const char* name, double x, bool left) {
    const std::string text = fmt::format("{} = {}", name, number(x));
    const ImVec2 size = label_size(ui, font, text);
    const float at = origin.x + plot.x(x), foot = origin.y + plot.bottom - size.y, gap = 3 * ui.thin;
    const float outside = left ? at - gap - size.x : at + gap, inside = left ? at + gap : at - gap - size.x;
    std::vector<ImVec2> places;
    for (const float up : {0.0f, 1.1f, 2.2f, 3.3f, 4.4f})
      for (const float from : {outside, inside}) places.push_back({from, foot - up * size.y});
    labels.put(text, ui.colors().text, places, font, true);
  };
  put(slice.upright ? "y" : "x_L", span->x_left, true);
  put(slice.upright ? "y" : "x_R", span->x_right, false);
}

/// Beside each marker, right of it or left; the upper one's a little higher, the lower one's lower.
void name_markers(Ui& ui, Labels& labels, ImVec2 origin, std::vector<SliceMarker> markers) {
  const ImFont* font = ui.fonts.mono;
  std::stable_sort(markers.begin(), markers.end(),
                   [](const SliceMarker& a, const SliceMarker& b) { return a.y < b.y; });
  const float reach = std::max(7.0f, 0.5f * ui.em);
  for (const SliceMarker& marker : markers)
    labels.keep_free({origin.x + marker.x - reach, origin.y + marker.y - reach}, {2 * reach, 2 * reach});
  for (std::size_t k = 0; k < markers.size(); ++k) {
    const SliceMarker& marker = markers[k];
    const ImVec2 size = text_size(ui, font, marker.text);
    const float x = origin.x + marker.x, y = origin.y + marker.y - size.y / 2;
    std::vector<ImVec2> places;
    for (const float down : {k == 0 ? -0.75f : 0.75f, 0.0f, k == 0 ? -1.5f : 1.5f, k == 0 ? 0.75f : -0.75f})
      for (const bool right : {true, false})
        places.push_back({right ? x + reach + 3 : x - reach - 3 - size.x, y + down * size.y});
    for (const float down : {1.2f, -1.2f, 2.3f, -2.3f}) places.push_back({x - size.x / 2, y + down * size.y});
    labels.put(marker.text, ui.colors().text, places, font);
  }
}

}  // namespace

void write_names(Ui& ui, const SlicePlot& plot, ImVec2 origin, const Slice& slice,
                 const std::vector<SliceMarker>& markers) {
  Labels labels(ui, {origin, {origin.x + to_float(plot.width), origin.y + to_float(plot.height)}});
  for (const SliceSpan& span : slice.spans)
    labels.avoid({origin.x + plot.x(span.x_left), origin.y + plot.y(span.z_left)},
                 {origin.x + plot.x(span.x_right), origin.y + plot.y(span.z_right)});
  for (std::size_t k = 1; k < slice.correct.size(); ++k)
    labels.avoid({origin.x + plot.x(slice.correct[k - 1].x), origin.y + plot.y(slice.correct[k - 1].z)},
                 {origin.x + plot.x(slice.correct[k].x), origin.y + plot.y(slice.correct[k].z)});
  const float band = origin.y + plot.band;  // no name stands at it as if its depth were that
  labels.avoid({origin.x, band}, {origin.x + to_float(plot.width), band});
  name_markers(ui, labels, origin, markers);
  name_spans(ui, labels, plot, origin, slice);
  if (plot.unit == 0 && !plot.view) name_ends(ui, labels, plot, origin, slice);
}

}  // namespace zstep::viewer
