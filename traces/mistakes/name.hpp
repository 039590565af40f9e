// Which known mistake did the program make that wrote a run? Among them those that put every pixel elsewhere.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "traces/check/check.hpp"
#include "traces/check/precision.hpp"
#include "traces/file/trace.hpp"
#include "traces/mistakes/mistake.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

// Mistakes that put every pixel elsewhere: found by moving all of them back, as nothing else in such a run is wrong.

/// y_upside_down or x_y_exchanged, where the run has the reference's steps at pixels, number by number, once y is
/// turned over or x and y are exchanged; and not both of them do.
std::optional<Mistake> turned_of(const Trace& reference, const Trace& run, const Precision& precision);

/// How each mistake fits the run; `faults` is what is wrong in it. Goes through it once.
ByEnum<Mistake, Fit> fits_of(const Trace& run, const Precision& precision, std::span<const Fault> faults);

/// The mistake that a run goes wrong by, where one of the catalogue makes the run's own numbers from there on; several,
/// where these make the same numbers and nothing tells which of them it is. `first` is the step at which it first goes
/// wrong, `next` the first one that is wrong for another reason; 0 where none is. The mistake must show before that:
/// what shows later may be another's doing. And it explains all that is wrong at each of its steps, and at the first
/// one. `depth_is_wrong`: at the first step it is the depth of a pixel, which no mistake with the buffer makes.
std::vector<Mistake> mistakes_of(const Trace& run, std::int64_t first, std::int64_t next, bool depth_is_wrong,
                                 const Precision& precision);

/// What a run goes wrong by, found without a right one beside it.
struct Diagnosis {
  std::vector<Mistake> either{};  ///< one of these; several where they make the same numbers
  std::optional<Mistake> also{};  ///< and this one besides
};
/// Of a run in which `report` finds something wrong: by what its steps compute, else by the pixels that it draws.
/// Nothing where it is too long to be gone through several times.
Diagnosis diagnosis_of(const Trace& run, const CheckReport& report);
/// The same by its pixels alone.
Diagnosis diagnosis_of_pixels(const Trace& run, const Precision& precision);

/// Where no single one does, two mistakes that together make the number of the first wrong step, and all later ones
/// that they would change together.
std::optional<Pair> pair_of(const Trace& run, std::int64_t first, const Precision& precision);

}  // namespace zstep::mistakes
