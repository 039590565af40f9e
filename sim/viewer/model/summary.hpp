// What one look over a trace tells: the range of its depths, where scan lines begin, how often each line ran.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

/// The depths that can be drawn, in the buffer's own numbers; the colours of the depth buffer span it. Fixed for a trace,
/// so that a colour means the same depth at every step.
struct DepthRange {
  double near = 0, far = 1;
  bool known = false;
  bool flat() const { return !(near < far); }
  double share(double depth) const { return far > near ? (depth - near) / (far - near) : 0.5; }
};
DepthRange depth_range(const Trace& trace);

/// Scan lines of the polygon at work, for the timeline. Found again when the polygon changes.
class ScanLineMarks {
 public:
  struct Mark { std::int64_t position; std::int32_t y; };
  struct Stretch {
    std::int64_t first = 0, last = 0;  ///< the polygon's events lead to positions first+1 … last
    std::int32_t polygon = no_polygon;
    std::vector<Mark> lines;
    bool complete = true;              ///< false: too long to look through for marks
  };
  const Stretch& at(const Trace& trace, std::int64_t position);

 private:
  std::optional<Stretch> stretch_;
};

/// How often each step ran up to a position. Follows small moves by counting, and gives up on far ones in huge traces.
class HitCounts {
 public:
  void follow(const Trace& trace, std::int64_t position);
  /// nullopt when unknown.
  std::optional<std::int64_t> of(std::uint8_t step) const {
    return known_ ? std::optional(count_[step]) : std::nullopt;
  }

 private:
  std::array<std::int64_t, step_limit> count_{};
  std::int64_t position_ = 0;
  bool known_ = true;
};

}  // namespace zstep::viewer
