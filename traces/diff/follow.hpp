// Goes through one of two runs and follows what is different: what a difference goes back to, and whether it follows
// from the run's own operands.
#pragma once

#include <functional>
#include <vector>

#include "traces/check/inheritance.hpp"
#include "traces/diff/before_first.hpp"

namespace zstep::diff {

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
