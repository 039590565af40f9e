// The slice: depth z over x along one scan line. Spans are lines, depths found at pixels are dots, what the depth
// buffer holds are steps, and of two depths that are held against each other the one that wins is filled.

#include "sim/viewer/panes/slice.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/charts/sheet.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/oracle/exact_depth.hpp"

namespace zstep::viewer {
namespace {

enum Shape : int { disc = 0, square = 1, diamond = 3 };  // as Canvas::mark has them

}  // namespace

void take(Fingerprint& print, const SlicePicture& picture) {
  const auto all = [&](auto... values) { (take(print, values), ...); };
  const SlicePlot& p = picture.plot;
  all(p.x_first, p.x_last, p.low, p.high, p.top, p.bottom, p.band, p.unit, p.least);
  for (const Slice& slice : picture.runs) {
    all(slice.work_from, slice.empty, slice.spans.size());
    for (const SliceSpan& s : slice.spans) all(s.step, s.polygon, s.x_left, s.z_left, s.x_right, s.z_right);
    for (const SliceSample& s : slice.samples) all(s.polygon, s.x, s.z);
    for (const double z : slice.stored) take(print, z);
  }
}

namespace {

Pixel32 color_of(const Scene& scene, std::int32_t polygon, const Theme& c) {
  const std::size_t at = polygon;
  return polygon >= 0 && at < scene.polygons.size() ? opaque(scene.polygons[at].color) : to_pixel(c.muted);
}

/// Depths by column as steps, joined where neighbours hold different ones; those of a second run are dashed.
void paint_stored(Canvas& canvas, const SlicePlot& plot, const Slice& slice, bool dashed, Pixel32 color, double line) {
  const float band_height = std::max(3.0f, static_cast<float>(2.5 * line));
  float before = 0;
  for (std::size_t x = 0; x < slice.stored.size(); ++x) {
    const auto column = static_cast<double>(x);
    const int left = nearest_int(plot.x(column - 0.5)), right = nearest_int(plot.x(column + 0.5));
    const float y = std::clamp(plot.y_stored(slice.stored[x], slice.empty), -100.0f, to_float(plot.height) + 100);
    const int above = nearest_int(y - band_height / 2), below = nearest_int(y + band_height / 2);
    const int end = dashed ? left + std::max(1, (right - left) / 2) : right;
    canvas.rectangle(left, above, std::max(end, left + 1), below, color);
    if (x > 0 && std::abs(y - before) > 1 && !dashed)
      canvas.rectangle(left, static_cast<int>(std::min(y, before)), left + ceil_int(line),
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

/// Rounded depths as one step a pixel; of two at one level the later lies on the earlier one, and is thinner.
void paint_steps(Canvas& canvas, const SlicePlot& plot, const Slice& slice, const Scene& scene, const Theme& c,
                 double line) {
  for (const SliceSample& sample : slice.samples) {
    const bool at_work = sample.step > slice.work_from && slice.work_from > 0;
    const double half = (at_work ? 1.8 : 3.6) * line, y = plot.y(sample.z);
    if (y < plot.top - half || y > plot.bottom + half) continue;
    const int left = nearest_int(plot.x(sample.x - 0.5)), right = nearest_int(plot.x(sample.x + 0.5));
    canvas.rectangle(left, nearest_int(y - half - line), right, nearest_int(y + half + line), to_pixel(c.text));
    canvas.rectangle(left, nearest_int(y - half), right, nearest_int(y + half), color_of(scene, sample.polygon, c));
  }
}

}  // namespace

void paint_slice(Canvas& canvas, const SlicePicture& picture, const Scene& scene, const Theme& c, const float& thin) {
  const SlicePlot& plot = picture.plot;
  const double line = thin;
  canvas.fill(to_pixel(c.pane));
  const int bottom = static_cast<int>(plot.bottom), top = static_cast<int>(plot.top);
  if (plot.column() >= 5)
    for (double x = std::ceil(plot.x_first); x <= plot.x_last; ++x) {
      const int at = nearest_int(plot.x(x));
      canvas.rectangle(at, top, at + 1, bottom, to_pixel(c.head));
    }
  if (plot.unit > 0)
    for (double z = std::ceil(plot.shown(plot.low)); z <= plot.shown(plot.high); ++z) {
      const int at = nearest_int(plot.y(plot.least + z * plot.unit));
      canvas.rectangle(0, at, plot.width, at + 1, to_pixel(c.rule));
    }
  for (std::size_t run = picture.runs.size(); run-- > 0;)
    paint_stored(canvas, plot, picture.runs[run], run > 0,
                 mixed(to_pixel(c.pane), to_pixel(c.text), run > 0 ? 150 : 90), line);
  for (std::size_t run = picture.runs.size(); run-- > 0;) {
    const Slice& slice = picture.runs[run];
    const std::int64_t now = slice.work_from;
    if (plot.unit > 0) {
      paint_steps(canvas, plot, slice, scene, c, line);
      continue;
    }
    for (const bool at_work : {false, true})
      for (const SliceSpan& span : slice.spans)
        if ((now > 0 && span.step == now) == at_work) {
          // Down to the columns, where the span at work begins and ends.
          if (at_work && run == 0 && !plot.view)
            for (const auto& [x, z] : {std::pair{span.x_left, span.z_left}, {span.x_right, span.z_right}})
              canvas.line(plot.x(x), std::clamp(plot.y(z), 0.0f, plot.bottom), plot.x(x), to_float(plot.height), line,
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
  const double radius = std::max(5.0, 0.36 * ui.em) * (marker.shape == square ? 1.35
                                                       : marker.shape == disc ? 0.6
                                                                              : 0.9);
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
                       fmt::format("{}{} {}", run, name(rival.polygon, ""), number(plot.shown(rival.z)))});
  if (!slice.attribute.empty() && slice.compare) {
    const Slice::Compare& found = *slice.compare;
    markers.push_back(
        {plot.x(found.x), plot.y(found.z), diamond, true, fmt::format("{} = {}", slice.attribute, number(found.z))});
    // What the run did not take.
    double correct = found.z;
    for (const SliceSample& one : slice.correct)
      if (one.x == found.x) correct = one.z;
    const bool is_linear = std::abs(found.z - found.stored) < std::abs(found.z - correct);
    const double other = is_linear ? correct : found.stored;
    if (std::abs(plot.y(other) - plot.y(found.z)) > 4)
      markers.push_back({plot.x(found.x), plot.y(other), square, false,
                         fmt::format("{} {}", is_linear ? "correct" : "linear", number(other))});
    return markers;
  }
  if (const auto& compare = slice.compare) {
    const auto [z, stored] = tell_apart(plot.shown(compare->z), plot.shown(compare->stored));
    if (compare->written) {
      markers.push_back({plot.x(compare->x), plot.y(compare->z), diamond, true,
                         fmt::format("{}{} {}", run, name(compare->polygon, "new"), number(plot.shown(compare->z)))});
      // Painted over without a compare.
      if (!compare->nearer && compare->stored_polygon != no_polygon && std::isfinite(compare->stored))
        markers.push_back(
            {plot.x(compare->x), plot.y_stored(compare->stored, slice.empty), square, false,
             fmt::format("{}{} {}", run, name(compare->stored_polygon, ""), number(plot.shown(compare->stored)))});
      return markers;
    }
    markers.push_back({plot.x(compare->x), plot.y(compare->z), diamond, compare->nearer,
                       fmt::format("{}{} {}", run, name(compare->polygon, "new"), z)});
    if (plot.unit > 0 && !compare->nearer) return markers;
    const auto loses = compare->nearer ? std::optional(!*compare->nearer) : std::optional(false);
    markers.push_back({plot.x(compare->x), plot.y_stored(compare->stored, slice.empty), square, loses,
                       fmt::format("{}stored {}", run, stored)});
  }
  return markers;
}

void paint_markers(Ui& ui, Canvas& canvas, const std::vector<SliceMarker>& markers) {
  const Pixel32 now = to_pixel(ui.colors().now);
  for (std::size_t k = 1; k < markers.size() && markers[k].shape != disc; ++k)
    canvas.line(markers[0].x, markers[k - 1].y, markers[0].x, markers[k].y, 1.6 * ui.thin, now);
  for (const int shape : {disc, square, diamond})
    for (const SliceMarker& marker : markers)
      if (marker.shape == shape) draw_marker(ui, canvas, marker);
}

namespace {

struct Room {
  float margin, line;  ///< left of the plot; a line of letters
};

/// What the depths are called, and which way is far, where the trace says so.
std::string upwards(const Ui& ui, const Slice& slice, const SlicePlot& plot) {
  if (!slice.attribute.empty()) return slice.attribute;
  const Header& header = ui.session.header();
  const std::string z = plot.view ? "z_v" : depth_symbol(ui.session.scene(), header.conventions);
  if (plot.unit > 0) return z + " in units \u2191";
  if (!header.declares(Convention::nearer)) return z;
  return z + (header.comparison.nearer == Comparison::Nearer::greater ? "  \u2191 nearer" : "  \u2191 farther");
}

/// Numbers along both axes, and which way is near.
void draw_axes(Ui& ui, const SlicePlot& plot, ImVec2 origin, const Room& room, const Slice& slice) {
  const Theme& c = ui.colors();
  const ImFont* font = ui.fonts.mono;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Header& header = ui.session.header();
  const float half = font->FontSize / 2, right = origin.x + to_float(plot.width);
  list->AddRectFilled({origin.x - 1, origin.y}, {origin.x, origin.y + to_float(plot.height)}, c.muted);
  list->AddRectFilled({origin.x, origin.y + to_float(plot.height) - 1}, {right, origin.y + to_float(plot.height)},
                      c.muted);
  const auto beside = [&](float y, const std::string& text) {
    list->AddRectFilled({origin.x - 5, origin.y + y}, {origin.x, origin.y + y + 1}, c.muted);
    draw_text(ui, {origin.x - 8 - text_size(ui, font, text).x, origin.y + y - half}, font, c.muted, text);
  };
  const int most = std::max(1, static_cast<int>((plot.bottom - plot.top) / (font->FontSize * 1.7f)));
  const double low = plot.shown(plot.low), high = plot.shown(plot.high);
  const double step = std::max(plot.unit > 0 ? 1.0 : 0.0, nice_step(high - low, most));
  const int decimals = std::clamp(ceil_int(-portable::log10(step) - 1e-9), 0, 8);
  for (double z = std::ceil(low / step) * step; z <= high; z += step) {
    const double shown = std::abs(z) < step * 1e-6 ? 0 : z;
    beside(plot.y(plot.unit > 0 ? plot.least + shown * plot.unit : shown), number(shown, decimals));
  }
  if (slice.attribute.empty()) beside(plot.band, number(slice.empty));
  // Columns.
  const float below = origin.y + to_float(plot.height) + 2;
  const double widest = 8.0 + text_size(ui, font, fmt::format("{:.0f}", plot.x_last)).x;
  const double columns = std::max(1.0, nice_step(widest / plot.column(), 1));
  const std::string title = slice.upright ? "y" : "x";
  const float title_left = right - text_size(ui, font, title).x;
  for (double x = std::ceil(plot.x_first / columns) * columns; x <= plot.x_last; x += columns) {
    const std::string text = fmt::format("{:.0f}", x + 0.0);
    const float left = origin.x + plot.x(x) - text_size(ui, font, text).x / 2;
    if (left < origin.x - 2 || left + text_size(ui, font, text).x > title_left - 4) continue;
    draw_text(ui, {left, below}, font, c.muted, text);
  }
  draw_text(ui, {title_left, below}, font, c.text, title);
  // Which way is which, where the trace says so.
  const bool named = header.declares(Convention::nearer) && slice.attribute.empty();
  const char* down = header.comparison.nearer == Comparison::Nearer::greater ? "farther" : "nearer";
  draw_label(ui, {origin.x - room.margin, origin.y - room.line}, font, c.text, upwards(ui, slice, plot));
  if (named) draw_text(ui, {origin.x - room.margin, below}, font, c.text, std::string("\u2193 ") + down);
}

/// Where z_v is interpolated as if it were linear on the picture: what it is on the plane of the polygon at work, at
/// each column of the span. Nothing where that is the line of the span, as nearly as can be seen.
std::vector<SliceSample> depths_on_plane(const Moment& now, const SlicePlot& plot, const Slice& slice) {
  const auto span = std::find_if(slice.spans.begin(), slice.spans.end(),
                                 [&](const SliceSpan& one) { return one.step == slice.work_from; });
  if (slice.work_from == 0 || span == slice.spans.end() || slice.at.pass != Pass::eye ||
      now.header().conventions.depth != Conventions::Depth::view ||
      now.scene().camera.kind != Camera::Kind::perspective)
    return {};
  std::vector<oracle::Vertex> corners;
  for (const std::int32_t vertex : now.state().machine.outline)
    if (const auto spot = on_raster(now.scene(), now.state(), vertex))
      if (spot->z > 0) corners.push_back({spot->x, spot->y, 1 / spot->z});
  std::optional<oracle::ExactDepth> plane;
  for (std::size_t k = 2; k < corners.size() && !plane; ++k)
    plane = oracle::ExactDepth::on_plane(corners[0], corners[1], corners[k], slice.at.y, oracle::Along::reciprocal);
  std::vector<SliceSample> depths;
  float apart = 0;
  for (double x = std::ceil(span->x_left); plane && x <= span->x_right; ++x) {
    depths.push_back({span->step, span->polygon, x, plane->at(static_cast<std::int32_t>(x))});
    const double share = (x - span->x_left) / std::max(1e-12, span->x_right - span->x_left);
    const double line = span->z_left + share * (span->z_right - span->z_left);
    apart = std::max(apart, std::abs(plot.y(line) - plot.y(depths.back().z)));
  }
  return apart > 2 ? depths : std::vector<SliceSample>();
}

/// In fixed point: the depths of this scan line's spans without rounding, as far as the run has and will have them.
std::vector<SliceSample> unrounded_depths(Ui& ui, const Moment& now, const Slice& slice) {
  std::vector<SliceSample> depths;
  const double unit = depth_unit(now.scene(), now.header().conventions);
  if (unit == 0 || slice.at.pass != Pass::eye) return depths;
  for (const oracle::DepthError& depth : ui.errors.of(now.trace()))
    if (depth.y == slice.at.y)
      for (const SliceSpan& span : slice.spans)
        if (span.step == depth.span)
          depths.push_back({depth.span, span.polygon, static_cast<double>(depth.x), depth.z - depth.error * unit});
  return depths;
}

/// The straight line between the ends of the span at work, at its columns.
std::vector<SliceSample> straight_depths(const Slice& slice) {
  std::vector<SliceSample> depths;
  const auto at_work = [&](const SliceSpan& span) { return slice.work_from > 0 && span.step == slice.work_from; };
  const auto first = std::find_if(slice.spans.begin(), slice.spans.end(), at_work);
  const auto last = std::find_if(slice.spans.rbegin(), slice.spans.rend(), at_work);
  if (first == slice.spans.end() || !(first->x_left < last->x_right)) return depths;
  const double slope = (last->z_right - first->z_left) / (last->x_right - first->x_left);
  for (double x = std::ceil(first->x_left); x <= last->x_right; ++x)
    depths.push_back({first->step, first->polygon, x, first->z_left + (x - first->x_left) * slope});
  return depths;
}

/// The true depths as a dotted curve.
void paint_true(Canvas& canvas, const SlicePlot& plot, const std::vector<SliceSample>& depths, const Theme& c,
                double line) {
  for (std::size_t k = 1; k < depths.size(); ++k)
    for (const double from : {0.0, 0.5}) {
      if (depths[k].step != depths[k - 1].step) continue;
      if (std::max(plot.y(depths[k].z), plot.y(depths[k - 1].z)) > plot.bottom + 50) continue;
      if (std::min(plot.y(depths[k].z), plot.y(depths[k - 1].z)) < -50) continue;
      const auto at = [&](double share) {
        const double z = depths[k - 1].z + share * (depths[k].z - depths[k - 1].z);
        return std::pair{plot.x(depths[k - 1].x + share), plot.y(z)};
      };
      const auto [x0, y0] = at(from);
      const auto [x1, y1] = at(from + 0.3);
      if (plot.unit > 0) canvas.line(x0, y0, x1 + (x1 - x0), y1 + (y1 - y0), 1.4 * line, to_pixel(c.text));
      else canvas.line(x0, y0, x1, y1, 3 * line, to_pixel(c.text));
    }
}

/// What line, dot and steps mean.
void draw_key(Ui& ui, ImVec2 at, float width, bool two, bool with_true, bool of_attribute, bool units, bool view) {
  const Theme& c = ui.colors();
  const ImFont* font = ui.fonts.mono;
  ImDrawList* list = ImGui::GetWindowDrawList();
  struct Entry {
    int sign;
    std::string text;
  };
  const DepthBuffer buffer = depth_buffer(ui.session.header());
  const char* stored = buffer == DepthBuffer::picture ? "depth buffer"
                       : buffer == DepthBuffer::line  ? "line buffer"
                                                      : "depth of what is shown";
  std::vector<Entry> entries{{0, "span"}, {1, "depth at a pixel"}, {2, stored}};
  if (two) entries = {{0, "run A"}, {3, "run B"}, {2, stored}};
  if (with_true) entries[1] = {4, "true depth"};
  if (view) entries[1] = {4, "if z_v were linear"};
  if (units) entries = {{5, "without rounding"}, {0, "rounded"}, {2, stored}};
  if (of_attribute) entries = {{0, "linear on the picture"}, {4, "perspective-correct"}};
  const float sign = 1.6f * ui.em, gap = ui.em, middle = at.y + font->FontSize * 0.55f;
  const auto wide = [&](const Entry& entry) { return sign + text_size(ui, font, entry.text).x + gap + 4; };
  float needed = -gap;
  for (const Entry& entry : entries) needed += wide(entry);
  for (; !entries.empty() && needed > width; entries.pop_back()) needed -= wide(entries.back());  // the rest has room
  float x = at.x + width - needed;
  const float line = 3 * ui.thin;
  for (const Entry& entry : entries) {
    const float end = x + sign - 4;
    if (entry.sign == 5) list->AddRectFilled({x, middle}, {end, middle + ui.thin}, c.text);
    if (entry.sign == 0) list->AddRectFilled({x, middle - line / 2}, {end, middle + line / 2}, c.text);
    if (entry.sign == 3)
      for (const float from : {x, x + (end - x) * 0.6f})
        list->AddRectFilled({from, middle - line / 2}, {from + (end - x) * 0.35f, middle + line / 2}, c.text);
    if (entry.sign == 4)
      for (float from = x; from + line < end; from += 2 * line)
        list->AddRectFilled({from, middle - line / 2}, {from + line, middle + line / 2}, c.text);
    if (entry.sign == 1) {
      const float r = 4 * ui.thin;
      list->AddRectFilled({end - 2 * r, middle - r}, {end, middle + r}, c.text);
    }
    if (entry.sign == 2) {
      const float half = (end - x) / 2;
      list->AddRectFilled({x, middle + 1}, {x + half, middle + 1 + line}, c.muted);
      list->AddRectFilled({x + half, middle - 4}, {end, middle - 4 + line}, c.muted);
      list->AddRectFilled({x + half, middle - 4}, {x + half + 1, middle + 1 + line}, c.muted);
    }
    draw_text(ui, {x + sign, at.y}, font, c.muted, entry.text);
    x += wide(entry);
  }
}

/// What is under the mouse: the polygons at that column.
void point(Ui& ui, const SlicePlot& plot, ImVec2 origin, const Slice& slice) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float inside_x = mouse.x - origin.x, inside_y = mouse.y - origin.y;
  if (!ImGui::IsWindowHovered() || inside_x < 0 || inside_y < 0 || inside_x >= to_float(plot.width) ||
      inside_y >= to_float(plot.height))
    return;
  const double x = std::round(plot.x_first + static_cast<double>(inside_x) / plot.column());
  if (x < 0 || x >= static_cast<double>(slice.stored.size())) return;
  const auto column = static_cast<std::int32_t>(x);
  ui.pointed_next = Cell{column, slice.at.y};
  const std::string z = depth_symbol(ui.session.scene(), ui.session.header().conventions);
  std::vector<std::string> lines{fmt::format("pixel ({}, {})", column, slice.at.y)};
  constexpr std::size_t most = 12;
  for (const SliceSample& sample : slice.samples)
    if (std::round(sample.x) == x && lines.size() < most)
      lines.push_back(
          fmt::format("{}: {} = {}", polygon_label(ui.session.scene(), sample.polygon), z, exact(sample.z)));
  lines.push_back(fmt::format("stored: {}", exact(slice.stored[column])));
  ui.mouse_help = "The depths at this column. Click a pixel of the frame to keep its scan line here.";
  tooltip(ui, lines);
}

bool same_compare(const Slice& a, const Slice& b) {
  if (a.compare.has_value() != b.compare.has_value() || a.rivals.size() != b.rivals.size()) return false;
  for (std::size_t i = 0; i < a.rivals.size(); ++i)
    if (a.rivals[i].z != b.rivals[i].z || a.rivals[i].polygon != b.rivals[i].polygon) return false;
  if (!a.compare) return a.winner == b.winner;
  return a.compare->x == b.compare->x && a.compare->z == b.compare->z && a.compare->stored == b.compare->stored &&
         a.compare->nearer == b.compare->nearer;
}

std::optional<SliceAt> line_of(const Ui& ui, const Moment& now) {
  return slice_line(now, ui.pointed ? ui.pointed : ui.session.selected);
}

/// The part of a span that is seen; nothing where none is.
std::optional<SliceSpan> seen_of(SliceSpan span, const SlicePlot& plot) {
  const double slope = span.x_left < span.x_right ? (span.z_right - span.z_left) / (span.x_right - span.x_left) : 0;
  double from = std::max(span.x_left, plot.x_first), to = std::min(span.x_right, plot.x_last);
  if (slope != 0) {
    const auto [one, other] =
        std::minmax({span.x_left + (plot.low - span.z_left) / slope, span.x_left + (plot.high - span.z_left) / slope});
    from = std::max(from, one), to = std::min(to, other);
  } else if (span.z_left < plot.low || span.z_left > plot.high) {
    return std::nullopt;
  }
  if (from > to) return std::nullopt;
  span.z_right = span.z_left + (to - span.x_left) * slope, span.z_left += (from - span.x_left) * slope;
  span.x_left = from, span.x_right = to;
  return span;
}

/// The columns that are seen: those that the line reaches, or what the frame is zoomed to.
void see_columns(const Ui& ui, SlicePlot& plot) {
  if (ui.view.zoom <= 1) return;
  const double width = ui.session.scene().raster.width, half = width / ui.view.zoom / 2,
               middle = width / 2 + ui.view.center_x - 0.5;
  plot.x_first = std::max(-0.5, middle - half), plot.x_last = std::min(width - 0.5, middle + half);
  if (plot.x_last - plot.x_first < 1) plot.x_last = plot.x_first + 1;
}

}  // namespace

Slice in_view_depth(Slice slice, const Camera& camera, const Conventions& conventions, bool ends_only) {
  const auto seen = [&](double z) { return std::isfinite(z) ? view_depth(camera, conventions, z) : z; };
  std::vector<SliceSpan> pieces;
  for (const SliceSpan& span : slice.spans) {
    const double left = seen(span.z_left), right = seen(span.z_right);
    if (ends_only && span.step == slice.work_from) {
      pieces.push_back({span.step, span.polygon, span.x_left, left, span.x_left, left});
      pieces.push_back({span.step, span.polygon, span.x_right, right, span.x_right, right});
      continue;
    }
    constexpr int most = 24;
    SliceSpan piece{span.step, span.polygon, span.x_left, left, span.x_left, left};
    for (int k = 1; k <= most; ++k) {
      const double share = static_cast<double>(k) / most;
      piece.x_right = span.x_left + share * (span.x_right - span.x_left);
      piece.z_right = seen(span.z_left + share * (span.z_right - span.z_left));
      pieces.push_back(piece);
      piece.x_left = piece.x_right, piece.z_left = piece.z_right;
    }
  }
  slice.spans = std::move(pieces);
  if (ends_only && slice.work_from > 0) {
    std::erase_if(slice.samples, [&](const SliceSample& sample) { return sample.step > slice.work_from; });
    slice.compare.reset();
  }
  for (SliceSample& sample : slice.samples) sample.z = seen(sample.z);
  for (double& z : slice.stored) z = z == slice.empty ? z : seen(z);
  if (slice.compare) {
    slice.compare->z = seen(slice.compare->z);
    if (slice.compare->stored != slice.empty) slice.compare->stored = seen(slice.compare->stored);
  }
  std::tie(slice.low, slice.high) = std::minmax({seen(slice.low), seen(slice.high)});
  return slice;
}

void see_units(SlicePlot& plot, Slice& slice, const Scene& scene, const Conventions& conventions,
               const std::vector<SliceSample>& exact) {
  if (!slice.compare) return;
  const Slice::Compare& now = *slice.compare;
  const double unit = depth_unit(scene, conventions);
  double low = now.z, high = now.z, slope = 0;
  constexpr double most_units = 64, most_columns = 12, least_columns = 5;
  const auto take = [&](double x, double z) {
    if (x == now.x && std::abs(z - now.z) < most_units * unit) low = std::min(low, z), high = std::max(high, z);
  };
  if (now.nearer)  // else no other depth matters yet
    for (const SliceSample& sample : slice.samples) take(sample.x, sample.z);
  for (std::size_t k = 0; k < exact.size(); ++k) {
    if (now.nearer || exact[k].step == slice.work_from) take(exact[k].x, exact[k].z);
    if (k > 0 && exact[k].step == slice.work_from && exact[k - 1].step == slice.work_from)
      slope = std::abs(exact[k].z - exact[k - 1].z) / unit;
  }
  plot.unit = unit, plot.least = formulas::least_depth(scene, conventions.depth);
  const double middle = (plot.shown(low) + plot.shown(high)) / 2;
  const double half = std::max((plot.shown(high) - plot.shown(low)) / 2 + (slope > 0.1 ? 4 : 2), least_columns * slope);
  plot.low = plot.least + std::max(-1.0, std::floor(middle - half)) * unit;
  plot.high = plot.least + std::ceil(middle + half) * unit;
  const double columns = std::clamp(half / std::max(slope, 0.2), least_columns, most_columns);
  plot.x_first = std::max(plot.x_first, now.x - columns - 0.5);
  plot.x_last = std::min(plot.x_last, now.x + columns + 0.5);
  std::vector<SliceSpan> seen;
  for (const SliceSpan& span : slice.spans)
    if (const auto part = seen_of(span, plot)) seen.push_back(*part);
  slice.spans = std::move(seen);
}

namespace {

void draw_slice_of(Ui& ui, bool view) {
  const Moment now = ui.moment();
  const auto at = line_of(ui, now);
  if (!at) return say_empty(ui, "Empty: no scan line is at work. Point at a pixel of the frame to see its depths.");
  SlicePicture lines;
  const std::optional<Slice> attribute = view ? std::nullopt : attribute_slice(now);
  lines.runs.push_back(attribute ? *attribute : slice_of(now, ui.slices, *at));
  if (view)
    lines.runs[0] =
        in_view_depth(lines.runs[0], now.scene().camera, now.header().conventions, ui.session.question_open());
  const Slice slice = lines.runs[0];
  if (ui.other && !view && !attribute) lines.runs.push_back(slice_of(ui.other->moment(), ui.other->slices, *at));
  SlicePlot& plot = lines.plot;
  plot.view = view;
  plot.x_first = slice.x_first, plot.x_last = slice.x_last, plot.low = slice.low, plot.high = slice.high;
  for (const Slice& run : lines.runs) {
    plot.x_first = std::min(plot.x_first, run.x_first), plot.x_last = std::max(plot.x_last, run.x_last);
    plot.low = std::min(plot.low, run.low), plot.high = std::max(plot.high, run.high);
  }
  see_columns(ui, plot);
  const bool two = lines.runs.size() > 1;
  std::vector<SliceSample> truth;
  if (!two && !view && !attribute) truth = unrounded_depths(ui, now, slice);
  if (!truth.empty()) see_units(plot, lines.runs[0], now.scene(), now.header().conventions, truth);

  const ImFont* font = ui.fonts.mono;
  const ImVec2 corner = ImGui::GetCursorScreenPos(), avail = ImGui::GetContentRegionAvail();
  const float line = std::round(font->FontSize * 1.25f);
  float numbers = attribute ? 0 : text_size(ui, font, "\u2193 farther").x;
  for (const double z : {plot.low, plot.high})
    numbers = std::max(numbers, text_size(ui, font, number(plot.shown(z), plot.unit > 0 ? 0 : 4)).x + 10);
  const Room room{numbers + 4, line};
  const ImVec2 origin{corner.x + room.margin, corner.y + line};
  plot.width = static_cast<int>(avail.x - room.margin);
  const bool keyed = avail.y > 8 * line;  // else the plot has the room
  plot.height = static_cast<int>(avail.y - (keyed ? 3 : 2) * line);
  if (plot.width < 60 || plot.height < 40)
    return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  // Of the height the empty band has a line, and letters above the highest line and below the lowest have room.
  const float inner = std::min(0.9f * line, to_float(plot.height) * 0.1f);
  const bool empty_above = ui.session.header().comparison.farthest() > 0;
  plot.top = inner + (empty_above ? line : 0), plot.bottom = to_float(plot.height) - inner;
  plot.band = line * 0.6f;
  if (!empty_above) {
    plot.band = to_float(plot.height) - line * 0.6f;
    plot.bottom -= line;
  }

  // Of the second run what is not the same.
  const bool parts = two && !same_compare(lines.runs[0], lines.runs[1]);
  std::vector<SliceMarker> markers = markers_of(ui, plot, slice, parts ? "A: " : "");
  if (parts)
    for (SliceMarker& marker : markers_of(ui, plot, lines.runs[1], "B: ")) markers.push_back(std::move(marker));
  const Kept<Canvas>& base = *keep_canvas(ui.canvases, view ? "slice in z_v lines" : "slice lines", plot.width,
                                          plot.height, paint_slice, lines, ui.session.scene(), ui.colors(), ui.thin);
  Canvas& canvas = ui.canvases[view ? "slice in z_v" : "slice"].made;
  canvas = base.made;
  if (attribute) truth = slice.correct;
  else if (!two && plot.unit == 0) truth = view ? straight_depths(slice) : depths_on_plane(now, plot, slice);
  paint_true(canvas, plot, truth, ui.colors(), ui.thin);
  for (const SliceSample& depth : truth)
    if (slice.compare && !attribute && slice.compare->x == depth.x && depth.z >= plot.low && depth.z <= plot.high &&
        std::none_of(slice.samples.begin(), slice.samples.end(), [&](const SliceSample& found) {
          return found.x == depth.x && found.polygon == depth.polygon && std::abs(found.z - depth.z) < 1e-6 * plot.unit;
        }))
      markers.push_back({plot.x(depth.x),
                         plot.y(depth.z),
                         disc,
                         {},
                         plot.unit > 0 ? fmt::format("{} exactly {}", polygon_label(now.scene(), depth.polygon),
                                                     number(plot.shown(depth.z), 2))
                                       : fmt::format("{} {}", view ? "linear" : "true", number(depth.z))});
  paint_markers(ui, canvas, markers);
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas), origin,
                                       {origin.x + to_float(plot.width), origin.y + to_float(plot.height)});

  write_names(ui, plot, origin, lines.runs[0], markers);
  draw_axes(ui, plot, origin, room, slice);
  const float below = origin.y + to_float(plot.height) + line;
  std::string sentence = slice_sentence(now, slice);
  float key_from = corner.x;  // beside what stands there
  if (parts) {
    const std::string other = slice_sentence(ui.other->moment(), lines.runs[1]);
    if (!sentence.empty()) sentence = "Run A: " + sentence;
    const std::string text = "Run B: " + other;
    const float wide = text_size(ui, ui.fonts.bold, text).x;
    if (!other.empty() && keyed && wide < avail.x) {
      draw_text(ui, {corner.x, below - 1}, ui.fonts.bold, ui.colors().text, text);
      key_from += wide + ui.em;
    }
  }
  const float sentence_at = corner.x + label_size(ui, font, upwards(ui, slice, plot)).x + 1.5f * ui.em;
  if (sentence_at + text_size(ui, ui.fonts.bold, sentence).x < corner.x + avail.x)
    draw_text(ui, {sentence_at, corner.y - 1}, ui.fonts.bold, ui.colors().text, sentence);
  if (keyed)
    draw_key(ui, {key_from, below}, corner.x + avail.x - key_from, two, !truth.empty(), attribute.has_value(),
             plot.unit > 0, plot.view);
  point(ui, plot, origin, slice);
}

void draw_slice(Ui& ui) { draw_slice_of(ui, false); }
void draw_slice_in_view(Ui& ui) { draw_slice_of(ui, true); }

std::string note_of_slice(Ui& ui) {
  const auto at = line_of(ui, ui.moment());
  if (!at) return "";
  if (const auto attribute = attribute_slice(ui.moment()))
    return fmt::format("{} = {}", attribute->upright ? "column x" : "scan line y", attribute->at.y);
  const char* of_light = at->pass == Pass::light ? ", what the light sees" : "";
  const char* why = ui.pointed ? ", pointed at" : ui.session.selected ? ", of the selected pixel" : "";
  const char* lacks = ui.slices.complete(ui.session.trace()) ? "" : "; a long run: only the span at work is drawn";
  return fmt::format("scan line y = {}{}{}{}", at->y, of_light, why, lacks);
}

bool serves_slice(const Header& header) {
  return records<SpanBegin>(header) || records<SpanFlags>(header) || records(header, AtPixel::verdict);
}

bool serves_slice_in_view(const Header& header) {
  return serves_slice(header) && header.conventions.depth == Conventions::Depth::pseudodepth;
}

bool no_slice_yet(Ui& ui) { return none_yet<SpanBegin, SpanFlags>(ui) && none_yet(ui, AtPixel::verdict); }

}  // namespace

const Pane slice_pane{"slice", "SLICE", draw_slice, note_of_slice, serves_slice,    0.7f,
                      false,   nullptr, true,       no_slice_yet,  &slice_view_pane};
const Pane slice_view_pane{
    "slice_view", "SLICE IN z_v", draw_slice_in_view, note_of_slice, serves_slice_in_view, 0.7f, false,
    nullptr,      true,           no_slice_yet};

}  // namespace zstep::viewer
