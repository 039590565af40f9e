// Replay: the state at any position of a trace, forwards, backwards and by seek; for the words of one step also without
// a replay.
//
// Forwards, an event is applied. What is large (buffers, vertices) leaves its old value in an undo log; what is small
// (MethodState) is copied at check-points. Backwards, the large is undone and the small re-applied from the last
// check-point, so a step back costs the same wherever it is. A seek starts at the nearest key frame, and leaves key
// frames where it passes.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "traces/file/trace.hpp"
#include "traces/replay/state.hpp"

namespace zstep {

/// How far apart a replay sets its marks, in events. Tests set them close, so that short traces cross them all.
struct ReplayTuning {
  std::int64_t undo_window = 32768;       ///< what can be undone without a seek
  std::int64_t check_point_every = 1024;  ///< re-applied at most for a step back
  std::int64_t lead_in = 16384;          ///< logged before a seek's target, so that stepping back from there is at hand
  std::int64_t key_frame_every = 65536;  ///< or more, so that there are not too many
};

class Replay {
 public:
  /// The trace must outlive the replay. Begins at position 0.
  explicit Replay(const Trace& trace, const ReplayTuning& tuning = {});
  ~Replay();
  Replay(Replay&&) noexcept;
  Replay& operator=(Replay&&) noexcept;

  const Trace& trace() const;
  const State& state() const;
  std::int64_t position() const { return state().position; }

  /// To any position; clamped to 0 … trace().size(). Near ones are stepped to, far ones sought. On a long way,
  /// `on_way`, if there is one, is told now and then what share of it is done; when it returns true, the way ends
  /// there.
  using OnWay = std::function<bool(double share)>;
  void go_to(std::int64_t position, const OnWay& on_way = nullptr);
  void step_forward() { go_to(position() + 1); }
  void step_back() { go_to(position() - 1); }

  /// How often a position was sought so far, and not stepped to: what an answer costs is mostly this.
  std::int64_t seeks() const;

  /// The event that led here, or nullptr at position 0.
  const RecordedEvent* current() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Where a reader may want to go from here. `from` itself is never the answer; without one the end that way is
/// returned.
std::int64_t next_unit(const Trace& trace, std::int64_t from, Unit unit);
std::int64_t previous_unit(const Trace& trace, std::int64_t from, Unit unit);

// The state at a step without a replay, where the events around it tell all that the words for it need.

/// What a pixel held before a step.
struct HeldBefore {
  double depth = no_depth;
  std::int32_t polygon = no_polygon;
};

/// nullopt where only a replay knows it. `before`: of its pixel, for a step of one pixel.
std::optional<State> state_nearby(const Trace& trace, std::int64_t step, std::int32_t polygon,
                                  std::optional<HeldBefore> before);

}  // namespace zstep
