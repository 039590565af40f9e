// What a process and all that it has started take.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace zstep::homework {

struct Usage {
  std::vector<pid_t> processes;  ///< those below this one, as the system lists them; none where it has no /proc
  std::uint64_t memory = 0;      ///< bytes, of all of them
  double seconds = 0;            ///< of the processor, of all of them and of those that they have waited for
};
Usage usage_below(pid_t process);

}  // namespace zstep::homework
