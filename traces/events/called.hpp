// What readers call an event, beyond the vocabulary's own headers: few ask, so not every file that knows events is
// compiled with it.
#pragma once

#include <cstddef>
#include <string_view>

namespace zstep {

/// One event of a kind, by its numbers: "span of scan line {y}", where {field} stands for what a field names. The kind's
/// meaning where it has no words of its own.
std::string_view called(std::size_t kind);

/// Is it about all polygons at once, after the work on each of them?
bool after_polygons(std::size_t kind);

/// Where it gives a piece to several pixels at once, seen from one of them: "in the area around it"; empty for all others.
std::string_view gives_around(std::size_t kind);

}  // namespace zstep
