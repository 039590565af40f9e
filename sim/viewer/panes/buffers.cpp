// Framebuffer and depth buffer, with depths in units and their errors; the shadow buffer.

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/chart_picture.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/legend.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/raster_pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/relief.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// Numbers in the colours of depths, from the least to the most, polygons in their own; hatched where there is none.
void color_heat(Cells& cells, const HeatMap& heat, const Scene& scene, const DepthScale& scale) {
  cells.colors.resize(heat.values.size());
  cells.counts.clear();
  if (!heat.polygons) cells.counts = heat.values;
  const auto color = [&](double value) {
    if (std::isnan(value)) return hatched_cell;
    if (!heat.polygons) return scale.at(heat.share(value));
    const auto at = static_cast<std::size_t>(value);
    return at < scene.polygons.size() ? opaque(scene.polygons[at].color) : hatched_cell;
  };
  double last = std::nan("");
  Pixel32 its_color = hatched_cell;
  for (std::size_t i = 0; i < cells.colors.size(); ++i) {
    // Neighbours mostly have the same number.
    if (const double value = heat.values[i]; value != last) last = value, its_color = color(value);
    cells.colors[i] = its_color;
  }
}

void color_frame(Cells& cells, const Moment& now) {
  const Picture& picture = now.picture();
  std::vector<Pixel32> colors;
  for (const Polygon& polygon : now.scene().polygons) colors.push_back(opaque(polygon.color));
  const Pixel32 background = opaque(now.scene().background);
  cells.colors.resize(picture.polygon.size());
  for (std::size_t i = 0; i < cells.colors.size(); ++i) {
    if (!picture.ink.empty() && picture.ink[i] != no_ink) {
      cells.colors[i] = opaque(color_of(picture.ink[i]));
      continue;
    }
    const std::int32_t p = picture.polygon[i];
    cells.colors[i] = p >= 0 && p < std::ssize(colors) ? colors[p] : background;
  }
}

std::string heat_text(const Ui& ui, std::size_t at) {
  const double value = ui.heat->values[at];
  if (std::isnan(value)) return "";
  return ui.heat->polygons ? polygon_label(ui.session.scene(), static_cast<std::int32_t>(value))
                           : number(value, 2, true);
}

std::vector<std::string> about_cell(Ui& ui, Cell cell) {
  const Session& s = ui.session;
  const Picture& picture = s.picture();
  const std::size_t at = picture.at(cell.x, cell.y);
  const std::string z = depth_symbol(s.scene(), s.header().conventions);
  std::vector<std::string> lines{fmt::format("pixel ({}, {})", cell.x, cell.y),
                                 fmt::format("frame: {}", polygon_label(s.scene(), picture.polygon[at])),
                                 fmt::format("{} = {}", z, exact(picture.depth[at]))};
  if (z == "z*")
    lines.push_back(
        fmt::format("z_v = {}", exact(view_depth(s.scene().camera, s.header().conventions, picture.depth[at]))));
  if (ui.heat) {
    const std::string value = heat_text(ui, at);
    lines.push_back(fmt::format("{}: {}", ui.heat->name, value.empty() ? "none" : value));
  }
  if (!std::isfinite(picture.depth[at])) return lines;
  const auto question = answers::of_pixel(s.looking_back ? s.before() : s.position(), {cell.x, cell.y});
  if (const std::string line = exact_line(ui.session, question); !line.empty())  // moves the replay
    lines.insert(lines.begin() + 3, line);
  return lines;
}

void draw_frame(Ui& ui) {
  const Session& s = ui.session;
  const Scene& scene = s.scene();
  const float bottom = ImGui::GetCursorScreenPos().y + ImGui::GetContentRegionAvail().y;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Kept<Cells>& cells = ui.heat ? *keep(ui.cells, "heat", color_heat, *ui.heat, scene, ui.depth_scale)
                                     : *keep(ui.cells, "frame", color_frame, ui.moment());
  // Where pixels of a polygon have colours of their own, a letter in each would hide how these change.
  const Conventions& conventions = s.header().conventions;
  const bool shades = conventions.attribute != Conventions::Attribute::none &&
                      !formulas::is_of_stripes(formulas::shade_of(conventions));
  std::function<std::string(std::size_t, int)> text = [&](std::size_t at, int) {
    if (ui.heat) return heat_text(ui, at);
    const std::int32_t p = s.picture().polygon[at];
    return p < 0 ? std::string() : polygon_label(scene, p);
  };
  if (shades && !ui.heat) text = nullptr;
  draw_raster(ui, "frame", ui.presenter && !ui.heat ? 0 : legend_height(ui), cells, text,
              [&](Cell cell) { return about_cell(ui, cell); }, {{}, !ui.heat});
  if (!ui.heat) return;
  ImGui::SetCursorScreenPos(corner);
  draw_heat_legend(ui, bottom);
}

std::string frame_note(Ui& ui) {
  const Session& s = ui.session;
  if (!ui.heat_behind.empty()) return ui.heat_behind;
  if (ui.heat)
    return fmt::format("{}{}; Esc ends", ui.heat->name,
                       ui.heat->until >= 0 ? fmt::format(" up to step {}", grouped(ui.heat->until)) : "");
  if (s.looking_back) return fmt::format("BEFORE: step {}", grouped(s.before()));
  if (s.state().machine.pass == Pass::light) return "as the light sees it";
  return fmt::format("{} \u00d7 {}{}", s.scene().raster.width, s.scene().raster.height,
                     ui.view.zoom >= 100 ? fmt::format(", zoom {:.0f}", ui.view.zoom)
                     : ui.view.zoom > 1  ? fmt::format(", zoom {:.3g}", ui.view.zoom)
                                         : "");
}

/// Decimals that the numbers in the buffer need.
int decimals_in(const Picture& picture) {
  std::vector<double> values;
  for (const double z : picture.depth)
    if (std::isfinite(z)) values.push_back(z);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return decimals_needed(values, 3);
}

/// What the colours of the depth buffer span: one set by hand, that of what is shown, or the scene's. The light's
/// picture, and a trace that does not say where its vertices are, have that of what is shown.
DepthRange range_of(const Ui& ui, const Moment& now) {
  if (ui.range_mode == Ui::RangeMode::by_hand) return ui.hand_range;
  const bool fits =
      ui.range_mode == Ui::RangeMode::fitted || !ui.depth_range.known || now.state().machine.pass == Pass::light;
  return fits ? fitted_range(now.picture(), now.header()) : ui.depth_range;
}

void color_depths_of(Cells& cells, const Picture& picture, const DepthRange& range, const DepthScale& scale) {
  cells.decimals = picture.depth.size() <= 16384 ? decimals_in(picture) : 2;
  cells.colors.resize(picture.depth.size());
  for (std::size_t i = 0; i < cells.colors.size(); ++i)
    cells.colors[i] = std::isfinite(picture.depth[i]) ? scale.at(range.share(picture.depth[i])) : hatched_cell;
}
void color_depths(Cells& cells, const Moment& now, const DepthRange& range, const DepthScale& scale) {
  color_depths_of(cells, now.picture(), range, scale);
}

void draw_depth(Ui& ui) {
  const Session& s = ui.session;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float bottom = corner.y + ImGui::GetContentRegionAvail().y;
  const DepthRange range = range_of(ui, ui.moment());
  const bool spread = ui.histogram && ImGui::GetContentRegionAvail().y > 2.5f * histogram_height(ui);
  const float reserve = legend_height(ui) + (spread ? histogram_height(ui) : 0.0f);
  const auto tip = [&](Cell cell) { return about_cell(ui, cell); };
  RasterTalk talk;
  talk.question = [&](Cell cell) -> std::optional<answers::Question> {
    if (!std::isfinite(s.picture().depth[s.picture().at(cell.x, cell.y)])) return std::nullopt;
    return answers::of_pixel(s.looking_back ? s.before() : s.position(), {cell.x, cell.y});
  };
  if (ui.relief)
    draw_relief(ui, {ImGui::GetContentRegionAvail().x, ImGui::GetContentRegionAvail().y - reserve}, range, tip);
  else
    draw_raster(
        ui, "depth", reserve, *keep(ui.cells, "depth", color_depths, ui.moment(), range, ui.depth_scale),
        [&](std::size_t at, int shown) { return number(s.picture().depth[at], shown); }, tip, talk);
  ImGui::SetCursorScreenPos(corner);
  draw_depth_legend(ui, bottom, range);
  if (spread) draw_histogram(ui, bottom, range, s.picture());
}

std::string depth_note(Ui& ui) {
  const Session& s = ui.session;
  if (s.looking_back) return "BEFORE";
  if (s.state().machine.pass == Pass::light) return "the light's: the shadow buffer";
  const std::string z = depth_symbol(s.scene(), s.header().conventions);
  const std::string name = z == "z*" ? "z* pseudodepth" : z == "z_v" ? "z_v" : "z";
  const char* kept = "";
  if (depth_buffer(s.header()) == DepthBuffer::none) kept = "; the method keeps none";
  if (depth_buffer(s.header()) == DepthBuffer::line) kept = "; the method keeps one line of them";
  return name + kept +
         (ui.range_mode == Ui::RangeMode::fitted    ? ", range fitted"
          : ui.range_mode == Ui::RangeMode::by_hand ? ", range by hand"
                                                    : "");
}

bool keeps_depths(const Header& header) { return depth_buffer(header) == DepthBuffer::picture; }
/// What is painted has a depth in the trace, though the method has no buffer of them.
bool records_depths(const Header& header) { return !keeps_depths(header) && records<PixelPaint>(header); }

}  // namespace

const Pane frame_pane{"frame", "FRAMEBUFFER", draw_frame, frame_note, nullptr, 0, false, always<20>};
namespace {
// One of them serves, and both have the same place on the stage.
const Pane depth_buffer_pane{"depth", "DEPTH BUFFER", draw_depth, depth_note, keeps_depths, 0, false, always<10>};
const Pane depths_pane{"depth", "DEPTHS OF WHAT IS SHOWN", draw_depth, depth_note, records_depths, 0, false};
}  // namespace

const Pane* depth_pane_of(const Header& header) {
  for (const Pane* pane : {&depth_buffer_pane, &depths_pane})
    if (pane->serves(header)) return pane;
  return nullptr;
}

// Which depths the depth buffer can hold between the near plane and the far one: how far apart they are, and how far
// apart at the pixel at work.

namespace {

/// The depth at work, or at the pixel that is pointed at or selected, where there is one between the planes.
std::optional<double> depth_now(const Ui& ui) {
  const Session& s = ui.session;
  const auto chosen = ui.pointed ? ui.pointed : s.selected;
  std::optional<double> z;
  if (chosen) {
    const Picture& picture = s.picture();
    if (picture.depth.empty()) return std::nullopt;
    z = picture.depth[picture.at(chosen->x, chosen->y)];
  } else if (s.state().machine.fragment && s.state().machine.pass != Pass::light) {
    z = s.state().machine.fragment->z;
  }
  if (!z || !std::isfinite(*z)) return std::nullopt;
  const Camera& camera = s.scene().camera;
  const double z_v = view_depth(camera, s.header().conventions, *z);
  return z_v >= camera.near && z_v <= camera.far ? std::optional(z_v) : std::nullopt;
}

/// The view depths that the stop marks, else the depth at work. None while a question is open: they may answer it.
std::vector<double> depths_to_mark(const Ui& ui) {
  const Session& s = ui.session;
  if (s.question_open()) return {};
  if (!ui.marked_depths.empty()) return ui.marked_depths;
  if (s.lesson() && s.stop() >= 0 && !s.lesson()->stops[s.stop()].marked_depths.empty())
    return s.lesson()->stops[s.stop()].marked_depths;
  const auto z_v = depth_now(ui);
  return z_v ? std::vector{*z_v} : std::vector<double>();
}

bool has_no_planes(Ui& ui) { return ui.session.scene().camera.kind == Camera::Kind::screen; }

void draw_depth_units(Ui& ui) {
  const Scene& scene = ui.session.scene();
  const Conventions& conventions = ui.session.header().conventions;
  if (has_no_planes(ui))
    return say_empty(ui, "Empty: this scene's points are on the screen already; it has no near and no far plane.");
  const Conventions* other = ui.other ? &ui.other->session.header().conventions : nullptr;
  const bool same_format = other && other->number_format == conventions.number_format;
  if (same_format && other->depth == conventions.depth) other = nullptr;
  const auto named = [&](const char* run, const Conventions& of) {
    return fmt::format("{}: {}", run, same_format ? word_of(of.depth) : word_of(of.number_format));
  };
  LineChart chart = other ? unit_chart(scene, {{named("A", conventions), conventions}, {named("B", *other), *other}})
                          : unit_chart(scene, {{"", conventions}});
  for (std::size_t i = 0; i < chart.lines.size(); ++i)
    chart.lines[i].look = i == 0 ? LineChart::plain_look : index32(i);
  chart.x_title = fmt::format("z_v, from near = {:g} to far = {:g}", scene.camera.near, scene.camera.far);
  chart.y_title = other ? "distance in z_v to the next depth"
                        : fmt::format("distance in z_v to the next depth of {}", word_of(conventions.number_format));
  // A power of ten too near to one of the planes would have its number written over.
  const double near = scene.camera.near, far = scene.camera.far;
  std::erase_if(chart.x_ticks, [&](double tick) {
    constexpr double share = 0.08;
    const double at = portable::log(tick / near) / portable::log(far / near);
    return at < share || at > 1 - share;
  });
  chart.x_ticks.insert(chart.x_ticks.begin(), near);
  chart.x_ticks.push_back(far);
  for (const double z_v : depths_to_mark(ui))
    if (const double unit = formulas::resolution(scene, conventions, z_v); unit > 0)
      chart.now.push_back({{z_v, unit}, fmt::format("z_v = {}: {:.2g}", number(z_v), unit)});
  draw_line_chart(ui, "depths of the buffer", chart);
  if (ImGui::IsWindowHovered())
    ui.mouse_help = "What the depth buffer cannot tell apart, near to far. Point at a pixel to see its depth.";
}

/// "65 536 depths, half of them before z_v = 1.98"
std::string note_of_depth_units(Ui& ui) {
  const Scene& scene = ui.session.scene();
  const Conventions& conventions = ui.session.header().conventions;
  if (has_no_planes(ui)) return "empty: points on the screen have no near and no far plane";
  const double count = 1 + formulas::depths_between(scene, conventions, scene.camera.near, scene.camera.far);
  const std::string many = count < 1e9 ? grouped(std::llround(count)) : fmt::format("{:.1e}", count);
  return fmt::format("{} depths, half before z_v = {}", many, number(formulas::middle_depth(scene, conventions)));
}

bool serves_depth_units(const Header& header) { return records(header, AtPixel::verdict); }

}  // namespace

const Pane depth_units_pane{"depth_units",
                            "DEPTHS OF THE BUFFER",
                            draw_depth_units,
                            note_of_depth_units,
                            serves_depth_units,
                            0.5f,
                            false,
                            nullptr,
                            true,
                            has_no_planes,
                            &depth_error_pane};

// The number of the depth buffer over the distance: between the planes, with the view depths that a stop is about.

namespace {

void draw_depth_curve(Ui& ui) {
  const Scene& scene = ui.session.scene();
  const Conventions& conventions = ui.session.header().conventions;
  if (has_no_planes(ui))
    return say_empty(ui, "Empty: this scene's points are on the screen already; it has no near and no far plane.");
  const double near = scene.camera.near, far = scene.camera.far, unit = depth_unit(scene, conventions);
  const double least = unit > 0 ? formulas::least_depth(scene, conventions.depth) : 0;
  const auto at = [&](double z_v) {
    const double z = buffer_depth(scene.camera, conventions, z_v);
    return glm::dvec2(z_v, unit > 0 ? (z - least) / unit : z);
  };
  const auto mark = [&](const char* name, double z_v) {
    const double z = at(z_v).y;
    return LineChart::Now{at(z_v),
                          fmt::format("{}{} \u2192 {}", name, number(z_v), unit > 0 ? number(z, 0) : number(z))};
  };
  LineChart chart;
  chart.scale = LineChart::Scale::linear;
  const std::string z = depth_symbol(scene, conventions);
  constexpr int steps = 16;  // as four bits have numbers
  chart.y_title = fmt::format("{}{}", z, unit > 0 ? " in units" : "");
  chart.x_title = "z_v";
  chart.x_reach = {near, far}, chart.y_reach = {at(near).y, at(far).y};
  chart.now = {mark("near ", near), mark("far ", far)};
  if (!ui.session.question_open()) {  // the curve is the answer
    for (int step = 0; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps, number = at(near).y + share * (at(far).y - at(near).y);
      const double z_v = view_depth(scene.camera, conventions, unit > 0 ? least + number * unit : number);
      chart.led.emplace_back(std::clamp(z_v, near, far), number);
    }
    LineChart::Line line{"", {}, false, LineChart::plain_look, true};
    constexpr int points = 200;
    for (int k = 0; k <= points; ++k) line.points.push_back(at(near * portable::pow(far / near, 1.0 * k / points)));
    chart.lines.push_back(std::move(line));
    chart.y_title += fmt::format("; thin lines: {} equal steps of it", steps);
    for (const double z_v : depths_to_mark(ui)) chart.now.push_back(mark("", z_v));
  }
  draw_line_chart(ui, "depth curve", chart);
  if (ImGui::IsWindowHovered())
    ui.mouse_help = "Which number the depth buffer has for each distance from the eye, near to far.";
}

std::string note_of_depth_curve(Ui& ui) {
  if (has_no_planes(ui)) return "empty: points on the screen have no near and no far plane";
  return fmt::format("{} over z_v", depth_symbol(ui.session.scene(), ui.session.header().conventions));
}

bool serves_depth_curve(const Header& header) { return depth_pane_of(header) != nullptr; }

}  // namespace

const Pane depth_curve_pane{
    "depth_curve", "DEPTH CURVE", draw_depth_curve, note_of_depth_curve, serves_depth_curve, 0.5f, false,
    nullptr,       true,          has_no_planes,    &depth_units_pane};

// How errors of depth add up: along the span at work, and along its left edge. What rounding alone does: each depth is
// held against what its own formula gives without any.

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

bool serves_depth_error(const Header& header) { return records<SpanBegin>(header) && records(header, AtPixel::depth); }

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
                            waits_for_depths};

// The shadow buffer: depths as the light sees them, with the place of the point under test.

namespace {

/// The range of the light's depths at this step: near is bright, as in the depth buffer.
void color_light(Cells& cells, const Moment& now, const DepthScale& scale) {
  color_depths_of(cells, now.state().light, fitted_range(now.state().light, now.header()), scale);
}
void paint_shadow_buffer(Canvas& canvas, const RasterMap& map, const Kept<Cells>& cells, const Theme& c) {
  paint_raster(canvas, map, cells.made.colors,
               {to_pixel(c.pane), to_pixel(c.grid), to_pixel(c.empty), to_pixel(c.empty_hatch)});
}

/// A pixel of the shadow buffer that a point was held against.
struct HeldAgainst {
  double column, row;
  bool lit;
  bool on(const RasterMap& map) const { return column >= 0 && column < map.width && row >= 0 && row < map.height; }
};
HeldAgainst held_against(const ShadowCompare& at) { return {std::round(at.x_light), std::round(at.y_light), at.lit}; }
/// The one that the step at work is about: a neighbour, or where the point lies.
HeldAgainst held_now(const MethodState& machine, const Moment& now) {
  const auto* neighbour = now.event() ? get_if<ShadowNeighbour>(&now.event()->event) : nullptr;
  if (neighbour)
    return {static_cast<double>(neighbour->x_shadow), static_cast<double>(neighbour->y_shadow), neighbour->lit};
  return held_against(*machine.shadow);
}

/// A ring of two colours round the cell: it shows on every depth.
void mark_point(Ui& ui, const RasterMap& map, ImVec2 origin, const HeldAgainst& at) {
  if (!at.on(map)) return;
  const float half = static_cast<float>(std::max(map.cell / 2, 4.0));
  const ImVec2 centre = moved_by(origin, map.px(at.column), map.py(at.row));
  frame_box(ui, {centre.x - half - 2, centre.y - half - 2}, {centre.x + half + 2, centre.y + half + 2},
            IM_COL32(255, 255, 255, 255), 2);
  frame_box(ui, {centre.x - half, centre.y - half}, {centre.x + half, centre.y + half}, ui.colors().now, 2);
}
/// What a compare said, where several count: a white dot for lit, a black one for dark.
void mark_outcome(const RasterMap& map, ImVec2 origin, const HeldAgainst& at) {
  if (!at.on(map)) return;
  const float size = static_cast<float>(std::max(map.cell / 5, 2.0));
  const ImVec2 centre = moved_by(origin, map.px(at.column), map.py(at.row));
  const ImU32 white = IM_COL32(255, 255, 255, 255), black = IM_COL32(0, 0, 0, 255);
  fill_circle(ImGui::GetWindowDrawList(), centre, size + 1.5f, at.lit ? black : white);
  fill_circle(ImGui::GetWindowDrawList(), centre, size, at.lit ? white : black);
}

std::string verdict(const HeldAgainst& at, const State& state) {
  if (!(at.column >= 0 && at.column < state.light.width && at.row >= 0 && at.row < state.light.height))
    return "beside the light's window: dark";
  const double stored =
      state.light.depth[state.light.at(static_cast<std::int32_t>(at.column), static_cast<std::int32_t>(at.row))];
  const auto [z, shadow] = tell_apart(state.machine.shadow->z_light, stored);
  return fmt::format("pixel ({}, {}): stored {}, point {}: {}", at.column, at.row, shadow, z, at.lit ? "lit" : "dark");
}

/// The pixels of the shadow buffer that count for the point at work, and which of them the step is about.
void mark_held(Ui& ui, const RasterMap& map, ImVec2 origin) {
  if (ui.still) return;
  const MethodState& machine = ui.session.state().machine;
  if (!machine.neighbours.empty()) mark_outcome(map, origin, held_against(*machine.shadow));
  for (const ShadowNeighbour& one : machine.neighbours)
    mark_outcome(map, origin, {static_cast<double>(one.x_shadow), static_cast<double>(one.y_shadow), one.lit});
  mark_point(ui, map, origin, held_now(machine, ui.moment()));
}

void draw_shadow_buffer(Ui& ui) {
  const State& state = ui.session.state();
  if (state.machine.pass == Pass::light)
    return say_empty(ui, "The light's picture is being made; it stands where the eye's will.");
  if (state.light.depth.empty()) return say_empty(ui, "Empty: the light has not looked yet.");
  const ImVec2 room = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorScreenPos();
  const float caption = (room.x > 30 * ui.em ? 1.4f : 2.4f) * ui.line();
  const Rulers rulers = room_for_rulers(ui, ui.session.scene().raster);
  const int width = static_cast<int>(room.x - rulers.left), height = static_cast<int>(room.y - caption - rulers.below);
  if (width < 16 || height < 16) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const RasterMap map(Raster{state.light.width, state.light.height, false}, {}, width, height);
  const Kept<Cells>& cells = *keep(ui.cells, "shadow", color_light, ui.moment(), ui.depth_scale);
  const Kept<Canvas>& canvas =
      *keep_canvas(ui.canvases, "shadow", width, height, paint_shadow_buffer, map, cells, ui.colors());
  const ImVec2 at{corner.x + rulers.left, corner.y};
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas.made), at,
                                       {at.x + to_float(width), at.y + to_float(height)});
  draw_numbers(ui, map, at, cells.made,
               [&](std::size_t pixel, int shown) { return number(state.light.depth[pixel], shown); });
  const bool still = std::exchange(ui.still, true);  // the scan line at work is the eye's
  draw_rulers(ui, map, at, rulers);
  ui.still = still;
  ImGui::Dummy({room.x, to_float(height) + rulers.below});
  // Of the point that is looked at, not of the one before it.
  const auto cell = ui.session.cell_looked_at();
  const bool to_come = ui.moment().event() && holds<ShadowBias>(ui.moment().event()->event);
  const auto& held = state.machine.shadow;
  if (!held || to_come || ui.still || !cell || held->x != cell->x || held->y != cell->y) return;
  mark_held(ui, map, at);
  const auto& share = state.machine.light_share;
  const bool shared = share && share->x == state.machine.shadow->x && share->y == state.machine.shadow->y;
  const ImVec2 below = ImGui::GetCursorScreenPos();
  flow(ui,
       shared ? fmt::format("share of light {}", number(share->share))
              : verdict(held_now(state.machine, ui.moment()), state),
       {ui.colors().text, 0, ui.fonts.small, 0});
  const std::int64_t here = ui.session.position();
  number_at(ui, below, {below.x + room.x, ImGui::GetCursorScreenPos().y},
            shared                              ? answers::made_by<LightShare>(here, "share")
            : !state.machine.neighbours.empty() ? answers::made_by<ShadowNeighbour>(here, "lit")
                                                : answers::made_by<ShadowCompare>(here, "lit"));
}

std::string note_of_shadow_buffer(Ui& ui) { return ui.session.state().machine.shadow ? "what the light sees" : ""; }

bool serves_shadow_buffer(const Header& header) { return records<ShadowCompare>(header); }

}  // namespace

const Pane shadow_buffer_pane{
    "shadow_buffer", "SHADOW BUFFER", draw_shadow_buffer,     note_of_shadow_buffer, serves_shadow_buffer, 0.5f, false,
    always<15>,      false,           none_yet<ShadowCompare>};

}  // namespace zstep::viewer
