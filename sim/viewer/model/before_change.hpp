// The run before the last change of the scene. It goes to the same moment as the run that is shown, so that what a
// table or a picture shows can be held against what it showed then.
#pragma once

#include <cstdint>
#include <memory>

#include "sim/viewer/model/session.hpp"
#include "traces/diff/align.hpp"

namespace zstep::viewer {

/// Beyond so many steps of both runs together, matching them would keep a reader waiting.
inline constexpr std::int64_t most_steps_matched = 400'000;

class BeforeChange {
 public:
  /// `now` must outlive this.
  BeforeChange(const Session& now, std::shared_ptr<const Trace> before);

  Session& session() { return session_; }
  /// Brings it to where the run that is shown is.
  void follow();

 private:
  const Session& now_;
  std::shared_ptr<const Trace> trace_;
  diff::Alignment both_;  ///< A is the run that is shown
  Session session_;
};

/// Where run B is when run A is there: at the partner of that step, or else behind what comes before it.
std::int64_t moment_in_b(const diff::Alignment& both, std::int64_t at, std::int64_t size_a, std::int64_t size_b);

}  // namespace zstep::viewer
