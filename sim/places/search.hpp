// Looks for the next step that fulfils a condition, forwards or backwards, a little at a time: a window goes on
// drawing, and whoever waits can stop. Blocks that cannot hold such a step are passed over.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sim/places/condition.hpp"

namespace zstep::places {

class Search {
 public:
  enum class Way : std::uint8_t { forwards, backwards };
  enum class Result : std::uint8_t { found, none, not_yet };

  /// From a position, whose own step does not count. The trace must outlive it.
  Search(const Trace& trace, Condition condition, std::int64_t from, Way way);

  /// Looks on for about this long; a block is read whole, and once for all that is found in it. Throws InputError where
  /// the trace is damaged.
  Result look(std::chrono::microseconds time);
  /// The step that was found.
  std::int64_t step() const { return at_; }
  /// After a step was found: on to the next one.
  void go_on() { result_ = Result::not_yet; }

  const Condition& condition() const { return condition_; }
  Way way() const { return way_; }
  std::int64_t at() const { return at_; }  ///< how far it has come
  double share() const;                    ///< of the way that there was, 0 to 1

 private:
  struct Interval {
    std::int64_t first, last;  ///< steps, both included
  };
  bool next_interval();
  Result look_in_interval();
  void look_in_block();
  bool forwards() const { return way_ == Way::forwards; }

  const Trace* trace_;
  Condition condition_;
  Way way_;
  std::int64_t from_, at_;
  std::vector<Interval> intervals_;    ///< worth looking at; the next one last
  std::vector<std::int64_t> waiting_;  ///< found in the block that was read last, and not yet told; the next one last
  std::int64_t looked_to_ = 0;         ///< when none of them waits any more
  Result result_ = Result::not_yet;
};

}  // namespace zstep::places
