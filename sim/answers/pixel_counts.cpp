#include "sim/answers/pixel_counts.hpp"

#include <algorithm>

#include "sim/answers/origin/find.hpp"
#include "traces/file/visit.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {

namespace {

constexpr std::size_t memory = std::size_t{96} << 20;  // bytes of moments to go back to
constexpr std::int64_t at_a_time = 1 << 16;            // events: as many as a block has, so that each is unpacked once
constexpr std::int64_t near_by = 1 << 15;              // events before where one is, to step back to

}  // namespace

PixelCounts::PixelCounts(const Trace& trace) : trace_(&trace), width_(trace.scene().raster.width) {
  const Raster& raster = trace.scene().raster;
  const std::size_t pixels = pixel_count(raster.width, raster.height);
  for (auto& counts : now_.counts) counts.assign(pixels, 0);
  now_.counts[Count::first].assign(pixels, no_polygon);
  now_.counts[Count::last].assign(pixels, no_polygon);
  now_.covered_by.assign(pixels, no_polygon);
  rays_ = records<RayBegin>(trace.header());
  comes_back_ = rays_ || records<ColorBlend>(trace.header());
  if (comes_back_) now_.last_met.assign(pixels, -1);
  most_moments_ = std::clamp<std::size_t>(memory / (pixels * (comes_back_ ? 16 : 7) * sizeof(std::int32_t) + 1), 1, 16);
  spacing_ = std::max<std::int64_t>(1 << 18, trace.size() / static_cast<std::int64_t>(most_moments_));
  now_.spans = PolygonsOfSpans::of(trace);
  moments_.push_back(now_);
}

void PixelCounts::cover(std::size_t pixel, std::int32_t polygon) {
  if (polygon == no_polygon || now_.covered_by[pixel] == polygon) return;
  now_.covered_by[pixel] = polygon;
  if (comes_back_) {
    for (std::int32_t at = now_.last_met[pixel]; at >= 0; at = now_.met[at].before)
      if (now_.met[at].polygon == polygon) return;
    now_.met.push_back({polygon, now_.last_met[pixel]});
    now_.last_met[pixel] = size32(now_.met) - 1;
  }
  ++now_.counts[Count::covers][pixel];
}

template <class E>
void PixelCounts::take(std::int64_t step, const E& event) {
  count(event);
  if (now_.spans) now_.spans->pass(step, event);
}

template <class E>
void PixelCounts::count(const E& event) {
  if constexpr (std::is_same_v<E, PassBegin>) now_.light = event.pass == Pass::light;
  else if constexpr (std::is_same_v<E, TablesBegin>) now_.keeps_all = true;
  else if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) {
    now_.polygon = event.polygon;
    now_.span_edge = -1;
    if (std::is_same_v<E, PieceDraw> || !now_.keeps_all) now_.edges.clear();
  } else if constexpr (std::is_same_v<E, EdgeTableInsert>) {
    now_.edges.push_back(event.polygon);
  } else if constexpr (std::is_same_v<E, ScanLineBegin>) {
    now_.span_edge = -1;
  } else if constexpr (std::is_same_v<E, SpanBegin>) {
    now_.span_edge = event.left_edge;
  }
  if (now_.light) return;
  if constexpr (std::is_same_v<E, RayHit>) {
    if (event.inside && now_.ray_x >= 0)
      cover(pixel_at(now_.ray_x, now_.ray_y, width_), polygon_of_facet(trace_->scene(), event.facet));
  }
  if constexpr (requires {
                  event.x;
                  event.y;
                }) {
    const std::size_t pixel = pixel_at(event.x, event.y, width_);
    const auto counts = [&](Count count) -> std::int32_t& { return now_.counts[count][pixel]; };
    if (event.x < 0 || event.x >= width_ || pixel >= now_.covered_by.size()) return;
    ++counts(Count::work);
    if constexpr (std::is_same_v<E, RayBegin>) {
      const bool eye = event.role == RayRole::eye;
      now_.ray_x = eye ? event.x : -1, now_.ray_y = eye ? event.y : -1;
    } else if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
      const std::size_t edge = now_.span_edge;
      const auto by_span = now_.spans ? now_.spans->at(event) : std::nullopt;
      cover(pixel, by_span ? by_span->polygon : edge < now_.edges.size() ? now_.edges[edge] : now_.polygon);
      if (!event.nearer) ++counts(Count::failed);
    } else if constexpr (std::is_same_v<E, ColorWrite>) {
      ++counts(Count::writes);
    } else if constexpr (std::is_same_v<E, PixelWrite> || std::is_same_v<E, PixelPaint> ||
                         std::is_same_v<E, ColorBlend>) {
      ++counts(Count::writes);
      if (!rays_) cover(pixel, event.polygon);
      if (event.polygon == no_polygon) return;
      counts(Count::last) = event.polygon;
      if (counts(Count::first) == no_polygon) counts(Count::first) = event.polygon;
    }
  }
}

void PixelCounts::go_back_before(std::int64_t position) {
  while (moments_.back().position > position && moments_.size() > 1) moments_.pop_back();
  const bool recent = recent_ && recent_->position <= position && recent_->position > moments_.back().position;
  now_ = recent ? *recent_ : moments_.back();
}

void PixelCounts::keep_recent() {
  if (recent_) *recent_ = now_;  // into the memory that it has
  else recent_ = now_;
}

bool PixelCounts::count_to(std::int64_t position, std::chrono::microseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  position = std::clamp<std::int64_t>(position, 0, trace_->size());
  if (position < now_.position) go_back_before(position);
  while (now_.position < position) {
    if (position - now_.position <= 256) {
      for (std::int64_t step = now_.position + 1; step <= position; ++step)
        if (trace_->impl().readable(step))
          visit_event([&](const auto& event) { take(step, event); }, trace_->event(step).event);
      now_.position = position;
      break;
    }
    // A moment is kept where the way is long, and one more a little before its end.
    const std::int64_t lead_in = position - near_by;
    std::int64_t to = std::min(position, (now_.position / at_a_time + 1) * at_a_time);
    if (now_.position < lead_in) to = std::min(to, lead_in);
    trace_->visit(now_.position, to, [this](std::int64_t step, std::uint8_t, const auto& event) {
      take(step, event);
      return true;
    });
    now_.position = to;
    if (to == lead_in) keep_recent();
    else if (to - moments_.back().position >= spacing_ && moments_.size() < most_moments_) moments_.push_back(now_);
    if (std::chrono::steady_clock::now() >= end) break;
  }
  // Steps back from where one walks: the moment follows.
  if (now_.position == position && (!recent_ || position - recent_->position > 2 * near_by) &&
      position - moments_.back().position > near_by)
    keep_recent();
  return now_.position == position;
}

}  // namespace zstep::answers
