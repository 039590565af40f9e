// Where do two runs of a scene part, which steps of theirs are the same step, and what else follows from it?
//
// Steps are matched by what they are about. Where a step's numbers part, it is a cause if its operands did
// not part before, or if one of the two runs computes wrongly from the operands it has; else it is a symptom of what
// its operands come from. Operands are what a formula or a rule has (traces/formulas): that one step comes after
// another says nothing. What rounding explains under the number formats of both is kept apart from what it does not.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "traces/check/precision.hpp"
#include "traces/file/trace.hpp"

namespace zstep::diff {

// Which steps of two runs are the same step, and which of those part.

/// A step of one run that is not, to the last bit, what the other run has for it.
struct Difference {
  std::int64_t a = 0, b = 0;  ///< the steps, counted from 1; 0 where the run has no such step
  std::uint16_t fields = 0;   ///< bit I: the I-th field differs
  std::uint8_t kind = 0;      ///< of the event
  std::uint8_t line = 0;      ///< of the pseudo-code of B, or of A where B has no such step: the step's id
  float off = 0;              ///< of the numbers that differ: how far, as a share of the larger one, at most
  bool only_a() const { return b == 0; }
  bool only_b() const { return a == 0; }
};

/// Steps a + i and b + i are the same step, for i from 0 to below count.
struct Match {
  std::int64_t a = 0, b = 0, count = 0;
};

/// How many steps of a kind.
struct KindCount {
  std::int64_t pairs = 0, equal = 0, only_a = 0, only_b = 0;
  std::int64_t not_kept = 0;  ///< pairs that differ, beyond as many as are kept
};

/// So many differences are kept, the first that are found: until their causes are known each takes about 100 bytes.
inline constexpr std::size_t most_differences = 4'000'000;

struct Alignment {
  std::vector<Match> by_a, by_b;            ///< the same, ordered by one run's steps and by the other's
  std::vector<Difference> differences;      ///< by the steps of B; what B does not have stands where it would have been
  std::array<KindCount, kind_count> kinds;  ///< of the kinds that are compared
  std::array<bool, kind_count> compared{};  ///< which these are
  bool turns = false;                       ///< of two methods, each says whose turn it is
  std::size_t keeps = most_differences;
  std::int64_t not_kept = 0;  ///< differences beyond those, which are only counted
  bool identical = false;     ///< byte for byte
  bool complete = true;       ///< false where it ended at a limit, or was told to

  /// Takes note of a difference.
  void differs(const Difference& difference);

  /// The other run's step for one's own; 0 where there is none.
  std::int64_t in_b(std::int64_t a) const;
  std::int64_t in_a(std::int64_t b) const;
  /// The last of the other run's steps that comes before what one's own step would be there; 0 where there is none.
  std::int64_t before_in_b(std::int64_t a) const;
  std::int64_t before_in_a(std::int64_t b) const;
};

/// Fast: together where the runs do the same. Plain: every step for itself, which gives the same (tests compare both).
enum class Way : std::uint8_t { fast, plain };

/// Steps of a kind that one run never records: it may do them all the same, and not print them. Or it was to print what
/// its pseudo-code has a line for; then what is done to pixels is missing.
enum class Unrecorded : std::uint8_t { left_out, missing_of_pixels };

/// Matches the steps of two runs by what they are about: steps may be missing, additional or in another order.
/// `on_way` is called now and then with the share done; true ends it.
Alignment align(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way = nullptr,
                Way way = Way::fast, std::size_t keeps = most_differences,
                Unrecorded unrecorded = Unrecorded::left_out);

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
