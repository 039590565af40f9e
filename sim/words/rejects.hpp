// A polygon's verdicts before the raster (which way it faces, why it is dropped), held against the numbers that they
// rest on.
#pragma once

#include <cstdint>
#include <string>

#include "traces/events/vocabulary.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// What the four numbers of a facing test say; those within rounding of 0, and what is not a number, say nothing.
struct FacingVotes {
  bool front = false, back = false;
  bool disagree() const { return front && back; }
  /// Does one of them say other than this?
  bool speak_against(Facing facing) const {
    return (front && facing != Facing::front) || (back && facing != Facing::back);
  }
};
FacingVotes votes_of(const Scene& scene, std::int32_t facet, const FacingTest& test);
/// "faces the eye", "faces away from the eye", "is seen edge-on".
const char* facing_text(Facing facing);

/// A reason for which a facet was dropped, held against the scene and, where one was recorded, its facing test.
struct RejectCheck {
  bool holds = true;  ///< or nothing speaks against it
  bool shown = true;  ///< something speaks for it; else it cannot be checked
  std::string text;  ///< what speaks against it, or why it cannot be checked: "it faces the eye, as (p − e)·n = −2.5 is
                     ///< negative"
};
/// `test`: the last of this facet, nullptr where there is none. Without one, only what the scene's own camera drops can
/// be checked.
RejectCheck check_reject(const Scene& scene, std::int32_t facet, Reject reason, const FacingTest* test);

}  // namespace zstep
