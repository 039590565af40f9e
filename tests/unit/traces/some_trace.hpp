// Traces made of nothing: for tests of the codec, which must carry any event, sensible or not.
#pragma once

#include <vector>

#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep {

/// A step for every kind of event: step id = kind + 1, named as the kind.
inline std::uint8_t step_of(std::uint8_t kind) { return static_cast<std::uint8_t>(kind + 1); }
Header some_header();
Scene some_scene();

bool same_bits(const Event& a, const Event& b);

/// Events of every kind with numbers that stay within some_scene(), in no sensible order.
std::vector<RecordedEvent> random_events(std::size_t count, unsigned seed);

std::vector<std::uint8_t> recorded_bytes(const std::vector<RecordedEvent>& events);
Trace record_events(const std::vector<RecordedEvent>& events);

}  // namespace zstep
