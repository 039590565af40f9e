// What came to one pixel, and what of it was compared and written, as the trace records it: the one reading on which
// why-not and the history of a pixel rest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/answers/origin/find.hpp"
#include "sim/words/notation.hpp"
#include "traces/file/trace.hpp"

namespace zstep::answers {

// What the history of any pixel asks of a whole trace, found once: which facets of the scene could cover the pixel, by
// squares of the raster, and on which polygons work never begins.

class FacetsNear {
 public:
  /// Looks at each facet and each polygon's beginning once.
  explicit FacetsNear(const Trace& trace);

  /// All facets that could cover this pixel, and some others; in order.
  std::vector<std::int32_t> near(Trace::Pixel pixel) const;

  /// By polygon: work on it begins. Empty where it begins on all, or others than these are drawn or dropped.
  const std::vector<bool>& begun() const { return begun_; }

 private:
  std::int32_t squares_across_ = 0;
  std::vector<std::size_t> first_;      ///< of each square, where its facets begin; one more at the end
  std::vector<std::int32_t> facets_;    ///< square after square
  std::vector<std::int32_t> anywhere_;  ///< facets with a corner that is not before the eye
  std::vector<bool> begun_;
};

enum class Outcome : std::uint8_t {
  won,           ///< nearer than what was there
  lost,          ///< not nearer
  tie,           ///< equal; what came first stays
  painted,       ///< without a compare, by a step that takes depth and colour at once
  written,       ///< without a compare: a depth, a colour or both
  mixed,         ///< laid over what was there
  interpolated,  ///< its depth was interpolated there, and no step says that it was compared or written
  colored,       ///< the pixel got a colour that is no polygon's own
  behind,        ///< it covers the pixel, and on the interval or in the area around it another was found to be in front
  rejected,      ///< it would cover the pixel, but was not drawn: culled, edge-on, out of view
  cut_off,       ///< it covers the pixel, and the trace ends before its turn
};

/// Something that a polygon did to a pixel of the eye's picture, or would have done: the steps that belong together
/// there.
struct Visit {
  std::int64_t step = 0;  ///< that decided it: the compare, where there is one
  std::int32_t polygon =
      no_polygon;  ///< at work there; where nothing says so, the one that is written; none if that is not known either
  Outcome outcome = Outcome::won;
  std::optional<double> z;                   ///< the buffer's own numbers: compared, painted or written; along a ray, t
  std::optional<double> stored;              ///< what it was held against; none where that is not recorded
  std::int32_t stored_polygon = no_polygon;  ///< whose the pixel was before
  bool only_cleared = true;                  ///< no depth was written here since the buffers were cleared

  std::optional<double> kept;       ///< the depth that was written
  std::int64_t kept_at = 0;         ///< the step that wrote it
  std::int64_t written = 0;         ///< the step that changed the pixel's colour, 0 if none did
  bool takes = false;               ///< afterwards it is one polygon's alone: glass that is mixed in only colours it
  std::int32_t shows = no_polygon;  ///< that polygon: mostly its own
  double opacity = 1;               ///< of what is mixed in
  std::int64_t blended = 0;         ///< the step that mixed it in, also where a compare came first

  // What the history of the pixel adds.
  std::string sentence;               ///< why, in words, once tell() was asked
  std::vector<std::string> formulas;  ///< and in numbers
  std::vector<words::Owned> owned{};  ///< whose they are
  std::string remark;                 ///< how compare and writes differ from what they should be: "step 205 writes A"
  std::string reason;                 ///< of a rejected one: "back-facing"; of one that was cut off, how
  std::optional<std::int64_t> wiped;  ///< the step that cleared the pixel while it was this polygon's
  std::optional<std::size_t> over;    ///< the visit that next took the pixel from this one, by its place in the history

  /// Does a compare alone say what came of it?
  bool compared() const { return outcome == Outcome::won || outcome == Outcome::lost || outcome == Outcome::tie; }
  bool nearer() const { return outcome != Outcome::lost && outcome != Outcome::tie; }
};

/// All that happened to a pixel after a step (standard: since its picture began), in order. A blend that follows a
/// compare is one with it.
std::vector<Visit> visits_of(const Trace& trace, Trace::Pixel pixel, std::int64_t after);
std::vector<Visit> visits_of(const Trace& trace, Trace::Pixel pixel);

/// May a polygon have visits there? Answered without reading all that was done at the pixel; where this is false, it
/// has none in the whole trace.
bool may_have_visits(const Trace& trace, Trace::Pixel pixel, std::int32_t polygon);

/// Does a run have steps that say whose a pixel is? Where it has none, and compares depths, the last that is found to
/// be nearer takes the pixel.
bool records_owners(const Trace& trace);
/// Does it have steps that say what is written into the depth buffer?
bool records_depths(const Trace& trace);

/// The last that took the pixel before a step; nullptr while it shows the background.
const Visit* holder(const std::vector<Visit>& visits, std::int64_t before);

/// Is this depth nearer than what is stored, by the trace's conventions?
bool is_nearer(const Trace& trace, double z, double stored);
/// Does a compare's outcome follow from its two depths? True where the stored one is not known.
bool follows(const Trace& trace, const Visit& compared);
/// A depth was compared and found nearer, the pixel was written, and the depth was not.
bool lacks_depth(const Visit& visit);
/// The depth that was written is another than the one compared.
bool keeps_other_depth(const Visit& visit);

}  // namespace zstep::answers
