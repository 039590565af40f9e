// Scenes of each student's own: how much two runs have in common, whatever their scenes are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traces/file/trace.hpp"
#include "traces/grade/grade.hpp"

namespace zstep::homework {

/// What a run has in steps that hold numbers, in any order, numbers up to rounding: the least of the steps' hashes, by
/// which the share of what two runs have in common is known without either run (A. Z. Broder, 1997).
struct Sketch {
  std::vector<std::uint64_t> least;  ///< ascending
  std::int64_t steps = 0;            ///< different ones
  std::int64_t numbers = 0;          ///< different ones in them, but for 0
  std::uint64_t whole = 0;           ///< the same where all steps are
};
/// Of the steps of these parts.
Sketch sketch_of(const Trace& run, const std::vector<grade::Part>& parts);
/// Of the steps that either has, the share that both have.
double in_common(const Sketch& a, const Sketch& b);

/// A run of a scene of the student's own, and the right run.
struct OwnRun {
  std::string scene;
  Sketch run, right;
};

/// Who handed in what.
struct HandedIn {
  std::string name;
  std::vector<OwnRun> runs;
};

/// Runs of one scene's name that are nearly the same, although the scenes are not.
struct AlikeRuns {
  std::string scene;
  std::vector<std::string> names;      ///< of who handed them in
  bool same = true;                    ///< all steps that hold numbers
  double share = 1;                    ///< of them that any has in common with the first, at least
  std::int64_t steps = 0;              ///< of the first
  std::vector<std::string> right_for;  ///< students on whose scenes they are right, or nearly
};
/// Finds them in n log n. Runs that are those of a public scene are none: who mixes up files has them, too.
std::vector<AlikeRuns> alike_runs(const std::vector<HandedIn>& all, const std::vector<Sketch>& right_public);

}  // namespace zstep::homework
