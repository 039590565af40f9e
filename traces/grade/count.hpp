// What is counted of a part of a run, and why it does not have all of its points. Points follow from the counts alone,
// and so do the reasons: a part has a reason where and only where it lacks points.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "traces/diff/diff.hpp"
#include "traces/file/trace.hpp"
#include "traces/scene.hpp"

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
  double share(std::int64_t of) const { return all() == 0 ? 1 : static_cast<double>(of) / static_cast<double>(all()); }
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

}  // namespace zstep::grade
