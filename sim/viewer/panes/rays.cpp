// The rays of the pixel at work, seen from above: through the boxes or cells that they are held against, to what they
// meet; and tables of their tests.

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "algorithms/ray_casting/geometry.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/plan_frame.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// From above: what lies away from the eye is drawn upwards, or to the right where the pane is wider than high. A
/// screen scene is seen along its rows: x and z.
class Plan {
 public:
  /// On the ray through this part of the window's half width from its middle, at this t.
  static glm::dvec3 on_window(const Scene& scene, double share, double t) {
    const Camera& camera = scene.camera;
    const double half = camera.window * scene.raster.width / scene.raster.height;
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(camera.view));
    return camera.eye + t * (to_world * glm::dvec3(share * half, 0, camera.d));
  }

  Plan(const Scene& scene, ImVec2 at, ImVec2 size, float margin)
      : screen_(scene.camera.kind == Camera::Kind::screen), wide_(size.x > size.y), at_(at) {
    const glm::dmat4& view = scene.camera.view;
    const glm::dvec2 away(view[0][2], view[1][2]), right(view[0][0], view[1][0]);
    if (glm::length(away) > 1e-6) away_ = glm::normalize(away);
    right_ = glm::length(right) > 1e-6 ? glm::normalize(right) : glm::dvec2(away_.y, -away_.x);
    for (const glm::dvec3& point : scene.points) include(flat(point));
    if (scene.camera.kind == Camera::Kind::perspective) include(flat(scene.camera.eye));
    if (scene.light) include(flat(scene.light->position));
    show_rays(scene);
    const glm::dvec2 span = glm::max(high_ - low_, glm::dvec2(1e-9));
    const glm::dvec2 pane(size.x, size.y);
    scale_ = std::min((pane.x - 2 * margin) / span.x, (pane.y - 2 * margin) / span.y);
    middle_ = 0.5 * (low_ + high_);
    half_ = 0.5 * pane;
  }

  glm::dvec2 flat(glm::dvec3 point) const {
    const double across = screen_ ? point.x : glm::dot(right_, glm::dvec2(point));
    const double away = screen_ ? point.z : glm::dot(away_, glm::dvec2(point));
    return wide_ ? glm::dvec2(away, -across) : glm::dvec2(across, away);
  }
  glm::dvec2 inside(glm::dvec3 point) const {
    const glm::dvec2 p = (flat(point) - middle_) * scale_;
    return {half_.x + p.x, half_.y - p.y};
  }
  ImVec2 place(glm::dvec3 point) const {
    const glm::dvec2 p = inside(point);
    return moved_by(at_, p.x, p.y);
  }
  ImVec2 at() const { return at_; }
  double scale() const { return scale_; }  ///< pixels of a unit
  /// Far enough for a ray that meets nothing to leave the pane.
  double farthest() const { return 2 * glm::length(high_ - low_) + 1; }

 private:
  /// What rays meet of planes lies beside polygons, too: as far as the outer rays reach, where that is not much
  /// farther.
  void show_rays(const Scene& scene) {
    const Camera& camera = scene.camera;
    if (camera.kind != Camera::Kind::perspective) return;
    const glm::dvec2 least = low_, most = high_, more = 0.05 * (high_ - low_);
    double deepest = 0;
    for (const glm::dvec3& point : scene.points)
      deepest = std::max(deepest, (glm::dmat3(camera.view) * (point - camera.eye)).z);
    for (const double side : {-1.0, 1.0})
      include(glm::clamp(flat(on_window(scene, side, deepest / std::max(1e-9, camera.d))), least - more, most + more));
  }
  void include(glm::dvec2 p) { low_ = glm::min(low_, p), high_ = glm::max(high_, p); }

  bool screen_, wide_;
  ImVec2 at_;
  glm::dvec2 right_{1, 0}, away_{0, 1}, middle_{0}, half_{0};
  glm::dvec2 low_{std::numeric_limits<double>::infinity()}, high_{-std::numeric_limits<double>::infinity()};
  double scale_ = 1;
};

std::array<ImVec2, 4> corners_of(const Plan& plan, const BoxMake& b) {
  return {plan.place({b.x_min, b.y_min, b.z_min}), plan.place({b.x_max, b.y_min, b.z_min}),
          plan.place({b.x_max, b.y_max, b.z_max}), plan.place({b.x_min, b.y_max, b.z_max})};
}

/// A lesson shows boxes and cells from its first stop on at which one is tested.
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

const RayBegin* ray_in(const RayWork& rays) {
  const auto row =
      std::find_if(rays.tree.begin(), rays.tree.end(), [&](const RayRow& one) { return one.entry.ray == rays.ray; });
  return row == rays.tree.end() ? nullptr : &row->entry;
}
glm::dvec3 from_of(const RayBegin& ray) { return {ray.x_0, ray.y_0, ray.z_0}; }
glm::dvec3 along_of(const RayBegin& ray) { return {ray.dir_x, ray.dir_y, ray.dir_z}; }

/// Those that the ray meets before what it has met are drawn through, the others dashed.
void draw_boxes(const Ui& ui, const Plan& plan) {
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

/// Of those that the ray was tested against, at their corners.
void name_boxes(const Ui& ui, const Plan& plan, WordPlaces& words) {
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

/// For which t the ray is within each slab of a box, and within all: bars below each other, in a corner of the pane
/// that is free; nothing where none is.
void draw_intervals(const Ui& ui, const Plan& plan, const BoxTest& test, const RayBegin& ray, const BoxMake& box,
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

/// Of the box that the ray is tested against, or that is asked for: its slabs along x and y, and on the ray with which
/// t it comes into each and out of it.
void draw_slabs(const Ui& ui, const Plan& plan, WordPlaces& words) {
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

/// The window on the projection plane, divided in columns of pixels; the one at work is marked.
void draw_window(const Ui& ui, const Plan& plan, WordPlaces& words) {
  const Session& s = ui.session;
  const Scene& scene = s.scene();
  if (scene.camera.kind != Camera::Kind::perspective) return;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const std::int32_t columns = std::max(1, scene.raster.width);
  const auto at = [&](std::int32_t border) {
    return plan.place(Plan::on_window(scene, 2.0 * border / columns - 1, 1));
  };
  const ImVec2 from = at(0), to = at(columns);
  stroke_line(list, from, to, c.text, 1.5f * ui.thin);
  const float length = portable::length(to.x - from.x, to.y - from.y), tick = std::round(0.25f * ui.em);
  if (!(length > 0)) return;
  const ImVec2 across{(to.y - from.y) / length * tick, (from.x - to.x) / length * tick};
  for (std::int32_t k = 0; k <= columns && length / to_float(columns) >= 4; ++k) {
    const ImVec2 border = at(k);
    stroke_line(list, {border.x - across.x, border.y - across.y}, {border.x + across.x, border.y + across.y}, c.text,
                1.5f * ui.thin);
  }
  const auto& tree = s.state().machine.rays.tree;
  if (!tree.empty()) stroke_line(list, at(tree.front().entry.x), at(tree.front().entry.x + 1), c.now, 4 * ui.thin);
  words.keep_line_free(from, to);
}

void draw_cells(const Ui& ui, const Plan& plan) {
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

/// The facets that the mark is for as thick lines.
void mark_facet(const Ui& ui, const Plan& plan, std::int32_t number, ImU32 color, float thickness) {
  const Scene& scene = ui.session.scene();
  if (number < 0 || number >= std::ssize(scene.facets)) return;
  const Facet& facet = scene.facets[number];
  for (std::int32_t k = 0; k < facet.corner_count; ++k) {
    const auto corner = [&](std::int32_t i) {
      return scene.points[scene.corners[facet.first_corner + i % facet.corner_count]];
    };
    stroke_line(ImGui::GetWindowDrawList(), plan.place(corner(k)), plan.place(corner(k + 1)), color,
                thickness * ui.thin);
  }
}

/// The ends of a facet that is seen from its edge.
std::optional<std::array<glm::dvec2, 2>> edge_of(const Plan& plan, const Scene& scene, std::int32_t number) {
  if (number < 0 || number >= std::ssize(scene.facets)) return std::nullopt;
  const Facet& facet = scene.facets[number];
  std::vector<glm::dvec2> corners;
  for (std::int32_t k = 0; k < facet.corner_count; ++k)
    corners.push_back(plan.inside(scene.points[scene.corners[facet.first_corner + k]]));
  if (corners.empty()) return std::nullopt;
  const auto farthest = [&](glm::dvec2 p) {
    return *std::max_element(corners.begin(), corners.end(),
                             [&](glm::dvec2 a, glm::dvec2 b) { return glm::length(a - p) < glm::length(b - p); });
  };
  const glm::dvec2 end = farthest(corners[0]), other = farthest(end), way = end - other;
  for (const glm::dvec2 p : corners)
    if (!(std::abs(way.x * (p.y - other.y) - way.y * (p.x - other.x)) < 0.5 * glm::length(way))) return std::nullopt;
  return std::array{other, end};
}

/// The plane of a facet that is seen from its edge: beside the facet, as far as the pane goes or to a point.
void draw_plane(const Ui& ui, const Plan& plan, std::int32_t facet, const std::optional<glm::dvec3>& to) {
  const auto ends = edge_of(plan, ui.session.scene(), facet);
  if (!ends) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 corner = plan.at(), low = list->GetClipRectMin(), high = list->GetClipRectMax();
  for (const auto& [from, out] : {std::pair{(*ends)[0], (*ends)[1]}, {(*ends)[1], (*ends)[0]}}) {
    const glm::dvec2 way = from - out;
    const auto part =
        part_within(glm::dvec2(low.x - corner.x, low.y - corner.y), glm::dvec2(high.x - corner.x, high.y - corner.y),
                    from, way, 0, std::numeric_limits<double>::max());
    if (!part) continue;
    const double share =
        std::min(part->second, to ? glm::dot(plan.inside(*to) - from, way) / glm::dot(way, way) : part->second);
    if (share * glm::length(way) > 2)
      stroke_dashed(list, moved_by(corner, from.x, from.y),
                    moved_by(corner, from.x + share * way.x, from.y + share * way.y), ui.colors().now, 1.5f * ui.thin);
  }
}

/// One that lies in the line of later ones is drawn wider, and so is seen on both sides of them.
float thickness_of(const Plan& plan, const Scene& scene, std::int32_t facet) {
  float thickness = 3;
  const auto ends = edge_of(plan, scene, facet);
  for (std::int32_t other = facet + 1; ends && other < std::ssize(scene.facets); ++other) {
    const auto its = edge_of(plan, scene, other);
    if (!its) continue;
    const glm::dvec2 way = (*ends)[1] - (*ends)[0];
    const auto along = [&](glm::dvec2 p) { return glm::dot(p - (*ends)[0], way) / glm::dot(way, way); };
    const auto [low, high] = std::minmax({along((*its)[0]), along((*its)[1])});
    const auto lies_in_it = [&](glm::dvec2 p) { return glm::length((*ends)[0] + along(p) * way - p) < 1; };
    if (std::all_of(its->begin(), its->end(), lies_in_it) && low < 1 && high > 0) thickness += 5;
  }
  return thickness;
}

void draw_facets(const Ui& ui, const Plan& plan) {
  const Scene& scene = ui.session.scene();
  constexpr std::size_t most_drawn = 4000;
  const std::size_t step = 1 + scene.facets.size() / most_drawn;
  for (std::size_t i = 0; i < scene.facets.size(); i += step) {
    const Polygon& polygon = scene.polygons[scene.facets[i].polygon];
    mark_facet(ui, plan, index32(i), scene.facets.size() > 200 ? ui.colors().muted : to_im(opaque(polygon.color)),
               scene.facets.size() > 200  ? 1.0f
               : scene.facets.size() > 16 ? 3.0f
                                          : thickness_of(plan, scene, index32(i)));
  }
}

/// Letters beside their facets.
void draw_names(const Ui& ui, const Plan& plan, WordPlaces& words) {
  const Scene& scene = ui.session.scene();
  if (scene.facets.size() > 16) return;
  const auto each = [&](auto&& use) {
    for (const Facet& facet : scene.facets) {
      std::vector<ImVec2> corners;
      for (std::int32_t k = 0; k < facet.corner_count; ++k)
        corners.push_back(plan.place(scene.points[scene.corners[facet.first_corner + k]]));
      // Seen from its edge it is as long as this.
      const auto away = [&](ImVec2 p) { return portable::length(p.x - corners[0].x, p.y - corners[0].y); };
      use(facet, corners[0],
          *std::max_element(corners.begin(), corners.end(), [&](ImVec2 a, ImVec2 b) { return away(a) < away(b); }));
    }
  };
  each([&](const Facet&, ImVec2 from, ImVec2 to) { words.keep_line_free(from, to); });
  each([&](const Facet& facet, ImVec2 from, ImVec2 to) {
    const glm::dvec2 along(to.x - from.x, to.y - from.y);
    const std::string name = polygon_label(scene, facet.polygon);
    const glm::dvec2 out = along.x < 0 ? glm::dvec2(-along.y, along.x) : glm::dvec2(along.y, -along.x);
    if (!words.beside(name, ui.colors().text, ui.fonts.bold, from, to, out))
      words.around(name, ui.colors().text, ui.fonts.bold, {(from.x + to.x) / 2, (from.y + to.y) / 2}, out);
  });
}

/// The ray that the step is about: where one ends, that one, though the run is back at its parent.
std::optional<std::int32_t> ray_now(const Session& s) {
  const RayEnd* end = s.event() ? get_if<RayEnd>(&s.event()->event) : nullptr;
  return end ? std::optional(end->ray) : s.state().machine.rays.ray;
}

/// Where a ray that is still waiting met something: its first child begins there.
const RayBegin* first_child(const RayWork& rays, std::int32_t ray) {
  for (const RayRow& row : rays.tree)
    if (row.entry.parent == ray) return &row.entry;
  return nullptr;
}

void draw_rays(Ui& ui, const Plan& plan, WordPlaces& words) {
  const MethodState& machine = ui.session.state().machine;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (const RayRow& row : machine.rays.tree) {
    const RayBegin& ray = row.entry;
    const glm::dvec3 from(ray.x_0, ray.y_0, ray.z_0), along(ray.dir_x, ray.dir_y, ray.dir_z);
    const bool now = ray_now(ui.session) == ray.ray;
    const bool met = row.end && row.end->nearest_facet >= 0;
    const double speed = std::max(1e-12, glm::length(along));
    const double t_end = met ? row.end->t : ray.role == RayRole::shadow ? 1 : plan.farthest() / speed;
    const RayBegin* child = row.end ? nullptr : first_child(machine.rays, ray.ray);
    const ImVec2 a = plan.place(from);
    ImVec2 b = plan.place(child ? glm::dvec3(child->x_0, child->y_0, child->z_0) : from + t_end * along);
    const RayBegin* begins = ui.session.event() ? get_if<RayBegin>(&ui.session.event()->event) : nullptr;
    if (begins && begins->ray == ray.ray && ui.arrived < 1) {  // it travels
      const double share = ui.on_way();
      b = moved_by(a, (b.x - a.x) * share, (b.y - a.y) * share);
    }
    const ImU32 color = now ? c.now : c.text;
    if (ray.role == RayRole::shadow || (!met && !child))
      stroke_dashed(list, a, b, color, (now ? 2.0f : 1.2f) * ui.thin);
    else stroke_line(list, a, b, color, (now ? 2.5f : 1.5f) * ui.thin);
    if (met || child) fill_circle(list, b, 4, color);
    words.keep_line_free(a, b);
  }
  const float reach = std::round(0.35f * ui.em);
  std::vector<RayHit> hits = machine.rays.hits;  // none of those inside lies under a cross
  std::stable_partition(hits.begin(), hits.end(), [](const RayHit& hit) { return !hit.inside; });
  for (const RayHit& hit : hits) {
    const ImVec2 p = plan.place({hit.x_hit, hit.y_hit, hit.z_hit});
    if (hit.inside) {
      fill_circle(list, p, reach, hit.nearest ? c.now : c.pane);
      stroke_circle(list, p, reach, c.now, 1.5f * ui.thin);
    } else {
      for (const auto& [color, thick] : {std::pair{c.pane, 5.0f}, {c.text, 2.5f}})
        for (const float down : {reach, -reach})
          stroke_line(list, {p.x - reach, p.y - down}, {p.x + reach, p.y + down}, color, thick * ui.thin);
    }
    words.taken.take({p.x - reach, p.y - reach}, {2 * reach, 2 * reach});
  }
}

/// The normal at a point of some facet, of length 1, against this direction; none where the point lies on no facet.
std::optional<glm::dvec3> normal_at(const Scene& scene, glm::dvec3 point, glm::dvec3 direction) {
  constexpr double near_enough = 1e-6;  // of the scene's size: rays set out a little off what they meet
  std::optional<glm::dvec3> found;
  double least = 0;
  for (const glm::dvec3& p : scene.points) least = std::max(least, near_enough * glm::length(p - scene.points[0]));
  for (const Facet& facet : scene.facets) {
    const auto corner = [&](std::int32_t k) {
      return scene.points[scene.corners[facet.first_corner + k % facet.corner_count]];
    };
    glm::dvec3 area(0), low = corner(0), high = low;
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      area += glm::cross(corner(k) - corner(0), corner(k + 1) - corner(0));
      low = glm::min(low, corner(k)), high = glm::max(high, corner(k));
    }
    if (!(glm::length(area) > 0)) continue;
    const glm::dvec3 normal = glm::normalize(area);
    const double away = std::abs(glm::dot(normal, point - corner(0)));
    if (away > least || glm::any(glm::lessThan(point, low - least)) || glm::any(glm::greaterThan(point, high + least)))
      continue;
    least = away, found = glm::dot(normal, direction) > 0 ? -normal : normal;
  }
  return found;
}

void draw_arrow(ImDrawList* list, ImVec2 from, ImVec2 to, ImU32 color, float thin) {
  const glm::dvec2 way(to.x - from.x, to.y - from.y);
  const double length = glm::length(way), head = 7.0 * static_cast<double>(thin);
  stroke_line(list, from, to, color, 2 * thin);
  if (length < head) return;
  const glm::dvec2 along = way / length, across(-along.y, along.x);
  for (const double sign : {-0.5, 0.5}) {
    const glm::dvec2 wing = -head * along + sign * head * across;
    stroke_line(list, to, moved_by(to, wing.x, wing.y), color, 2 * thin);
  }
}

/// Where a ray is mirrored or transmitted: the normal N and the directions D and R or T, with their angles to it; where
/// one meets what may do so, the hit X with D and N.
void draw_law(const Ui& ui, const Plan& plan, WordPlaces& words) {
  const Session& s = ui.session;
  const RayBegin* ray = s.event() ? get_if<RayBegin>(&s.event()->event) : nullptr;
  const RayWork& work = s.state().machine.rays;
  const RayHit* met = s.event() ? get_if<RayHit>(&s.event()->event) : nullptr;
  if (met && (!met->nearest || !records<ColorWrite>(s.header()))) met = nullptr;
  if (!met && (!ray || (ray->role != RayRole::reflected && ray->role != RayRole::transmitted))) return;
  const auto arrives = std::find_if(work.tree.begin(), work.tree.end(), [&](const RayRow& row) {
    return row.entry.ray == (ray ? ray->parent : work.ray.value_or(-1));
  });
  if (arrives == work.tree.end()) return;
  const glm::dvec3 came(arrives->entry.dir_x, arrives->entry.dir_y, arrives->entry.dir_z);
  const glm::dvec3 hit =
      ray ? glm::dvec3(ray->x_0, ray->y_0, ray->z_0) : glm::dvec3(met->x_hit, met->y_hit, met->z_hit);
  const glm::dvec3 goes = ray ? glm::dvec3(ray->dir_x, ray->dir_y, ray->dir_z) : -came;
  if (!(glm::length(goes) > 0) || !(glm::length(came) > 0)) return;
  const auto normal = normal_at(s.scene(), hit, came);
  if (!normal) return;
  const bool mirrored = !ray || ray->role == RayRole::reflected;
  const glm::dvec3 out = glm::normalize(goes), back = -glm::normalize(came), side = mirrored ? *normal : -*normal;
  const ImVec2 foot = plan.place(hit);
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto tip_of = [&](glm::dvec3 direction, double ems) {
    const double size = ems * static_cast<double>(ui.em) / plan.scale();
    return plan.place(hit + size * direction);
  };
  const auto name = [&](const char* word, ImVec2 at, ImU32 color) {
    words.around(word, color, ui.fonts.bold, at, {at.x - foot.x, at.y - foot.y});
  };
  if (!mirrored) stroke_dashed(list, foot, tip_of(side, 3.5), c.muted, 1.5f * ui.thin);
  draw_arrow(list, foot, tip_of(*normal, 3.5), c.text, ui.thin);
  draw_arrow(list, tip_of(back, 5), foot, c.text, ui.thin);
  name("N", tip_of(*normal, 3.5), c.text);
  name("D", tip_of(back, 5), c.text);
  words.keep_line_free(foot, tip_of(*normal, 3.5));
  words.keep_line_free(foot, tip_of(back, 5));
  if (!ray) return name("X", tip_of(-*normal, 0.4), c.now);
  draw_arrow(list, foot, tip_of(out, 3), c.now, ui.thin);
  name(mirrored ? "R" : "T", tip_of(out, 3), c.now);
  int which = 0;
  for (const auto& [from, to] : {std::pair{*normal, back}, {side, out}}) {
    ++which;
    constexpr double seen_apart = 0.998;  // cosine of 3.6 degrees
    if (glm::dot(from, to) > seen_apart) continue;
    constexpr int parts = 12;
    const auto point = [&, one = from, other = to](int k) {
      const glm::dvec3 between = glm::mix(one, other, static_cast<double>(k) / parts);
      return tip_of(between / std::max(1e-9, glm::length(between)), 1.6);
    };
    for (int k = 0; k < parts; ++k) stroke_line(list, point(k), point(k + 1), c.muted, 1.5f * ui.thin);
    const ImVec2 middle = point(parts / 2);
    if (!mirrored)
      words.around(which == 1 ? "a\u2081" : "a\u2082", c.text, ui.fonts.text, middle,
                   {middle.x - foot.x, middle.y - foot.y});
  }
}

/// Where the pixels that the stop of a lesson marks are seen, and the ends of the polygons that it labels.
void draw_lines_of_sight(const Ui& ui, const Plan& plan, WordPlaces& words) {
  const Stop* const told = ui.moment().told();
  const Scene& scene = ui.session.scene();
  if (!told || scene.camera.kind != Camera::Kind::perspective) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto line = [&](glm::dvec3 along) {
    const double t = plan.farthest() / std::max(1e-12, glm::length(along));
    const ImVec2 from = plan.place(scene.camera.eye), to = plan.place(scene.camera.eye + t * along);
    stroke_line(list, from, to, ui.colors().muted, ui.thin);
    const ImVec2 low = list->GetClipRectMin(), high = list->GetClipRectMax();
    const glm::dvec2 first(from.x, from.y), way(to.x - from.x, to.y - from.y);
    const double end =
        part_within({low.x, low.y}, {high.x, high.y}, first, way, 0, 1).value_or(std::pair{0.0, 1.0}).second;
    return std::pair{moved_by(from, 0.6 * end * way.x, 0.6 * end * way.y), moved_by(from, end * way.x, end * way.y)};
  };
  std::map<std::int32_t, std::int32_t> columns;  // and a scan line of each
  for (const std::int32_t cell : told->pixels.right)
    columns.emplace(cell % scene.raster.width, cell / scene.raster.width);
  if (told->pixel) columns.emplace(told->pixel->x, told->pixel->y);
  const ray_casting::EyeRays rays(scene, ui.session.header().conventions.depth);
  constexpr std::size_t most_drawn = 32, most_named = 4;
  for (const auto& [x, y] : columns)
    if (columns.size() <= most_drawn)
      if (const auto [from, to] = line(rays.through(x, y).along); columns.size() <= most_named)
        words.beside(fmt::format("({}, {})", x, y), ui.colors().text, ui.fonts.small, from, to,
                     {to.y - from.y, from.x - to.x});
  for (const StopLabel& label : told->labels)
    for (std::int32_t k = 0; k < std::ssize(scene.facets) && label.vertex < 0; ++k)
      if (const Facet& facet = scene.facets[k]; polygon_label(scene, facet.polygon) == label.name)
        for (std::int32_t i = 0; i < facet.corner_count; ++i)
          line(scene.points[scene.corners[facet.first_corner + i]] - scene.camera.eye);
}

/// On a ray of the eye that begins, where t is 0, 1, 2 \u2026; in a lesson where its stop gives the ray's numbers.
void mark_times(const Ui& ui, const Plan& plan, WordPlaces& words) {
  const Session& s = ui.session;
  const RayBegin* ray = s.event() ? get_if<RayBegin>(&s.event()->event) : nullptr;
  const Camera& camera = s.scene().camera;
  if (!ray || ray->role != RayRole::eye || camera.kind != Camera::Kind::perspective) return;
  const glm::dvec3 away(camera.view[0][2], camera.view[1][2], camera.view[2][2]);
  const bool counts_windows = std::abs(glm::dot(away, along_of(*ray)) - camera.d) <= 1e-9 * camera.d;
  if (!counts_windows || !ui.moment().tells("x_0", true)) return;
  constexpr int most = 6;
  for (int t = 0; t <= most; ++t) {
    const ImVec2 p = plan.place(from_of(*ray) + static_cast<double>(t) * along_of(*ray));
    if (!ImGui::IsRectVisible(p, {p.x + 1, p.y + 1})) return;
    if (t > 0) fill_circle(ImGui::GetWindowDrawList(), p, std::round(0.22f * ui.em), ui.colors().now);
    words.around(fmt::format("t = {}", t), ui.colors().now, ui.fonts.small, p, {-1, -1});
  }
}

/// How far along the ray it meets planes.
void name_hits(const Ui& ui, const Plan& plan, WordPlaces& words) {
  constexpr std::size_t most_named = 4;
  const RayWork& rays = ui.session.state().machine.rays;
  const std::vector<RayHit>& hits = rays.hits;
  const RayBegin* const ray = ray_in(rays);
  const auto name = [&](double t, ImU32 color, bool filled) {
    const ImVec2 p = plan.place(from_of(*ray) + t * along_of(*ray));
    fill_circle(ImGui::GetWindowDrawList(), p, std::round(0.3f * ui.em), filled ? color : ui.colors().pane);
    stroke_circle(ImGui::GetWindowDrawList(), p, std::round(0.3f * ui.em), color, 1.5f * ui.thin);
    words.around(fmt::format("t = {}", number(t)), color, ui.fonts.small, p, {1, 1});
  };
  const RayPlane* plane = ui.session.event() ? get_if<RayPlane>(&ui.session.event()->event) : nullptr;
  if (ray && plane && plane->t > 0 && std::isfinite(plane->t)) name(plane->t, ui.colors().now, false);
  const auto kept = std::find_if(hits.rbegin(), hits.rend(), [](const RayHit& hit) { return hit.nearest; });
  std::set<double> beyond;  // where boxes begin that need no search, and where cells do and end
  for (const BoxTest& test : rays.boxes)
    if (kept != hits.rend() && test.t_enter <= test.t_leave && test.t_enter > kept->t) beyond.insert(test.t_enter);
  for (const CellVisit& cell : rays.cells)
    for (const double t : {cell.t_enter, cell.t_leave})
      if (std::isfinite(t)) beyond.insert(t);
  if (ray && beyond.size() <= most_named && shows_boxes(ui))
    for (const double t : beyond) name(t, ui.colors().selected, true);
  for (const RayHit& hit : hits)
    if (hits.size() <= most_named && (hit.nearest || std::none_of(hits.begin(), hits.end(), [&](const RayHit& other) {
                                        return &other != &hit && number(other.t) == number(hit.t) &&
                                               (other.nearest || &other < &hit);
                                      })))
      words.around(fmt::format("t = {}", number(hit.t)), hit.nearest ? ui.colors().now : ui.colors().text,
                   ui.fonts.small, plan.place({hit.x_hit, hit.y_hit, hit.z_hit}), {1, 0});
}

void draw_ray_plan(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  const Scene& scene = s.scene();
  const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  if (size.x < 40 || size.y < 40) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  if (scene.points.empty()) return say_empty(ui, "Empty: the scene has no points.");
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  const Plan plan(scene, at, size, ui.em * 1.4f);
  WordPlaces words(ui, at, {at.x + size.x, at.y + size.y});
  const bool boxes = shows_boxes(ui);
  if (boxes) draw_cells(ui, plan), draw_boxes(ui, plan);
  draw_facets(ui, plan);
  if (machine.rays.plane_test && s.event() && holds<RayPlane>(s.event()->event)) {
    draw_plane(ui, plan, machine.rays.plane_test->facet, {});
    mark_facet(ui, plan, machine.rays.plane_test->facet, ui.colors().now, 5);
  }
  if (const RayHit* hit = s.event() ? get_if<RayHit>(&s.event()->event) : nullptr; hit && !hit->inside && !ui.still)
    draw_plane(ui, plan, hit->facet, glm::dvec3(hit->x_hit, hit->y_hit, hit->z_hit));
  draw_window(ui, plan, words);
  if (!ui.still) draw_rays(ui, plan, words);
  const auto label = [&](glm::dvec3 point, const std::string& word) {
    const ImVec2 p = plan.place(point);
    fill_circle(list, p, 4, ui.colors().text);
    words.around(word, ui.colors().text, ui.fonts.text, p, {1, 0});
  };
  if (scene.camera.kind == Camera::Kind::perspective) {
    label(scene.camera.eye, "eye");
    const ImVec2 from = plan.place(Plan::on_window(scene, -1, 1)), to = plan.place(Plan::on_window(scene, 1, 1));
    const glm::dvec2 along(to.x - from.x, to.y - from.y);
    for (const auto& [end, out] : {std::pair{to, along}, {from, -along}})
      if (words.around("window", ui.colors().text, ui.fonts.small, end, out)) break;
  }
  if (scene.light) label(scene.light->position, "light");
  draw_law(ui, plan, words);
  if (!ui.still) mark_times(ui, plan, words);
  if (!ui.still) draw_slabs(ui, plan, words);
  draw_names(ui, plan, words);
  draw_lines_of_sight(ui, plan, words);
  if (!ui.still) name_hits(ui, plan, words);
  if (!ui.still && boxes) name_boxes(ui, plan, words);
  list->PopClipRect();
}

std::string note_of_ray_plan(Ui& ui) {
  const RayWork& rays = ui.session.state().machine.rays;
  if (rays.tree.empty()) return "from above";
  const RayBegin& ray = rays.tree.front().entry;
  return fmt::format("from above \u00b7 pixel ({}, {})", ray.x, ray.y);
}

bool serves_ray_plan(const Header& header) { return records<RayBegin>(header); }

}  // namespace

const Pane ray_plan_pane{"ray_plan", "RAYS",     draw_ray_plan, note_of_ray_plan,  serves_ray_plan, 0.38f,
                         false,      always<15>, false,         none_yet<RayBegin>};

// The rays of the pixel at work as tables: what the ray at work was held against, and the tree of rays.

namespace {

std::string facet_label(const Scene& scene, std::int32_t facet) {
  if (facet < 0 || facet >= std::ssize(scene.facets)) return "\u2013";
  return polygon_label(scene, scene.facets[facet].polygon);
}

template <class E>
bool just(const Session& s) {
  return s.event() && holds<E>(s.event()->event);
}

/// What the ray at work is about: where it was cast, and what for.
std::string ray_at_work(const RayWork& rays) {
  for (const RayRow& ray : rays.tree)
    if (ray.entry.ray == rays.ray) return fmt::format("{},{} {} ", ray.entry.x, ray.entry.y, word_of(ray.entry.role));
  return "";
}

}  // namespace

std::vector<TableRow> ray_test_rows(Ui& ui) {
  const Session& s = ui.session;
  const RayWork& rays = s.state().machine.rays;
  const std::string ray = ray_at_work(rays);
  std::vector<TableRow> rows;
  for (const CellVisit& visit : rays.cells) {
    TableRow row;
    const auto asks = [&](const char* field) {
      return answers::made_by<CellVisit>(
          s.position(), field, {{"cell_x", visit.cell_x}, {"cell_y", visit.cell_y}, {"cell_z", visit.cell_z}});
    };
    row.cells = {fmt::format("cell {},{},{}", visit.cell_x, visit.cell_y, visit.cell_z),
                 TableCell(visit.t_enter, asks("t_enter")), TableCell(visit.t_leave, asks("t_leave")),
                 std::string("entered")};
    row.about = ray + row.cells[0].text;
    if (just<CellVisit>(s) && &visit == &rays.cells.back()) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  for (const BoxTest& test : rays.boxes) {
    TableRow row;
    const bool meets = test.t_enter <= test.t_leave;
    const auto asks = [&](const char* field) {
      return answers::made_by<BoxTest>(s.position(), field, {{"box", test.box}});
    };
    row.cells = {fmt::format("box {}", test.box), TableCell(test.t_enter, asks("t_enter")),
                 TableCell(test.t_leave, asks("t_leave")),
                 TableCell::result_of(test.hit ? "met"
                                      : meets  ? "too far"
                                               : "missed")};
    row.about = ray + row.cells[0].text;
    if (!test.hit) row.look = TableRow::Look::gone;
    if (just<BoxTest>(s) && &test == &rays.boxes.back()) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  double kept = std::numeric_limits<double>::quiet_NaN();  // the smallest t so far
  for (const RayHit& hit : rays.hits) {
    TableRow row;
    row.cells = {facet_label(s.scene(), hit.facet),
                 TableCell(hit.t, answers::made_by<RayHit>(s.position(), "t", {{"facet", hit.facet}})), std::string(),
                 TableCell::result_of(hit.nearest     ? "nearest so far"
                                      : !hit.inside   ? "outside"
                                      : hit.t == kept ? "inside, as near"
                                                      : "inside, farther",
                                      hit.nearest     ? "nearest"
                                      : !hit.inside   ? "outside"
                                      : hit.t == kept ? "as near"
                                                      : "farther")};
    row.about = ray + row.cells[0].text;
    if (hit.nearest) kept = hit.t;
    if (!hit.nearest) row.look = TableRow::Look::gone;
    if (just<RayHit>(s) && &hit == &rays.hits.back()) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

void draw_tests(Ui& ui) {
  if (ui.session.state().machine.rays.tree.empty()) return say_empty(ui, "Empty: no ray was cast yet.");
  const std::vector<TableRow> rows = rows_of_both(ui, ray_test_rows);
  if (rows.empty()) return say_empty(ui, "Empty: the ray met nothing yet between the near and the far plane.");
  number_table(ui, "ray_tests", {"", "t", "t_leave", ""}, rows);
}

std::string note_tests(Ui& ui) {
  const std::int64_t tested = ui.session.state().machine.rays.planes_tested;
  return tested == 1 ? "1 plane met" : fmt::format("{} planes met", tested);
}

bool serves_tests(const Header& header) { return records<RayBegin>(header) && !records<ColorWrite>(header); }

int depth_in(const RayWork& rays, const RayRow& row) {
  int depth = 0;
  std::int32_t parent = row.entry.parent;
  for (std::size_t i = rays.tree.size(); i-- > 0 && parent >= 0;) {
    if (rays.tree[i].entry.ray == parent) ++depth, parent = rays.tree[i].entry.parent;
  }
  return depth;
}

}  // namespace

std::vector<TableRow> ray_tree_rows(Ui& ui) {
  const Session& s = ui.session;
  const RayWork& rays = s.state().machine.rays;
  constexpr ByEnum<RayRole, const char*> roles{"eye", "mirrored", "transmitted", "to the light"};
  constexpr ByEnum<RayRole, const char*> brief_roles{"eye", "mirror", "transm.", "light"};
  std::vector<TableRow> rows;
  for (const RayRow& ray : rays.tree) {
    TableRow row;
    std::string branch;
    for (int i = depth_in(rays, ray); i > 0; --i) branch += i == 1 ? "\u2514 " : "  ";
    const RayRole role = ray.entry.role;
    row.cells = {branch + roles[role]};
    row.cells.back().brief = branch + brief_roles[role];
    row.about = fmt::format("{},{} {}", ray.entry.x, ray.entry.y, row.cells[0].text);
    if (ray.end) {
      row.cells.push_back(TableCell::result_of(facet_label(s.scene(), ray.end->nearest_facet)));
      if (ray.end->nearest_facet >= 0)
        row.cells.emplace_back(ray.end->t, answers::made_by<RayEnd>(s.position(), "t", {{"ray", ray.entry.ray}}));
      else row.cells.emplace_back(std::string());
      if (ray.entry.role == RayRole::shadow) {
        row.cells.push_back(TableCell::result_of(ray.end->nearest_facet >= 0 ? "dark" : "lit"));
      } else {
        const auto part = [](double v) { return nearest_byte(255 * std::clamp(v, 0.0, 1.0)); };
        const Color color{part(ray.end->red), part(ray.end->green), part(ray.end->blue)};
        row.cells.emplace_back(fmt::format("{} {} {}", color.red, color.green, color.blue), to_im(opaque(color)));
        row.cells.back().result = true;
        row.cells.back().brief = fmt::format("{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
      }
    } else {
      row.cells.insert(row.cells.end(), {std::string("\u2026"), std::string(), std::string()});
    }
    if (ray_now(s) == ray.entry.ray) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

void draw_tree(Ui& ui) {
  if (ui.session.state().machine.rays.tree.empty()) return say_empty(ui, "Empty: no ray was cast yet.");
  number_table(ui, "ray_tree", {"ray", "meets", "t", "colour"}, rows_of_both(ui, ray_tree_rows));
}

std::string note_tree(Ui& ui) {
  const std::size_t rays = ui.session.state().machine.rays.tree.size();
  return rays == 1 ? "1 ray" : fmt::format("{} rays", rays);
}

bool serves_tree(const Header& header) { return records<RayBegin>(header) && records<ColorWrite>(header); }

}  // namespace

const Pane ray_tests_pane{"ray_tests", "THIS RAY", draw_tests, note_tests, serves_tests,
                          0.3f,        true,       nullptr,    false,      none_yet<RayBegin>};
const Pane ray_tree_pane{"ray_tree", "RAY TREE", draw_tree, note_tree, serves_tree,
                         0.34f,      true,       nullptr,   false,     none_yet<RayBegin>};

}  // namespace zstep::viewer
