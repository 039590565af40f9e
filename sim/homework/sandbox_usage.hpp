// What a process and all that it has started take.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace zstep::homework {

struct Usage {
  std::vector<pid_t> processes;  ///< those below this one, as the system lists them; none where it has no /proc
  std::uint64_t memory = 0;      ///< bytes, of all of them
  double seconds = 0;  ///< of the processor, of all of them and of those that they, or this one, have waited for
};
/// Memory that several processes share counts once, in parts: their proportional set size. The system needs a while to
/// tell it, so it is asked only where all of their pages are more than `allowed`; where it does not tell, those count.
Usage usage_below(pid_t process, std::uint64_t allowed = ~std::uint64_t{0});

}  // namespace zstep::homework
