// How much work each pixel was, up to a position of a trace, and who wrote it first and last. Counted in one pass, a
// part at a time; the light's picture is another one and does not count.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/answers/polygons_of_spans.hpp"
#include "traces/file/trace.hpp"

namespace zstep::answers {

enum class Count : std::uint8_t {
  writes,  ///< colours that the pixel took: overdraw
  failed,  ///< compares that were not nearer
  first,   ///< the polygon whose colour it took first; no_polygon
  last,    ///< and last
  work,    ///< events that name it
  covers,  ///< polygons that were compared or painted there, or met by the eye's ray: depth complexity
};
inline constexpr std::array<std::string_view, 6> count_names{"overdraw",    "failed", "first-writer",
                                                             "last-writer", "work",   "complexity"};
inline constexpr std::size_t count_kinds = count_names.size();

class PixelCounts {
 public:
  /// At position 0. The trace must outlive it.
  explicit PixelCounts(const Trace& trace);

  std::int64_t position() const { return now_.position; }
  /// Counts up to `position`, forwards or backwards, for about this long; a block is counted whole. True when it is
  /// there. Throws InputError where the trace is damaged.
  bool count_to(std::int64_t position, std::chrono::microseconds time);
  void count_to(std::int64_t position) {
    while (!count_to(position, std::chrono::seconds(1))) {
    }
  }

  /// [height*width]
  const std::vector<std::int32_t>& of(Count count) const { return now_.counts[count]; }

 private:
  /// Everything at a position, so that it can be gone back to.
  struct Moment {
    std::int64_t position = 0;
    ByEnum<Count, std::vector<std::int32_t>, count_kinds> counts;
    std::vector<std::int32_t> covered_by;  ///< the last polygon that was counted there
    struct Met {
      std::int32_t polygon, before;  ///< before: the one met there before it, by its place in `met`; -1 for none
    };
    std::vector<Met> met;                ///< of methods that come back to a polygon: all that were counted
    std::vector<std::int32_t> last_met;  ///< by pixel
    std::vector<std::int32_t> edges;     ///< the polygon of each edge
    std::int32_t polygon = no_polygon, span_edge = -1;
    std::int32_t ray_x = -1, ray_y = -1;  ///< the pixel of the eye's ray; -1 where it is another ray
    bool light = false, keeps_all = false;
    std::optional<PolygonsOfSpans> spans;  ///< where not all pixels are of the polygon at work
  };
  template <class E>
  void take(std::int64_t step, const E& event);
  template <class E>
  void count(const E& event);
  void cover(std::size_t pixel, std::int32_t polygon);
  void go_back_before(std::int64_t position);
  void keep_recent();

  const Trace* trace_;
  std::int32_t width_;
  std::int64_t spacing_;
  std::size_t most_moments_;
  bool comes_back_ = false;  ///< a pixel may meet one polygon, another, and the first again
  bool rays_ = false;        ///< what a ray met is known from its hits
  Moment now_;
  std::vector<Moment> moments_;   ///< far apart, by position; the first is the beginning
  std::optional<Moment> recent_;  ///< a little before where one was last
};

}  // namespace zstep::answers
