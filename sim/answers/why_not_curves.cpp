// The floating horizon: a polygon is a cell of the surface, and is seen where one of the curves along its border is.
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/answers/why_not_parts.hpp"

namespace zstep::answers {
namespace {

/// A piece of a curve along the polygon's border: the step of its curve_segment and the one at which it ends.
struct Segment {
  std::int64_t begin = 0, end = 0;
  CurveSegment ends{};
};

std::set<std::int32_t> corners_of(const Asked& q, std::int32_t polygon) {
  std::set<std::int32_t> corners;
  for (const Facet& facet : q.scene.facets) {
    if (facet.polygon != polygon) continue;
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      corners.insert(q.scene.corners[static_cast<std::size_t>(facet.first_corner + k)]);
  }
  return corners;
}

/// A side of the cell, not its diagonal.
bool is_side(const Asked& q, const std::set<std::int32_t>& corners, const CurveSegment& segment) {
  if (!corners.contains(segment.vertex_0) || !corners.contains(segment.vertex_1)) return false;
  const std::int32_t apart = std::abs(segment.vertex_0 - segment.vertex_1);
  return !q.scene.surface || apart == 1 || apart == q.scene.surface->columns;
}

/// Whose curve a step belongs to: the first cell that has the segment as a side.
std::int32_t owner_of(const Asked& q, std::int64_t step) {
  const auto begin = previous_of<CurveSegment>(q.trace, step);
  if (!begin || !q.scene.surface) return no_polygon;
  const CurveSegment segment = *event_at<CurveSegment>(q.trace, *begin);
  for (const Facet& facet : q.scene.facets) {
    int found = 0;
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const std::int32_t corner = q.scene.corners[static_cast<std::size_t>(facet.first_corner + k)];
      found += corner == segment.vertex_0 || corner == segment.vertex_1;
    }
    if (found == 2 && facet.polygon != q.polygon) return facet.polygon;
  }
  return no_polygon;
}

/// A curve in the pixel's column.
struct There {
  std::int64_t step = 0;
  HorizonTest test{};
  double low = 0, high = 0;  ///< rows that it passes within the column
  bool passes(std::int32_t row) const { return low - 0.5 <= row && row <= high + 0.5; }
};

std::vector<There> tests_in_column(const Asked& q, const Segment& segment) {
  std::vector<There> all;
  std::vector<std::pair<std::int64_t, HorizonTest>> tests;
  for (std::int64_t step = segment.begin + 1; step < segment.end; ++step)
    if (const auto test = event_at<HorizonTest>(q.trace, step)) tests.emplace_back(step, *test);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const HorizonTest& test = tests[k].second;
    if (test.x != q.pixel.x) continue;
    There there{tests[k].first, test, test.y_curve, test.y_curve};
    for (const std::size_t next : {k - 1, k + 1}) {  // k - 1 of 0 is beyond the end
      if (next >= tests.size() || std::abs(tests[next].second.x - test.x) != 1) continue;
      const double halfway = (test.y_curve + tests[next].second.y_curve) / 2;
      there.low = std::min(there.low, halfway), there.high = std::max(there.high, halfway);
    }
    all.push_back(there);
  }
  return all;
}

std::optional<Verdict> drawn(Asked& q, const Segment& segment) {
  const auto here = [&](const RecordedEvent& recorded) {
    const auto* color = get_if<ColorWrite>(&recorded.event);
    return color && color->x == q.pixel.x && color->y == q.pixel.y;
  };
  const auto step = next_within(q.trace, segment.begin, segment.end, here);
  if (!step) return std::nullopt;
  Verdict verdict =
      seen(q, *step, "a curve along its border is drawn through it", "the pixel gets the colour of curves");
  verdict.chain.push_back(
      {segment.begin, q.polygon,
       fmt::format("the curve from sample {} to sample {}", segment.ends.vertex_0, segment.ends.vertex_1)});
  if (const auto test = previous_of<HorizonTest>(q.trace, *step, segment.begin)) {
    verdict.chain.push_back({*test, q.polygon, "the curve is held against the horizons of its column"});
    q.add_formulas(verdict, *test);
  }
  return verdict;
}

Verdict hidden(Asked& q, const Segment& segment, const There& there) {
  const auto moved = previous_within(q.trace, there.step, 0, [&](const RecordedEvent& recorded) {
    const auto* move = get_if<HorizonMove>(&recorded.event);
    return move && move->x == q.pixel.x && std::isfinite(move->y_curve);
  });
  Verdict verdict =
      q.verdict(Why::horizon, there.step,
                fmt::format("its curve passes there at y = {}, but it is hidden by the horizons of column {}",
                            number(there.test.y_curve), q.pixel.x));
  q.add_formulas(verdict, there.step);
  if (moved) {
    verdict.other = owner_of(q, *moved);
    verdict.chain.push_back({*moved, verdict.other,
                             fmt::format("a nearer curve moves a horizon of column {} to y = {}", q.pixel.x,
                                         number(event_at<HorizonMove>(q.trace, *moved)->y_curve))});
  }
  verdict.chain.push_back(
      {segment.begin, q.polygon,
       fmt::format("the curve from sample {} to sample {}", segment.ends.vertex_0, segment.ends.vertex_1)});
  verdict.chain.push_back({there.step, q.polygon, "its point in this column is hidden"});
  return verdict;
}

std::vector<Segment> segments_of(const Asked& q) {
  const std::set<std::int32_t> corners = corners_of(q, q.polygon);
  const auto of_it = [&](const RecordedEvent& recorded) {
    const auto* segment = get_if<CurveSegment>(&recorded.event);
    return segment && is_side(q, corners, *segment);
  };
  const std::int64_t end = q.trace.size() + 1;
  std::vector<Segment> segments;
  for (auto step = q.trace.next(0, of_it); step; step = q.trace.next(*step, of_it))
    segments.push_back({*step, next_of<CurveSegment, CurveBegin>(q.trace, *step, end).value_or(end),
                        *event_at<CurveSegment>(q.trace, *step)});
  return segments;
}

}  // namespace

bool of_curves(const Trace& trace) { return trace.has(kind_of<HorizonTest>); }

Verdict why_by_curves(Asked& q) {
  const std::vector<Segment> segments = segments_of(q);
  const There* behind = nullptr;
  const Segment* its = nullptr;
  std::vector<std::vector<There>> columns;
  std::string rows;
  for (const Segment& segment : segments) {
    if (auto verdict = drawn(q, segment)) return *verdict;
    columns.push_back(tests_in_column(q, segment));
  }
  for (std::size_t k = 0; k < segments.size(); ++k)
    for (const There& there : columns[k]) {
      rows += (rows.empty() ? "" : ", ") + number(there.test.y_curve);
      if (there.test.verdict == Horizon::hidden && there.passes(q.pixel.y)) behind = &there, its = &segments[k];
    }
  if (behind) return hidden(q, *its, *behind);
  const std::int64_t step = segments.empty() ? 0 : segments.front().begin;
  Verdict verdict = q.verdict(
      Why::not_covered, step,
      rows.empty()
          ? fmt::format("only curves are drawn, and none along its border meets column {}", q.pixel.x)
          : fmt::format("only curves are drawn, and those along its border pass column {} at y = {}", q.pixel.x, rows));
  for (const Segment& segment : segments)
    verdict.chain.push_back(
        {segment.begin, q.polygon,
         fmt::format("the curve from sample {} to sample {}", segment.ends.vertex_0, segment.ends.vertex_1)});
  return verdict;
}

Verdict curves_anywhere(Asked& q) {
  std::size_t visible = 0, hidden = 0;
  std::optional<Trace::Pixel> drawn, behind;
  for (const Segment& segment : segments_of(q))
    for (std::int64_t step = segment.begin + 1; step < segment.end; ++step) {
      if (const auto color = event_at<ColorWrite>(q.trace, step); color && !drawn)
        drawn = Trace::Pixel{color->x, color->y};
      const auto test = event_at<HorizonTest>(q.trace, step);
      if (!test) continue;
      (test->verdict == Horizon::hidden ? hidden : visible) += 1;
      const auto row =
          static_cast<std::int32_t>(std::clamp(std::round(test->y_curve), 0.0, q.scene.raster.height - 1.0));
      if (test->verdict == Horizon::hidden && !behind)
        behind = Trace::Pixel{std::clamp(test->x, 0, q.scene.raster.width - 1), row};
    }
  const std::string whole = fmt::format("Of the {} of the curves around {}, {} visible and {} hidden.",
                                        count_text(visible + hidden, "point", "points"), q.name, visible, hidden);
  return with_pixel(q, drawn ? *drawn : behind.value_or(q.pixel), whole);
}

}  // namespace zstep::answers
