// Points for a run that somebody's own program made (docs/homework.md).
//
// A method has parts, as "edge table" and "spans": some kinds of steps each. A step earns for its computation where its
// numbers follow from the operands that the run itself has (check), and for its value where they are the reference's
// (diff). So what correctly follows from an early mistake keeps the points of its computation. All is counted in steps
// or pixels: who has the report can work out the points by hand.
#pragma once

#include <array>
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
#include "traces/scene.hpp"

namespace zstep::grade {

// Programs that number polygons or vertices otherwise than the scene does: then every step of theirs is about something
// else, and each is called missing, though all that is wrong is the number.

enum class Numbering : std::uint8_t {
  as_scene,             ///< or nothing tells
  polygons_from_1,      ///< the scene's begin at 0
  vertices_from_1,      ///< likewise
  vertices_of_polygon,  ///< each polygon's from 0, where a vertex is known by its number in the scene
};

/// By the edges that a run names: how its numbers would have to be meant for them to be edges of the scene.
Numbering numbering_of(const Trace& run);

/// The scene as it is for a program that numbers so from 1: what is numbered 0 there is something that no run names.
Scene numbered_from_1(Scene scene, Numbering numbering);

// What is counted of a part of a run, and why it does not have all of its points. Points follow from the counts alone,
// and so do the reasons: a part has a reason where and only where it lacks points.

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

/// Why a part does not have all points: steps of a kind, or pixels, that earn nothing, or not all they could.
struct Loss {
  enum class Why : std::uint8_t {
    never,          ///< the run has no step of this kind
    missing,        ///< steps that it lacks
    additional,     ///< steps that it has besides
    numbers,        ///< steps with other numbers than the reference's
    computation,    ///< steps that do not follow from the run's own operands
    order,          ///< steps that come in another order; of the part, not of a kind
    unknown_edges,  ///< steps that speak of edges of which the run does not say which these are
    not_reached,    ///< steps that it lacks as far as it could be read
    colors,         ///< pixels of another colour
    depths,         ///< pixels of another depth
    no_colors,      ///< pixels of a submission without a picture
    no_depths,      ///< pixels of a submission without depths
    beyond,         ///< pixels that should not be drawn
  };
  Why why = Why::missing;
  std::uint8_t kind = 0;  ///< of the steps
  std::int64_t count = 0;
};

/// What was found of a part in one scene, in steps; of buffers, in pixels.
struct PartCount {
  /// Of the expected pixels, those with the right colour and those with the right depth, where a picture is both. Each
  /// is worth half.
  struct Halves {
    std::int64_t colors = 0, depths = 0;
  };
  std::int64_t expected = 0;    ///< the reference has, without those that right programs do or leave out
  std::int64_t additional = 0;  ///< the run has besides
  std::int64_t computed = 0;    ///< of the expected ones, the run has and computes from its own operands
  std::int64_t same = 0;        ///< of the expected ones, the run has with the reference's numbers, but for rounding
  std::optional<Halves> halves = std::nullopt;
  std::vector<Loss> lost{};  ///< empty where and only where the part has all points
  std::int64_t all() const { return expected + additional; }
  /// Its halves are to be told apart: not the same pixels are right in both.
  bool in_halves() const { return halves && (halves->colors != same || halves->depths != same); }
  /// Points of the part; where there is nothing to be done and nothing was, all of them.
  double computation_points(const Part& part) const { return part.computation * share(computed); }
  double value_points(const Part& part) const {
    return part.value * (halves ? (share(halves->colors) + share(halves->depths)) / 2 : share(same));
  }

 private:
  double share(std::int64_t of) const { return all() == 0 ? 1 : ratio(of, all()); }
};

/// By pixel, whether a picture has a polygon there, or ink.
std::vector<bool> drawn(const Picture& picture);

/// A picture held against the reference's, by pixel: how far they are apart (0: not at all). Empty where the submission
/// has no such thing.
struct PixelsApart {
  std::vector<float> color, depth;
};
/// What is counted of a picture: by pixel, whether something was drawn by the reference and by the program, and whether
/// the two differ. `keeps_depths`: the method has depths, too.
PartCount count_pixels(const Part& part, const std::vector<bool>& reference, const std::vector<bool>& other,
                       const PixelsApart& apart, bool keeps_depths);
/// Does a picture have the depth of something anywhere?
bool has_depths(const Picture& picture);

/// Counts steps by part.
class Counter {
 public:
  /// `not_computed`: by step of the run, from 1, whether it does not follow from the run's own operands; `aside`: kinds
  /// that earn nothing.
  Counter(const Trace& reference, const Trace& run, const diff::DiffReport& difference,
          const std::vector<bool>& not_computed, const std::set<std::uint8_t>& aside);
  PartCount steps(const Part& part) const;

 private:
  std::int64_t out_of_order(const Part& part) const;

  const Trace& run_;
  const diff::DiffReport& difference_;
  const std::set<std::uint8_t>& aside_;
  std::array<std::int64_t, kind_count> expected_, not_computed_{};
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
  std::optional<mistakes::Mistake> also{};  ///< besides
};
/// `either`, where it is there, takes the mistakes that make the same numbers, so that none of them is named: another
/// run of the program may tell which.
std::optional<Likely> mistake_in(const Trace& reference, const Trace& run, const Judgement& found,
                                 std::vector<mistakes::Mistake>* either = nullptr);

/// How a submission is read: its scene is the grader's, and so are its conventions but for those that it may choose.
/// `reference` must live as long as what is returned.
GivenRun given_run(const Header& reference, const Scene& scene, std::vector<std::string> free);

}  // namespace zstep::grade
