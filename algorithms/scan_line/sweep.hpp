// The sweep along a scan line: across the active edges from left to right, with an in/out flag for each polygon.
#pragma once

#include <algorithm>
#include <vector>

#include "algorithms/scan_line/front.hpp"

namespace zstep::scan_line {

/// What a sweep looks for: the pixels, so that intervals without a pixel's centre need no depth, or every length of
/// line.
enum class Wanted : std::uint8_t { pixels, lengths };

/// Finds what is seen on scan line y and calls seen(const Visible&) for each part, from left to right. `coherence` may
/// be null. Flags are out before the first edge and after the last, as every outline is crossed an even number of
/// times.
template <Recorder R, class Seen>
void sweep(const Tables& tables, const std::vector<std::int32_t>& active, double y, std::int32_t width, Wanted wanted,
           Coherence* coherence, R& record, Seen&& seen) {
  std::vector<std::int32_t> inside;  // the polygons whose flag is true
  std::vector<Visible> visible;
  if (coherence) coherence->begin_line(active);

  for (std::size_t i = 0; i < active.size(); ++i) {
    const std::int32_t piece = tables.owner_of(active[i]);
    const auto flag = std::find(inside.begin(), inside.end(), piece);
    const bool enters = flag == inside.end();
    record(step::flip, FlagFlip{active[i], piece, enters});
    if (enters) inside.push_back(piece);
    else inside.erase(flag);

    if (i + 1 == active.size()) break;
    const Interval interval = interval_between(y, tables.x_of(active[i]), tables.x_of(active[i + 1]), width);
    if (!(interval.x_left < interval.x_right)) continue;  // two edges at one x, or outside the raster
    const auto row = static_cast<std::int32_t>(y), flags = static_cast<std::int32_t>(inside.size());
    record(step::flags, SpanFlags{row, interval.x_left, interval.x_right, interval.first, interval.last, flags});
    if (inside.empty() || (wanted == Wanted::pixels && interval.last < interval.first)) continue;

    const bool known =
        coherence && flags > 1 && coherence->as_before(tables.polygons, i, inside, interval, visible, record);
    if (!known) {
      find_front(tables.polygons, inside, interval, visible, record);
      if (coherence) coherence->keep(tables.polygons, i, visible);
    }
    for (const Visible& part : visible) seen(part);
  }
}

}  // namespace zstep::scan_line
