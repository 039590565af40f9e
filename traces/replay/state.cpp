#include "traces/replay/state.hpp"

#include "traces/replay/same.hpp"

namespace zstep {

namespace {

bool same_picture(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height && same(a.polygon, b.polygon) && same(a.depth, b.depth) &&
         same(a.ink, b.ink);
}

}  // namespace

bool State::operator==(const State& other) const {
  return position == other.position && same(machine, other.machine) && same_picture(picture, other.picture) &&
         same_picture(light, other.light) && same(vertices, other.vertices);
}

}  // namespace zstep
