// Goes through one of two runs, from where they differ first, and follows what is different: what a difference goes
// back to, and whether it follows from the run's own operands.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "traces/check/inheritance.hpp"
#include "traces/diff/diff.hpp"
#include "traces/diff/identity.hpp"
#include "traces/replay/apply.hpp"

namespace zstep::diff {

// To where two runs differ first: what comes before needs no formulas, and what comes after the last difference, and
// does not belong to it, is not read at all.

/// Does to a state what the steps do.
class Replaying {
 public:
  Replaying(const Trace& trace, State state) : points_(trace.scene().points.size()), state_(std::move(state)) {}
  const State& state() const { return state_; }

  template <class E>
  void apply(std::int64_t position, const E& e) {
    try {
      apply_stores(e, state_, points_, log_);
      apply_method_state(e, state_.machine, position);
    } catch (const Impossible&) {  // `check` says so
    }
    state_.position = position;
  }
  /// Of pixels, the first of which follows this position.
  template <class Run>
  void apply_pixels(std::int64_t position, const Run& run) {
    apply_run(run, state_);
    state_.position = position + run.events();
  }

 private:
  std::size_t points_;
  State state_;
  NoLog log_;
};

/// Asks now and then whether to go on.
class GoOn {
 public:
  explicit GoOn(const std::function<bool(std::int64_t)>& on_way) : on_way_(on_way) {}
  bool operator()(std::int64_t position) { return !(on_way_ && ++visits_ % now_and_then == 0 && on_way_(position)); }

 private:
  static constexpr std::uint64_t now_and_then = 1 << 14;
  const std::function<bool(std::int64_t)>& on_way_;
  std::uint64_t visits_ = 0;
};

inline std::int64_t own_step(const Difference& difference, bool of_a) { return of_a ? difference.a : difference.b; }
/// The last step of one run that comes before where the other one's would be.
inline std::int64_t step_before(const Alignment& alignment, const Difference& difference, bool in_a) {
  return in_a ? alignment.before_in_a(difference.b) : alignment.before_in_b(difference.a);
}

/// A run before the first of its steps that can matter.
struct BeforeFirst {
  std::int64_t position = 0;
  std::int64_t last = 0;  ///< the last step that differs
  State state;
  Identity identity;
};
BeforeFirst go_to_first(const Trace& trace, bool of_a, const DiffReport& report,
                        const std::function<bool(std::int64_t)>& on_way, Way way);

/// In place of a number among the differences.
inline constexpr std::int32_t no_difference = Inheritance::clean;

/// What going through one of the two runs says of a difference.
struct Finding {
  /// An earlier difference that its operands, or what it is part of, go back to.
  std::int32_t comes_from = no_difference;
  bool wrong = false;     ///< it does not follow from the run's own operands
  bool rounding = false;  ///< it, or what it comes from, is no more than rounding allows
  bool decides = false;   ///< what it says is no number, so that other steps may follow
  float off = 0;          ///< by rounding: how far its numbers are off, as a share of the larger one, at most
  bool told = false;      ///< each number that differs has a formula here
  bool unjudged = false;  ///< a verdict of which the header does not say which is right, or a choice without a formula
  bool tie = false;       ///< a verdict about two depths that are equal, to the last bit
  bool free = false;      ///< which of two edges at one x is named: either is right
  std::uint16_t says_nothing = 0;  ///< of the fields that differ: the slope of a span without width
  /// An edge that ends is moved to where it ends, before it is taken out; a span without pixels.
  bool idle = false;
  /// What follows it belongs to it, or should, and is in both runs: then it may not be missing.
  bool needed = false;
};

/// A place that a step of the other run writes, which this run does not have.
struct Elsewhere {
  std::int64_t before = 0;  ///< the last step of this run that comes before it
  std::int32_t difference = 0;
  formulas::Place place;
  Identity::Key name = 0;  ///< of the edge, vertex or piece that the place is of; else 0
};

/// Goes through A or B and says of each of its differences what it finds; what another difference only the other run
/// has is in `elsewhere`, by `before`. Returns the same of this run, for going through the other one.
std::vector<Elsewhere> follow(const Trace& trace, bool of_a, const DiffReport& report, const BeforeFirst& before,
                              const std::vector<Elsewhere>& elsewhere, std::vector<Finding>& findings,
                              const std::function<bool(std::int64_t)>& on_way, Way way);

}  // namespace zstep::diff
