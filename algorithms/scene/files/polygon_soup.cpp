
#include "algorithms/scene/files/polygon_soup.hpp"

#include <fmt/format.h>

#include "traces/error.hpp"

namespace zstep::scene {

void PolygonSoup::too_much(std::string_view where, std::string_view what, std::int64_t most) {
  throw InputError(where, fmt::format("there are more than {} {}, the most that are read", most, what),
                   "decimate the mesh in a modelling program");
}

}  // namespace zstep::scene
