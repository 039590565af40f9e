#include "sim/words/hex.hpp"

#include <cmath>

#include <fmt/format.h>

namespace zstep {

std::string hex_text(double value) {
  if (value == 0) return std::signbit(value) ? "-0x0p+0" : "0x0p+0";
  return fmt::format("{:a}", value);
}

}  // namespace zstep
