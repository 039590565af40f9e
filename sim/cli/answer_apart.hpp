// An answer that is worked out in a process of its own, so that there is one whatever becomes of that process.
#pragma once

#include <functional>
#include <string>

#include "sim/cli/messages.hpp"
#include "sim/cli/watch.hpp"
#include "sim/homework/run_programs.hpp"

namespace zstep::cli {

struct Answer {
  std::string text;
  int code = exit_code::done;
};

/// What `work` answers within these limits; where it comes to no end, what `otherwise` answers to why not ("took more
/// than 10 seconds …"), with exit_code::incomplete. Where there are no processes to be had, `work` is done in this one,
/// which the limits end.
Answer answer_apart(const homework::GradingLimits& limits, const std::function<Answer()>& work,
                    const std::function<std::string(const std::string&)>& otherwise, Watch& watch);

}  // namespace zstep::cli
