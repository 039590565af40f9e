#include "sim/viewer/panes/slice_plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
namespace {

enum Shape : int { disc = 0, square = 1, diamond = 3 };  // as Canvas::mark has them

}  // namespace

void take(Fingerprint& print, const SlicePicture& picture) {
  const auto all = [&](std::initializer_list<double> values) {
    for (const double value : values) take(print, value);
  };
  const SlicePlot& p = picture.plot;
  all({p.x_first, p.x_last, p.low, p.high, static_cast<double>(p.top), static_cast<double>(p.bottom),
       static_cast<double>(p.band)});
  for (const Slice& slice : picture.runs) {
    all({static_cast<double>(slice.work_from), slice.empty, static_cast<double>(slice.spans.size())});
    for (const SliceSpan& s : slice.spans)
      all({static_cast<double>(s.step), static_cast<double>(s.polygon), s.x_left, s.z_left, s.x_right, s.z_right});
    for (const SliceSample& s : slice.samples) all({static_cast<double>(s.polygon), s.x, s.z});
    for (const double z : slice.stored) take(print, z);
  }
}

namespace {

Pixel32 color_of(const Scene& scene, std::int32_t polygon, const Theme& c) {
  const auto at = static_cast<std::size_t>(polygon);
  return polygon >= 0 && at < scene.polygons.size() ? opaque(scene.polygons[at].color) : to_pixel(c.muted);
}

/// Depths by column as steps, joined where neighbours hold different ones; those of a second run are dashed.
void paint_stored(Canvas& canvas, const SlicePlot& plot, const Slice& slice, bool dashed, Pixel32 color, double line) {
  const float band_height = std::max(3.0f, static_cast<float>(2.5 * line));
  float before = 0;
  for (std::size_t x = 0; x < slice.stored.size(); ++x) {
    const auto column = static_cast<double>(x);
    const int left = static_cast<int>(std::lround(plot.x(column - 0.5))),
              right = static_cast<int>(std::lround(plot.x(column + 0.5)));
    const float y =
        std::clamp(plot.y_stored(slice.stored[x], slice.empty), -100.0f, static_cast<float>(plot.height) + 100);
    const int above = static_cast<int>(std::lround(y - band_height / 2)),
              below = static_cast<int>(std::lround(y + band_height / 2));
    const int end = dashed ? left + std::max(1, (right - left) / 2) : right;
    canvas.rectangle(left, above, std::max(end, left + 1), below, color);
    if (x > 0 && std::abs(y - before) > 1 && !dashed)
      canvas.rectangle(left, static_cast<int>(std::min(y, before)), left + static_cast<int>(std::ceil(line)),
                       static_cast<int>(std::max(y, before)), color);
    before = y;
  }
}

void paint_span(Canvas& canvas, const SlicePlot& plot, const SliceSpan& span, bool dashed, Pixel32 color,
                const Theme& c, double line) {
  const double x0 = plot.x(span.x_left), y0 = plot.y(span.z_left), x1 = plot.x(span.x_right), y1 = plot.y(span.z_right);
  if (!dashed) {
    canvas.line(x0, y0, x1, y1, 4.6 * line, to_pixel(c.text), 230);
    return canvas.line(x0, y0, x1, y1, 2.6 * line, color);
  }
  const double length = portable::length(x1 - x0, y1 - y0), dash = 9 * line, gap = 7 * line;
  if (!(length < 1e5)) return;
  for (double at = 0; at < length; at += dash + gap) {
    const double from = at / length, to = std::min(at + dash, length) / length;
    canvas.line(x0 + from * (x1 - x0), y0 + from * (y1 - y0), x0 + to * (x1 - x0), y0 + to * (y1 - y0), 4.6 * line,
                to_pixel(c.text), 230);
    canvas.line(x0 + from * (x1 - x0), y0 + from * (y1 - y0), x0 + to * (x1 - x0), y0 + to * (y1 - y0), 2.6 * line,
                color);
  }
}

}  // namespace

void paint_slice(Canvas& canvas, const SlicePicture& picture, const Scene& scene, const Theme& c, const float& thin) {
  const SlicePlot& plot = picture.plot;
  const auto line = static_cast<double>(thin);
  canvas.fill(to_pixel(c.pane));
  const int bottom = static_cast<int>(plot.bottom), top = static_cast<int>(plot.top);
  if (plot.column() >= 5)
    for (double x = std::ceil(plot.x_first); x <= plot.x_last; ++x) {
      const int at = static_cast<int>(std::lround(plot.x(x)));
      canvas.rectangle(at, top, at + 1, bottom, to_pixel(c.head));
    }
  for (std::size_t run = picture.runs.size(); run-- > 0;)
    paint_stored(canvas, plot, picture.runs[run], run > 0,
                 mixed(to_pixel(c.pane), to_pixel(c.text), run > 0 ? 150 : 90), line);
  for (std::size_t run = picture.runs.size(); run-- > 0;) {
    const Slice& slice = picture.runs[run];
    const std::int64_t now = slice.work_from;
    for (const bool at_work : {false, true})
      for (const SliceSpan& span : slice.spans)
        if ((now > 0 && span.step == now) == at_work) {
          // Down to the columns, where the span at work begins and ends.
          if (at_work && run == 0)
            for (const auto& [x, z] : {std::pair{span.x_left, span.z_left}, {span.x_right, span.z_right}})
              canvas.line(plot.x(x), std::clamp(plot.y(z), 0.0f, plot.bottom), plot.x(x), plot.bottom, line,
                          to_pixel(c.now));
          paint_span(canvas, plot, span, run > 0, color_of(scene, span.polygon, c), c, line);
        }
    const double radius = std::clamp(plot.column() * 0.16, 0.0, 4.0 * line);
    if (radius < 1.2) continue;
    for (const SliceSample& sample : slice.samples) {
      canvas.mark(plot.x(sample.x), plot.y(sample.z), radius + 1.4 * line, disc, to_pixel(c.text));
      canvas.mark(plot.x(sample.x), plot.y(sample.z), radius, disc,
                  run > 0 ? to_pixel(c.pane) : color_of(scene, sample.polygon, c));
    }
  }
}

namespace {

void draw_marker(Ui& ui, Canvas& canvas, const SliceMarker& marker) {
  const Theme& c = ui.colors();
  // Of equal depths both are seen: the diamond lies on the square.
  const double radius = std::max(5.0, 0.36 * static_cast<double>(ui.em)) * (marker.shape == square ? 1.35 : 0.9);
  canvas.mark(marker.x, marker.y, radius + 1.5, marker.shape, to_pixel(c.pane));
  canvas.mark(marker.x, marker.y, radius, marker.shape, to_pixel(c.now));
  if (marker.wins && !*marker.wins) canvas.mark(marker.x, marker.y, radius - 2.5, marker.shape, to_pixel(c.pane));
}

}  // namespace

std::vector<SliceMarker> markers_of(Ui& ui, const SlicePlot& plot, const Slice& slice, const std::string& run) {
  std::vector<SliceMarker> markers;
  const auto name = [&](std::int32_t polygon, const char* otherwise) {
    return polygon == no_polygon ? std::string(otherwise) : polygon_label(ui.session.scene(), polygon);
  };
  for (const SliceSample& rival : slice.rivals)
    markers.push_back({plot.x(rival.x), plot.y(rival.z), diamond,
                       slice.winner ? std::optional(rival.polygon == *slice.winner) : std::nullopt,
                       fmt::format("{}{} {}", run, name(rival.polygon, ""), number(rival.z))});
  if (const auto& compare = slice.compare) {
    const auto [z, stored] = tell_apart(compare->z, compare->stored);
    if (compare->written) {
      markers.push_back({plot.x(compare->x), plot.y(compare->z), diamond, true,
                         fmt::format("{}{} {}", run, name(compare->polygon, "new"), number(compare->z))});
      return markers;
    }
    markers.push_back({plot.x(compare->x), plot.y(compare->z), diamond, compare->nearer,
                       fmt::format("{}{} {}", run, name(compare->polygon, "new"), z)});
    const auto loses = compare->nearer ? std::optional(!*compare->nearer) : std::optional(false);
    markers.push_back({plot.x(compare->x), plot.y_stored(compare->stored, slice.empty), square, loses,
                       fmt::format("{}stored {}", run, stored)});
  }
  return markers;
}

void paint_markers(Ui& ui, Canvas& canvas, const std::vector<SliceMarker>& markers) {
  const Pixel32 now = to_pixel(ui.colors().now);
  for (std::size_t k = 1; k < markers.size(); ++k)
    canvas.line(markers[0].x, markers[k - 1].y, markers[0].x, markers[k].y, 1.6 * static_cast<double>(ui.thin), now);
  for (const int shape : {square, diamond})
    for (const SliceMarker& marker : markers)
      if (marker.shape == shape) draw_marker(ui, canvas, marker);
}

}  // namespace zstep::viewer
