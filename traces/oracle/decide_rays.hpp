// Decisions about a ray: boxes, facets and which of them is nearest.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "traces/formulas/lines.hpp"
#include "traces/formulas/of_rays.hpp"
#include "traces/oracle/deciding.hpp"

namespace zstep::oracle::deciding {

class RayJudge {
 public:
  explicit RayJudge(Common& common) : common_(common) {}

  void judge(const RayPlane& e, const Situation& at) {
    const auto ray = ray_at(at);
    const Wholly& on = common_.target(e.facet, at);
    if (!ray || !on.plane) return;
    const Rational slope = turning(*on.plane, ray->along);
    const int claim = std::isnan(e.t) ? 0 : e.denominator > 0 ? 1 : e.denominator < 0 ? -1 : 0;
    const double length = on.plane->length();
    const double bent = unit * static_cast<double>(8 + 2 * on.corners.size()) * terms_of(on.corners) / length;
    common_.note(Predicate::ray_facing, outcome_of(claim == slope.sign(), claim == 0), size_of(slope) / length,
                 (bent + 8 * unit) * taxi(ray->along));
  }
  void judge(const RayHit& e, const Situation& at) {
    const auto ray = ray_at(at);
    if (!ray) return;
    judge_inside(e, *ray, at);
    if (!e.inside) return;
    const RayHit* nearest = nullptr;
    for (const RayHit& hit : at.method().rays.hits)
      if (hit.nearest) nearest = &hit;
    if (!nearest) return;
    const auto here = meet(*ray, e.facet, at), before = meet(*ray, nearest->facet, at);
    if (!here || !before) return;
    const bool truth = here->t < before->t || (here->t == before->t && e.facet < nearest->facet);
    common_.note(Predicate::ray_nearest, outcome_of(e.nearest == truth), size_of(here->t - before->t),
                 here->bound + before->bound);
  }
  void judge(const BoxTest& e, const Situation& at) {
    const auto ray = ray_at(at);
    const auto number = static_cast<std::size_t>(e.box);
    if (!ray || number >= at.method().boxes.size()) return;
    const BoxMake& box = at.method().boxes[number].entry;
    const double low[3] = {box.x_min, box.y_min, box.z_min}, high[3] = {box.x_max, box.y_max, box.z_max};
    const Rational *from[3] = {&ray->from.x, &ray->from.y, &ray->from.z},
                   *along[3] = {&ray->along.x, &ray->along.y, &ray->along.z};
    // Its limits count as they were recorded: what it enters first, and what it has met so far.
    std::optional<Rational> enter, leave;
    bool beside = false;
    for (int axis = 0; axis < 3; ++axis) {
      if (*along[axis] == 0) {
        beside = beside || *from[axis] < exactly(low[axis]) || *from[axis] > exactly(high[axis]);
        continue;
      }
      Rational a = (exactly(low[axis]) - *from[axis]) / *along[axis],
               b = (exactly(high[axis]) - *from[axis]) / *along[axis];
      if (a > b) std::swap(a, b);
      if (!enter || a > *enter) enter = a;
      if (!leave || b < *leave) leave = b;
    }
    const RayHit* nearest = nullptr;
    for (const RayHit& hit : at.method().rays.hits)
      if (hit.nearest) nearest = &hit;
    const Camera& camera = at.scene.camera;
    const double scale = camera.kind == Camera::Kind::perspective ? camera.d : 1;
    if (!at.on_screen()) {
      if (const Rational near = exactly(camera.near / scale); *enter < near) enter = near;
      if (const Rational far = exactly(camera.far / scale); *leave > far) leave = far;
    }
    bool truth = !beside && *enter <= *leave;
    double margin = size_of(*enter - *leave);
    if (nearest) {
      truth = truth && *enter <= exactly(nearest->t);
      margin = std::min(margin, size_of(*enter - exactly(nearest->t)));
    }
    common_.note(Predicate::box, outcome_of(e.hit == truth), margin, 8 * unit * (size_of(*enter) + size_of(*leave)));
  }

 private:
  struct Ray {
    Point from, along;
  };
  static std::optional<Ray> ray_at(const Situation& at) {
    const RayBegin* ray = formulas::detail::ray_at_work(at);
    if (!ray) return std::nullopt;
    return Ray{exactly(glm::dvec3(ray->x_0, ray->y_0, ray->z_0)),
               exactly(glm::dvec3(ray->dir_x, ray->dir_y, ray->dir_z))};
  }
  static Rational turning(const Plane& plane, const Point& along) {
    return plane.a * along.x + plane.b * along.y + plane.c * along.z;
  }
  /// Where a ray meets a facet's plane, and what rounding may do to t.
  struct Met {
    Rational t;
    double bound;
  };
  std::optional<Met> meet(const Ray& ray, std::int32_t facet, const Situation& at) {
    const Wholly& on = common_.target(facet, at);
    if (!on.plane) return std::nullopt;
    const Rational slope = turning(*on.plane, ray.along);
    if (slope == 0) return std::nullopt;
    const Rational t = -on.plane->value(ray.from) / slope;
    const double length = on.plane->length(), steep = size_of(slope) / length;
    const double bent = unit * static_cast<double>(8 + 2 * on.corners.size()) * terms_of(on.corners) / length;
    const double bound =
        distance(*on.plane, on.corners, ray.from).bound + size_of(t) * (bent + 8 * unit) * taxi(ray.along);
    return Met{t, bound / steep + 4 * unit * size_of(t)};
  }
  /// The corners as they are seen along the ray: the coordinate along which it runs fastest is projected away.
  void judge_inside(const RayHit& e, const Ray& ray, const Situation& at) {
    const auto part = [](const Point& p, int which) -> const Rational& {
      return which == 0 ? p.x : which == 1 ? p.y : p.z;
    };
    const Rational x = abs(ray.along.x), y = abs(ray.along.y), z = abs(ray.along.z);
    const int axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0, axis_x = (axis + 1) % 3, axis_y = (axis + 2) % 3;
    const Rational slope_x = part(ray.along, axis_x) / part(ray.along, axis),
                   slope_y = part(ray.along, axis_y) / part(ray.along, axis);
    std::vector<Point> seen;
    double off = 0;
    for (const Point& corner : common_.target(e.facet, at).corners) {
      const Point away = corner - ray.from;
      const Rational& along = part(away, axis);
      seen.push_back({part(away, axis_x) - slope_x * along, part(away, axis_y) - slope_y * along, 0});
      off = std::max(off, 4 * unit * taxi(away));
    }
    double margin = std::numeric_limits<double>::infinity(), bound = 0;
    const auto consider = [&](double away, double allowed) {
      if (bound == 0 || away / allowed < margin / bound) margin = away, bound = allowed;
    };
    for (std::size_t i = 0; i < seen.size() && off > 0; ++i) {
      const Point &a = seen[i], &b = seen[i + 1 < seen.size() ? i + 1 : 0];
      consider(size_of(a.y), off);
      if ((a.y <= 0) == (b.y <= 0)) continue;
      const double lean = size_of((b.x - a.x) / (b.y - a.y));
      consider(size_of(formulas::on_line(a.x, b.x, Rational(0), a.y, b.y)),
               off * (2 + 2 * lean) + 8 * unit * (size_of(a.x) + size_of(b.x)));
    }
    common_.note(Predicate::ray_inside, outcome_of(e.inside == covers(seen, 0, 0)), margin, bound);
  }

  Common& common_;
};

}  // namespace zstep::oracle::deciding
