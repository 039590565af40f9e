// What happened to one pixel: every polygon that reached it, in order, with the numbers that decided and the reason in
// words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/answers/facets_near.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

enum class Outcome : std::uint8_t {
  won,       ///< nearer than what was there
  lost,      ///< not nearer
  tie,       ///< equal; what came first stays
  painted,   ///< without a compare
  mixed,     ///< laid over what was there
  colored,   ///< the pixel got a colour that is no polygon's own
  behind,    ///< it covers the pixel, and on the interval or in the area around it another was found to be in front
  rejected,  ///< it would cover the pixel, but was not drawn: culled, edge-on, out of view
  cut_off,   ///< it covers the pixel, and the trace ends before its turn
};

/// One thing that happened to the pixel.
struct Visit {
  std::int64_t step = 0;              ///< that decided it
  std::int32_t polygon = no_polygon;  ///< of whom; none for a colour alone
  Outcome outcome = Outcome::won;
  std::optional<double> z;       ///< the buffer's own numbers; along a ray, t
  std::optional<double> stored;  ///< what it was held against
  std::int32_t stored_polygon = no_polygon;
  std::string sentence;               ///< why, in words, once tell() was asked
  std::vector<std::string> formulas;  ///< and in numbers
  std::string remark;                 ///< what is not as a compare and its writes should be: "step 205 writes A"
  std::string reason;                 ///< of a rejected one: "back-facing"; of one that was cut off, how
  std::optional<double> opacity;      ///< of a mixed one
  bool takes = false;                 ///< afterwards the pixel is one polygon's alone
  std::int32_t shows = no_polygon;    ///< that polygon: mostly its own
  std::optional<std::int64_t> wiped;  ///< the step that cleared the pixel while it was this polygon's
  std::optional<std::size_t> over;    ///< the visit that next took the pixel from this one, by its place in the history
};

/// All that happened to a pixel, by step. Of polygons that were rejected only those that cover its centre; so, too, of
/// those whose turn did not come before a recording was cut off, which stand at its last step.
/// Throws InputError where the trace is damaged, or tells what cannot be.
std::vector<Visit> pixel_history(const Trace& trace, Trace::Pixel pixel);
/// The same for who asks more than once, and keeps what tells which facets come near a pixel.
std::vector<Visit> pixel_history(const Trace& trace, const FacetsNear& facets, Trace::Pixel pixel);

/// Fills in why, for which the replay goes to the visit's step.
void tell(Replay& replay, Visit& visit);

/// What came of a visit, in a few words: "behind by 0.03", "nearer; B comes over it at step 812".
std::string outcome_text(const Trace& trace, const std::vector<Visit>& history, const Visit& visit);

/// Of a compare whose outcome is not what its numbers give: "the trace says nearer, but 7 < 7 is false".
std::string contradiction_text(const Trace& trace, bool nearer, double z, double stored);

/// A depth with nine significant digits: those that two depths are told apart by are worth more than a short number.
std::string depth_text(double z);

}  // namespace zstep::answers
