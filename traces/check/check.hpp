// Does each step of a run follow from its own operands? Judges a trace that zstep need not have made, by the formulas
// of traces/formulas and the rules of the algorithm, under the conventions that its header declares.
//
// A number is held against what its formula gives for the operands that the trace itself has. So an error counts once,
// where it is made; what correctly follows from it is counted as its consequence.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "traces/check/precision.hpp"
#include "traces/check/rules.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"
#include "traces/file/trace.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

/// Something that is wrong at a step: a field that is not what its formula gives, a rule that is broken, or a step that
/// cannot be at all.
struct Fault {
  std::int64_t step = 0;
  std::uint8_t line = 0;  ///< of the pseudo-code: the step's id
  std::uint8_t kind = 0;  ///< of the event
  std::string field;      ///< "x_edge"; empty where a rule is broken
  std::optional<formulas::Rule> rule;
  double recorded = 0, expected = 0;  ///< of a field
  std::string impossible;             ///< why the step cannot be
  bool by_scene = false;  ///< `expected` is what the scene has there, though the step goes with what the run has
  /// Where the rule is about another pixel than the step's, and how many more are like it.
  std::optional<Trace::Pixel> pixel;
  std::int64_t more_pixels = 0;
  std::int32_t facet = -1;  ///< that is never begun
  /// NaN or an infinity stands where a finite number must be, and no formula says which; then `expected` is NaN.
  bool no_number() const { return !std::isfinite(recorded) && std::isnan(expected); }
};

/// A fault that does not follow from another one, and what goes with it.
struct Cause {
  Fault first;
  std::int64_t again = 0;      ///< later steps with the same fault, not for the same reason as another's
  std::int64_t inherited = 0;  ///< later steps that follow, correctly, from what is wrong here
};

/// How much of the steps of one kind could be judged.
struct KindJudged {
  static constexpr std::size_t most_fields = 16;
  std::int64_t steps = 0;
  bool can_be_judged = false;                      ///< there is a formula or a rule for steps of this kind
  bool joins_things = false;                       ///< there is none, and something may be wrong all the same
  std::int64_t judged = 0;                         ///< of these, with a field or a rule that could be judged
  std::array<std::int64_t, most_fields> fields{};  ///< by field: in how many steps something says what it must be
  /// Nothing that the other one judges is left out.
  bool covers(const KindJudged& other) const;
};

struct CheckReport {
  std::int64_t steps = 0;        ///< that were gone through
  std::int64_t judged = 0;       ///< of these, with a field or a rule that could be judged
  std::int64_t numbers = 0;      ///< that were held against a formula
  std::int64_t exact = 0;        ///< of these, to the last bit
  std::int64_t rounded = 0;      ///< within what rounding allows
  double largest_rounding = 0;   ///< in last digits of the number format, of the largest number in the formula
  std::int64_t wrong_steps = 0;  ///< with a fault of their own
  std::int64_t inherited = 0;    ///< without one, but following from one
  Precision precision;
  std::vector<Cause> causes;  ///< by their first step
  std::array<KindJudged, kind_count> kinds{};
  bool coverage = false;  ///< a pixel that is missing or too many would have been found, in what is recorded
  std::vector<std::int32_t> polygons_missing;  ///< of the scene: the run has no step of them, and does not say why
};

/// Which steps are wrong or follow from what is wrong, and where that is: for who marks them. The steps and the faults
/// are in the order of the run.
struct CheckMarks {
  struct Step {
    std::int64_t step = 0;
    std::int32_t cause = 0;  ///< its place among the causes
    bool wrong = false;      ///< it has a fault of its own; else it follows from the cause
  };
  /// From this step on a place holds what follows from a cause; or, with none, no longer does.
  struct Change {
    std::int64_t step = 0;
    formulas::Place place;
    std::int32_t cause = none;
  };
  static constexpr std::int32_t none = -1;
  static constexpr std::size_t most = 4'000'000;  ///< steps and changes; what comes later is not marked

  std::vector<Step> steps;
  std::vector<Fault> faults;  ///< all of them, a step's one after another
  std::vector<Change> changes;
  bool complete = true;
};

/// What a caller may look at where a cause is found: the state before it, and the event.
using OnCause = std::function<void(const Cause&, const formulas::Situation&, const RecordedEvent&)>;
/// Called now and then with the steps that are done; true ends the check there.
using OnChecked = std::function<bool(std::int64_t)>;

/// Goes through the whole trace, its numbers held to what precision_of() is told. Throws InputError where it cannot be
/// read.
CheckReport check(const Trace& trace, const OnCause& on_cause = nullptr, const OnChecked& on_checked = nullptr,
                  CheckMarks* marks = nullptr, const HeldTo& held = {});

/// All that is wrong in a run, in its order, its numbers held to this.
std::vector<Fault> faults_of(const Trace& trace, const Precision& precision);

/// One convention declared otherwise, as a trace's first line writes it: of those that may turn a wrong run into a
/// right one.
struct Otherwise {
  std::string_view key, word;
  std::function<void(Header&)> change;
  bool is_of_raster = false;                     ///< it stands in the scene, with its raster
  bool is_of_numbers = false;                    ///< the run's numbers are then others (traces/file/written.hpp)
  std::function<void(Raster&)> change_raster{};  ///< then
  /// Whether a run with this header and scene has it so already.
  bool holds(const Header& header, const Raster& raster) const;
};
std::vector<Otherwise> other_conventions();

/// Conventions, one or two, that a trace's steps follow, other than its header says or leaves to be assumed.
struct OtherConvention {
  struct Declared {
    std::string key, word;  ///< "nearer", "greater", as the first line writes them
    bool in_raster = false;
    bool operator==(const Declared&) const = default;
  };
  std::vector<Declared> declared;
  std::int64_t wrong_steps = 0;  ///< that would be wrong under them
};
/// Of a trace with something wrong: the conventions under which the least would be, where that is less than a tenth of
/// what is wrong under its own, and all that is judged under its own is judged under those, too: one, or two together
/// where one alone leaves anything wrong and two leave less than a tenth of that. Goes through the trace for each, and
/// for some of the pairs, fewer of a long one.
std::optional<OtherConvention> convention_it_follows(const Trace& trace, const CheckReport& report);

// What a check leaves open: of which steps of a run, and of which of their numbers, nothing says what they must be.

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
