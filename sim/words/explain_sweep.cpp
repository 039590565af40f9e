// The scan-line method: flags, intervals of the line, implied edges, coverage (002, "Scan Line Algorithm").
#include "sim/words/explain_parts.hpp"

namespace zstep::words {
namespace {

std::string edge(const Telling& t, std::int32_t number) {
  const EdgeTableInsert* entry = t.at.edge(number);
  return entry ? edge_label(t.scene, *entry) : fmt::format("e{}", number);
}

std::string names_inside(const Telling& t) {
  std::string names;
  for (const std::int32_t piece : t.machine.sweep.inside) names += (names.empty() ? "" : ", ") + t.piece(piece);
  return names;
}

/// The depth of a piece's plane, held against what was recorded.
void depth_formula(Telling& t, std::int32_t piece, double x, double y, double z) {
  t.derive(PlaneDepth{piece, x, y, z});
  t.follows(fmt::format("{} of {}", t.z, t.piece(piece)), "z", z);
}

}  // namespace

void tell(Telling& t, const FlagFlip& e) {
  t.say(
      e.inside
          ? fmt::format("The sweep crosses edge {}: the flag of {} turns to in.", edge(t, e.edge), t.piece(e.piece))
          : fmt::format("The sweep crosses edge {}: the flag of {} turns to out.", edge(t, e.edge), t.piece(e.piece)));
  const std::string names = names_inside(t);
  t.formula(names.empty() ? "in: none" : "in: " + names);
}

void tell(Telling& t, const SpanFlags& e) {
  const std::string pixels = e.last < e.first    ? "no pixel"
                             : e.first == e.last ? fmt::format("pixel {}", e.first)
                                                 : fmt::format("pixels {} to {}", e.first, e.last);
  const std::string what = e.last < e.first ? "it holds no pixel's centre, so nothing is to be done"
                           : e.flags == 0   ? "no flag is true, so nothing is drawn"
                           : e.flags == 1
                               ? fmt::format("only {} is in, so {} is seen", names_inside(t), names_inside(t))
                               : fmt::format("{} are in, so the frontmost must be found", names_inside(t));
  t.say(fmt::format("From here to the next edge: {}.", what));
  t.formula(fmt::format("x = {} to {}: {}, {} flag{} true", number(e.x_left), number(e.x_right), pixels, e.flags,
                        e.flags == 1 ? "" : "s"));
  t.value("x_L", e.x_left);
  t.value("x_R", e.x_right);
}

void tell(Telling& t, const PlaneDepth& e) {
  t.say(fmt::format("The plane of {} has the depth {} at x = {}, y = {}.", t.piece(e.piece), number(e.z),
                    number(e.x_at), number(e.y_at)));
  depth_formula(t, e.piece, e.x_at, e.y_at, e.z);
  t.value("x", e.x_at);
  t.value("y", e.y_at);
  t.value(t.z, e.z);
}

void tell(Telling& t, const ImpliedEdge& e) {
  t.say(fmt::format("Up to x = {} {} is in front, from there on {}: the two penetrate each other in an implied edge.",
                    number(e.x_at), t.piece(e.piece), t.piece(e.other)));
  if (t.machine.scan_line) {
    const auto y = static_cast<double>(*t.machine.scan_line);
    depth_formula(t, e.piece, e.x_at, y, e.z);
    depth_formula(t, e.other, e.x_at, y, e.z);
  }
  t.value("x", e.x_at);
  t.value(t.z, e.z);
}

void tell(Telling& t, const SpanWinner& e) {
  t.say(e.last < e.first
            ? fmt::format("{} is seen, but between two pixels' centres: no pixel shows it.", t.piece(e.piece))
        : e.first == e.last ? fmt::format("{} is seen at pixel {}.", t.piece(e.piece), e.first)
                            : fmt::format("{} is seen from pixel {} to pixel {}.", t.piece(e.piece), e.first, e.last));
}

void tell(Telling& t, const CoverageAdd& e) {
  const std::string who = e.owner == no_polygon ? "Nothing but background" : t.label(e.owner);
  t.say(fmt::format("{} is seen on {} % of the area of pixel ({}, {}).", who, number(100 * e.coverage, 1, true), e.x,
                    e.y));
  t.formula(fmt::format("share = {}", number(e.coverage)));
  t.value("share", e.coverage);
}

}  // namespace zstep::words
