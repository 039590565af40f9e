// Keeps every event in memory as it stands: for tests and small tools. 100 bytes an event; for runs use a
// TraceRecorder.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/record/step.hpp"

namespace zstep {

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
