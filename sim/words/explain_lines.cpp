// Edges as lines of the picture, cut into visible and hidden pieces (002, 004; Roberts 1963).
#include "sim/words/explain_parts.hpp"
#include "traces/formulas/of_lines.hpp"

namespace zstep::words {
namespace {

std::string facet_label(const Telling& t, std::int32_t facet) {
  const auto at = static_cast<std::size_t>(facet);
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
  const auto at = static_cast<std::size_t>(facet);
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
  t.gives("t", formulas::where_lines_cross(x_0, y_0, x_1, y_1, x_a, y_a, x_b, y_b), e.t,
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
      t.gives("t", formulas::where_zero(Shown("d_0", *d_0), Shown("d_1", *d_1)), e.t);
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
