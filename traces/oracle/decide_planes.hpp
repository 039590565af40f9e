// Decisions about areas of the raster, and about which of two planes is nearer.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "traces/oracle/deciding.hpp"

namespace zstep::oracle::deciding {

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

}  // namespace zstep::oracle::deciding
