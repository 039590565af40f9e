#pragma once

#include <string>

#include "sim/image/png.hpp"

namespace zstep {

/// A chart as a picture, and the same as SVG.
struct Drawing : Image {
  std::string svg;
};

}  // namespace zstep
