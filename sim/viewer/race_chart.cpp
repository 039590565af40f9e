// Where the costs of the methods of a race cross as the number of polygons grows, as a chart.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/panes/chart_picture.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

using compare::Measure;

LineChart growth_chart(const GrowthChart& growth, Measure measure) {
  LineChart chart;
  chart.x_title = "polygons";
  chart.y_title = measure == Measure::time ? "milliseconds" : std::string(word_of(measure));
  chart.x_ticks.assign(compare::growth_sizes.begin(), compare::growth_sizes.end());
  const double unit = measure == Measure::time ? 1e3 : 1;
  // Shapes and colours of their own: a disc, a square, a triangle, a diamond.
  constexpr std::array<int, Race::most> looks{LineChart::plain_look, 1, 2, 6 + LineChart::muted_look};
  for (const compare::GrowthLine& line : growth.lines) {
    LineChart::Line drawn{line.title, {}, false, looks[static_cast<std::size_t>(&line - growth.lines.data())]};
    for (const compare::GrowthPoint& point : line.points)
      drawn.points.emplace_back(point.polygons, unit * point.by(measure));
    if (!drawn.points.empty()) chart.lines.push_back(std::move(drawn));
  }
  for (const compare::Crossing& crossing : compare::crossings(growth.lines, measure))
    chart.now.push_back({{crossing.polygons, unit * crossing.cost}, "about " + grouped(crossing.rounded())});
  return chart;
}

}  // namespace

void App::draw_growth(ImVec2 at, ImVec2 size) {
  const Theme& c = ui_.colors();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, c.pane);
  ImGui::SetCursorScreenPos(at);
  ImGui::BeginChild("costs", size, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysUseWindowPadding);
  const Measure measure = race().clock();
  const GrowthChart& growth = race_->growth;
  const auto measured = [](const compare::GrowthLine& line) { return line.points.size() > 1; };
  flow(
      ui_,
      fmt::format(
          "{} against the number of polygons: random triangles on {} \u00d7 {} pixels, whose areas add up to "
          "{:g} times that whatever their number.{}",
          measure == Measure::time    ? "Time"
          : measure == Measure::steps ? "Steps"
                                      : "Operations",
          compare::growth_side, compare::growth_side, compare::growth_layers,
          measure == Measure::time ? " Measured on this machine without a recording; the median of several runs." : ""),
      {.color = c.muted});
  if (growth.at_work) {
    flow(ui_, fmt::format("Measuring {}; Esc ends it.", growth.next_text()), {.color = c.now, .font = ui_.fonts.bold});
  } else {
    if (button(ui_, growth.lines.empty() ? "Measure (Enter)" : "Measure again (Enter)")) race_->growth.begin(race());
    if (!growth.lines.empty()) flow(ui_, compare::tell_growth(growth.lines, measure), {});
  }
  if (std::any_of(growth.lines.begin(), growth.lines.end(), measured))
    draw_line_chart(ui_, "costs of the race", growth_chart(growth, measure));
  ImGui::EndChild();
  frame_box(ui_, at, {at.x + size.x, at.y + size.y}, c.rule);
}

}  // namespace zstep::viewer
