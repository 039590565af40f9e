// Why the timeline shows no scan lines where a method has some.
#pragma once

#include <cstdint>
#include <string>

#include "sim/viewer/model/summary.hpp"

namespace zstep::viewer {

/// Of an interval without scan lines, at a position in it: "no scan lines of polygon K yet".
std::string why_no_lines(const Trace& trace, const ScanLineMarks::Interval& interval, std::int64_t position);

}  // namespace zstep::viewer
