// The judges of each kind of decision: about polygons and the ends of spans, pieces, planes and areas, rays, curves and
// lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/of_rays.hpp"
#include "traces/formulas/outlines.hpp"
#include "tests/laws/decisions/deciding.hpp"

namespace zstep::oracle::deciding {

class PolygonJudge {
 public:
  explicit PolygonJudge(Common& common) : common_(common) {}

  void judge(const FacingTest& e, const Situation& at) {
    const Fields exact = common_.vertices.fields_of(e, at);
    const auto value = exact.find("view_dot_normal");
    if (value == exact.end()) return;
    const int claim = e.facing == Facing::back ? 1 : e.facing == Facing::front ? -1 : 0;
    const std::vector<Point>& corners = common_.target(at.method().facet, at).corners;
    const double sight = at.camera->kind == Camera::Kind::orthographic ? taxi(at.camera->eye)
                                                                       : taxi(corners[0] - exactly(at.camera->eye));
    common_.note(Predicate::facing, outcome_of(claim == value->second.sign(), claim == 0), size_of(value->second),
                 unit * 2 * static_cast<double>(corners.size() + 6) * sight * terms_of(corners));
  }
  void judge(const ClipVertex& e, const Situation& at) {
    const Fields exact = common_.vertices.fields_of(e, at);
    const auto value = exact.find("distance");
    const VertexStages* vertex = at.viewed(e.vertex);
    if (value == exact.end() || !vertex) return;
    const double distance = size_of(value->second);
    common_.note(Predicate::clip_side, outcome_of(e.inside == (value->second >= 0)), distance,
                 8 * unit * (2 * std::max(1.0, std::abs(vertex->view.z)) + distance));
  }
  void judge(const SpanBegin& e, const Situation& at) {
    const auto left = crossing(at, e.left_edge, e.y), right = crossing(at, e.right_edge, e.y);
    if (!common_.plain || !left || !right) return;
    const std::int32_t width = at.scene.raster.width;
    const auto end = [&](const Crossing& edge, std::int32_t claim, std::int32_t truth) {
      const Rational away = edge.x - floor(edge.x + Rational(1, 2));  // from the nearest centre
      common_.note(Predicate::span_end, outcome_of(claim == truth), size_of(away), edge.bound);
    };
    end(*left, e.first, std::max(0, formulas::limited_column(rounded(ceil(left->x)), width)));
    end(*right, e.last, formulas::limited_column(rounded(ceil(right->x)), width) - 1);
    common_.note(Predicate::edge_order, outcome_of(left->x <= right->x), size_of(left->x - right->x),
                 left->bound + right->bound);
  }

 private:
  struct Crossing {
    Rational x;
    double bound;
  };
  std::optional<Crossing> crossing(const Situation& at, std::int32_t edge, std::int32_t y) const {
    const EdgeTableInsert* entry = at.edge(edge);
    if (!entry) return std::nullopt;
    const auto a = common_.vertices.on_raster(entry->vertex_0, at), b = common_.vertices.on_raster(entry->vertex_1, at);
    if (!a || !b || a->y == b->y) return std::nullopt;
    const double lean = 1 + size_of((b->x - a->x) / (b->y - a->y));
    const double slipped = common_.slip(entry->vertex_0, at) + common_.slip(entry->vertex_1, at);
    return Crossing{formulas::on_line(a->x, b->x, Rational(y), a->y, b->y),
                    8 * unit * (size_of(a->x) + size_of(b->x)) + 2 * lean * slipped};
  }

  Common& common_;
};

// Decisions about pieces: on which side of a plane, and whether two overlap.

class PieceJudge {
 public:
  explicit PieceJudge(Common& common) : common_(common) {}

  void judge(const VertexSide& e, const Situation& at) {
    const Wholly& whole = common_.whole_of(e.plane_of, at);
    const auto point = common_.vertices.cutting_point(e.vertex, at);
    if (!whole.plane || !point) return;
    const Distance exact = distance(*whole.plane, whole.corners, *point, common_.cut_slip(e.vertex, at));
    const int claim = e.side == Side::front ? 1 : e.side == Side::behind ? -1 : 0;
    common_.note(Predicate::vertex_side, outcome_of(claim == exact.sign, claim == 0), exact.size, exact.bound);
  }
  void judge(const SideTest& e, const Situation& at) {
    const Wholly& whole = common_.whole_of(e.plane_of, at);
    const Piece* piece = at.piece(e.piece);
    if (!whole.plane || !piece) return;
    // A tree has the front where the plane's value is positive; on the raster it is where the eye is.
    const bool tree = at.records<NodeMake>();
    if (!tree && whole.plane->c == 0) return;
    const int front_sign = tree ? 1 : -whole.plane->c.sign();
    double before = 0, behind = 0, bound = 0, scale = 1;
    for (const std::int32_t vertex : piece->outline) {
      const auto point = common_.vertices.cutting_point(vertex, at);
      if (!point) return;
      const Distance exact = distance(*whole.plane, whole.corners, *point, common_.cut_slip(vertex, at));
      if (exact.sign != 0)
        (exact.sign == front_sign ? before : behind) = std::max(exact.sign == front_sign ? before : behind, exact.size);
      bound = std::max(bound, exact.bound), scale = std::max(scale, taxi(*point));
    }
    const double tolerance = (tree ? 1e-8 : 1e-11) * scale;  // not less than that of the methods
    const double against = e.side == Side::front ? behind : e.side == Side::behind ? before : 0;
    const bool flat = before == 0 && behind == 0;
    switch (e.side) {
      case Side::on:
        return common_.note(Predicate::side, outcome_of(flat, true));
      case Side::crossing:
        return common_.note(Predicate::side, outcome_of(before > 0 && behind > 0),
                            std::min(std::abs(e.least), std::abs(e.greatest)), bound);
      default:
        common_.note(Predicate::side, outcome_of(against == 0 && !flat, against > 0 && against <= tolerance),
                     flat ? std::max(std::abs(e.least), std::abs(e.greatest)) : against, bound);
    }
  }
  void judge(const EyeSide& e, const Situation& at) {
    const std::size_t node = e.node;
    if (node >= at.method().tree.size()) return;
    const Wholly& whole = common_.whole_of(at.method().tree[node].pieces[0], at);
    if (!whole.plane) return;
    const double length = whole.plane->length();
    const double bent = unit * static_cast<double>(8 + 2 * whole.corners.size()) * terms_of(whole.corners) / length;
    if (at.scene.camera.kind == Camera::Kind::perspective) {
      const Distance exact = distance(*whole.plane, whole.corners, exactly(at.scene.camera.eye));
      return common_.note(Predicate::eye_side, outcome_of(e.front == (exact.sign > 0)), exact.size, exact.bound);
    }
    const Point way = at.on_screen() ? Point{0, 0, -1} : exactly(at.scene.camera.eye);
    const Rational along = whole.plane->a * way.x + whole.plane->b * way.y + whole.plane->c * way.z;
    common_.note(Predicate::eye_side, outcome_of(e.front == (along > 0)), size_of(along) / length, bent + 16 * unit);
  }
  void judge(const ExtentTest& e, const Situation& at) {
    const std::vector<Point> one = common_.vertices.corners_of(e.piece, at),
                             other = common_.vertices.corners_of(e.other, at);
    if (one.empty() || other.empty()) return;
    const auto along = [&](const Point& p) -> const Rational& {
      return e.axis == Axis::x ? p.x : e.axis == Axis::y ? p.y : p.z;
    };
    const auto less = [&](const Point& a, const Point& b) { return along(a) < along(b); };
    const auto [low, high] = std::minmax_element(one.begin(), one.end(), less);
    const auto [other_low, other_high] = std::minmax_element(other.begin(), other.end(), less);
    const bool truth = along(*low) < along(*other_high) && along(*other_low) < along(*high);
    double slipped = 0;
    for (const std::int32_t piece : {e.piece, e.other})
      for (const std::int32_t vertex : at.piece(piece)->outline)
        slipped = std::max(slipped, common_.cut_slip(vertex, at));
    common_.note(Predicate::extents, outcome_of(e.overlap == truth),
                 std::min(size_of(along(*low) - along(*other_high)), size_of(along(*other_low) - along(*high))),
                 2 * slipped);
  }
  void judge(const OverlapTest& e, const Situation& at) {
    const std::vector<Point> one = common_.vertices.corners_of(e.piece, at),
                             other = common_.vertices.corners_of(e.other, at);
    if (one.empty() || other.empty() || !is_convex(one) || !is_convex(other)) return;
    const std::vector<Point> part = common_part(one, other);
    double length = 0;
    for (const Point& a : part)
      for (const Point& b : part) length = std::max({length, size_of(a.x - b.x), size_of(a.y - b.y)});
    constexpr double touch = 2e-6;  // px: the method takes half of it for a touch
    const bool thin = !part.empty() && size_of(area_of(part)) <= touch * length;
    common_.note(Predicate::overlap, outcome_of(e.overlap == !part.empty(), thin), part.empty() ? 1 : length);
  }

 private:
  Common& common_;
};

// Decisions about areas of the raster, and about which of two planes is nearer.

class PlaneJudge {
 public:
  explicit PlaneJudge(Common& common) : common_(common) {}

  void judge(const AreaBegin& e, const Situation&) { area_ = e, depths_.clear(); }
  void judge(const AreaBin& e, const Situation& at) {
    if (!area_) return;
    if (e.bin == Bin::surrounding) surrounding_[area_->area].insert(e.piece);
    const auto parent = surrounding_.find(area_->parent);
    if (parent != surrounding_.end() && parent->second.contains(e.piece)) return;  // it still does
    const std::vector<Point> corners = common_.vertices.corners_of(e.piece, at);
    if (corners.empty()) return;
    const Rational half(1, 2), x_0 = area_->first_column - half, y_0 = area_->first_row - half,
                               x_1 = area_->end_column - half, y_1 = area_->end_row - half;
    bool crossed = false, contained = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &a = corners[i], &b = corners[i + 1 < corners.size() ? i + 1 : 0];
      crossed = crossed || meets(a, b, x_0, y_0, x_1, y_1);
      contained = contained && a.x >= x_0 && a.x <= x_1 && a.y >= y_0 && a.y <= y_1;
    }
    const bool inside = covers(corners, area_->first_column, area_->first_row);
    const Bin truth = !crossed    ? (inside ? Bin::surrounding : Bin::disjoint)
                      : contained ? Bin::contained
                                  : Bin::intersecting;
    // The side of a corner of the area is a sum of products that cancel; only it has rounding.
    double margin = std::numeric_limits<double>::infinity(), bound = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &a = corners[i], &b = corners[i + 1 < corners.size() ? i + 1 : 0];
      for (const Rational& x : {x_0, x_1})
        for (const Rational& y : {y_0, y_1}) {
          const Rational one = (b.x - a.x) * (y - a.y), other = (b.y - a.y) * (x - a.x);
          const double off = size_of(one - other), allowed = 4 * unit * (size_of(one) + size_of(other));
          if (allowed > 0 && (bound == 0 || off / allowed < margin / bound)) margin = off, bound = allowed;
        }
    }
    common_.note(Predicate::bin, outcome_of(e.bin == truth), margin, bound);
  }
  void judge(const PlaneDepth& e, const Situation& at) {
    if (auto depth = plane_at(e.piece, e.x_at, e.y_at, at)) depths_.push_back(*std::move(depth));
  }
  void judge(const AreaDecide& e, const Situation&) {
    const bool pixel = e.what == AreaCase::pixel;
    if (e.piece >= 0 && (pixel || e.what == AreaCase::front_surrounder))
      for (const PlaneAt& winner : depths_)
        for (const PlaneAt& other : depths_)
          if (winner.piece == e.piece && other.piece != e.piece && winner.x == other.x && winner.y == other.y)
            compare_planes(winner, other);
  }
  void judge(const SpanWinner& e, const Situation& at) {
    const std::vector<std::int32_t>& inside = at.method().sweep.inside;
    const auto& interval = at.method().sweep.interval;
    if (inside.size() < 2 || !interval) return;
    for (std::int32_t x = e.first; x <= e.last; ++x) {
      const auto winner = plane_at(e.piece, x, interval->y, at);
      for (const std::int32_t piece : inside) {
        const auto other = plane_at(piece, x, interval->y, at);
        if (winner && other && piece != e.piece) compare_planes(*winner, *other);
      }
    }
  }

 private:
  struct PlaneAt {
    std::int32_t piece;
    double x, y;
    Rational z;
    double bound;
  };
  std::optional<PlaneAt> plane_at(std::int32_t piece, double x, double y, const Situation& at) {
    const Wholly& whole = common_.whole_of(piece, at);
    if (!whole.plane || whole.plane->c == 0) return std::nullopt;
    const Rational z = whole.plane->depth(exactly(x), exactly(y));
    const Distance off = distance(*whole.plane, whole.corners, {exactly(x), exactly(y), z});
    const double steep = whole.plane->length() / size_of(whole.plane->c);
    return PlaneAt{piece, x, y, z, (off.bound + 4 * unit * size_of(z)) * steep};
  }
  /// Was it right to take `winner` for the one in front of `other`? Of equal depths the first of the file is.
  void compare_planes(const PlaneAt& winner, const PlaneAt& other) {
    const bool first = winner.piece < other.piece;
    const double apart = size_of(winner.z - other.z), bound = winner.bound + other.bound;
    // Depths that are equal to some twelve digits are a tie for the methods, which the first of the file wins.
    const bool tie = apart <= 1e-12 * std::max(1.0, size_of(winner.z)) + 100 * bound;
    const bool in_front = winner.z < other.z || (winner.z == other.z && first);
    common_.note(Predicate::plane_depth, outcome_of(in_front, tie && first), apart, bound);
  }

  Common& common_;
  std::optional<AreaBegin> area_;
  std::map<std::int32_t, std::set<std::int32_t>> surrounding_;  ///< by area: pieces
  std::vector<PlaneAt> depths_;                                 ///< of the area at work
};

// Decisions about a ray: boxes, facets and which of them is nearest.

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
    const std::size_t number = e.box;
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

// Decisions about curves and lines: against the horizons, and behind a face.

class CurveJudge {
 public:
  explicit CurveJudge(Common& common) : common_(common) {}

  void judge(const HorizonTest& e, const Situation& at) {
    const auto here = height_at(e.x, at);
    const Column& column = columns_[e.x];
    if (!here || !column.upper || !column.lower) return;
    const auto option = common_.trace.header().conventions.options.find("horizons");
    const bool one = option != common_.trace.header().conventions.options.end() && option->second == "one";
    const Horizon truth = here->y <= column.upper->y           ? Horizon::above
                          : !one && here->y >= column.lower->y ? Horizon::below
                                                               : Horizon::hidden;
    common_.note(Predicate::horizon, outcome_of(e.verdict == truth),
                 std::min(size_of(here->y - column.upper->y), size_of(here->y - column.lower->y)),
                 here->bound + std::max(column.upper->bound, column.lower->bound));
  }
  void judge(const HorizonMove& e, const Situation& at) {
    Column& column = columns_[e.x];
    std::optional<Height>& horizon = e.upper ? column.upper : column.lower;
    horizon.reset();
    if (!std::isfinite(e.y_curve)) return;
    horizon = height_at(e.x, at);
    if (!horizon || std::abs(rounded(horizon->y) - e.y_curve) > 1e-6) horizon = Height{exactly(e.y_curve), 0};
  }
  void judge(const LineAgainst& e, const Situation& at) {
    const std::size_t line = e.line;
    if (line >= at.method().lines.size() || e.outcome == LineFace::apart || e.outcome == LineFace::own) return;
    const LineBegin& entry = at.method().lines[line].entry;
    const auto a = common_.vertices.on_raster(entry.vertex_0, at), b = common_.vertices.on_raster(entry.vertex_1, at);
    std::vector<Point> corners;
    for (const std::int32_t corner : formulas::detail::corners_of(at, e.facet)) {
      const auto point = common_.vertices.on_raster(corner, at);
      if (!point) return;  // clipped
      corners.push_back(*point);
    }
    if (!a || !b || corners.size() < 3 || !is_convex(corners)) return;
    const Plane plane = oracle::plane_of(corners);
    const int away = plane.c.sign(), way = area_of(corners).sign();
    // The part of the line, from t = 0 to 1, that is behind the plane and within each edge.
    Rational from = 0, to = 1;
    const auto limit = [&](const Rational& d_0, const Rational& d_1) {  // where it is positive
      if (d_0 <= 0 && d_1 <= 0) to = from;
      else if (d_0 < 0) from = std::max(from, formulas::where_zero(d_0, d_1));
      else if (d_1 < 0) to = std::min(to, formulas::where_zero(d_0, d_1));
    };
    limit(plane.value(*a) * away, plane.value(*b) * away);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &c = corners[i], &d = corners[i + 1 < corners.size() ? i + 1 : 0];
      const auto side = [&](const Point& p) {
        return Rational(((d.x - c.x) * (p.y - c.y) - (d.y - c.y) * (p.x - c.x)) * way);
      };
      limit(side(*a), side(*b));
    }
    const bool truth = from < to, claim = e.outcome == LineFace::covered;
    const double hidden = truth ? rounded(to - from) * taxi(*b - *a) : 0;
    // Within the method's tolerances a face that is touched hides nothing: the far part may then be long.
    const Distance d_0 = distance(plane, corners, *a), d_1 = distance(plane, corners, *b);
    const bool touches = std::max(d_0.sign == away ? d_0.size : 0, d_1.sign == away ? d_1.size : 0) <= 2e-9;
    common_.note(Predicate::line_and_face, outcome_of(claim == truth, truth && (touches || hidden <= 4e-6)), hidden);
  }

 private:
  struct Height {
    Rational y;
    double bound;
  };
  struct Column {
    std::optional<Height> upper, lower;
  };
  std::optional<Height> height_at(std::int32_t x, const Situation& at) const {
    const auto& segment = at.method().horizon.segment;
    if (!segment) return std::nullopt;
    const auto a = common_.vertices.on_raster(segment->vertex_0, at),
               b = common_.vertices.on_raster(segment->vertex_1, at);
    if (!a || !b || a->x == b->x || (a->x < x && b->x < x) || (a->x > x && b->x > x)) return std::nullopt;
    return Height{formulas::on_line(a->y, b->y, Rational(x), a->x, b->x), 8 * unit * (size_of(a->y) + size_of(b->y))};
  }

  Common& common_;
  std::map<std::int32_t, Column> columns_;
};

}  // namespace zstep::oracle::deciding
