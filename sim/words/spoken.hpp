// Sentences and formulas as they are read aloud: every sign a word, for a screen reader, which passes over signs.
#pragma once

#include <string>
#include <string_view>

namespace zstep::words {

/// A sentence, a heading, or what stands in a table: "z* ≥ −0.5" becomes "z star at least minus 0.5".
std::string spoken(std::string_view text);

/// A formula's line as read_notation() reads it: "z = (a + b)/4 = 0.75" becomes "z equals, a plus b, over 4, equals
/// 0.75".
std::string spoken_formula(std::string_view line);

}  // namespace zstep::words
