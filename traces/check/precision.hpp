// How exact the numbers of a trace are: as its header declares, else as the numbers themselves look.
#pragma once

#include <cstdint>
#include <string>

#include "traces/file/trace.hpp"

namespace zstep {

struct Precision {
  double relative = 0;        ///< by what share of itself a number may be off
  double absolute = 0;        ///< and by how much besides: numbers written with so many decimals
  bool every_digit = true;    ///< all digits that the program computed with are there: equal means equal
  std::string text;           ///< "float64, as the header declares"
  NumberFormat format = NumberFormat::float64;
  double unit = 0;            ///< of fixed-point depths, or of the last decimal that is written; else 0
  bool held = false;          ///< to more digits than are written, as `digits` asks
};

/// What numbers are held to, whatever they look like.
struct HeldTo {
  int digits = 0;  ///< or decimals, at least
  std::uint32_t fixed = ~0u;  ///< bit F: numbers of the fixed-point format F are taken for such where no format is declared
  HeldTo() = default;
  HeldTo(int least, std::uint32_t formats = ~0u) : digits(least), fixed(formats) {}  // NOLINT: a number of digits
  bool takes(NumberFormat format) const { return (fixed >> static_cast<unsigned>(format) & 1) != 0; }
};

/// Reads the whole trace where the header declares no number format: a program that prints "%f" or "%.6g" writes fewer
/// digits than it computes with, and one that computes in float32 writes numbers that are float32.
/// Numbers are held to so many digits, or decimals, however few are written.
Precision precision_of(const Trace& trace, const HeldTo& held = {});

}  // namespace zstep
