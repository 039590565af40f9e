// Curves of a surface against the horizons, edges as lines against faces, and intervals of a scan line.

#include <algorithm>
#include <cmath>

#include "sim/answers/origin/work.hpp"
#include "sim/words/explain.hpp"
#include "traces/formulas/of_colors.hpp"
#include "traces/formulas/of_curves.hpp"
#include "traces/formulas/of_edges.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {
namespace {

/// y of the curve's straight piece at a column.
void tell_on_segment(Datum& datum, Work& work, std::int32_t column) {
  const auto& segment = work.machine().horizon.segment;
  if (!segment) return;
  const CurveSegment s = *segment;
  const auto a = zstep::on_raster(work.scene, work.state(), s.vertex_0),
             b = zstep::on_raster(work.scene, work.state(), s.vertex_1);
  if (!a || !b) return datum.note("on a piece of the curve that is cut at the near plane");
  const auto at = [&](std::int32_t vertex, Axis3 axis) { return work.on_raster(vertex, axis); };
  const bool between = column >= std::min(a->x, b->x) && column <= std::max(a->x, b->x);
  if (!between || a->x == b->x)
    return datum.same_as("y_s", at(datum.number() == a->y ? s.vertex_0 : s.vertex_1, Axis3::y));
  Operands of;
  const Formula y_0 = of("y_0", at(s.vertex_0, Axis3::y)), y_1 = of("y_1", at(s.vertex_1, Axis3::y)),
                x = of("x", column), x_0 = of("x_0", at(s.vertex_0, Axis3::x)),
                x_1 = of("x_1", at(s.vertex_1, Axis3::x));
  datum.is(formulas::on_line(y_0, y_1, x, x_0, x_1), of);
}

Number horizon_at(Work& work, std::int64_t step, std::int32_t x, bool upper) {
  const Step moved =
      find_last<HorizonMove>(work.trace, step, [&](const HorizonMove& e) { return e.x == x && e.upper == upper; });
  const double value = moved ? get<HorizonMove>(work.trace.event(*moved).event).y_curve : upper ? no_depth : -no_depth;
  return work.kept(
      step, fmt::format("horizon {} {}", x, upper),
      fmt::format("{} horizon of column {}", upper ? "upper" : "lower", x), "y", value, "y_curve",
      [&] { return moved; }, "nothing was drawn there yet");
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t, const CurveBegin& e, std::string_view field) {
  if (field != "constant" || !work.scene.surface) return;
  const std::int32_t sample = e.across ? e.row : e.row * work.scene.surface->columns;
  datum.same_as(e.across ? "x" : "y", work.world(sample, e.across ? Axis3::x : Axis3::y));
}

static void tell(Datum& datum, Work& work, std::int64_t step, const HorizonTest& e, std::string_view field) {
  if (field == "y_curve") return tell_on_segment(datum, work, e.x);
  if (field != "verdict") return;
  const Number y = work.field(step, "y_curve"), upper = horizon_at(work, step, e.x, true),
               lower = horizon_at(work, step, e.x, false);
  datum.comes_of("above where y is at most upper[x], below where it is at least lower[x]", {y, upper, lower});
}

static void tell(Datum& datum, Work& work, std::int64_t step, const HorizonMove& e, std::string_view field) {
  if (field != "y_curve") return;
  const std::string name = work.step_name(step);
  if (name == "clear_horizons") return datum.note("nothing is drawn yet");
  if (name == "fill") return tell_on_segment(datum, work, e.x);
  const Step test = work.last(step, &HorizonTest::x, e.x);
  if (test) datum.same_as("y", work.field(*test, "y_curve"));
}

static void tell(Datum& datum, Work& work, std::int64_t step, const HorizonCross& e, std::string_view field) {
  if (field == "upper") return;
  const Step to = work.last<HorizonTest>(step), from = to ? work.last<HorizonTest>(*to - 1) : std::nullopt;
  if (!from) return;
  const HorizonTest a = get<HorizonTest>(work.trace.event(*from).event),
                    b = get<HorizonTest>(work.trace.event(*to).event);
  // Where the curve was on the column before, its own piece may have been another.
  const Number y_0 = work.kept(*from, "column before", fmt::format("the curve at x = {}", a.x), "y", a.y_curve,
                               "y_curve", [&] { return from; });
  const Number y_1 = work.field(*to, "y_curve"), h_0 = horizon_at(work, *from, a.x, e.upper),
               h_1 = horizon_at(work, *to, b.x, e.upper);
  Operands of;
  const Formula from_y = of("y_0", y_0), from_h = of("h_0", h_0), to_y = of("y_1", y_1), to_h = of("h_1", h_1),
                from_x = of("x_0", a.x), to_x = of("x_1", b.x),
                part = formulas::where_zero<Formula>(from_y - from_h, to_y - to_h);
  datum.is(field == "x_at" ? formulas::part_of_way(from_x, to_x, part) : formulas::part_of_way(from_y, to_y, part), of);
}

namespace {

/// The piece that a facet became: one of its polygon, and, of several, the one whose plane the line crosses there.
std::int32_t piece_of_facet(const Work& work, std::int32_t facet, const LineBegin& line, double t) {
  if (!entry(work.scene.facets, facet)) return -1;
  std::int32_t best = -1;
  double least = std::numeric_limits<double>::infinity();
  const auto a = zstep::on_raster(work.scene, work.state(), line.vertex_0),
             b = zstep::on_raster(work.scene, work.state(), line.vertex_1);
  for (std::size_t i = 0; a && b && i < work.machine().pieces.size(); ++i) {
    const Piece& piece = work.machine().pieces[i];
    if (piece.polygon != polygon_of_facet(work.scene, facet) || !piece.plane) continue;
    const double off = std::abs(formulas::plane_value(
        *piece.plane, formulas::part_of_way(glm::dvec3(a->x, a->y, a->z), glm::dvec3(b->x, b->y, b->z), t)));
    if (off < least) least = off, best = index32(i);
  }
  return best;
}

/// Where, on the picture, the line crosses an edge of the face: the edge that gives this t.
void tell_edge_crossing(Datum& datum, Work& work, const LineCross& e, const LineBegin& line) {
  const auto edge =
      formulas::detail::crossings_of(formulas::situation_of(work.trace, work.state()), line, e.facet).edge_at(e.t);
  if (!edge) return;
  const auto [a, b] = *edge;
  Operands of;
  const auto x = [&](const char* name, std::int32_t vertex) { return of(name, work.on_raster(vertex, Axis3::x)); };
  const auto y = [&](const char* name, std::int32_t vertex) { return of(name, work.on_raster(vertex, Axis3::y)); };
  const Formula a_x = x("a_x", a), x_0 = x("x_0", line.vertex_0), b_y = y("b_y", b), a_y = y("a_y", a),
                y_0 = y("y_0", line.vertex_0), b_x = x("b_x", b), x_1 = x("x_1", line.vertex_1),
                y_1 = y("y_1", line.vertex_1);
  datum.is(formulas::where_lines_cross(x_0, y_0, x_1, y_1, a_x, a_y, b_x, b_y), of, false);
  datum.note(
      fmt::format("where it crosses the edge from vertex {} to vertex {}", work.vertex_name(a), work.vertex_name(b)));
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const LineCross& e, std::string_view field) {
  const LineRow* row = entry(work.machine().lines, e.line);
  if (!row || field == "in_space") return;
  const LineBegin line = row->entry;
  if (field == "t" && !e.in_space) return tell_edge_crossing(datum, work, e, line);
  const std::int32_t piece = field == "t" ? piece_of_facet(work, e.facet, line, e.t) : -1;
  if (piece < 0) return;
  const auto value = [&](const char* name, std::int32_t vertex) {
    return plane_value(work, step, name, piece, [&](Axis3 axis) { return work.on_raster(vertex, axis); });
  };
  const Number d_0 = value("d_0", line.vertex_0), d_1 = value("d_1", line.vertex_1);
  tell_cut(datum, d_0, d_1);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const LineHide& e, std::string_view field) {
  const double t = datum.number();
  const Step cross = find_last<LineCross>(
      work.trace, step,
      [&](const LineCross& other) { return other.line == e.line && other.facet == e.facet && other.t == t; },
      [](const Event& event) { return holds<LineAgainst>(event); });
  if (cross) return datum.same_as("t", work.field(*cross, "t"));
  datum.note(field == "t_0" ? "where the edge begins" : field == "t_1" ? "where the edge ends" : "");
}

static void tell(Datum& datum, Work& work, std::int64_t step, const LinePiece& e, std::string_view field) {
  if (field == "visible") return;
  const double t = datum.number();
  if (t == 0 || t == 1) return datum.note(t == 0 ? "where the edge begins" : "where the edge ends");
  const Step hide = find_last<LineHide>(
      work.trace, step,
      [&](const LineHide& other) { return other.line == e.line && (other.t_0 == t || other.t_1 == t); },
      [](const Event& event) { return holds<LineBegin>(event); });
  if (!hide) return;
  const bool begins = get<LineHide>(work.trace.event(*hide).event).t_0 == t;
  datum.same_as(begins ? "t_0h" : "t_1h", work.field(*hide, begins ? "t_0" : "t_1"));
  datum.note(begins ? "a hidden interval begins there" : "a hidden interval ends there");
}

// The scan-line method: intervals of a line, the depths of planes on them, implied edges, shares of a pixel.

static void tell(Datum& datum, Work& work, std::int64_t step, const SpanFlags&, std::string_view field) {
  const MethodState& m = work.machine();
  if (field == "flags") return datum.note("those that are in");
  const bool left = field == "x_left" || field == "first";
  if (field == "first")
    return datum.comes_of("the first whole number from x_L on, within the raster", {work.field(step, "x_left")});
  if (field == "last")
    return datum.comes_of("the last whole number before x_R, within the raster", {work.field(step, "x_right")});
  if (!field.starts_with("x")) return;
  // Between the edge that was crossed last and the next of the active ones.
  const Step flipped = work.last<FlagFlip>(step);
  if (!flipped) return;
  const std::int32_t crossed = get<FlagFlip>(work.trace.event(*flipped).event).edge;
  for (std::size_t i = 0; i < m.active.size(); ++i) {
    if (m.active[i].edge != crossed) continue;
    const std::size_t wanted = left ? i : i + 1;
    if (wanted >= m.active.size()) return;
    const ActiveEdge edge = m.active[wanted];
    const Number x = work.field(step_of_active_edge(work.trace, m, step, edge.edge), "x_edge", edge.x);
    if (x.value == datum.number()) return datum.same_as("x", x);
    if (left) return datum.is("max(x, -0.5)", {{"x", x}});
    return datum.is("min(x, W - 0.5)", {{"x", x}, {"W", work.scene.raster.width}});
  }
}

static void tell(Datum& datum, Work& work, std::int64_t, const PlaneDepth& e, std::string_view field) {
  // An end of the interval of the line that is at work, or a corner or the centre of an area.
  const auto& interval = work.machine().sweep.interval;
  if (!interval || field != "x_at") return;
  const Step flags = work.last<SpanFlags>(work.at());
  if (e.x_at == interval->x_left) datum.same_as("x_left", work.field(flags, "x_left", interval->x_left));
  else if (e.x_at == interval->x_right) datum.same_as("x_right", work.field(flags, "x_right", interval->x_right));
}

static void tell(Datum& datum, Work& work, std::int64_t, const ImpliedEdge& e, std::string_view) {
  Operands of;
  const auto one = [&](char letter) { return of(fmt::format("{}_1", letter), work.plane(e.piece, letter)); };
  const auto other = [&](char letter) { return of(fmt::format("{}_2", letter), work.plane(e.other, letter)); };
  const Formula a_1 = one('A'), b_1 = one('B'), c_1 = one('C'), d_1 = one('D'), a_2 = other('A'), b_2 = other('B'),
                c_2 = other('C'), d_2 = other('D'), y = of("y", work.machine().scan_line.value_or(0));
  datum.is(formulas::where_planes_meet(a_1, b_1, c_1, d_1, a_2, b_2, c_2, d_2, y), of, false);
}

bool tell_coverage(Datum& datum, Work& work, std::int64_t step, std::int32_t x, std::int32_t y, int which) {
  const auto& covered = work.machine().sweep.covered;
  if (covered.empty() || covered.back().x != x || covered.back().y != y) return false;
  Operands of;
  Formula sum(0);
  int number = 0;
  for (const CoverageAdd& share : std::vector<CoverageAdd>(covered)) {
    const std::string n = std::to_string(++number);
    const Step added = find_last<CoverageAdd>(work.trace, step, [&](const CoverageAdd& other) {
      return other.x == x && other.y == y && other.owner == share.owner;
    });
    const Formula part = of("share_" + n, work.field(added, "coverage", share.coverage));
    sum = formulas::with_share(sum, part, of("colour_" + n, work.color_of(share.owner, which)));
  }
  datum.is(round(sum), of);
  return true;
}

TellTheme* const tell_curves = tell_one_of<CurveBegin, HorizonTest, HorizonMove, HorizonCross>;
TellTheme* const tell_lines = tell_one_of<LineCross, LineHide, LinePiece>;
TellTheme* const tell_sweep = tell_one_of<SpanFlags, PlaneDepth, ImpliedEdge>;

}  // namespace zstep::answers
