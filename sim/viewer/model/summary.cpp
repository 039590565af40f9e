#include "sim/viewer/model/summary.hpp"

#include <algorithm>
#include <cmath>

#include <glm/vec4.hpp>

#include "traces/file/header.hpp"
#include "traces/file/visit.hpp"

namespace zstep::viewer {

DepthRange range_between(double smallest, double largest, const Header& header) {
  const bool greater = header.comparison.nearer == Comparison::Nearer::greater;
  return {greater ? largest : smallest, greater ? smallest : largest, true, header.declares(Convention::nearer)};
}

DepthRange depth_range(const Trace& trace) {
  const Scene& scene = trace.scene();
  const Camera& camera = scene.camera;
  const bool screen = camera.kind == Camera::Kind::screen;
  if (!screen && !(camera.near < camera.far)) return {};
  double smallest = no_depth, largest = -no_depth;
  const auto add = [&](double z) {
    if (std::isfinite(z)) smallest = std::min(smallest, z), largest = std::max(largest, z);
  };
  for (const Facet& facet : scene.facets) {
    double nearest = no_depth, farthest = -no_depth;
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const std::size_t corner = facet.first_corner + k;
      const auto point =
          corner < scene.corners.size() ? static_cast<std::size_t>(scene.corners[corner]) : scene.points.size();
      if (point >= scene.points.size()) continue;
      const double z = screen ? scene.points[point].z : (camera.view * glm::dvec4(scene.points[point], 1)).z;
      nearest = std::min(nearest, z);
      farthest = std::max(farthest, z);
    }
    if (screen) add(nearest), add(farthest);
    if (screen || !(nearest <= camera.far && farthest >= camera.near)) continue;  // nothing of it is in view
    // What is cut by the near or the far plane reaches as far as that.
    for (const double z_v : {nearest, farthest})
      add(buffer_depth(camera, trace.header().conventions, std::clamp(z_v, camera.near, camera.far)));
  }
  return smallest <= largest ? range_between(smallest, largest, trace.header()) : DepthRange{};
}

std::optional<std::int64_t> ScanLineMarks::sweep_from(const Trace& trace) {
  if (sweep_known_) return sweep_from_;
  sweep_known_ = true;
  if (!sweeps(trace.header())) return std::nullopt;
  const std::int64_t gathered = trace.polygons().empty() ? 0 : trace.polygons().back().position;
  const auto line = trace.next(gathered, [](const RecordedEvent& e) { return holds<ScanLineBegin>(e.event); });
  if (line) sweep_from_ = *line - 1;
  return sweep_from_;
}

const ScanLineMarks::Interval& ScanLineMarks::at(const Trace& trace, std::int64_t position) {
  const auto polygons = trace.polygons();
  const auto after = std::upper_bound(polygons.begin(), polygons.end(), position,
                                      [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
  Interval s;
  s.last = after == polygons.end() ? trace.size() : after->position;
  if (after != polygons.begin()) {
    s.first = (after - 1)->position;
    s.polygon = (after - 1)->polygon;
  }
  const std::optional<std::int64_t> sweep = sweep_from(trace);
  const bool sweeping = sweep && position > *sweep;
  if (sweeping) {
    s.first = *sweep;
    s.polygon = no_polygon;
  } else if (sweep && s.last > *sweep) {
    s.last = *sweep;
  }
  if (interval_ && interval_->first == s.first && interval_->last == s.last && interval_->polygon == s.polygon)
    return *interval_;
  s.complete = s.last - s.first <= quick;
  if (s.complete && (sweeping || s.polygon != no_polygon))
    trace.each(s.first, s.last, [&](std::int64_t p, const RecordedEvent& recorded) {
      if (const auto* line = get_if<ScanLineBegin>(&recorded.event)) s.lines.push_back({p, line->y});
      return true;
    });
  interval_ = std::move(s);
  return *interval_;
}

namespace {

/// Calls visit(position, event) for each event of kind E; for none where the trace is too long to look through.
template <class E, class Visit>
void visit_each(const Trace& trace, Visit&& visit) {
  if (!records<E>(trace.header()) || trace.size() > quick) return;
  trace.scan(Trace::Among(std::nullopt, kind_of<E>), [&](std::int64_t position, const RecordedEvent& recorded) {
    visit(position, get<E>(recorded.event));
    return true;
  });
}

/// The last mark at or before a position: its place, −1 before the first.
template <class Mark>
std::ptrdiff_t last_before(const std::vector<Mark>& marks, std::int64_t position) {
  const auto after = std::upper_bound(marks.begin(), marks.end(), position,
                                      [](std::int64_t p, const Mark& mark) { return p < mark.position; });
  return after - marks.begin() - 1;
}

}  // namespace

const std::vector<CurveMarks::Mark>& CurveMarks::of(const Trace& trace) {
  if (marks_) return *marks_;
  marks_.emplace();
  visit_each<CurveBegin>(trace, [&](std::int64_t position, const CurveBegin& curve) {
    marks_->push_back({position, curve});
  });
  return *marks_;
}

std::ptrdiff_t CurveMarks::at(const Trace& trace, std::int64_t position) { return last_before(of(trace), position); }

const std::vector<RowMarks::Mark>& RowMarks::of(const Trace& trace) {
  if (marks_) return *marks_;
  marks_.emplace();
  visit_each<RayBegin>(trace, [&](std::int64_t position, const RayBegin& ray) {
    if (marks_->empty() || marks_->back().y != ray.y) marks_->push_back({position, ray.y});
  });
  return *marks_;
}

std::ptrdiff_t RowMarks::at(const Trace& trace, std::int64_t position) { return last_before(of(trace), position); }

void HitCounts::follow(const Trace& trace, std::int64_t position) {
  // What is known depends on the position alone, not on the way that led to it.
  known_ = position <= quick;
  if (!known_) return;
  if (std::abs(position - position_) > position) {  // cheaper to count from the beginning
    count_.fill(0);
    position_ = 0;
  }
  const std::int64_t change = position > position_ ? 1 : -1;
  const std::int64_t low = std::min(position, position_), high = std::max(position, position_);
  if (high - low < 64) {
    for (std::int64_t p = low + 1; p <= high; ++p)
      if (trace.impl().readable(p)) count_[trace.event(p).step] += change;
  } else {
    trace.each(low, high, [&](std::int64_t, const RecordedEvent& recorded) {
      count_[recorded.step] += change;
      return true;
    });
  }
  position_ = position;
}

}  // namespace zstep::viewer
