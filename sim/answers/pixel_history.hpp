// What happened to one pixel: every polygon that reached it, in order, with the numbers that decided and the reason in
// words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/answers/visits.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

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
