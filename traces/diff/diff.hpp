// Where do two runs of a scene part, and what else follows from it?
//
// Steps are matched by what they are about (align.hpp). Where a step's numbers part, it is a cause if its operands did
// not part before, or if one of the two runs computes wrongly from the operands it has; else it is a symptom of what
// its operands come from. Operands are what a formula or a rule has (traces/formulas): that one step comes after
// another says nothing. What rounding explains under the number formats of both is kept apart from what it does not.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "traces/check/precision.hpp"
#include "traces/diff/align.hpp"

namespace zstep::diff {

enum class Part : std::uint8_t { different, rounding };

/// A step of B that is as it should be, but comes before one that it must not come before: where both paint, what comes
/// later is seen.
struct TooEarly {
  std::int64_t before = 0;     ///< the step of B that has to come first
  std::int32_t x = 0, y = 0;   ///< a pixel that both paint
  double z = 0, z_before = 0;  ///< the depths of both there
};

/// A compare that comes before another one at its pixel in one run, and after it in the other: its step in both.
struct OtherOrder {
  std::int64_t a = 0, b = 0;
  bool first_in_a = true;
};

/// Where the runs part, for a reason of its own.
struct Cause {
  Difference first;
  Part part = Part::different;
  bool wrong_a = false, wrong_b = false;  ///< the number does not follow from the run's own operands
  bool tie = false;                       ///< both compare two equal depths, and say otherwise which wins
  bool unexplained = false;               ///< a number, and not both runs have what it follows from
  std::int64_t again = 0;                 ///< later differences of the same sort, with a reason of their own
  std::int64_t symptoms = 0;              ///< differences that follow from it
  std::int64_t pixels = 0;                ///< of these, pixels that were written otherwise
  std::int64_t elsewhere = 0;             ///< of a step of one run: the other run's, which has it at another place
  std::optional<TooEarly> too_early = std::nullopt;  ///< nothing but its place in the order is wrong
  bool operands_differ = false;  ///< a result, and each run has computed it rightly from operands of its own
  bool unjudged = false;         ///< a verdict or a choice, and neither header nor formula says which one is right
  std::optional<OtherOrder> other_order = std::nullopt;  ///< by which the operands of a compare differ
};

/// Of a kind of event: steps that are to the bit the same, part by rounding, part otherwise, or are only in one run.
struct KindDifference {
  std::int64_t same = 0, rounding = 0, different = 0, only_a = 0, only_b = 0;
  std::int64_t idle_a = 0, idle_b = 0;  ///< of the last two: steps that right programs do or leave out, as they like
  std::int64_t not_followed = 0;        ///< in both runs and not the same, beyond as many as causes are looked for
};

struct DiffReport {
  Alignment alignment;
  std::array<KindDifference, kind_count> kinds{};
  std::vector<Cause> causes;         ///< those that are different, then those by rounding, each by the steps of B
  Precision precision;               ///< the coarser one of the two
  std::int64_t differences() const;  ///< all that rounding does not explain
};

/// Compares two runs. `on_way` is called now and then with the share done; if it returns true, the report is partial.
/// Numbers are held to what precision_of() is told. Causes are looked for among the first differences, `keeps` of them.
DiffReport compare(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way = nullptr,
                   Way way = Way::fast, const HeldTo& held = {}, std::size_t keeps = most_differences,
                   Unrecorded unrecorded = Unrecorded::left_out);

}  // namespace zstep::diff
