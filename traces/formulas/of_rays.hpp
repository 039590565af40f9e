// Rays: the boxes and cells that they pass, how much wider programs make these, the plane of a facet and the point on
// it (002, "Simple Ray Tracing").
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/vectors.hpp"

namespace zstep::formulas {

// Boxes around facets, the cells of a grid, and where a ray comes to their sides (002, "Simple Ray Tracing"). Templates
// for the reason in outlines.hpp.

/// A side of the box around a coordinate, which reaches somewhat farther.
template <class T>
T side_of_box(const T& p, const T& pad, bool low) {
  return low ? p - pad : p + pad;
}

/// The side between the k-th cell and the one before, of `cells` from `low` to `high`.
template <class T>
T side_of_cells(const T& low, const T& high, const T& k, const T& cells) {
  return low + (high - low) * k / cells;
}

/// t where a ray comes to a side.
template <class T>
T ray_at_side(const T& side, const T& from, const T& along) {
  return (side - from) / along;
}

/// The coordinate at t of a ray that begins at `from` and gains `along` where t gains 1.
template <class T>
T on_ray(const T& from, const T& t, const T& along) {
  return from + t * along;
}

namespace detail {

/// The ray at work: X = X_0 + t dX.
inline const RayBegin* ray_at_work(const Situation& at) {
  const RayWork& rays = at.method().rays;
  if (!rays.ray) return nullptr;
  // Rays are numbered in the order of work, and one pixel may have tens of thousands.
  const auto found = std::lower_bound(rays.tree.begin(), rays.tree.end(), *rays.ray,
                                      [](const RayRow& row, std::int32_t ray) { return row.entry.ray < ray; });
  return found != rays.tree.end() && found->entry.ray == *rays.ray ? &found->entry : nullptr;
}
/// The same where it is the one that was cast last: only of that one the boxes, cells and hits are at hand.
inline const RayBegin* ray_cast_last(const Situation& at) {
  const RayBegin* ray = ray_at_work(at);
  return ray && ray->ray == at.method().rays.tree.back().entry.ray ? ray : nullptr;
}
inline const RayHit* kept_hit(const Situation& at) {
  const RayHit* kept = nullptr;
  for (const RayHit& hit : at.method().rays.hits)
    if (hit.nearest) kept = &hit;
  return kept;
}

inline std::array<double, 3> start_of(const RayBegin& ray) { return {ray.x_0, ray.y_0, ray.z_0}; }
inline std::array<double, 3> way_of(const RayBegin& ray) { return {ray.dir_x, ray.dir_y, ray.dir_z}; }

/// From where to where along a ray something is met: from the eye between the near and the far plane.
struct Reach {
  double least = 0, most = std::numeric_limits<double>::infinity();
};
inline Reach reach_of(const Situation& at, const RayBegin& ray) {
  if (ray.role == RayRole::shadow) return {0, 1};
  if (ray.role != RayRole::eye) return {};
  const Camera& camera = at.scene.camera;
  if (camera.kind == Camera::Kind::screen) return {-std::numeric_limits<double>::infinity()};
  const double unit = camera.kind == Camera::Kind::orthographic ? 1 : camera.d;
  return {camera.near / unit, camera.far / unit};
}

/// Where a ray enters and leaves the slabs of a box.
struct Passage {
  Rounded enter = -std::numeric_limits<double>::infinity(), leave = std::numeric_limits<double>::infinity();
};
inline Passage passage_of(const RayBegin& ray, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  Passage passage;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from = start_of(ray)[axis], along = way_of(ray)[axis];
    if (along == 0) {
      if (from < low[axis] || from > high[axis]) passage.leave = -std::numeric_limits<double>::infinity();
      continue;
    }
    const Rounded to_low = ray_at_side<Rounded>(low[axis], from, along),
                  to_high = ray_at_side<Rounded>(high[axis], from, along);
    const Rounded &in = along > 0 ? to_low : to_high, &beyond = along > 0 ? to_high : to_low;
    if (in.value > passage.enter.value) passage.enter = in;
    if (beyond.value < passage.leave.value) passage.leave = beyond;
  }
  return passage;
}
template <class Box>
Passage passage_of(const RayBegin& ray, const Box& box) {
  return passage_of(ray, {box.x_min, box.y_min, box.z_min}, {box.x_max, box.y_max, box.z_max});
}
/// No earlier than the ray begins, in a program that limits it so.
inline Rounded enters_at(double recorded, const Passage& passage, const Reach& reach) {
  const Rounded limited = passage.enter.value < reach.least ? Rounded(reach.least) : passage.enter;
  return nearest_of(recorded, {limited, passage.enter});
}
inline Rounded leaves_at(double recorded, const Passage& passage, const Reach& reach) {
  const Rounded limited = passage.leave.value > reach.most ? Rounded(reach.most) : passage.leave;
  return nearest_of(recorded, {limited, passage.leave});
}

/// How far beyond its numbers a box is taken to reach: it is made somewhat wider, so that rounding hides nothing.
inline double slack_of(double low, double high) { return 1e-6 * std::max({std::abs(low), std::abs(high), 1.0}); }
inline bool lies_in(double value, double low, double high) {
  const double slack = slack_of(low, high);
  return low - slack <= value && value <= high + slack;
}
template <class Box>
bool holds_point(const Box& box, const glm::dvec3& p) {
  return lies_in(p.x, box.x_min, box.x_max) && lies_in(p.y, box.y_min, box.y_max) && lies_in(p.z, box.z_min, box.z_max);
}
inline const glm::dvec3& corner_at(const Situation& at, std::int32_t point) { return at.scene.points[point]; }

/// How far a box may reach beyond what it holds: programs make it wider by some share of the coordinates' size, or not.
inline double box_margin(const Scene& scene) {
  double size = 0;
  for (const glm::dvec3& p : scene.points) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const glm::dvec3& eye = scene.camera.eye;
  return 4e-9 * std::max(size, std::abs(eye.x) + std::abs(eye.y) + std::abs(eye.z)) + 1e-12;
}

/// Does each side go through a point of the scene, but for the margin? Of large scenes nothing is said.
template <class Box>
bool is_tight(const Situation& at, const Box& box) {
  constexpr std::size_t most_points = 1000;
  if (at.scene.points.size() > most_points) return true;
  const double margin = box_margin(at.scene);
  const auto touches = [&](double side, int axis) {
    return std::any_of(at.scene.points.begin(), at.scene.points.end(),
                       [&](const glm::dvec3& p) { return std::abs(p[axis] - side) <= margin; });
  };
  return touches(box.x_min, 0) && touches(box.x_max, 0) && touches(box.y_min, 1) && touches(box.y_max, 1) &&
         touches(box.z_min, 2) && touches(box.z_max, 2);
}

/// Is the point where a ray meets a facet's plane inside the facet? Nothing where it is too near to an edge to be sure:
/// corners may lie beside the plane, and look the farther off the more it is seen from its side.
inline std::optional<bool> is_inside(const Situation& at, std::span<const std::int32_t> corners, const glm::dvec3& p,
                                     const CornersPlane& plane, const RayBegin& ray) {
  const Vector<Rounded> way{ray.dir_x, ray.dir_y, ray.dir_z};
  const double sine = std::abs(dot(plane.normal, way).value) / std::sqrt(dot(way, way).value);
  double bend = 0;
  for (const std::int32_t corner : corners)
    bend = std::max(bend, std::abs((dot(plane.normal, rounded(corner_at(at, corner))) + plane.d).value));
  const double x = std::abs(plane.normal.x.value), y = std::abs(plane.normal.y.value),
               z = std::abs(plane.normal.z.value);
  const int drop = z >= x && z >= y ? 2 : y >= x ? 1 : 0, u = (drop + 1) % 3, v = (drop + 2) % 3;
  constexpr double near = 1e-6;
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &a = corner_at(at, corners[i]), &b = corner_at(at, corners[(i + 1) % corners.size()]);
    const double along_u = b[u] - a[u], along_v = b[v] - a[v], away_u = p[u] - a[u], away_v = p[v] - a[v];
    const double length = along_u * along_u + along_v * along_v;
    if (length == 0) continue;
    const double t = std::clamp((away_u * along_u + away_v * along_v) / length, 0.0, 1.0);
    const double off_u = away_u - t * along_u, off_v = away_v - t * along_v;
    const double off = std::sqrt(off_u * off_u + off_v * off_v);
    if (!(off > near * std::sqrt(length) + 4 * bend / sine)) return std::nullopt;
    if ((a[v] <= p[v]) != (b[v] <= p[v]) && away_u < along_u * (away_v / along_v)) inside = !inside;
  }
  return inside;
}

}  // namespace detail

template <class Out>
void derive(const BoxMake& e, const Situation& at, Out& out) {
  const bool turned = e.x_min > e.x_max || e.y_min > e.y_max || e.z_min > e.z_max;
  out.rule(Rule::box_is_tight, !turned && detail::is_tight(at, e));
  const std::size_t parent = e.parent;
  if (e.parent < 0 || parent >= at.method().boxes.size()) return;
  const BoxMake& around = at.method().boxes[parent].entry;
  out.rule(Rule::box_in_parent, detail::holds_point(around, {e.x_min, e.y_min, e.z_min}) &&
                                    detail::holds_point(around, {e.x_max, e.y_max, e.z_max}));
}

template <class Out>
void derive(const BoxHold& e, const Situation& at, Out& out) {
  const std::size_t box = e.box;
  if (e.box < 0 || box >= at.method().boxes.size()) return;
  bool holds = true;
  for (const std::int32_t corner : detail::corners_of(at, e.facet))
    holds = holds && detail::holds_point(at.method().boxes[box].entry, detail::corner_at(at, corner));
  out.rule(Rule::box_holds, holds);
}

template <class Out>
void derive(const GridMake& e, const Situation& at, Out& out) {
  out.rule(Rule::box_is_tight, e.cells_x > 0 && e.cells_y > 0 && e.cells_z > 0 && detail::is_tight(at, e));
}

template <class Out>
void derive(const CellHold& e, const Situation& at, Out& out) {
  const auto& grid = at.method().grid;
  if (!grid) return;
  const auto meets = [&](std::int32_t cell, std::int32_t cells, double low, double high, int axis) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const std::int32_t corner : detail::corners_of(at, e.facet)) {
      least = std::min(least, detail::corner_at(at, corner)[axis]);
      most = std::max(most, detail::corner_at(at, corner)[axis]);
    }
    const double slack = detail::slack_of(low, high);
    return cell >= 0 && cell < cells && most >= side_of_cells<double>(low, high, cell, cells) - slack &&
           least <= side_of_cells<double>(low, high, cell + 1, cells) + slack;
  };
  out.rule(Rule::cell_holds, meets(e.cell_x, grid->cells_x, grid->x_min, grid->x_max, 0) &&
                                 meets(e.cell_y, grid->cells_y, grid->y_min, grid->y_max, 1) &&
                                 meets(e.cell_z, grid->cells_z, grid->z_min, grid->z_max, 2));
}

template <class Out>
void derive(const CellVisit& e, const Situation& at, Out& out) {
  const RayBegin* ray = detail::ray_cast_last(at);
  const auto& grid = at.method().grid;
  if (!ray || !grid) return;
  const std::array<double, 3> low{grid->x_min, grid->y_min, grid->z_min}, high{grid->x_max, grid->y_max, grid->z_max};
  const std::array<std::int32_t, 3> cell{e.cell_x, e.cell_y, e.cell_z},
      cells{grid->cells_x, grid->cells_y, grid->cells_z};
  Rounded leave = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = detail::way_of(*ray)[axis];
    if (along == 0 || cells[axis] <= 0) continue;
    const Rounded side =
        side_of_cells<Rounded>(low[axis], high[axis], Rounded(cell[axis] + (along > 0), 0), Rounded(cells[axis], 0));
    const Rounded t = ray_at_side<Rounded>(side, detail::start_of(*ray)[axis], along);
    if (t.value < leave.value) leave = t;
  }
  out.near(&CellVisit::t_leave, leave);
  const auto& visited = at.method().rays.cells;
  if (visited.empty()) {
    out.near(&CellVisit::t_enter,
             detail::enters_at(e.t_enter, detail::passage_of(*ray, *grid), detail::reach_of(at, *ray)));
    return;
  }
  const CellVisit& last = visited.back();
  out.near(&CellVisit::t_enter, Rounded(std::max(last.t_enter, last.t_leave)));
  out.rule(Rule::cell_is_next,
           std::abs(e.cell_x - last.cell_x) + std::abs(e.cell_y - last.cell_y) + std::abs(e.cell_z - last.cell_z) == 1);
}

template <class Out>
void derive(const BoxTest& e, const Situation& at, Out& out) {
  if (e.hit) out.rule(Rule::box_entered, e.t_enter <= e.t_leave);
  const RayBegin* ray = detail::ray_cast_last(at);
  const std::size_t box = e.box;
  if (!ray || e.box < 0 || box >= at.method().boxes.size()) return;
  const detail::Passage passage = detail::passage_of(*ray, at.method().boxes[box].entry);
  const detail::Reach reach = detail::reach_of(at, *ray);
  out.near(&BoxTest::t_enter, detail::enters_at(e.t_enter, passage, reach));
  out.near(&BoxTest::t_leave, detail::leaves_at(e.t_leave, passage, reach));
  // A box behind the nearest point that was found so far may be passed over.
  const RayHit* kept = detail::kept_hit(at);
  const bool worth_it = e.t_enter <= e.t_leave && e.t_enter <= (kept ? kept->t : reach.most);
  if (worth_it && (e.hit || at.records<RayHit>())) out.is(&BoxTest::hit, true);
}

/// As shares of Newell's sum; 0 for a normal of length 1.
inline constexpr std::array<double, 3> usual_lengths{0, 1, 0.5};

template <class Out>
void derive(const RayPlane& e, const Situation& at, Out& out) {
  const auto gives_t = [&] {
    out.gives(&RayPlane::t,
              out.number("numerator", e.numerator, Place{}) / out.number("denominator", e.denominator, Place{}));
  };
  if (!std::isnan(e.t)) gives_t();
  const RayBegin* ray = detail::ray_at_work(at);
  const auto corners = detail::corners_of(at, e.facet);
  if (!ray || corners.empty()) return;
  out.reads(Place{Place::In::ray, 0});
  const auto plane = plane_of_corners(corners.size(), [&](std::size_t i) { return detail::corner_at(at, corners[i]); });
  if (!plane) return;
  const Vector<Rounded> from{ray->x_0, ray->y_0, ray->z_0}, way{ray->dir_x, ray->dir_y, ray->dir_z};
  const auto numerator = [&](const CornersPlane& p) { return -(dot(p.normal, from) + p.d); };
  const auto denominator = [&](const CornersPlane& p) { return dot(p.normal, way); };
  // Of the two the one that says more tells how long the normal is, unless the other one alone has a length that
  // programs give it: 1, that of Newell's sum, or half of that.
  const Rounded n = numerator(*plane), d = denominator(*plane);
  // It runs along the plane, within a tolerance of the program's own, or it does not.
  if (std::isnan(e.t) && std::abs(d.value) > rounding_of_float32 * d.spread) gives_t();
  const double of_n = e.numerator / n.value, of_d = e.denominator / d.value;
  const auto is_usual = [&](double factor) {
    constexpr double near = 1e-6;
    return std::any_of(usual_lengths.begin(), usual_lengths.end(), [&](double share) {
      const double length = share > 0 ? share * plane->length : 1;
      return std::abs(std::abs(factor) - length) <= near * length;
    });
  };
  const bool by_d = is_usual(of_d) != is_usual(of_n) ? is_usual(of_d) : std::abs(d.value) >= std::abs(n.value);
  const double factor = by_d ? of_d : of_n;
  const CornersPlane as_it = std::isfinite(factor) ? plane->times(factor < 0 ? -1 : 1, std::abs(factor)) : *plane;
  out.near(&RayPlane::numerator, numerator(as_it));
  out.near(&RayPlane::denominator, denominator(as_it));
}

template <class Out>
void derive(const RayHit& e, const Situation& at, Out& out) {
  if (const auto& plane = at.method().rays.plane_test; plane && plane->facet == e.facet)
    out.gives(&RayHit::t, out.number("t of the plane", plane->t, Place{Place::In::ray, 0, "t"}));
  const RayBegin* ray = detail::ray_at_work(at);
  if (!ray) return;
  const Place place{Place::In::ray, 0};
  const auto t = out.number("t", e.t, Place{});
  const auto along = [&](std::string_view start, double from, std::string_view direction, double step) {
    return on_ray(out.number(start, from, place[start]), t, out.number(direction, step, place[direction]));
  };
  out.gives(&RayHit::x_hit, along("x_0", ray->x_0, "dir_x", ray->dir_x));
  out.gives(&RayHit::y_hit, along("y_0", ray->y_0, "dir_y", ray->dir_y));
  out.gives(&RayHit::z_hit, along("z_0", ray->z_0, "dir_z", ray->dir_z));
  out.rule(Rule::kept_inside, e.inside || !e.nearest);
  const auto corners = detail::corners_of(at, e.facet);
  const auto plane = plane_of_corners(corners.size(), [&](std::size_t i) { return detail::corner_at(at, corners[i]); });
  if (plane)
    if (const auto inside = detail::is_inside(at, corners, {e.x_hit, e.y_hit, e.z_hit}, *plane, *ray))
      out.is(&RayHit::inside, *inside);
  const detail::Reach reach = detail::reach_of(at, *ray);
  if (!at.header.declares(Convention::nearer)) return;
  if (detail::ray_cast_last(at) != ray || !e.inside || !(e.t >= reach.least && e.t <= reach.most)) return;
  const RayHit* kept = detail::kept_hit(at);
  if (!kept || e.t != kept->t) out.is(&RayHit::nearest, !kept || e.t < kept->t);
}

// Boxes about polygons: programs make them wider by a little, which changes their sides and where rays meet them.

/// The largest number of a box; 0 of other steps. Its sides are off by a share of that, for they may be 0.
template <class E>
double size_of_box(const E& e) {
  if constexpr (std::is_same_v<E, BoxMake>)
    return std::max({std::abs(e.x_min), std::abs(e.x_max), std::abs(e.y_min), std::abs(e.y_max), std::abs(e.z_min),
                     std::abs(e.z_max)});
  else return 0;
}

/// By what share a box, or where a ray meets it, is off with such a margin; `apart(a, b)` is the share between two.
template <class E, class Apart>
double off_by_margin(const E& e, const Situation& at, double margin, Apart&& apart) {
  if constexpr (std::is_same_v<E, BoxMake>) {
    return margin / size_of_box(e);
  } else if constexpr (std::is_same_v<E, BoxTest>) {
    const RayBegin* ray = detail::ray_cast_last(at);
    const auto& boxes = at.method().boxes;
    const std::size_t number = e.box;
    if (!ray || e.box < 0 || number >= boxes.size()) return 0;
    BoxMake wider = boxes[number].entry;
    const detail::Passage through = detail::passage_of(*ray, wider);
    wider.x_min -= margin, wider.y_min -= margin, wider.z_min -= margin;
    wider.x_max += margin, wider.y_max += margin, wider.z_max += margin;
    const detail::Passage about = detail::passage_of(*ray, wider);
    const auto moved = [&](double one, double other) { return one == other ? 0 : apart(one, other); };
    return std::max(moved(through.enter.value, about.enter.value), moved(through.leave.value, about.leave.value));
  } else {
    return 0;
  }
}

}  // namespace zstep::formulas
