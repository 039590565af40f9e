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
#include "traces/mistakes/mistake.hpp"

namespace zstep::grade {

enum class Level : std::uint8_t {
  matched,  ///< steps may come in another order, as far as they can be matched by what they are about
  ordered,  ///< what comes in another order than the reference's does not count
  buffers,  ///< nothing but the picture and the depths at the end; these may also come from an image
};

/// A part of a method, and what it is worth.
struct Part {
  std::string name;  ///< "edge table"
  Level level = Level::matched;
  std::vector<std::uint8_t> kinds;  ///< of the events it consists of; none of the buffers
  double computation = 0;           ///< points; none of the buffers
  double value = 0;                 ///< points
  double points() const { return computation + value; }
};

/// What was found of a part in one scene, in steps; of buffers, in pixels.
struct PartCount {
  std::int64_t expected = 0;    ///< the reference has, without those that right programs do or leave out
  std::int64_t additional = 0;  ///< the run has besides
  std::int64_t computed = 0;    ///< of the expected ones, the run has and computes from its own operands
  std::int64_t same = 0;        ///< of the expected ones, the run has with the reference's numbers, but for rounding
  std::int64_t all() const { return expected + additional; }
  /// Points of the part; where there is nothing to be done and nothing was, all of them.
  double computation_points(const Part& part) const { return part.computation * share(computed); }
  double value_points(const Part& part) const { return part.value * share(same); }

 private:
  double share(std::int64_t of) const { return all() == 0 ? 1 : static_cast<double>(of) / static_cast<double>(all()); }
};

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

/// What a homework with this `free` holds numbers to: those of a fixed-point format that it does not name are wrong where
/// float64 and float32 would have others.
HeldTo held_to(int digits, const std::vector<std::string>& free);

/// The kinds of a run's steps that nothing can be said of, as they speak of edges by numbers and the run has no edge
/// table that says which edges these are. Steps of these kinds earn nothing and are not called wrong.
std::set<std::uint8_t> kinds_of_unknown_edges(const Trace& run);

/// Judges a run of the reference's scene. Numbers are held to so many digits or decimals, however few are written: who
/// prints three would have errors taken for rounding.
Judgement judge(const Trace& reference, const Trace& run, const std::vector<Part>& parts,
                const HeldTo& held = {});

/// The known mistake that the run goes wrong by, where one is found to make its very numbers; or two that do together.
struct Likely {
  mistakes::Mistake mistake{};
  std::optional<mistakes::Mistake> also{};  ///< in the same number
};
/// `either`, where it is there, takes the mistakes that make the same numbers, so that none of them is named: another run
/// of the program may tell which.
std::optional<Likely> mistake_in(const Trace& reference, const Trace& run, const Judgement& found,
                                 std::vector<mistakes::Mistake>* either = nullptr);

/// By pixel, whether a picture has a polygon there, or ink.
std::vector<bool> drawn(const Picture& picture);

/// What is counted of a picture that a program printed instead of its steps: by pixel, whether something was drawn by
/// the reference and by the program, and whether the two differ.
PartCount count_pixels(const std::vector<bool>& reference, const std::vector<bool>& other,
                       const std::vector<float>& apart);

/// How a submission is read: its scene is the grader's, and so are its conventions but for those that it may choose.
/// `reference` must live as long as what is returned.
GivenRun given_run(const Header& reference, const Scene& scene, std::vector<std::string> free);

}  // namespace zstep::grade
