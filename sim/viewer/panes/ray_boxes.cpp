// The boxes and cells that a ray is held against, on the plan of rays.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/ray_plan.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

std::array<ImVec2, 4> corners_of(const PlanOfRays& plan, const BoxMake& b) {
  return {plan.place({b.x_min, b.y_min, b.z_min}), plan.place({b.x_max, b.y_min, b.z_min}),
          plan.place({b.x_max, b.y_max, b.z_max}), plan.place({b.x_min, b.y_max, b.z_max})};
}

/// For which t the ray is within each slab of a box, and within all: bars below each other, in a corner of the pane
/// that is free; nothing where none is.
void draw_intervals(const Ui& ui, const PlanOfRays& plan, const BoxTest& test, const RayBegin& ray, const BoxMake& box,
                    WordPlaces& words) {
  const glm::dvec3 from = from_of(ray), along = along_of(ray);
  const glm::dvec3 a = (glm::dvec3(box.x_min, box.y_min, box.z_min) - from) / along,
                   b = (glm::dvec3(box.x_max, box.y_max, box.z_max) - from) / along;
  const glm::dvec3 enters = glm::min(a, b), leaves = glm::max(a, b);
  const double last = std::max({enters.x, enters.y, enters.z, test.t_leave}) * 1.15;
  const double first = std::min({0.0, leaves.x, leaves.y, leaves.z}) - 0.1 * last;
  if (!std::isfinite(glm::dot(enters, leaves)) || !(last > 0) || !std::isfinite(first)) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 low = list->GetClipRectMin(), high = list->GetClipRectMax();
  const ImVec2 size{17 * ui.em, 4.5f * ui.line()}, edge{0.6f * ui.em, 0.4f * ui.em};
  WordPlaces probe = words;  // its outline is no place for bars
  for (const std::array corners{corners_of(plan, box)}; const int k : {0, 1, 2, 3})
    probe.keep_line_free(corners.at(k), corners.at((k + 1) % 4));
  for (const float x : {low.x + edge.x, high.x - size.x - edge.x})
    for (const float y : {high.y - size.y - edge.y, low.y + edge.y}) {
      if (x < low.x || y < low.y || !probe.taken.free({x, y}, size)) continue;
      words.taken.take({x, y}, size);
      const Theme& c = ui.colors();
      const float left = x + 2.5f * ui.em, width = 7.5f * ui.em;
      const auto at = [&](double t) {
        return left + width * static_cast<float>((std::clamp(t, first, last) - first) / (last - first));
      };
      for (const double t : {0.0, test.t_enter, test.t_leave})
        if (t > first && t < last)
          stroke_dashed(list, {at(t), y}, {at(t), y + 4 * ui.line()}, t == 0 ? c.muted : c.now, ui.thin);
      draw_text(ui, {at(0) - 1.2f * ui.em, y + 4 * ui.line() - 0.2f * ui.em}, ui.fonts.small, c.muted, "t = 0");
      for (int k = 0; k < 4; ++k) {
        const bool all = k == 3;
        const double t_enter = all ? test.t_enter : enters[k], t_leave = all ? test.t_leave : leaves[k];
        const ImU32 color = all ? c.now : c.changed;
        const float top = y + to_float(k) * ui.line();
        draw_text(ui, {x, top}, ui.fonts.small, color, all ? "box" : std::string(1, "xyz"[k]));
        draw_text(
            ui, {left + width + 0.5f * ui.em, top}, ui.fonts.small, color,
            all && t_enter > t_leave ? "none" : fmt::format("{} \u2013 {}", number(t_enter, 2), number(t_leave, 2)));
        if (t_enter <= t_leave)
          list->AddRectFilled({at(t_enter), top + 0.3f * ui.line()},
                              {std::max(at(t_leave), at(t_enter) + 2 * ui.thin), top + 0.65f * ui.line()}, color);
      }
      return;
    }
}

}  // namespace

bool shows_boxes(const Ui& ui) {
  const Session& s = ui.session;
  if (!s.lesson() || ui.laboratory) return true;
  const auto tests_one = [&](const Stop& stop) {
    return std::any_of(s.header().page.begin(), s.header().page.end(), [&](const StepInfo& step) {
      return (step.kind == kind_of<BoxTest> || step.kind == kind_of<CellVisit>)&&stop.anchor.find(step.name) !=
             std::string::npos;
    });
  };
  const auto& stops = s.lesson()->stops;
  const auto first = std::find_if(stops.begin(), stops.end(), tests_one);
  return first == stops.end() || s.stop() >= first - stops.begin();
}

void draw_boxes(const Ui& ui, const PlanOfRays& plan) {
  const MethodState& machine = ui.session.state().machine;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  constexpr std::size_t most_drawn = 400;
  if (machine.boxes.size() <= most_drawn)
    for (const BoxRow& row : machine.boxes) stroke_lines(list, corners_of(plan, row.entry), c.muted, ui.thin, true);
  if (ui.still) return;
  const RecordedEvent* event = ui.session.event();
  for (const bool hit : {true, false})
    for (const BoxTest& test : machine.rays.boxes) {
      if (test.hit != hit || test.box < 0 || test.box >= std::ssize(machine.boxes)) continue;
      const std::array corners = corners_of(plan, machine.boxes[static_cast<std::size_t>(test.box)].entry);
      const bool now =
          event && !ui.moment().asked() && holds<BoxTest>(event->event) && &test == &machine.rays.boxes.back();
      const ImU32 color = now ? c.now : hit ? c.selected : c.text;
      if (hit) stroke_lines(list, corners, color, 2.5f * ui.thin, true);
      for (std::size_t k = 0; k < 4 && !hit; ++k) {
        stroke_line(list, corners[k], corners[(k + 1) % 4], c.pane, 3.5f * ui.thin);
        stroke_dashed(list, corners[k], corners[(k + 1) % 4], color, 2 * ui.thin);
      }
    }
}

void name_boxes(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
  const MethodState& machine = ui.session.state().machine;
  constexpr std::size_t most_named = 8;
  if (machine.rays.boxes.size() > most_named) return;
  const RecordedEvent* const event = ui.session.event();
  const BoxTest* const now = event ? get_if<BoxTest>(&event->event) : nullptr;  // with those in it
  for (const BoxRow& row : machine.boxes) {
    const auto is_it = [&](const BoxTest& test) { return test.box == row.entry.box; };
    if (std::none_of(machine.rays.boxes.begin(), machine.rays.boxes.end(), is_it) &&
        !(now && row.entry.parent == now->box))
      continue;
    const std::array corners = corners_of(plan, row.entry);
    const std::string name = fmt::format("box {}", row.entry.box);
    const ImVec2 size = text_size(ui, ui.fonts.small, name);
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x, corners[3].x});
    const auto [top, end] = std::minmax({corners[0].y, corners[1].y, corners[2].y, corners[3].y});
    std::vector<ImVec2> places;
    if (end - top < 2 * size.y)
      places = {{right - size.x * 0.65f, top - size.y * 0.75f}, {right + size.x * 0.65f, (top + end) / 2}};
    for (const float inside : {1.0f, -1.0f})
      for (const float y : {end - inside * size.y * 0.75f, top + inside * size.y * 0.75f})
        for (const float x : {right - size.x * 0.65f, left + size.x * 0.65f}) places.push_back({x, y});
    words.put(name, ui.colors().text, ui.fonts.small, places);
  }
}

void draw_slabs(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
  const Session& s = ui.session;
  const Moment now = ui.moment();
  const MethodState& machine = s.state().machine;
  const Event* step = now.asked() ? now.asked() : s.event() ? &s.event()->event : nullptr;
  const auto* test = step && now.told() ? get_if<BoxTest>(step) : nullptr;
  const RayBegin* const ray = ray_in(machine.rays);
  if (!test || test->box < 0 || test->box >= std::ssize(machine.boxes) || !ray) return;
  const BoxMake& box = machine.boxes[static_cast<std::size_t>(test->box)].entry;
  const glm::dvec3 from = from_of(*ray), along = along_of(*ray);
  const glm::dvec3 low(box.x_min, box.y_min, box.z_min), high(box.x_max, box.y_max, box.z_max);
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (now.asked()) stroke_lines(list, corners_of(plan, box), c.now, 2.5f * ui.thin, true);
  const double beyond =
      std::max({0.25 * (high[0] - low[0]), 0.25 * (high[1] - low[1]), 2 * static_cast<double>(ui.em) / plan.scale()});
  std::array<std::vector<double>, 2> times;
  for (int axis = 0; axis < 2; ++axis)
    for (const double border : {low[axis], high[axis]}) {
      glm::dvec3 a(0), b(0);
      a[axis] = b[axis] = border;
      for (const auto& [from_box, out] : {std::pair{low[1 - axis], -beyond}, {high[1 - axis], beyond}}) {
        a[1 - axis] = from_box, b[1 - axis] = from_box + out;
        stroke_dashed(list, plan.place(a), plan.place(b), c.changed, 1.5f * ui.thin);
        words.keep_line_free(plan.place(a), plan.place(b));
      }
      std::vector<double>& its = times[axis];
      const double t = along[axis] != 0 ? (border - from[axis]) / along[axis] : -1;
      if (t > 0 && (its.empty() || std::abs(its[0] - t) > 1e-6)) its.push_back(t);
    }
  for (const bool of_y : {false, true})
    for (const double t : times[of_y]) {
      const ImVec2 at = plan.place(from + t * along);
      fill_circle(list, at, std::round(0.22f * ui.em), c.changed);
      words.around(fmt::format("{} {}", of_y ? "y" : "x", number(t, 2, true)), c.changed, ui.fonts.small, at,
                   {1, of_y ? 1 : -1});
    }
  if (now.asked()) words.around(fmt::format("box {}", test->box), c.now, ui.fonts.small, plan.place(low), {-1, 0.6});
  else draw_intervals(ui, plan, *test, *ray, box, words);
}

void draw_cells(const Ui& ui, const PlanOfRays& plan) {
  const MethodState& machine = ui.session.state().machine;
  if (!machine.grid) return;
  const Theme& c = ui.colors();
  const GridMake& g = *machine.grid;
  const glm::dvec3 low(g.x_min, g.y_min, g.z_min);
  const glm::dvec3 cell((g.x_max - g.x_min) / g.cells_x, (g.y_max - g.y_min) / g.cells_y,
                        (g.z_max - g.z_min) / g.cells_z);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto corner = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return plan.place(low + cell * glm::dvec3(x, y, z));
  };
  const auto outline = [&](const CellVisit& visit, std::array<ImVec2, 4>& corners) {
    const std::int32_t x = visit.cell_x, y = visit.cell_y, z = visit.cell_z;
    corners = {corner(x, y, z), corner(x + 1, y, z), corner(x + 1, y + 1, z), corner(x, y + 1, z)};
  };
  std::array<ImVec2, 4> corners;
  for (const CellVisit& visit : machine.rays.cells) {
    outline(visit, corners);
    list->AddConvexPolyFilled(corners.data(), 4, c.selected_soft);
  }
  for (std::int32_t x = 0; x <= g.cells_x; ++x)
    stroke_line(list, corner(x, 0, 0), corner(x, g.cells_y, 0), c.muted, ui.thin);
  for (std::int32_t y = 0; y <= g.cells_y; ++y)
    stroke_line(list, corner(0, y, 0), corner(g.cells_x, y, 0), c.muted, ui.thin);
  for (const CellVisit& visit : machine.rays.cells) {
    outline(visit, corners);
    stroke_lines(list, corners, c.selected, 2 * ui.thin, true);
  }
}

}  // namespace zstep::viewer
