// Steps, the named lines of an algorithm's pseudo-code, and what an algorithm may be handed as `record`: any callable
// that takes a step and its event, as the one that keeps all events in memory.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

#include "traces/events/vocabulary.hpp"

namespace zstep {

// Steps: the named lines of an algorithm's pseudo-code.
//
// A step is the pseudo-code line, the anchor of a lesson's narration and the category of a grading report at once. Each
// module lists its steps in one steps.def and declares them by including declare_steps.hpp (see there).

/// The handle of a step. Its type says which event the step records, so that recording another one does not compile.
template <class E>
struct Step {
  std::uint8_t id;
};

/// A step as a trace's header carries it.
struct StepInfo {
  std::uint8_t id = 0;      ///< unique in its trace, below step_limit
  std::uint8_t kind = 0;    ///< which event it records: an index of Event
  std::uint8_t indent = 0;  ///< depth of nesting in the pseudo-code
  std::string module;       ///< "viewing", "scan_conversion", "z_buffer"
  std::string name;         ///< "compare"
  std::string text;         ///< "if z < zbuffer[x,y]"

  bool operator==(const StepInfo&) const = default;
};

/// A method's pseudo-code: its steps in the order in which they are read.
using Page = std::vector<StepInfo>;

inline constexpr int step_limit =
    125;  ///< a token of the file is seven bits, and three of them stand for several events

/// A Recorder is called once per elementary step: record(step::write_pixel, PixelWrite{x, y, polygon}).
template <class R>
concept Recorder = requires(R& record, Step<PixelWrite> step, const PixelWrite& event) {
  record(step, event);
};

/// Records nothing and compiles to nothing (tests/bench measures that).
struct NullRecorder {
  template <class E>
  void operator()(Step<E>, const E&) const noexcept {}
};

/// Counts the steps; what a method cost, without a trace.
struct CountRecorder {
  std::array<std::int64_t, step_limit> count{};

  template <class E>
  void operator()(Step<E> step, const E&) noexcept {
    ++count[step.id];
  }
};

// Keeps every event in memory as it stands: for tests and small tools. 100 bytes an event; for runs use a
// TraceRecorder.

struct CollectedEvent {
  std::uint8_t step = 0;  ///< id of the step
  Event event;
};

struct CollectRecorder {
  std::vector<CollectedEvent> events;

  template <class E>
  void operator()(Step<E> step, const E& event) {
    events.push_back({step.id, Event(event)});
  }

  /// The events of one kind, in order.
  template <class E>
  std::vector<E> all() const {
    std::vector<E> found;
    for (const CollectedEvent& collected : events) {
      if (const E* event = get_if<E>(&collected.event)) found.push_back(*event);
    }
    return found;
  }
};

}  // namespace zstep
