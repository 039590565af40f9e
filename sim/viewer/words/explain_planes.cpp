// Vertices against planes, as a BSP tree asks (001, 003), and what coherence saved.
#include "sim/viewer/words/explain_parts.hpp"

#include <algorithm>

#include "sim/viewer/words/pieces.hpp"

namespace zstep::words {
namespace {

const char* where(Side side) {
  switch (side) {
    case Side::front: return "in front of";
    case Side::behind: return "behind";
    case Side::on: return "in";
    default: return "on both sides of";
  }
}

}  // namespace

void tell(Telling& t, const VertexSide& e) {
  t.say(fmt::format("Vertex {} lies {} the plane of {}.", e.vertex, where(e.side), t.piece(e.plane_of)));
  t.value("value", e.value);
  const Piece* of = t.piece_at(e.plane_of);
  const auto p = cutting_point(t.scene, t.after, e.vertex);
  if (!of || !of->plane || !p) return;
  const PlaneEquation& plane = *of->plane;
  t.formula(fmt::format("A x + B y + C z + D = {}\u00b7{} + {}\u00b7{} + {}\u00b7{} + {} = {}", operand(plane.plane_a, factor(plane.plane_a)), operand(p->x),
                        operand(plane.plane_b, factor(plane.plane_b)), operand(p->y), operand(plane.plane_c, factor(plane.plane_c)), operand(p->z), operand(plane.plane_d),
                        number(e.value)));
  const double computed = plane.plane_a * p->x + plane.plane_b * p->y + plane.plane_c * p->z + plane.plane_d;
  const double size = std::abs(plane.plane_a * p->x) + std::abs(plane.plane_b * p->y) + std::abs(plane.plane_c * p->z) + std::abs(plane.plane_d);
  if (std::abs(computed - e.value) > 1e-9 * size) t.hold_against("the value", e.value, computed);  // on the plane: rounding
}

void tell(Telling& t, const Saved& e) {
  std::string thanks_to(words_of<Coherence>[static_cast<std::size_t>(e.coherence)]);
  std::replace(thanks_to.begin(), thanks_to.end(), '_', ' ');
  if (e.coherence == Coherence::extent) thanks_to = "extents";
  else if (e.coherence == Coherence::order) thanks_to = "the order of drawing";
  else thanks_to += " coherence";
  t.say(fmt::format("{} {} not needed, thanks to {}; {} so far.", e.tests, e.tests == 1 ? "test was" : "tests were", thanks_to,
                    grouped(t.machine.saved[static_cast<std::size_t>(e.coherence)])));
}

}  // namespace zstep::words
