#include "tests/unit/sim/answers/why_not_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/truth/truth.hpp"
#include "sim/words/explain.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::test {

using answers::Verdict, answers::Why, answers::why_not;

namespace {

template <class E>
const E* at(const Trace& trace, std::int64_t step) {
  return step < 1 || step > trace.size() ? nullptr : get_if<E>(&trace.event(step).event);
}

template <class E>
bool in_page(const Trace& trace) {
  const Page& page = trace.header().page;
  return std::any_of(page.begin(), page.end(), [](const StepInfo& step) { return step.kind == kind_of<E>; });
}

/// What a run through the whole trace knows of one pixel: who drew a line through it, and who wrote what there.
struct Brute {
  const Trace& trace;
  Picture picture;
  compare::Truth all, front;                  ///< whatever way they face; without those that face away
  std::vector<std::set<std::int32_t>> drawn;  ///< by pixel, the polygons whose line or curve wrote there

  explicit Brute(const Trace& of) : trace(of), all(of.scene(), false), front(of.scene(), true) {
    Replay replay(trace);
    replay.go_to(trace.size());
    picture = replay.state().picture;
    drawn.resize(picture.polygon.size());
    std::set<std::int32_t> now;
    const Scene& scene = trace.scene();
    for (std::int64_t step = 1; step <= trace.size(); ++step) {
      if (const auto* line = at<LineBegin>(trace, step)) {
        now.clear();
        for (const std::int32_t facet : {line->left_facet, line->right_facet})
          if (facet >= 0) now.insert(scene.facets[static_cast<std::size_t>(facet)].polygon);
      } else if (const auto* segment = at<CurveSegment>(trace, step)) {
        now.clear();
        for (const Facet& facet : scene.facets) {
          const auto* corners = &scene.corners[static_cast<std::size_t>(facet.first_corner)];
          const auto has = [&](std::int32_t vertex) {
            return std::find(corners, corners + facet.corner_count, vertex) != corners + facet.corner_count;
          };
          if (has(segment->vertex_0) && has(segment->vertex_1)) now.insert(facet.polygon);
        }
      } else if (const auto* color = at<ColorWrite>(trace, step)) {
        drawn[picture.at(color->x, color->y)].insert(now.begin(), now.end());
      }
    }
  }
};

/// What the trace's own numbers are at a pixel before a step.
struct Stored {
  double z = no_depth;
  std::int32_t polygon = no_polygon;
};
Stored stored_before(const Trace& trace, std::int64_t step, Trace::Pixel pixel) {
  Stored stored;
  for (std::int64_t k = 1; k < step; ++k) {
    if (at<BuffersClear>(trace, k)) stored = {};
    if (const auto* depth = at<DepthWrite>(trace, k); depth && depth->x == pixel.x && depth->y == pixel.y)
      stored.z = depth->z;
    if (const auto* write = at<PixelWrite>(trace, k); write && write->x == pixel.x && write->y == pixel.y)
      stored.polygon = write->polygon;
  }
  return stored;
}

std::int32_t polygon_of(const Scene& scene, std::int32_t facet) {
  return scene.facets[static_cast<std::size_t>(facet)].polygon;
}

/// The depth at which the polygon won its last compare before the verdict's step.
double mine_before(const Trace& trace, const Verdict& verdict, std::int32_t polygon, Trace::Pixel pixel) {
  double z = no_depth;
  std::optional<double> compared;
  for (std::int64_t k = 1; k < verdict.step; ++k) {
    if (const auto* compare = at<DepthCompare>(trace, k); compare && compare->x == pixel.x && compare->y == pixel.y)
      compared = compare->z;
    const auto* write = at<PixelWrite>(trace, k);
    if (compared && write && write->x == pixel.x && write->y == pixel.y && write->polygon == polygon) z = *compared;
  }
  return z;
}

/// Is a facet of the polygon in this box, or in one inside it?
bool holds(const Trace& trace, std::int32_t box, std::int32_t polygon) {
  std::set<std::int32_t> inside{box};
  for (std::int64_t step = 1; step <= trace.size(); ++step) {
    if (const auto* made = at<BoxMake>(trace, step); made && inside.contains(made->parent)) inside.insert(made->box);
    if (const auto* hold = at<BoxHold>(trace, step);
        hold && inside.contains(hold->box) && polygon_of(trace.scene(), hold->facet) == polygon)
      return true;
    if (at<RayBegin>(trace, step)) return false;
  }
  return false;
}

/// What the ray at work at a step meets first; infinite where it meets nothing.
double nearest_on_ray(const Trace& trace, std::int64_t step) {
  double t = no_depth;
  for (; step <= trace.size() && !at<RayEnd>(trace, step) && !at<RayBegin>(trace, step); ++step) {
    if (const auto* hit = at<RayHit>(trace, step); hit && hit->nearest) t = hit->t;
  }
  for (std::int64_t before = step - 1; before > 0 && !at<RayBegin>(trace, before); --before)
    if (const auto* hit = at<RayHit>(trace, before); hit && hit->nearest) t = std::min(t, hit->t);
  return t;
}

/// By how many rows a curve moves from this column to the next or the one before, at most.
double steepness(const Trace& trace, std::int64_t step) {
  const HorizonTest here = *at<HorizonTest>(trace, step);
  double most = 0;
  for (const int way : {-1, 1})
    for (std::int64_t k = step + way; k > 0 && k <= trace.size() && !at<CurveBegin>(trace, k); k += way)
      if (const auto* next = at<HorizonTest>(trace, k)) {
        if (std::abs(next->x - here.x) == 1) most = std::max(most, std::abs(next->y_curve - here.y_curve));
        break;
      }
  return most;
}

/// The step of a verdict must be there and say what the verdict says.
void check_step(const Trace& trace, const Verdict& verdict, std::int32_t polygon, Trace::Pixel pixel) {
  const auto here = [pixel](const auto* event) { return event && event->x == pixel.x && event->y == pixel.y; };
  switch (verdict.kind) {
    case Why::lost:
    case Why::tie:
      REQUIRE(verdict.gap);
      if (verdict.kind == Why::lost) CHECK(*verdict.gap > 0);
      else CHECK(std::abs(*verdict.gap) < 1e-9);
      if (const auto* compare = at<DepthCompare>(trace, verdict.step)) {
        CHECK(here(compare));
        CHECK_FALSE(compare->nearer);
        const double z = compare->z;
        const Stored stored = stored_before(trace, verdict.step, pixel);
        CHECK(stored.polygon == verdict.other);
        CHECK(*verdict.gap == trace.header().comparison.behind(z, stored.z));
      } else if (const auto* hit = at<RayHit>(trace, verdict.step)) {
        CHECK(hit->inside);
        const bool mine = polygon_of(trace.scene(), hit->facet) == polygon;
        CHECK((mine ? !hit->nearest : hit->nearest));
      } else if (const auto* winner = at<SpanWinner>(trace, verdict.step)) {
        CHECK(winner->first <= pixel.x);
        CHECK(winner->last >= pixel.x);
      } else if (const auto* tile = at<TileDepthTest>(trace, verdict.step)) {
        CHECK_FALSE(tile->nearer);
        CHECK(*verdict.gap == tile->z_nearest - tile->z_farthest);
      } else {
        CHECK(at<AreaDecide>(trace, verdict.step));
      }
      break;
    case Why::overwritten:
      if (const auto* hit = at<RayHit>(trace, verdict.step)) {
        CHECK(hit->nearest);
        CHECK(polygon_of(trace.scene(), hit->facet) == verdict.other);
      } else {
        REQUIRE(here(at<DepthCompare>(trace, verdict.step)));
        CHECK(at<DepthCompare>(trace, verdict.step)->nearer);
        std::int64_t written = verdict.step;  // what is written there next
        while (!here(at<PixelWrite>(trace, written)) && !here(at<ColorBlend>(trace, written)))
          REQUIRE(++written <= trace.size());
        const auto* write = at<PixelWrite>(trace, written);
        CHECK((write ? write->polygon : at<ColorBlend>(trace, written)->polygon) == verdict.other);
        CHECK(*verdict.gap == trace.header().comparison.behind(mine_before(trace, verdict, polygon, pixel),
                                                               at<DepthCompare>(trace, verdict.step)->z));
      }
      CHECK(*verdict.gap > 0);
      break;
    case Why::painted_over: {
      REQUIRE(here(at<PixelPaint>(trace, verdict.step)));
      CHECK(at<PixelPaint>(trace, verdict.step)->polygon == verdict.other);
      const auto mine = std::find_if(verdict.chain.begin(), verdict.chain.end(), [&](const answers::Link& link) {
        const auto* paint = at<PixelPaint>(trace, link.step);
        return here(paint) && paint->polygon == polygon;
      });
      REQUIRE(mine != verdict.chain.end());
      CHECK(mine->step < verdict.step);
      break;
    }
    case Why::taken:
      CHECK(here(at<PixelPaint>(trace, verdict.step)));
      break;
    case Why::surrounded:
      REQUIRE(at<AreaDecide>(trace, verdict.step));
      CHECK(at<AreaDecide>(trace, verdict.step)->what == AreaCase::front_surrounder);
      break;
    case Why::unreached:
    case Why::box_missed: {
      const bool missed = verdict.kind == Why::box_missed;
      if (const auto* box = at<BoxTest>(trace, verdict.step)) {
        CHECK(holds(trace, box->box, polygon));
        CHECK((box->t_enter > box->t_leave) == missed);
        if (!missed) CHECK(box->t_enter > nearest_on_ray(trace, verdict.step));
      } else {
        REQUIRE(at<CellVisit>(trace, verdict.step));
        CHECK(std::isinf(nearest_on_ray(trace, verdict.step)) == missed);
      }
      break;
    }
    case Why::apart:
      CHECK(at<AreaBin>(trace, verdict.step)->bin == Bin::disjoint);
      break;
    case Why::horizon:
      REQUIRE(at<HorizonTest>(trace, verdict.step));
      CHECK(at<HorizonTest>(trace, verdict.step)->verdict == Horizon::hidden);
      CHECK(at<HorizonTest>(trace, verdict.step)->x == pixel.x);
      CHECK(std::abs(at<HorizonTest>(trace, verdict.step)->y_curve - pixel.y) <=
            0.5 + steepness(trace, verdict.step) / 2);
      break;
    case Why::line_hidden:
      REQUIRE(at<LineHide>(trace, verdict.step));
      CHECK(polygon_of(trace.scene(), at<LineHide>(trace, verdict.step)->facet) == verdict.other);
      break;
    case Why::back_edge:
      REQUIRE(at<LinePiece>(trace, verdict.step));
      CHECK_FALSE(at<LinePiece>(trace, verdict.step)->visible);
      break;
    case Why::mixed:
      CHECK((at<ColorBlend>(trace, verdict.step) || at<CoverageAdd>(trace, verdict.step)));
      break;
    case Why::culled:
      CHECK((verdict.step == 0 || at<PolygonReject>(trace, verdict.step) || at<RayPlane>(trace, verdict.step)));
      break;
    default:
      break;
  }
}

/// Whatever short cut was taken, the words are those of a replay that stands at the step.
void check_formulas(const Trace& trace, const Verdict& verdict) {
  const bool of_pixel = at<DepthCompare>(trace, verdict.step) || at<PixelPaint>(trace, verdict.step);
  const bool of_ray =
      at<RayHit>(trace, verdict.step) || at<RayPlane>(trace, verdict.step) || at<BoxTest>(trace, verdict.step);
  if (!of_pixel && !of_ray && !at<ClipVertex>(trace, verdict.step)) return;
  if (verdict.kind == Why::painted_over || verdict.kind == Why::taken ||
      (verdict.kind == Why::seen && !at<RayHit>(trace, verdict.step)))
    return;
  if (verdict.kind == Why::overwritten && of_ray) return;  // told of its own hit
  Replay replay(trace);
  replay.go_to(verdict.step);
  for (const std::string& formula : explain(trace, replay.state(), *replay.current()).formulas)
    CHECK_MESSAGE(std::find(verdict.formulas.begin(), verdict.formulas.end(), formula) != verdict.formulas.end(),
                  formula);
}

void check_verdict(const Brute& brute, const Verdict& verdict, std::int32_t polygon, Trace::Pixel pixel) {
  const Trace& trace = brute.trace;
  CHECK_FALSE(verdict.sentence.empty());
  std::int64_t before = 0;
  for (const answers::Link& link : verdict.chain) {
    CHECK(link.step >= before);
    CHECK(link.step <= trace.size());
    before = link.step;
    CHECK_FALSE(link.text.empty());
  }
  const std::size_t place = brute.picture.at(pixel.x, pixel.y);
  check_formulas(trace, verdict);
  check_step(trace, verdict, polygon, pixel);
  if (in_page<LineBegin>(trace) || in_page<HorizonTest>(trace)) {
    CHECK((verdict.kind == Why::seen) == brute.drawn[place].contains(polygon));
    return;
  }
  CHECK((verdict.kind == Why::seen) == (brute.picture.polygon[place] == polygon));
  bool covers = false, towards = false, sure = true;
  for (const compare::Candidate& candidate : brute.all.at(pixel.x, pixel.y)) {
    if (candidate.polygon != polygon) continue;
    sure = sure && candidate.edge > compare::edge_tolerance && !candidate.edge_on;
    covers = covers || candidate.covers;
  }
  for (const compare::Candidate& candidate : brute.front.at(pixel.x, pixel.y))
    towards = towards || (candidate.polygon == polygon && candidate.covers);
  if (!sure) return;
  CHECK(verdict.kind != Why::not_recorded);
  const bool partly =
      verdict.kind == Why::mixed && in_page<CoverageAdd>(trace);  // antialiasing looks beyond the centre
  if (!partly) CHECK((answers::does_not_cover(verdict.kind) || verdict.kind == Why::clipped) == !covers);
  const bool culls = trace.header().conventions.cull && trace.scene().camera.kind != Camera::Kind::screen;
  CHECK((verdict.kind == Why::culled) == (culls && covers && !towards));
}

}  // namespace

std::set<Why> check_why_not(const Trace& trace, std::int32_t columns, std::int32_t rows) {
  const Brute brute(trace);
  std::set<Why> kinds;
  const Raster& raster = trace.scene().raster;
  for (std::int32_t y = 0; y < raster.height; y += std::max(1, raster.height / rows))
    for (std::int32_t x = 0; x < raster.width; x += std::max(1, raster.width / columns))
      for (std::int32_t polygon = 0; polygon < static_cast<std::int32_t>(trace.scene().polygons.size()); ++polygon) {
        CAPTURE(x);
        CAPTURE(y);
        CAPTURE(polygon);
        const Verdict verdict = why_not(trace, polygon, {x, y});
        CAPTURE(verdict.sentence);
        CAPTURE(static_cast<int>(verdict.kind));
        check_verdict(brute, verdict, polygon, {x, y});
        kinds.insert(verdict.kind);
      }
  for (std::int32_t polygon = 0; polygon < static_cast<std::int32_t>(trace.scene().polygons.size()); ++polygon) {
    CAPTURE(polygon);
    const Verdict verdict = why_not(trace, polygon);
    CAPTURE(verdict.sentence);
    CHECK_FALSE(verdict.sentence.empty());
    for (const answers::Link& link : verdict.chain) CHECK(link.step >= 1);
    kinds.insert(verdict.kind);
    if (in_page<LineBegin>(trace) || in_page<HorizonTest>(trace)) continue;
    const auto& picture = brute.picture.polygon;
    CHECK((verdict.kind == Why::seen) == (std::find(picture.begin(), picture.end(), polygon) != picture.end()));
  }
  return kinds;
}

}  // namespace zstep::test
