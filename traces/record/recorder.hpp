// What an algorithm may be handed as `record`: any callable that takes a step and its event.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>

#include "traces/record/step.hpp"

namespace zstep {

/// A Recorder is called once per elementary step: record(step::compare, DepthCompare{x, y, z, nearer}).
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

}  // namespace zstep
