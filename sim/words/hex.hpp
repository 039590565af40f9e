#pragma once

#include <string>

namespace zstep {

/// Every bit of a number as C writes it: "0x1.8p+1". (Of 0 some libraries write the exponent of the smallest number.)
std::string hex_text(double value);

}  // namespace zstep
