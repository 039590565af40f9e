// What one look over a trace tells: the range of its depths, where scan lines begin, how often each line ran.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

/// So many steps can be looked through between two frames.
inline constexpr std::int64_t quick = 3'000'000;

/// The depths that can be drawn, in the buffer's own numbers; the colours of the depth buffer span it. Fixed for a
/// scene and its camera, so that a colour means the same depth at every step.
struct DepthRange {
  double near = 0, far = 1;  ///< far is the smaller one where the greater depth is nearer
  bool known = false;
  bool named = true;  ///< the trace declares which of its ends is near
  bool flat() const { return !(near < far || far < near); }
  /// 0 at near, 1 at far.
  double share(double depth) const { return flat() ? 0.5 : (depth - near) / (far - near); }
};
/// From the smallest and the largest depth, as the trace declares it.
DepthRange range_between(double smallest, double largest, const Header& header);
DepthRange depth_range(const Trace& trace);

/// Scan lines of the polygon at work, or of all polygons where a method goes through them at once; for the timeline.
/// Found again when the polygon changes.
class ScanLineMarks {
 public:
  struct Mark {
    std::int64_t position;
    std::int32_t y;
  };
  struct Interval {
    std::int64_t first = 0, last = 0;  ///< the polygon's events lead to positions first+1 … last
    std::int32_t polygon = no_polygon;
    std::vector<Mark> lines;
    bool complete = true;  ///< false: too long to look through for marks
  };
  const Interval& at(const Trace& trace, std::int64_t position);
  /// The position just before the first line of all polygons at once; nullopt where each polygon has lines of its own.
  std::optional<std::int64_t> sweep_from(const Trace& trace);

 private:
  std::optional<Interval> interval_;
  bool sweep_known_ = false;
  std::optional<std::int64_t> sweep_from_;
};

/// Where the curves of a floating horizon begin, for the timeline and for drawing those that were at work. Found once;
/// none where the trace is too long to look through, or has none.
class CurveMarks {
 public:
  struct Mark {
    std::int64_t position;
    CurveBegin curve;
  };
  const std::vector<Mark>& of(const Trace& trace);
  /// The one at work at a position: its place among them, −1 before the first.
  std::ptrdiff_t at(const Trace& trace, std::int64_t position);

 private:
  std::optional<std::vector<Mark>> marks_;
};

/// Where rays begin a row of pixels, for the timeline of a method that goes from pixel to pixel. Found once; none where
/// the trace is too long to look through, or has no rays.
class RowMarks {
 public:
  struct Mark {
    std::int64_t position;
    std::int32_t y;
  };
  const std::vector<Mark>& of(const Trace& trace);
  /// The one at work at a position: its place among them, −1 before the first.
  std::ptrdiff_t at(const Trace& trace, std::int64_t position);

 private:
  std::optional<std::vector<Mark>> marks_;
};

/// How often each step ran up to a position. Follows small moves by counting; late in a huge trace that would take too
/// long.
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
