// Points for a run that somebody's own program made (docs/homework.md).
//
// A method has parts, as "edge table" and "spans": some kinds of steps each. A step earns for its computation where its
// numbers follow from the operands that the run itself has (check), and for its value where they are the reference's
// (diff). So what correctly follows from an early mistake keeps the points of its computation. All is counted in steps
// or pixels: who has the report can work out the points by hand.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "traces/check/check.hpp"
#include "traces/diff/buffers.hpp"
#include "traces/diff/diff.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/trace.hpp"
#include "traces/grade/count.hpp"
#include "traces/mistakes/mistake.hpp"

namespace zstep::grade {

/// Where a run first goes wrong: at a step that parts from the reference for a reason of its own, or that does not
/// follow from its own operands.
struct Divergence {
  std::optional<diff::Difference> parts;
  std::optional<Fault> fault;
  std::optional<diff::TooEarly> too_early;  ///< of `parts`: only its place in the order is wrong
  std::int64_t step = 0;  ///< of the run; the one before which something is missing, where it has no such step
};

/// What is in the buffers at the end of the reference and of a run, and where these differ.
struct Ends {
  Picture reference, run;
  diff::BufferDifference apart;
};

struct Judgement {
  std::vector<PartCount> parts;
  std::optional<Divergence> first;  ///< none where nothing is wrong
  Ends ends;
  diff::DiffReport difference;
  CheckReport checked;
};

/// What a homework with this `free` holds numbers to: those of a fixed-point format that it does not name are wrong
/// where float64 and float32 would have others.
HeldTo held_to(int digits, const std::vector<std::string>& free);

/// The kinds of a run's steps that nothing can be said of, as they speak of edges by numbers and the run has no edge
/// table that says which edges these are. Steps of these kinds earn nothing and are not called wrong.
std::set<std::uint8_t> kinds_of_unknown_edges(const Trace& run);

/// Judges a run of the reference's scene. Numbers are held to so many digits or decimals, however few are written: who
/// prints three would have errors taken for rounding.
Judgement judge(const Trace& reference, const Trace& run, const std::vector<Part>& parts, const HeldTo& held = {});

/// The known mistake that the run goes wrong by, where one is found to make its very numbers; or two that do together.
struct Likely {
  mistakes::Mistake mistake{};
  std::optional<mistakes::Mistake> also{};  ///< in the same number
};
/// `either`, where it is there, takes the mistakes that make the same numbers, so that none of them is named: another
/// run of the program may tell which.
std::optional<Likely> mistake_in(const Trace& reference, const Trace& run, const Judgement& found,
                                 std::vector<mistakes::Mistake>* either = nullptr);

/// How a submission is read: its scene is the grader's, and so are its conventions but for those that it may choose.
/// `reference` must live as long as what is returned.
GivenRun given_run(const Header& reference, const Scene& scene, std::vector<std::string> free);

}  // namespace zstep::grade
