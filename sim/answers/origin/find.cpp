
#include "sim/answers/origin/find.hpp"

#include <algorithm>
#include <iterator>
#include <type_traits>

namespace zstep::answers {

std::int32_t polygon_of_facet(const Scene& scene, std::int32_t facet) {
  const Facet* found = entry(scene.facets, facet);
  return found ? found->polygon : no_polygon;
}

std::int64_t begin_of_eye_pass(const Trace& trace) {
  if (!records<PassBegin>(trace)) return 0;
  // The light's pass has a mark for every facet, and the eye's begins when the last of them is done.
  const auto marks = trace.polygons();
  const std::size_t facets = trace.scene().facets.size();
  const std::int64_t from = facets > 0 && marks.size() >= facets ? marks[facets - 1].position : 0;
  const auto step = trace.next<PassBegin>(from, [](const PassBegin& pass) { return pass.pass == Pass::eye; });
  return step.value_or(trace.size() + 1);
}

std::int64_t begin_of_picture(const Trace& trace) {
  const std::int64_t eye = begin_of_eye_pass(trace);
  return trace.clears().empty() ? eye : std::max(eye, trace.clears().back());
}

std::vector<std::int64_t> marks_of(const Trace& trace, std::int32_t polygon) {
  const std::int64_t begin = begin_of_picture(trace);
  std::vector<std::int64_t> steps;
  for (const PolygonMark& mark : trace.polygons())
    if (mark.polygon == polygon && mark.position > begin) steps.push_back(mark.position);
  return steps;
}

namespace {

auto mark_beyond(const Trace& trace, std::int64_t step) {
  const auto marks = trace.polygons();
  return std::upper_bound(marks.begin(), marks.end(), step,
                          [](std::int64_t at, const PolygonMark& mark) { return at < mark.position; });
}

}  // namespace

std::int64_t next_mark(const Trace& trace, std::int64_t step) {
  const auto beyond = mark_beyond(trace, step);
  return beyond == trace.polygons().end() ? trace.size() + 1 : beyond->position;
}

std::int64_t last_mark(const Trace& trace) { return trace.polygons().empty() ? 0 : trace.polygons().back().position; }

namespace {

constexpr std::int64_t near = 4096;  // events: what is looked through before anything cleverer

bool begins_work(const Event& event) { return holds<PolygonBegin>(event) || holds<PieceDraw>(event); }

/// All vertices are viewed in one go, in their order: where in the trace.
struct Interval {
  std::int64_t low = 0, high = 0;
};

Interval viewing_interval(const Trace& trace, const MethodState& machine) {
  const auto marks = trace.polygons();
  const auto facets = trace.scene().facets.size();
  const Interval between{facets > 0 && marks.size() >= facets ? marks[facets - 1].position : 0,
                         marks.size() > facets ? marks[facets].position : trace.size()};
  if (trace.scene().light && machine.pass == Pass::eye && marks.size() > facets && facets > 0)
    return between;  // the second pass of a shadow buffer
  // A tree is built of all facets before its vertices are viewed, and then its pieces are drawn.
  if (trace.size() > 0 && holds<TablesBegin>(trace.event(1).event) && !marks.empty()) return between;
  return {0, marks.empty() ? trace.size() : marks.front().position};
}

Step viewed_in(const Trace& trace, const Interval& interval, std::int32_t vertex) {
  return numbered(trace, interval.low, interval.high + 1, &ViewTransform::vertex, vertex);
}

/// The vertex is projected right after it was viewed, or soon after clipping made it.
void find_projection(const Trace& trace, std::int64_t from, std::int64_t at, std::int32_t vertex, VertexSteps& steps) {
  trace.each(from - 1, at, [&](std::int64_t step, const RecordedEvent& recorded) {
    if (const auto* projection = get_if<Projection>(&recorded.event)) {
      if (projection->vertex == vertex) steps.projected = step;
    } else if (const auto* viewport = get_if<ViewportTransform>(&recorded.event)) {
      if (viewport->vertex == vertex) steps.on_raster = step;
    } else if (const auto* view = get_if<ViewTransform>(&recorded.event)) {
      if (view->vertex != vertex) return false;
    }
    return !steps.on_raster && !is_one_of<PolygonBegin, PieceDraw>(recorded);
  });
}

bool same_edge(const EdgeTableInsert& a, const EdgeTableInsert& b) {
  return a.edge == b.edge && a.polygon == b.polygon && a.vertex_0 == b.vertex_0 && a.vertex_1 == b.vertex_1 &&
         a.x_edge == b.x_edge && a.z_edge == b.z_edge;
}

}  // namespace

std::int64_t begin_of_work(const Trace& trace, const MethodState& machine, std::int64_t at) {
  const auto beyond = mark_beyond(trace, at);
  const auto last = beyond == trace.polygons().begin() ? 1 : std::prev(beyond)->position;
  if (machine.piece >= 0) {
    // Work on a piece begins at a mark, too.
    if (const auto* draw = get_if<PieceDraw>(&trace.event(last).event); draw && draw->piece == machine.piece)
      return last;
    const auto drawn = find_last<PieceDraw>(trace, at, [&](const PieceDraw& e) { return e.piece == machine.piece; });
    if (drawn) return *drawn;
  }
  return last;
}

VertexSteps steps_of_vertex(const Trace& trace, const MethodState& machine, std::int64_t at, std::int32_t vertex) {
  VertexSteps steps;
  const bool of_scene = static_cast<std::size_t>(vertex) < trace.scene().points.size();
  const auto viewing = [&](const ViewTransform& e) { return e.vertex == vertex; };
  if (!of_scene) {
    const auto made = [&](const RecordedEvent& recorded) {
      if (const auto* clipped = get_if<ClipCross>(&recorded.event)) return clipped->vertex == vertex;
      if (const auto* cut = get_if<SplitVertex>(&recorded.event)) return cut->vertex == vertex;
      return false;
    };
    // Of a polygon at work, clipping made it after the work began.
    const bool of_polygon = machine.polygon != no_polygon && machine.piece == -1 && !machine.keeps_all;
    if (of_polygon) steps.made = trace.next(begin_of_work(trace, machine, at), made);
    if (machine.keeps_all)
      steps.made = numbered(trace, 0, at + 1, &SplitVertex::vertex, vertex);  // their numbers go up
    if (machine.keeps_all && !steps.made) steps.made = numbered(trace, 0, at + 1, &ClipCross::vertex, vertex);
    if (!steps.made || *steps.made > at) steps.made = trace.previous(at + 1, made);
    if (!steps.made) return steps;
    if (holds<ClipCross>(trace.event(*steps.made).event)) {
      find_projection(trace, *steps.made + 1, at, vertex, steps);
      return steps;
    }
    const SplitVertex cut = get<SplitVertex>(trace.event(*steps.made).event);
    if (cut.space == Space::world) {
      steps.viewed = viewed_in(trace, viewing_interval(trace, machine), vertex);
      if (!steps.viewed) steps.viewed = find_first<ViewTransform>(trace, *steps.made, viewing);
    }
  } else if (trace.scene().camera.kind != Camera::Kind::screen) {
    steps.viewed = viewed_in(trace, viewing_interval(trace, machine), vertex);
    if (!steps.viewed) steps.viewed = find_last<ViewTransform>(trace, at, viewing);
  }
  if (steps.viewed && *steps.viewed > at) steps.viewed.reset();
  if (steps.viewed) find_projection(trace, *steps.viewed + 1, at, vertex, steps);
  return steps;
}

Step step_of_edge(const Trace& trace, const MethodState& machine, std::int64_t at, std::int32_t edge) {
  const EdgeTableInsert* const row = entry(machine.edge_table, edge);
  if (!row) return std::nullopt;
  const auto wanted = [known = *row](const EdgeTableInsert& e) { return same_edge(e, known); };
  const std::int64_t soon = std::max<std::int64_t>(1, at - near);
  if (const auto found = find_last<EdgeTableInsert>(
          trace, at, wanted, [](const Event&) { return false; }, soon))
    return found;
  // A polygon's edges follow its beginning, those of all at once the last of the polygons, and their numbers go up.
  if (machine.keeps_all && machine.piece == -1)
    if (const auto found = numbered(trace, last_mark(trace), at + 1, &EdgeTableInsert::edge, edge)) return found;
  return find_first<EdgeTableInsert>(trace, begin_of_work(trace, machine, at), wanted);
}

Step step_of_active_edge(const Trace& trace, const MethodState& machine, std::int64_t at, std::int32_t edge) {
  const auto moved = find_last<EdgeStep>(
      trace, at, [&](const EdgeStep& e) { return e.edge == edge; },
      [&](const Event& event) {
        if (const auto* enters = get_if<EdgeEnter>(&event)) return enters->edge == edge;
        return begins_work(event);
      });
  return moved ? moved : step_of_edge(trace, machine, at, edge);
}

Step step_of_plane(const MethodState& machine, std::int32_t piece) {
  const Piece* found = entry(machine.pieces, piece);
  return found && found->plane_step > 0 ? Step(found->plane_step) : std::nullopt;
}

Step step_of_depth(const Trace& trace, std::int64_t at, Trace::Pixel pixel, bool light) {
  const auto writes = [&](const RecordedEvent& recorded) {
    if (const auto* depth = get_if<DepthWrite>(&recorded.event)) return depth->x == pixel.x && depth->y == pixel.y;
    if (const auto* paint = get_if<PixelPaint>(&recorded.event)) return paint->x == pixel.x && paint->y == pixel.y;
    return false;
  };
  const std::int64_t eye = begin_of_eye_pass(trace);
  const auto found = trace.previous(light ? std::min(at + 1, eye) : at + 1, writes, pixel);
  if (found && !light && *found < eye) return std::nullopt;
  const auto cleared = std::upper_bound(trace.clears().begin(), trace.clears().end(), at);
  if (found && cleared != trace.clears().begin() && *std::prev(cleared) > *found) return std::nullopt;
  return found;
}

Step step_of_shade(const Trace& trace, std::int64_t at, Trace::Pixel pixel) {
  if (!trace.has(kind_of<AttributeInterpolate>)) return std::nullopt;
  return trace.previous<ColorWrite>(
      at + 1, [](const ColorWrite&) { return true; }, pixel);
}

}  // namespace zstep::answers
