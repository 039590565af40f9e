// Vertices against planes, as a BSP tree asks (001, 003), and what coherence saved.
#include "sim/words/explain_parts.hpp"

#include <algorithm>

namespace zstep::words {
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
  std::string thanks_to(words_of<Coherence>[static_cast<std::size_t>(e.coherence)]);
  std::replace(thanks_to.begin(), thanks_to.end(), '_', ' ');
  if (e.coherence == Coherence::extent) thanks_to = "extents";
  else if (e.coherence == Coherence::order) thanks_to = "the order of drawing";
  else thanks_to += " coherence";
  t.say(fmt::format("{} {} not needed, thanks to {}; {} so far.", e.tests, e.tests == 1 ? "test was" : "tests were",
                    thanks_to, grouped(t.machine.saved[static_cast<std::size_t>(e.coherence)])));
}

}  // namespace zstep::words
