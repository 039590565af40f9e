

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "sim/viewer/charts/chart.hpp"
#include "sim/viewer/charts/sheet.hpp"
#include "traces/formulas/resolution.hpp"
#include "traces/math/portable_math.hpp"

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
    LineChart::Line line{modes[mode].first, {}, false, static_cast<int>(mode)};
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

}  // namespace zstep
