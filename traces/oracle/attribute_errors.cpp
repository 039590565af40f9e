#include "traces/oracle/attribute_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "traces/formulas/attributes.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/oracle/exact_geometry.hpp"

namespace zstep::oracle {
namespace {

using formulas::Situation;
using OverDepth = formulas::OverDepth<Rational>;

/// A span's two ends, exactly: as they are on the polygon, or as the run takes them.
struct Ends {
  OverDepth left{}, right{};
  Rational x_left, x_right;

  Rational attribute(std::int32_t x) const {
    const OverDepth here = x_left == x_right ? left : formulas::on_line(left, right, Rational(x), x_left, x_right);
    return here.over_z / here.one_over_z;
  }
};

/// Where an edge meets a scan line.
struct OnEdge {
  OverDepth over_depth{};
  Rational x;
};

class AttributeJudge {
 public:
  explicit AttributeJudge(const Trace& trace)
      : in_perspective_(trace.scene().camera.kind == Camera::Kind::perspective),
        divides_(formulas::attribute_over_depth(trace.scene(), trace.header().conventions)) {
    const Raster& raster = trace.scene().raster;
    errors_.rounding_of_pixel.assign(Picture(raster.width, raster.height).depth.size(),
                                     std::numeric_limits<double>::quiet_NaN());
  }

  void begin_span() { tried_ = nullptr; }

  void take(std::int64_t step, const AttributeInterpolate& e, const Situation& at) {
    find_ends(at, e);
    if (!on_polygon_) {
      ++errors_.not_judged;
      return;
    }
    if (!std::isfinite(e.attribute)) {
      if (++errors_.not_finite == 1) errors_.largest_step = step;
      errors_.largest = errors_.sum_of_squares = errors_.rounding = std::numeric_limits<double>::infinity();
      errors_.rounding_of_pixel[at.pixel(e.x, e.y)] = errors_.rounding;
      ++errors_.attributes;
      return;
    }
    const Rational a = exactly(e.attribute);
    const double off = std::abs(rounded(a - on_polygon_->attribute(e.x)));
    ++errors_.attributes;
    errors_.sum_of_squares += off * off;
    if (off > errors_.largest) errors_.largest = off, errors_.largest_step = step;
    const double by_rounding = as_run_ ? std::abs(rounded(a - as_run_->attribute(e.x))) : off;
    errors_.rounding = std::max(errors_.rounding, by_rounding);
    errors_.rounding_of_pixel[at.pixel(e.x, e.y)] = by_rounding;
  }

  AttributeErrors finish() { return std::move(errors_); }

 private:
  void find_ends(const Situation& at, const AttributeInterpolate& e) {
    const Situation::SpanOfPixel span = at.span_of(e);
    const formulas::Shading shading = formulas::shading_of(at.scene, at.header.conventions);
    const std::int32_t component = formulas::detail::component_at_work(at, shading, e.x, e.y);
    if (span && span.span == tried_ && component == component_) return;
    tried_ = span.span, shading_ = shading, component_ = component;
    on_polygon_ = ends(at, span, e.y, in_perspective_);
    as_run_ = divides_ != in_perspective_ ? ends(at, span, e.y, divides_) : std::nullopt;
  }
  std::optional<Ends> ends(const Situation& at, const Situation::SpanOfPixel& span, std::int32_t y,
                           bool divides) const {
    if (!span || span->y != y || span.is_of_other(at)) return std::nullopt;
    const auto left = on_edge(at, span->left_edge, y, divides), right = on_edge(at, span->right_edge, y, divides);
    if (!left || !right) return std::nullopt;
    return Ends{left->over_depth, right->over_depth, left->x, right->x};
  }
  std::optional<OnEdge> on_edge(const Situation& at, std::int32_t edge, std::int32_t y, bool divides) const {
    const EdgeTableInsert* entry = at.edge(edge);
    if (!entry) return std::nullopt;
    const auto from = at.on_raster(entry->vertex_0), to = at.on_raster(entry->vertex_1);
    if (!from || !to || from->y == to->y) return std::nullopt;
    const auto p_0 = of_vertex(at, entry->vertex_0, divides), p_1 = of_vertex(at, entry->vertex_1, divides);
    if (!p_0 || !p_1) return std::nullopt;
    const Rational y_0 = exactly(from->y), y_1 = exactly(to->y), line(y);
    return OnEdge{formulas::on_line(*p_0, *p_1, line, y_0, y_1),
                  formulas::on_line(exactly(from->x), exactly(to->x), line, y_0, y_1)};
  }
  std::optional<OverDepth> of_vertex(const Situation& at, std::int32_t vertex, bool divides) const {
    const VertexStages* stages = at.viewed(vertex);
    if (!stages && !at.on_screen()) return std::nullopt;
    if (!shading_.is_known() || (shading_.attribute && !at.is_facet(at.method().facet))) return std::nullopt;
    const Rational a = exactly(
        formulas::detail::attribute_at(at, shading_, component_, vertex, stages ? stages->view : glm::dvec3(0)));
    if (!divides) return OverDepth{a, 1};
    if (stages->view.z == 0) return std::nullopt;
    return formulas::over_depth(a, exactly(stages->view.z));
  }

  bool in_perspective_, divides_;
  const SpanBegin* tried_ = nullptr;  ///< the span whose ends these are
  formulas::Shading shading_;
  std::int32_t component_ = 0;  ///< of the attribute, whose ends these are
  std::optional<Ends> on_polygon_, as_run_;
  AttributeErrors errors_;
};

}  // namespace

double AttributeErrors::root_mean_square() const {
  return attributes == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(attributes));
}

AttributeErrors attribute_errors_of(const Trace& trace) {
  AttributeJudge judge(trace);
  formulas::walk(
      trace,
      [&]<class E>(std::int64_t position, const E& e, const Situation& at) {
        if constexpr (std::is_same_v<E, SpanBegin>) judge.begin_span();
        if constexpr (std::is_same_v<E, AttributeInterpolate>) judge.take(position, e, at);
        return true;
      },
      [](std::int64_t, const Impossible&) {});
  return judge.finish();
}

}  // namespace zstep::oracle
