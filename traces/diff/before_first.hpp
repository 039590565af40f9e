// To where two runs differ first: what comes before needs no formulas, and what comes after the last difference, and
// does not belong to it, is not read at all.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "traces/diff/diff.hpp"
#include "traces/diff/identity.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/apply_runs.hpp"

namespace zstep::diff {

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

}  // namespace zstep::diff
