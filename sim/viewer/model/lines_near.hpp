// Which lines of the pseudo-code matter at a step: what a class is shown, and what stays where there is no room for
// all.
#pragma once

#include <cstddef>
#include <vector>

#include "traces/file/header.hpp"

namespace zstep::viewer {

/// The line at work, the lines it stands in, its neighbours in the same block and what it holds. Where it stands in its
/// block alone, the neighbours of the line around it, too, as one of them comes next.
std::vector<bool> lines_near(const Page& page, std::size_t now);

}  // namespace zstep::viewer
