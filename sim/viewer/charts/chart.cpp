// Charts as pictures: dots with what they say, and lines over axes.

#include "sim/viewer/charts/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/charts/sheet.hpp"
#include "sim/words/numbers.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep {

namespace {

using viewer::chart_margin;
using viewer::chart_text;
using viewer::chart_wide;
using viewer::LogAxis;
using viewer::Sheet;

constexpr float row_height = 40, between_columns = 44, zero_slot = 26, dot = 7;

// The place of 0, and the decades right of it.
struct Scale {
  float left = 0, right = 0;
  bool has_zero = false;
  std::optional<LogAxis> decades;  // nothing above 0, no decades

  float at(double value) const { return value > 0 ? decades->at(value) : left; }
};

Scale axis_of(const DotChart::Column& column, float left, float right) {
  Scale axis{left, right, false, {}};
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const ChartValue& value : column.values) {
    axis.has_zero = axis.has_zero || value.value == 0;
    if (!(value.value > 0)) continue;
    least = std::min(least, value.value), most = std::max(most, value.value);
  }
  if (most > 0) axis.decades.emplace(least, most, left + (axis.has_zero ? zero_slot : 0), right);
  return axis;
}

void draw_axis(Sheet& sheet, const Scale& axis, float top, float bottom) {
  const auto tick = [&](float x, const std::string& text) {  // the outer labels stay within the column
    const Sheet::Side side = x <= axis.left    ? Sheet::Side::left
                             : x >= axis.right ? Sheet::Side::right
                                               : Sheet::Side::middle;
    sheet.rule({x, top}, {x, bottom}, sheet.theme().rule);
    sheet.text(x, bottom + 6, text, sheet.theme().muted, side);
  };
  if (axis.has_zero) tick(axis.left, "0");
  if (!axis.decades) return;
  const int count = axis.decades->last_decade() - axis.decades->first_decade();
  const int stride = 1 + (count - 1) / 3;  // labels that do not touch
  for (int n = axis.decades->first_decade(); n <= axis.decades->last_decade(); ++n) {
    const float x = axis.decades->at(portable::pow(10.0, n));
    if ((n - axis.decades->first_decade()) % stride == 0) tick(x, viewer::decade_text(n));
    else sheet.rule({x, top}, {x, bottom}, sheet.theme().rule);
  }
}

// A dot, and what it says on the side where there is room.
void draw_value(Sheet& sheet, const Scale& axis, const ChartValue& value, float y, ImU32 behind) {
  const float text_y = y - sheet.text_height() / 2;
  if (!std::isfinite(value.value)) {
    sheet.text(axis.left, text_y, value.text, sheet.theme().bad);
    return;
  }
  const float x = axis.at(value.value), needs = sheet.text_width(value.text) + dot + 8;
  const ImU32 color = value.warning ? sheet.theme().bad : sheet.theme().changed;
  sheet.line({axis.left, y}, {x, y}, color, 2);
  const bool right = x + needs <= axis.right + between_columns - 16;
  const float text_x = right ? x + dot + 6 : x - dot - 6;
  const float text_left = right ? text_x : text_x - sheet.text_width(value.text);
  sheet.rectangle({text_left - 2, text_y}, {text_left + needs - dot - 4, text_y + sheet.text_height()}, behind);
  sheet.text(text_x, text_y, value.text, sheet.theme().text, right ? Sheet::Side::left : Sheet::Side::right);
  if (value.warning) sheet.cross({x, y}, dot, color);
  else sheet.mark({x, y}, dot, 0, color);
}

}  // namespace

Drawing draw_chart(const DotChart& chart) {
  const float line = chart_text * 1.35f;
  const float top = chart_margin + 2 * line + 12, rows_top = top + 2 * line + 6;
  const float bottom = rows_top + row_height * static_cast<float>(chart.rows.size());
  Sheet sheet(chart_wide, static_cast<int>(bottom + line + chart_margin), chart_text);

  sheet.text(chart_margin, chart_margin, chart.title, sheet.theme().text, Sheet::Side::left, true);
  sheet.text(chart_margin, chart_margin + line, chart.subtitle, sheet.theme().muted);
  const auto band = [&](std::size_t row) { return row % 2 == 0 ? sheet.theme().head : sheet.theme().pane; };
  float names = 0;
  for (const std::string& name : chart.rows) names = std::max(names, sheet.text_width(name));
  for (std::size_t row = 0; row < chart.rows.size(); ++row) {
    const float y = rows_top + row_height * (static_cast<float>(row) + 0.5f);
    sheet.rectangle({chart_margin / 2, y - row_height / 2}, {chart_wide - chart_margin / 2, y + row_height / 2},
                    band(row));
    sheet.text(chart_margin + names, y - sheet.text_height() / 2, chart.rows[row], sheet.theme().text,
               Sheet::Side::right);
  }

  const float first = chart_margin + names + 24, count = static_cast<float>(chart.columns.size());
  const float column_width = (chart_wide - chart_margin - first) / std::max(count, 1.0f);
  for (std::size_t k = 0; k < chart.columns.size(); ++k) {
    const DotChart::Column& column = chart.columns[k];
    const float left = first + static_cast<float>(k) * column_width;
    const Scale axis = axis_of(column, left, left + column_width - between_columns);
    sheet.text(left, top, column.title, sheet.theme().text, Sheet::Side::left, true);
    sheet.text(left, top + line, column.subtitle, sheet.theme().muted);
    draw_axis(sheet, axis, rows_top, bottom);
    for (std::size_t row = 0; row < std::min(column.values.size(), chart.rows.size()); ++row)
      draw_value(sheet, axis, column.values[row], rows_top + row_height * (static_cast<float>(row) + 0.5f), band(row));
  }
  return {sheet.picture(), sheet.svg()};
}

std::vector<double> decades_between(double from, double to) {
  std::vector<double> all;
  for (double decade = portable::pow(10, std::ceil(portable::log10(from) - 1e-9)); decade <= to * 1.0001; decade *= 10)
    all.push_back(decade);
  return all;
}

LineChart unit_chart(const Scene& scene, const std::vector<std::pair<std::string, Conventions>>& modes) {
  const double near = scene.camera.near, far = scene.camera.far;
  LineChart chart;
  chart.title = fmt::format("{}: which depths a buffer can tell apart, near = {:g}, far = {:g}", scene.name, near, far);
  chart.subtitle = "By formula: the distance in z_v to the next depth that the mode's buffer can hold.";
  chart.x_title = "z_v";
  chart.y_title = "a unit of the depth buffer, in z_v";
  chart.x_ticks = decades_between(near, far);
  constexpr int points = 17;
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    LineChart::Line line{modes[mode].first, {}, false, index32(mode)};
    for (int k = 0; k < points; ++k) {
      const double z =
          near * portable::pow(far / near, (k + 0.5) / points);  // not at the planes: about 0 floats are endless
      if (const double unit = formulas::resolution(scene, modes[mode].second, z); unit > 0)
        line.points.emplace_back(z, unit);
    }
    if (!line.points.empty()) chart.lines.push_back(std::move(line));
  }
  return chart;
}

namespace {

using viewer::chart_margin;
using viewer::chart_text;
using viewer::chart_wide;
using viewer::LogAxis;
using viewer::Paper;
using viewer::Sheet;

constexpr int high = 720;
constexpr float mark_size = 7;

std::string tick_text(double value) {
  if (value < 1 || (value < 1000 && value != std::round(value))) return fmt::format("{:.3g}", value);
  const std::int64_t whole = std::llround(value);
  if (whole < 1000) return std::to_string(whole);
  return fmt::format("{} {:03}", whole / 1000, whole % 1000);
}

ImU32 color_of_look(const viewer::Theme& theme, int look) {
  const std::array<ImU32, 6> colors{theme.now, theme.changed, theme.selected, theme.good, theme.text, theme.muted};
  return colors[static_cast<std::size_t>(look) % colors.size()];
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void take(double value) { least = std::min(least, value), most = std::max(most, value); }
};

/// One of the two axes: where a value lies, and which values have a number.
class ChartAxis {
 public:
  struct Tick {
    double value;
    std::string text;
  };
  /// `each`: pixels that a number needs.
  static ChartAxis up(const Range& range, LineChart::Scale scale, float from, float to, float each) {
    ChartAxis axis{from, to, range, {}, {}};
    if (scale == LineChart::Scale::linear) return axis.with_round_ticks(each);
    axis.decades_.emplace(range.least, range.most, from, to);
    const LogAxis& decades = *axis.decades_;
    const int count = decades.last_decade() - decades.first_decade() + 1;
    const int stride = std::max(1, ceil_int(static_cast<float>(count) * each / std::abs(to - from)));
    for (int n = decades.first_decade(); n <= decades.last_decade(); n += stride)
      axis.ticks_.push_back({portable::pow(10.0, n), viewer::decade_text(n)});
    for (int n = decades.first_decade();
         n < decades.last_decade() && std::abs(to - from) > 2 * each * static_cast<float>(count); ++n)
      for (int k = 2; k < 10; ++k) axis.between_.push_back(k * portable::pow(10.0, n));
    return axis;
  }
  static ChartAxis across(const Range& range, const LineChart& chart, float from, float to, float each) {
    ChartAxis axis{from, to, range, {}, {}};
    if (chart.scale == LineChart::Scale::linear) return axis.with_round_ticks(each);
    for (const double tick : chart.x_ticks) axis.ticks_.push_back({tick, tick_text(tick)});
    axis.ratios_ = true;
    return axis;
  }

  float at(double value) const {
    if (decades_) return decades_->at(value);
    double share = 0.5;
    if (range_.most > range_.least)
      share = ratios_ ? portable::log(value / range_.least) / portable::log(range_.most / range_.least)
                      : (value - range_.least) / (range_.most - range_.least);
    return from_ + static_cast<float>(share) * (to_ - from_);
  }
  const std::vector<Tick>& ticks() const { return ticks_; }
  /// What has a line without a number: 2, 3, … 9 times a power of ten, where there is room.
  const std::vector<double>& between() const { return between_; }

 private:
  ChartAxis(float from, float to, const Range& range, std::optional<LogAxis> decades, std::vector<Tick> ticks)
      : from_(from), to_(to), range_(range), decades_(decades), ticks_(std::move(ticks)) {}
  ChartAxis& with_round_ticks(float each) {
    const int most = std::max(1, static_cast<int>(std::abs(to_ - from_) / each));
    const double step = viewer::nice_step(range_.most - range_.least, most);
    const int decimals = std::clamp(ceil_int(-portable::log10(step) - 1e-9), 0, 8);
    for (double value = std::ceil(range_.least / step - 1e-9) * step; value <= range_.most + step * 1e-9;
         value += step) {
      const double shown = std::abs(value) < step * 1e-6 ? 0 : value;
      ticks_.push_back({shown, number(shown, decimals)});
    }
    return *this;
  }

  float from_, to_;
  Range range_;
  std::optional<LogAxis> decades_;  ///< whole ones; else from the least to the greatest
  std::vector<Tick> ticks_;
  std::vector<double> between_{};
  bool ratios_ = false;
};

// The names beside the lines' ends, pushed apart where they would overlap.
struct EndName {
  float y;
  ImU32 color;
  std::string text;
};
void draw_names(Paper& sheet, std::vector<EndName> names, float x, float top, float bottom) {
  const float step = sheet.text_height() * 1.1f;
  std::stable_sort(names.begin(), names.end(), [](const EndName& a, const EndName& b) { return a.y < b.y; });
  for (std::size_t k = 1; k < names.size(); ++k) names[k].y = std::max(names[k].y, names[k - 1].y + step);
  float limit = bottom;
  for (std::size_t k = names.size(); k-- > 0; limit = names[k].y - step)
    names[k].y = std::max(top, std::min(names[k].y, limit));
  for (const EndName& name : names) sheet.text(x, name.y - sheet.text_height() / 2, name.text, name.color);
}

struct Box {
  ImVec2 from, to;
  bool meets(const Box& other) const {
    return from.x < other.to.x && other.from.x < to.x && from.y < other.to.y && other.from.y < to.y;
  }
};

/// A mark with its text beside it, on the side where there is room and no other text, and best no line.
void draw_now(Paper& paper, const LineChart::Now& now, ImVec2 at, const viewer::PlotArea& plot, std::vector<Box>& taken,
              const std::vector<Box>& lines) {
  const viewer::Theme& theme = paper.theme();
  const float radius = mark_size * plot.scale, away = radius + 5, wide = paper.text_width(now.text);
  paper.mark(at, radius + 2, 3, theme.pane);
  paper.mark(at, radius, 3, theme.now);
  if (now.text.empty()) return;
  const float letters = paper.text_height(), right = at.x + away, left = at.x - away - wide;
  Box box, on_line;
  const auto is_free = [](const std::vector<Box>& all, const Box& place) {
    return std::none_of(all.begin(), all.end(), [&](const Box& one) { return one.meets(place); });
  };
  for (const float down : {0.5f, -1.5f, 1.6f, 2.7f, 3.8f}) {
    const float below = std::clamp(at.y + down * letters, plot.top, plot.bottom - letters);
    for (const float x : {right, left, left - 2 * letters, left - 4 * letters, left - 6 * letters}) {
      if (x < plot.left || x + wide > plot.right) continue;
      const Box place{{x - 2, below}, {x + wide + 2, below + letters}};
      if (!is_free(taken, place)) continue;
      if (on_line.to.x == 0) on_line = place;
      if (box.to.x == 0 && is_free(lines, place)) box = place;
    }
  }
  if (box.to.x == 0) box = on_line;
  if (box.to.x == 0) return;
  taken.push_back(box);
  paper.rectangle(box.from, box.to, theme.pane);
  paper.text(box.from.x + 2, box.from.y, now.text, theme.now);
}

struct Reach {
  Range x, y;
};
Reach reach_of(const LineChart& chart) {
  Reach reach;
  for (const LineChart::Line& one : chart.lines)
    for (const glm::dvec2 point : one.points) reach.x.take(point.x), reach.y.take(point.y);
  for (const LineChart::Now& now : chart.now) reach.x.take(now.at.x), reach.y.take(now.at.y);
  for (const double tick : chart.x_ticks) reach.x.take(tick);
  if (chart.scale != LineChart::Scale::linear) return reach;
  for (const double x : {chart.x_reach.x, chart.x_reach.y}) reach.x.take(x);
  for (const double y : {chart.y_reach.x, chart.y_reach.y}) reach.y.take(y);
  return reach;
}

}  // namespace

double viewer::nice_step(double range, int most) {
  const double raw = range / std::max(1, most), decade = portable::pow(10.0, std::floor(portable::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (decade * factor >= raw * (1 - 1e-9)) return decade * factor;
  return decade * 10;
}

void viewer::draw_lines(Paper& paper, const LineChart& chart, const PlotArea& area) {
  const bool linear = chart.scale == LineChart::Scale::linear;
  const Theme& theme = paper.theme();
  const float letters = paper.text_height(), line = letters * 1.35f;
  float names_wide = 0;
  for (const LineChart::Line& one : chart.lines) names_wide = std::max(names_wide, paper.text_width(one.name));
  const auto [xs, ys] = reach_of(chart);
  if (!(xs.most > (linear ? xs.least : 0)) || !(ys.most > (linear ? ys.least : 0))) return;

  PlotArea plot = area;
  plot.top = area.top + 1.2f * line, plot.bottom = area.bottom - 2.2f * line;
  const ChartAxis up = ChartAxis::up(ys, chart.scale, plot.bottom, plot.top, 1.25f * letters);
  float labels = area.labels;
  if (labels == 0)
    for (const ChartAxis::Tick& tick : up.ticks()) labels = std::max(labels, paper.text_width(tick.text) + 12);
  plot.left = area.left + labels, plot.right = area.right - names_wide - 30 * area.scale;
  if (plot.right - plot.left < 60 || plot.bottom - plot.top < 30) return;
  const float beside = 30 * area.scale;  // a little room beside the first and the last
  const ChartAxis across = ChartAxis::across(xs, chart, plot.left + beside, plot.right - beside, 3.5f * letters);

  paper.text(area.left, area.top, chart.y_title, theme.text);
  for (const double value : up.between()) paper.rule({plot.left, up.at(value)}, {plot.right, up.at(value)}, theme.head);
  for (const ChartAxis::Tick& tick : up.ticks()) {
    const float y = up.at(tick.value);
    paper.rule({plot.left, y}, {plot.right, y}, tick.value == 0 ? theme.muted : theme.rule);
    paper.text(plot.left - 10, y - letters / 2, tick.text, theme.muted, Paper::Side::right);
  }
  for (const ChartAxis::Tick& tick : across.ticks()) {
    const float x = across.at(tick.value);
    if (chart.led.empty()) paper.rule({x, plot.top}, {x, plot.bottom}, theme.rule);
    paper.text(x, plot.bottom + 8 * area.scale, tick.text, theme.muted, Paper::Side::middle);
  }
  paper.text((plot.left + plot.right) / 2, plot.bottom + 8 * area.scale + line, chart.x_title, theme.text,
             Paper::Side::middle);

  const auto lead = [&](glm::dvec2 point, ImU32 color) {
    const ImVec2 at{across.at(point.x), up.at(point.y)};
    paper.rule({plot.left, at.y}, {at.x, at.y}, color);
    paper.rule({at.x, at.y}, {at.x, plot.bottom}, color);
  };
  for (const glm::dvec2 point : chart.led) lead(point, theme.muted);
  if (!chart.led.empty())
    for (const LineChart::Now& now : chart.now) lead(now.at, theme.now);

  std::vector<EndName> names;
  std::vector<Box> lines;  // in short pieces
  const auto keep_free = [&](ImVec2 from, ImVec2 to) {
    constexpr float step = 4;
    const float length = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y)), half = mark_size * area.scale;
    constexpr float longest = 10'000;  // in pixels; a number that is none leads nowhere
    if (!(length <= longest)) return;
    for (float at = 0; at <= length; at += step) {
      const float t = length > 0 ? at / length : 0;
      const ImVec2 p{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
      lines.push_back({{p.x - half, p.y - half}, {p.x + half, p.y + half}});
    }
  };
  for (const LineChart::Line& one : chart.lines) {
    const ImU32 color = color_of_look(theme, one.look);
    const auto place = [&](glm::dvec2 point) { return ImVec2(across.at(point.x), up.at(point.y)); };
    for (std::size_t k = 1; k < one.points.size(); ++k) {
      const ImVec2 from = place(one.points[k - 1]), to = place(one.points[k]);
      if (one.dashed) paper.dashed_line(from, to, color, 2.5f * area.scale);
      else paper.line(from, to, color, 3 * area.scale);
      if (!chart.now.empty()) keep_free(from, to);
    }
    float last = -1e9f;  // marks that would hide each other are left out
    for (const glm::dvec2 point : one.points) {
      if (one.bare) break;
      if (linear && place(point).x - last < 2.5f * mark_size * area.scale) continue;
      last = place(point).x;
      paper.mark(place(point), mark_size * area.scale, one.look, color, !one.dashed);
    }
    if (!one.points.empty() && !one.name.empty()) names.push_back({up.at(one.points.back().y), color, one.name});
  }
  std::vector<Box> taken;  // a mark is not to be written over, either
  for (const LineChart::Now& now : chart.now) {
    const float x = across.at(now.at.x), y = up.at(now.at.y), half = mark_size * area.scale;
    taken.push_back({{x - half, y - half}, {x + half, y + half}});
  }
  for (const LineChart::Now& now : chart.now)
    draw_now(paper, now, {across.at(now.at.x), up.at(now.at.y)}, plot, taken, lines);
  draw_names(paper, std::move(names), plot.right + 14 * area.scale, plot.top, plot.bottom);
}

Drawing draw_chart(const LineChart& chart) {
  Sheet sheet(chart_wide, high, chart_text);
  const viewer::Theme& theme = sheet.theme();
  const float line = chart_text * 1.35f;
  sheet.text(chart_margin, chart_margin, chart.title, theme.text, Sheet::Side::left, true);
  sheet.text(chart_margin, chart_margin + line, chart.subtitle, theme.muted);
  draw_lines(sheet, chart,
             {chart_margin, chart_margin + 2.2f * line, chart_wide - chart_margin, high - chart_margin, 90, 1});
  return {sheet.picture(), sheet.svg()};
}

}  // namespace zstep
