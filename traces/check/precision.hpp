// How exact the numbers of a trace are: as its header declares, else as the numbers themselves look.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "traces/file/trace.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

/// By how much rounding may change a depth at each pixel, whatever its size: of a depth near 0 no share of it says
/// that.
struct DepthBounds {
  std::int32_t width = 0;
  std::vector<double> of_pixel;  ///< [height*width], Picture::at, in units of depth
  double at(std::int64_t x, std::int64_t y) const {
    const std::int64_t pixel = y * width + x;
    const bool inside = x >= 0 && x < width && y >= 0 && static_cast<std::size_t>(pixel) < of_pixel.size();
    return inside ? of_pixel[pixel] : 0;
  }
};

struct Precision {
  double relative = 0;      ///< by what share of itself a number may be off
  double absolute = 0;      ///< and by how much besides: depths in fixed point, numbers written with so many decimals
  bool every_digit = true;  ///< all digits that the program computed with are there: equal means equal
  std::string text;         ///< "float64, as the header declares"
  NumberFormat format = NumberFormat::float64;
  double unit = 0;    ///< of fixed-point depths, or of the last decimal that is written; else 0
  bool held = false;  ///< to more digits than are written, as `digits` asks
  std::shared_ptr<const DepthBounds> depths = nullptr;  ///< as it was told
  bool whole = false;                                   ///< depths, and they alone, are rounded to whole numbers
  int digits = 0;                                       ///< that are written of each number, where they are cut; else 0
  double positions = 0;  ///< by how much positions in pixels may be off where that is another amount: in fixed point

  /// What a number of this unit may be off besides its share. Of units that a program need not keep in fixed point, the
  /// larger amount.
  double amount(std::string_view of_unit) const {
    if (whole) return of_unit == "depth" ? absolute : 0;
    if (positions == 0 || of_unit == "depth") return absolute;
    return of_unit == "px" ? positions : largest_amount();
  }
  /// Of numbers of which the unit is not asked.
  double largest_amount() const { return whole ? 0 : std::max(absolute, positions); }
  /// The same of an operand, by the field that it stands in.
  double amount(const formulas::Place& place) const;
  double allowed_depth(std::int64_t x, std::int64_t y) const { return depths ? depths->at(x, y) : 0; }
};

/// Holds what is said of a step to these numbers.
void hold(formulas::Situation& at, const Precision& precision);

/// One unit of the last digit of a number that is written with so many.
double last_written_digit(double value, int digits);

/// What numbers are held to, whatever they look like.
struct HeldTo {
  int digits = 0;  ///< or decimals, at least
  std::uint32_t fixed =
      ~0u;  ///< bit F: numbers of the fixed-point format F are taken for such where no format is declared
  std::shared_ptr<const DepthBounds> depths = nullptr;  ///< what theory allows the depths of pixels, where it is known
  HeldTo() = default;
  HeldTo(int least, std::uint32_t formats = ~0u) : digits(least), fixed(formats) {}  // NOLINT: a number of digits
  bool takes(NumberFormat format) const { return (fixed >> static_cast<unsigned>(format) & 1) != 0; }
};

/// Reads the whole trace where the header declares no number format: a program that prints "%f" or "%.6g" writes fewer
/// digits than it computes with, and one that computes in float32 writes numbers that are float32.
/// Numbers are held to so many digits, or decimals, however few are written.
Precision precision_of(const Trace& trace, const HeldTo& held = {});

}  // namespace zstep
