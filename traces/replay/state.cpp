#include "traces/replay/state.hpp"

#include "traces/replay/same.hpp"

namespace zstep {

namespace {

bool same_picture(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height && same(a.polygon, b.polygon) && same(a.depth, b.depth) &&
         same(a.ink, b.ink);
}

}  // namespace

std::vector<std::int32_t> draw_places(const MethodState& machine) {
  std::vector<std::int32_t> places(machine.pieces.size(), -1);
  std::int32_t place = 0;
  for (const std::int32_t piece : machine.drawn) places[piece] = place++;
  return places;
}

bool State::operator==(const State& other) const {
  return position == other.position && same(machine, other.machine) && same_picture(picture, other.picture) &&
         same_picture(light, other.light) && same(vertices, other.vertices);
}

}  // namespace zstep
