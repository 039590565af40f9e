// Decisions about a polygon before it is drawn, and about the ends of its spans.
#pragma once

#include <algorithm>
#include <optional>

#include "traces/formulas/lines.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/oracle/deciding.hpp"

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

}  // namespace zstep::oracle::deciding
