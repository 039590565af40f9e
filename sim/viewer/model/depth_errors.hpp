// By how much the depths of a run are off, as it adds up along the span and the edge at work.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/viewer/model/moment.hpp"
#include "traces/oracle/errors.hpp"

namespace zstep::viewer {

/// The errors of a trace's depths. Found once; none where the trace is too long to wait for them.
class DepthErrors {
 public:
  const std::vector<oracle::DepthError>& of(const Trace& trace);
  bool too_long(const Trace& trace) const { return trace.size() > most_steps; }
  /// Of the whole run: the axes stay where they are.
  double least() const { return least_; }
  double most() const { return most_; }
  std::int32_t longest() const { return longest_; }

  static constexpr std::int64_t most_steps = 100'000;

 private:
  bool found_ = false;
  std::vector<oracle::DepthError> all_;  ///< by step
  double least_ = 0, most_ = 0;
  std::int32_t longest_ = 1;  ///< pixels of a span, or scan lines of an edge, after the first
};

/// What has added up until a step.
struct Drift {
  std::int32_t y = 0;                    ///< of the span
  std::vector<oracle::DepthError> span;  ///< its depths so far
  std::vector<oracle::DepthError> edge;  ///< the first depths of all spans so far that begin at its left edge
  bool chosen = false;                   ///< it is the last span that reached a chosen pixel, not the one at work
  bool past = false;                     ///< none is at work: it is the last one that was
};

/// Of the span at work, else of the last one that was, or of the last one that reached a chosen pixel; none where there
/// is none.
std::optional<Drift> drift_at(const Moment& now, DepthErrors& errors, std::optional<Cell> chosen);

}  // namespace zstep::viewer
