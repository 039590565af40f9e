// Boxes about polygons: programs make them wider by a little, which changes their sides and where rays meet them.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "traces/formulas/of_rays.hpp"

namespace zstep::formulas {

/// The largest number of a box; 0 of other steps. Its sides are off by a share of that, for they may be 0.
template <class E>
double size_of_box(const E& e) {
  if constexpr (std::is_same_v<E, BoxMake>)
    return std::max({std::abs(e.x_min), std::abs(e.x_max), std::abs(e.y_min), std::abs(e.y_max), std::abs(e.z_min),
                     std::abs(e.z_max)});
  else return 0;
}

/// By what share a box, or where a ray meets it, is off with such a margin; `apart(a, b)` is the share between two.
template <class E, class Apart>
double off_by_margin(const E& e, const Situation& at, double margin, Apart&& apart) {
  if constexpr (std::is_same_v<E, BoxMake>) {
    return margin / size_of_box(e);
  } else if constexpr (std::is_same_v<E, BoxTest>) {
    const RayBegin* ray = detail::ray_cast_last(at);
    const auto& boxes = at.method().boxes;
    const auto number = static_cast<std::size_t>(e.box);
    if (!ray || e.box < 0 || number >= boxes.size()) return 0;
    BoxMake wider = boxes[number].entry;
    const detail::Passage through = detail::passage_of(*ray, wider);
    wider.x_min -= margin, wider.y_min -= margin, wider.z_min -= margin;
    wider.x_max += margin, wider.y_max += margin, wider.z_max += margin;
    const detail::Passage about = detail::passage_of(*ray, wider);
    const auto moved = [&](double one, double other) { return one == other ? 0 : apart(one, other); };
    return std::max(moved(through.enter.value, about.enter.value), moved(through.leave.value, about.leave.value));
  } else {
    return 0;
  }
}

}  // namespace zstep::formulas
