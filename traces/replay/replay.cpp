#include "traces/replay/replay.hpp"

#include <algorithm>
#include <deque>

#include "traces/error.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/apply_runs.hpp"
#include "traces/replay/beginning.hpp"
#include "traces/replay/key_frames.hpp"
#include "traces/replay/memory.hpp"
#include "traces/replay/undo_log.hpp"

namespace zstep {

namespace {

constexpr std::size_t key_frame_budget = std::size_t{96} << 20;  // bytes
constexpr std::int64_t most_key_frames = 192;
constexpr std::int64_t few_events = 64;                        // that are better asked for one by one
constexpr std::size_t picture_budget = std::size_t{64} << 20;  // bytes of whole pictures in the undo log

}  // namespace

struct Replay::Impl {
  explicit Impl(const Trace& trace_, const ReplayTuning& tuning_)
      : trace(&trace_),
        tuning(tuning_),
        points(trace_.scene().points.size()),
        beginning(trace_),
        state(beginning.state()),
        key_frames(beginning, trace->size() - tuning.lead_in,
                   std::max(tuning.key_frame_every, trace->size() / most_key_frames), key_frame_budget) {
    forget();
  }

  [[noreturn]] void impossible(std::int64_t position, const Impossible& error) const {
    throw InputError(trace->name(), fmt::format("step {} cannot be: {}", position, error.what()),
                     "correct the program that wrote the trace, or open it at an earlier step");
  }

  template <class E, class Log>
  void apply(std::int64_t position, const E& event, Log& old_values) {
    try {
      // The stores first: they refuse before they change anything, and what they changed when the machine then refuses
      // is taken back by the callers.
      apply_stores(event, state, points, old_values);
      apply_method_state(event, state.machine, position);
    } catch (const Impossible& error) {
      if (trace->impl().any_lost) return pass(position);  // what it needs may be among what is lost
      refused = true;
      impossible(position, error);
    }
    state.position = position;
  }
  void pass(std::int64_t position) { state.position = position; }

  /// Ahead with a log.
  void step_to(std::int64_t target) {
    if (target - state.position > few_events) {
      trace->visit(state.position, target, [&](std::int64_t position, std::uint8_t, const auto& event) {
        step(position, event);
        return true;
      });
      return pass(target);
    }
    while (state.position < target) {
      const std::int64_t next = state.position + 1;
      if (!trace->impl().readable(next)) pass(next);
      else visit_event([&](const auto& event) { step(next, event); }, trace->event(next).event);
    }
  }
  template <class E>
  void step(std::int64_t next, const E& event) {
    log.begin(next);
    try {
      apply(next, event, log);
    } catch (...) {
      log.undo_to(state.position, state);
      throw;
    }
    if (log.pictures_bytes() > picture_budget) forget();
    if (state.position >= check_point_due) add_check_point();
    if (check_points.size() > 1 && state.position - check_points[1].first > tuning.undo_window) {
      check_points.pop_front();
      log.forget_to(check_points.front().first);
    }
  }

  /// A copy of a machine that holds much is made as seldom as it takes long.
  void add_check_point() {
    check_points.emplace_back(state.position, state.machine);
    const std::size_t held = heap_of(state.machine) / sizeof(MethodState);
    check_point_due = state.position + std::max(tuning.check_point_every, static_cast<std::int64_t>(held));
  }

  /// Ahead without one, leaving key frames.
  void run_to(std::int64_t target, const OnWay& on_way) {
    if (state.position >= target) return;
    refused = false;
    try {
      run(target, on_way);
    } catch (...) {
      if (refused) {
        // The refused event may be half applied: go once more from what is known to be whole.
        const std::int64_t whole = state.position;
        key_frames.restore_before(whole, state);
        run(whole, nullptr);
      }
      forget();
      throw;
    }
    forget();
  }

  void run(std::int64_t target, const OnWay& on_way) {
    const std::int64_t from = state.position;
    while (state.position < target) {
      if (on_way && on_way(static_cast<double>(state.position - from) / static_cast<double>(target - from))) return;
      const std::int64_t end = std::min(target, std::max(key_frames.next_due(), state.position + 1));
      trace->visit(state.position, end, Ahead{*this});
      pass(end);
      if (state.position >= key_frames.next_due()) key_frames.add(state);
    }
  }
  /// Applies events without a log, and pixels by the run.
  struct Ahead {
    Impl& replay;

    template <class E>
    bool operator()(std::int64_t position, std::uint8_t, const E& event) {
      NoLog none;
      replay.apply(position, event, none);
      return true;
    }
    template <class Run>
    requires requires(const Run& run, State& changed) { apply_run(run, changed); }
    bool operator()(std::int64_t before, const Run& run) {
      apply_run(run, replay.state);
      replay.state.position = before + run.events();
      return true;
    }
  };

  void back_to(std::int64_t target) {
    log.undo_to(target, state);
    while (check_points.back().first > target) {
      check_point_due = check_points.back().first;
      check_points.pop_back();
    }
    auto fragment = state.machine.fragment;
    state.machine = check_points.back().second;
    trace->impl().visit_at_hand(check_points.back().first, target, [&](std::int64_t position, const Event& event) {
      visit_event([&](const auto& e) { apply_method_state(e, state.machine, position); }, event);
    });
    state.machine.fragment = fragment;
    state.position = target;
  }

  void seek(std::int64_t target, const OnWay& on_way) {
    ++seeks;
    const bool from_here = state.position <= target && state.position >= key_frames.before(target);
    if (!from_here) {
      key_frames.restore_before(target, state);
      forget();
    }
    run_to(target - tuning.lead_in, on_way);
    if (state.position >= target - tuning.lead_in) step_to(target);  // else it was ended on the way
  }

  /// Nothing before this position can be undone.
  void forget() {
    log.clear();
    check_points.clear();
    add_check_point();
  }

  const Trace* trace;
  ReplayTuning tuning;
  std::size_t points;
  Beginning beginning;
  State state;
  KeyFrames key_frames;
  UndoLog log;
  std::deque<std::pair<std::int64_t, MethodState>> check_points;  ///< never empty; the log reaches back to the first
  std::int64_t check_point_due = 0, seeks = 0;
  bool refused = false;
};

Replay::Replay(const Trace& trace, const ReplayTuning& tuning) : impl_(std::make_unique<Impl>(trace, tuning)) {}
Replay::~Replay() = default;
Replay::Replay(Replay&&) noexcept = default;
Replay& Replay::operator=(Replay&&) noexcept = default;

const Trace& Replay::trace() const { return *impl_->trace; }
const State& Replay::state() const { return impl_->state; }

std::int64_t Replay::seeks() const { return impl_->seeks; }

void Replay::go_to(std::int64_t position, const OnWay& on_way) {
  position = std::clamp<std::int64_t>(position, 0, impl_->trace->size());
  const std::int64_t here = impl_->state.position;
  if (position >= here && position - here <= impl_->tuning.undo_window) impl_->step_to(position);
  else if (position < here && position >= impl_->check_points.front().first) impl_->back_to(position);
  else impl_->seek(position, on_way);
}

const RecordedEvent* Replay::current() const {
  return position() > 0 && impl_->trace->impl().readable(position()) ? &impl_->trace->event(position()) : nullptr;
}

}  // namespace zstep
