// What a check leaves open: of which steps of a run, and of which of their numbers, nothing says what they must be.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "traces/check/check.hpp"
#include "traces/file/header.hpp"

namespace zstep {

/// A kind of step of which something is not judged.
struct NotJudged {
  std::uint8_t kind = 0;
  std::int64_t steps = 0, of = 0;        ///< in so many of its steps
  std::vector<std::string_view> fields;  ///< these fields; all of the step where it is empty
  bool never = false;                    ///< in no run: no formula says what they must be
};
/// In the order of the vocabulary. Kinds that only say where the run has come to are not among them: there is nothing
/// in them that could be wrong.
std::vector<NotJudged> not_judged(const CheckReport& report);

enum class Verdict : std::uint8_t {
  wrong,
  not_judged,          ///< nothing could be
  right_where_judged,  ///< of some kind of step nothing, or not all, is judged
  right,
};
Verdict verdict_of(const CheckReport& report);

/// The steps of the pseudo-code that the run has no events of, by name. They are taken as not recorded.
std::vector<std::string_view> never_recorded(const Header& header, const CheckReport& report);

}  // namespace zstep
