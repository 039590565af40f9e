// What the numbers of a chain would be without any rounding, and where the error of the first one came in.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/answers/origin/chain.hpp"
#include "traces/file/trace.hpp"

namespace zstep::answers {

/// A number of a chain, held against what + − × ÷ and square roots give from the scene's numbers without rounding.
struct Exact {
  bool known = false;
  std::string why;        ///< where it is not known: what stands in the way
  bool enclosed = false;  ///< it has a square root behind it, and is known to lie in an interval narrower than its
                          ///< 2⁻¹⁰⁰th part; the digits are those of the middle
  std::string digits;     ///< "1/3 = 0.3333333333333333333333333"
  double error = 0;       ///< the recorded number − the exact one
  double ulps = 0;        ///< the same, in units of the last digit that the trace's number format has there
  double brought = 0;     ///< what rounding at this very step adds to the error of the chain's first number
};

struct Exactness {
  std::vector<std::vector<Exact>> of;  ///< by link and by value
  struct Where {
    std::size_t link, value;
  };
  double buffer_unit = 0;     ///< the last bit of the depth buffer at the first number, where that is a depth; else 0
  std::optional<Where> most;  ///< where most of the first number's error came in, if it has one
};

Exactness exactness_of(const Chain& chain, const Trace& trace);

/// Two digits, with signs as they are printed.
std::string roughly(double value);
/// "exactly 1/3 = 0.3333…; error −1.9e−17, −0.33 ulp"
std::string exact_text(const ChainValue& value, const Exact& exact);

}  // namespace zstep::answers
