// Runs: what repeats along a scan line, told at once, with the depths along a span. Reading a run is many times faster
// than reading its events.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/record/event_log.hpp"

namespace zstep::codec {

// The depths along a span, as a trace foretells them.

/// The depth at column x of a span, `last` being the one told before:
/// that on the line between the ends or, by increments, one more dz_dx.
inline double depth_along(const SpanBegin& span, bool increments, std::int32_t x, double last) {
  if (increments && x != span.first) return last + span.dz_dx;
  if (span.x_right == span.x_left) return span.z_left;
  return formulas::on_line<double>(span.z_left, span.z_right, x, span.x_left, span.x_right);
}

/// The same at columns first … first + count - 1; without a question for each where they are not asked one after
/// another, so that a compiler finds several at once.
inline void depths_along(const SpanBegin& span, bool increments, std::int32_t first, std::uint32_t count, double before,
                         double* depths) {
  if (increments || span.x_right == span.x_left) {
    double z = before;
    for (std::uint32_t k = 0; k < count; ++k)
      depths[k] = z = depth_along(span, increments, first + static_cast<std::int32_t>(k), z);
    return;
  }
  const double z_left = span.z_left, x_left = span.x_left, rise = span.z_right - z_left, width = span.x_right - x_left;
  for (std::uint32_t k = 0; k < count; ++k)
    depths[k] = z_left + rise * (static_cast<double>(first + static_cast<std::int32_t>(k)) - x_left) / width;
}

/// The steps by which a trace tells of scan lines. Rows are told at once where there is one step for each kind.
struct RowSteps {
  std::uint8_t line = unknown_step, edge = unknown_step, span = unknown_step;

  explicit RowSteps(const Page& page);
  bool known() const { return line < unknown_step && edge < unknown_step && span < unknown_step; }
};

/// A scan line as it mostly is: it begins, its two active edges step, and the span between them begins.
struct Row {
  RowSteps steps;
  ScanLineBegin line{};
  std::array<EdgeStep, 2> edges{};
  SpanBegin span{};

  explicit Row(const RowSteps& steps_) : steps(steps_) {}
  static constexpr std::uint32_t events() { return 4; }
  bool has(std::uint8_t kind) const {
    return kind == kind_of<ScanLineBegin> || kind == kind_of<EdgeStep> || kind == kind_of<SpanBegin>;
  }
  template <class Visit>
  bool expand(Visit&& visit) const {
    return visit(steps.line, line) && visit(steps.edge, edges[0]) && visit(steps.edge, edges[1]) &&
           visit(steps.span, span);
  }
};

/// visit(step, event) for the events of one pixel of a span, by the steps that record them, until it returns false.
template <class Visit>
bool visit_fragment(const std::array<std::uint8_t, 4>& steps, std::int32_t x, std::int32_t y, double z, bool wins,
                    std::int32_t polygon, Visit&& visit) {
  if (!visit(steps[0], DepthInterpolate{x, y, z}) || !visit(steps[1], DepthCompare{x, y, z, wins})) return false;
  return !wins || (visit(steps[2], DepthWrite{x, y, z}) && visit(steps[3], PixelWrite{x, y, polygon}));
}

/// Pixels of a span that are held against the depth buffer, from left to right. Each is a depth_interpolate and a
/// depth_compare; where it is nearer, a depth_write and a pixel_write follow.
struct FragmentRun {
  std::int32_t x = 0, y = 0;  ///< of the first pixel
  std::uint32_t count = 0;
  std::uint64_t nearer = 0;  ///< bit k: the k-th pixel's compare
  std::int32_t polygon = 0;
  std::array<std::uint8_t, 4> steps{};  ///< interpolate, compare, write depth, write pixel
  const SpanBegin* span = nullptr;
  bool increments = false;
  double before = 0;  ///< the depth told before the first

  std::uint32_t events() const {
    return 2 * (count + static_cast<std::uint32_t>(nearer == 0 ? 0 : std::popcount(nearer)));
  }
  /// Whether some event of this kind is among them.
  bool has(std::uint8_t kind) const {
    return kind == kind_of<DepthInterpolate> || kind == kind_of<DepthCompare> ||
           (nearer != 0 && (kind == kind_of<DepthWrite> || kind == kind_of<PixelWrite>));
  }
  bool is_nearer(std::uint32_t pixel) const { return (nearer >> pixel & 1u) != 0; }
  std::int32_t end() const { return x + static_cast<std::int32_t>(count); }
  /// How many events of the run come before those of its k-th pixel.
  std::uint32_t events_before(std::uint32_t pixel) const {
    const std::uint64_t earlier = pixel == 0 ? 0 : nearer & (~std::uint64_t{0} >> (64 - pixel));
    return 2 * (pixel + static_cast<std::uint32_t>(std::popcount(earlier)));
  }

  /// Calls each(k, x, z, is nearer) for its pixels in turn; stops early when it returns false. True when all were
  /// visited.
  template <class Each>
  bool for_each(Each&& each) const {
    std::array<double, run_limit> depths;
    depths_along(*span, increments, x, count, before, depths.data());
    for (std::uint32_t k = 0; k < count; ++k)
      if (!each(k, x + static_cast<std::int32_t>(k), depths[k], is_nearer(k))) return false;
    return true;
  }
  /// The depth at its k-th pixel.
  double depth(std::uint32_t pixel) const {
    const std::int32_t column = x + static_cast<std::int32_t>(pixel);
    if (!increments) return depth_along(*span, false, column, 0);
    double z = before;
    for (std::uint32_t k = 0; k <= pixel; ++k) z = depth_along(*span, true, x + static_cast<std::int32_t>(k), z);
    return z;
  }

  /// Calls visit(step, event) for its events in turn; stops early when it returns false.
  template <class Visit>
  bool expand(Visit&& visit) const {
    return for_each([&](std::uint32_t, std::int32_t column, double z, bool wins) {
      return visit_fragment(steps, column, y, z, wins, polygon, visit);
    });
  }
};

/// Pixels of a span that take a polygon's colour without a compare: a pixel_paint each.
struct PaintRun {
  std::int32_t x = 0, y = 0;
  std::uint32_t count = 0;
  std::int32_t polygon = 0;
  std::uint8_t step = 0;
  const SpanBegin* span = nullptr;
  bool increments = false;
  double before = 0;

  std::uint32_t events() const { return count; }
  bool has(std::uint8_t kind) const { return kind == kind_of<PixelPaint>; }
  std::int32_t end() const { return x + static_cast<std::int32_t>(count); }
  template <class Each>
  bool for_each(Each&& each) const {
    std::array<double, run_limit> depths;
    depths_along(*span, increments, x, count, before, depths.data());
    for (std::uint32_t k = 0; k < count; ++k)
      if (!each(k, x + static_cast<std::int32_t>(k), depths[k])) return false;
    return true;
  }
  template <class Visit>
  bool expand(Visit&& visit) const {
    return for_each([&](std::uint32_t, std::int32_t column, double z) {
      return visit(step, PixelPaint{column, y, z, polygon});
    });
  }
};

}  // namespace zstep::codec
