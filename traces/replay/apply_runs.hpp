// What a run of pixels does to a state, all at once: the same as its events one by one (apply.hpp), without a log.
#pragma once

#include "traces/codec/runs.hpp"
#include "traces/replay/state.hpp"

namespace zstep {

namespace detail {

/// What stood at a pixel before the fragment that comes now.
inline Fragment fragment_before(const Picture& picture, std::size_t pixel, std::int32_t x, std::int32_t y, double z) {
  return {x,
          y,
          z,
          picture.depth[pixel],
          picture.polygon[pixel],
          picture.ink.empty() ? no_ink : picture.ink[pixel],
          std::nullopt};
}

}  // namespace detail

inline void apply_run(const codec::FragmentRun& run, State& state) {
  Picture& picture = state.picture_of_pass();
  const std::size_t first = picture.at(run.x, run.y), last = first + run.count - 1;
  const auto write = [&](std::size_t pixel, double z) {
    picture.depth[pixel] = z;
    picture.polygon[pixel] = run.polygon;
  };
  const std::uint64_t before_last = run.nearer & ~(std::uint64_t{1} << (run.count - 1));
  if (run.increments) {
    run.for_each([&](std::uint32_t k, std::int32_t, double z, bool nearer) {
      if (nearer && k + 1 < run.count) write(first + k, z);
      return true;
    });
  } else {
    for (std::uint64_t bits = before_last; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(bits));
      write(first + k, run.depth(k));
    }
  }
  const double z = run.depth(run.count - 1);
  state.machine.fragment = detail::fragment_before(picture, last, run.end() - 1, run.y, z);
  state.machine.fragment->nearer = run.is_nearer(run.count - 1);
  if (run.is_nearer(run.count - 1)) write(last, z);
}

inline void apply_run(const codec::PaintRun& run, State& state) {
  Picture& picture = state.picture_of_pass();
  const std::size_t first = picture.at(run.x, run.y);
  run.for_each([&](std::uint32_t k, std::int32_t x, double z) {
    if (k + 1 == run.count) state.machine.fragment = detail::fragment_before(picture, first + k, x, run.y, z);
    picture.depth[first + k] = z;
    picture.polygon[first + k] = run.polygon;
    return true;
  });
}

}  // namespace zstep
