#pragma once

#include <string>
#include <vector>

#include "sim/image/drawing.hpp"

namespace zstep::cli {

/// The file that --plot names, if it is given. Throws InputError where this zstep cannot draw charts.
std::vector<std::string> chart_outputs(const std::string& plot);

/// Writes an SVG where the file is called so, else a PNG; what was written, for people.
std::string write_chart(const std::string& plot, const Drawing& drawing);

}  // namespace zstep::cli
