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
#include <optional>

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

/// Those that the ray meets before what it has met are drawn through, the others dashed.
void draw_boxes(const Ui& ui, const Plan& plan) {
  const MethodState& machine = ui.session.state().machine;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  constexpr std::size_t most_drawn = 400;
  if (machine.boxes.size() <= most_drawn)
    for (const BoxRow& row : machine.boxes) stroke_lines(list, corners_of(plan, row.entry), c.rule, ui.thin, true);
  if (ui.still) return;
  const RecordedEvent* event = ui.session.event();
  for (const bool hit : {true, false})
    for (const BoxTest& test : machine.rays.boxes) {
      if (test.hit != hit || test.box < 0 || test.box >= std::ssize(machine.boxes)) continue;
      const std::array corners = corners_of(plan, machine.boxes[static_cast<std::size_t>(test.box)].entry);
      const bool now = event && holds<BoxTest>(event->event) && &test == &machine.rays.boxes.back();
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
  for (const BoxTest& test : machine.rays.boxes) {
    if (test.box < 0 || test.box >= std::ssize(machine.boxes)) continue;
    const std::array corners = corners_of(plan, machine.boxes[static_cast<std::size_t>(test.box)].entry);
    const std::string name = fmt::format("box {}", test.box);
    const ImVec2 size = text_size(ui, ui.fonts.small, name);
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x, corners[3].x});
    const auto [top, end] = std::minmax({corners[0].y, corners[1].y, corners[2].y, corners[3].y});
    std::vector<ImVec2> places;
    for (const float inside : {1.0f, -1.0f})
      for (const float y : {end - inside * size.y * 0.75f, top + inside * size.y * 0.75f})
        for (const float x : {right - size.x * 0.65f, left + size.x * 0.65f}) places.push_back({x, y});
    words.put(name, ui.colors().text, ui.fonts.small, places);
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
  if (!test || !(now.asked() || test->hit) || test->box < 0 || test->box >= std::ssize(machine.boxes) ||
      !machine.rays.ray)
    return;
  const auto& tree = machine.rays.tree;
  const auto row =
      std::find_if(tree.begin(), tree.end(), [&](const RayRow& one) { return one.entry.ray == *machine.rays.ray; });
  if (row == tree.end()) return;
  const BoxMake& box = machine.boxes[static_cast<std::size_t>(test->box)].entry;
  const RayBegin& ray = row->entry;
  const glm::dvec3 from(ray.x_0, ray.y_0, ray.z_0), along(ray.dir_x, ray.dir_y, ray.dir_z);
  const glm::dvec3 low(box.x_min, box.y_min, box.z_min), high(box.x_max, box.y_max, box.z_max);
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (now.asked()) {
    stroke_lines(list, corners_of(plan, box), c.now, 2.5f * ui.thin, true);
    words.around(fmt::format("box {}", test->box), c.now, ui.fonts.small, plan.place(low), {-1, 0.6});
  }
  constexpr std::array names{"x", "y"};
  for (int axis = 0; axis < 2; ++axis) {
    const int other = 1 - axis;
    const double beyond = 0.25 * std::max(high[0] - low[0], high[1] - low[1]);
    std::vector<double> times;
    for (const double border : {low[axis], high[axis]}) {
      glm::dvec3 a(0), b(0);
      a[axis] = b[axis] = border, a[other] = low[other] - beyond, b[other] = high[other] + beyond;
      stroke_dashed(list, plan.place(a), plan.place(b), c.changed, 1.5f * ui.thin);
      const double t = along[axis] != 0 ? (border - from[axis]) / along[axis] : -1;
      if (t > 0 && (times.empty() || std::abs(times[0] - t) > 1e-6)) times.push_back(t);
    }
    for (const double t : times) {
      const ImVec2 at = plan.place(from + t * along);
      fill_circle(list, at, std::round(0.22f * ui.em), c.changed);
      words.around(fmt::format("{} {}", names.at(static_cast<std::size_t>(axis)), number(t, 2, true)), c.changed,
                   ui.fonts.small, at, {1, axis == 0 ? -1 : 1});
    }
  }
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
    stroke_line(list, corner(x, 0, 0), corner(x, g.cells_y, 0), c.rule, ui.thin);
  for (std::int32_t y = 0; y <= g.cells_y; ++y)
    stroke_line(list, corner(0, y, 0), corner(g.cells_x, y, 0), c.rule, ui.thin);
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

void draw_facets(const Ui& ui, const Plan& plan) {
  const Scene& scene = ui.session.scene();
  constexpr std::size_t most_drawn = 4000;
  const std::size_t step = 1 + scene.facets.size() / most_drawn;
  for (std::size_t i = 0; i < scene.facets.size(); i += step) {
    const Polygon& polygon = scene.polygons[scene.facets[i].polygon];
    mark_facet(ui, plan, index32(i), scene.facets.size() > 200 ? ui.colors().muted : to_im(opaque(polygon.color)),
               scene.facets.size() > 200 ? 1.0f : 3.0f);
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
    words.beside(polygon_label(scene, facet.polygon), ui.colors().text, ui.fonts.bold, from, to,
                 along.x < 0 ? glm::dvec2(-along.y, along.x) : glm::dvec2(along.y, -along.x));
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
  for (const RayHit& hit : machine.rays.hits) {
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

/// How far along the ray it meets planes.
void name_hits(const Ui& ui, const Plan& plan, WordPlaces& words) {
  constexpr std::size_t most_named = 4;
  const std::vector<RayHit>& hits = ui.session.state().machine.rays.hits;
  for (const RayHit& hit : hits)
    if (hits.size() <= most_named)
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
  draw_cells(ui, plan);
  draw_boxes(ui, plan);
  draw_facets(ui, plan);
  if (machine.rays.plane_test && s.event() && holds<RayPlane>(s.event()->event))
    mark_facet(ui, plan, machine.rays.plane_test->facet, ui.colors().now, 5);
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
  if (!ui.still) draw_slabs(ui, plan, words);
  draw_names(ui, plan, words);
  if (!ui.still) name_hits(ui, plan, words), name_boxes(ui, plan, words);
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
