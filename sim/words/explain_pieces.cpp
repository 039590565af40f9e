// All polygons at once: pieces, their planes and extents, how they are cut, the tree and the list in which they are
// drawn (001, 002, 003).

#include <algorithm>
#include <limits>

#include "sim/words/explain_parts.hpp"

namespace zstep::words {
namespace {

/// The plane's value at a vertex that was found a few events ago.
std::optional<double> value_found(const Telling& t, std::int32_t vertex) {
  const std::int64_t first = std::max<std::int64_t>(1, t.after.position - 256);
  for (std::int64_t p = t.after.position - 1; p >= first; --p) {
    const Event& event = t.trace.event(p).event;
    if (const auto* found = get_if<VertexSide>(&event); found && found->vertex == vertex) return found->value;
    if (holds<PieceMake>(event)) break;
  }
  return std::nullopt;
}

}  // namespace

void tell(Telling& t, const TablesBegin& e) {
  t.say(fmt::format(
      "This method needs all {} polygons at once: from here on, vertices and pieces of all of them are kept.",
      e.polygons));
}

void tell(Telling& t, const PieceMake& e) {
  const std::size_t at = e.piece;
  const std::size_t corners = at < t.machine.pieces.size() ? t.machine.pieces[at].outline.size() : 0;
  if (e.parent < 0)
    t.say(fmt::format("What is left of polygon {} to be drawn becomes piece {}: {} corners.", t.label(e.polygon),
                      e.piece, corners));
  else
    t.say(fmt::format("One part of {} becomes a piece of its own, {}: {} corners.", t.piece(e.parent), t.piece(e.piece),
                      corners));
}

void tell(Telling& t, const PlaneEquation& e) {
  t.say(fmt::format("The plane of {}: what lies on one side of it has {} > 0, on the other < 0.", t.piece(e.piece),
                    plane_in_symbols(cutting_names(t))));
  for (const char* symbol : {"A", "B", "C", "D"}) t.owns(symbol, t.about);
  t.formula(fmt::format("A = {}, B = {}, C = {}, D = {}", factor(e.plane_a), factor(e.plane_b), factor(e.plane_c),
                        number(e.plane_d)));
  t.value("A", e.plane_a);
  t.value("B", e.plane_b);
  t.value("C", e.plane_c);
  t.value("D", e.plane_d);
}

void tell(Telling& t, const Extent& e) {
  t.say(fmt::format("The extents of {}: the box between its least and greatest coordinates.", t.piece(e.piece)));
  t.formula(fmt::format("x: {} \u2026 {}", number(e.x_min), number(e.x_max)));
  t.formula(fmt::format("y: {} \u2026 {}", number(e.y_min), number(e.y_max)));
  t.formula(fmt::format("{}: {} \u2026 {}", t.z, number(e.z_min), number(e.z_max)));
  for (const auto& [name, value] : {std::pair{"x_min", e.x_min},
                                    {"x_max", e.x_max},
                                    {"y_min", e.y_min},
                                    {"y_max", e.y_max},
                                    {"z_min", e.z_min},
                                    {"z_max", e.z_max}})
    t.value(name, value);
}

void tell(Telling& t, const SplitVertex& e) {
  t.say(fmt::format("The edge from vertex {} to vertex {} crosses the plane: a new vertex {} is made there.",
                    e.vertex_0, e.vertex_1, e.vertex));
  const auto d0 = value_found(t, e.vertex_0), d1 = value_found(t, e.vertex_1);
  if (d0 && d1) {
    t.gives("t", "t", formulas::where_zero(Shown("d_0", *d0), Shown("d_1", *d1)), e.t);
  } else {
    t.formula(fmt::format("t = {} = {}   d: {} at either end",
                          in_symbols([](auto&& name) { return formulas::where_zero(name("d_0"), name("d_1")); }),
                          number(e.t), plane_in_symbols(cutting_names(t))),
              "t");
  }
  t.formula(
      fmt::format("{} = ({}, {}, {})", point_on_way("V_0", "V_1"), number(e.x_cut), number(e.y_cut), number(e.z_cut)));
  t.value("t", e.t);
  t.value("x", e.x_cut);
  t.value("y", e.y_cut);
  t.value("z", e.z_cut);
  t.derive(e);
  t.hold_derived("x", "x_cut", e.x_cut);
  t.hold_derived("y", "y_cut", e.y_cut);
  t.hold_derived("z", "z_cut", e.z_cut);
}

void tell(Telling& t, const PieceDraw& e) {
  t.say(fmt::format("{} is drawn, over whatever is there.", t.piece(e.piece)));
  t.formula(fmt::format("number {} to be drawn", t.machine.drawn.size()));
}

void tell(Telling& t, const PixelPaint& e) {
  const Fragment* f = t.machine.fragment ? &*t.machine.fragment : nullptr;
  const std::string before =
      f ? fmt::format(" It showed {}; nobody asks which is nearer.", t.label(f->stored_polygon)) : "";
  t.say(fmt::format("Pixel ({}, {}) takes the colour of {}.{}", e.x, e.y, t.label(e.polygon), before));
  t.value(t.z, e.z);
  t.derive(e);
  if (t.derived_of("z") == nullptr) return t.formula(fmt::format("{} = {}", t.z, number(e.z)), "z");
  t.depth_on_span(e.z);
}

// Vertices against planes, as a BSP tree asks (001, 003), and what coherence saved.

namespace {

const char* where(Side side) {
  switch (side) {
    case Side::front:
      return "in front of";
    case Side::behind:
      return "behind";
    case Side::on:
      return "in";
    default:
      return "on both sides of";
  }
}

}  // namespace

void tell(Telling& t, const VertexSide& e) {
  t.say(fmt::format("Vertex {} lies {} the plane of {}.", e.vertex, where(e.side), t.piece(e.plane_of)));
  t.value("value", e.value);
  t.derive(e);
  t.follows("the value", "value", e.value);
}

void tell(Telling& t, const Saved& e) {
  std::string thanks_to(word_of(e.coherence));
  std::replace(thanks_to.begin(), thanks_to.end(), '_', ' ');
  if (e.coherence == Coherence::extent) thanks_to = "extents";
  else if (e.coherence == Coherence::order) thanks_to = "the order of drawing";
  else thanks_to += " coherence";
  t.say(fmt::format("{} {} not needed, thanks to {}; {} so far.", e.tests, e.tests == 1 ? "test was" : "tests were",
                    thanks_to, grouped(t.machine.saved[e.coherence])));
}

// The BSP tree (001, 002, 003): roots, nodes, the eye's side of each plane, subtrees passed over.

namespace {

/// What a node is called: its first piece.
std::string node_name(const Telling& t, std::int32_t node) {
  if (node < 0 || node >= std::ssize(t.machine.tree)) return fmt::format("node {}", node);
  const TreeNode& at = t.machine.tree[node];
  return at.pieces.empty() ? fmt::format("node {}", node) : t.piece(at.pieces[0]);
}

bool front_to_back(const Telling& t) {
  const auto order = t.conventions.options.find("order");
  return order != t.conventions.options.end() && order->second == "front-to-back";
}

}  // namespace

void tell(Telling& t, const RootCandidate& e) {
  t.say(fmt::format("{} is tried as the root: its plane would cut {} of the other pieces{}.", t.piece(e.piece),
                    e.splits == 0 ? std::string("none") : std::to_string(e.splits),
                    e.splits == 0 ? ", and no root can do better" : ""));
  t.formula(fmt::format("splits = {}", e.splits), "splits");
}

void tell(Telling& t, const NodeMake& e) {
  if (e.parent < 0)
    t.say(fmt::format("{} becomes the root of the tree: its plane divides all other pieces.", t.piece(e.piece)));
  else
    t.say(fmt::format("{} becomes the {} child of {}: its plane divides what lies {} the plane of {}.",
                      t.piece(e.piece), e.front ? "front" : "back", node_name(t, e.parent),
                      e.front ? "in front of" : "behind", node_name(t, e.parent)));
}

void tell(Telling& t, const NodeAdd& e) {
  t.say(fmt::format("{} lies in the plane of {} and stays at its node: neither can hide the other.", t.piece(e.piece),
                    node_name(t, e.node)));
}

void tell(Telling& t, const EyeSide& e) {
  const char* far = e.front ? "behind" : "in front of";
  const char* near = e.front ? "in front of" : "behind";
  t.say(fmt::format("The eye is {} the plane of {}, so what lies {} it is drawn first.", near, node_name(t, e.node),
                    front_to_back(t) ? near : far));
  if (e.front != (e.value > 0))
    t.contradict(fmt::format("The trace takes the eye for {} the plane of {}, but its value there, {}, says {}.", near,
                             node_name(t, e.node), number(e.value), far));
  t.value("at the eye", e.value);
  const bool direction = t.scene.camera.kind != Camera::Kind::perspective;
  t.derive(e);
  if (!t.follows("the value", "value", e.value)) return;
  if (!direction) return;
  const PointNames at = cutting_names(t);
  t.formula(fmt::format("w = 0: the eye is infinitely far away, in the direction ({}, {}, {})", at.x, at.y, at.z));
}

void tell(Telling& t, const NodeSkip& e) {
  t.say(fmt::format("All that the eye sees lies {} the plane of {}, so what lies {} it is not drawn.",
                    e.front ? "behind" : "in front of", node_name(t, e.node), e.front ? "in front of" : "behind"));
  if (e.front ? e.value >= 0 : e.value <= 0)
    t.contradict(fmt::format(
        "The trace skips what lies {} the plane of {}, but the view volume reaches there: its {} value is {}.",
        e.front ? "in front of" : "behind", node_name(t, e.node), e.front ? "greatest" : "least", number(e.value)));
  t.formula(fmt::format("{} of {} over the view volume's corners = {}{}", e.front ? "greatest" : "least",
                        plane_in_symbols(cutting_names(t)), number(e.value),
                        e.value > 0   ? " > 0"
                        : e.value < 0 ? " < 0"
                                      : ""));
  t.value("nearest corner", e.value);
}

// Pairs of pieces and the list in which they are drawn: depth sort (002).

namespace {

const Extent* extent_of(const Telling& t, std::int32_t number) {
  const Piece* piece = t.at.piece(number);
  return piece && piece->extent ? &*piece->extent : nullptr;
}

std::string range(double low, double high) { return fmt::format("{} \u2026 {}", number(low), number(high)); }

/// The plane turned so that C > 0, as depth sort turns it: the eye, at z = −∞, is where its values are negative.
PlaneEquation turned(PlaneEquation plane) {
  if (plane.plane_c > 0) return plane;
  return {plane.piece, -plane.plane_a, -plane.plane_b, -plane.plane_c, -plane.plane_d};
}

std::string equation(const PlaneEquation& p, const std::string& z) {
  const auto of = [](double value) { return Shown(factor(value), value); };
  return "f(x, y, " + z + ") = " +
         formulas::plane_value(of(p.plane_a), of(p.plane_b), of(p.plane_c), Shown(p.plane_d), Shown("x", 0),
                               Shown("y", 0), Shown(z, 0))
             .symbols();
}

/// Computes the extremes again from the corners that the state knows.
void hold_extremes(Telling& t, const SideTest& e, const PlaneEquation& p) {
  const double far = std::numeric_limits<double>::infinity();
  formulas::Rounded least(far, 0), greatest(-far, 0);
  const Piece* piece = t.at.piece(e.piece);
  if (!piece) return;
  for (const std::int32_t vertex : piece->outline) {
    const auto corner = t.at.on_raster(vertex);
    if (!corner) return;
    const auto value = formulas::plane_value<formulas::Rounded>(p, {corner->x, corner->y, corner->z});
    if (value.value < least.value) least = value;
    if (value.value > greatest.value) greatest = value;
  }
  t.hold_against("the least value", e.least, least);
  t.hold_against("the greatest value", e.greatest, greatest);
}

std::string place_word(std::int32_t place) { return place == 0 ? "the first place" : fmt::format("place {}", place); }

}  // namespace

void tell(Telling& t, const PairBegin& e) {
  t.say(fmt::format("May P = {} be drawn before Q = {}? If any of the tests says yes, it may.", t.piece(e.piece),
                    t.piece(e.other)));
  const Extent *p = extent_of(t, e.piece), *q = extent_of(t, e.other);
  if (!p || !q) return;
  t.formula(fmt::format("{} of {}: {}", t.z, t.piece(e.piece), range(p->z_min, p->z_max)));
  t.formula(fmt::format("{} of {}: {}", t.z, t.piece(e.other), range(q->z_min, q->z_max)));
}

void tell(Telling& t, const ExtentTest& e) {
  const std::string axis(word_of(e.axis)), one = t.piece(e.piece), other = t.piece(e.other);
  if (e.overlap)
    t.say(fmt::format("The {} extents of {} and {} overlap: this test cannot say that {} may be drawn first.", axis,
                      one, other, one));
  else if (e.axis == Axis::z)
    t.say(fmt::format("The whole of {} is nearer than all of {}: {} cannot hide it.", other, one, one));
  else t.say(fmt::format("The {} extents of {} and {} do not overlap: neither can hide the other.", axis, one, other));
  const bool meet = e.low < e.other_high && e.other_low < e.high;
  if (e.overlap ? !meet && e.axis != Axis::z : meet)
    t.contradict(fmt::format("The trace says that the {} extents of {} and {} {}, but {} and {} {}.", axis, one, other,
                             e.overlap ? "overlap" : "do not overlap", range(e.low, e.high),
                             range(e.other_low, e.other_high), meet ? "do" : "do not"));
  t.formula(fmt::format("{}: {}, {}: {}", one, range(e.low, e.high), other, range(e.other_low, e.other_high)));
  if (!e.overlap && e.high <= e.other_low) t.formula(fmt::format("{} \u2264 {}", number(e.high), number(e.other_low)));
  else if (!e.overlap && !meet) t.formula(fmt::format("{} \u2264 {}", number(e.other_high), number(e.low)));
  t.value("low", e.low);
  t.value("high", e.high);
  t.value("other low", e.other_low);
  t.value("other high", e.other_high);
}

void tell(Telling& t, const SideTest& e) {
  const std::string piece = t.piece(e.piece), plane = t.piece(e.plane_of), step = t.step();
  const bool sorted = t.machine.pair.has_value();
  const std::string_view before = sorted ? "on the eye's side of" : "in front of";
  switch (e.side) {
    case Side::front:
      t.say(fmt::format("All of {} lies {} the plane of {}.", piece, before, plane));
      break;
    case Side::behind:
      t.say(fmt::format("All of {} lies behind the plane of {}.", piece, plane));
      break;
    case Side::on:
      t.say(fmt::format(
          "{} lies in the plane of {}{}", piece, plane,
          sorted && keeps_first(t.trace.header()) ? ": the later one in the file is to be drawn first." : "."));
      break;
    case Side::crossing:
      t.say(fmt::format("{} lies on both sides of the plane of {}{}", piece, plane,
                        step == "split" || (!sorted && step != "penetrate") ? ": it is cut there." : "."));
      break;
  }
  const bool wants_behind = step == "test_3" || step == "test_3_swapped",
             wants_before = step == "test_4" || step == "test_4_swapped";
  if (sorted && e.side != Side::on && (wants_behind || wants_before)) {
    const bool passed = e.side == (wants_behind ? Side::behind : Side::front);
    const bool exchanged = step == "test_3_swapped" || step == "test_4_swapped";
    const std::string earlier = exchanged ? t.piece(t.machine.pair->other) : t.piece(t.machine.pair->piece);
    t.out.sentence += passed ? fmt::format(" So {} may be drawn first.", earlier) : " This test cannot decide.";
  }
  // A vertex on the plane leaves digits of rounding, on either side of it.
  const Piece* of = t.at.piece(e.plane_of);
  const double size = of && of->plane ? std::abs(of->plane->plane_d) : 0;
  const double rounding =
      std::max(1e-6 * std::max(std::abs(e.least), std::abs(e.greatest)), 1e-9 * std::max(1.0, size));
  const bool both_sides = e.least < -rounding && e.greatest > rounding,
             one_side = e.least > rounding || e.greatest < -rounding;
  if (e.side == Side::crossing ? one_side : both_sides)
    t.contradict(fmt::format(
        "The trace says that {} lies {} the plane of {}, but its values there run from {} to {}: it lies on {}.", piece,
        e.side == Side::crossing ? "on both sides of"
        : e.side == Side::front  ? before
        : e.side == Side::behind ? "behind"
                                 : "in",
        plane, number(e.least), number(e.greatest), both_sides ? "both sides" : "one side"));
  t.formula(fmt::format("f at the vertices of {}: {}", piece, range(e.least, e.greatest)));
  t.value("least", e.least);
  t.value("greatest", e.greatest);
  if (!sorted || !of || !of->plane) return;
  t.formula(equation(turned(*of->plane), t.z) + "   the eye: f < 0");
  hold_extremes(t, e, turned(*of->plane));
}

void tell(Telling& t, const OverlapTest& e) {
  const std::string one = t.piece(e.piece), other = t.piece(e.other);
  if (!e.overlap)
    return t.say(fmt::format(
        "On the picture {} and {} do not overlap, though their boxes do: neither can hide the other.", one, other));
  t.say(fmt::format("On the picture {} and {} overlap, for one at ({}, {}).", one, other, number(e.x_at),
                    number(e.y_at)));
  t.value("x", e.x_at);
  t.value("y", e.y_at);
  const Piece *p = t.at.piece(e.piece), *q = t.at.piece(e.other);
  if (!p || !q || !p->plane || !q->plane) return;
  const double z_p = formulas::plane_depth(*p->plane, e.x_at, e.y_at),
               z_q = formulas::plane_depth(*q->plane, e.x_at, e.y_at);
  const auto [shown_p, shown_q] = tell_apart(z_p, z_q);
  t.formula(fmt::format("there {} of {} = {}, of {} = {}", t.z, one, shown_p, other, shown_q));
}

void tell(Telling& t, const ListInsert& e) {
  const std::string piece = t.piece(e.piece);
  const Extent* extent = extent_of(t, e.piece);
  if (t.step() == "move") return t.say(fmt::format("{} becomes the first of the list: it is the new P.", piece));
  t.say(fmt::format("{} goes to {} of the list, where its farthest {} puts it.", piece, place_word(e.place), t.z));
  if (!extent) return;
  t.formula(fmt::format("farthest {} = {}", t.z, number(extent->z_max)));
  t.value("farthest z", extent->z_max);
}

void tell(Telling& t, const ListRemove& e) {
  const Piece* piece = t.at.piece(e.piece);
  const std::string name = t.piece(e.piece);
  if (piece && piece->cut) return t.say(fmt::format("{} leaves the list: its parts take over.", name));
  if (t.step() == "remove")
    return t.say(fmt::format("{} was moved for the sake of what has been split: it goes back to its place.", name));
  if (std::find(t.machine.drawn.begin(), t.machine.drawn.end(), e.piece) != t.machine.drawn.end())
    return t.say(fmt::format("{} is drawn and leaves the list; {} to go.", name, t.machine.list.size()));
  t.say(fmt::format("{} leaves its place in the list.", name));
}

void tell(Telling& t, const ListMark& e) {
  t.say(fmt::format(
      "{} is marked. If it would have to move again, the pieces stand in a ring, and one of them must be split.",
      t.piece(e.piece)));
}

}  // namespace zstep::words
