// The old values of what recent events changed in the stores, newest last.

#include "traces/replay/replay.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/header.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/key_frames.hpp"
#include "traces/replay/same.hpp"
#include "traces/replay/state.hpp"
#include "traces/scene.hpp"

namespace zstep {

class UndoLog {
 public:
  /// The position that the next entries lead to.
  void begin(std::int64_t position) { position_ = position; }

  void depth(bool light, std::size_t pixel, double old) { add(Depth{pixel, old, light}); }
  void polygon(bool light, std::size_t pixel, std::int32_t old) { add(Owner{pixel, old, light}); }
  void ink(std::size_t pixel, std::uint32_t old) { add(Ink{pixel, old}); }
  void vertex(std::size_t index, const VertexStages& old) { add(Vertex{index, old}); }
  void vertex_added() { add(VertexAdded{}); }
  /// Those from the `kept`-th on.
  void vertices_dropped(const SharedChunks<VertexStages>& vertices, std::size_t kept) {
    std::vector<VertexStages> old;
    for (std::size_t i = kept; i < vertices.size(); ++i) old.push_back(vertices[i]);
    add(VerticesDropped{std::make_shared<const std::vector<VertexStages>>(std::move(old))});
  }
  void fragment(const std::optional<Fragment>& old) { add(Pixel{old}); }
  void picture(bool light, const Picture& old) {
    pictures_bytes_ += old.depth.size() * (sizeof(double) + 2 * sizeof(std::int32_t));
    add(Whole{std::make_shared<const Picture>(old), light});
  }

  /// What the logged pictures take since the log was last cleared.
  std::size_t pictures_bytes() const { return pictures_bytes_; }

  /// Undoes everything that led to positions after `position`.
  void undo_to(std::int64_t position, State& state) {
    while (!entries_.empty() && entries_.back().position > position) {
      std::visit([&](const auto& old) { restore(old, state); }, entries_.back().old);
      entries_.pop_back();
    }
  }
  /// Forgets what led to positions up to `position`.
  void forget_to(std::int64_t position) {
    while (!entries_.empty() && entries_.front().position <= position) entries_.pop_front();
  }
  void clear() {
    entries_.clear();
    pictures_bytes_ = 0;
  }

 private:
  struct Depth {
    std::size_t pixel;
    double old;
    bool light;
  };
  struct Owner {
    std::size_t pixel;
    std::int32_t old;
    bool light;
  };
  struct Ink {
    std::size_t pixel;
    std::uint32_t old;
  };
  struct Vertex {
    std::size_t index;
    VertexStages old;
  };
  struct VertexAdded {};
  struct VerticesDropped {
    std::shared_ptr<const std::vector<VertexStages>> old;
  };
  struct Pixel {
    std::optional<Fragment> old;
  };
  struct Whole {
    std::shared_ptr<const Picture> old;
    bool light;
  };
  using Old = std::variant<Depth, Owner, Ink, Vertex, VertexAdded, VerticesDropped, Pixel, Whole>;
  struct Entry {
    std::int64_t position;
    Old old;
  };

  void add(Old old) { entries_.push_back(Entry{position_, std::move(old)}); }

  static Picture& picture_of(bool light, State& state) { return light ? state.light : state.picture; }
  static void restore(const Depth& entry, State& state) {
    picture_of(entry.light, state).depth[entry.pixel] = entry.old;
  }
  static void restore(const Owner& entry, State& state) {
    picture_of(entry.light, state).polygon[entry.pixel] = entry.old;
  }
  static void restore(const Ink& entry, State& state) { state.picture.ink[entry.pixel] = entry.old; }
  static void restore(const Vertex& entry, State& state) { state.vertices.edit(entry.index) = entry.old; }
  static void restore(const VertexAdded&, State& state) { state.vertices.pop_back(); }
  static void restore(const VerticesDropped& entry, State& state) {
    for (const VertexStages& way : *entry.old) state.vertices.push_back(way);
  }
  static void restore(const Pixel& entry, State& state) { state.machine.fragment = entry.old; }
  static void restore(const Whole& entry, State& state) { picture_of(entry.light, state) = *entry.old; }

  std::int64_t position_ = 0;
  std::size_t pictures_bytes_ = 0;
  std::deque<Entry> entries_;
};

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
      if (on_way && on_way(ratio(state.position - from, target - from))) return;
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

// Where the next pixel, span, scan line or polygon begins.

namespace {

/// The kinds of event that begin a unit: of a method that has areas or edges in the stead of scan lines, these. A pixel
/// begins with the first thing that is said of it in this trace; methods that may do without depths paint it at once.
std::set<std::size_t> beginnings(const Trace& trace, Unit unit) {
  const Header& header = trace.header();
  const Begins* first = nullptr;
  std::set<std::size_t> kinds;
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const Begins& begins = description_of_kind(kind).begins;
    if (begins.unit != unit || !records(header, kind)) continue;
    if (first == nullptr) first = &begins;
    if (begins.word == first->word) kinds.insert(kind);
  }
  if (unit != Unit::pixel || !kinds.empty()) return kinds;
  kinds.insert(kind_of<PixelPaint>);
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if ((is_of_fragment(at_pixel_of(kind)) || kind == kind_of<HorizonTest>)&&records(header, kind)) {
      kinds.insert(kind);
      return kinds;
    }
  if (!records(header, kind_of<PixelPaint>))
    kinds.insert(records(header, kind_of<ColorWrite>) ? kind_of<ColorWrite> : kind_of<PixelWrite>);
  return kinds;
}

/// Work on polygons in turn, by the trace's marks.
bool by_marks(const Trace& trace, Unit unit) { return unit == Unit::polygon && !trace.polygons().empty(); }

}  // namespace

std::int64_t next_unit(const Trace& trace, std::int64_t from, Unit unit) {
  if (unit == Unit::event) return std::min(from + 1, trace.size());
  if (by_marks(trace, unit)) {
    const auto marks = trace.polygons();
    const auto mark =
        std::upper_bound(marks.begin(), marks.end(), from,
                         [](std::int64_t position, const PolygonMark& m) { return position < m.position; });
    return mark == marks.end() ? trace.size() : mark->position;
  }
  const std::set<std::size_t> kinds = beginnings(trace, unit);
  return trace.next(from, [&](const RecordedEvent& event) { return kinds.contains(event.event.index()); })
      .value_or(trace.size());
}

std::int64_t previous_unit(const Trace& trace, std::int64_t from, Unit unit) {
  if (unit == Unit::event) return std::max<std::int64_t>(from - 1, 0);
  if (by_marks(trace, unit)) {
    const auto marks = trace.polygons();
    const auto mark =
        std::lower_bound(marks.begin(), marks.end(), from,
                         [](const PolygonMark& m, std::int64_t position) { return m.position < position; });
    return mark == marks.begin() ? 0 : std::prev(mark)->position;
  }
  const std::set<std::size_t> kinds = beginnings(trace, unit);
  return trace.previous(from, [&](const RecordedEvent& event) { return kinds.contains(event.event.index()); })
      .value_or(0);
}

namespace {

template <class... E>
bool is_one_of(const Event& event) {
  return (holds<E>(event) || ...);
}

/// The pixel at work, as the replay would have it.
template <class E>
void set_fragment(State& state, const E& event, const HeldBefore& before) {
  Fragment fragment;
  fragment.x = event.x, fragment.y = event.y, fragment.z = event.z;
  fragment.stored = before.depth;
  fragment.stored_polygon = before.polygon;
  state.machine.fragment = fragment;
}

/// The span on which a pixel is painted, and none where a method paints without spans.
void set_span(State& state, const Trace& trace, std::int64_t step, const PixelPaint& paint) {
  if (!records<SpanBegin>(trace.header())) return;
  const auto begin = trace.previous(
      step, [](const RecordedEvent& recorded) { return is_one_of<SpanBegin, PieceDraw, SpanWinner>(recorded.event); });
  if (!begin) return;
  const Event event = trace.event(*begin).event;
  if (const auto* span = get_if<SpanBegin>(&event))
    if (span->y == paint.y && span->first <= paint.x && paint.x <= span->last) state.machine.span = *span;
}

/// The ray and what it met so far.
void set_ray(State& state, const Trace& trace, std::int64_t step) {
  const auto begin = trace.previous(
      step, [](const RecordedEvent& recorded) { return holds<RayBegin>(recorded.event); },
      Trace::Among({}, kind_of<RayBegin>));
  if (!begin) return;
  const RayBegin ray = get<RayBegin>(trace.event(*begin).event);
  state.machine.rays.tree.push_back({ray, std::nullopt});
  state.machine.rays.ray = ray.ray;
  for (std::int64_t k = *begin + 1; k <= step; ++k) {
    const Event event = trace.event(k).event;
    if (const auto* hit = get_if<RayHit>(&event)) state.machine.rays.hits.push_back(*hit);
  }
}

}  // namespace

std::optional<State> state_nearby(const Trace& trace, std::int64_t step, std::int32_t polygon,
                                  std::optional<HeldBefore> before) {
  const Event event = trace.event(step).event;
  State state;
  state.position = step;
  state.machine.polygon = polygon;
  const bool of_pixel = before && visit_event(
                                      [&]<class E>(const E& e) {
                                        constexpr bool compares = has(at_pixel<E>, AtPixel::verdict);
                                        constexpr bool paints = std::is_same_v<E, PixelPaint>;
                                        if constexpr (compares || paints) set_fragment(state, e, *before);
                                        if constexpr (compares) state.machine.fragment->nearer = e.nearer;
                                        if constexpr (paints) set_span(state, trace, step, e);
                                        return compares || paints;
                                      },
                                      event);
  if (of_pixel) return state;
  if (is_one_of<RayPlane, RayHit>(event)) {
    set_ray(state, trace, step);
    return state;
  }
  if (is_one_of<ClipTest, PolygonReject, BoxTest, CellVisit, CoverageAdd>(event)) return state;
  return std::nullopt;
}

}  // namespace zstep
