// What a run can have recorded, by its pseudo-code.
#pragma once

#include <algorithm>
#include <cstdint>

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

/// Where the method itself keeps depths to compare with: for the whole picture, for one scan line, or nowhere. What is
/// painted has a depth in the trace even where the method never looks at it.
enum class DepthBuffer : std::uint8_t { none, line, picture };
inline DepthBuffer depth_buffer(const Header& header) {
  const bool keeps = records<DepthInterpolate>(header) || records<DepthCompare>(header) || records<DepthWrite>(header);
  if (!keeps) return DepthBuffer::none;
  if (!records<SpanFlags>(header)) return DepthBuffer::picture;
  // The scan-line method has steps for both of its ways.
  const auto resolve = header.conventions.options.find("resolve");
  const bool by_line = resolve != header.conventions.options.end() && resolve->second == "line-buffer";
  return by_line ? DepthBuffer::line : DepthBuffer::none;
}

/// Scan lines that go through all polygons at once, whose edges stand in one table?
inline bool sweeps(const Header& header) { return records<FlagFlip>(header); }

}  // namespace zstep
