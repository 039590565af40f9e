// What a method costs on a scene: its steps, its time, its memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "sim/cost/apart.hpp"

namespace zstep::compare {

struct Measured {
  const Method* method = nullptr;
  Apart::End end = Apart::End::done;  ///< the rest is there only if it is done
  std::string what;                   ///< why it failed
  Picture picture;
  std::vector<double> seconds;                   ///< of the processor, for each unrecorded run
  std::int64_t heap = -1;                        ///< bytes, see AllocationPeak::peak(); the picture is among them
  std::array<std::int64_t, step_limit> count{};  ///< by step: how often a recorded run would record it

  bool done() const { return end == Apart::End::done; }
  double median_seconds() const;
  std::int64_t steps() const;
};

struct MeasureOptions {
  double limit = 60;     ///< seconds that all runs of one method together may take
  int most_runs = 25;    ///< for the time; at least 3 unless one takes longer than a second
  double enough = 0.25;  ///< seconds of runs after which no further one is begun
  bool count = true;     ///< steps and memory, too, which takes one run more
};

/// Runs the method as it is taught, in a process of its own. `tick` is called about ten times a second with the seconds
/// so far and may throw, which stops it.
Measured measure(const Method& method, const Scene& scene, const Conventions& conventions,
                 const MeasureOptions& options, const std::function<void(double)>& tick);

}  // namespace zstep::compare
