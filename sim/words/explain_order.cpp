// Pairs of pieces and the list in which they are drawn: depth sort (002).
#include <algorithm>
#include <limits>

#include "sim/words/explain_parts.hpp"

namespace zstep::words {
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
  const std::string axis(words_of<Axis>[static_cast<std::size_t>(e.axis)]), one = t.piece(e.piece),
                                                                            other = t.piece(e.other);
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
  t.formula(fmt::format("{}: {} and {}", one, range(e.low, e.high), range(e.other_low, e.other_high)));
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
                        !sorted || step == "split" ? ": it is cut there." : "."));
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
  t.formula(fmt::format("f at the corners of {}: {}", piece, range(e.least, e.greatest)));
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
