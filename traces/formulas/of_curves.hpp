// The floating horizon (004, "Some of the methods of hidden surface elimination").
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "traces/formulas/lines.hpp"
#include "traces/formulas/follows.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

template <>
inline constexpr bool joins_things<CurveSegment> = true;

template <class Out>
void derive(const HorizonTest& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  if (work.segment) {
    const auto a = at.on_raster(work.segment->vertex_0), b = at.on_raster(work.segment->vertex_1);
    // A curve that is seen edge-on between two columns stands on the nearest one.
    if (a && b && a->x != b->x && e.x >= std::min(a->x, b->x) && e.x <= std::max(a->x, b->x)) {
      const Place from{Place::In::vertex, work.segment->vertex_0}, to{Place::In::vertex, work.segment->vertex_1};
      out.gives(&HorizonTest::y_curve, on_line(out.number("y_0", a->y, from["y_s"]), out.number("y_1", b->y, to["y_s"]),
                                               out.number("x", e.x, Place{}), out.number("x_0", a->x, from["x_s"]),
                                               out.number("x_1", b->x, to["x_s"])));
    }
  }
  const auto column = static_cast<std::size_t>(e.x);
  if (e.x < 0 || column >= work.upper.size() || column >= work.lower.size()) return;
  const double upper = work.upper[column], lower = work.lower[column];
  out.reads(Place{Place::In::horizon, e.x});
  const auto option = at.header.conventions.options.find("horizons");
  const bool one = option != at.header.conventions.options.end() && option->second == "one";
  // An entry is NaN while nothing was drawn in its column.
  const bool above = !(e.y_curve > upper), below = !one && !(e.y_curve < lower);
  out.is(&HorizonTest::verdict, above ? Horizon::above : below ? Horizon::below : Horizon::hidden);
}

template <class Out>
void derive(const CurveBegin& e, const Situation& at, Out& out) {
  const auto& last = at.method().horizon.curve;
  out.rule(Rule::number_is_next, e.curve == (last ? last->curve + 1 : 0));
  if (!at.scene.surface) return;
  const Surface& surface = *at.scene.surface;
  if (e.row < 0 || e.row >= (e.across ? surface.columns : surface.rows)) return;
  // A sample stands at (x, z, y) in the world.
  const glm::dvec3& first = at.scene.points[static_cast<std::size_t>(e.across ? e.row : e.row * surface.columns)];
  out.is(&CurveBegin::constant, e.across ? first.x : first.y);
}

template <class Out>
void derive(const HorizonMove& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  const auto column = static_cast<std::size_t>(e.x);
  const auto& own = e.upper ? work.upper : work.lower;
  if (e.x < 0 || column >= own.size() || !std::isfinite(e.y_curve)) return;
  out.reads(Place{Place::In::horizon, e.x});
  const double before = own[column];
  out.rule(Rule::horizon_moves_out, std::isnan(before) || (e.upper ? e.y_curve <= before : e.y_curve >= before));
  if (work.test && work.test->x == e.x) out.is(&HorizonMove::y_curve, work.test->y_curve);
}

/// Where a curve crosses a horizon between two columns, both taken as straight there: at the part d_0/(d_0 − d_1) of
/// the way, d being how far the curve is from the horizon.
template <class Out>
void derive(const HorizonCross& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  if (work.test) out.rule(Rule::cross_beside, std::abs(e.x_at - work.test->x) <= 1);
  if (!work.before || !work.here) return;
  const HorizonPassage &from = *work.before, &to = *work.here;
  const double before = e.upper ? from.upper : from.lower, here = e.upper ? to.upper : to.lower;
  if (std::abs(from.test.x - to.test.x) != 1 || !std::isfinite(before) || !std::isfinite(here)) return;
  const auto horizon = [&](std::string_view name, double value, std::int32_t x) {
    return out.number(name, value, Place{Place::In::horizon, x});
  };
  const auto y_0 = out.number("y_0", from.test.y_curve, Place{}), y_1 = out.number("y_1", to.test.y_curve, Place{}),
             x_0 = out.number("x_0", from.test.x, Place{}), x_1 = out.number("x_1", to.test.x, Place{});
  const auto t = where_zero(out.named("d_0", y_0 - horizon("h_0", before, from.test.x)),
                            out.named("d_1", y_1 - horizon("h_1", here, to.test.x)));
  out.gives(&HorizonCross::x_at, part_of_way(x_0, x_1, t));
  out.gives(&HorizonCross::y_at, part_of_way(y_0, y_1, t));
}

namespace detail {

/// Of a curve on two columns, the ends of what is drawn between them of its part above or below the horizons.
struct VisiblePart {
  double x_0, y_0, x_1, y_1;
  Horizon where;
};
inline std::vector<VisiblePart> visible_parts(const HorizonPassage& from, const HorizonPassage& to) {
  const double x_0 = from.test.x, y_0 = from.test.y_curve, x_1 = to.test.x, y_1 = to.test.y_curve;
  std::vector<VisiblePart> parts;
  if (from.test.verdict == to.test.verdict) {
    if (to.test.verdict != Horizon::hidden) parts.push_back({x_0, y_0, x_1, y_1, to.test.verdict});
    return parts;
  }
  for (const bool begins : {true, false}) {
    const Horizon where = begins ? from.test.verdict : to.test.verdict;
    if (where == Horizon::hidden) continue;
    const bool upper = where == Horizon::above;
    const double t = where_zero(y_0 - (upper ? from.upper : from.lower), y_1 - (upper ? to.upper : to.lower));
    const bool crosses = t >= 0 && t <= 1;  // else only the column itself is drawn
    const double x = crosses  ? part_of_way(x_0, x_1, t)
                     : begins ? x_0
                              : x_1,
                 y = crosses  ? part_of_way(y_0, y_1, t)
                     : begins ? y_0
                              : y_1;
    parts.push_back(begins ? VisiblePart{x_0, y_0, x, y, where} : VisiblePart{x, y, x_1, y_1, where});
  }
  return parts;
}

/// Does the part come as near to a pixel's centre as `reach` in x and in y?
inline bool comes_near(const VisiblePart& part, double x, double y, double reach) {
  double low = 0, high = 1;
  const auto narrow = [&](double from, double to, double centre) {
    if (from == to) {
      if (std::abs(from - centre) > reach) high = -1;
      return;
    }
    const double one = (centre - reach - from) / (to - from), other = (centre + reach - from) / (to - from);
    low = std::max(low, std::min(one, other)), high = std::min(high, std::max(one, other));
  };
  narrow(part.x_0, part.x_1, x), narrow(part.y_0, part.y_1, y);
  return low <= high;
}

/// Ink of what is seen above the upper horizon, which is told from the paper, and of what is seen below the lower one.
inline Color ink_of_curve(const Color& paper, Horizon where) {
  if (where == Horizon::below) return {213, 94, 0};
  const bool dark = 2 * paper.red + 5 * paper.green + paper.blue < 4 * 255;
  return dark ? Color{255, 255, 255} : Color{0, 0, 0};
}

/// The part of the curve at work that a pixel is drawn of, where it is between the last two columns; with none, nothing
/// of what is visible there comes near it. Of several parts it is the one that it has the ink of.
struct DrawnOfCurve {
  bool known = false;
  std::optional<VisiblePart> part{};
};
inline DrawnOfCurve drawn_of_curve(const Situation& at, const ColorWrite& e) {
  const HorizonWork& work = at.method().horizon;
  if (!work.here) return {};
  const HorizonPassage& to = *work.here;
  const bool joined = work.before && std::abs(work.before->test.x - to.test.x) <= 1;  // 0 where it rises in one column
  const HorizonPassage& from = joined ? *work.before : to;
  if (e.x < std::min(from.test.x, to.test.x) || e.x > std::max(from.test.x, to.test.x)) return {};
  constexpr double reach = 1;  // programs draw lines in more than one way
  std::vector<VisiblePart> parts = visible_parts(from, to);
  if (joined)  // a piece that was cut off begins anew
    for (const VisiblePart& alone : visible_parts(to, to)) parts.push_back(alone);
  DrawnOfCurve drawn{true};
  for (const VisiblePart& part : parts) {
    if (!comes_near(part, e.x, e.y, reach + rounding_of_float32)) continue;
    const Color ink = ink_of_curve(at.scene.background, part.where);
    const bool of_its_ink = ink.red == e.r8 && ink.green == e.g8 && ink.blue == e.b8;
    if (of_its_ink || !drawn.part) drawn.part = part;
    if (of_its_ink) break;
  }
  return drawn;
}

}  // namespace detail

}  // namespace zstep::formulas
