// Which depths the depth buffer can hold between the near plane and the far one: how far apart they are, and how far
// apart at the pixel at work.
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/panes/chart_picture.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/numbers.hpp"
#include "traces/formulas/resolution.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
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
    chart.lines[i].look = i == 0 ? LineChart::plain_look : static_cast<int>(i);
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
  if (const auto z_v = depth_now(ui)) {
    const double unit = formulas::resolution(scene, conventions, *z_v);
    if (unit > 0) chart.now.push_back({{*z_v, unit}, fmt::format("z_v = {}: {}", number(*z_v), number(unit))});
  }
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

bool serves_depth_units(const Header& header) { return has_step_of<DepthCompare>(header); }

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

}  // namespace zstep::viewer
