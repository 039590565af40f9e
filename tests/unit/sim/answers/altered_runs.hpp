// Traces of runs that are not whole, or not what the run did.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::test {

/// What a run recorded, without the events of which change(step, event) says no; it may alter the others.
template <class Change>
Trace changed(const Trace& trace, Change&& change) {
  TraceRecorder recorder(trace.header(), trace.scene());
  for (std::int64_t step = 1; step <= trace.size(); ++step) {
    RecordedEvent recorded = trace.event(step);
    if (change(step, recorded.event)) record_any(recorder, recorded.step, recorded.event);
  }
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "changed");
}

/// So large that every method's run takes some blocks.
inline Scene large_scene() {
  ViewOptions view;
  view.width = view.height = 250;
  return look_at_scene(load_scene("pyramid-behind").scene, view);
}

/// The first part of a recording's file, as of a program that was killed: not more than three quarters of the run's
/// steps. The run must take some blocks.
inline Trace cut_off(const std::string& method_id, const Scene& scene) {
  const Method& by = method(method_id);
  TraceRecorder recorder(header_for(by, {}), scene);
  by.record(scene, {}, recorder);
  recorder.finish();
  const std::vector<std::uint8_t> bytes = recorder.take_bytes();
  const std::int64_t whole = Trace::from_bytes(bytes, "whole").size();
  for (std::size_t left = 98;; --left) {
    Trace trace = Trace::from_bytes(
        {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() * left / 100)}, "cut off");
    if (trace.size() * 4 <= whole * 3) return trace;
  }
}

}  // namespace zstep::test
