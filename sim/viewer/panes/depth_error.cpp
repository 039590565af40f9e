// How errors of depth add up: along the span at work, and along its left edge. What rounding alone does: each depth is
// held against what its own formula gives without any.
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/panes/chart_picture.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

std::optional<Drift> drift_of(Ui& ui, std::optional<Cell> chosen) { return drift_at(ui.moment(), ui.errors, chosen); }
std::optional<Cell> chosen_in(const Ui& ui) { return ui.pointed ? ui.pointed : ui.session.selected; }

const char* unit_of(const Header& header) { return bits_of(header.conventions.number_format) > 0 ? "units" : "ulps"; }

/// The span filled and solid, the edge hollow and dashed; the second run has marks and colours of its own.
void add_lines(LineChart& chart, const Drift& drift, const std::string& run, int look) {
  LineChart::Line edge{run + "edge", {}, true, look + 1}, span{run + "span", {}, false, look};
  for (const oracle::DepthError& depth : drift.edge) edge.points.emplace_back(depth.along_edge, depth.error);
  for (const oracle::DepthError& depth : drift.span) span.points.emplace_back(depth.along_span, depth.error);
  for (LineChart::Line* line : {&edge, &span})
    if (!line->points.empty()) chart.lines.push_back(std::move(*line));
}

std::string what_of(const Ui& ui) {
  const Header& header = ui.session.header();
  return fmt::format("error of {} in {} of {}", depth_symbol(ui.session.scene(), header.conventions), unit_of(header),
                     word_of(header.conventions.number_format));
}

LineChart chart_of(Ui& ui, const Drift& drift) {
  LineChart chart;
  chart.scale = LineChart::Scale::linear;
  chart.y_title = what_of(ui);
  if (ui.other && what_of(*ui.other) != chart.y_title)
    chart.y_title = fmt::format("A: {}; B: {}", chart.y_title, what_of(*ui.other));
  chart.x_title = "pixels, or lines, after the first";
  chart.x_reach = {0, ui.errors.longest()};
  chart.y_reach = {std::min(-1.0, ui.errors.least()), std::max(1.0, ui.errors.most())};
  if (ui.other) {
    if (const auto other = drift_of(*ui.other, chosen_in(ui))) {
      add_lines(chart, *other, "B: ", 2);
      chart.x_reach.y = std::max(chart.x_reach.y, static_cast<double>(ui.other->errors.longest()));
      chart.y_reach.x = std::min(chart.y_reach.x, ui.other->errors.least());
      chart.y_reach.y = std::max(chart.y_reach.y, ui.other->errors.most());
    }
  }
  add_lines(chart, drift, ui.other ? "A: " : "", LineChart::plain_look);
  const auto& last = drift.span.empty() ? drift.edge : drift.span;
  if (last.empty() || drift.past) return chart;
  const oracle::DepthError& now = last.back();
  chart.now.push_back({{drift.span.empty() ? now.along_edge : now.along_span, now.error},
                       fmt::format("x = {}: {}", now.x, number(now.error, 2, true))});
  return chart;
}

void draw_depth_error(Ui& ui) {
  if (ui.errors.too_long(ui.session.trace()))
    return say_empty(ui, fmt::format("A long run: 'zstep error' finds the errors of its {} steps.",
                                     grouped(ui.session.trace().size())));
  const auto drift = drift_of(ui, chosen_in(ui));
  if (!drift && ui.errors.of(ui.session.trace()).empty())
    return say_empty(ui, "Empty: no depth of this trace can be held against an exact one.");
  if (!drift)
    return say_empty(ui,
                     chosen_in(ui) ? "Empty: no span has reached this pixel." : "Empty: no span has been at work yet.");
  draw_line_chart(ui, "error along span and edge", chart_of(ui, *drift));
  if (ImGui::IsWindowHovered())
    ui.mouse_help = "How rounding adds up along the span and along its left edge. Point at a pixel to see its span.";
}

/// Whatever pixel is pointed at: what leads does not change with the mouse.
bool waits_for_depths(Ui& ui) { return !drift_of(ui, std::nullopt); }

std::string note_of_depth_error(Ui& ui) {
  if (ui.errors.too_long(ui.session.trace())) return "a long run: 'zstep error' finds its errors";
  const auto drift = drift_of(ui, chosen_in(ui));
  if (!drift && waits_for_depths(ui)) return "empty: no span has been at work yet";
  if (!drift) return "";
  const char* why = !drift->chosen ? "" : ui.pointed ? ", pointed at" : ", of the selected pixel";
  return fmt::format("{} on scan line y = {}{}", drift->past ? "last span" : "span", drift->y, why);
}

bool serves_depth_error(const Header& header) {
  return has_step_of<SpanBegin>(header) && (has_step_of<DepthInterpolate>(header) ||
                                            has_step_of<DepthCompare>(header) || has_step_of<PixelPaint>(header));
}

}  // namespace

const Pane depth_error_pane{"depth_error",
                            "ERROR ALONG SPAN AND EDGE",
                            draw_depth_error,
                            note_of_depth_error,
                            serves_depth_error,
                            0.5f,
                            false,
                            nullptr,
                            true,
                            waits_for_depths,
                            &depth_units_pane};

}  // namespace zstep::viewer
