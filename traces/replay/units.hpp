// What begins with an event: the units in which a reader goes through a trace.
#pragma once

#include <string_view>

#include "traces/replay/replay.hpp"

namespace zstep {

struct Begins {
  Unit unit = Unit::event;
  std::string_view word{};  ///< what methods call the unit that have areas, edges or curves in its stead
};
const Begins& begins_with(std::size_t kind);

}  // namespace zstep
