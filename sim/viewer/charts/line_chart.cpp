#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sim/viewer/charts/chart.hpp"
#include "sim/viewer/charts/sheet.hpp"

namespace zstep {

namespace {

using viewer::chart_margin;
using viewer::chart_text;
using viewer::chart_wide;
using viewer::LogAxis;
using viewer::Sheet;

constexpr int high = 720;
constexpr float mark_size = 7;

std::string tick_text(double value) {
  if (value < 1) return fmt::format("{:g}", value);
  const auto whole = static_cast<std::int64_t>(std::llround(value));
  if (whole < 1000) return std::to_string(whole);
  return fmt::format("{} {:03}", whole / 1000, whole % 1000);
}

ImU32 color_of_look(const viewer::Theme& theme, int look) {
  const std::array<ImU32, 4> colors{theme.now, theme.changed, theme.selected, theme.good};
  return colors[static_cast<std::size_t>(look) % colors.size()];
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  void take(double value) { least = std::min(least, value), most = std::max(most, value); }
};

// The names beside the lines' ends, pushed apart where they would overlap.
struct EndName {
  float y;
  ImU32 color;
  std::string text;
};
void draw_names(Sheet& sheet, std::vector<EndName> names, float x, float top, float bottom) {
  const float step = sheet.text_height() * 1.1f;
  std::sort(names.begin(), names.end(), [](const EndName& a, const EndName& b) { return a.y < b.y; });
  for (std::size_t k = 1; k < names.size(); ++k) names[k].y = std::max(names[k].y, names[k - 1].y + step);
  float limit = bottom;
  for (std::size_t k = names.size(); k-- > 0; limit = names[k].y - step)
    names[k].y = std::max(top, std::min(names[k].y, limit));
  for (const EndName& name : names) sheet.text(x, name.y - sheet.text_height() / 2, name.text, name.color);
}

}  // namespace

Drawing draw_chart(const LineChart& chart) {
  Sheet sheet(chart_wide, high, chart_text);
  const viewer::Theme& theme = sheet.theme();
  const float line = chart_text * 1.35f;
  sheet.text(chart_margin, chart_margin, chart.title, theme.text, Sheet::Side::left, true);
  sheet.text(chart_margin, chart_margin + line, chart.subtitle, theme.muted);

  Range xs, ys;
  float names_wide = 0;
  for (const LineChart::Line& one : chart.lines) {
    names_wide = std::max(names_wide, sheet.text_width(one.name));
    for (const glm::dvec2 point : one.points) xs.take(point.x), ys.take(point.y);
  }
  for (const double tick : chart.x_ticks) xs.take(tick);
  if (!(xs.most > 0) || !(ys.most > 0)) return {sheet.picture(), sheet.svg()};

  const float left = chart_margin + 90, right = chart_wide - chart_margin - names_wide - 30;
  const float top = chart_margin + 3.4f * line, bottom = high - chart_margin - 2.2f * line;
  const LogAxis up(ys.least, ys.most, bottom, top);
  const auto x_at = [&](double x) {  // a little room beside the first and the last
    const double share = xs.most > xs.least ? std::log(x / xs.least) / std::log(xs.most / xs.least) : 0.5;
    return left + 30 + static_cast<float>(share) * (right - left - 60);
  };
  sheet.text(chart_margin, top - 1.2f * line, chart.y_title, theme.text);
  for (int n = up.first_decade(); n <= up.last_decade(); ++n) {
    const float y = up.at(std::pow(10.0, n));
    sheet.rule({left, y}, {right, y}, theme.rule);
    sheet.text(left - 10, y - sheet.text_height() / 2, viewer::decade_text(n), theme.muted, Sheet::Side::right);
  }
  for (const double tick : chart.x_ticks) {
    sheet.rule({x_at(tick), top}, {x_at(tick), bottom}, theme.rule);
    sheet.text(x_at(tick), bottom + 8, tick_text(tick), theme.muted, Sheet::Side::middle);
  }
  sheet.text((left + right) / 2, bottom + 8 + line, chart.x_title, theme.text, Sheet::Side::middle);

  std::vector<EndName> names;
  for (const LineChart::Line& one : chart.lines) {
    const ImU32 color = color_of_look(theme, one.look);
    for (std::size_t k = 1; k < one.points.size(); ++k) {
      const ImVec2 from(x_at(one.points[k - 1].x), up.at(one.points[k - 1].y)),
          to(x_at(one.points[k].x), up.at(one.points[k].y));
      if (one.dashed) sheet.dashed_line(from, to, color, 2.5f);
      else sheet.line(from, to, color, 3);
    }
    for (const glm::dvec2 point : one.points)
      sheet.mark({x_at(point.x), up.at(point.y)}, mark_size, one.look, color, !one.dashed);
    if (!one.points.empty() && !one.name.empty()) names.push_back({up.at(one.points.back().y), color, one.name});
  }
  draw_names(sheet, std::move(names), right + 14, top, bottom);
  return {sheet.picture(), sheet.svg()};
}

}  // namespace zstep
