// A number as it is written, read to the nearest double.
#pragma once

#include <cstddef>
#include <string_view>

namespace zstep {

/// Reads the decimal number that `text` begins with: "-12", "3.5e-2", ".5". Returns how many characters it has; 0, with
/// `value` as it was, where there is none or it is beyond what a double holds. (Some standard libraries have no
/// std::from_chars for doubles.)
std::size_t read_number(std::string_view text, double& value);

}  // namespace zstep
