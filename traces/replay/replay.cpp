#include "traces/replay/replay.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>

#include "traces/error.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/undo_log.hpp"

namespace zstep {

namespace {

constexpr std::int64_t undo_window = 32768;       // events that can be undone without a seek
constexpr std::int64_t check_point_every = 1024;  // events re-applied at most for a step back
constexpr std::int64_t lead_in =
    16384;  // events before a seek's target that are logged, so that stepping back is at hand
constexpr std::int64_t key_frame_at_least = 65536;
constexpr std::size_t key_frame_budget = std::size_t{64} << 20;  // bytes

}  // namespace

struct Replay::Impl {
  explicit Impl(const Trace& trace_) : trace(&trace_), points(trace_.scene().points.size()) {
    state.picture = Picture(trace->scene().raster.width, trace->scene().raster.height);
    state.vertices.resize(points);
    if (trace->scene().camera.kind == Camera::Kind::screen) {
      for (std::size_t i = 0; i < points; ++i) {
        const glm::dvec3& point = trace->scene().points[i];
        state.vertices[i].stage = VertexWay::on_raster;
        state.vertices[i].plane = point;
        state.vertices[i].raster = {point.x, point.y};
      }
    }
    const std::size_t frame_size = state.picture.depth.size() * 12 + points * sizeof(VertexWay) + 1;
    const auto frames = static_cast<std::int64_t>(std::clamp<std::size_t>(key_frame_budget / frame_size, 4, 32));
    key_frame_spacing = std::max(key_frame_at_least, trace->size() / frames);
    key_frames.emplace(0, state);
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
      apply_machine(event, state.machine);
    } catch (const Impossible& error) {
      refused = true;
      impossible(position, error);
    }
    state.position = position;
  }

  /// Ahead with a log.
  void step_to(std::int64_t target) {
    while (state.position < target) {
      const std::int64_t next = state.position + 1;
      const RecordedEvent& recorded = trace->event(next);
      log.begin(next);
      try {
        std::visit([&](const auto& event) { apply(next, event, log); }, recorded.event);
      } catch (...) {
        log.undo_to(state.position, state);
        throw;
      }
      if (state.position - check_points.back().first >= check_point_every)
        check_points.emplace_back(state.position, state.machine);
      if (state.position - check_points.front().first > undo_window + check_point_every) {
        check_points.pop_front();
        log.forget_to(check_points.front().first);
      }
    }
  }

  /// Ahead without one, leaving key frames.
  void run_to(std::int64_t target) {
    if (state.position >= target) return;
    refused = false;
    try {
      run(target);
    } catch (...) {
      if (refused) {
        // The refused event may be half applied: go once more from what is known to be whole.
        const std::int64_t whole = state.position;
        state = std::prev(key_frames.upper_bound(whole))->second;
        run(whole);
      }
      forget();
      throw;
    }
    forget();
  }

  void run(std::int64_t target) {
    NoLog none;
    std::int64_t next_frame = std::prev(key_frames.upper_bound(state.position))->first + key_frame_spacing;
    trace->visit(state.position, target, [&](std::int64_t position, std::uint8_t, const auto& event) {
      apply(position, event, none);
      if (position >= next_frame) {
        key_frames.try_emplace(position, state);
        next_frame = position + key_frame_spacing;
      }
      return true;
    });
  }

  void back_to(std::int64_t target) {
    log.undo_to(target, state);
    while (check_points.back().first > target) check_points.pop_back();
    auto fragment = state.machine.fragment;
    state.machine = check_points.back().second;
    for (std::int64_t position = check_points.back().first + 1; position <= target; ++position) {
      std::visit([&](const auto& event) { apply_machine(event, state.machine); }, trace->event(position).event);
    }
    state.machine.fragment = fragment;
    state.position = target;
  }

  void seek(std::int64_t target) {
    const auto frame = std::prev(key_frames.upper_bound(target));
    const bool from_here = state.position <= target && state.position >= frame->first;
    if (!from_here) {
      state = frame->second;
      forget();
    }
    run_to(target - lead_in);
    step_to(target);
  }

  /// Nothing before this position can be undone.
  void forget() {
    log.clear();
    check_points.clear();
    check_points.emplace_back(state.position, state.machine);
  }

  const Trace* trace;
  std::size_t points;
  State state;
  UndoLog log;
  std::deque<std::pair<std::int64_t, Machine>> check_points;  ///< never empty; the log reaches back to the first
  std::map<std::int64_t, State> key_frames;                   ///< position 0 always
  std::int64_t key_frame_spacing = key_frame_at_least;
  bool refused = false;
};

Replay::Replay(const Trace& trace) : impl_(std::make_unique<Impl>(trace)) {}
Replay::~Replay() = default;
Replay::Replay(Replay&&) noexcept = default;
Replay& Replay::operator=(Replay&&) noexcept = default;

const Trace& Replay::trace() const { return *impl_->trace; }
const State& Replay::state() const { return impl_->state; }

void Replay::go_to(std::int64_t position) {
  position = std::clamp<std::int64_t>(position, 0, impl_->trace->size());
  const std::int64_t here = impl_->state.position;
  if (position >= here && position - here <= undo_window) impl_->step_to(position);
  else if (position < here && position >= impl_->check_points.front().first) impl_->back_to(position);
  else impl_->seek(position);
}

const RecordedEvent* Replay::current() const { return position() == 0 ? nullptr : &impl_->trace->event(position()); }

}  // namespace zstep
