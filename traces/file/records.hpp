// What a run can have recorded, by its pseudo-code.
#pragma once

#include <algorithm>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"

namespace zstep {

/// Events of this kind?
inline bool records(const Header& header, std::size_t kind) {
  return std::any_of(header.page.begin(), header.page.end(), [&](const StepInfo& step) { return step.kind == kind; });
}
template <class E>
bool records(const Header& header) {
  return records(header, kind_of<E>);
}

/// Scan lines that go through all polygons at once, whose edges stand in one table?
inline bool sweeps(const Header& header) { return records<FlagFlip>(header); }

}  // namespace zstep
