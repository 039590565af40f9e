// Depths over x along one scan line: the spans that were drawn there, the depths that were found at its pixels, what
// the depth buffer holds, and the depths that the step at work holds against each other.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sim/viewer/model/moment.hpp"

namespace zstep::viewer {

/// A polygon along a scan line, from edge to edge.
struct SliceSpan {
  std::int64_t step = 0;
  std::int32_t polygon = no_polygon;
  double x_left = 0, z_left = 0, x_right = 0, z_right = 0;
};
/// A polygon's depth at a place of the scan line, as the run found it.
struct SliceSample {
  std::int64_t step = 0;
  std::int32_t polygon = no_polygon;
  double x = 0, z = 0;
};

/// The scan line of a picture: the eye's, or the light's.
struct SliceAt {
  Pass pass = Pass::eye;
  std::int32_t y = 0;
  bool operator==(const SliceAt&) const = default;
};

/// All spans and samples of a trace, by scan line. Found once; none where the trace is too long to look through.
class SliceLines {
 public:
  struct Line {
    std::vector<SliceSpan> spans;
    std::vector<SliceSample> samples;
  };
  const Line& of(const Trace& trace, const SliceAt& at);
  /// False where the trace is too long to look through.
  bool complete(const Trace& trace);
  /// The last step up to a position that began this picture anew.
  std::int64_t begun(Pass pass, std::int64_t position) const;

 private:
  void find(const Trace& trace);
  bool found_ = false, complete_ = true;
  std::unordered_map<std::int64_t, Line> lines_;
  std::vector<std::pair<std::int64_t, Pass>> begins_;
};

struct Slice {
  SliceAt at;
  std::vector<SliceSpan> spans;      ///< up to the step
  std::vector<SliceSample> samples;  ///< likewise
  std::vector<double> stored;        ///< the depth buffer's, by column
  double empty = 0;                  ///< what the depth buffer holds where nothing was drawn
  std::int64_t work_from = 0;        ///< the span, or the interval, that began at this step is at work; 0: none
  /// Of all that the run draws on this line, whichever step it is: the axes stay where they are.
  double low = 0, high = 0, x_first = 0, x_last = 0;
  bool complete = true;  ///< false: only the span at work is known

  /// What the step at work holds against what the buffer has.
  struct Compare {
    std::int32_t polygon = no_polygon;
    double x = 0, z = 0, stored = 0;
    std::int32_t stored_polygon = no_polygon;
    std::optional<bool> nearer;  ///< once it is decided
    bool written = false;        ///< the step writes; what was stored is gone
  };
  std::optional<Compare> compare;
  /// Depths of polygons at one place, of which the nearest wins, and the polygon that does, once it is found.
  std::vector<SliceSample> rivals;
  std::optional<std::int32_t> winner;

  /// Where it is an attribute, and not a depth: its name, and what it is, pixel by pixel; the one span is what it would
  /// be if it were linear on the picture.
  std::string attribute;
  std::vector<SliceSample> correct;
  bool upright = false;  ///< along the column at.y, over y
};

/// The scan line of the pixel that is pointed at or selected, else of the step at work; none where there is none.
std::optional<SliceAt> slice_line(const Moment& now, std::optional<Cell> chosen);
Slice slice_of(const Moment& now, SliceLines& lines, const SliceAt& at);
/// Of the attribute that the step at work found at its pixel: along the scan line of its polygon, or along the column
/// where it is the same all along the scan line. Nothing at other steps, nor where it is the same along both.
std::optional<Slice> attribute_slice(const Moment& now);

/// "At x = 5, 0.42 < 0.5: A is nearer than B."; empty where the step holds no depths against each other there.
std::string slice_sentence(const Moment& now, const Slice& slice);

}  // namespace zstep::viewer
