// A formula's line as it is set in type: fractions, letters with what stands below them, numbers, and signs between.
// Reads what the formulas were written as (derived.hpp), so that what is set is what is printed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::words {

struct Notation {
  enum class Kind : std::uint8_t {
    text,      ///< words and signs
    number,    ///< "−0.5"
    symbol,    ///< "x", and "L" below it
    row,       ///< one beside the other
    fraction,  ///< one over the other
  };
  Kind kind = Kind::text;
  std::string text{};                 ///< of text, numbers and symbols
  std::string below{};                ///< what stands below a symbol; mostly empty
  std::vector<Notation> parts{};      ///< of a row; of a fraction these two: above and below the line
  std::int32_t polygon = no_polygon;  ///< whose number it is, once mark_owned() has said so

  bool operator==(const Notation&) const = default;
};

/// "z_L" is a number of this polygon.
struct Owned {
  std::string symbol;
  std::int32_t polygon = no_polygon;
  bool operator==(const Owned&) const = default;
};

/// The sides between " = ": "z = z_L + k", then "0.5 + 0.25", then "0.75" of a line with two signs. What is no formula
/// is text. Costs what the line is long; brackets nested deeper than 32 are text.
std::vector<Notation> read_notation(std::string_view line);

/// On one line again, where there is no room for fractions: "(a + b)/(c − d)".
std::string on_one_line(const Notation& part);

/// Are these the same formula, once in symbols and once in numbers? Then what stands at the same place in both belongs
/// together.
bool alike(const Notation& one, const Notation& other);

}  // namespace zstep::words
