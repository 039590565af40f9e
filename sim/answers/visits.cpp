#include "sim/answers/visits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/answers/polygons_of_spans.hpp"
#include "traces/codec/scene_geometry.hpp"
#include "traces/file/visit.hpp"
#include "traces/math/whole.hpp"
#include "traces/replay/key_frames.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {

namespace {

constexpr double side = 16;   // pixels
constexpr double margin = 1;  // by which a facet may reach farther than its corners say

struct Squares {
  std::int32_t left = 0, right = -1, top = 0, bottom = -1;  // both ends included; none when right < left
};

std::vector<bool> begun_polygons(const Trace& trace) {
  // Rays come to no polygon; and what is dropped without its work beginning is in the list of rejects.
  if (trace.polygons().empty() || trace.has(kind_of<RayBegin>) || trace.has(kind_of<PolygonReject>)) return {};
  std::vector<bool> begun(trace.scene().polygons.size(), false);
  for (const PolygonMark& mark : trace.polygons()) begun[mark.polygon] = true;
  const bool all = std::find(begun.begin(), begun.end(), false) == begun.end();
  return all ? std::vector<bool>{} : begun;
}

}  // namespace

FacetsNear::FacetsNear(const Trace& trace) : begun_(begun_polygons(trace)) {
  const Scene& scene = trace.scene();
  const codec::SceneGeometry facts(scene, trace.header());
  squares_across_ = ceil_int(scene.raster.width / side);
  const auto squares_down = ceil_int(scene.raster.height / side);
  const double nearest = scene.camera.near;

  const auto square = [](double at, std::int32_t count) { return floor_int(std::clamp(at / side, -1.0, count + 1.0)); };
  std::vector<Squares> of_facet(scene.facets.size());
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
    bool before_eye = true;
    for (const std::int32_t corner : facts.corners(index32(i))) {
      const codec::VertexGeometry& vertex = facts.of_point(corner);
      before_eye = before_eye && (!facts.viewed() || vertex.view.z >= nearest) && std::isfinite(vertex.raster.x) &&
                   std::isfinite(vertex.raster.y);
      left = std::min(left, vertex.raster.x), right = std::max(right, vertex.raster.x);
      top = std::min(top, vertex.raster.y), bottom = std::max(bottom, vertex.raster.y);
    }
    if (!before_eye) {
      anywhere_.push_back(index32(i));
      continue;
    }
    Squares& squares = of_facet[i];
    squares.left = std::max(0, square(left - margin, squares_across_)),
    squares.right = std::min(squares_across_ - 1, square(right + margin, squares_across_));
    squares.top = std::max(0, square(top - margin, squares_down)),
    squares.bottom = std::min(squares_down - 1, square(bottom + margin, squares_down));
  }

  first_.assign(static_cast<std::size_t>(squares_across_) * squares_down + 1, 0);
  const auto for_each_square = [&](const Squares& squares, const auto& each) {
    for (std::int32_t row = squares.top; row <= squares.bottom; ++row)
      for (std::int32_t column = squares.left; column <= squares.right; ++column)
        each(static_cast<std::size_t>(row * squares_across_ + column));
  };
  for (const Squares& squares : of_facet) for_each_square(squares, [&](std::size_t at) { ++first_[at + 1]; });
  for (std::size_t at = 1; at < first_.size(); ++at) first_[at] += first_[at - 1];
  facets_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (std::size_t i = 0; i < of_facet.size(); ++i)
    for_each_square(of_facet[i], [&](std::size_t at) { facets_[next[at]++] = index32(i); });
}

std::vector<std::int32_t> FacetsNear::near(Trace::Pixel pixel) const {
  const auto column = static_cast<std::int32_t>(pixel.x / static_cast<std::int32_t>(side)),
             row = static_cast<std::int32_t>(pixel.y / static_cast<std::int32_t>(side));
  std::vector<std::int32_t> found;
  const std::size_t at = row * squares_across_ + column;
  if (pixel.x < 0 || pixel.y < 0 || column >= squares_across_ || at + 1 >= first_.size()) return found;
  std::merge(facets_.begin() + first_[at], facets_.begin() + (first_[at + 1]), anywhere_.begin(), anywhere_.end(),
             std::back_inserter(found));
  return found;
}

namespace {

/// Where edges of all polygons stand in one table: the polygon of the edge at the left of the span.
std::optional<AtWork> by_span(const Trace& trace, std::int64_t step) {
  const auto span = last_event<SpanBegin>(trace, step);
  if (!span) return std::nullopt;
  const auto row = numbered(trace, last_mark(trace), span->step, &EdgeTableInsert::edge, span->event.left_edge);
  return AtWork{row ? event_at<EdgeTableInsert>(trace, *row)->polygon : no_polygon, span->step};
}

/// Are edges of all polygons in one table?
bool has_one_table(const Trace& trace) {
  return sweeps(trace.header()) || (records<TablesBegin>(trace) && !records<PieceDraw>(trace));
}

AtWork at_work(const Trace& trace, std::int64_t step) {
  if (has_one_table(trace))
    if (const auto found = by_span(trace, step)) return *found;
  const auto marks = trace.polygons();
  const auto beyond = std::upper_bound(marks.begin(), marks.end(), step,
                                       [](std::int64_t at, const PolygonMark& mark) { return at < mark.position; });
  const std::int64_t mark = beyond == marks.begin() ? 0 : std::prev(beyond)->position;
  if (records<PieceDraw>(trace))
    if (const auto draw = last_event<PieceDraw>(trace, step, mark)) return {draw->event.polygon, draw->step};
  return mark == 0 ? AtWork{} : AtWork{std::prev(beyond)->polygon, mark};
}

/// A step at the pixel, or one that concerns all pixels alike.
struct Here {
  std::int64_t step = 0;
  Event event;
  std::optional<AtWork> by_span{};  ///< whose it is, where spans of several polygons come before their pixels
};

template <class E>
inline constexpr bool is_at_pixel =
    at_pixel<E> != AtPixel::nothing || std::is_same_v<E, ColorBlend> || std::is_same_v<E, ColorWrite>;

/// Puts the events of one pixel together.
class Reading {
 public:
  Reading(const Trace& trace, bool by_spans)
      : trace_(trace),
        by_spans_(by_spans),
        depth_(trace.header().empty_depth()),
        known_(trace.header().initial_depth.has_value()),
        shades_(trace.has(kind_of<AttributeInterpolate>)),
        owners_(records_owners(trace)),
        compares_write_(Beginning(trace).machine().compares_write) {}

  void clear(double z) {
    depth_ = z, polygon_ = no_polygon;
    only_cleared_ = known_ = true;
    open_ = false;
  }
  void close() { open_ = false; }

  void take(const Here& here) {
    const auto& [step, event, by_span] = here;
    if (const auto* z = get_if<DepthInterpolate>(&event)) {
      open_ = false;  // a new fragment
      interpolated_.push_back({step, work_of(here), z->z});
    } else if (has(at_pixel_of(event), AtPixel::verdict)) {
      visit_event(
          [&]<class E>(const E& e) {
            if constexpr (has(at_pixel<E>, AtPixel::verdict)) take_verdict(here, e.z, e.nearer);
          },
          event);
    } else if (const auto* depth = get_if<DepthWrite>(&event)) {
      const AtWork work = work_of(here);
      Visit& visit = goes_on(work) && all.back().kept_at == 0 ? all.back() : add(step, work, Outcome::written);
      if (!visit.z) visit.z = depth->z;
      visit.kept = depth->z, visit.kept_at = step;
      depth_ = depth->z, only_cleared_ = false, known_ = true;
    } else if (const auto* write = get_if<PixelWrite>(&event)) {
      const AtWork work = work_of(here);
      const bool after_blend = goes_on(work) && all.back().outcome == Outcome::mixed &&
                               all.back().polygon == write->polygon && !all.back().takes;
      const bool belongs = goes_on(work) && all.back().written == 0;
      Visit& visit = after_blend || belongs ? all.back() : add(step, work, Outcome::written);
      if (visit.polygon == no_polygon) visit.polygon = write->polygon;
      if (!visit.z && !interpolated_.empty() && interpolated_.back().work == work) visit.z = interpolated_.back().z;
      if (visit.outcome == Outcome::written) visit.step = step;
      if (!after_blend) visit.written = step;  // a blend has coloured it already
      take_pixel(visit, write->polygon);
    } else if (const auto* paint = get_if<PixelPaint>(&event)) {
      Visit& visit = add(step, painting(paint->polygon), Outcome::painted);
      if (known_) visit.stored = depth_;
      visit.z = visit.kept = paint->z, visit.kept_at = visit.written = step;
      take_pixel(visit, paint->polygon);
      depth_ = paint->z, only_cleared_ = false, known_ = true;
      open_ = false;
    } else if (const auto* blend = get_if<ColorBlend>(&event)) {
      const AtWork work = work_of(here);
      const bool belongs = goes_on(work) && all.back().outcome == Outcome::won && !all.back().takes;
      Visit& visit = belongs ? all.back() : add(step, work, Outcome::mixed);
      visit.outcome = Outcome::mixed, visit.polygon = blend->polygon, visit.opacity = blend->opacity;
      visit.blended = visit.written = step;
    } else if (holds<ColorWrite>(event) && shades_) {
      // The stripes of an attribute belong to the write before them.
    } else if (holds<ColorWrite>(event)) {
      add(step, {}, Outcome::colored).written = step;
      open_ = false;
    }
  }

  /// At the end: of what was interpolated there, and no step since says what came of it.
  void add_interpolated() {
    std::sort(works_.begin(), works_.end());
    const auto went_on = [&](const AtWork& work) { return std::binary_search(works_.begin(), works_.end(), work); };
    for (const Interpolated& one : interpolated_) {
      if (went_on(one.work) || went_on(painting(one.work.polygon))) continue;
      Visit visit;
      visit.outcome = Outcome::interpolated, visit.step = one.step, visit.polygon = one.work.polygon, visit.z = one.z;
      const auto later =
          std::find_if(all.begin(), all.end(), [&](const Visit& other) { return other.step > visit.step; });
      all.insert(later, std::move(visit));
    }
  }

  std::vector<Visit> all;

 private:
  struct Interpolated {
    std::int64_t step = 0;
    AtWork work;
    double z = 0;
  };

  void take_verdict(const Here& here, double z, bool nearer) {
    const AtWork work = work_of(here);
    // A colour that was written before its compare belongs to it.
    const bool belongs = goes_on(work) && all.back().outcome == Outcome::written && all.back().kept_at == 0;
    Visit& visit = belongs ? all.back() : add(here.step, work, Outcome::won);
    visit.step = here.step, visit.z = z;
    if (known_) visit.stored = depth_;
    visit.outcome = nearer ? Outcome::won : visit.z == visit.stored ? Outcome::tie : Outcome::lost;
    if (nearer && compares_write_) {
      visit.kept = depth_ = z, visit.kept_at = here.step;
      only_cleared_ = false, known_ = true;
    }
    if (nearer && !owners_ && work.polygon != no_polygon) {
      visit.written = here.step;
      take_pixel(visit, work.polygon);
    }
  }

  /// Of a paint, which is a whole visit.
  static AtWork painting(std::int32_t polygon) { return {polygon, 0}; }

  /// Whose a step is. What is written later than its pixel's turn belongs to what came to the pixel last.
  AtWork work_of(const Here& here) const {
    const bool begins = is_of_fragment(at_pixel_of(here.event));
    const bool has_span = here.by_span && here.by_span->since > 0;
    if (by_spans_ && !has_span && !begins && open_) return work_;
    return here.by_span ? *here.by_span : at_work(trace_, here.step);
  }

  /// Does a step of this work belong to what came to the pixel last?
  bool goes_on(const AtWork& work) const { return open_ && !all.empty() && work == work_; }

  Visit& add(std::int64_t step, const AtWork& work, Outcome outcome) {
    Visit visit;
    visit.outcome = outcome, visit.step = step, visit.polygon = work.polygon;
    visit.stored_polygon = polygon_, visit.only_cleared = only_cleared_;
    all.push_back(std::move(visit)), works_.push_back(work);
    work_ = work, open_ = true;
    return all.back();
  }
  void take_pixel(Visit& visit, std::int32_t polygon) { visit.takes = true, visit.shows = polygon_ = polygon; }

  const Trace& trace_;
  bool by_spans_;
  double depth_;
  std::int32_t polygon_ = no_polygon;
  bool known_, shades_, owners_, compares_write_, only_cleared_ = true;
  AtWork work_;                ///< of the last visit
  bool open_ = false;          ///< steps that follow may belong to it
  std::vector<AtWork> works_;  ///< of each visit
  std::vector<Interpolated> interpolated_;
};

}  // namespace

bool records_owners(const Trace& trace) {
  return trace.has(kind_of<PixelWrite>) || trace.has(kind_of<PixelPaint>) || trace.has(kind_of<ColorBlend>);
}
bool records_depths(const Trace& trace) { return trace.has(kind_of<DepthWrite>) || trace.has(kind_of<PixelPaint>); }

std::vector<Visit> visits_of(const Trace& trace, Trace::Pixel pixel) {
  return visits_of(trace, pixel, begin_of_picture(trace));
}

std::vector<Visit> visits_of(const Trace& trace, Trace::Pixel pixel, std::int64_t after) {
  // The events of this pixel and those that concern all pixels alike.
  std::vector<Here> here;
  std::optional<PolygonsOfSpans> spans = PolygonsOfSpans::of(trace);
  const bool by_spans = spans.has_value();
  if (by_spans) {
    trace.visit(0, trace.size(), [&]<class E>(std::int64_t step, std::uint8_t, const E& e) {
      if constexpr (is_at_pixel<E>)
        if (e.x == pixel.x && e.y == pixel.y) here.push_back({step, e, spans->at(e)});
      spans->pass(step, e);
      return true;
    });
  } else {
    trace.scan(pixel, [&](std::int64_t step, const RecordedEvent& recorded) {
      visit_event(
          [&]<class E>(const E& e) {
            if constexpr (is_at_pixel<E>) here.push_back({step, e});
          },
          recorded.event);
      return true;
    });
  }
  for (const std::int64_t step : trace.clears()) here.push_back({step, trace.event(step).event});
  std::stable_sort(here.begin(), here.end(), [](const Here& a, const Here& b) { return a.step < b.step; });

  Reading reading(trace, by_spans);
  const std::int64_t eye = begin_of_eye_pass(trace);
  for (const Here& one : here) {
    if (one.step < eye) continue;  // another picture
    if (const auto* clear = get_if<BuffersClear>(&one.event)) reading.clear(clear->z);
    else reading.take(one);
  }
  reading.add_interpolated();
  std::erase_if(reading.all, [after](const Visit& visit) { return visit.step <= after; });
  return std::move(reading.all);
}

bool may_have_visits(const Trace& trace, Trace::Pixel pixel, std::int32_t polygon) {
  return has_one_table(trace) || trace.may_be_of(polygon, pixel);
}

const Visit* holder(const std::vector<Visit>& visits, std::int64_t before) {
  const Visit* last = nullptr;
  for (const Visit& visit : visits)
    if (visit.step < before && visit.takes) last = &visit;
  return last;
}

bool is_nearer(const Trace& trace, double z, double stored) { return trace.header().comparison.wins(z, stored); }

bool follows(const Trace& trace, const Visit& compared) {
  return !compared.stored || !compared.z || is_nearer(trace, *compared.z, *compared.stored) == compared.nearer();
}

bool lacks_depth(const Visit& visit) { return visit.compared() && visit.takes && !visit.kept; }

bool keeps_other_depth(const Visit& visit) { return visit.kept && visit.z && *visit.kept != *visit.z; }

}  // namespace zstep::answers
