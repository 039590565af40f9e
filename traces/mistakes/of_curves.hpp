// Mistakes with the floating horizon (004).
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "traces/formulas/of_curves.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

/// The rows of a surface from the nearest to the farthest, where all are on one side of the eye; else none.
inline std::vector<std::int32_t> rows_from_eye(const Situation& at) {
  if (!at.scene.surface || !at.camera || at.scene.surface->columns <= 0) return {};
  const auto columns = static_cast<std::size_t>(at.scene.surface->columns);
  std::vector<std::int32_t> rows(at.scene.points.size() / columns);
  std::iota(rows.begin(), rows.end(), 0);
  const auto place = [&](std::int32_t row) { return at.scene.points[static_cast<std::size_t>(row) * columns].y; };
  const double eye = at.camera->eye.y;
  const auto is_ahead = [&](std::int32_t row) {
    return at.camera->kind == Camera::Kind::perspective ? place(row) >= eye : eye <= 0;
  };
  const bool ahead = !rows.empty() && is_ahead(rows.front());
  for (const std::int32_t row : rows)
    if (is_ahead(row) != ahead) return {};
  std::stable_sort(rows.begin(), rows.end(), [&](std::int32_t one, std::int32_t other) {
    return ahead ? place(one) < place(other) : place(one) > place(other);
  });
  return rows;
}

/// On the last column the curve was seen below all before it: has the lower horizon come down there since?
inline void suppose_lower_moved(const Situation& at, Supposed& out) {
  const HorizonWork& work = at.method().horizon;
  if (!work.here || work.here->test.verdict == Horizon::hidden) return;
  const HorizonPassage& last = *work.here;
  const auto column = static_cast<std::size_t>(last.test.x);
  if (last.test.x < 0 || column >= work.lower.size() || !(last.test.y_curve > last.lower)) return;
  // Who does not move it either uses it all the same, or has the upper one alone.
  for (const Mistake mistake : {lower_never_moves, only_upper})
    out.says(mistake, work.lower[column] == last.lower, work.lower[column] != last.lower);
}

}  // namespace detail

inline void suppose(const CurveBegin& e, const Situation& at, Supposed& out) {
  detail::suppose_lower_moved(at, out);
  if (e.across || (at.method().horizon.curve && at.method().horizon.curve->across)) return;
  const std::vector<std::int32_t> rows = detail::rows_from_eye(at);
  const auto turn = static_cast<std::size_t>(e.curve);
  if (e.curve < 0 || turn >= rows.size()) return;
  out.whole(farthest_first, "row", e.row, {rows[rows.size() - 1 - turn]}, {rows[turn]});
}

inline void suppose(const HorizonCross& e, const Situation& at, Supposed& out) {
  const HorizonWork& work = at.method().horizon;
  if (!work.before || !work.here) return;
  const HorizonPassage &from = *work.before, &to = *work.here;
  const Rounded y_0 = from.test.y_curve, y_1 = to.test.y_curve, x_0 = from.test.x, x_1 = to.test.x;
  const Rounded d_0 = y_0 - Rounded(e.upper ? from.upper : from.lower),
                d_1 = y_1 - Rounded(e.upper ? to.upper : to.lower);
  if (!std::isfinite(d_0.value) || !std::isfinite(d_1.value)) return;
  const Rounded t = formulas::where_zero(d_0, d_1), other = formulas::where_zero(d_1, d_0);
  const auto part = [&](std::string_view field, double recorded, const Rounded& begin, const Rounded& end) {
    out.number(crossing_from_end, field, recorded, {formulas::part_of_way(begin, end, other)},
               formulas::part_of_way(begin, end, t));
  };
  part("x_at", e.x_at, x_0, x_1);
  part("y_at", e.y_at, y_0, y_1);
}

inline void suppose(const ColorWrite& e, const Situation& at, Supposed& out) {
  const auto drawn = formulas::detail::drawn_of_curve(at, e);
  const HorizonWork& work = at.method().horizon;
  if (!drawn.known || !drawn.part || !work.here) return;
  // Where both parts meet, either ink may be right.
  const Horizon where = work.here->test.verdict;
  if (where == Horizon::hidden || (work.before && work.before->test.verdict != where)) return;
  const auto is = [&](Horizon of) {
    const Color ink = formulas::detail::ink_of_curve(at.scene.background, of);
    return ink.red == e.r8 && ink.green == e.g8 && ink.blue == e.b8;
  };
  out.says(one_ink, is(Horizon::above), is(where), "r8 g8 b8");
}

inline void suppose(const HorizonTest& e, const Situation& at, Supposed& out) {
  detail::suppose_lower_moved(at, out);
  const HorizonWork& work = at.method().horizon;
  const auto column = static_cast<std::size_t>(e.x);
  if (work.segment) {
    const auto a = at.on_raster(work.segment->vertex_0), b = at.on_raster(work.segment->vertex_1);
    if (a && b && a->x != b->x && e.x > std::min(a->x, b->x) && e.x < std::max(a->x, b->x))
      out.number(not_interpolated, "y_curve", e.y_curve, {Rounded(a->y), Rounded(b->y)},
                 formulas::on_line(Rounded(a->y), Rounded(b->y), Rounded(e.x), Rounded(a->x), Rounded(b->x)));
  }
  if (e.x < 0 || column >= work.upper.size() || column >= work.lower.size()) return;
  const bool above = !(e.y_curve > work.upper[column]), below = !(e.y_curve < work.lower[column]);
  if (above || !below) return;
  out.says(only_upper, e.verdict == Horizon::hidden, e.verdict == Horizon::below, "verdict");
  if (e.verdict == Horizon::hidden) out.rules_out(lower_never_moves);
}

}  // namespace zstep::mistakes
