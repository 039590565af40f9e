// Curves of the floating horizon: tests, crossings, horizons (004, "Some of the methods of hidden surface
// elimination"); and edges as lines, cut into visible and hidden pieces (002, 004; Roberts 1963).

#include <algorithm>
#include <tuple>

#include "sim/words/explain_parts.hpp"
#include "traces/formulas/of_curves.hpp"

namespace zstep::words {
namespace {

bool one_horizon(const Telling& t) {
  const auto found = t.conventions.options.find("horizons");
  return found != t.conventions.options.end() && found->second == "one";
}

std::string place(std::int32_t vertex, const std::optional<OnRaster>& at) {
  return at ? fmt::format("sample {} at ({}, {})", vertex, number(at->x, 2, true), number(at->y, 2, true))
            : fmt::format("sample {}, which is out of view", vertex);
}

/// A curve on a column, and the horizons that it found there.
struct Passage {
  std::int32_t x;
  double y, upper, lower;
  Horizon where;
};

/// A horizon of a column as it stood before `position`.
double horizon_before(const Telling& t, std::int64_t position, std::int32_t x, bool upper) {
  const auto moved = t.trace.previous(position, [&](const RecordedEvent& event) {
    const auto* move = get_if<HorizonMove>(&event.event);
    return move && move->x == x && move->upper == upper;
  });
  if (moved) return get<HorizonMove>(t.trace.event(*moved).event).y_curve;
  return upper ? no_depth : -no_depth;
}

/// The `back`-th test before this step, 0 for the last one.
std::optional<Passage> passage(const Telling& t, int back) {
  std::int64_t position = t.after.position + 1;
  for (int i = 0; i <= back; ++i) {
    const auto found = t.trace.previous(position, [](const RecordedEvent& event) {
      return holds<HorizonTest>(event.event) || holds<CurveBegin>(event.event);
    });
    if (!found || !holds<HorizonTest>(t.trace.event(*found).event)) return std::nullopt;
    position = *found;
  }
  const auto test = get<HorizonTest>(t.trace.event(position).event);
  return Passage{test.x, test.y_curve, horizon_before(t, position, test.x, true),
                 horizon_before(t, position, test.x, false), test.verdict};
}

/// Rows as they can be told apart.
std::string row_of(const std::string& number) { return "row " + number; }

void tell_y(Telling& t, const HorizonTest& e, const Passage& now) {
  t.derive(e);
  if (t.follows("y", "y_curve", e.y_curve) || !t.machine.horizon.segment) return;
  const auto a = t.at.on_raster(t.machine.horizon.segment->vertex_0);
  const auto b = t.at.on_raster(t.machine.horizon.segment->vertex_1);
  if (!a || !b || a->x == b->x) return;
  // Seen edge-on between two columns: the curve's samples stand on the nearest one.
  const OnRaster& end = now.y == a->y ? *a : *b;
  t.formula(
      fmt::format("y = {}, of the sample at x = {}: column {} is the nearest", number(end.y), number(end.x), now.x));
  t.hold_against("y", now.y, end.y);
}

/// "y ≤ upper[x]:  10.4 ≤ 12.1  is true"
void tell_test(Telling& t, const char* sign, const char* horizon, double y, double entry, bool holds) {
  const auto [left, right] = tell_apart(y, entry);
  t.formula(fmt::format("y {0} {1}[x]:  {2} {0} {3}  is {4}", sign, horizon, left, right, holds ? "true" : "false"));
}

}  // namespace

void tell(Telling& t, const CurveBegin& e) {
  if (e.across)
    t.say(fmt::format("From curve to curve along x = {}, column {} of the surface's grid.", number(e.constant), e.row));
  else
    t.say(fmt::format("The next curve has z = {}: row {} of the surface's grid. All that is nearer was drawn before.",
                      number(e.constant), e.row));
  t.value(e.across ? "x" : "z", e.constant);
}

void tell(Telling& t, const CurveSegment& e) {
  const auto a = t.at.on_raster(e.vertex_0), b = t.at.on_raster(e.vertex_1);
  const std::string way = fmt::format("from {} to {}", place(e.vertex_0, a), place(e.vertex_1, b));
  if (t.step() == "side")
    t.say(fmt::format(
        "The surface goes on between its curves, here {}. Nothing is drawn, but what lies behind is hidden.", way));
  else t.say(fmt::format("The curve goes straight {}.", way));
}

void tell(Telling& t, const HorizonTest& e) {
  const auto found = passage(t, 0);
  if (!found) return t.say(fmt::format("Column {}: row {}.", e.x, number(e.y_curve)));
  const Passage now = *found;
  const bool one = one_horizon(t), empty = std::isinf(now.upper);
  const bool above = now.y <= now.upper, below = !one && now.y >= now.lower;
  const auto [over, upper] = tell_apart(now.y, now.upper);
  const auto [under, lower] = tell_apart(now.y, now.lower);
  if (empty) t.say(fmt::format("No curve has passed column {} yet: {} is visible.", e.x, row_of(over)));
  else if (above)
    t.say(fmt::format("On column {} the curve, {}, is {} the upper horizon, {}: visible.", e.x, row_of(over),
                      now.y == now.upper ? "on" : "above", row_of(upper)));
  else if (below)
    t.say(fmt::format("On column {} the curve, {}, is {} the lower horizon, {}: visible, from below.", e.x,
                      row_of(under), now.y == now.lower ? "on" : "below", row_of(lower)));
  else if (one)
    t.say(fmt::format("On column {} the curve, {}, is not above the horizon, {}: hidden, by this rule.", e.x,
                      row_of(over), row_of(upper)));
  else  // the more digits of its row tell it from both
    t.say(fmt::format("On column {} the curve, {}, lies between the horizons, rows {} and {}: hidden.", e.x,
                      row_of(over.size() < under.size() ? under : over), upper, lower));
  tell_y(t, e, now);
  tell_test(t, "\u2264", "upper", now.y, now.upper, above);
  if (!one && !above) tell_test(t, "\u2265", "lower", now.y, now.lower, below);
  t.value("y", now.y);
  t.value("upper[x]", now.upper);
  if (!one) t.value("lower[x]", now.lower);
  const Horizon rule = above ? Horizon::above : below ? Horizon::below : Horizon::hidden;
  if (rule != e.verdict)
    t.contradict(fmt::format("On column {} the trace says {}, but by these numbers the curve is {}.", e.x,
                             word_of(e.verdict), word_of(rule)));
}

void tell(Telling& t, const HorizonCross& e) {
  const auto before = passage(t, 1), now = passage(t, 0);
  const char* horizon = e.upper ? "upper" : "lower";
  const std::string at = fmt::format("({}, {})", number(e.x_at), number(e.y_at));
  if (!before || !now) return t.say(fmt::format("The curve crosses the {} horizon at {}.", horizon, at));
  const Passage &from = *before, &to = *now;
  const bool leaves = from.where == (e.upper ? Horizon::above : Horizon::below);
  t.say(fmt::format("Between columns {} and {} the curve {} the {} horizon at {}.", from.x, to.x,
                    leaves ? "goes behind" : "comes out at", horizon, at));
  const double d_0 = from.y - (e.upper ? from.upper : from.lower), d_1 = to.y - (e.upper ? to.upper : to.lower);
  for (const auto& [name, passage, d] : {std::tuple("d_0", &from, d_0), std::tuple("d_1", &to, d_1)}) {
    const auto [y, entry] = tell_apart(passage->y, e.upper ? passage->upper : passage->lower);
    t.formula(fmt::format("{} = y \u2212 {}[{}] = {} \u2212 {} = {}", name, horizon, passage->x, y,
                          operand(e.upper ? passage->upper : passage->lower, entry), number(d)));
  }
  const Shown x_0("x_0", from.x), x_1("x_1", to.x), at_0("d_0", d_0), at_1("d_1", d_1);
  if (d_0 != d_1)
    t.gives("x", "x_at", formulas::part_of_way<Shown>(x_0, x_1, formulas::where_zero(at_0, at_1)), e.x_at);
  t.value("x", e.x_at);
  t.value("y", e.y_at);
}

void tell(Telling& t, const HorizonMove& e) {
  const std::string step = t.step();
  if (step == "clear_horizons") {
    t.say(fmt::format("Nothing is drawn yet on column {}: {} the {} horizon.", e.x,
                      e.upper ? "every row is above" : "every row is below", e.upper ? "upper" : "lower"));
    return t.formula(fmt::format("{}[{}] = {}", e.upper ? "upper" : "lower", e.x, number(e.y_curve)), "y_curve");
  }
  const double was = horizon_before(t, t.after.position, e.x, e.upper);
  const char* horizon = e.upper ? "upper" : "lower";
  const std::string why = step == "fill" ? ", out to the side edge" : "";
  const auto [before, now] = tell_apart(was, e.y_curve);
  if (std::isinf(was)) t.say(fmt::format("The {} horizon of column {} begins at row {}{}.", horizon, e.x, now, why));
  else
    t.say(fmt::format("The {} horizon of column {} {} from row {} to row {}{}.", horizon, e.x,
                      e.upper ? "rises" : "sinks", before, now, why));
  t.formula(fmt::format("{}[{}] = {}", horizon, e.x, now), "y_curve");
  t.value("y", e.y_curve);
}

// Edges as lines of the picture, cut into visible and hidden pieces (002, 004; Roberts 1963).

namespace {

std::string facet_label(const Telling& t, std::int32_t facet) {
  const std::size_t at = facet;
  return facet >= 0 && at < t.scene.facets.size() ? t.label(t.scene.facets[at].polygon)
                                                  : fmt::format("facet {}", facet);
}

std::string edge_label(const Telling& t, std::int32_t line) {
  const LineRow* row = formulas::detail::line_row(t.at, line);
  return row ? fmt::format("edge {} ({}\u2013{})", line, row->entry.vertex_0, row->entry.vertex_1)
             : fmt::format("edge {}", line);
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] == 'e') text[0] = 'E';
  return text;
}

/// The plane of the piece that this facet is, as the replay knows it.
const PlaneEquation* plane_of(const Telling& t, std::int32_t facet) {
  const std::size_t at = facet;
  if (facet < 0 || at >= t.scene.facets.size()) return nullptr;
  const Piece* found = nullptr;
  for (const Piece& piece : t.machine.pieces) {
    if (piece.polygon != t.scene.facets[at].polygon) continue;
    if (found) return nullptr;  // several facets of one polygon: the trace does not say which is which
    found = &piece;
  }
  return found && found->plane ? &*found->plane : nullptr;
}

/// Signed distance of a vertex from the plane, positive behind it.
std::optional<double> distance_behind(const Telling& t, const PlaneEquation& plane, std::int32_t vertex) {
  const auto at = t.at.on_raster(vertex);
  if (!at) return std::nullopt;
  const double value = formulas::plane_value(plane, {at->x, at->y, at->z});
  return plane.plane_c > 0 ? value : -value;
}

/// Of the crossings with the edges of the face, the one that is meant.
void crossing_on_picture(Telling& t, const LineCross& e, const LineBegin& line) {
  const formulas::detail::Crossings found = formulas::detail::crossings_of(t.at, line, e.facet);
  const auto edge = found.edge_at(e.t);
  if (!edge) return;
  const auto at = [&](const char* name, std::int32_t vertex) {
    const OnRaster p = *t.at.on_raster(vertex);
    return std::pair{Shown(std::string("x_") + name, p.x), Shown(std::string("y_") + name, p.y)};
  };
  const auto [x_0, y_0] = at("0", line.vertex_0);
  const auto [x_1, y_1] = at("1", line.vertex_1);
  const auto [x_a, y_a] = at("a", (*edge)[0]);
  const auto [x_b, y_b] = at("b", (*edge)[1]);
  t.gives("t", "t", formulas::where_lines_cross(x_0, y_0, x_1, y_1, x_a, y_a, x_b, y_b), e.t,
          formulas::nearest_of(e.t, found.on_picture));
}

std::string between(double t_0, double t_1) { return fmt::format("t = {} to {}", number(t_0), number(t_1)); }

}  // namespace

void tell(Telling& t, const LineBegin& e) {
  const std::string edge =
      capital(fmt::format("edge {} runs from vertex {} to vertex {}", e.line, e.vertex_0, e.vertex_1));
  const bool two = e.left_facet >= 0 && e.right_facet >= 0;
  const std::string one = facet_label(t, e.left_facet >= 0 ? e.left_facet : e.right_facet);
  const std::string both = two ? facet_label(t, e.left_facet) + " and " + facet_label(t, e.right_facet) : one;
  switch (e.kind) {
    case LineKind::inner:
      t.say(fmt::format("{}. Its faces {} both face the eye.", edge, both));
      break;
    case LineKind::contour:
      t.say(fmt::format("{}, on the contour: of {} one faces the eye and the other faces away.", edge, both));
      break;
    case LineKind::boundary:
      t.say(fmt::format("{}. Only {} is there; nothing lies on its other side.", edge, both));
      break;
    default:
      t.say(two ? fmt::format("{}. Its faces {} both face away.", edge, both)
                : fmt::format("{}. Its face {} faces away.", edge, both));
  }
  const auto a = t.at.on_raster(e.vertex_0), b = t.at.on_raster(e.vertex_1);
  if (!a || !b) return;
  t.formula(fmt::format("t = 0 at ({}, {}), {} = {}", number(a->x), number(a->y), t.z, number(a->z)));
  t.formula(fmt::format("t = 1 at ({}, {}), {} = {}", number(b->x), number(b->y), t.z, number(b->z)));
}

void tell(Telling& t, const LineAgainst& e) {
  const std::string face = facet_label(t, e.facet), edge = edge_label(t, e.line);
  switch (e.outcome) {
    case LineFace::own:
      t.say(fmt::format("{} is an edge of {} itself, and its own face does not hide it.", capital(edge), face));
      return;
    case LineFace::apart:
      t.say(fmt::format("The extents of {} miss {}: it hides none of it.", face, edge));
      return;
    case LineFace::in_front:
      t.say(fmt::format("{} lies in front of the plane of {} from end to end, or on it: {} hides none of it.",
                        capital(edge), face, face));
      break;
    case LineFace::behind:
      t.say(fmt::format("A part of {} lies behind the plane of {}, but beside {} on the picture: it hides none of it.",
                        edge, face, face));
      break;
    default:
      t.say(fmt::format("{} hides a part of {}.", face, edge));
  }
  const LineRow* row = formulas::detail::line_row(t.at, e.line);
  const PlaneEquation* plane = plane_of(t, e.facet);
  if (!row || !plane) return;
  const auto d_0 = distance_behind(t, *plane, row->entry.vertex_0),
             d_1 = distance_behind(t, *plane, row->entry.vertex_1);
  if (!d_0 || !d_1) return;
  t.formula(fmt::format("behind the plane by d_0 = {} at t = 0, d_1 = {} at t = 1", number(*d_0), number(*d_1)));
  t.value("d_0", *d_0);
  t.value("d_1", *d_1);
}

void tell(Telling& t, const LineCross& e) {
  const std::string face = facet_label(t, e.facet), edge = edge_label(t, e.line);
  t.say(e.in_space ? fmt::format("{} goes through the plane of {} at t = {}.", capital(edge), face, number(e.t))
                   : fmt::format("On the picture {} crosses an edge of {} at t = {}.", edge, face, number(e.t)));
  t.value("t", e.t);
  const LineRow* row = formulas::detail::line_row(t.at, e.line);
  if (!row) return;
  const PlaneEquation* plane = plane_of(t, e.facet);
  if (e.in_space && plane) {
    const auto d_0 = distance_behind(t, *plane, row->entry.vertex_0),
               d_1 = distance_behind(t, *plane, row->entry.vertex_1);
    if (d_0 && d_1) {
      t.gives("t", "t", formulas::where_zero(Shown("d_0", *d_0), Shown("d_1", *d_1)), e.t);
    }
  }
  if (!e.in_space) crossing_on_picture(t, e, row->entry);
  t.derive(e);
  t.follows("x", "x_at", e.x_at);
  t.follows("y", "y_at", e.y_at);
}

void tell(Telling& t, const LineHide& e) {
  t.say(fmt::format("From t = {} to t = {} {} is inside {} on the picture and behind its plane: hidden there.",
                    number(e.t_0), number(e.t_1), edge_label(t, e.line), facet_label(t, e.facet)));
  t.formula(between(e.t_0, e.t_1));
  t.value("t_0", e.t_0);
  t.value("t_1", e.t_1);
}

void tell(Telling& t, const LinePiece& e) {
  const std::string edge = edge_label(t, e.line);
  const LineRow* row = formulas::detail::line_row(t.at, e.line);
  const bool whole = e.t_0 == 0 && e.t_1 == 1;
  if (whole && e.visible) t.say(fmt::format("All of {} is drawn.", edge));
  else if (whole && row && row->entry.kind == LineKind::back)
    t.say(fmt::format("All faces at {} face away, so none of it is seen.", edge));
  else if (whole) t.say(fmt::format("All of {} is hidden.", edge));
  else
    t.say(fmt::format("{} is {} from t = {} to t = {}.", capital(edge), e.visible ? "visible" : "hidden", number(e.t_0),
                      number(e.t_1)));
  t.formula(fmt::format("{}: {} of its length", between(e.t_0, e.t_1), number(e.t_1 - e.t_0)));
  t.value("t_0", e.t_0);
  t.value("t_1", e.t_1);
}

}  // namespace zstep::words
