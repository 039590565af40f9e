// Decisions about pieces: on which side of a plane, and whether two overlap.
#pragma once

#include <algorithm>
#include <vector>

#include "traces/oracle/deciding.hpp"

namespace zstep::oracle::deciding {

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
    const auto node = static_cast<std::size_t>(e.node);
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

}  // namespace zstep::oracle::deciding
