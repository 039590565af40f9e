// Work in a process of its own, so that it can be stopped at any moment.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace zstep::compare {

struct Apart {
  enum class End : std::uint8_t { done, out_of_time, failed };
  End end = End::done;
  std::vector<std::uint8_t> bytes;  ///< what the work returned
  std::string what;                 ///< why it failed
};

/// Runs `work` in a copy of this process. After `limit` seconds it is stopped. `tick` is called about ten times a
/// second with the seconds so far; what it throws stops the work, too, and is passed on. Where processes cannot be
/// copied (Windows, the browser), work runs here, without a limit.
Apart run_apart(const std::function<std::vector<std::uint8_t>()>& work, double limit,
                const std::function<void(double)>& tick);

}  // namespace zstep::compare
