// The rays of the pixel at work, seen from above: through the boxes or cells that they are held against, to what they
// meet.

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
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/ray_plan.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

const RayBegin* ray_in(const RayWork& rays) {
  const auto row =
      std::find_if(rays.tree.begin(), rays.tree.end(), [&](const RayRow& one) { return one.entry.ray == rays.ray; });
  return row == rays.tree.end() ? nullptr : &row->entry;
}

std::optional<std::int32_t> ray_now(const Session& s) {
  const RayEnd* end = s.event() ? get_if<RayEnd>(&s.event()->event) : nullptr;
  return end ? std::optional(end->ray) : s.state().machine.rays.ray;
}

namespace {

/// The window on the projection plane, divided in columns of pixels; the one at work is marked.
void draw_window(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
  const Session& s = ui.session;
  const Scene& scene = s.scene();
  if (scene.camera.kind != Camera::Kind::perspective) return;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const std::int32_t columns = std::max(1, scene.raster.width);
  const auto at = [&](std::int32_t border) {
    return plan.place(PlanOfRays::on_window(scene, 2.0 * border / columns - 1, 1));
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

/// The facets that the mark is for as thick lines.
void mark_facet(const Ui& ui, const PlanOfRays& plan, std::int32_t number, ImU32 color, float thickness) {
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
std::optional<std::array<glm::dvec2, 2>> edge_of(const PlanOfRays& plan, const Scene& scene, std::int32_t number) {
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
void draw_plane(const Ui& ui, const PlanOfRays& plan, std::int32_t facet, const std::optional<glm::dvec3>& to) {
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
float thickness_of(const PlanOfRays& plan, const Scene& scene, std::int32_t facet) {
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

void draw_facets(const Ui& ui, const PlanOfRays& plan) {
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
void draw_names(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
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

/// Where a ray that is still waiting met something: its first child begins there.
const RayBegin* first_child(const RayWork& rays, std::int32_t ray) {
  for (const RayRow& row : rays.tree)
    if (row.entry.parent == ray) return &row.entry;
  return nullptr;
}

void draw_rays(Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
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
void draw_law(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
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
void draw_lines_of_sight(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
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
void mark_times(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
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
void name_hits(const Ui& ui, const PlanOfRays& plan, WordPlaces& words) {
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
  const PlanOfRays plan(scene, at, size, ui.em * 1.4f);
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
    const ImVec2 from = plan.place(PlanOfRays::on_window(scene, -1, 1)),
                 to = plan.place(PlanOfRays::on_window(scene, 1, 1));
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

}  // namespace zstep::viewer
