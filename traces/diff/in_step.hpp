// How far two runs do the same steps in the same order: there, what a step is about need not be found out.
#pragma once

#include <functional>
#include <optional>
#include <unordered_set>
#include <vector>

#include "traces/diff/align.hpp"
#include "traces/diff/identity.hpp"
#include "traces/diff/steps.hpp"
#include "traces/diff/waiting.hpp"

namespace zstep::diff {

/// Polygons that were begun. Who works scan line by scan line comes back to them.
class Begun {
 public:
  template <class E>
  bool again(const E& event) {
    if constexpr (std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>) polygons_.clear();
    if constexpr (std::is_same_v<E, PolygonBegin>) return !polygons_.insert(event.polygon).second;
    return false;
  }
  bool has(const PolygonBegin& event) const { return polygons_.contains(event.polygon); }

 private:
  std::unordered_set<std::int32_t> polygons_;
};

/// One of the two runs: what was read of it, what it calls things by then.
struct Run {
  const Trace& trace;
  const Both& both;
  Steps steps;
  Identity identity;
  Begun begun;
  Waiting waiting;        ///< steps that the other run has not done yet
  std::int64_t last = 0;  ///< the last step that was read by itself

  Run(const Trace& trace_, const Both& both_)
      : trace(trace_),
        both(both_),
        steps(trace_, both_),
        identity(trace_, {both_[kind_of<EdgeTableInsert>], both_[kind_of<PieceDraw>]}) {}
  /// The next step; none at the end.
  std::optional<Keyed> read();
  /// Passes over a polygon that is begun again, if that comes next.
  bool pass_repeated();
  /// Passes over a step that the other run has none of, and that says whose turn it is.
  bool pass_turn();
};

/// Steps a and b are the same, and so are those after them, so many in all.
void extend(std::vector<Match>& matches, std::int64_t a, std::int64_t b, std::int64_t count);

/// Goes through both runs while their steps are the same, but for numbers that came out otherwise, and takes note of
/// pairs and differences.
class InStep {
 public:
  /// `plain`: every step for itself. It takes longer and gives the same.
  InStep(Run& a, Run& b, Alignment& found, bool plain);

  /// Until their steps part, or one of them waits for the step that comes next in the other; false where it was told to
  /// end.
  bool go_on(const std::function<bool(double)>& on_way);
  /// Both to their ends, and byte for byte.
  bool identical() const { return equal_ == a_.trace.size() && equal_ == b_.trace.size(); }
  /// Their steps have parted: from here on each run may call things by numbers of its own.
  void part();

 private:
  struct EqualBlock;
  bool pass_equal_block();
  bool along();
  template <class E>
  bool step_along();
  template <class OneRun>
  std::uint32_t pixels_along(const OneRun& a, const OneRun& b);
  template <class OneRun>
  bool go_along(const OneRun& a, const OneRun& b);
  void count_run(const codec::FragmentRun& run);
  void count_run(const codec::PaintRun& run);
  template <class E>
  bool waits(const E& event);
  template <class E>
  void count(std::int64_t pairs, std::int64_t equal);

  Run &a_, &b_;
  Alignment& found_;
  bool plain_, one_code_;   ///< the same bytes mean the same in both
  bool one_identity_;       ///< both call all things by the same numbers; that of B is not kept then
  std::int64_t equal_ = 0;  ///< steps in blocks that are the same, byte for byte
};

}  // namespace zstep::diff
