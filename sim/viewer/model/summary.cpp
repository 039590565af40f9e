#include "sim/viewer/model/summary.hpp"

#include <algorithm>
#include <cmath>

namespace zstep::viewer {

namespace {
constexpr std::int64_t quick = 3'000'000;  // events that can be looked through between two frames
}

DepthRange depth_range(const Trace& trace) {
  DepthRange range;
  double near = no_depth, far = -no_depth;
  const auto add = [&](double z) {
    if (!std::isfinite(z)) return;
    near = std::min(near, z);
    far = std::max(far, z);
  };
  const Scene& scene = trace.scene();
  const Camera& camera = scene.camera;
  if (camera.kind == Camera::Kind::screen) {
    for (const std::int32_t corner : scene.corners)
      if (corner >= 0 && static_cast<std::size_t>(corner) < scene.points.size()) add(scene.points[static_cast<std::size_t>(corner)].z);
  } else {
    // The vertices that are in view in depth, as the trace's own projection gives them; where some are not, the planes.
    const std::int64_t end = trace.polygons().empty() ? trace.size() : trace.polygons().front().position;
    for (std::int64_t p = 1; p <= std::min(end, quick); ++p) {
      const auto* projected = std::get_if<Projection>(&trace.event(p).event);
      if (!projected) continue;
      const double z_v = view_depth(camera, trace.header().conventions, projected->z);
      if (z_v >= camera.near && z_v <= camera.far) add(projected->z);
    }
  }
  if (!(near <= far)) return range;
  range = {near, far, true};
  if (near == far) range = {near - 0.5, far + 0.5, true};
  return range;
}

const ScanLineMarks::Stretch& ScanLineMarks::at(const Trace& trace, std::int64_t position) {
  if (stretch_ && position >= stretch_->first && position < stretch_->last) return *stretch_;
  if (stretch_ && position == stretch_->last && position == trace.size()) return *stretch_;
  const auto polygons = trace.polygons();
  const auto after = std::upper_bound(polygons.begin(), polygons.end(), position,
                                      [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
  Stretch s;
  s.last = after == polygons.end() ? trace.size() : after->position;
  if (after != polygons.begin()) {
    s.first = (after - 1)->position;
    s.polygon = (after - 1)->polygon;
  }
  s.complete = s.last - s.first <= quick;
  if (s.complete && s.polygon != no_polygon)
    for (std::int64_t p = s.first + 1; p <= s.last; ++p)
      if (const auto* line = std::get_if<ScanLineBegin>(&trace.event(p).event)) s.lines.push_back({p, line->y});
  stretch_ = std::move(s);
  return *stretch_;
}

void HitCounts::follow(const Trace& trace, std::int64_t position) {
  if (known_ && position == position_) return;
  if (!known_ || std::abs(position - position_) > std::min(position, quick)) {
    // Cheaper to count from the beginning, or too far to count at all.
    count_.fill(0);
    position_ = 0;
    known_ = position <= quick;
    if (!known_) return;
  }
  for (std::int64_t p = position_ + 1; p <= position; ++p) ++count_[trace.event(p).step];
  for (std::int64_t p = position + 1; p <= position_; ++p) --count_[trace.event(p).step];
  position_ = position;
}

}  // namespace zstep::viewer
