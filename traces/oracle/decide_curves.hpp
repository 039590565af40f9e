// Decisions about curves and lines: against the horizons, and behind a face.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "traces/formulas/lines.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/oracle/deciding.hpp"

namespace zstep::oracle::deciding {

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
    const auto line = static_cast<std::size_t>(e.line);
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
